//! Page of one scene on several grids: each measure over the spacing, with its limit.

use drape::report::plot::{Axis, GraphPlot, GraphSeries, Look};
use drape::report::{EffectTable, Error, MeasureEffects, StudyPage};
use drape::run::reports::VERSION;
use drape::sweep::{Approach, Column, Convergence, GRID_ORDER, GridValue, Mean, Study, Table};
use serde::Serialize;

use super::digits::{like_scatter, number, with_scatter};
use super::failures;
use super::unit::ShownMeasure;

/// Beginnings of the names of the values that the grid changes and that mean something at its limit.
const MEASURES: [&str; 4] = ["measures.", "strain.", "energy.elastic", "energy.gravity"];

/// Number of parts of the curve of a plot.
const PARTS: usize = 60;

/// Measures of one scene on several grids, in SI.
#[derive(Serialize)]
pub(crate) struct Converged {
    /// Runs that came to their end, coarsest first.
    pub(crate) spacings: Vec<Grid>,
    /// Measures that two runs or more have, with values that differ.
    pub(crate) measures: Vec<ConvergedMeasure>,
}

/// Run on one grid.
#[derive(Serialize)]
pub(crate) struct Grid {
    /// Spacing, in m.
    spacing: f64,
    particles: Option<f64>,
    /// Wall time, in s.
    seconds: Option<f64>,
}

/// Measure on several grids.
#[derive(Serialize)]
pub(crate) struct ConvergedMeasure {
    /// Key in the summary.
    pub(crate) key: String,
    /// Value on each grid; `None` where the summary has none.
    values: Vec<Option<f64>>,
    /// Value at a spacing of 0, if they approach one.
    limit: Option<f64>,
    /// Uncertainty of the value on the finest grid.
    uncertainty: f64,
    /// Order that three grids give.
    order: Option<f64>,
    #[serde(skip)]
    shown: Shown,
}

/// Measure as it is shown, in its own unit.
struct Shown {
    label: String,
    unit: String,
    values: Vec<GridValue>,
    convergence: Convergence,
}

impl Converged {
    /// Returns the convergence of the measures of a table, whose rows have these spacings, in m: of those
    /// that are usual, and of those that are named.
    pub(crate) fn of(table: &Table, spacings: &[f64], named: &[String]) -> Self {
        let outcomes = table.records[0].cells.iter().enumerate();
        let rows: Vec<usize> =
            outcomes.filter(|(_, outcome)| *outcome == "ok").map(|(row, _)| row).collect();
        let of_table = |name: &str| table.columns().find(|own| own.name == name);
        let numbers = |name: &str| of_table(name).map(Column::numbers).unwrap_or_default();
        let [particles, seconds] = ["particles", "wall_seconds"].map(numbers);
        let at = |numbers: &[Option<f64>], row: usize| numbers.get(row).copied().flatten();
        let grids = rows.iter().map(|&row| Grid {
            spacing: spacings[row],
            particles: at(&particles, row),
            seconds: at(&seconds, row),
        });
        let is_usual = |name: &str| MEASURES.iter().any(|begin| name.starts_with(begin));
        let chosen = table.measures.iter();
        let chosen = chosen.filter(|own| is_usual(&own.name) || named.contains(&own.name));
        let of = |column: &Column| -> Vec<Option<GridValue>> {
            let numbers = column.numbers();
            let value =
                |&row: &usize| Some(GridValue { spacing: spacings[row], value: numbers[row]? });
            rows.iter().map(value).collect()
        };
        let measures = chosen.filter_map(|column| {
            let values: Vec<Option<GridValue>> = of(column);
            let found: Vec<GridValue> = values.iter().copied().flatten().collect();
            let differ = found.windows(2).any(|pair| pair[0].value != pair[1].value);
            if !differ && !named.contains(&column.name) {
                return None;
            }
            let convergence = Convergence::new(&found)?;
            let shown = ShownMeasure::new(column);
            let in_unit: Vec<GridValue> = of(&shown.column).into_iter().flatten().collect();
            let order = match convergence.approach {
                Approach::Measured(order) => Some(order),
                Approach::Assumed | Approach::None => None,
            };
            Some(ConvergedMeasure {
                key: column.name.clone(),
                values: values.iter().map(|own| own.map(|own| own.value)).collect(),
                limit: (convergence.approach != Approach::None).then_some(convergence.limit),
                uncertainty: convergence.uncertainty,
                order,
                shown: Shown {
                    convergence: Convergence::new(&in_unit)?,
                    label: shown.label,
                    unit: shown.unit,
                    values: in_unit,
                },
            })
        });
        Self { measures: measures.collect(), spacings: grids.collect() }
    }
}

impl ConvergedMeasure {
    /// Returns a line for the terminal.
    pub(crate) fn line(&self) -> String {
        let values: Vec<String> = self.shown.values.iter().map(|own| number(own.value)).collect();
        format!("{}: {}; {}", self.title(), values.join(", "), self.shown.verdict())
    }

