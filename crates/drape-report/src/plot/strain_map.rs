//! Strain map: pictures of cloth coloured by a quantity, each above its colour scale.

use askama::Template;
use drape_input::{figure_in_decimals, typeset};
use drape_render::{Picture, diverging};

use crate::check;
use crate::error::Error;
use crate::text::base64::encode;

/// Number of steps of a colour bar.
const STEPS: usize = 64;

/// Width of a map, in px.
const WIDTH: f64 = 460.0;
/// Width of the colour bar below a map, in px.
const BAR: f64 = 260.0;
/// Room above the pictures, in px.
const HEAD: f64 = 34.0;
/// Room below the pictures, in px.
const FOOT: f64 = 56.0;

/// Picture of cloth coloured by a quantity, such as the strain along the warp.
#[derive(Debug, Clone, PartialEq)]
pub struct StrainMap {
    /// Caption of the map.
    pub caption: String,
    /// Value at the ends of the scale, in the unit of the map. The scale is the one of
    /// [`diverging`].
    pub limit: f64,
    /// Unit, as in "%".
    pub unit: String,
    /// Picture of the cloth in these colours.
    pub picture: Picture,
}

/// What the SVG template shows.
#[derive(Template)]
#[template(path = "plot/strain.svg", escape = "html")]
struct View<'a> {
    width: f64,
    height: f64,
    maps: Vec<MapView<'a>>,
}

/// Map in the figure. Lengths are in px.
struct MapView<'a> {
    map: &'a StrainMap,
    left: f64,
    middle: f64,
    size: [f64; 2],
    top: f64,
    /// PNG file in base64.
    png: String,
    steps: Vec<Step>,
    bar: f64,
    marks: [Mark; 3],
}

/// Step of the colour bar.
struct Step {
    x: f64,
    width: f64,
    colour: String,
}

/// Mark below the colour bar.
struct Mark {
    x: f64,
    text: String,
}

impl<'a> MapView<'a> {
    /// Lays out a `map` by its `number` from the left and the height of the `tallest` picture, in
    /// px.
    fn new(map: &'a StrainMap, number: usize, tallest: f64) -> Result<Self, Error> {
        check::text("the caption of a map", &map.caption)?;
        check::text("the unit of a map", &map.unit)?;
        check::unit(map.limit)?;
        let left = number as f64 * WIDTH;
        let middle = left + 0.5 * WIDTH;
        let start = middle - 0.5 * BAR;
        let step = BAR / STEPS as f64;
        let steps = (0..STEPS).map(|k| {
            let value = 2.0 * (k as f64 + 0.5) / STEPS as f64 - 1.0;
            let [red, green, blue] = diverging(value, 1.0);
            // Steps overlap by half a pixel, which hides the seams between them.
            let width = if k + 1 < STEPS { step + 0.5 } else { step };
            let colour = format!("#{red:02x}{green:02x}{blue:02x}");
            Step { x: start + k as f64 * step, width, colour }
        });

        let mark = |part: f64| Mark {
            x: middle + 0.5 * part * BAR,
            text: mark(part * map.limit, &map.unit),
        };

        Ok(Self {
            map,
            left,
            middle,
            size: [WIDTH, height(map)],
            top: HEAD,
            png: encode(&map.picture.png()?),
            steps: steps.collect(),
            bar: HEAD + tallest + 8.0,
            marks: [mark(-1.0), mark(0.0), mark(1.0)],
        })
    }
}

/// Returns the height of the picture of a `map` in the figure, in px.
fn height(map: &StrainMap) -> f64 {
    WIDTH * f64::from(map.picture.height()) / f64::from(map.picture.width().max(1))
}

/// Draws `maps` side by side, each above its scale, as one self-contained SVG file.
///
/// # Errors
/// No maps, a limit that is not positive, or texts that cannot be shown.
pub fn strain_svg(maps: &[StrainMap]) -> Result<String, Error> {
    if maps.is_empty() {
        return Err(Error::EmptyReport { name: "the map of strains".to_owned() });
    }
    let tallest = maps.iter().map(height).fold(0.0, f64::max);
    let (width, height) = (WIDTH * maps.len() as f64, HEAD + tallest + FOOT);
    let maps = maps.iter().enumerate().map(|(number, map)| MapView::new(map, number, tallest));
    let maps: Result<Vec<MapView<'_>>, Error> = maps.collect();
    let view = View { width, height, maps: maps? };
    Ok(view.render().expect("writing to a string does not fail"))
}

/// Returns the text of a mark at a `value` in a `unit`.
fn mark(value: f64, unit: &str) -> String {
    let sign = if value > 0.0 { "+" } else { "" };
    let space = if unit == "°" { "" } else { " " };
    format!("{sign}{}{space}{unit}", typeset(&figure_in_decimals(value, 3)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_has_a_picture_and_a_scale_for_each_map() {
        let picture = Picture::from_pixels([2, 3], vec![200; 18]).expect("the size");
        let map = |caption: &str, unit: &str| StrainMap {
            caption: caption.into(),
            limit: 0.5,
            unit: unit.into(),
            picture: picture.clone(),
        };
        let svg = strain_svg(&[map("along the <warp>", "%"), map("shear", "°")]).expect("a figure");
        let document = roxmltree::Document::parse(&svg).expect("XML");
        let images = document.descendants().filter(|node| node.tag_name().name() == "image");
        assert_eq!(images.count(), 2);
        assert!(svg.contains("along the &#60;warp&#62;") || svg.contains("&lt;warp&gt;"), "{svg}");
        assert!(svg.contains("+0.5 %") && svg.contains("−0.5°"), "{svg}");
        assert!(strain_svg(&[]).is_err());
        assert!(strain_svg(&[StrainMap { limit: f64::NAN, ..map("", "") }]).is_err());
    }
}
