//! Keys and texts written as TOML, for files and for key paths in messages, and texts written as
//! XML.

/// Returns `name` as a TOML key, in quotes if TOML requires them, such as `"simon.back"`.
///
/// ```
/// assert_eq!(drape_input::toml_key("front_left-2"), "front_left-2");
/// assert_eq!(drape_input::toml_key("simon.back"), "\"simon.back\"");
/// ```
#[must_use]
pub fn toml_key(name: &str) -> String {
    let is_bare = !name.is_empty()
        && name.chars().all(|letter| letter.is_ascii_alphanumeric() || matches!(letter, '_' | '-'));
    if is_bare { name.into() } else { toml_string(name) }
}

/// Returns `text` as a TOML string, in quotes.
///
/// ```
/// assert_eq!(drape_input::toml_string("a \"b\"\n"), r#""a \"b\"\n""#);
/// ```
#[must_use]
pub fn toml_string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            letter if letter.is_control() => {
                quoted.push_str(&format!("\\u{:04X}", u32::from(letter)));
            }
            letter => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}

/// Returns `text` as the content of an element of XML or HTML, or as the value of an attribute in
/// double quotes.
///
/// Line ends and tabs become references, because a reader of attributes would replace them by
/// blanks. Characters that XML does not allow become U+FFFD.
///
/// ```
/// assert_eq!(drape_input::xml_text("A & \"B\" <C>"), "A &amp; &quot;B&quot; &lt;C&gt;");
/// assert_eq!(drape_input::xml_text("a\nb\u{0}"), "a&#10;b\u{fffd}");
/// ```
#[must_use]
pub fn xml_text(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' | '\r' => escaped.push_str(&format!("&#{};", u32::from(letter))),
            '\0'..' ' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            letter => escaped.push(letter),
        }
    }
    escaped
}
