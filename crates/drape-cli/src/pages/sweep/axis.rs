//! Axes of a study in the form in which its page shows them.

use std::collections::BTreeSet;

use drape::sweep::{AxisKind, Column};

/// An axis with more levels has no table of means. A sampled axis has another level at each point.
const LEVELS_MAX: usize = 12;

/// Axis of a study, prepared for the page.
pub(super) struct ShownAxis<'a> {
    pub(super) column: &'a Column,
    /// Short names of the levels. The list is empty if all levels are numbers.
    pub(super) names: Vec<String>,
    /// The different levels, in the order of the plan.
    levels: Vec<String>,
    /// Whether the axis has plots: it has several levels that mean something to the reader.
    pub(super) is_shown: bool,
    pub(super) has_means: bool,
}

impl<'a> ShownAxis<'a> {
    /// Prepares the axis of `kind` whose cells stand in `column`.
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

    /// Returns the coordinate of `level` on the axis of a plot.
    pub(super) fn position(&self, level: &str) -> Option<f64> {
        if self.names.is_empty() {
            return level.parse().ok();
        }
        self.levels.iter().position(|known| known == level).map(|index| 1.0 + index as f64)
    }

    /// Returns the name of `level` on the page.
    pub(super) fn name(&self, level: &str) -> String {
        let index = self.levels.iter().position(|known| known == level);
        index.and_then(|index| self.names.get(index)).map_or_else(|| level.to_owned(), Clone::clone)
    }
}

/// Returns the parts in which the paths `levels` differ, such as `NAME` of
/// `fabrics/NAME/sheet.toml`.
fn short_names(levels: &[String]) -> Vec<String> {
    let parts: Vec<Vec<&str>> = levels.iter().map(|level| level.split('/').collect()).collect();
    let Some(first) = parts.first() else { return Vec::new() };

    // At least one part of each level remains after the common parts are removed.
    let begin = (0..first.len())
        .take_while(|&index| {
            parts
                .iter()
                .all(|level| level.len() > index + 1 && level.get(index) == first.get(index))
        })
        .count();
    let end = (0..first.len())
        .take_while(|&index| {
            parts.iter().all(|level| {
                level.len() > index + 1
                    && level.iter().nth_back(index) == first.iter().nth_back(index)
            })
        })
        .count();

    parts
        .iter()
        .map(|level| match level.get(begin..level.len().saturating_sub(end)) {
            Some(different) if !different.is_empty() => different.join("/"),
            _ => level.join("/"),
        })
        .collect()
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
        // A single level keeps its whole name.
        assert_eq!(names(&["a/b"]), ["a/b"]);
    }
}
