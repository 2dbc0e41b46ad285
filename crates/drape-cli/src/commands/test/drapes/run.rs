//! Drapes of a fabric: as it is, without friction, and at the ends of what its sheet leaves open.

use std::time::{Duration, Instant};

use drape::dynamics::Snapshot;
use drape::fabric::Fabric;
use drape::run::reports::{DrapeEvaluation, DrapeResult, VERSION, laws_digest};
use drape::validate::ValidationError;
use drape::validate::drapemeter::{Prediction, Sampling, spacing_bound};

use super::{DrapeRequest, SPACING_MAX};
use crate::console::progress;
use crate::failure::Failure;

/// Duration of the steps from which the time of all specimens is told.
const CALIBRATION: Duration = Duration::from_secs(2);

/// Result of the specimens of a fabric, with the cloth of one of them.
pub(crate) struct Draped {
    pub(crate) result: DrapeResult,
    /// The cloth on its disc, where a picture is wanted.
    pub(crate) snapshot: Option<Snapshot>,
}

/// Specimens of a fabric, before they are draped.
pub(crate) struct Specimens<'a> {
    fabric: &'a Fabric,
    request: &'a DrapeRequest,
    /// Spacing of the particles, in m.
    pub(crate) spacing: f64,
    /// Largest spacing that the fabric allows, in m.
    pub(crate) bound: f64,
    /// Whether a picture is wanted, for which one specimen is draped once more.
    has_picture: bool,
}

impl DrapeRequest {
    /// Returns the specimens of a fabric.
    pub(crate) fn of<'a>(&'a self, fabric: &'a Fabric, has_picture: bool) -> Specimens<'a> {
        let bound = spacing_bound(fabric);
        let spacing = self.spacing.unwrap_or(bound.min(SPACING_MAX));
        Specimens { fabric, request: self, spacing, bound, has_picture }
    }
}

impl Specimens<'_> {
    /// Returns a warning where the particles are too far apart.
    pub(crate) fn warning(&self) -> Option<String> {
        let is_coarse = self.spacing > 1.05 * self.bound;
        is_coarse.then(|| format!("the fabric requires {:.2} mm or less", 1e3 * self.bound))
    }

    /// Returns the number of specimens: of the fabric, of it without friction, at the ends of each open
    /// parameter, and that of the picture.
    fn count(&self) -> u64 {
        let studies = 1 + Prediction::study_count(self.fabric);
        self.request.starts * studies + u64::from(self.has_picture)
    }

    /// Begins one specimen and says how long all of them take at its pace.
    pub(crate) fn expected(&self) -> Result<String, Failure> {
        let begin = Instant::now();
        let go_on = || begin.elapsed() < CALIBRATION;
        let part = self.request.meter.begin(self.fabric, self.spacing, &go_on).map_err(failed)?;
        let whole = begin.elapsed().as_secs_f64() / part.max(1e-9);
        // A specimen alone has all threads; many share them, and each is slower by that at most.
        let all = whole * self.count() as f64;
        Ok(format!(
            "{} specimens, about {} at the pace of the first steps",
            self.count(),
            in_words(all)
        ))
    }

    /// Drapes the specimens.
    pub(crate) fn drape(&self) -> Result<Draped, Failure> {
        let Self { fabric, request, spacing, bound, .. } = self;
        let bar = progress::bar(self.count(), "{pos}/{len} specimens, {eta} left");
        let sampling = Sampling { spacing: *spacing, starts: request.starts };
        let done = || bar.inc(1);
        let meter = &request.meter;
        let prediction = Prediction::run(meter, fabric, sampling, &done).map_err(failed)?;
        let elastic = fabric.without_friction();
        let elastic = meter.study(&elastic, sampling, &done).map_err(failed)?;
        let shown = prediction.fitted.typical();
        // The seeds of the starts count from 1.
        let seed = shown as u64 + 1;
        let snapshot = if self.has_picture {
            let snapshot = meter.snapshot(fabric, *spacing, seed).map_err(failed)?;
            done();
            Some(snapshot)
        } else {
            None
        };
        bar.finish_and_clear();
        let mut evaluations = vec![
            DrapeEvaluation::new("with its friction", &prediction.fitted),
            DrapeEvaluation::new("elastic", &elastic),
        ];
        for (parameter, [low, high]) in &prediction.ends {
            let of = |end: &str| format!("{}, {end} end", parameter.name());
            evaluations.push(DrapeEvaluation::new(&of("limp"), low));
            evaluations.push(DrapeEvaluation::new(&of("stiff"), high));
        }
        let result = DrapeResult {
            version: VERSION.into(),
            fabric: fabric.name.clone(),
            laws: laws_digest(fabric),
            meter: request.words.clone(),
            disc: meter.disc,
            specimen: meter.specimen,
            spacing: *spacing,
            spacing_bound: *bound,
            interval: prediction.interval(),
            evaluations,
            shown,
            picture: None,
        };
        Ok(Draped { result, snapshot })
    }
}

fn failed(error: ValidationError) -> Failure {
    Failure::Solver(error.to_string())
}

/// Returns a duration in words.
fn in_words(seconds: f64) -> String {
    match seconds {
        ..120.0 => format!("{:.0} s", seconds.max(1.0)),
        120.0..7200.0 => format!("{:.0} min", seconds / 60.0),
        _ => format!("{:.1} h", seconds / 3600.0),
    }
}
