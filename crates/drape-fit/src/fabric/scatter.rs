//! Standard errors of laws that come from values, by the standard deviations of the values.

use std::collections::{BTreeMap, BTreeSet};

use drape_fabric::{
    BendingBackbone, BlimanSorine, Fabric, Piecewise, ShearBackbone, TractionBackbone,
    TractionFriction, Varying, YarnLaws,
};
use drape_kes::{Direction, Scatter, Sheet};

use crate::fabric::keys::FittedErrors;

/// Step by which a value is changed for a derivative, as a share of the value: above the tolerance to
/// which laws meet their values, and small against what bends a law.
const STEP: f64 = 0.01;

/// Correlation below which numbers have no value in common: more than laws are matched to.
const CORRELATION_MIN: f64 = 1e-6;

/// Returns the errors of the numbers of a fabric, where they come from values with a stated standard
/// deviation.
///
/// ```text
/// c(p, q) = Σ (∂p/∂v · s(v)) (∂q/∂v · s(v))
/// ```
///
/// over the values `v`, taken as independent of each other; derivatives are central differences. Laws
/// that a curve gives are left out. `None` where a value close by has no law, or one of another form.
pub(crate) fn fitted_errors(
    sheet: &Sheet,
    of_curves: &BTreeSet<String>,
    identified: impl Fn(&Sheet) -> Option<Fabric>,
) -> Option<FittedErrors> {
    let mut errors = FittedErrors::default();
    if sheet.scatter.is_empty() {
        return Some(errors);
    }
    // Of each number, the effect of each value.
    let mut all: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let mut values = sheet.clone();
    (values.curves, values.scatter) = (Vec::new(), Vec::new());
    for (index, stated) in independent(sheet).enumerate() {
        for (key, effect) in effects(&values, stated, &identified)? {
            let own = all.entry(key).or_default();
            own.resize(index, 0.0);
            own.push(effect);
        }
    }
    let is_of_curve = |key: &String| of_curves.iter().any(|law| key.starts_with(law));
    let norm = |effects: &[f64]| effects.iter().map(|effect| effect * effect).sum::<f64>().sqrt();
    all.retain(|key, effects| norm(effects) > 0.0 && !is_of_curve(key));
    for (key, effects) in &all {
        errors.standard.insert(key.clone(), norm(effects));
        for (other, others) in all.range::<String, _>(..key) {
            let product: f64 = effects.iter().zip(others).map(|(a, b)| a * b).sum();
            let correlation = product / (norm(effects) * norm(others));
            // What has no value in common is independent.
            if correlation.abs() > CORRELATION_MIN {
                errors.correlate(key, other, correlation.clamp(-1.0, 1.0));
            }
        }
    }
    Some(errors)
}

/// Returns the stated deviations that are independent: of a value for both directions, that of the warp.
fn independent(sheet: &Sheet) -> impl Iterator<Item = &Scatter> {
    let is_shared = |stated: &Scatter| sheet.shared.contains(&stated.symbol.name());
    sheet.scatter.iter().filter(move |s| !is_shared(s) || s.direction == Direction::Warp)
}

/// Returns the change of each number of the fabric by one standard deviation of a value; `None` where
/// the changed value has no law, or one of another form.
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
    let changed = |by: f64| {
        let mut sheet = values.clone();
        let Sheet { warp, weft, .. } = &mut sheet;
        for (own, values) in [(Direction::Warp, warp), (Direction::Weft, weft)] {
            if own == direction || is_shared {
                *values.get_mut(symbol) = Some(value + by);
            }
        }
        identified(&sheet).map(|fabric| numbers(&fabric))
    };
    let (above, below) = (changed(step)?, changed(-step)?);
    let pairs = above.into_iter().zip(below);
    let effect = |((key, above), (other, below)): ((String, f64), (String, f64))| {
        (key == other).then_some((key, deviation * (above - below) / (2.0 * step)))
    };
    pairs.map(effect).collect()
}

/// Returns the numbers of the laws by their key paths.
fn numbers(fabric: &Fabric) -> Vec<(String, f64)> {
    let mut numbers = Vec::new();
    for (direction, laws) in [(Direction::Warp, &fabric.warp), (Direction::Weft, &fabric.weft)] {
        of_yarns(laws).into_iter().for_each(|(key, number)| {
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

fn of_yarns(laws: &YarnLaws) -> Vec<(String, f64)> {
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
    let named = |law: &'static str| move |(key, number)| (format!("{law}.{key}"), number);
    traction.map(named("traction")).chain(bending.map(named("bending"))).collect()
}

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

fn varying(law: &Varying) -> Vec<(String, f64)> {
    vec![
        ("varying.initial_stiffness".to_owned(), law.initial_stiffness),
        ("varying.final_stiffness".to_owned(), law.final_stiffness),
        ("varying.transition".to_owned(), law.transition),
    ]
}

fn piecewise(law: &Piecewise) -> Vec<(String, f64)> {
    vec![
        ("piecewise.slope".to_owned(), law.slope),
        ("piecewise.intercept".to_owned(), law.intercept),
        ("piecewise.knot".to_owned(), law.knot),
    ]
}

fn friction(friction: &BlimanSorine) -> impl Iterator<Item = (String, f64)> {
    friction.elements.iter().enumerate().flat_map(|(index, element)| {
        [
            (format!("friction[{index}].plateau"), element.plateau),
            (format!("friction[{index}].length"), element.length),
        ]
    })
}
