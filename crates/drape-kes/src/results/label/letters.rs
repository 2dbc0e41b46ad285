//! Words, numbers and letters of the text of a cell.

use crate::tables::heading::words::{Words, single};

/// Takes words out of a text; returns whether there were any.
pub(crate) fn take(text: &mut String, words: Words) -> bool {
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

/// Returns the numbers of a text that stand by themselves, with a decimal point or comma.
pub(crate) fn numbers(text: &str) -> Vec<f64> {
    let letters = |letter: char| !(letter.is_ascii_digit() || letter == '.' || letter == ',');
    let mut numbers = Vec::new();
    let mut before = ' ';
    for part in text.split_inclusive(letters) {
        let digits = part.trim_end_matches(letters).trim_matches([',', '.']);
        if !before.is_alphabetic()
            && let Ok(number) = digits.replace(',', ".").parse()
        {
            numbers.push(number);
        }
        before = part.chars().next_back().unwrap_or(' ');
    }
    numbers
}

/// Returns a text with its letters, digits and signs of full width in half width, and digits below
/// the line on it.
pub(crate) fn half_width(text: &str) -> String {
    let letter = |letter: char| match letter {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(letter as u32 - 0xfee0).unwrap_or(letter),
        '\u{3000}' | '\u{a0}' => ' ',
        '₀'..='₉' => char::from_u32(letter as u32 - 0x2080 + 0x30).unwrap_or(letter),
        '【' | '〔' | '「' => '(',
        '】' | '〕' | '」' => ')',
        other => other,
    };
    text.chars().map(letter).collect::<String>().trim().to_owned()
}
