//! Standard errors of laws from the standard deviations of values.

use std::collections::{BTreeMap, BTreeSet};

use drape_fabric::{
    BendingBackbone, BlimanSorine, Fabric, Piecewise, ShearBackbone, TractionBackbone,
    TractionFriction, Varying, YarnLaws,
};
use drape_kes::{Direction, Scatter, Sheet};

use crate::fabric::keys::FittedErrors;

/// Step of a value for a derivative, over the value. The step is larger than the tolerance to which
/// laws meet their values, and small against the curvature of a law.
const STEP: f64 = 0.01;

/// Correlation below which two numbers have no value in common, larger than the tolerance to which
/// laws meet their values.
const CORRELATION_MIN: f64 = 1e-6;

/// Returns the errors of the numbers of a fabric that come from values with a stated standard
/// deviation.
///
/// ```text
/// c(p, q) = Σ (∂p/∂v · s(v)) (∂q/∂v · s(v))
/// ```
///
/// over the values `v`, taken as independent of each other. Derivatives are central differences.
/// Laws of the keys `of_curves` are skipped, because a curve gives them. Returns `None` if a value
/// nearby has no law, or a law of another form.
pub(crate) fn fitted_errors(
    sheet: &Sheet,
    of_curves: &BTreeSet<String>,
    identified: impl Fn(&Sheet) -> Option<Fabric>,
) -> Option<FittedErrors> {
    let mut errors = FittedErrors::default();
    if sheet.scatter.is_empty() {
        return Some(errors);
    }
    // For each number, the effect of each value.
    let mut all: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let mut values = sheet.clone();
    (values.curves, values.scatter) = (Vec::new(), Vec::new());
    for (index, stated) in independent(sheet).enumerate() {
        for (key, effect) in effects(&values, stated, &identified)? {
            let row = all.entry(key).or_default();
            row.resize(index, 0.0);
            row.push(effect);
        }
    }

    all.retain(|key, effects| {
        norm(effects) > 0.0 && !of_curves.iter().any(|law| key.starts_with(law))
    });
    for (key, effects) in &all {
        errors.standard.insert(key.clone(), norm(effects));
        for (other, others) in all.range::<String, _>(..key) {
            let product: f64 = effects.iter().zip(others).map(|(a, b)| a * b).sum();
            let correlation = product / (norm(effects) * norm(others));
            // Numbers without a value in common are independent.
            if correlation.abs() > CORRELATION_MIN {
                errors.correlate(key, other, correlation.clamp(-1.0, 1.0));
            }
        }
    }
    Some(errors)
}

/// Returns the root of the sum of squares of `effects`.
fn norm(effects: &[f64]) -> f64 {
    effects.iter().map(|effect| effect * effect).sum::<f64>().sqrt()
}

/// Returns the stated deviations of `sheet` that are independent. A value for both directions
/// counts once, for the warp.
fn independent(sheet: &Sheet) -> impl Iterator<Item = &Scatter> {
    sheet.scatter.iter().filter(|stated| {
        stated.direction == Direction::Warp || !sheet.shared.contains(&stated.symbol.name())
    })
}

/// Returns the change of each number of the fabric by one standard deviation of a value. Returns
/// `None` if the changed value has no law, or a law of another form.
fn effects(
    values: &Sheet,
    stated: &Scatter,
    identified: impl Fn(&Sheet) -> Option<Fabric>,
) -> Option<Vec<(String, f64)>> {
    let Scatter { direction, symbol, deviation } = *stated;
    let is_shared = values.shared.contains(&symbol.name());
    let value = values.values(direction).get(symbol)?;
    let step = STEP * value.abs();
    if step == 0.0 {
        return None;
    }
    let mut fabrics = Vec::with_capacity(2);
    for change in [step, -step] {
        let mut sheet = values.clone();
        let Sheet { warp, weft, .. } = &mut sheet;
        for (side, values) in [(Direction::Warp, warp), (Direction::Weft, weft)] {
            if side == direction || is_shared {
                *values.get_mut(symbol) = Some(value + change);
            }
        }
        fabrics.push(numbers(&identified(&sheet)?));
    }
    let below = fabrics.pop()?;
    let above = fabrics.pop()?;
    above
        .into_iter()
        .zip(below)
        .map(|((key, above), (other, below))| {
            (key == other).then_some((key, deviation * (above - below) / (2.0 * step)))
        })
        .collect()
}

