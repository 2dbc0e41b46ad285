//! Laws of a sheet: from curves if there are any, else from values, with notes on assumptions.

use drape_fabric::{BendingLaw, ShearLaw, TractionLaw};
use drape_kes::{BendingValues, Curve, Direction, ShearValues, Sheet, Test, Values};

use crate::curves::bending::identify_bending;
use crate::curves::loop_bending::identify_loop_bending;
use crate::curves::shear::identify_shear;
use crate::curves::tensile::identify_tensile;
use crate::error::Error;
use crate::regression::curve_fit::{CurveFit, Identified};
use crate::settings::FitSettings;
use crate::threads;
use crate::values::assumed;
use crate::values::bending::bending_from_values;
use crate::values::completion::tensile_law;
use crate::values::matched::{Matched, Noted, REPORTED_DEVIATION};
use crate::values::shear::shear_from_values;
use crate::values::traction::{TensileTarget, tensile_from_values};

/// Law of one curve.
enum CurveLaw {
    Traction(Identified<TractionLaw>),
    Bending(Identified<BendingLaw>),
    LoopBending(Identified<BendingLaw>),
    Shear(Identified<ShearLaw>),
}

/// Returns the indices of `curves` that are identified together: the loop-bending curves of one
/// direction, and every other curve alone.
fn groups(curves: &[Curve]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (index, curve) in curves.iter().enumerate() {
        let group = groups.iter_mut().find(|group| {
            let first = &curves[group[0]];
            curve.test == Test::LoopBending
                && first.test == curve.test
                && first.direction == curve.direction
        });
        match group {
            Some(group) => group.push(index),
            None => groups.push(vec![index]),
        }
    }
    groups
}

impl CurveLaw {
    /// Identifies the laws of a `group` of curves that are identified together.
    fn identify_group(group: &[&Curve], settings: &FitSettings) -> Result<Vec<Self>, Error> {
        let curve = group[0];
        Ok(match curve.test {
            Test::Tensile => vec![Self::Traction(identify_tensile(curve, settings)?)],
            Test::Bending => vec![Self::Bending(identify_bending(curve, settings)?)],
            Test::Shear => vec![Self::Shear(identify_shear(curve, settings)?)],
            Test::LoopBending => {
                identify_loop_bending(group, settings)?.into_iter().map(Self::LoopBending).collect()
            }
        })
    }

    /// Returns the fit of the law to its curve.
    fn into_fit(self) -> CurveFit {
        match self {
            Self::Traction(identified) => identified.fit,
            Self::Bending(identified) | Self::LoopBending(identified) => identified.fit,
            Self::Shear(identified) => identified.fit,
        }
    }
}

/// Sheet with the laws of its curves.
pub(crate) struct SheetLaws<'a> {
    sheet: &'a Sheet,
    settings: &'a FitSettings,
    /// Laws in the order of the sheet's curves.
    laws: Vec<CurveLaw>,
}

impl<'a> SheetLaws<'a> {
    /// Identifies the law of every curve of `sheet`, in parallel.
    pub(crate) fn new(sheet: &'a Sheet, settings: &'a FitSettings) -> Result<Self, Error> {
        let groups = groups(&sheet.curves);
        let identified = threads::map(&groups, |group| {
            let curves: Vec<&Curve> = group.iter().map(|&index| &sheet.curves[index]).collect();
            CurveLaw::identify_group(&curves, settings)
        });
        let identified: Result<Vec<Vec<CurveLaw>>, Error> = identified.into_iter().collect();
        let indices = groups.into_iter().flatten();
        let mut laws: Vec<(usize, CurveLaw)> =
            indices.zip(identified?.into_iter().flatten()).collect();
        laws.sort_by_key(|(index, _)| *index);
        let laws = laws.into_iter().map(|(_, laws)| laws).collect();
        Ok(Self { sheet, settings, laws })
    }

    /// Returns the fit of each curve, in the order of the sheet.
    pub(crate) fn into_fits(self) -> Vec<CurveFit> {
        self.laws.into_iter().map(CurveLaw::into_fit).collect()
    }

    /// Returns the traction law of the first tensile curve of `direction`, or of its values.
    pub(crate) fn traction(
        &self,
        direction: Direction,
    ) -> Result<Option<Noted<TractionLaw>>, Error> {
        let from_curve = self.laws.iter().find_map(|laws| match laws {
            CurveLaw::Traction(identified) if identified.fit.direction == direction => {
                Some(identified.law)
            }
            _ => None,
        });
        if let Some(law) = from_curve {
            let mut notes = Vec::new();
            if law.friction.is_none() {
                let name = direction.name();
                notes.push(format!("{name} traction friction: no recovery measured, none taken"));
            }
            return Ok(Some(Noted { law, notes }));
        }
        tensile_law(direction.name(), self.sheet.values(direction), self.sheet.maximum_tension())
    }

