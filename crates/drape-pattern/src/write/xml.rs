//! Texts in XML.

/// Returns `text` as the content of an element or an attribute.
pub(crate) fn escape(text: &str) -> String {
    let mut clean = String::new();
    for letter in text.chars() {
        match letter {
            '&' => clean.push_str("&amp;"),
            '<' => clean.push_str("&lt;"),
            '>' => clean.push_str("&gt;"),
            '"' => clean.push_str("&quot;"),
            '\n' => clean.push('\n'),
            // Characters that XML does not allow.
            letter if letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}') => {
                clean.push(' ');
            }
            letter => clean.push(letter),
        }
    }
    clean
}

/// Returns the `text-anchor` of a text beside a line, so that the text does not run over the line.
/// `inward` is the x component of the unit vector from the line to the text.
pub(crate) fn text_anchor(inward: f64) -> &'static str {
    match inward {
        0.5.. => "start",
        ..-0.5 => "end",
        _ => "middle",
    }
}
