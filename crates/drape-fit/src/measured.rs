//! What a sheet's curves and values say about each law.

use drape_fabric::{BendingLaw, ShearLaw, TractionLaw};
use drape_kes::{Curve, Direction, Sheet, Test, Values};
use rayon::prelude::*;

use crate::from_values::{TensileTarget, bending_from_values, tensile_from_values};
use crate::tensile_values::tensile_law;
use crate::{
    CurveFit, Error, Identified, Settings, assumed, identify_bending, identify_loop_bending,
    identify_shear, identify_tensile, shear_from_values,
};

/// Deviation of a law's values from the sheet's, relative, that is worth a word: a tenth of their scatter.
pub(crate) const UNMET: f64 = 1e-3;

/// What one curve gave.
enum Laws {
    Traction(Identified<TractionLaw>),
    Bending(Identified<BendingLaw>),
    LoopBending(Identified<BendingLaw>),
    Shear(Identified<ShearLaw>),
}

/// The curves that are identified together, by their places in the sheet: the loop-bending curves of a
/// direction, every other curve by itself.
fn groups(curves: &[Curve]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (index, curve) in curves.iter().enumerate() {
        let together = |group: &&mut Vec<usize>| {
            let first = &curves[group[0]];
            curve.test == Test::LoopBending
                && first.test == curve.test
                && first.direction == curve.direction
        };
        match groups.iter_mut().find(together) {
            Some(group) => group.push(index),
            None => groups.push(vec![index]),
        }
    }
    groups
}

impl Laws {
    fn of(group: &[&Curve], settings: &Settings) -> Result<Vec<Self>, Error> {
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

    fn into_fit(self) -> CurveFit {
        match self {
            Self::Traction(found) => found.fit,
            Self::Bending(found) | Self::LoopBending(found) => found.fit,
            Self::Shear(found) => found.fit,
        }
    }
}

/// The sheet with the laws of its curves.
pub(crate) struct Measured<'a> {
    sheet: &'a Sheet,
    settings: &'a Settings,
    /// In the order of the sheet's curves.
    laws: Vec<Laws>,
}

/// A law with what had to be assumed for it; nothing where nothing was measured.
pub(crate) type Found<L> = Result<Option<(L, Vec<String>)>, Error>;

impl<'a> Measured<'a> {
    /// Identifies the law of every curve, side by side.
    pub(crate) fn new(sheet: &'a Sheet, settings: &'a Settings) -> Result<Self, Error> {
        let groups = groups(&sheet.curves);
        let identified: Result<Vec<Vec<Laws>>, Error> = groups
            .par_iter()
            .map(|group| {
                let curves: Vec<&Curve> = group.iter().map(|&index| &sheet.curves[index]).collect();
                Laws::of(&curves, settings)
            })
            .collect();
        let places = groups.into_iter().flatten();
        let mut laws: Vec<(usize, Laws)> = places.zip(identified?.into_iter().flatten()).collect();
        laws.sort_by_key(|(index, _)| *index);
        let laws = laws.into_iter().map(|(_, laws)| laws).collect();
        Ok(Self { sheet, settings, laws })
    }

    /// How well each curve is followed, in the order of the sheet.
    pub(crate) fn into_fits(self) -> Vec<CurveFit> {
        self.laws.into_iter().map(Laws::into_fit).collect()
    }

    pub(crate) fn traction(&self, direction: Direction) -> Found<TractionLaw> {
        let from_curve = self.laws.iter().find_map(|laws| match laws {
            Laws::Traction(found) if found.fit.direction == direction => Some(found.law),
            _ => None,
        });
        if let Some(law) = from_curve {
            let mut notes = Vec::new();
            if law.friction.plateau() == 0.0 {
                let name = direction.name();
                notes.push(format!("{name} traction friction: no recovery measured, none taken"));
            }
            return Ok(Some((law, notes)));
        }
        tensile_law(direction.name(), self.sheet.values(direction), self.sheet.maximum_tension())
    }

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
        tensile_from_values(&target).map(|(law, _)| law)
    }

    pub(crate) fn bending(&self, direction: Direction, density: f64) -> Found<BendingLaw> {
        let curve = self.laws.iter().find_map(|laws| match laws {
            Laws::Bending(found) if found.fit.direction == direction => Some(found.law),
            _ => None,
        });
        let arches = self.laws.iter().find_map(|laws| match laws {
            Laws::LoopBending(found) if found.fit.direction == direction => Some(found.law),
            _ => None,
        });
        if let Some(law) = curve.or(arches) {
            return Ok(Some((law, Vec::new())));
        }
        let values = self.sheet.values(direction);
        let (rigidity, width) = (values.bending_rigidity(), values.bending_loop_width());
        if rigidity.is_none() && width.is_none() {
            return Ok(None);
        }
        let name = direction.name();
        let mut notes = Vec::new();
        let rigidity = rigidity.unwrap_or_else(|| {
            notes.push(format!("{name} B: not measured, a bending length of 20 mm taken"));
            assumed::bending_rigidity(density)
        });
        let width = width.unwrap_or_else(|| {
            notes.push(format!("{name} 2HB: not measured, no bending friction taken"));
            0.0
        });
        if width > 0.0 {
            let slip = assumed::BENDING_SLIP;
            notes.push(format!("{name} bending friction length: not in 2HB, {slip} 1/m taken"));
        }
        Ok(Some((bending_from_values(rigidity, width), notes)))
    }

    /// The law of the first shear curve, or of the mean of the values of both directions.
    pub(crate) fn shear(&self, notes: &mut Vec<String>) -> ShearLaw {
        let curve = self.laws.iter().find_map(|laws| match laws {
            Laws::Shear(found) => Some(found.law),
            _ => None,
        });
        if let Some(law) = curve {
            return law;
        }
        let mut mean = |name: &str, value: fn(&Values) -> Option<f64>| {
            let values = [value(&self.sheet.warp), value(&self.sheet.weft)];
            if let [Some(warp), Some(weft)] = values
                && (warp - weft).abs() > UNMET * warp.abs()
            {
                let (warp, weft) = (format!("{warp:.4}"), format!("{weft:.4}"));
                notes
                    .push(format!("{name}: the mean of warp {warp} and weft {weft} (in SI) taken"));
            }
            let known: Vec<f64> = values.into_iter().flatten().collect();
            (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
        };
        let stiffness = mean("G", Values::shear_stiffness);
        let narrow = mean("2HG", Values::shear_loop_width);
        let wide = mean("2HG5", Values::shear_loop_width_at_five_degrees);
        let stiffness = stiffness.unwrap_or_else(|| {
            let taken = assumed::SHEAR_STIFFNESS;
            notes.push(format!("shear stiffness: not measured, {taken} N/(m·rad) taken"));
            taken
        });
        let widths = match (narrow, wide) {
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
        let (law, off) = shear_from_values(stiffness, widths, &self.settings.shear_points);
        let slip = law.friction.elements[0].length;
        if widths[1] < widths[0] && slip > assumed::SHEAR_SLIP {
            notes.push(format!("shear friction length: a sine of {slip:.4}, since 2HG5 < 2HG"));
        } else {
            notes.push(format!("shear friction length: not in the values, a sine of {slip} taken"));
        }
        if off > UNMET {
            let percent = 100.0 * off;
            notes.push(format!(
                "G, 2HG and 2HG5: met to {percent:.1} % only, no friction widens so"
            ));
        }
        law
    }
}
