//! Effects: means of a measure over the levels of one axis, and over the pairs of levels of two
//! axes.

use crate::table::Column;

/// Mean of a measure over some points, and its scatter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// Mean of the measure.
    pub value: f64,
    /// Standard deviation over the points, or `None` if there is a single point.
    pub deviation: Option<f64>,
    /// Number of points that have the measure.
    pub count: usize,
}

impl Mean {
    /// Returns the mean of `numbers`, or `None` if there are none.
    fn new(numbers: &[f64]) -> Option<Self> {
        let count = numbers.len();
        let value = numbers.iter().sum::<f64>() / count as f64;
        let squares = numbers.iter().map(|number| (number - value).powi(2)).sum::<f64>();
        let deviation = (count > 1).then(|| (squares / (count - 1) as f64).sqrt());
        (count > 0).then_some(Self { value, deviation, count })
    }
}

/// Means of a measure over the levels of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct MainEffect {
    /// Levels, in the order of the plan.
    pub levels: Vec<String>,
    /// Mean of each level, or `None` if no point with this level has the measure.
    pub means: Vec<Option<Mean>>,
}

/// Means of a measure over the pairs of levels of two axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Interaction {
    /// Levels of the first axis, one for each row.
    pub rows: Vec<String>,
    /// Levels of the second axis.
    pub columns: Vec<String>,
    /// Mean of each pair of levels, or `None` if no point with this pair has the measure.
    pub means: Vec<Vec<Option<Mean>>>,
}

/// Returns the means of `measure` over the levels of `axis`.
#[must_use]
pub fn main_effect(axis: &Column, measure: &Column) -> MainEffect {
    let levels = levels(axis);
    let mut numbers = vec![Vec::new(); levels.len()];
    for (level, value) in axis.cells.iter().zip(measure.numbers()) {
        let index = levels.iter().position(|known| known == level);
        if let Some((index, value)) = index.zip(value) {
            numbers[index].push(value);
        }
    }
    MainEffect { levels, means: numbers.iter().map(|numbers| Mean::new(numbers)).collect() }
}

/// Returns the means of `measure` over the pairs of levels of two `axes`.
#[must_use]
pub fn interaction(axes: [&Column; 2], measure: &Column) -> Interaction {
    let [rows, columns] = axes.map(levels);
    let mut numbers = vec![vec![Vec::new(); columns.len()]; rows.len()];
    let pairs = axes[0].cells.iter().zip(&axes[1].cells);
    for ((row, column), value) in pairs.zip(measure.numbers()) {
        let i = rows.iter().position(|known| known == row);
        let j = columns.iter().position(|known| known == column);
        if let (Some(i), Some(j), Some(value)) = (i, j, value) {
            numbers[i][j].push(value);
        }
    }
    let means =
        numbers.iter().map(|row| row.iter().map(|numbers| Mean::new(numbers)).collect()).collect();
    Interaction { rows, columns, means }
}

/// Returns the levels of `axis`, each once, in the order of the plan.
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
        let mean = |value, deviation, count| Some(Mean { value, deviation, count });
        let [wool, cupro] = [mean(2.0, Some(2.0_f64.sqrt()), 2), mean(10.0, None, 1)];
        assert_eq!(main.means, [wool, cupro]);
        let both = interaction([&fabric, &size], &drop);
        assert_eq!(both.columns, ["1", "2"]);
        let expected = [[mean(1.0, None, 1), mean(3.0, None, 1)], [None, cupro]];
        assert_eq!(both.means, expected);
    }
}
