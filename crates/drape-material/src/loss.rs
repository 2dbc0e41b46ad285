//! Losses: properties of a fabric that its numbers for other programs do not describe.

use drape_fabric::Fabric;
use drape_kes::Values;

use crate::number::{brief, mean, one_line};
use crate::stretch::Stretch;

/// Relative difference up to which warp and weft count as equal.
const ALIKE: f64 = 0.01;

/// Width of a loop, in SI units, below which the width is a rounding error.
const ROUNDING: f64 = 1e-12;

/// Returns the losses of every format: friction, nonlinearity, assumptions and standard errors of
/// `fabric`. `values` are the results of simulated KES tests, and `stretch` the secants of warp and
/// weft.
pub(crate) fn losses(fabric: &Fabric, values: &[Values; 2], stretch: [Stretch; 2]) -> Vec<String> {
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

/// Returns a description of the internal friction in the tests `values`, which the numbers leave
/// out.
fn friction(values: &[Values; 2]) -> String {
    let [warp, weft] = values.each_ref().map(|values| measure(values.bending_loop_width()));
    let [narrow, wide] =
        [values[0].shear_loop_width(), values[0].shear_loop_width_at_five_degrees()].map(measure);
    let [warp_resilience, weft_resilience] = values.each_ref().map(|values| measure(values.rt));
    format!(
        "Friction and hysteresis: the loops are {warp} and {weft} N wide in bending (2HB, warp and weft), {narrow} \
         and {wide} N/m in shear (2HG, 2HG5), and {warp_resilience} and {weft_resilience} % of the tensile work come back (RT, \
         warp and weft). Cloth of these numbers gives back all of it."
    )
}

/// Returns `value` with three digits, zero for a rounding error, and a dash for no value.
fn measure(value: Option<f64>) -> String {
    value.map_or("–".into(), |value| brief(if value < ROUNDING { 0.0 } else { value }))
}

/// Returns a description of the change of the tensile stiffness of `fabric` with the load.
/// `stretch` are the secants of warp and weft.
fn nonlinearity(fabric: &Fabric, stretch: [Stretch; 2]) -> String {
    let laws = [("warp", &fabric.warp.traction), ("weft", &fabric.weft.traction)];
    let rows = laws.iter().zip(stretch).map(|((direction, law), secant)| {
        let [half, twice] = [0.5, 2.0].map(|factor| {
            let stretch = Stretch::new(law, direction, factor * secant.load);
            stretch.map_or("–".into(), |stretch| brief(stretch.stiffness))
        });
        format!(
            "{direction} {} N/m at {} % ({half} at half the load, {twice} at twice)",
            brief(secant.stiffness),
            brief(100.0 * secant.strain),
        )
    });
    format!(
        "Nonlinearity: the stretch is a secant from rest to {} N/m, {}. Bending is read from 50 to 150 1/m, \
         shear from 0.5° to 2.5°.",
        brief(stretch[0].load),
        rows.collect::<Vec<_>>().join(", "),
    )
}

/// Returns a description of the loss of a `program` with one number for warp and weft. `stretch`
/// are the stiffnesses of both, in N/m, and `bending` the rigidities, in N·m.
pub(crate) fn direction(program: &str, stretch: [f64; 2], bending: [f64; 2]) -> String {
    let mut differences = Vec::new();
    for (name, pair, unit) in [("stretch", stretch, "N/m"), ("bending", bending, "N·m")] {
        if (pair[0] - pair[1]).abs() > ALIKE * mean(pair) {
            let [warp, weft] = pair.map(brief);
            differences.push(format!("{name} {warp} (warp) and {weft} {unit} (weft)"));
        }
    }

    if differences.is_empty() {
        return format!(
            "Direction: {program} has one number for warp and weft, which are alike here."
        );
    }
    let differences = differences.join(", and of ");
    format!("Direction: {program} has one number for warp and weft, the mean of {differences}.")
}
