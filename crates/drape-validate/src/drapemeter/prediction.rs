//! Prediction of a drape coefficient from a KES sheet that leaves parameters open.
//!
//! Each open parameter is taken to either end of its range. To first order the changes of
//! independent parameters add as squares, so the interval around the fitted coefficient `$D$` ends
//! at `$D \pm \sqrt{\sum_i \Delta_i^2}$`.

use drape_fabric::{Fabric, ShearBackbone};

use super::meter::Drapemeter;
use super::study::{Sampling, Study};
use crate::error::ValidationError;

/// Parameter that a sheet may leave open.
///
/// Its logarithm is taken to be normally distributed, with one in twenty fabrics below and one
/// above its ends; the parameters are taken to be independent. No survey of many fabrics is behind
/// the ends; they are meant to be wide for apparel weaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnmeasuredParameter {
    /// G.
    ShearStiffness,
    /// 2HG.
    ShearLoop,
    /// The curvature over which the friction of bending builds up.
    BendingSlip,
}

impl UnmeasuredParameter {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::ShearStiffness, Self::ShearLoop, Self::BendingSlip];

    /// Its name, and its ends in the laboratory's units.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ShearStiffness => "G 0.3 to 1 gf/(cm·deg)",
            Self::ShearLoop => "2HG 0.2 to 2 gf/cm",
            Self::BendingSlip => "bending friction over 0.2 to 0.02 1/cm",
        }
    }

    /// The two fabrics with this at the end where it drapes most and where it drapes least; none if
    /// it was not assumed in the fabric's fit.
    #[must_use]
    pub fn ends(self, fabric: &Fabric) -> Option<[Fabric; 2]> {
        let assumed = &fabric.provenance.as_ref()?.assumed;
        let named = |what: &str| assumed.iter().any(|text| text.starts_with(what));
        let of = |change: &dyn Fn(&mut Fabric, usize)| {
            [0, 1].map(|end| {
                let mut changed = fabric.clone();
                change(&mut changed, end);
                changed
            })
        };
        match self {
            Self::ShearStiffness => named("shear stiffness").then(|| {
                of(&|fabric, end| {
                    let stiffness = [16.86, 56.19][end];
                    fabric.shear.backbone = ShearBackbone::Linear { stiffness };
                })
            }),
            Self::ShearLoop => named("shear loop").then(|| {
                of(&|fabric, end| {
                    // Half of the loop's width.
                    fabric.shear.friction.elements[0].plateau = [0.0981, 0.9807][end];
                })
            }),
            Self::BendingSlip => {
                let open = [named("warp bending friction"), named("weft bending friction")];
                (open != [false; 2]).then(|| {
                    of(&|fabric, end| {
                        let both = [&mut fabric.warp, &mut fabric.weft];
                        for (laws, _) in both.into_iter().zip(open).filter(|(_, open)| *open) {
                            laws.bending.friction.elements[0].length = [20.0, 2.0][end];
                        }
                    })
                })
            }
        }
    }
}

/// Prediction of a drape coefficient, with what the sheet leaves open.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// The fabric as it was fitted.
    pub fitted: Study,
    /// The same with one parameter at either end.
    pub ends: Vec<(UnmeasuredParameter, [Study; 2])>,
}

impl Prediction {
    /// Drapes a fabric as fitted and with each open parameter at its ends, at a spacing, in m, from
    /// so many starts.
    ///
    /// # Errors
    /// Those of [`Drapemeter::study`].
    pub fn of(
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

    /// Studies that a prediction of a fabric takes.
    #[must_use]
    pub fn studies(fabric: &Fabric) -> u64 {
        let open = UnmeasuredParameter::ALL.iter().filter(|open| open.ends(fabric).is_some());
        1 + 2 * open.count() as u64
    }

    /// What nine of ten fabrics with the same sheet drape to: to first order, the changes of
    /// independent parameters add up as squares.
    #[must_use]
    pub fn interval(&self) -> [f64; 2] {
        let middle = self.fitted.mean();
        let reach = |sign: f64| {
            let change = |ends: &[Study; 2]| {
                ends.iter().map(|end| sign * (end.mean() - middle)).fold(0.0, f64::max)
            };
            self.ends.iter().map(|(_, ends)| change(ends).powi(2)).sum::<f64>().sqrt()
        };
        [middle - reach(-1.0), middle + reach(1.0)]
    }
}
