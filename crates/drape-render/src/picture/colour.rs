//! Colours: sRGB and linear light, and a diverging scale for signed values.

use std::sync::LazyLock;

/// Colour in sRGB: red, green, blue.
pub type Colour = [u8; 3];

/// Returns the linear light of an sRGB `value` \[IEC61966\].
pub(crate) fn decode(value: u8) -> f64 {
    let value = f64::from(value) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

/// Number of steps of linear light in the table of sRGB values. A step is at most a fifth of an
/// sRGB value, at the dark end.
const STEPS: usize = 1 << 14;

/// sRGB values of evenly spaced linear light. Computing a power for each pixel would take longer
/// than computing its light.
static ENCODED: LazyLock<Vec<u8>> =
    LazyLock::new(|| (0..=STEPS).map(|step| encode_exactly(step as f64 / STEPS as f64)).collect());

/// Returns the nearest sRGB value of linear `light` \[IEC61966\].
pub(crate) fn encode(light: f64) -> u8 {
    ENCODED[(light.clamp(0.0, 1.0) * STEPS as f64 + 0.5) as usize]
}

/// Returns the sRGB value of `light` without the table.
fn encode_exactly(light: f64) -> u8 {
    let value =
        if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    (255.0 * value).round() as u8
}

/// Colours of the lower end, the middle and the upper end of the diverging scale: blue, nearly
/// white, red.
pub(crate) const DIVERGING: [Colour; 3] = [[33, 92, 172], [246, 246, 244], [186, 38, 48]];

/// Colours of the scale from low to high: dark blue, green, yellow, evenly lighter.
pub(crate) const SEQUENTIAL: [Colour; 5] =
    [[37, 35, 92], [32, 99, 141], [33, 153, 134], [122, 199, 82], [250, 228, 66]];

/// Returns the colour at the fraction `part`, 0 to 1, between the first and the last of `stops`,
/// which are evenly spaced.
pub(crate) fn between<const N: usize>(stops: &[Colour; N], part: f64) -> Colour {
    let place = part.clamp(0.0, 1.0) * (N - 1) as f64;
    // The cast rounds down, and makes 0 of NaN.
    let first = (place as usize).min(N.saturating_sub(2));
    let share = place - first as f64;
    std::array::from_fn(|channel| {
        let [from, to] =
            [stops[first], stops[(first + 1).min(N - 1)]].map(|c| f64::from(c[channel]));
        (from + share * (to - from)).round() as u8
    })
}

/// Returns the colour of a `value` on a diverging scale from `-limit` to `limit`.
///
/// Zero is nearly white, negative values are blue, and positive values are red. Values beyond the
/// ends have the colour of the end.
///
/// ```
/// use drape_render::diverging;
///
/// let [red, _, blue] = diverging(-0.02, 0.05);
/// assert!(blue > red);
/// assert_eq!(diverging(0.2, 0.05), diverging(0.05, 0.05));
/// ```
#[must_use]
pub fn diverging(value: f64, limit: f64) -> Colour {
    let fraction = if limit > 0.0 { (value / limit).clamp(-1.0, 1.0) } else { 0.0 };
    between(&DIVERGING, 0.5 + 0.5 * fraction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_colour_comes_back_from_its_light() {
        assert!((0..=255).all(|value| encode(decode(value)) == value));
        assert_eq!([encode(-1.0), encode(7.0), encode(f64::NAN)], [0, 255, 0]);
    }

    #[test]
    fn zero_is_light_and_the_ends_are_kept() {
        assert_eq!(diverging(0.0, 2.0), DIVERGING[1]);
        assert_eq!([diverging(-2.0, 2.0), diverging(9.0, 2.0)], [DIVERGING[0], DIVERGING[2]]);
        let half = diverging(1.0, 2.0);
        assert!(half[0] > half[1] && half[1] > DIVERGING[2][1], "{half:?}");
        assert_eq!(diverging(1.0, 0.0), DIVERGING[1]);
    }
}
