//! Plain words: what a machine can find of them. `.ci/words` measures the rest.

use crate::tokens::tokens;

/// Names that say nothing of what they name: the noun that is meant stands in their place.
const EMPTY_NAMES: [&str; 1] = ["own"];

/// Phrases that stand for a noun that should be repeated.
const PHRASES: [&str; 4] = ["that of", "those of", "so many", "from which on"];

/// Longest line of a comment, in letters. Formulas, tables and addresses cannot be broken.
const COMMENT_MAX: usize = 100;

/// Returns what is not plain in the source `text`, each with its line.
pub fn faults(text: &str) -> Vec<String> {
    let source = text.split("#[cfg(test)]").next().unwrap_or_default();
    let mut faults = Vec::new();
    let mut is_code = false;
    for (number, line) in source.lines().enumerate() {
        let comment = line.trim_start();
        let text = comment.trim_start_matches(['/', '!', ' ']);
        is_code = comment.starts_with("//") && (is_code != text.starts_with("```"));
        if !comment.starts_with("//") {
            continue;
        }

        let words = format!(" {text} ");
        for phrase in PHRASES.iter().filter(|phrase| words.contains(&format!(" {phrase} "))) {
            faults.push(format!("line {}: \"{phrase}\"", number + 1));
        }
        let can_break = !is_code && !line.contains("](") && !line.contains("http");
        let is_row = text.starts_with('|');
        if can_break && !is_row && line.chars().count() > COMMENT_MAX {
            faults.push(format!("line {}: a comment over {COMMENT_MAX} letters", number + 1));
        }
    }
    let names = tokens(source).into_iter().filter(|token| EMPTY_NAMES.contains(&token.as_str()));
    faults.extend(names.map(|name| format!("the name `{name}`")));
    faults
}
