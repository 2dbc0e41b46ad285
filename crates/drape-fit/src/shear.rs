//! The shear law from a shear loop.

use drape_fabric::{Locking, ShearBackbone, ShearLaw};
use drape_kes::{Curve, Test};

use crate::bending::{friction, friction_starts, half_width, mean_slope, reach, span, zero};
use crate::curve_fit::{self, Identified, Named};
use crate::history::along;
use crate::lm::Parameter;
use crate::{Error, FrictionOrder};

/// Growths of the plateau to start from, per unit of the sine.
const GROWTH_STARTS: [f64; 2] = [0.5, 8.0];
/// Largest growth looked for: a plateau that grows a hundredfold over the KES range.
const LARGEST_GROWTH: f64 = 700.0;

/// Identifies the shear law from a shear curve, along its whole history.
///
/// The law's deformation is the sine of the measured angle, to which the measured force is conjugate. The
/// zero of the force is fitted too. Jamming is not measured by the KES test: it begins where the curve ends.
///
/// # Errors
/// The curve is of another test, has no load, or does not rise.
pub fn identify_shear(curve: &Curve, order: FrictionOrder) -> Result<Identified<ShearLaw>, Error> {
    curve_fit::expect(curve, Test::Shear)?;
    let sines: Vec<f64> = curve
        .deformation()
        .iter()
        .map(|angle| angle.sin())
        .collect();
    let reach = reach(&sines);
    let slope = mean_slope(curve)?;
    let plateau = half_width(curve, 0.3 * reach);
    let stiffness = Parameter::new(slope).between(1e-3 * slope, 10.0 * slope);
    let mut starts: Vec<Vec<Named>> = Vec::new();
    for friction in friction_starts(order, plateau, reach, span(curve)) {
        for growth in GROWTH_STARTS {
            let growth = Parameter::new(growth).between(0.0, LARGEST_GROWTH);
            let mut start = vec![
                ("stiffness", stiffness),
                ("zero", zero(curve)),
                ("growth", growth),
            ];
            start.extend(friction.iter().copied());
            starts.push(start);
        }
    }
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
    let default = Locking::default();
    let onset = default.onset.max(reach);
    let locking = (onset < default.limit).then_some(Locking { onset, ..default });
    Ok(Identified {
        law: ShearLaw {
            locking,
            ..law(&fit.values())
        },
        fit,
    })
}
