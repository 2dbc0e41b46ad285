//! Names of panels and bodies as the formats can have them.

use std::collections::HashSet;

use drape_frames::SurfacePart;

/// Returns the names of `parts`, each once. A repeated name gets a number.
pub(crate) fn unique<'a>(parts: impl IntoIterator<Item = &'a SurfacePart>) -> Vec<String> {
    let names =
        parts.into_iter().map(|part| part.name.replace(char::is_control, " ").trim().to_owned());
    numbered(names, |name, n| format!("{name} ({n})"))
}

/// Returns identifiers for `names`, each once: letters, digits and underscores of ASCII.
pub(crate) fn identifiers<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    numbered(names.into_iter().map(identifier), |name, n| format!("{name}_{n}"))
}

/// Returns `names`, each once. `with_number` returns a repeated name with a number, from 2 on.
fn numbered(
    names: impl Iterator<Item = String>,
    with_number: impl Fn(&str, usize) -> String,
) -> Vec<String> {
    let mut taken = HashSet::new();
    let mut unique = Vec::new();
    for name in names {
        let name = if name.is_empty() { "part".to_owned() } else { name };
        let mut candidates =
            std::iter::once(name.clone()).chain((2..).map(|n| with_number(&name, n)));
        let free = candidates.find(|candidate| taken.insert(candidate.clone()));
        unique.push(free.expect("some number is free"));
    }
    unique
}

/// Returns `name` as an identifier.
fn identifier(name: &str) -> String {
    let letters = name.chars();
    let name: String = letters.map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    match name.chars().next() {
        Some(first) if first.is_ascii_digit() => format!("_{name}"),
        _ => name,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn names_are_unique_and_without_control_characters() {
        let parts = example::parts(&["front", "front", "front (2)", "a\nb\u{0}", "", " "]);
        let names = ["front", "front (2)", "front (2) (2)", "a b", "part", "part (2)"];
        assert_eq!(unique(&parts), names);
    }

    #[test]
    fn identifiers_are_unique_and_of_ascii() {
        let names = ["Vorderteil", "Ärmel 1", "_rmel_1", "1/2", "\"}", "袖", "袖子", ""];
        let expected = ["Vorderteil", "_rmel_1", "_rmel_1_2", "_1_2", "__", "_", "___2", "part"];
        assert_eq!(identifiers(names), expected);
    }
}
