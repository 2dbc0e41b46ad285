//! The shear law from a shear loop.

use drape_fabric::{BlimanSorine, Locking, ShearBackbone, ShearLaw};
use drape_kes::{Curve, Test};

use crate::bending::{breen, orders, piecewise, reach};
use crate::choice::Model;
use crate::curve_fit::{self, Identified};
use crate::history::along;
use crate::line::{Form, Line, Loop};
use crate::{Error, LoopModel, Plateau, Settings};

/// Identifies the shear law from a shear curve.
///
/// The law's deformation is the sine of the measured angle, to which the measured force is conjugate. A line
/// with friction is driven along the whole history, and the zero of the force is fitted too. A quadratic and
/// a line is fitted to the first loading branch. Jamming is not measured by the KES test: it begins where
/// the curve ends.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_shear(curve: &Curve, settings: &Settings) -> Result<Identified<ShearLaw>, Error> {
    curve_fit::expect(curve, Test::Shear)?;
    let angles = curve.deformation().iter();
    let sines: Vec<f64> = angles.map(|angle| angle.sin()).collect();
    let found = match settings.shear {
        Some(LoopModel::Piecewise) => {
            let law = |p: &[f64]| ShearLaw {
                backbone: ShearBackbone::Piecewise(piecewise(p)),
                friction: BlimanSorine::none(),
                growth: 0.0,
                locking: None,
            };
            let fit = breen(curve, (&sines, settings), |p, path, out| {
                along(&law(p), path.iter().copied(), out);
            })?;
            Identified { law: law(&fit.values()), fit }
        }
        _ => line(curve, &sines, settings)?,
    };
    let default = Locking::default();
    let onset = default.onset.max(reach(&sines));
    let locking = (onset < default.limit).then_some(Locking { onset, ..default });
    Ok(Identified { law: ShearLaw { locking, ..found.law }, ..found })
}

fn line(curve: &Curve, sines: &[f64], settings: &Settings) -> Result<Identified<ShearLaw>, Error> {
    let law = |line: &Line| ShearLaw {
        backbone: ShearBackbone::Linear { stiffness: line.stiffness },
        friction: line.friction,
        growth: line.growth,
        locking: None,
    };
    let search = Loop::new(curve, ("stiffness", sines))?;
    let plateaus: Vec<Plateau> = match settings.plateau {
        Some(plateau) => vec![plateau],
        None => vec![Plateau::Constant, Plateau::Growing],
    };
    let forms: Vec<Form> = orders(settings.shear)
        .flat_map(|order| plateaus.iter().map(move |&plateau| Form { order, plateau }))
        .collect();
    let model = |form: &Form| {
        let plateau = match form.plateau {
            Plateau::Constant => "constant plateau",
            Plateau::Growing => "growing plateau",
        };
        search.model(*form, format!("{}, {plateau}", form.order.name()))
    };
    let models: Vec<Model<'_>> = forms.iter().map(model).collect();
    let weights = settings.weighting.weights(curve, 0.0);
    let fit = curve_fit::fit(curve, &models, (weights, settings.intervals));
    let (line, _) = forms[fit.chosen].law(&fit.values());
    Ok(Identified { law: law(&line), fit })
}
