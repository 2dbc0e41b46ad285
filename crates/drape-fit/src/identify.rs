//! A whole fabric from a sheet.

use drape_fabric::{self as fabric, Fabric, Provenance, SURFACE_FRICTION};
use drape_kes::{BendingPoints, Direction, Model, Reading, ShearPoints, Sheet};

use crate::fabric_keys::standard_errors;
use crate::from_values::bending_from_values;
use crate::measured::{Found, Measured};
use crate::reach::reach;
use crate::{
    CurveFit, Error, FrictionOrder, LoopModel, Plateau, Toe, TractionModel, Weighting, assumed,
};

/// Which laws to identify, how, and where KES values are read.
///
/// Every law that is not set is the one that the sheet asks for, or is chosen by Akaike's criterion, and
/// [`CurveFit::candidates`] says among which.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings {
    /// Elastic load of the traction laws.
    pub traction: Option<TractionModel>,
    /// Whether the priming zone of the traction laws moves.
    pub toe: Option<Toe>,
    /// The bending laws; of those with a line, unless set.
    pub bending: Option<LoopModel>,
    /// The shear law; of those with a line, unless set.
    pub shear: Option<LoopModel>,
    /// Whether the plateau of the shear friction grows.
    pub plateau: Option<Plateau>,
    /// How much each point of a curve counts.
    pub weighting: Weighting,
    /// How the intervals of the parameters are found.
    pub intervals: Intervals,
    /// Where the sheet's B and 2HB were read.
    pub bending_points: BendingPoints,
    /// Where the sheet's G, 2HG and 2HG5 were read.
    pub shear_points: ShearPoints,
}

impl Settings {
    /// The same settings with the bending and shear laws that a sheet asks for, where they leave them open.
    fn or_of(self, model: Option<Model>) -> Self {
        let model = model.map(|model| match model {
            Model::FirstOrder => LoopModel::Linear(FrictionOrder::First),
            Model::TwoElements => LoopModel::Linear(FrictionOrder::Parallel),
            Model::SecondOrder => LoopModel::Linear(FrictionOrder::Second),
            Model::Breen1994 => LoopModel::Piecewise,
        });
        Self { bending: self.bending.or(model), shear: self.shear.or(model), ..self }
    }

    /// Where the values of a sheet are read.
    #[must_use]
    pub fn reading(&self, sheet: &Sheet) -> Reading {
        Reading {
            maximum_tension: sheet.maximum_tension(),
            bending: self.bending_points,
            shear: self.shear_points,
        }
    }
}

/// How the intervals of the parameters are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Intervals {
    /// From the standard errors: right where the law is nearly linear over them.
    #[default]
    Wald,
    /// From the residuals themselves, [`lm::profile`](drape_lm::profile): right for curved laws and at bounds,
    /// for some hundred times the work.
    Profile,
}

/// An identified fabric, with how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The fabric.
    pub fabric: Fabric,
    /// How well a law follows each of the sheet's curves, in the order of the sheet.
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
    let settings = &settings.or_of(sheet.model);
    let measured = Measured::new(sheet, settings)?;
    let mut notes = Vec::new();

    let density = sheet.density().unwrap_or_else(|| {
        notes.push(format!("density: not measured, {} kg/m² taken", assumed::DENSITY));
        assumed::DENSITY
    });
    let thickness = sheet.thickness().unwrap_or_else(|| {
        notes.push(format!("thickness: not measured, {} m taken", assumed::THICKNESS));
        assumed::THICKNESS
    });
    let pressed_thickness = sheet.pressed_thickness();
    if pressed_thickness.is_none() {
        notes.push("pressed_thickness: not measured, 0.7 of the thickness taken".into());
    }
    let surface_friction = sheet.miu.unwrap_or_else(|| {
        notes.push(format!("surface_friction: not measured, {SURFACE_FRICTION} taken"));
        SURFACE_FRICTION
    });
    let [warp, weft] = both(
        "traction",
        [Direction::Warp, Direction::Weft].map(|direction| measured.traction(direction)),
        &mut notes,
        |notes| measured.assumed_traction(notes),
    )?;
    let [warp_bending, weft_bending] = both(
        "bending",
        [Direction::Warp, Direction::Weft].map(|direction| measured.bending(direction, density)),
        &mut notes,
        |notes| {
            let law = bending_from_values(assumed::bending_rigidity(density), 0.0);
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
        notes.push(format!("shear beyond {degrees:.1}°: not measured, jamming before 60° taken"));
    }
    let fits = measured.into_fits();
    let fabric = Fabric {
        name: sheet.name.clone(),
        source: sheet.source.trim().to_owned(),
        density,
        thickness,
        pressed_thickness,
        surface_friction,
        warp: fabric::YarnLaws { traction: warp, bending: warp_bending },
        weft: fabric::YarnLaws { traction: weft, bending: weft_bending },
        shear,
        provenance: Some(Provenance {
            sheet: sheet.name.clone(),
            digest: sheet.digest(),
            fitted_by: concat!("drape-fit ", env!("CARGO_PKG_VERSION")).to_owned(),
            assumed: notes.clone(),
            standard_errors: standard_errors(&fits),
            measured_range: reach(sheet),
        }),
    };
    if let Some(problem) = fabric.problems().into_iter().next() {
        let fabric::Problem { key, message, help } = problem;
        return Err(Error::Impossible { key, message, help });
    }
    Ok(Fit { fabric, curves: fits, assumed: notes })
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
