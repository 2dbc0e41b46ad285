//! Colours of panels and bodies in files for other programs.
//!
//! Each panel has a material. Panels of several fabrics have the colours of their fabrics, which
//! `palette` chooses. Panels of one fabric have different colours, so that neighbours can be
//! distinguished.

/// Linear light of red, green and blue, 0 to 1.
pub(crate) type Colour = [f64; 3];

/// Colour of a body: a neutral grey.
pub(crate) const BODY: Colour = [0.45, 0.45, 0.47];

/// Fraction of the circle of hues between the colours of two panels: the golden section, so that no
/// two panels of a garment have similar colours.
const HUE_STEP: f64 = 0.618_034;

/// Hue of the first panel: a light blue.
const HUE: f64 = 0.58;

/// Largest linear light of a panel. Shadows show folds on light cloth.
const LIGHT: f64 = 0.65;

/// Largest fraction of the light that the hue takes away. A stronger hue would look painted.
const STRENGTH: f64 = 0.5;

/// Returns the colour of the panel with the number `index`.
pub(crate) fn panel_colour(index: usize) -> Colour {
    let hue = (HUE + HUE_STEP * index as f64).fract();
    [0.0, 4.0, 2.0].map(|offset| {
        let place = (6.0 * hue + offset).rem_euclid(6.0);
        let missing = 1.0 - (2.0 - (place - 3.0).abs()).clamp(0.0, 1.0);
        // Three digits are more than a screen shows.
        (1000.0 * LIGHT * (1.0 - STRENGTH * (1.0 - missing))).round() / 1000.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_panels_of_a_garment_differ() {
        let colours: Vec<Colour> = (0..12).map(panel_colour).collect();
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
