//! Colours of panels and bodies in files for other programs.
//!
//! Each panel has a material. Panels of several fabrics have the colours of their fabrics, which
//! `palette` chooses. Panels of one fabric have different colours, so that one can be told from the next.

/// Linear light of red, green and blue, 0 to 1.
pub(crate) type Colour = [f64; 3];

/// Colour of a body: a neutral grey.
pub(crate) const BODY: Colour = [0.45, 0.45, 0.47];

/// Part of the circle of hues between two panels: the golden section, so that no two of a garment
/// come out alike.
const HUE_STEP: f64 = 0.618_034;

/// Hue of the first panel: a light blue.
const HUE: f64 = 0.58;

/// Largest linear light of a panel, and the part of it that the hue takes away at most: light, since
/// shadows show folds on light cloth, and not so strong that a garment looks painted.
const LIGHT: f64 = 0.65;
const STRENGTH: f64 = 0.5;

/// Returns the colour of a panel.
pub(crate) fn of_panel(index: usize) -> Colour {
    let hue = (HUE + HUE_STEP * index as f64).fract();
    let part = |offset: f64| {
        let place = (6.0 * hue + offset).rem_euclid(6.0);
        let missing = 1.0 - (2.0 - (place - 3.0).abs()).clamp(0.0, 1.0);
        // Three digits are more than a screen shows.
        (1000.0 * LIGHT * (1.0 - STRENGTH * (1.0 - missing))).round() / 1000.0
    };
    [part(0.0), part(4.0), part(2.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_panels_of_a_garment_differ() {
        let colours: Vec<Colour> = (0..12).map(of_panel).collect();
        let [red, green, blue] = colours[0];
        assert!(red < green && green < blue, "the first is blue: {:?}", colours[0]);
        for (index, one) in colours.iter().enumerate() {
            assert!(one.iter().all(|part| (0.2..=LIGHT).contains(part)), "{one:?}");
            for other in &colours[..index] {
                let apart: f64 = (0..3).map(|k| (one[k] - other[k]).abs()).sum();
                assert!(apart > 0.05, "{one:?} and {other:?}");
            }
        }
    }
}
