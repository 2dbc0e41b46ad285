//! Keys and strings written as TOML, for files and for key paths in messages.

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
