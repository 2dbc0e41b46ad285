//! Cost of the simulation of garments, as far as it can be told in advance.

use drape_input::figure;

/// Least number of particles of a garment that takes long.
const MANY: usize = 20_000;

/// Processor time in s that a garment of one particle would take to be sewn and come to rest, and
/// the exponent by which that grows: from the three shipped ones at 10 mm and one of them at 5 mm,
/// which are within a factor of 1.8 of it. The trousers at 5 mm take 1.3 times as long, and the
/// skirt, which is slow to rest, 3.7 times.
const SECONDS: f64 = 1.3e-3;
const GROWTH: f64 = 1.3;

/// Number of particles of a coarse garment.
const FEW: f64 = 20_000.0;

/// Least number of particles of a garment for which a coarser grid gains time.
const SMALL: f64 = 4000.0;

/// Returns a note on the cost of garments with this number of `particles` at `spacing`, in m.
/// Returns `None` if the cost is low. The garments are not sewn on coarser grids.
pub(crate) fn cost(particles: usize, spacing: f64) -> Option<String> {
    if particles < MANY {
        return None;
    }
    let mut grids = Vec::new();
    let mut factor = 2.0;
    while particles as f64 * (factor / 2.0_f64).powi(-2) > SMALL {
        grids.insert(0, format!("\"{} mm\"", figure(1e3 * factor * spacing)));
        factor *= 2.0;
    }
    let hours = SECONDS * (particles as f64).powf(GROWTH) / 3600.0;
    // In whole millimetres, as a person would write it.
    let coarser = (1e3 * spacing * (particles as f64 / FEW).sqrt()).ceil();
    let fewer = particles as f64 * (1e3 * spacing / coarser).powi(2);
    Some(format!(
        "{particles} particles at a spacing of {:.1} mm: expect some {hours:.1} hours of processor until they rest; \
         {coarser:.0} mm has {:.0} thousand, and with [refine] spacings = [{}] they take less than half of the time",
        1e3 * spacing,
        1e-3 * fewer,
        grids.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_takes_hours_is_said_with_a_spacing_that_does_not() {
        let note = cost(193_000, 0.002).expect("many");
        assert!(
            note.contains("193000 particles")
                && note.contains("2.7 hours")
                && note.contains("7 mm has 16 thousand")
                && note.contains("spacings = [\"16 mm\", \"8 mm\", \"4 mm\"]"),
            "{note}"
        );
        assert!(cost(10_000, 0.01).is_none());
    }
}