    fn title(&self) -> String {
        match self.shown.unit.as_str() {
            "" => self.shown.label.clone(),
            unit => format!("{}, {unit}", self.shown.label),
        }
    }
}

impl Shown {
    /// Returns the value on the finest grid with its uncertainty.
    fn finest(&self) -> String {
        let value = self.values.last().map_or(f64::NAN, |own| own.value);
        let deviation = Some(self.convergence.uncertainty);
        with_scatter(Some(Mean { value, deviation, count: self.values.len() }))
    }

    /// Returns the limit, if there is one.
    fn limit(&self) -> String {
        match self.convergence.approach {
            Approach::None => "–".into(),
            _ => like_scatter(self.convergence.limit, self.convergence.uncertainty),
        }
    }

    fn order(&self) -> String {
        match self.convergence.approach {
            Approach::Measured(order) if order < GRID_ORDER => format!("{order:.2}"),
            Approach::Measured(_) => format!("{GRID_ORDER} or more"),
            Approach::Assumed => format!("{GRID_ORDER}, assumed"),
            Approach::None => "none".into(),
        }
    }

    fn verdict(&self) -> String {
        match self.convergence.approach {
            Approach::None => format!("they approach no limit; the finest is {}", self.finest()),
            _ => format!(
                "limit {}, the finest is {}, order {}",
                self.limit(),
                self.finest(),
                self.order()
            ),
        }
    }
}

/// Returns the page of a scene on several grids.
pub(crate) fn page(study: &Study, table: &Table, converged: &Converged) -> Result<String, Error> {
    let name = study.base_file().file_stem().unwrap_or_default().to_string_lossy();
    let grids = &converged.spacings;
    let facts = vec![
        format!("{} of {} runs ended well", grids.len(), table.records[0].cells.len()),
        format!(
            "the error of a value is taken as C hᵖ, h being the spacing; the order p comes of the three \
             finest grids and is at most {GRID_ORDER}, which is also that of two grids"
        ),
        "± is the uncertainty of the value on the finest grid: 1.25 times its error, 3 times with the \
         order of two grids, 3 times the range of the values where they approach no limit"
            .into(),
        format!("scene {}", study.base_file().display()),
    ];
    let overview = MeasureEffects {
        name: "All measures".into(),
        plots: Vec::new(),
        tables: vec![runs(grids), limits(&converged.measures)],
    };
    let measures = converged.measures.iter().map(|measure| MeasureEffects {
        name: measure.title(),
        plots: vec![plot(&measure.shown)],
        tables: Vec::new(),
    });
    StudyPage {
        version: VERSION.into(),
        title: format!("{name}: convergence with the spacing"),
        facts,
        failures: failures(table, |row| table.inputs[0].cells[row].clone()),
        measures: std::iter::once(overview).chain(measures).collect(),
    }
    .to_html()
}

/// Returns the table of the runs.
fn runs(grids: &[Grid]) -> EffectTable {
    let cell = |value: Option<f64>| value.map_or("–".into(), number);
    let rows = grids
        .iter()
        .map(|grid| vec![number(1e3 * grid.spacing), cell(grid.particles), cell(grid.seconds)]);
    EffectTable {
        caption: "Runs that ended well".into(),
        heads: ["spacing, mm", "particles", "wall time, s"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

/// Returns the table of the limits of all measures.
fn limits(measures: &[ConvergedMeasure]) -> EffectTable {
    let rows = measures.iter().map(|measure| {
        let shown = &measure.shown;
        vec![measure.title(), shown.finest(), shown.limit(), shown.order()]
    });
    EffectTable {
        caption: "Limits at a spacing of 0".into(),
        heads: ["measure", "finest grid", "limit", "order"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

/// Returns the plot of a measure over the spacing.
fn plot(shown: &Shown) -> GraphPlot {
    let points = shown.values.iter().map(|own| [own.spacing, own.value]).collect();
    let mut series = vec![GraphSeries { label: "run".into(), look: Look::Dots, points }];
    if shown.convergence.approach != Approach::None {
        let coarsest = shown.values.first().map_or(0.0, |own| own.spacing);
        let spacing = |part| coarsest * part as f64 / PARTS as f64;
        let points = (0..=PARTS).map(|part| [spacing(part), shown.convergence.at(spacing(part))]);
        let label = "extrapolated to 0".into();
        series.push(GraphSeries { label, look: Look::Line, points: points.collect() });
    }
    GraphPlot {
        title: format!("{} over the spacing", shown.label),
        axes: [Axis::new("spacing", "mm", 1e-3), Axis::new(&shown.label, &shown.unit, 1.0)],
        categories: Vec::new(),
        logarithmic: [false, false],
        to_scale: false,
        series,
    }
}
