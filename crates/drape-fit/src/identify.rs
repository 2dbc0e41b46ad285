//! A whole fabric from a sheet.

use drape_fabric::{self as fabric, Fabric, Provenance, SURFACE_FRICTION};
use drape_fabric::{BendingLaw, ShearLaw, TractionLaw};
use drape_kes::{Curve, Direction, ShearPoints, Sheet, Test, Values};
use rayon::prelude::*;

use crate::from_values::{
    TensileTarget, bending_from_values, shear_from_values, tensile_from_values,
};
use crate::{
    CurveFit, Error, Identified, LoopModel, TractionModel, assumed, identify_bending,
    identify_loop_bending, identify_shear, identify_tensile,
};

/// How much better the polynomial must follow a tensile curve than the priming zone to be taken, as a ratio
/// of their misfits.
///
/// The priming zone is the model, and its parameters mean something; the polynomial is for curves that go on
/// bending upwards to their end.
const CLEARLY_BETTER: f64 = 0.5;

/// Which laws to identify, and where KES values are read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings {
    /// Elastic load of the traction laws; whichever follows the curve better unless set.
    pub traction: Option<TractionModel>,
    /// The bending laws.
    pub bending: LoopModel,
    /// The shear law.
    pub shear: LoopModel,
    /// Where the sheet's G, 2HG and 2HG5 were read.
    pub shear_points: ShearPoints,
}

/// An identified fabric, with how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The fabric.
    pub fabric: Fabric,
    /// How well a law follows each of the sheet's curves, in the order of the sheet; of loop bending, the curves
    /// of a direction stand together.
    pub curves: Vec<CurveFit>,
    /// What the sheet does not have, and what was taken instead.
    pub assumed: Vec<String>,
}

/// Identifies a fabric from a sheet, with the usual laws.
///
/// # Errors
/// A curve or a set of values that gives no law, or a fabric that no fabric is.
pub fn identify(sheet: &Sheet) -> Result<Fit, Error> {
    identify_with(sheet, &Settings::default())
}

/// Identifies a fabric from a sheet.
///
/// Curves come before values, values before assumptions, and each assumption is named. Of several curves of
/// one test and direction the first gives the law, except that loop-bending curves give one law together.
/// What is missing of one direction is taken from the other.
///
/// # Errors
/// A curve or a set of values that gives no law, or a fabric that no fabric is.
pub fn identify_with(sheet: &Sheet, settings: &Settings) -> Result<Fit, Error> {
    let laws: Result<Vec<Vec<Laws>>, Error> = groups(sheet)
        .par_iter()
        .map(|group| Laws::of(group, settings))
        .collect();
    let measured = Measured {
        sheet,
        settings,
        laws: laws?.into_iter().flatten().collect(),
    };
    let mut notes = Vec::new();

    let density = sheet.density().unwrap_or_else(|| {
        notes.push(format!(
            "density: not measured, {} kg/m² taken",
            assumed::DENSITY
        ));
        assumed::DENSITY
    });
    let thickness = sheet.thickness().unwrap_or_else(|| {
        notes.push(format!(
            "thickness: not measured, {} m taken",
            assumed::THICKNESS
        ));
        assumed::THICKNESS
    });
    notes.push(format!(
        "surface_friction: not measured, {SURFACE_FRICTION} taken"
    ));
    let [warp, weft] = both(
        "traction",
        [Direction::Warp, Direction::Weft].map(|direction| measured.traction(direction)),
        &mut notes,
        |notes| measured.assumed_traction(notes),
    )?;
    let [warp_bending, weft_bending] = both(
        "bending",
        [Direction::Warp, Direction::Weft].map(|direction| measured.bending(direction)),
        &mut notes,
        |notes| {
            let law = assumed::bending(density);
            notes.push(
                "bending: not measured, a bending length of 20 mm without friction taken".into(),
            );
            Ok(law)
        },
    )?;
    let shear = measured.shear(&mut notes);
    notes.push("traction in compression: not measured, buckling at 0.2 % taken".into());
    if let Some(locking) = shear.locking {
        let degrees = locking.onset.asin().to_degrees();
        notes.push(format!(
            "shear beyond {degrees:.1}°: not measured, jamming before 60° taken"
        ));
    }
    let fabric = Fabric {
        name: sheet.name.clone(),
        source: sheet.source.trim().to_owned(),
        density,
        thickness,
        surface_friction: SURFACE_FRICTION,
        warp: fabric::Direction {
            traction: warp,
            bending: warp_bending,
        },
        weft: fabric::Direction {
            traction: weft,
            bending: weft_bending,
        },
        shear,
        provenance: Some(Provenance {
            sheet: sheet.name.clone(),
            fitted_by: concat!("drape-fit ", env!("CARGO_PKG_VERSION")).to_owned(),
            assumed: notes.clone(),
        }),
    };
    if let Some(problem) = fabric.problems().into_iter().next() {
        let fabric::Problem { key, message, help } = problem;
        return Err(Error::Impossible { key, message, help });
    }
    let curves = measured.laws.into_iter().map(Laws::into_fit).collect();
    Ok(Fit {
        fabric,
        curves,
        assumed: notes,
    })
}

