//! Prediction of a drape coefficient from a KES sheet that leaves parameters open.
//!
//! Each open parameter is set to either end of its range. To first order the squares of the changes
//! of independent parameters add up. So the interval around the fitted coefficient `$D$` ends at
//! `$D \pm \sqrt{\sum_i \Delta_i^2}$`.

use drape_fabric::{Fabric, ShearBackbone};

use super::meter::Drapemeter;
use super::study::{Sampling, Study};
use crate::error::ValidationError;

/// Parameter that a sheet may leave open.
///
/// The logarithm of a parameter is assumed to be normally distributed, with one in twenty fabrics
/// below its lower end and one in twenty above its upper end. The parameters are assumed to be
/// independent. The ends do not come from a survey of many fabrics. They are meant to be wide for
/// apparel weaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnmeasuredParameter {
    /// Shear stiffness G.
    ShearStiffness,
    /// Width of the shear loop, 2HG.
    ShearLoop,
    /// The curvature over which the friction of bending builds up.
    BendingSlip,
}

impl UnmeasuredParameter {
    /// All parameters.
    pub const ALL: [Self; 3] = [Self::ShearStiffness, Self::ShearLoop, Self::BendingSlip];

    /// Returns the name of the parameter (`self`) with its ends in the laboratory's units.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ShearStiffness => "G 0.3 to 1 gf/(cm·deg)",
            Self::ShearLoop => "2HG 0.2 to 2 gf/cm",
            Self::BendingSlip => "bending friction over 0.2 to 0.02 1/cm",
        }
    }

    /// Returns `fabric` with the parameter at its limp end and at its stiff end. `None` if the fit
    /// of `fabric` did not assume the parameter.
    #[must_use]
    pub fn ends(self, fabric: &Fabric) -> Option<[Fabric; 2]> {
        let assumed = &fabric.provenance.as_ref()?.assumed;
        let starts: &[&str] = match self {
            Self::ShearStiffness => &["shear stiffness"],
            Self::ShearLoop => &["shear loop"],
            Self::BendingSlip => &["warp bending friction", "weft bending friction"],
        };
        let is_assumed: Vec<bool> =
            starts.iter().map(|start| assumed.iter().any(|text| text.starts_with(start))).collect();
        if !is_assumed.contains(&true) {
            return None;
        }

        // Values are in SI. A plateau is half of the width of a loop.
        let mut ends = [fabric.clone(), fabric.clone()];
        for (end, changed) in ends.iter_mut().enumerate() {
            match self {
                Self::ShearStiffness => {
                    let stiffness = [16.86, 56.19][end];
                    changed.shear.backbone = ShearBackbone::Linear { stiffness };
                }
                Self::ShearLoop => {
                    changed.shear.friction.elements[0].plateau = [0.0981, 0.9807][end];
                }
                Self::BendingSlip => {
                    let directions = [&mut changed.warp, &mut changed.weft];
                    for (laws, is_assumed) in directions.into_iter().zip(&is_assumed) {
                        if *is_assumed {
                            laws.bending.friction.elements[0].length = [20.0, 2.0][end];
                        }
                    }
                }
            }
        }
        Some(ends)
    }
}

/// Prediction of a drape coefficient from a KES sheet that leaves parameters open.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// Study of the fitted fabric.
    pub fitted: Study,
    /// Studies with one open parameter at its limp end and at its stiff end.
    pub ends: Vec<(UnmeasuredParameter, [Study; 2])>,
}

impl Prediction {
    /// Drapes the fitted `fabric`, and `fabric` with each open parameter at its ends, from the
    /// starts of `sampling`. Calls `done` after each start.
    ///
    /// # Errors
    /// The errors of [`Drapemeter::study`].
    pub fn run(
        meter: &Drapemeter,
        fabric: &Fabric,
        sampling: Sampling,
        done: &(dyn Fn() + Sync),
    ) -> Result<Self, ValidationError> {
        let fitted = meter.study(fabric, sampling, done)?;
        let mut ends = Vec::new();
        for parameter in UnmeasuredParameter::ALL {
            if let Some([low, high]) = parameter.ends(fabric) {
                let low = meter.study(&low, sampling, done)?;
                ends.push((parameter, [low, meter.study(&high, sampling, done)?]));
            }
        }
        Ok(Self { fitted, ends })
    }

    /// Returns the number of studies in a prediction for `fabric`.
    #[must_use]
    pub fn study_count(fabric: &Fabric) -> u64 {
        let open = UnmeasuredParameter::ALL.iter().filter(|open| open.ends(fabric).is_some());
        1 + 2 * open.count() as u64
    }

    /// Returns the interval that contains the drape coefficients of nine in ten fabrics with this
    /// sheet, as ratios. To first order, the squares of the changes by independent parameters add
    /// up.
    #[must_use]
    pub fn interval(&self) -> [f64; 2] {
        let middle = self.fitted.mean();
        let [below, above] = [-1.0, 1.0].map(|sign| {
            let changes = self.ends.iter().map(|(_, ends)| {
                ends.iter().map(|end| sign * (end.mean() - middle)).fold(0.0, f64::max)
            });
            changes.map(|change| change.powi(2)).sum::<f64>().sqrt()
        });
        [middle - below, middle + above]
    }
}
