//! Axes of a study as its page shows them.

use std::collections::BTreeSet;

use drape::sweep::{AxisKind, Column};

/// Most levels of an axis that has means and pairs; a sample has others at each point.
const LEVELS_MAX: usize = 12;

/// Axis of a study as the page shows it.
pub(super) struct ShownAxis<'a> {
    pub(super) column: &'a Column,
    /// Short names of its levels, if it is no axis of numbers.
    pub(super) names: Vec<String>,
    /// Its levels, each once, in the order of the plan.
    levels: Vec<String>,
    /// Whether it has plots: its levels differ, and mean something.
    pub(super) is_shown: bool,
    pub(super) has_means: bool,
}

impl<'a> ShownAxis<'a> {
    pub(super) fn new(column: &'a Column, kind: AxisKind) -> Self {
        let mut known = BTreeSet::new();
        let levels: Vec<String> =
            column.cells.iter().filter(|cell| known.insert(*cell)).cloned().collect();
        let is_number = column.numbers().iter().all(Option::is_some);
        let names = if is_number { Vec::new() } else { short_names(&levels) };
        let is_shown = matches!(kind, AxisKind::Levels | AxisKind::Sample) && levels.len() > 1;
        let has_means = kind == AxisKind::Levels && (2..=LEVELS_MAX).contains(&levels.len());
        Self { column, names, levels, is_shown, has_means }
    }

    /// Returns the place of a level on the axis of a plot.
    pub(super) fn place(&self, level: &str) -> Option<f64> {
        if self.names.is_empty() {
            return level.parse().ok();
        }
        self.levels.iter().position(|own| own == level).map(|index| 1.0 + index as f64)
    }

    /// Returns the level as the page names it.
    pub(super) fn name(&self, level: &str) -> String {
        let index = self.levels.iter().position(|own| own == level);
        index.and_then(|index| self.names.get(index)).map_or_else(|| level.to_owned(), Clone::clone)
    }
}

/// Returns the parts of texts in which they differ, such as the folder of `fabrics/NAME/sheet.toml`.
fn short_names(levels: &[String]) -> Vec<String> {
    let parts: Vec<Vec<&str>> = levels.iter().map(|level| level.split('/').collect()).collect();
    let Some(first) = parts.first() else { return Vec::new() };
    let same = |index: usize, from_end: bool| {
        parts.iter().all(|own| {
            let at = |parts: &[&'_ str]| -> Option<String> {
                let index = if from_end { parts.len().checked_sub(index + 1)? } else { index };
                parts.get(index).map(|part| (*part).to_owned())
            };
            own.len() > index + 1 && at(own) == at(first)
        })
    };
    let begin = (0..first.len()).take_while(|&index| same(index, false)).count();
    let end = (0..first.len()).take_while(|&index| same(index, true)).count();
    let name = |own: &Vec<&str>| match own.get(begin..own.len().saturating_sub(end)) {
        Some(part) if !part.is_empty() => part.join("/"),
        _ => own.join("/"),
    };
    parts.iter().map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::short_names;

    #[test]
    fn files_are_named_by_what_differs() {
        let names = |levels: &[&str]| {
            short_names(&levels.iter().map(|level| (*level).to_owned()).collect::<Vec<_>>())
        };
        assert_eq!(names(&["../f/wool/sheet.toml", "../f/cupro/sheet.toml"]), ["wool", "cupro"]);
        assert_eq!(names(&["a.toml", "b.toml"]), ["a.toml", "b.toml"]);
        assert_eq!(names(&["kes", "breen-1994"]), ["kes", "breen-1994"]);
        // One alone differs from none, and keeps its whole name.
        assert_eq!(names(&["a/b"]), ["a/b"]);
    }
}
