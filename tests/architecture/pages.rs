//! Pages about the crates: tags of sources, and paths that a page names.

use std::collections::BTreeSet;

/// Returns the tags of sources in brackets, such as `[BHW94, eq. 5.5]`, in the comments of a source
/// file or in a page.
pub fn tags(text: &str, is_code: bool) -> BTreeSet<String> {
    let comments = |line: &&str| !is_code || line.contains("//");
    let lines = text.lines().filter(comments);
    let groups = lines.flat_map(|line| line.split('[').skip(1));
    let groups = groups.filter_map(|rest| rest.split_once(']').map(|(group, _)| group));
    let words = groups.flat_map(|group| group.split([' ', ',', ';', '\\']));
    words.filter(|word| is_tag(word)).map(str::to_owned).collect()
}

/// Returns whether a word is a tag: letters, the first a capital, then digits.
fn is_tag(word: &str) -> bool {
    let digits = word.trim_start_matches(|c: char| c.is_ascii_alphabetic());
    let letters = word.len() - digits.len();
    word.starts_with(|c: char| c.is_ascii_uppercase())
        && letters >= 2
        && digits.len() >= 2
        && digits.bytes().all(|byte| byte.is_ascii_digit())
}

/// Returns the cells of the rows of all tables of a page, without their heads.
pub fn rows(page: &str) -> Vec<Vec<&str>> {
    let lines: Vec<&str> = page.lines().collect();
    let is_head = |i: usize| lines.get(i + 1).is_some_and(|next| next.starts_with("|---"));
    let is_row = |i: usize| lines[i].starts_with("| ") && !is_head(i);
    (0..lines.len())
        .filter(|&i| is_row(i))
        .map(|i| lines[i].trim_matches('|').split('|').map(str::trim).collect())
        .collect()
}

/// Returns the paths of files and folders of crates that a page names.
pub fn paths(page: &str) -> Vec<&str> {
    let code = page.split('`').skip(1).step_by(2);
    code.filter(|code| code.starts_with("drape") && code.contains('/')).collect()
}
