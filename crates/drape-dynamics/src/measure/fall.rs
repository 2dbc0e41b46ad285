//! Garments that fell off their body, or slid from where they were put.

use crate::measure::garment_parts::{GarmentParts, HungGarment, VerticalExtent};

/// Fraction of its height by which a garment may sink until it rests: more is no settling on the body.
const SUNK: f64 = 0.25;

/// Reason why a run is of no use any more: a garment is below all bodies, and nothing can hold it.
pub(crate) fn fallen(parts: &GarmentParts, positions: &[f64]) -> Option<String> {
    let ground = parts.ground?;
    let below = |garment: &&HungGarment| garment.extent(positions).high < ground;
    let HungGarment { name, hung, .. } = parts.garments.iter().find(below)?;
    let top = hung.high;
    Some(format!(
        "the garment \"{name}\" fell off: it was up at {top:.2} m, and is below {ground:.2} m, where the bodies end"
    ))
}

/// Warnings about garments that rest, but not where they were put.
pub(crate) fn sunk(parts: &GarmentParts, positions: &[f64]) -> Vec<String> {
    let sunk = parts.garments.iter().filter_map(|garment| {
        let VerticalExtent { low, high: top } = garment.hung;
        let now = garment.extent(positions).high;
        (top - now > SUNK * (top - low)).then(|| {
            format!(
                "the garment \"{}\" slid from {top:.2} m to {now:.2} m: nothing holds it there; pin it, take it in, or \
                 raise friction",
                garment.name
            )
        })
    });
    sunk.collect()
}
