//! Format of numbers and texts in files.

use drape_input::{figure_in_digits, round_digits};

/// Number of significant digits of a number in a file. Fabrics are measured to fewer digits.
const DIGITS: usize = 6;

/// Returns `value` with six digits, for a file.
pub(crate) fn number(value: f64) -> String {
    figure_in_digits(value, DIGITS)
}

/// Returns `value` rounded to six digits.
pub(crate) fn rounded(value: f64) -> f64 {
    round_digits(value, DIGITS)
}

/// Returns `value` with three digits, for a sentence.
pub(crate) fn brief(value: f64) -> String {
    figure_in_digits(value, 3)
}

/// Returns the mean of `pair`, a number of warp and weft, for a program with one number for both.
pub(crate) fn mean(pair: [f64; 2]) -> f64 {
    0.5 * (pair[0] + pair[1])
}

/// Returns `text` as one line, for comments and cells of tables.
pub(crate) fn one_line(text: &str) -> String {
    let words = text.split(is_separator).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join(" ")
}

/// Returns whether `letter` separates words: white space, a control character or a line separator.
fn is_separator(letter: char) -> bool {
    letter.is_whitespace() || letter.is_control()
}

/// Returns the lines of `text`, each of at most `letters` letters. A longer word is a line by
/// itself.
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
