//! Laws that no curve gives: the loop of each law along the test of its instrument, with marks at
//! the values of the sheet, and the assumptions of the law.

use drape_fit::{Fit, FitSettings};
use drape_kes::{BendingPoints, Curve, Direction, Sheet, Symbol, Test, Values};
use drape_report::plot::Mark;
use drape_report::{Interval, LawReport};

use super::fabric;
use super::quantity::DIRECTIONS;

/// Half width of the 95 % interval of a normal distribution, in standard deviations.
const NORMAL_95: f64 = 1.96;

/// Law of a test and direction, with the sheet that it comes from.
struct ValueLaw<'a> {
    sheet: &'a Sheet,
    settings: &'a FitSettings,
    test: Test,
    direction: Direction,
}

/// Law of a fit that no curve of the sheet gives.
pub struct ValueLawReport {
    pub test: Test,
    pub direction: Direction,
    /// Whether no value of the sheet determines the law.
    pub is_assumed: bool,
    pub law: LawReport,
}

/// Returns the laws of a `fit` that no curve of the `sheet` gives.
pub fn value_laws(sheet: &Sheet, fit: &Fit, settings: &FitSettings) -> Vec<ValueLawReport> {
    let tests = [Test::Tensile, Test::Bending, Test::Shear];
    let laws = tests.into_iter().flat_map(|test| {
        // There is one law of shear for both directions.
        let directions = if test == Test::Shear { &DIRECTIONS[..1] } else { &DIRECTIONS[..] };
        directions.iter().map(move |&direction| ValueLaw { sheet, settings, test, direction })
    });
    let report = |law: ValueLaw<'_>| ValueLawReport {
        test: law.test,
        direction: law.direction,
        is_assumed: law.given().is_empty(),
        law: law.report(fit),
    };
    laws.filter(|law| !law.has_curve()).map(report).collect()
}

