//! Garments and single panels that fell off their body, or slid from their place on the body.

use crate::measure::garment_parts::{GarmentParts, HungGarment, VerticalExtent};

/// Fraction of its height by which a garment may sink until it rests. A garment that sinks farther
/// has slid.
const SUNK: f64 = 0.25;

/// Height, in m, below which the height of a garment does not count for [`SUNK`]: a flat garment
/// falls onto its body.
const SLIDE_MIN: f64 = 0.3;

/// Height, in m, that a single panel falls without bodies before the run ends. Weight that nothing
/// holds does not come to rest.
const FREE_FALL: f64 = 0.1;

/// Returns a reason to end the run if a garment or a single panel of `parts` is below all bodies at
/// `positions`, so that nothing can hold it.
pub(crate) fn fallen(parts: &GarmentParts, positions: &[f64]) -> Option<String> {
    let ground = parts.ground?;
    let has_bodies = ground < f64::INFINITY;
    let mut garments = parts.garments.iter();
    let HungGarment { name, is_garment, hung, slid, .. } = garments.find(|garment| {
        let now = garment.extent(positions).high;
        // Without bodies a garment may hang from its pins. Single panels that have pins are not in
        // the list, but a program may hold one.
        let has_fallen = !garment.is_garment && garment.hung.high - now > FREE_FALL;
        if has_bodies { now < ground } else { has_fallen }
    })?;
    let what = if *is_garment { "garment" } else { "panel" };
    if !has_bodies {
        return Some(format!("the {what} \"{name}\" falls: there is neither a body nor a pin"));
    }
    let top = hung.high;
    let slide =
        slid.map_or(String::new(), |time| format!(", left its place on the body at {time:.1} s"));
    Some(format!(
        "the {what} \"{name}\" fell off: it was up at {top:.2} m{slide}, and is below {ground:.2} m, where the bodies end"
    ))
}

/// Records `time`, in s, for each garment that has just sunk farther than cloth settles, with the
/// particles at `positions`. Returns a warning for each. Without a body nothing slides.
pub(crate) fn note_slides(parts: &mut GarmentParts, positions: &[f64], time: f64) -> Vec<String> {
    if !parts.has_bodies {
        return Vec::new();
    }
    let garments = parts.garments.iter_mut().filter(|garment| garment.is_garment);
    let slides = garments.filter_map(|garment| {
        let (top, now) = (garment.hung.high, garment.extent(positions).high);
        let slides = garment.slid.is_none() && has_sunk(garment.hung, now);
        slides.then(|| {
            garment.slid = Some(time);
            format!(
                "the garment \"{}\" left its place on the body at {time:.1} s: its top was up at {top:.2} m, and is at \
                 {now:.2} m and sinks",
                garment.name
            )
        })
    });
    slides.collect()
}

/// Returns whether a garment that hung at first from `low` to `high` has sunk farther than cloth
/// settles. `now` is the height of its top, in m.
fn has_sunk(VerticalExtent { low, high: top }: VerticalExtent, now: f64) -> bool {
    top - now > SUNK * (top - low).max(SLIDE_MIN)
}

/// Returns a warning for each garment of `parts` that rests at `positions` after sliding.
pub(crate) fn sunk(parts: &GarmentParts, positions: &[f64]) -> Vec<String> {
    let garments = parts.garments.iter().filter(|garment| garment.is_garment);
    let sunk = garments.filter_map(|garment| {
        let (top, now) = (garment.hung.high, garment.extent(positions).high);
        has_sunk(garment.hung, now).then(|| {
            format!(
                "the garment \"{}\" slid from {top:.2} m to {now:.2} m: nothing holds it there; pin it, take it in, or \
                 raise friction",
                garment.name
            )
        })
    });
    sunk.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_garment_has_sunk_by_a_part_of_its_height_or_of_the_least() {
        let sunk = |low: f64, high: f64, by: f64| has_sunk(VerticalExtent { low, high }, high - by);
        for (low, high) in [(0.4, 1.4), (1.0, 1.3), (1.0, 1.01)] {
            let limit = SUNK * f64::max(high - low, SLIDE_MIN);
            assert!(!sunk(low, high, limit - 1e-6) && sunk(low, high, limit + 1e-6), "{low}");
        }
    }
}
