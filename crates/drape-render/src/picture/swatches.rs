//! Swatches: colours with their names, written below a picture.

use super::colour::Colour;
use super::lettering::Lettering;
use super::pixels::Picture;

/// Height of the margin above and below the lines of the legend, in heights of a line.
const MARGIN: f64 = 0.5;
/// Distance of two lines, in heights of a line.
const LINE: f64 = 1.4;

/// Largest fraction of the height of a picture that a legend takes.
const LARGEST: f64 = 0.4;

/// Colour of the border of a swatch.
const BORDER: Colour = [120, 124, 130];

/// Legend of named colours, such as the colours of fabrics, for pictures of one size.
#[derive(Debug, Clone)]
pub struct Swatches {
    entries: Vec<(String, Colour)>,
    letters: Lettering,
    height: u32,
}

impl Swatches {
    /// Returns the legend of `entries` for pictures that are `width` and `height` pixels large
    /// together with the legend. A legend without entries takes no room.
    ///
    /// Names are cut where a line has no room for them. A legend that would take more than two
    /// fifths of the picture is left out.
    #[must_use]
    pub fn new(entries: Vec<(String, Colour)>, [width, height]: [u32; 2]) -> Swatches {
        let mut swatches = Swatches { entries, letters: Lettering::for_height(height), height: 0 };
        let lines = swatches.lines(width).len();
        let needed = swatches.pixels(2.0 * MARGIN + LINE * lines as f64);
        let has_room = f64::from(needed) <= LARGEST * f64::from(height);
        if lines > 0 && has_room {
            swatches.height = needed;
        }
        swatches
    }

    /// Returns the `height` of the legend, in pixels.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns a `picture` with the legend below it, on a strip of the colour `ground`.
    #[must_use]
    pub fn below(&self, picture: &Picture, ground: Colour) -> Picture {
        if self.height == 0 {
            return picture.clone();
        }
        let mut whole = picture.extended(self.height, ground);
        let side = self.letters.height() * 4 / 5;
        for (line, number) in self.lines(picture.width()).into_iter().zip(0..) {
            let top = picture.height() + self.pixels(MARGIN + LINE * f64::from(number));
            let used: u32 = line.iter().map(|(name, _)| self.width(name)).sum();
            let mut left = picture.width().saturating_sub(used) / 2;
            for (name, colour) in line {
                swatch(&mut whole, [left, top + self.letters.height() / 10], [side, side], colour);
                let text = [left + side + self.letters.height() / 2, top];
                self.letters.write(&name, text, &mut whole);
                left += self.width(&name);
            }
        }
        whole
    }

    /// Returns the entries of each line of a picture that is `width` pixels wide, with names cut to
    /// the line.
    fn lines(&self, width: u32) -> Vec<Vec<(String, Colour)>> {
        let mut lines: Vec<Vec<(String, Colour)>> = Vec::new();
        let mut remaining = 0;
        for (name, colour) in &self.entries {
            let name = self.cut(name, width);
            let needed = self.width(&name);
            if lines.is_empty() || needed > remaining {
                lines.push(Vec::new());
                remaining = width;
            }
            remaining = remaining.saturating_sub(needed);
            if let Some(line) = lines.last_mut() {
                line.push((name, *colour));
            }
        }
        lines
    }

    /// Returns a `name` that fits a line of `width` pixels, cut at its end where it is too long.
    fn cut(&self, name: &str, width: u32) -> String {
        if self.width(name) <= width {
            return name.to_owned();
        }
        let cut = |kept: usize| name.chars().take(kept).chain("..".chars()).collect::<String>();
        let fits = |kept: &usize| self.width(&cut(*kept)) <= width;
        (0..name.chars().count()).rev().find(fits).map_or_else(String::new, cut)
    }

    /// Returns the width of the entry `name` with the room around it, in pixels.
    fn width(&self, name: &str) -> u32 {
        self.letters.height() * 14 / 5 + self.letters.width(name)
    }

    /// Returns a height in `lines` as pixels.
    fn pixels(&self, lines: f64) -> u32 {
        (lines * f64::from(self.letters.height())) as u32
    }
}

/// Fills a rectangle, whose upper left corner is at the pixel `left`, `top`, with a `colour` and a
/// border.
fn swatch(to: &mut Picture, [left, top]: [u32; 2], [width, height]: [u32; 2], colour: Colour) {
    for row in 0..height {
        for column in 0..width {
            let is_border = row == 0 || column == 0 || row + 1 == height || column + 1 == width;
            if let Some(pixel) = to.pixel_mut(left + column, top + row) {
                *pixel = if is_border { BORDER } else { colour };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUND: Colour = [233; 3];

    fn entries(names: &[&str]) -> Vec<(String, Colour)> {
        let colour = |number: usize| [200, 20 * number as u8, 40];
        names
            .iter()
            .enumerate()
            .map(|(number, name)| ((*name).to_owned(), colour(number)))
            .collect()
    }

    fn blank(width: u32, height: u32) -> Picture {
        Picture::new(width, height, vec![255; 3 * (width * height) as usize])
    }

    #[test]
    fn every_swatch_is_below_the_picture_and_the_size_is_the_one_asked_for() {
        let names = ["cotton", "wool", "a linen with a long name", "silk"];
        for size in [[1200, 900], [690, 700], [300, 400], [230, 1050], [1800, 1000]] {
            let [width, height] = size;
            let swatches = Swatches::new(entries(&names), size);
            assert!(swatches.height() > 0, "{size:?}");
            let whole = swatches.below(&blank(width, height - swatches.height()), GROUND);
            assert_eq!([whole.width(), whole.height()], size);
            for (_, colour) in entries(&names) {
                let places = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
                let rows: Vec<u32> = places
                    .filter(|[x, y]| whole.pixel(*x, *y) == Some(colour))
                    .map(|[_, y]| y)
                    .collect();
                assert!(rows.len() > 30, "{size:?}, {colour:?}: {}", rows.len());
                assert!(rows.iter().all(|y| *y >= height - swatches.height()));
            }
        }
    }

    #[test]
    fn names_are_cut_to_the_line_and_a_small_picture_has_no_legend() {
        let long = "a name that is far too long for the picture";
        let swatches = Swatches::new(entries(&[long, "wool"]), [200, 600]);
        let lines = swatches.lines(200);
        assert_eq!((lines.len(), lines[1][0].0.as_str()), (2, "wool"));
        assert!(
            lines[0][0].0.ends_with("..") && long.starts_with(lines[0][0].0.trim_end_matches('.'))
        );
        assert!(swatches.width(&lines[0][0].0) <= 200);
        assert_eq!(Swatches::new(entries(&["wool", "silk"]), [64, 64]).height(), 0);
        assert_eq!(Swatches::new(Vec::new(), [900, 900]).height(), 0);
    }
}
