//! Lettering: text on a picture.
//!
//! The glyphs of Noto Sans Mono are drawn beforehand in four sizes. Characters without a glyph
//! become `?`.

use noto_sans_mono_bitmap::{
    FontWeight, RasterHeight, RasterizedChar, get_raster, get_raster_width,
};

use super::colour::{Colour, decode, encode};
use super::pixels::Picture;

/// Sizes of the letters. Each size has the smallest height of a picture with this size, in pixels.
const SIZES: [(RasterHeight, u32); 4] = [
    (RasterHeight::Size32, 1500),
    (RasterHeight::Size24, 1050),
    (RasterHeight::Size20, 700),
    (RasterHeight::Size16, 0),
];

/// Letters of one size and colour.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Lettering {
    size: RasterHeight,
    ink: Colour,
}

impl Lettering {
    /// Returns the letters for a picture of a `height`, in pixels.
    pub(crate) fn for_height(height: u32) -> Lettering {
        let size = SIZES.into_iter().find(|(_, least)| height >= *least);
        Lettering { size: size.map_or(RasterHeight::Size16, |(size, _)| size), ink: [44, 48, 56] }
    }

    /// Returns the letters for a picture of a `height`, in pixels, that is extended by a strip of
    /// `lines` lines of these letters.
    pub(crate) fn for_extended(height: u32, lines: f64) -> Lettering {
        let letters = SIZES.iter().rev().find_map(|(size, _)| {
            let line = size.val() as u32;
            let letters = Lettering::for_height(height + (lines * f64::from(line)) as u32);
            (letters.height() == line).then_some(letters)
        });
        letters.unwrap_or(Lettering::for_height(height))
    }

    /// Returns the `height` of a line, in pixels.
    pub(crate) fn height(self) -> u32 {
        self.size.val() as u32
    }

    /// Returns the width of a `text`, in pixels.
    pub(crate) fn width(self, text: &str) -> u32 {
        (text.chars().count() * get_raster_width(FontWeight::Regular, self.size)) as u32
    }

    /// Writes a `text` whose upper left corner is at the pixel `left`, `top`. Letters outside the
    /// picture are cut.
    pub(crate) fn write(self, text: &str, [left, top]: [u32; 2], to: &mut Picture) {
        let advance = get_raster_width(FontWeight::Regular, self.size) as u32;
        let ink = self.ink.map(decode);
        for (glyph, number) in text.chars().filter_map(|c| self.glyph(c)).zip(0..) {
            for (row, line) in (0..).zip(glyph.rows()) {
                for (column, cover) in (0..).zip(line) {
                    let Some(pixel) = to.pixel_mut(left + number * advance + column, top + row)
                    else {
                        continue;
                    };
                    let cover = f64::from(*cover) / 255.0;
                    *pixel = [0, 1, 2].map(|k| {
                        let below = decode(pixel[k]);
                        encode(below + cover * (ink[k] - below))
                    });
                }
            }
        }
    }

    /// Returns the glyph of a `character`, or the glyph of `?`.
    fn glyph(self, character: char) -> Option<RasterizedChar> {
        let raster = |c| get_raster(c, FontWeight::Regular, self.size);
        raster(character).or_else(|| raster('?'))
    }
}

impl Picture {
    /// Returns the picture with a `text` in its upper left corner.
    #[must_use]
    pub fn captioned(mut self, text: &str) -> Picture {
        let letters = Lettering::for_height(self.height());
        let margin = letters.height() / 2;
        letters.write(text, [margin; 2], &mut self);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_are_drawn_where_they_belong_and_cut_at_the_border() {
        let plain = Picture::new(60, 20, vec![255; 3600]);
        let dark = |picture: &Picture| {
            let inked = |x: &u32| (0..20).any(|y| picture.pixel(*x, y).is_some_and(|p| p[0] < 128));
            (0..60).filter(inked).collect::<Vec<u32>>()
        };
        let letters = Lettering::for_height(20);
        let mut picture = plain.clone();
        letters.write("M°", [10, 2], &mut picture);
        let columns = dark(&picture);
        let width = letters.width("M°");
        assert!(
            columns.len() > 4 && columns.iter().all(|x| (10..10 + width).contains(x)),
            "{columns:?}"
        );
        let mut cut = plain.clone();
        letters.write("WWWW", [50, 12], &mut cut);
        assert!(!dark(&cut).is_empty());
        let mut unknown = plain.clone();
        letters.write("袖", [0, 0], &mut unknown);
        assert!(!dark(&unknown).is_empty(), "it is a question mark");
        assert!(Lettering::for_height(2000).height() > Lettering::for_height(500).height());
    }
}