/// What one curve gave.
enum Laws {
    Traction(Identified<TractionLaw>),
    Bending(Identified<BendingLaw>),
    LoopBending(Identified<BendingLaw>),
    Shear(Identified<ShearLaw>),
}

/// The curves that are identified together, in the order of the sheet: the loop-bending curves of a
/// direction, every other curve by itself.
fn groups(sheet: &Sheet) -> Vec<Vec<&Curve>> {
    let mut groups: Vec<Vec<&Curve>> = Vec::new();
    for curve in &sheet.curves {
        let together = |group: &&mut Vec<&Curve>| {
            curve.test == Test::LoopBending
                && group[0].test == curve.test
                && group[0].direction == curve.direction
        };
        match groups.iter_mut().find(together) {
            Some(group) => group.push(curve),
            None => groups.push(vec![curve]),
        }
    }
    groups
}

impl Laws {
    fn of(group: &[&Curve], settings: &Settings) -> Result<Vec<Self>, Error> {
        let curve = group[0];
        Ok(match curve.test {
            Test::Tensile => vec![Self::Traction(traction(curve, settings.traction)?)],
            Test::Bending => vec![Self::Bending(identify_bending(curve, settings.bending)?)],
            Test::Shear => vec![Self::Shear(identify_shear(curve, settings.shear)?)],
            Test::LoopBending => identify_loop_bending(group)?
                .into_iter()
                .map(Self::LoopBending)
                .collect(),
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

fn traction(curve: &Curve, model: Option<TractionModel>) -> Result<Identified<TractionLaw>, Error> {
    if let Some(model) = model {
        return identify_tensile(curve, model);
    }
    let primed = identify_tensile(curve, TractionModel::Primed)?;
    let polynomial = identify_tensile(curve, TractionModel::Polynomial)?;
    let better = polynomial.fit.misfit < CLEARLY_BETTER * primed.fit.misfit;
    Ok(if better { polynomial } else { primed })
}

/// The sheet with the laws of its curves.
struct Measured<'a> {
    sheet: &'a Sheet,
    settings: &'a Settings,
    laws: Vec<Laws>,
}

/// A law with what had to be assumed for it; nothing where nothing was measured.
type Found<L> = Result<Option<(L, Vec<String>)>, Error>;

impl Measured<'_> {
    fn traction(&self, direction: Direction) -> Found<TractionLaw> {
        let from_curve = self.laws.iter().find_map(|laws| match laws {
            Laws::Traction(found) if found.fit.direction == direction => Some(found.law),
            _ => None,
        });
        if let Some(law) = from_curve {
            let mut notes = Vec::new();
            if law.friction.plateau() == 0.0 {
                let name = direction.name();
                notes.push(format!(
                    "{name} traction friction: no recovery measured, none taken"
                ));
            }
            return Ok(Some((law, notes)));
        }
        tensile_values(
            direction.name(),
            self.sheet.values(direction),
            self.sheet.maximum_tension(),
        )
    }

    fn assumed_traction(&self, notes: &mut Vec<String>) -> Result<TractionLaw, Error> {
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

    fn bending(&self, direction: Direction) -> Found<BendingLaw> {
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
        let name = direction.name();
        let mut notes = Vec::new();
        let Some(rigidity) = values.bending_rigidity() else {
            if values.two_hb.is_some() {
                notes.push(format!("{name} 2HB: not used, because B is missing"));
            }
            return Ok(None);
        };
        let width = values.bending_loop_width().unwrap_or_else(|| {
            notes.push(format!(
                "{name} 2HB: not measured, no bending friction taken"
            ));
            0.0
        });
        if width > 0.0 {
            notes.push(format!(
                "{name} bending friction length: not in 2HB, {} 1/m taken",
                assumed::BENDING_SLIP
            ));
        }
        Ok(Some((bending_from_values(rigidity, width), notes)))
    }

    /// The law of the first shear curve, or of the mean of the values of both directions.
    fn shear(&self, notes: &mut Vec<String>) -> ShearLaw {
        let curve = self.laws.iter().find_map(|laws| match laws {
            Laws::Shear(found) => Some(found.law),
            _ => None,
        });
        if let Some(law) = curve {
            return law;
        }
        let mean = |value: fn(&Values) -> Option<f64>| {
            let values = [value(&self.sheet.warp), value(&self.sheet.weft)];
            let known: Vec<f64> = values.into_iter().flatten().collect();
            (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
        };
        let stiffness = mean(Values::shear_stiffness).unwrap_or_else(|| {
            let taken = assumed::SHEAR_STIFFNESS;
            notes.push(format!(
                "shear stiffness: not measured, {taken} N/(m·rad) taken"
            ));
            taken
        });
        let narrow = mean(Values::shear_loop_width);
        let wide = mean(Values::shear_loop_width_at_five_degrees);
        let widths = match (narrow, wide) {
            (Some(narrow), Some(wide)) => [narrow, wide],
            (Some(width), None) | (None, Some(width)) => {
                notes.push("shear loop: one width measured, the same taken at every angle".into());
                [width, width]
            }
            (None, None) => {
                let taken = assumed::SHEAR_LOOP_WIDTH;
                notes.push(format!(
                    "shear loop: not measured, a width of {taken} N/m taken"
                ));
                [taken, taken]
            }
        };
        let slip = assumed::SHEAR_SLIP;
        notes.push(format!(
            "shear friction length: not in the values, a sine of {slip} taken"
        ));
        shear_from_values(stiffness, widths, &self.settings.shear_points)
    }
}

/// The traction law of the tensile values, if any is there.
fn tensile_values(name: &str, values: &Values, maximum_tension: f64) -> Found<TractionLaw> {
    let (em, lt, wt) = (
        values.tensile_extension(),
        values.tensile_linearity(),
        values.tensile_work(),
    );
    let mut notes = Vec::new();
    let mut assume = |what: &str, value: f64| {
        notes.push(format!("{name} {what}: not measured, {value} taken"));
        value
    };
    // LT, WT and EM are tied by WT = ½·LT·FM·EM: two of them tell the third.
    let half = 0.5 * maximum_tension;
    let (extension, linearity) = match (em, lt, wt) {
        (Some(em), Some(lt), _) => (em, lt),
        (Some(em), None, Some(wt)) => (em, wt / (half * em)),
        (None, Some(lt), Some(wt)) => (wt / (half * lt), lt),
        (Some(em), None, None) => (em, assume("LT", assumed::LINEARITY)),
        (None, None, Some(wt)) => {
            let lt = assume("LT", assumed::LINEARITY);
            (wt / (half * lt), lt)
        }
        (None, _, None) => return Ok(None),
    };
    let resilience = values
        .tensile_resilience()
        .unwrap_or_else(|| assume("RT", assumed::RESILIENCE));
    let target = TensileTarget {
        maximum_tension,
        extension,
        linearity,
        resilience,
    };
    let (law, misfit) = tensile_from_values(&target)?;
    if misfit > 1e-3 {
        notes.push(format!(
            "{name} EM, LT and RT: met to {:.1} % only",
            100.0 * misfit
        ));
    }
    notes.push(format!(
        "{name} traction after stretching: not in the values, as before taken"
    ));
    Ok(Some((law, notes)))
}

/// The laws of both directions; where one is missing the other stands for it.
fn both<L: Copy>(
    what: &str,
    [warp, weft]: [Found<L>; 2],
    notes: &mut Vec<String>,
    assume: impl FnOnce(&mut Vec<String>) -> Result<L, Error>,
) -> Result<[L; 2], Error> {
    let mut take = |found: Option<(L, Vec<String>)>| {
        found.map(|(law, own)| {
            notes.extend(own);
            law
        })
    };
    let (warp, weft) = (take(warp?), take(weft?));
    match (warp, weft) {
        (Some(warp), Some(weft)) => Ok([warp, weft]),
        (Some(warp), None) => {
            notes.push(format!("weft {what}: not measured, the warp's taken"));
            Ok([warp, warp])
        }
        (None, Some(weft)) => {
            notes.push(format!("warp {what}: not measured, the weft's taken"));
            Ok([weft, weft])
        }
        (None, None) => {
            let law = assume(notes)?;
            Ok([law, law])
        }
    }
}
