//! Drapes of a fabric: with friction, without friction, and at the ends of the parameters that its
//! sheet leaves open.

use std::time::{Duration, Instant};

use drape::dynamics::Snapshot;
use drape::fabric::Fabric;
use drape::input::duration_in_words;
use drape::run::reports::{DrapeEvaluation, DrapeResult, VERSION, laws_digest};
use drape::validate::ValidationError;
use drape::validate::drapemeter::{Prediction, Sampling, spacing_bound};

use super::{DrapeRequest, SPACING_MAX};
use crate::console::progress;
use crate::failure::Failure;

/// Duration of the steps from which the time of all specimens is estimated.
const CALIBRATION: Duration = Duration::from_secs(2);

/// Result of the specimens of a fabric, with the cloth of one specimen.
pub(crate) struct Draped {
    pub(crate) result: DrapeResult,
    /// Cloth on its disc, if a picture was requested.
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
    /// Whether a picture is requested. One specimen is draped once more for it.
    has_picture: bool,
}

impl DrapeRequest {
    /// Returns the specimens of `fabric`, at the requested spacing or the default one.
    pub(crate) fn specimens<'a>(&'a self, fabric: &'a Fabric, has_picture: bool) -> Specimens<'a> {
        let bound = spacing_bound(fabric);
        let spacing = self.spacing.unwrap_or(bound.min(SPACING_MAX));
        Specimens { fabric, request: self, spacing, bound, has_picture }
    }
}

impl Specimens<'_> {
    /// Returns a warning if the spacing is clearly larger than the `bound` of the fabric.
    pub(crate) fn warning(&self) -> Option<String> {
        let is_coarse = self.spacing > 1.05 * self.bound;
        is_coarse.then(|| format!("the fabric requires {:.2} mm or less", 1e3 * self.bound))
    }

    /// Returns the number of specimens: `starts` for the fabric, for the fabric without friction
    /// and for each end of each open parameter, and one for the picture.
    fn count(&self) -> u64 {
        let studies = 1 + Prediction::study_count(self.fabric);
        self.request.starts * studies + u64::from(self.has_picture)
    }

    /// Starts one specimen, and estimates the time of all specimens at its pace.
    pub(crate) fn expected(&self) -> Result<String, Failure> {
        let begin = Instant::now();
        let fraction = self
            .request
            .meter
            .begin(self.fabric, self.spacing, &|| begin.elapsed() < CALIBRATION)
            .map_err(failed)?;
        let specimen_seconds = begin.elapsed().as_secs_f64() / fraction.max(1e-9);
        // One specimen used all threads here. Specimens that share the threads take at most this
        // time together.
        let total_seconds = specimen_seconds * self.count() as f64;
        Ok(format!(
            "{} specimens, about {} at the pace of the first steps",
            self.count(),
            duration_in_words(total_seconds)
        ))
    }

    /// Drapes the specimens, and returns the result with the cloth of a typical one.
    pub(crate) fn drape(&self) -> Result<Draped, Failure> {
        let Self { fabric, request, spacing, bound, .. } = self;
        let bar = progress::bar(self.count(), "{pos}/{len} specimens, {eta} left");
        let sampling = Sampling { spacing: *spacing, starts: request.starts };
        let meter = &request.meter;
        let prediction =
            Prediction::run(meter, fabric, sampling, &|| bar.inc(1)).map_err(failed)?;
        let without_friction = fabric.without_friction();
        let elastic = meter.study(&without_friction, sampling, &|| bar.inc(1)).map_err(failed)?;

        let shown = prediction.fitted.typical();
        // The seeds of the starts count from 1.
        let seed = shown as u64 + 1;
        let snapshot = if self.has_picture {
            let snapshot = meter.snapshot(fabric, *spacing, seed).map_err(failed)?;
            bar.inc(1);
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
            for (end, study) in [("limp", low), ("stiff", high)] {
                let name = format!("{}, {end} end", parameter.name());
                evaluations.push(DrapeEvaluation::new(&name, study));
            }
        }

        let result = DrapeResult {
            version: VERSION.into(),
            fabric: fabric.name.clone(),
            laws: laws_digest(fabric),
            meter: request.description.clone(),
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