impl ValueLaw<'_> {
    /// Returns whether a curve of the `sheet` gives the law.
    fn has_curve(&self) -> bool {
        self.sheet.curves.iter().any(|curve| match self.test {
            Test::Shear => curve.test == Test::Shear,
            Test::Bending | Test::LoopBending => {
                curve.direction == self.direction
                    && matches!(curve.test, Test::Bending | Test::LoopBending)
            }
            Test::Tensile => curve.direction == self.direction && curve.test == Test::Tensile,
        })
    }

    /// Returns the value `symbol` of the sheet, in the unit of the laboratory. In shear it is the
    /// mean of both directions.
    fn value(&self, symbol: Symbol) -> Option<f64> {
        if self.test != Test::Shear {
            return self.sheet.values(self.direction).get(symbol);
        }
        let both = DIRECTIONS.map(|direction| self.sheet.values(direction).get(symbol));
        let known: Vec<f64> = both.into_iter().flatten().collect();
        (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
    }

    /// Returns the symbols of the values of the `test`.
    fn symbols(&self) -> &'static [Symbol] {
        match self.test {
            Test::Tensile => &[Symbol::Em, Symbol::Lt, Symbol::Wt, Symbol::Rt],
            Test::Shear => &[Symbol::G, Symbol::TwoHg, Symbol::TwoHg5],
            Test::Bending | Test::LoopBending => &[Symbol::B, Symbol::TwoHb],
        }
    }

    /// Returns the symbols of the values that the `sheet` has.
    fn given(&self) -> Vec<&'static str> {
        let given = self.symbols().iter().filter(|symbol| self.value(**symbol).is_some());
        given.map(|symbol| symbol.name()).collect()
    }

    /// Returns the report of the law of a `fit`.
    fn report(&self, fit: &Fit) -> LawReport {
        let mut law = fabric::law(&fit.fabric, self.test, self.direction);
        let given = self.given();
        let assumed = given.is_empty();
        law.model = if assumed {
            "ASSUMED: no curve and no value of it is in the sheet".to_owned()
        } else {
            format!("from the values of the sheet: {}", given.join(", "))
        };

        // The marks show where the loop should pass.
        for plot in &mut law.plots {
            plot.law = if assumed { "assumed law" } else { "law of the values" }.to_owned();
            if let Some(ideal) = fabric::loop_of(&fit.fabric, self.test, self.direction) {
                plot.marks = self.marks(&ideal);
            }
        }

        // Only a value with a standard deviation gives its parameter an interval.
        let mut scatters = false;
        for parameter in &mut law.parameters {
            parameter.interval = match parameter.standard_error {
                Some(error) => {
                    scatters = true;
                    let half = NORMAL_95 * error;
                    Interval::Between {
                        lower: parameter.value - half,
                        upper: parameter.value + half,
                    }
                }
                None => Interval::Fixed { reason: self.reason(&parameter.symbol) },
            };
        }

        law.notes = fit.assumed.iter().filter(|note| self.concerns(note)).cloned().collect();
        if scatters {
            law.notes.push(
                "intervals: 1.96 standard errors, by the standard deviations that the sheet states"
                    .into(),
            );
        } else if !assumed {
            law.notes.push(
                "no intervals: a value alone has no scatter; state it, as in B = \"0.118 ± 0.006\", \
                 or give curves of repeats"
                    .into(),
            );
        }
        law
    }

    /// Returns the values that a parameter comes from, by its `symbol` on the page.
    fn reason(&self, symbol: &str) -> String {
        use Symbol::{B, Em, G, Lt, Rt, TwoHb, TwoHg, TwoHg5, Wt};
        let sources: &[Symbol] = match (self.test, symbol) {
            (Test::Tensile, "k_t" | "r_1" | "ε_1") => &[Em, Lt, Wt],
            (Test::Tensile, "F_c") => &[Rt],
            (Test::Shear, "k_s") => &[G],
            (Test::Shear, "F_c") => &[TwoHg, TwoHg5],
            (Test::Shear, "g") => &[TwoHg5],
            (Test::Bending, "k_b") => &[B],
            (Test::Bending, "F_c") => &[TwoHb],
            _ => return "ASSUMED: no value tells it".to_owned(),
        };

        let named = |symbols: &[Symbol]| {
            symbols.iter().map(|symbol| symbol.name()).collect::<Vec<_>>().join(", ")
        };
        let measured: Vec<Symbol> =
            sources.iter().copied().filter(|symbol| self.value(*symbol).is_some()).collect();
        match measured.as_slice() {
            [] => format!("ASSUMED: {} not measured", named(sources)),
            measured => format!("from {}", named(measured)),
        }
    }

    /// Returns whether a `note` on an assumption is about this law.
    fn concerns(&self, note: &str) -> bool {
        let name = self.direction.name();
        let starts: &[&str] = match self.test {
            Test::Tensile => &["traction", "EM", "LT", "WT", "RT", "FM"],
            Test::Shear => &["shear", "G", "2HG"],
            Test::Bending | Test::LoopBending => &["bending", "B", "2HB"],
        };
        let note = note.strip_prefix(name).map_or(note, str::trim_start);
        starts.iter().any(|start| {
            let rest = note.strip_prefix(start);
            rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric()))
        })
    }

    /// Returns the marks of the values of the sheet, on the loop `measured` if the law agrees with
    /// the values.
    fn marks(&self, measured: &Curve) -> Vec<Mark> {
        let mut si = Values::default();
        for symbol in self.symbols() {
            *si.get_mut(*symbol) = self.value(*symbol);
        }
        let mark = |symbol: Symbol, points: Vec<[f64; 2]>| {
            let label = symbol.name().to_owned();
            (!points.is_empty()).then_some(Mark { label, points })
        };
        let about = |at: f64, width: Option<f64>| {
            let middle = middle(measured, at).zip(width);
            let points =
                middle.map(|(m, width)| vec![[at, m + 0.5 * width], [at, m - 0.5 * width]]);
            points.unwrap_or_default()
        };

        let marks = match self.test {
            Test::Tensile => {
                let end = si.tensile_extension();
                let end = end.map(|strain| vec![[strain, self.sheet.maximum_tension()]]);
                vec![mark(Symbol::Em, end.unwrap_or_default())]
            }
            Test::Bending | Test::LoopBending => {
                let BendingPoints { slope, width } = self.settings.bending_points;
                vec![
                    mark(Symbol::TwoHb, about(width, si.bending_loop_width())),
                    mark(Symbol::B, line(measured, slope, si.bending_rigidity())),
                ]
            }
            Test::Shear => {
                let points = self.settings.shear_points;
                let wide = si.shear_loop_width_at_five_degrees();
                vec![
                    mark(Symbol::TwoHg, about(points.width, si.shear_loop_width())),
                    mark(Symbol::TwoHg5, about(points.wide, wide)),
                    mark(Symbol::G, line(measured, points.slope, si.shear_stiffness())),
                ]
            }
        };
        marks.into_iter().flatten().collect()
    }
}

/// Returns two points of a `slope` in the middle of the loop `measured`: the point of the loop at
/// `from`, and the point at `to` to which the slope leads.
fn line(measured: &Curve, [from, to]: [f64; 2], slope: Option<f64>) -> Vec<[f64; 2]> {
    let points = middle(measured, from).zip(slope);
    let points =
        points.map(|(start, slope)| vec![[from, start], [to, start + slope * (to - from)]]);
    points.unwrap_or_default()
}

/// Returns the load in the middle of the loop `measured` at the deformation `at`: the mean of its
/// last rising and falling branch.
fn middle(measured: &Curve, at: f64) -> Option<f64> {
    let branches = measured.branches();
    let load = |rising: bool| {
        let through = branches.iter().rev().filter(|branch| branch.rising == rising);
        through
            .filter_map(|branch| {
                let (q, f) = (measured.deformation(), measured.load());
                let mut pairs = branch.points.clone().zip(branch.points.clone().skip(1));
                let (a, b) =
                    pairs.find(|&(a, b)| (q[a] - at) * (q[b] - at) <= 0.0 && q[a] != q[b])?;
                Some(f[a] + (f[b] - f[a]) * (at - q[a]) / (q[b] - q[a]))
            })
            .next()
    };
    Some(0.5 * (load(true)? + load(false)?))
}
