//! Search for the known word that is nearest to a misspelt word, for the remedies of messages.

/// Returns the word among `known` that is nearest to `word`, if it is near enough.
///
/// The distance is the number of letters to insert, delete, replace or swap with a neighbour. The
/// case of letters does not matter. A third of the letters may be wrong.
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
        .map(|candidate| (distance(&word.to_lowercase(), &candidate.to_lowercase()), candidate))
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Returns the Levenshtein distance of `a` and `b` with swaps of neighbours (optimal string
/// alignment).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    rows[0] = (0..=b.len()).collect();
    for i in 1..=a.len() {
        rows[i][0] = i;
        for j in 1..=b.len() {
            let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = replaced.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                least = least.min(rows[i - 2][j - 2] + 1);
            }
            rows[i][j] = least;
        }
    }
    rows[a.len()][b.len()]
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
