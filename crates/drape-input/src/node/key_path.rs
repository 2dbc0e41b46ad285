//! Key paths as messages write them, such as `panel[1].rectangle`.
//!
//! `document` and `subject` follow them through the values of a text, `edit` through a text that is
//! changed.

/// Key of a key path, with the index of an element if it is an array, of an element of that if it is
/// an array of arrays, and so on.
pub(crate) struct Part<'a> {
    pub(crate) name: &'a str,
    pub(crate) indices: Vec<usize>,
}

/// Splits a key path at its dots outside of quotes.
pub(crate) fn parts(key: &str) -> impl Iterator<Item = Part<'_>> {
    let mut quoted = false;
    let pieces = key.split(move |letter: char| {
        quoted ^= letter == '"';
        letter == '.' && !quoted
    });
    pieces.map(|piece| match piece.strip_prefix('"').and_then(|rest| rest.split_once('"')) {
        Some((name, rest)) => Part { name, indices: indices(rest) },
        None => {
            let (name, rest) = piece.split_once('[').unwrap_or((piece, ""));
            Part { name, indices: indices(rest) }
        }
    })
}

/// Returns the numbers in brackets.
fn indices(text: &str) -> Vec<usize> {
    text.split(['[', ']']).filter_map(|number| number.parse().ok()).collect()
}
