//! Texts in XML.

/// Returns a text as the content of an element or an attribute.
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
