//! Legend: a scale of colours with its name, its unit and its range, below a picture.

use super::colour::Colour;
use super::lettering::Lettering;
use super::pixels::Picture;
use super::scale::ColourScale;

/// Width of the bar, as a fraction of the width of the picture.
const BAR: f64 = 0.4;
/// Smallest and largest width of the bar, in heights of a line.
const BAR_WITHIN: [f64; 2] = [10.0, 28.0];

/// Height of the strip that the legend takes, in heights of a line.
const HEIGHT: f64 = 3.9;

/// Scale of colours of a picture, with words.
#[derive(Debug, Clone, PartialEq)]
pub struct Legend {
    /// Name of the quantity.
    pub name: String,
    /// Unit of the quantity.
    pub unit: String,
    /// Colours of the values, in `unit`.
    pub scale: ColourScale,
    /// Texts below the lower end, the middle and the upper end of the scale.
    pub labels: [String; 3],
}

impl Legend {
    /// Returns the height of the legend of a picture, in pixels. `whole` is the height of both
    /// together.
    #[must_use]
    pub fn height(whole: u32) -> u32 {
        (HEIGHT * f64::from(Lettering::for_height(whole).height())) as u32
    }

    /// Returns a `picture` with the legend below it, on a strip of the colour `ground`.
    #[must_use]
    pub fn below(&self, picture: &Picture, ground: Colour) -> Picture {
        let letters = Lettering::for_extended(picture.height(), HEIGHT);
        let line = letters.height();
        let height = (HEIGHT * f64::from(line)) as u32;

        let mut whole = picture.extended(height, ground);
        let [least, most] = BAR_WITHIN.map(|lines| lines * f64::from(line));
        let bar = (BAR * f64::from(picture.width())).clamp(least, most) as u32;
        let bar = bar.min(picture.width().saturating_sub(2 * line)).max(2);
        let (left, top) = ((picture.width() - bar.min(picture.width())) / 2, picture.height());
        let [low, high] = self.scale.range();
        let centred = |text: &str, at: u32| {
            let latest = picture.width().saturating_sub(letters.width(text));
            at.saturating_sub(letters.width(text) / 2).min(latest)
        };

        let title = format!("{}, {}", self.name, self.unit);
        letters.write(&title, [centred(&title, left + bar / 2), top + line / 3], &mut whole);
        for column in 0..bar {
            let part = (f64::from(column) + 0.5) / f64::from(bar);
            let colour = self.scale.colour(low + part * (high - low));
            for row in 0..line * 3 / 4 {
                if let Some(pixel) = whole.pixel_mut(left + column, top + line * 3 / 2 + row) {
                    *pixel = colour;
                }
            }
        }

        for (text, at) in self.labels.iter().zip([left, left + bar / 2, left + bar]) {
            letters.write(text, [centred(text, at), top + line * 5 / 2], &mut whole);
        }
        whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_legend_is_below_the_picture_with_the_colours_of_its_ends() {
        let picture = Picture::new(600, 500, vec![9; 900_000]);
        let scale = ColourScale::new([-2.0, 2.0], true).expect("a range");
        let legend = Legend {
            name: "strain".into(),
            unit: "%".into(),
            scale,
            labels: ["-2", "0", "2"].map(Into::into),
        };
        let whole = legend.below(&picture, [240; 3]);
        assert_eq!((whole.width(), whole.pixel(300, 499)), (600, Some([9; 3])));
        assert_eq!(whole.height() - 500, Legend::height(whole.height()));
        let near = |a: Colour, b: Colour| (0..3).all(|k| a[k].abs_diff(b[k]) < 3);
        let found = |colour: Colour| {
            let all = (0..600).flat_map(|x| (500..whole.height()).map(move |y| (x, y)));
            all.filter_map(|(x, y)| whole.pixel(x, y)).any(|pixel| near(pixel, colour))
        };
        assert!([-2.0, 0.0, 2.0].iter().all(|value| found(scale.colour(*value))));
        assert!((0..600).any(|x| whole.pixel(x, 510).is_some_and(|p| p[0] < 100)), "a title");
    }
}
