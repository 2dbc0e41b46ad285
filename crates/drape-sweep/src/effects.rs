//! Effects: means of a measure over the levels of one axis, and of two.

use crate::table::Column;

/// Means of a measure over the levels of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct MainEffect {
    /// Levels, in the order of the plan.
    pub levels: Vec<String>,
    /// Mean of each level; `None` where no point of it has the measure.
    pub means: Vec<Option<f64>>,
    /// Number of points of each level that have the measure.
    pub counts: Vec<usize>,
}

/// Means of a measure over the pairs of levels of two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Interaction {
    /// Levels of the first axis, one for each row.
    pub rows: Vec<String>,
    /// Levels of the second axis.
    pub columns: Vec<String>,
    /// Mean of each pair; `None` where no point of it has the measure.
    pub means: Vec<Vec<Option<f64>>>,
}

/// Mean of numbers that come one after the other.
#[derive(Debug, Clone, Copy, Default)]
struct Mean {
    sum: f64,
    count: usize,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1;
    }

    fn value(self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / self.count as f64)
    }
}

/// Returns the means of a measure over the levels of an axis.
#[must_use]
pub fn main_effect(axis: &Column, measure: &Column) -> MainEffect {
    let levels = levels(axis);
    let mut means = vec![Mean::default(); levels.len()];
    for (level, value) in axis.cells.iter().zip(measure.numbers()) {
        let place = levels.iter().position(|own| own == level);
        place.zip(value).into_iter().for_each(|(place, value)| means[place].add(value));
    }
    MainEffect {
        levels,
        means: means.iter().map(|mean| mean.value()).collect(),
        counts: means.iter().map(|mean| mean.count).collect(),
    }
}

/// Returns the means of a measure over the pairs of levels of two axes.
#[must_use]
pub fn interaction(axes: [&Column; 2], measure: &Column) -> Interaction {
    let [rows, columns] = axes.map(levels);
    let mut means = vec![vec![Mean::default(); columns.len()]; rows.len()];
    let pairs = axes[0].cells.iter().zip(&axes[1].cells);
    for ((row, column), value) in pairs.zip(measure.numbers()) {
        let place = rows.iter().position(|own| own == row);
        let place = place.zip(columns.iter().position(|own| own == column));
        place.zip(value).into_iter().for_each(|((i, j), value)| means[i][j].add(value));
    }
    let means = means.iter().map(|row| row.iter().map(|mean| mean.value()).collect()).collect();
    Interaction { rows, columns, means }
}

/// Returns the levels of an axis, each once.
fn levels(axis: &Column) -> Vec<String> {
    let mut levels: Vec<String> = Vec::new();
    for level in &axis.cells {
        if !levels.contains(level) {
            levels.push(level.clone());
        }
    }
    levels
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_those_of_the_points_that_have_the_measure() {
        let column = |name: &str, cells: &[&str]| Column {
            name: name.into(),
            cells: cells.iter().map(|cell| (*cell).to_owned()).collect(),
        };
        let fabric = column("fabric", &["wool", "wool", "cupro", "cupro"]);
        let size = column("size", &["1", "2", "1", "2"]);
        let drop = column("drop", &["1.0", "3.0", "", "10"]);
        let main = main_effect(&fabric, &drop);
        assert_eq!(main.levels, ["wool", "cupro"]);
        assert_eq!(main.means, [Some(2.0), Some(10.0)]);
        assert_eq!(main.counts, [2, 1]);
        let both = interaction([&fabric, &size], &drop);
        assert_eq!(both.columns, ["1", "2"]);
        assert_eq!(both.means, [[Some(1.0), Some(3.0)], [None, Some(10.0)]]);
    }
}
