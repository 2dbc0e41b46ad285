//! Search for the known word that is nearest to a misspelt word, and messages about unknown words.

use strsim::osa_distance;

use crate::diagnostic::value_error::ValueError;
use crate::figure::excerpt;

/// Returns the word among `known` that is nearest to `word`, if it is near enough.
///
/// The distance is the number of letters to insert, delete, replace or swap with a neighbour
/// (optimal string alignment). The case of letters does not matter. A third of the letters may be
/// wrong.
///
/// ```
/// use drape_input::closest;
///
/// assert_eq!(closest("densty", ["density", "thickness"]), Some("density"));
/// assert_eq!(closest("gravity", ["density", "thickness"]), None);
/// ```
#[must_use]
pub fn closest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let letters = word.chars().count();
    let allowed = (letters / 3).max(1);
    known
        .into_iter()
        .filter(|candidate| candidate.chars().count().abs_diff(letters) <= allowed)
        .map(|candidate| (osa_distance(&word.to_lowercase(), &candidate.to_lowercase()), candidate))
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Returns the mistake that `word` is none of the words `known`, with the word that was probably
/// meant.
///
/// ```
/// let mistake = drape_input::unknown_word("newtn", &["newton", "bdf2"]);
/// assert_eq!(mistake.message, "there is no \"newtn\"");
/// assert_eq!(mistake.help, "did you mean \"newton\"?");
/// ```
#[must_use]
pub fn unknown_word(word: &str, known: &[&str]) -> ValueError {
    let near = closest(word, known.iter().copied());
    let help = match near {
        Some(near) => format!("did you mean \"{near}\"?"),
        None => one_of_words(known),
    };
    let message = format!("there is no \"{}\"", excerpt(word));
    ValueError { message, help, intended_value: near.map(str::to_owned) }
}

/// Returns the words `known` as a phrase, such as `one of "a", "b"`.
pub(crate) fn one_of_words(known: &[&str]) -> String {
    let quoted: Vec<String> = known.iter().map(|word| format!("\"{word}\"")).collect();
    format!("one of {}", quoted.join(", "))
}

#[cfg(test)]
mod tests {
    use super::closest;

    #[test]
    fn a_slip_of_the_pen_finds_the_word_and_a_different_word_does_not() {
        let known = ["density", "thickness", "warp", "weft"];
        assert_eq!(closest("densty", known), Some("density"));
        assert_eq!(closest("Weft", known), Some("weft"));
        assert_eq!(closest("wrap", ["warp", "weft"]), Some("warp"), "neighbours swapped");
        assert_eq!(closest("gravity", known), None);
    }
}
