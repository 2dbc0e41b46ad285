//! The shear law from a shear loop.

use drape_fabric::{BlimanSorine, Locking, ShearBackbone, ShearLaw};
use drape_kes::{Curve, Test};

use crate::bending::{
    first_branch, friction, friction_starts, half_width, mean_slope, piecewise, piecewise_starts,
    reach, span, zero,
};
use crate::curve_fit::{self, Identified, Named};
use crate::history::along;
use crate::lm::Parameter;
use crate::{Error, FrictionOrder, LoopModel};

/// Growths of the plateau to start from, per unit of the sine.
const GROWTH_STARTS: [f64; 2] = [0.5, 8.0];
/// Largest growth looked for: a plateau that grows a hundredfold over the KES range.
const LARGEST_GROWTH: f64 = 700.0;

/// Identifies the shear law from a shear curve.
///
/// The law's deformation is the sine of the measured angle, to which the measured force is conjugate. A line
/// with friction is driven along the whole history, and the zero of the force is fitted too. A quadratic and
/// a line is fitted to the first loading branch. Jamming is not measured by the KES test: it begins where
/// the curve ends.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_shear(curve: &Curve, model: LoopModel) -> Result<Identified<ShearLaw>, Error> {
    curve_fit::expect(curve, Test::Shear)?;
    let found = match model {
        LoopModel::Linear(order) => linear(curve, order)?,
        LoopModel::Piecewise => breen(curve)?,
    };
    let default = Locking::default();
    let onset = default.onset.max(reach(&sines(curve)));
    let locking = (onset < default.limit).then_some(Locking { onset, ..default });
    Ok(Identified {
        law: ShearLaw {
            locking,
            ..found.law
        },
        ..found
    })
}

fn sines(curve: &Curve) -> Vec<f64> {
    curve
        .deformation()
        .iter()
        .map(|angle| angle.sin())
        .collect()
}

fn linear(curve: &Curve, order: FrictionOrder) -> Result<Identified<ShearLaw>, Error> {
    let sines = sines(curve);
    let reach = reach(&sines);
    let slope = mean_slope(curve)?;
    let plateau = half_width(curve, 0.3 * reach);
    let own = |growth: f64| {
        [
            (
                "stiffness",
                Parameter::new(slope).between(1e-3 * slope, 10.0 * slope),
            ),
            ("zero", zero(curve)),
            (
                "growth",
                Parameter::new(growth).between(0.0, LARGEST_GROWTH),
            ),
        ]
    };
    let starts: Vec<Vec<Named>> = friction_starts(order, plateau, reach, span(curve))
        .iter()
        .flat_map(|friction| {
            GROWTH_STARTS.map(|growth| own(growth).into_iter().chain(friction.clone()).collect())
        })
        .collect();
    let law = |p: &[f64]| ShearLaw {
        backbone: ShearBackbone::Linear { stiffness: p[0] },
        friction: friction(&p[3..]),
        growth: p[2],
        locking: None,
    };
    let fit = curve_fit::fit(curve, &starts, |p, out| {
        along(&law(p), sines.iter().copied(), out);
        out.iter_mut().for_each(|load| *load += p[1]);
    });
    Ok(Identified {
        law: law(&fit.values()),
        fit,
    })
}

fn breen(curve: &Curve) -> Result<Identified<ShearLaw>, Error> {
    let first = first_branch(curve)?;
    let law = |p: &[f64]| ShearLaw {
        backbone: ShearBackbone::Piecewise(piecewise(p)),
        friction: BlimanSorine::none(),
        growth: 0.0,
        locking: None,
    };
    let branch = sines(&first);
    let mut fit = curve_fit::fit(&first, &piecewise_starts(&first)?, |p, out| {
        along(&law(p), branch.iter().copied(), out);
    });
    let law = law(&fit.values());
    fit.load.resize(curve.load().len(), 0.0);
    along(&law, sines(curve).into_iter(), &mut fit.load);
    Ok(Identified { law, fit })
}
