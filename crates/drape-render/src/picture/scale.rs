//! Colour scale: the colours of the values in a range.

use super::colour::{Colour, DIVERGING, SEQUENTIAL, between};
use crate::error::Error;

/// Colours of the values in a range.
///
/// ```
/// use drape_render::ColourScale;
///
/// let speed = ColourScale::new([0.0, 2.0], false)?;
/// assert_eq!(speed.colour(5.0), speed.colour(2.0), "beyond its ends it has the colours of the ends");
/// // About zero of signed values, nearly white, blue is below and red above.
/// let [red, _, blue] = ColourScale::new([-1.0, 1.0], true)?.colour(0.5);
/// assert!(red > blue);
/// # Ok::<(), drape_render::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColourScale {
    range: [f64; 2],
    is_signed: bool,
}

impl ColourScale {
    /// Returns the scale of a `range`. The values of a scale that `is_signed` may be negative.
    ///
    /// # Errors
    /// The range is not finite, or has no width.
    pub fn new(range: [f64; 2], is_signed: bool) -> Result<ColourScale, Error> {
        let [low, high] = range;
        if range.iter().all(|end| end.is_finite()) && low < high {
            return Ok(ColourScale { range, is_signed });
        }
        Err(Error::NoRange { low, high })
    }

    /// Returns the lower and the upper end of the `range`.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Returns the colour of a `value`.
    #[must_use]
    pub fn colour(&self, value: f64) -> Colour {
        let [low, high] = self.range;
        let value = value.clamp(low, high);
        if self.is_signed {
            let limit = low.abs().max(high.abs());
            return between(&DIVERGING, 0.5 + 0.5 * value / limit);
        }
        between(&SEQUENTIAL, (value - low) / (high - low))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_middle_have_the_colours_of_the_stops() {
        let [signed, plain] =
            [true, false].map(|is_signed| ColourScale::new([-2.0, 2.0], is_signed).expect("it is"));
        assert_eq!([-9.0, 0.0, 2.0].map(|value| signed.colour(value)), DIVERGING);
        let places = [-2.0, -1.0, 0.0, 1.0, 2.0];
        assert_eq!(places.map(|value| plain.colour(value)), SEQUENTIAL);
        // Zero stays white where the range is not about it.
        let aside = ColourScale::new([-1.0, 4.0], true).expect("a range");
        assert_eq!([aside.colour(0.0), aside.colour(4.0)], [DIVERGING[1], DIVERGING[2]]);
        for range in [[1.0, 1.0], [2.0, 1.0], [f64::NAN, 1.0], [0.0, f64::INFINITY]] {
            let refused = ColourScale::new(range, false).expect_err("no range");
            assert!(matches!(refused, Error::NoRange { .. }), "{refused}");
        }
    }
}
