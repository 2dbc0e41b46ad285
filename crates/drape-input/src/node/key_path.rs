//! Key paths as messages write them, such as `panel[1].rectangle`.
//!
//! `document` and `subject` follow key paths through the values of a text. `edit` follows them
//! through a text that is changed.

/// Key of a key path, with the indices that follow it.
pub(crate) struct KeyPart<'a> {
    pub(crate) name: &'a str,
    /// Index of an element of the array at `name`, then of an element of this element, and so on.
    pub(crate) indices: Vec<usize>,
}

/// Splits the key path `key` at its dots outside of quotes.
pub(crate) fn key_parts(key: &str) -> impl Iterator<Item = KeyPart<'_>> {
    let mut quoted = false;
    let pieces = key.split(move |letter: char| {
        quoted ^= letter == '"';
        letter == '.' && !quoted
    });
    pieces.map(|piece| match piece.strip_prefix('"').and_then(|rest| rest.split_once('"')) {
        Some((name, rest)) => KeyPart { name, indices: indices(rest) },
        None => {
            let (name, rest) = piece.split_once('[').unwrap_or((piece, ""));
            KeyPart { name, indices: indices(rest) }
        }
    })
}

/// Returns the numbers that stand in brackets in `text`.
fn indices(text: &str) -> Vec<usize> {
    text.split(['[', ']']).filter_map(|number| number.parse().ok()).collect()
}
