//! Page of a study: main effects and interactions of its axes on the measures of its runs.

mod axis;
pub(crate) mod converge;
mod digits;
mod unit;

use drape::report::plot::{Axis, GraphPlot, GraphSeries, Look};
use drape::report::{EffectTable, Error, MeasureEffects, StudyPage};
use drape::run::reports::VERSION;
use drape::sweep::{Column, Study, Table, interaction, main_effect};

use self::axis::ShownAxis;
use self::digits::with_scatter;
use self::unit::ShownMeasure;

/// Only this number of axes have tables of their pairs.
const PAIRED_MAX: usize = 6;

/// Beginnings of the names of values that describe the solver or the machine and not the cloth.
const SOLVER_VALUES: [&str; 8] = [
    "wall_seconds",
    "cpu_seconds",
    "threads",
    "solver.",
    "steps",
    "frames",
    "contact.grown",
    "energy.remainder",
];

/// Returns the HTML page of `study`. `table` has a row for each run. Without a list of measures in
/// the study, the page shows every value of the cloth that differs between runs.
pub(crate) fn page(study: &Study, table: &Table) -> Result<String, Error> {
    let inputs = table.inputs.iter().zip(study.axes());
    let axes: Vec<ShownAxis<'_>> =
        inputs.map(|(column, axis)| ShownAxis::new(column, axis.kind)).collect();
    let is_named = !study.measures().is_empty();
    let measures = table.measures.iter().filter(|measure| {
        let is_of_solver = SOLVER_VALUES.iter().any(|name| measure.name.starts_with(name));
        let numbers: Vec<f64> = measure.numbers().into_iter().flatten().collect();
        is_named || (!is_of_solver && numbers.windows(2).any(|pair| pair[0] != pair[1]))
    });

    let outcomes = &table.records[0].cells;
    let ok = outcomes.iter().filter(|outcome| *outcome == "ok").count();
    let facts = vec![
        format!("{ok} of {} points ended well", outcomes.len()),
        "± is the standard deviation of the runs of a level, or of a pair of levels".into(),
        format!(
            "study {}, {} {}",
            study.file().display(),
            study.base().key(),
            study.base_file().display()
        ),
    ];

    let failures = failures(table, |row| {
        let values = axes
            .iter()
            .map(|axis| format!("{} {}", axis.column.name, axis.name(&axis.column.cells[row])));
        values.collect::<Vec<_>>().join(", ")
    });
    let page = StudyPage {
        version: VERSION.into(),
        title: study.file().file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        facts,
        failures,
        measures: measures.map(|measure| effects(&axes, &ShownMeasure::new(measure))).collect(),
    };
    page.to_html()
}

/// Returns the input values and the message of each run that failed. `values` names the input
/// values of a row.
fn failures(table: &Table, values: impl Fn(usize) -> String) -> Vec<[String; 2]> {
    let outcomes = table.records[0].cells.iter().enumerate();
    let failed = outcomes.filter(|(_, outcome)| !matches!(&outcome[..], "ok" | "not run"));
    let messages = table.records.last().map(|column| &column.cells);
    failed
        .map(|(row, outcome)| {
            let message = messages.map_or("", |cells| cells[row].as_str());
            [values(row), format!("{outcome}: {message}").replace('\n', " ")]
        })
        .collect()
}

/// Returns the effects of `axes` on `measure`.
fn effects(axes: &[ShownAxis<'_>], measure: &ShownMeasure) -> MeasureEffects {
    let plots = axes.iter().filter_map(|axis| plot(axis, measure)).collect();
    let with_means: Vec<&ShownAxis<'_>> = axes.iter().filter(|axis| axis.has_means).collect();
    let mut tables: Vec<EffectTable> = with_means.iter().map(|axis| means(axis, measure)).collect();
    let paired = &with_means[..with_means.len().min(PAIRED_MAX)];
    for (index, first) in paired.iter().enumerate() {
        let following = paired[index + 1..].iter();
        tables.extend(following.map(|second| pairs([first, second], &measure.column)));
    }
    MeasureEffects { name: measure.title(), plots, tables }
}

/// Returns the plot of `measure` over `axis`: a point for each run, and the means, which are joined
/// by lines if the levels are numbers.
fn plot(axis: &ShownAxis<'_>, measure: &ShownMeasure) -> Option<GraphPlot> {
    if !axis.is_shown {
        return None;
    }
    let cells = axis.column.cells.iter().zip(measure.column.numbers());
    let points = cells.filter_map(|(level, value)| Some([axis.position(level)?, value?])).collect();
    let mut series = vec![GraphSeries { label: "run".into(), look: Look::Dots, points }];
    if axis.has_means {
        let effect = main_effect(axis.column, &measure.column);
        let means = effect.levels.iter().zip(&effect.means);
        let mut points: Vec<[f64; 2]> = means
            .filter_map(|(level, mean)| Some([axis.position(level)?, (*mean)?.value]))
            .collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let look = if axis.names.is_empty() { Look::Line } else { Look::Marks };
        series.push(GraphSeries { label: "mean".into(), look, points });
    }

    series.retain(|series| !series.points.is_empty());
    let (label, unit) = unit::split_unit(&axis.column.name);
    (!series.is_empty()).then(|| GraphPlot {
        title: format!("{} over {label}", measure.label),
        axes: [Axis::new(label, unit, 1.0), Axis::new(&measure.label, &measure.unit, 1.0)],
        categories: axis.names.clone(),
        logarithmic: [false, false],
        to_scale: false,
        series,
    })
}

/// Returns the table of the means of `measure` over `axis`.
fn means(axis: &ShownAxis<'_>, measure: &ShownMeasure) -> EffectTable {
    let effect = main_effect(axis.column, &measure.column);
    let rows = effect.levels.iter().zip(&effect.means).map(|(level, mean)| {
        let count = mean.map_or(0, |mean| mean.count);
        vec![axis.name(level), with_scatter(*mean), count.to_string()]
    });
    EffectTable {
        caption: format!("Means over {}", axis.column.name),
        heads: [axis.column.name.as_str(), "mean", "points"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

/// Returns the table of the means of `measure` over pairs of levels of two `axes`.
fn pairs(axes: [&ShownAxis<'_>; 2], measure: &Column) -> EffectTable {
    let interaction = interaction(axes.map(|axis| axis.column), measure);
    let [first, second] = axes.map(|axis| &axis.column.name);
    let heads = interaction.columns.iter().map(|level| format!("{second} {}", axes[1].name(level)));
    let rows = interaction.rows.iter().zip(&interaction.means).map(|(level, means)| {
        let cells = means.iter().map(|mean| with_scatter(*mean));
        std::iter::once(axes[0].name(level)).chain(cells).collect()
    });
    EffectTable {
        caption: format!("Means over {first} and {second}"),
        heads: std::iter::once(first.clone()).chain(heads).collect(),
        rows: rows.collect(),
    }
}
