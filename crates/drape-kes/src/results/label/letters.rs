//! Words, numbers and letters in the text of a cell.

use crate::tables::heading::words::{Words, single};

/// Removes `words` from `text`, longest words first. Returns whether `text` had any of them.
pub(crate) fn take_words(text: &mut String, words: Words) -> bool {
    let mut found = false;
    let mut known: Vec<&str> = single(words).collect();
    known.sort_by_key(|word| std::cmp::Reverse(word.len()));
    for word in known {
        let is_wide = word.chars().all(|letter| letter > '\u{2fff}');
        let there = if is_wide { text.find(word) } else { text.find(&format!(" {word} ")) };
        if let Some(place) = there {
            let length = if is_wide { word.len() } else { word.len() + 1 };
            text.replace_range(place..place + length, " ");
            found = true;
        }
    }
    found
}

/// Returns the numbers of `text` that stand alone, with a decimal point or comma.
pub(crate) fn numbers(text: &str) -> Vec<f64> {
    let is_separator = |letter: char| !(letter.is_ascii_digit() || letter == '.' || letter == ',');
    let mut numbers = Vec::new();
    let mut before = ' ';
    for part in text.split_inclusive(is_separator) {
        let digits = part.trim_end_matches(is_separator).trim_matches([',', '.']);
        if !before.is_alphabetic()
            && let Ok(number) = digits.replace(',', ".").parse()
        {
            numbers.push(number);
        }
        before = part.chars().next_back().unwrap_or(' ');
    }
    numbers
}

/// Returns `text` with full-width letters, digits and signs in half width, and subscript digits as
/// digits.
pub(crate) fn half_width(text: &str) -> String {
    let mut letters = String::with_capacity(text.len());
    for letter in text.chars() {
        letters.push(match letter {
            '\u{ff01}'..='\u{ff5e}' => char::from_u32(letter as u32 - 0xfee0).unwrap_or(letter),
            '\u{3000}' | '\u{a0}' => ' ',
            '₀'..='₉' => char::from_u32(letter as u32 - 0x2080 + 0x30).unwrap_or(letter),
            '【' | '〔' | '「' => '(',
            '】' | '〕' | '」' => ')',
            letter => letter,
        });
    }
    letters.trim().to_owned()
}
