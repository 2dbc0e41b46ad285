//! Losses: what of a fabric its numbers for other programs do not say.

use drape_fabric::Fabric;
use drape_kes::Values;

use crate::number::{brief, mean, one_line};
use crate::stretch::Stretch;

/// Share by which warp and weft may differ without a word.
const ALIKE: f64 = 0.01;

/// Width of a loop, in its SI unit, below which it is rounding.
const ROUNDING: f64 = 1e-12;

/// Returns what the numbers of a fabric lose, whatever the format: friction, nonlinearity, what was
/// assumed and how well it is known.
pub(crate) fn of(fabric: &Fabric, values: &[Values; 2], stretch: [Stretch; 2]) -> Vec<String> {
    let mut losses = vec![friction(values), nonlinearity(fabric, stretch)];
    let rest = [fabric.warp.bending.rest_curvature, fabric.weft.bending.rest_curvature];
    if rest != [0.0; 2] {
        losses.push(format!(
            "Curl: the fabric is bent by {} and {} 1/m at rest (warp and weft); the numbers are of a flat one.",
            brief(rest[0]),
            brief(rest[1]),
        ));
    }
    if fabric.shear.locking.is_some() {
        losses.push(
            "Locking: the yarns jam at a large shear angle; the numbers go on as a line.".into(),
        );
    }
    if let Some(provenance) = &fabric.provenance {
        let assumed = provenance.assumed.iter();
        losses.extend(assumed.map(|text| format!("Assumed: {}.", one_line(text))));
        if !provenance.standard_errors.is_empty() {
            losses.push("Standard errors of the fit: they are in fabric.toml.".into());
        }
    }
    losses
}

/// Describes the friction within the fabric, which the numbers leave out.
fn friction(values: &[Values; 2]) -> String {
    let width = |width: Option<f64>| {
        width.map_or("–".into(), |width| brief(if width < ROUNDING { 0.0 } else { width }))
    };
    let [warp, weft] = values.each_ref().map(|values| width(values.bending_loop_width()));
    let [narrow, wide] =
        [values[0].shear_loop_width(), values[0].shear_loop_width_at_five_degrees()].map(width);
    let [resilience, other] = values.each_ref().map(|values| width(values.rt));
    format!(
        "Friction and hysteresis: the loops are {warp} and {weft} N wide in bending (2HB, warp and weft), {narrow} \
         and {wide} N/m in shear (2HG, 2HG5), and {resilience} and {other} % of the tensile work come back (RT, \
         warp and weft). Cloth of these numbers gives back all of it."
    )
}

/// Describes how the tensile stiffness changes with the load at which it is read.
fn nonlinearity(fabric: &Fabric, stretch: [Stretch; 2]) -> String {
    let laws = [("warp", &fabric.warp.traction), ("weft", &fabric.weft.traction)];
    let rows = laws.iter().zip(stretch).map(|((direction, law), at)| {
        let other = |load: f64| {
            let stretch = Stretch::of(law, direction, load);
            stretch.map_or("–".into(), |stretch| brief(stretch.stiffness))
        };
        format!(
            "{direction} {} N/m at {} % ({} at half the load, {} at twice)",
            brief(at.stiffness),
            brief(100.0 * at.strain),
            other(0.5 * at.load),
            other(2.0 * at.load),
        )
    });
    format!(
        "Nonlinearity: the stretch is a secant from rest to {} N/m, {}. Bending is read from 50 to 150 1/m, \
         shear from 0.5° to 2.5°.",
        brief(stretch[0].load),
        rows.collect::<Vec<_>>().join(", "),
    )
}

/// Describes what a program loses that has one number for warp and weft, by stretch (N/m) and bending
/// rigidity (N·m) of both.
pub(crate) fn direction(program: &str, stretch: [f64; 2], bending: [f64; 2]) -> String {
    let apart = |pair: [f64; 2]| (pair[0] - pair[1]).abs() > ALIKE * mean(pair);
    let both = |name: &str, pair: [f64; 2], unit: &str| {
        let [warp, weft] = pair.map(brief);
        apart(pair).then(|| format!("{name} {warp} (warp) and {weft} {unit} (weft)"))
    };
    let named = [both("stretch", stretch, "N/m"), both("bending", bending, "N·m")];
    let named: Vec<String> = named.into_iter().flatten().collect();
    if named.is_empty() {
        return format!(
            "Direction: {program} has one number for warp and weft, which are alike here."
        );
    }
    let named = named.join(", and of ");
    format!("Direction: {program} has one number for warp and weft, the mean of {named}.")
}