    /// Returns the traction law of the default values, and adds a note to `notes`.
    pub(crate) fn assumed_traction(&self, notes: &mut Vec<String>) -> Result<TractionLaw, Error> {
        notes.push(format!(
            "traction: not measured, EM {:.0} %, LT {} and RT {:.0} % taken",
            100.0 * assumed::EXTENSION,
            assumed::LINEARITY,
            100.0 * assumed::RESILIENCE
        ));
        let target = TensileTarget {
            maximum_tension: self.sheet.maximum_tension(),
            extension: assumed::EXTENSION,
            linearity: assumed::LINEARITY,
            resilience: assumed::RESILIENCE,
        };
        tensile_from_values(&target).map(|identified| identified.law)
    }

    /// Returns the bending law of the first bending curve of `direction`, of its loop-bending
    /// curves, or of its values.
    pub(crate) fn bending(&self, direction: Direction, density: f64) -> Option<Noted<BendingLaw>> {
        let from_loop = self.laws.iter().find_map(|laws| match laws {
            CurveLaw::Bending(identified) if identified.fit.direction == direction => {
                Some(identified.law)
            }
            _ => None,
        });
        let from_arches = self.laws.iter().find_map(|laws| match laws {
            CurveLaw::LoopBending(identified) if identified.fit.direction == direction => {
                Some(identified.law)
            }
            _ => None,
        });

        if let Some(law) = from_loop.or(from_arches) {
            return Some(Noted { law, notes: Vec::new() });
        }
        let values = self.sheet.values(direction);
        let (rigidity, width) = (values.bending_rigidity(), values.bending_loop_width());
        if rigidity.is_none() && width.is_none() {
            return None;
        }

        let name = direction.name();
        let mut notes = Vec::new();
        let rigidity = rigidity.unwrap_or_else(|| {
            notes.push(format!("{name} B: not measured, a bending length of 20 mm taken"));
            assumed::bending_rigidity(density)
        });
        let loop_width = width.unwrap_or_else(|| {
            notes.push(format!("{name} 2HB: not measured, no bending friction taken"));
            0.0
        });
        if loop_width > 0.0 {
            let length = assumed::BENDING_FRICTION_LENGTH;
            notes.push(format!("{name} bending friction length: not in 2HB, {length} 1/m taken"));
        }
        let law = bending_from_values(&BendingValues { rigidity, loop_width });
        Some(Noted { law, notes })
    }

    /// Returns the law of the first shear curve, or of the mean of the values of both directions,
    /// and adds assumptions to `notes`.
    pub(crate) fn shear(&self, notes: &mut Vec<String>) -> ShearLaw {
        let from_curve = self.laws.iter().find_map(|laws| match laws {
            CurveLaw::Shear(identified) => Some(identified.law),
            _ => None,
        });
        if let Some(law) = from_curve {
            return law;
        }

        let stiffness = self.mean_value("G", Values::shear_stiffness, notes);
        let narrow = self.mean_value("2HG", Values::shear_loop_width, notes);
        let wide = self.mean_value("2HG5", Values::shear_loop_width_at_five_degrees, notes);
        let stiffness = stiffness.unwrap_or_else(|| {
            let taken = assumed::SHEAR_STIFFNESS;
            notes.push(format!("shear stiffness: not measured, {taken} N/(m·rad) taken"));
            taken
        });
        let [loop_width, wide_loop_width] = match (narrow, wide) {
            (Some(narrow), Some(wide)) => [narrow, wide],
            (Some(width), None) | (None, Some(width)) => {
                notes.push("shear loop: one width measured, the same taken at every angle".into());
                [width, width]
            }
            (None, None) => {
                let taken = assumed::SHEAR_LOOP_WIDTH;
                notes.push(format!("shear loop: not measured, a width of {taken} N/m taken"));
                [taken, taken]
            }
        };

        let target = ShearValues { stiffness, loop_width, wide_loop_width };
        let Matched { law, deviation } = shear_from_values(&target, &self.settings.shear_points);
        let length = law.friction.elements[0].length;
        if wide_loop_width < loop_width && length > assumed::SHEAR_FRICTION_LENGTH {
            notes.push(format!("shear friction length: a sine of {length:.4}, since 2HG5 < 2HG"));
        } else {
            let taken = format!("a sine of {length} taken");
            notes.push(format!("shear friction length: not in the values, {taken}"));
        }
        if deviation > REPORTED_DEVIATION {
            let percent = 100.0 * deviation;
            notes.push(format!(
                "G, 2HG and 2HG5: met to {percent:.1} % only, no friction widens so"
            ));
        }
        law
    }

    /// Returns the mean of a value over both directions, and adds a note if the directions differ.
    fn mean_value(
        &self,
        name: &str,
        value: fn(&Values) -> Option<f64>,
        notes: &mut Vec<String>,
    ) -> Option<f64> {
        let values = [value(&self.sheet.warp), value(&self.sheet.weft)];
        if let [Some(warp), Some(weft)] = values
            && (warp - weft).abs() > REPORTED_DEVIATION * warp.abs()
        {
            let (warp, weft) = (format!("{warp:.4}"), format!("{weft:.4}"));
            notes.push(format!("{name}: the mean of warp {warp} and weft {weft} (in SI) taken"));
        }
        let known: Vec<f64> = values.into_iter().flatten().collect();
        (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
    }
}
