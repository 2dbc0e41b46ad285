//! The search that every test shares: several starts, one history, one best set of parameters.

use drape_kes::{Curve, Direction, Test};
use rayon::prelude::*;

use crate::Error;
use crate::lm::{self, Parameter, Report, Settings, Stop};

/// How well a law follows a measured curve, and with which parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveFit {
    /// The curve's name.
    pub name: String,
    /// The test.
    pub test: Test,
    /// The yarns along which the strip was loaded.
    pub direction: Direction,
    /// Root mean square residual over the range of the measured load, a ratio.
    pub misfit: f64,
    /// Steps of the best start.
    pub iterations: usize,
    /// Evaluations of the law along the whole history, over all starts.
    pub evaluations: usize,
    /// Why the best start ended.
    pub stop: Stop,
    /// The fitted parameters by name, in SI.
    pub parameters: Vec<(&'static str, f64)>,
    /// The law's load at each point of the curve, in the curve's unit.
    pub load: Vec<f64>,
}

/// A fitted law with its fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Identified<L> {
    /// The law.
    pub law: L,
    /// How well it follows the curve.
    pub fit: CurveFit,
}

/// Steps that every start is given before the best are chosen.
///
/// Enough to leave the start's own neighbourhood, and a small part of a full search.
const SCOUT_ITERATIONS: usize = 12;
/// Starts that are searched to the end; more than one because the nearest valley is not always the deepest.
const FINALISTS: usize = 3;

/// A named parameter of a law.
pub(crate) type Named = (&'static str, Parameter);

/// The best end of a search from several starts.
pub(crate) struct Found {
    pub(crate) parameters: Vec<(&'static str, f64)>,
    pub(crate) report: Report,
    /// Evaluations over all starts.
    pub(crate) evaluations: usize,
}

/// Searches from every start a little way, and from the best of them to the end.
///
/// The starts run side by side; the first of equally good ones is taken, so the number of threads does not
/// matter.
pub(crate) fn search(problem: &(impl lm::Problem + Sync), starts: &[Vec<Named>]) -> Found {
    let minimise = |start: &[Named], from: Option<&Report>, iterations: usize| {
        let mut parameters: Vec<Parameter> = start.iter().map(|(_, p)| *p).collect();
        if let Some(report) = from {
            for (parameter, value) in parameters.iter_mut().zip(&report.parameters) {
                parameter.start = *value;
            }
        }
        lm::minimise(
            problem,
            &parameters,
            &Settings {
                iterations,
                ..Settings::default()
            },
        )
    };
    let mut scouts: Vec<(usize, Report)> = (0..starts.len())
        .into_par_iter()
        .map(|index| (index, minimise(&starts[index], None, SCOUT_ITERATIONS)))
        .collect();
    scouts.sort_by(|(_, a), (_, b)| a.rms.total_cmp(&b.rms));
    let scouted: usize = scouts.iter().map(|(_, report)| report.evaluations).sum();
    scouts.truncate(FINALISTS);
    let finals: Vec<(usize, Report)> = scouts
        .par_iter()
        .map(|(index, scout)| {
            let iterations = Settings::default().iterations;
            let mut report = minimise(&starts[*index], Some(scout), iterations);
            report.iterations += scout.iterations;
            (*index, report)
        })
        .collect();
    let searched: usize = finals.iter().map(|(_, report)| report.evaluations).sum();
    let (index, report) = finals
        .into_iter()
        .min_by(|(_, a), (_, b)| a.rms.total_cmp(&b.rms))
        .expect("every law gives at least one start");
    let names = starts[index].iter().map(|(name, _)| *name);
    let parameters = names.zip(report.parameters.iter().copied()).collect();
    Found {
        parameters,
        report,
        evaluations: scouted + searched,
    }
}

/// Finds the parameters with which `predict` comes nearest to the curve's loads.
pub(crate) fn fit(
    curve: &Curve,
    starts: &[Vec<Named>],
    predict: impl Fn(&[f64], &mut [f64]) + Sync,
) -> CurveFit {
    let (low, high) = curve.load_range();
    let problem = Residuals {
        load: curve.load(),
        scale: 1.0 / (high - low),
        predict: &predict,
    };
    let found = search(&problem, starts);
    let mut load = vec![0.0; curve.load().len()];
    predict(&found.report.parameters, &mut load);
    CurveFit::new(curve, found.report.rms, found, load)
}

impl CurveFit {
    pub(crate) fn new(curve: &Curve, misfit: f64, found: Found, load: Vec<f64>) -> Self {
        Self {
            name: curve.name.clone(),
            test: curve.test,
            direction: curve.direction,
            misfit,
            iterations: found.report.iterations,
            evaluations: found.evaluations,
            stop: found.report.stop,
            parameters: found.parameters,
            load,
        }
    }

    pub(crate) fn values(&self) -> Vec<f64> {
        self.parameters.iter().map(|(_, value)| *value).collect()
    }
}

/// Checks that a curve is of the right test and has a load that changes.
pub(crate) fn expect(curve: &Curve, wanted: Test) -> Result<(), Error> {
    let name = curve.name.clone();
    if curve.test != wanted {
        return Err(Error::WrongTest {
            name,
            found: curve.test,
            wanted,
        });
    }
    let (low, high) = curve.load_range();
    if low == high {
        return Err(Error::NoLoad { name, load: low });
    }
    Ok(())
}

/// Slope and intercept of the straight line through points, by least squares.
pub(crate) fn line(points: impl Iterator<Item = (f64, f64)> + Clone) -> Option<(f64, f64)> {
    let count = points.clone().count() as f64;
    let (sx, sy) = points
        .clone()
        .fold((0.0, 0.0), |(sx, sy), (x, y)| (sx + x, sy + y));
    let (mx, my) = (sx / count, sy / count);
    let (xx, xy) = points.fold((0.0, 0.0), |(xx, xy), (x, y)| {
        (xx + (x - mx).powi(2), xy + (x - mx) * (y - my))
    });
    let slope = xy / xx;
    slope.is_finite().then_some((slope, my - slope * mx))
}

struct Residuals<'a, F> {
    load: &'a [f64],
    scale: f64,
    predict: &'a F,
}

impl<F: Fn(&[f64], &mut [f64])> lm::Problem for Residuals<'_, F> {
    fn residual_count(&self) -> usize {
        self.load.len()
    }

    fn residuals(&self, parameters: &[f64], out: &mut [f64]) {
        (self.predict)(parameters, out);
        for (residual, load) in out.iter_mut().zip(self.load) {
            *residual = (*residual - load) * self.scale;
        }
    }
}
