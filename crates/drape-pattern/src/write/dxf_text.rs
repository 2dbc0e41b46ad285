//! Texts of DXF: letters beyond ASCII stand as `\U+00E9`, with the code units of UTF-16.

/// Characters with which the code of a letter begins.
const CODE: &str = "\\U+";

/// Returns `text` as it stands in a file, on one line. Control letters become spaces.
pub(crate) fn escaped(text: &str) -> String {
    let mut result = String::new();
    for letter in text.chars() {
        match letter {
            // A backslash would begin a code.
            '\\' => result.push_str("\\U+005C"),
            letter if letter.is_control() => result.push(' '),
            letter if letter.is_ascii() => result.push(letter),
            letter => {
                for unit in letter.encode_utf16(&mut [0; 2]) {
                    result.push_str(&format!("{CODE}{unit:04X}"));
                }
            }
        }
    }
    result
}

/// Returns `text` of a file with its codes replaced by their letters. A code that is no letter
/// stays as it is.
pub(crate) fn decoded(text: &str) -> String {
    let mut result = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(CODE) {
        result.push_str(&rest[..start]);
        rest = &rest[start..];

        // Two codes in a row may be one letter.
        let mut units = Vec::new();
        while let Some(unit) = rest.strip_prefix(CODE).and_then(code_unit) {
            units.push(unit);
            rest = &rest[CODE.len() + 4..];
        }
        if units.is_empty() {
            result.push_str(CODE);
            rest = &rest[CODE.len()..];
        }
        result.push_str(&String::from_utf16_lossy(&units));
    }
    result + rest
}

/// Returns the number of the four hexadecimal digits that `text` begins with.
fn code_unit(text: &str) -> Option<u16> {
    let digits = text.get(..4)?;
    let is_number = digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    u16::from_str_radix(digits, 16).ok().filter(|_| is_number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_beyond_ascii_have_codes_and_come_back() {
        assert_eq!(escaped("\u{dc}bertritt"), "\\U+00DCbertritt");
        assert_eq!(escaped("two\nlines"), "two lines");
        for text in ["plain", "\u{dc}bertritt", "\u{8eab}\u{9803}", "\u{1f457} dress", r"C:\U+0041"]
        {
            let stated = escaped(text);
            assert!(stated.is_ascii(), "{stated}");
            assert_eq!(decoded(&stated), text);
        }
    }

    #[test]
    fn codes_of_no_letter_stay_or_are_replaced() {
        assert_eq!(decoded(r"a\U+00E"), r"a\U+00E");
        assert_eq!(decoded(r"a\U+zzzz b\U+00e9"), "a\\U+zzzz b\u{e9}");
        assert_eq!(decoded(r"\U+D83D alone"), "\u{fffd} alone");
        assert_eq!(decoded("\\U+00\u{e9}9"), "\\U+00\u{e9}9");
    }
}
