//! Page of a study: main effects and interactions of its axes on the measures of its runs.

use std::collections::BTreeSet;

use drape::report::plot::{Axis, GraphPlot, GraphSeries, Look};
use drape::report::{EffectTable, Error, MeasureEffects, StudyPage};
use drape::sweep::{Column, Study, Table, interaction, main_effect};

use drape::reports::VERSION;

/// Most levels of an axis that has means and pairs; a sample has others at each point.
const LEVELS_MAX: usize = 12;

/// Most axes whose pairs have tables.
const PAIRED_MAX: usize = 6;

/// Beginnings of the names of values that are no measures of cloth.
const OTHERS: [&str; 8] = [
    "wall_seconds",
    "cpu_seconds",
    "threads",
    "solver.",
    "steps",
    "frames",
    "contact.grown",
    "energy.remainder",
];

/// Axis of a study as the page shows it.
struct Shown<'a> {
    column: &'a Column,
    /// Short names of its levels, if it is no axis of numbers.
    names: Vec<String>,
    /// Its levels, each once, in the order of the plan.
    levels: Vec<String>,
    has_means: bool,
}

impl<'a> Shown<'a> {
    fn new(column: &'a Column, is_sample: bool) -> Self {
        let mut known = BTreeSet::new();
        let levels: Vec<String> =
            column.cells.iter().filter(|cell| known.insert(*cell)).cloned().collect();
        let is_number = column.numbers().iter().all(Option::is_some);
        let names = if is_number { Vec::new() } else { short_names(&levels) };
        let has_means = !is_sample && (2..=LEVELS_MAX).contains(&levels.len());
        Self { column, names, levels, has_means }
    }

    /// Returns the place of a level on the axis of a plot.
    fn place(&self, level: &str) -> Option<f64> {
        if self.names.is_empty() {
            return level.parse().ok();
        }
        self.levels.iter().position(|own| own == level).map(|index| 1.0 + index as f64)
    }

    /// Returns the level as the page names it.
    fn name(&self, level: &str) -> String {
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

/// Returns the page of a study.
pub(crate) fn page(study: &Study, table: &Table) -> Result<String, Error> {
    let samples = study.axes().map(|axis| axis.is_sample);
    let axes = table.inputs.iter().zip(samples).map(|(column, sample)| Shown::new(column, sample));
    let axes: Vec<Shown<'_>> = axes.collect();
    let measures = table.measures.iter().filter(|measure| {
        let is_other = OTHERS.iter().any(|other| measure.name.starts_with(other));
        let numbers: Vec<f64> = measure.numbers().into_iter().flatten().collect();
        !is_other && numbers.windows(2).any(|pair| pair[0] != pair[1])
    });
    let outcomes = &table.records[0].cells;
    let ok = outcomes.iter().filter(|outcome| *outcome == "ok").count();
    let facts = vec![
        format!("{ok} of {} points ended well", outcomes.len()),
        format!("study {}, scene {}", study.file().display(), study.scene().display()),
    ];
    let failures = outcomes.iter().enumerate();
    let failures = failures.filter(|(_, outcome)| !matches!(&outcome[..], "ok" | "not run"));
    let message = table.records.last().map(|column| &column.cells);
    let failures = failures.map(|(row, outcome)| {
        let values = axes
            .iter()
            .map(|axis| format!("{} {}", axis.column.name, axis.name(&axis.column.cells[row])));
        let message = message.map_or("", |cells| cells[row].as_str());
        [values.collect::<Vec<_>>().join(", "), format!("{outcome}: {message}").replace('\n', " ")]
    });
    let page = StudyPage {
        version: VERSION.into(),
        title: study.file().file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        facts,
        failures: failures.collect(),
        measures: measures.map(|measure| effects(&axes, measure)).collect(),
    };
    page.to_html()
}

/// Returns the effects of the axes on a measure.
fn effects(axes: &[Shown<'_>], measure: &Column) -> MeasureEffects {
    let plots = axes.iter().filter_map(|axis| plot(axis, measure)).collect();
    let with_means = || axes.iter().filter(|axis| axis.has_means);
    let mut tables: Vec<EffectTable> = with_means().map(|axis| means(axis, measure)).collect();
    let paired: Vec<&Shown<'_>> = with_means().take(PAIRED_MAX).collect();
    for (index, first) in paired.iter().enumerate() {
        let rest = paired[index + 1..].iter();
        tables.extend(rest.map(|second| pairs([first, second], measure)));
    }
    MeasureEffects { name: measure.name.clone(), plots, tables }
}

/// Returns the plot of a measure over an axis: each point, and the means.
fn plot(axis: &Shown<'_>, measure: &Column) -> Option<GraphPlot> {
    let cells = axis.column.cells.iter().zip(measure.numbers());
    let points = cells.filter_map(|(level, value)| Some([axis.place(level)?, value?])).collect();
    let mut series = vec![GraphSeries { label: "run".into(), look: Look::Dots, points }];
    if axis.has_means {
        let effect = main_effect(axis.column, measure);
        let means = effect.levels.iter().zip(&effect.means);
        let mut points: Vec<[f64; 2]> =
            means.filter_map(|(level, mean)| Some([axis.place(level)?, (*mean)?])).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        series.push(GraphSeries { label: "mean".into(), look: Look::Line, points });
    }
    series.retain(|series| !series.points.is_empty());
    let name = axis.column.name.as_str();
    let label = if axis.names.is_empty() { name.to_owned() } else { format!("{name}, by number") };
    (!series.is_empty()).then(|| GraphPlot {
        title: format!("{} over {name}", measure.name),
        axes: [Axis::new(&label, "", 1.0), Axis::new(&measure.name, "", 1.0)],
        logarithmic: [false, false],
        to_scale: false,
        series,
    })
}

/// Returns the table of the means over an axis.
fn means(axis: &Shown<'_>, measure: &Column) -> EffectTable {
    let effect = main_effect(axis.column, measure);
    let rows = effect.levels.iter().zip(effect.means.iter().zip(&effect.counts));
    let rows = rows.enumerate().map(|(index, (level, (mean, count)))| {
        let number = if axis.names.is_empty() { String::new() } else { format!("{}: ", index + 1) };
        vec![number + &axis.name(level), cell(*mean), count.to_string()]
    });
    EffectTable {
        caption: format!("Means over {}", axis.column.name),
        heads: [axis.column.name.as_str(), "mean", "points"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

/// Returns the table of the means over pairs of levels of two axes.
fn pairs(axes: [&Shown<'_>; 2], measure: &Column) -> EffectTable {
    let found = interaction(axes.map(|axis| axis.column), measure);
    let [first, second] = axes.map(|axis| &axis.column.name);
    let heads = found.columns.iter().map(|level| format!("{second} {}", axes[1].name(level)));
    let rows = found.rows.iter().zip(&found.means).map(|(level, means)| {
        let cells = means.iter().map(|mean| cell(*mean));
        std::iter::once(axes[0].name(level)).chain(cells).collect()
    });
    EffectTable {
        caption: format!("Means over {first} and {second}"),
        heads: std::iter::once(first.clone()).chain(heads).collect(),
        rows: rows.collect(),
    }
}

/// Returns a mean as a cell.
fn cell(mean: Option<f64>) -> String {
    mean.map_or("–".into(), drape::input::figure)
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
