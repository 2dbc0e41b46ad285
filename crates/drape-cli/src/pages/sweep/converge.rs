//! Page of one scene on several grids: each measure over the spacing, with its extrapolated limit.

use drape::report::plot::{Axis, GraphPlot, GraphSeries, Look};
use drape::report::{EffectTable, Error, MeasureEffects, StudyPage};
use drape::run::reports::VERSION;
use drape::sweep::{Approach, Column, Convergence, GRID_ORDER, GridValue, Mean, Study, Table};
use serde::Serialize;

use super::digits::{like_scatter, number, with_scatter};
use super::failures;
use super::unit::ShownMeasure;

/// Beginnings of the names of the values that depend on the grid and have a meaningful limit.
const MEASURES: [&str; 4] = ["measures.", "strain.", "energy.elastic", "energy.gravity"];

/// Number of line segments of an extrapolated curve.
const SEGMENTS: usize = 60;

/// Measures of one scene on several grids, in SI.
#[derive(Serialize)]
pub(crate) struct Converged {
    /// Runs that came to their end, from the coarsest to the finest grid.
    pub(crate) spacings: Vec<Grid>,
    /// Measures with values that differ between at least two runs.
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
    /// Value at a spacing of 0, if the values approach one.
    limit: Option<f64>,
    /// Uncertainty of the value on the finest grid.
    uncertainty: f64,
    /// Order of convergence that three grids give.
    order: Option<f64>,
    #[serde(skip)]
    shown: MeasureInUnit,
}

/// Measure in the unit in which it is shown.
struct MeasureInUnit {
    label: String,
    unit: String,
    values: Vec<GridValue>,
    convergence: Convergence,
}

impl Converged {
    /// Returns the convergence of the measures of `table`. `spacings` has the spacing of each row,
    /// in m. The usual measures and the measures in `named` are taken.
    pub(crate) fn new(table: &Table, spacings: &[f64], named: &[String]) -> Self {
        let outcomes = table.records[0].cells.iter().enumerate();
        let rows: Vec<usize> =
            outcomes.filter(|(_, outcome)| *outcome == "ok").map(|(row, _)| row).collect();

        let [particles, seconds] = ["particles", "wall_seconds"].map(|name| {
            let column = table.columns().find(|column| column.name == name);
            column.map(Column::numbers).unwrap_or_default()
        });
        let grids = rows.iter().map(|&row| Grid {
            spacing: spacings[row],
            particles: particles.get(row).copied().flatten(),
            seconds: seconds.get(row).copied().flatten(),
        });

        let chosen = table.measures.iter().filter(|column| {
            MEASURES.iter().any(|begin| column.name.starts_with(begin))
                || named.contains(&column.name)
        });
        let measures = chosen.filter_map(|column| {
            let values = grid_values(column, &rows, spacings);
            let known: Vec<GridValue> = values.iter().copied().flatten().collect();
            let differ = known.windows(2).any(|pair| pair[0].value != pair[1].value);
            if !differ && !named.contains(&column.name) {
                return None;
            }

            let convergence = Convergence::new(&known)?;
            let shown = ShownMeasure::new(column);
            let in_unit: Vec<GridValue> =
                grid_values(&shown.column, &rows, spacings).into_iter().flatten().collect();
            let order = match convergence.approach {
                Approach::Measured(order) => Some(order),
                Approach::Assumed | Approach::None => None,
            };
            Some(ConvergedMeasure {
                key: column.name.clone(),
                values: values.iter().map(|grid| grid.map(|grid| grid.value)).collect(),
                limit: (convergence.approach != Approach::None).then_some(convergence.limit),
                uncertainty: convergence.uncertainty,
                order,
                shown: MeasureInUnit {
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

/// Returns the numbers of `column` in `rows`, each with the spacing of its row.
fn grid_values(column: &Column, rows: &[usize], spacings: &[f64]) -> Vec<Option<GridValue>> {
    let numbers = column.numbers();
    let rows = rows.iter();
    rows.map(|&row| Some(GridValue { spacing: spacings[row], value: numbers[row]? })).collect()
}

impl ConvergedMeasure {
    /// Returns the values and the `verdict` as a line for the terminal.
    pub(crate) fn line(&self) -> String {
        let values = self.shown.values.iter();
        let values: Vec<String> = values.map(|grid| number(grid.value)).collect();
        format!("{}: {}; {}", self.title(), values.join(", "), self.shown.verdict())
    }

    /// Returns the label with its `unit`.
    fn title(&self) -> String {
        match self.shown.unit.as_str() {
            "" => self.shown.label.clone(),
            unit => format!("{}, {unit}", self.shown.label),
        }
    }
}

impl MeasureInUnit {
    /// Returns the value on the finest grid with its uncertainty, as `value ± uncertainty`.
    fn finest(&self) -> String {
        let value = self.values.last().map_or(f64::NAN, |grid| grid.value);
        let deviation = Some(self.convergence.uncertainty);
        with_scatter(Some(Mean { value, deviation, count: self.values.len() }))
    }

    /// Returns the limit with the digits of its uncertainty, or `–` if there is none.
    fn limit(&self) -> String {
        match self.convergence.approach {
            Approach::None => "–".into(),
            _ => like_scatter(self.convergence.limit, self.convergence.uncertainty),
        }
    }

    /// Returns the order of convergence in words.
    fn order(&self) -> String {
        match self.convergence.approach {
            Approach::Measured(order) if order < GRID_ORDER => format!("{order:.2}"),
            Approach::Measured(_) => format!("{GRID_ORDER} or more"),
            Approach::Assumed => format!("{GRID_ORDER}, assumed"),
            Approach::None => "none".into(),
        }
    }

    /// Returns limit, finest value and order as one phrase.
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

/// Returns the HTML page of a scene on several grids.
pub(crate) fn page(study: &Study, table: &Table, converged: &Converged) -> Result<String, Error> {
    let name = study.base_file().file_stem().unwrap_or_default().to_string_lossy();
    let grids = &converged.spacings;
    let facts = vec![
        format!("{} of {} runs ended well", grids.len(), table.records[0].cells.len()),
        format!(
            "the error of a value is taken as C hᵖ, h being the spacing; the order p comes of the three \
             finest grids and is at most {GRID_ORDER}; with two grids it is {GRID_ORDER}"
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

/// Returns the table of the runs on `grids`.
fn runs(grids: &[Grid]) -> EffectTable {
    let rows = grids.iter().map(|grid| {
        let [particles, seconds] =
            [grid.particles, grid.seconds].map(|value| value.map_or("–".into(), number));
        vec![number(1e3 * grid.spacing), particles, seconds]
    });
    EffectTable {
        caption: "Runs that ended well".into(),
        heads: ["spacing, mm", "particles", "wall time, s"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

/// Returns the table of the limits of all `measures`.
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

/// Returns the plot of a measure over the spacing, with the extrapolated curve if the values
/// converge.
fn plot(shown: &MeasureInUnit) -> GraphPlot {
    let points = shown.values.iter().map(|grid| [grid.spacing, grid.value]).collect();
    let mut series = vec![GraphSeries { label: "run".into(), look: Look::Dots, points }];
    if shown.convergence.approach != Approach::None {
        let coarsest = shown.values.first().map_or(0.0, |grid| grid.spacing);
        let points = (0..=SEGMENTS).map(|part| {
            let spacing = coarsest * part as f64 / SEGMENTS as f64;
            [spacing, shown.convergence.at(spacing)]
        });
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