/// Returns the numbers of the laws of `fabric` by their key paths.
fn numbers(fabric: &Fabric) -> Vec<(String, f64)> {
    let mut numbers = Vec::new();
    for (direction, laws) in [(Direction::Warp, &fabric.warp), (Direction::Weft, &fabric.weft)] {
        numbers_of_yarns(laws).into_iter().for_each(|(key, number)| {
            numbers.push((format!("{}.{key}", direction.name()), number));
        });
    }
    let backbone = match fabric.shear.backbone {
        ShearBackbone::Linear { stiffness } => vec![("stiffness".to_owned(), stiffness)],
        ShearBackbone::Varying(law) => varying(&law),
        ShearBackbone::Piecewise(law) => piecewise(&law),
    };
    let growth = ("growth".to_owned(), fabric.shear.growth);
    let shear = backbone.into_iter().chain([growth]).chain(friction(&fabric.shear.friction));
    numbers.extend(shear.map(|(key, number)| (format!("shear.{key}"), number)));
    numbers
}

/// Returns the numbers of the `laws` of one direction by their keys.
fn numbers_of_yarns(laws: &YarnLaws) -> Vec<(String, f64)> {
    let traction = match laws.traction.backbone {
        TractionBackbone::Exponential(toe) => vec![
            ("exponential.base_stiffness".to_owned(), toe.base_stiffness),
            ("exponential.stiffness".to_owned(), toe.stiffness),
            ("exponential.steepness".to_owned(), toe.steepness),
            ("exponential.toe_strain".to_owned(), toe.toe_strain),
        ],
        TractionBackbone::Primed(law) => vec![
            ("primed.stiffness".to_owned(), law.stiffness),
            ("primed.toe_ratio".to_owned(), law.toe_ratio),
            ("primed.toe_strain".to_owned(), law.toe_strain),
        ],
        TractionBackbone::Polynomial(law) => vec![
            ("polynomial.quadratic".to_owned(), law.quadratic),
            ("polynomial.quartic".to_owned(), law.quartic),
        ],
    };
    let bending = match laws.bending.backbone {
        BendingBackbone::Linear { rigidity } => vec![("rigidity".to_owned(), rigidity)],
        BendingBackbone::Varying(law) => varying(&law),
        BendingBackbone::Piecewise(law) => piecewise(&law),
    };
    let traction = traction.into_iter().chain(traction_friction(&laws.traction.friction));
    let bending = bending.into_iter().chain(friction(&laws.bending.friction));
    traction
        .map(|(key, number)| (format!("traction.{key}"), number))
        .chain(bending.map(|(key, number)| (format!("bending.{key}"), number)))
        .collect()
}

/// Returns the numbers of a friction `law` of traction by their keys.
fn traction_friction(law: &TractionFriction) -> Vec<(String, f64)> {
    match law {
        TractionFriction::Plateau(law) => friction(law).collect(),
        TractionFriction::Proportional(law) => vec![
            ("proportional_friction.ratio".to_owned(), law.ratio),
            ("proportional_friction.plateau".to_owned(), law.plateau),
            ("proportional_friction.length".to_owned(), law.length),
        ],
    }
}

/// Returns the numbers of a varying stiffness by their keys.
fn varying(law: &Varying) -> Vec<(String, f64)> {
    vec![
        ("varying.initial_stiffness".to_owned(), law.initial_stiffness),
        ("varying.final_stiffness".to_owned(), law.final_stiffness),
        ("varying.transition".to_owned(), law.transition),
    ]
}

/// Returns the numbers of a piecewise `law` by their keys.
fn piecewise(law: &Piecewise) -> Vec<(String, f64)> {
    vec![
        ("piecewise.slope".to_owned(), law.slope),
        ("piecewise.intercept".to_owned(), law.intercept),
        ("piecewise.knot".to_owned(), law.knot),
    ]
}

/// Returns the numbers of each element of a `friction` by their keys.
fn friction(friction: &BlimanSorine) -> impl Iterator<Item = (String, f64)> {
    friction.elements.iter().enumerate().flat_map(|(index, element)| {
        [
            (format!("friction[{index}].plateau"), element.plateau),
            (format!("friction[{index}].length"), element.length),
        ]
    })
}
