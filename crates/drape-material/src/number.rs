//! Numbers and texts as the files show them.

use drape_input::figure;

/// Returns a number of a file: six digits, which is more than a fabric is known to.
pub(crate) fn number(value: f64) -> String {
    figure(rounded(value))
}

/// Returns a number rounded to six digits.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Returns a number of a sentence: three digits.
pub(crate) fn brief(value: f64) -> String {
    figure(format!("{value:.2e}").parse().unwrap_or(value))
}

/// Returns the mean over warp and weft of a number that another program has once.
pub(crate) fn mean(pair: [f64; 2]) -> f64 {
    0.5 * (pair[0] + pair[1])
}

/// Returns a text as one line: comments and tables have no place for more.
pub(crate) fn one_line(text: &str) -> String {
    let spaced =
        |c: char| if c.is_control() || c == '\u{2028}' || c == '\u{2029}' { ' ' } else { c };
    let text: String = text.chars().map(spaced).collect();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Returns a text broken into lines of at most a number of letters; a longer word has a line of its own.
pub(crate) fn wrapped(text: &str, letters: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= letters => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_six_digits_and_a_sentence_three() {
        assert_eq!(number(1.0 / 3.0), "0.333333");
        assert_eq!(number(1.234_567_89e-7), "1.23457e-7");
        assert_eq!(brief(15_762.4), "15800");
    }

    #[test]
    fn a_text_becomes_lines_that_are_not_too_long() {
        assert_eq!(one_line("a\n\n b\t\u{7}c"), "a b c");
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
    }
}
