//! Picture of a garment with the names of its seams in their colours.

use askama::Template;
use drape_render::{Colour, Picture};

use crate::check;
use crate::error::Error;
use crate::text::base64::encode;

/// Width of the picture, in px.
const WIDTH: f64 = 1200.0;
/// Height of a row of names, in px.
const ROW: f64 = 22.0;
/// Room around the names, in px.
const EDGE: f64 = 16.0;

/// Number of names in a row.
const COLUMNS: usize = 5;

/// Name of a seam in the colour in which a picture shows it.
#[derive(Debug, Clone, PartialEq)]
pub struct SeamKey {
    /// Name.
    pub name: String,
    /// Colour.
    pub colour: Colour,
}

/// What the SVG template shows.
#[derive(Template)]
#[template(path = "plot/seams.svg", escape = "html")]
struct View {
    width: f64,
    height: f64,
    picture_height: f64,
    /// PNG file in base64.
    png: String,
    names: Vec<Name>,
}

/// Name at its position, in px.
struct Name {
    x: f64,
    y: f64,
    text: String,
    colour: String,
}

/// Draws a `picture` above the names of its `seams`, as one self-contained SVG file.
///
/// # Errors
/// Names that cannot be shown, or a picture that cannot be encoded.
pub fn seams_svg(picture: &Picture, seams: &[SeamKey]) -> Result<String, Error> {
    let picture_height = WIDTH * f64::from(picture.height()) / f64::from(picture.width().max(1));
    let column = (WIDTH - 2.0 * EDGE) / COLUMNS as f64;

    let name = |(number, seam): (usize, &SeamKey)| {
        check::text("the name of a seam", &seam.name)?;
        let [red, green, blue] = seam.colour;
        Ok(Name {
            x: EDGE + (number % COLUMNS) as f64 * column,
            y: picture_height + EDGE + (number / COLUMNS) as f64 * ROW,
            text: seam.name.clone(),
            colour: format!("#{red:02x}{green:02x}{blue:02x}"),
        })
    };
    let names: Result<Vec<Name>, Error> = seams.iter().enumerate().map(name).collect();

    let rows = seams.len().div_ceil(COLUMNS) as f64;
    let view = View {
        width: WIDTH,
        height: picture_height + 2.0 * EDGE + rows * ROW,
        picture_height,
        png: encode(&picture.png()?),
        names: names?,
    };
    Ok(view.render().expect("writing to a string does not fail"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_has_the_name_of_each_seam_in_its_colour() {
        let picture = Picture::from_pixels([2, 3], vec![200; 18]).expect("the size");
        let seam = |name: &str, colour| SeamKey { name: name.into(), colour };
        let seams = [seam("side <left>", [255, 0, 0]), seam("waist", [0, 128, 255])];
        let svg = seams_svg(&picture, &seams).expect("a figure");
        let document = roxmltree::Document::parse(&svg).expect("XML");
        let texts: Vec<&str> = document.descendants().filter_map(|node| node.text()).collect();
        assert!(texts.contains(&"side <left>") && texts.contains(&"waist"), "{svg}");
        assert!(svg.contains("#ff0000") && svg.contains("#0080ff"), "{svg}");
    }

    #[test]
    fn names_are_below_the_picture_and_the_page_ends_with_them() {
        let picture = Picture::from_pixels([4, 2], vec![200; 24]).expect("the size");
        let seam = |k: usize| SeamKey { name: format!("seam {k}"), colour: [0, 0, 0] };
        let seams: Vec<SeamKey> = (0..2 * COLUMNS + 1).map(seam).collect();
        let svg = seams_svg(&picture, &seams).expect("a figure");
        let document = roxmltree::Document::parse(&svg).expect("XML");
        let number = |text: &str| text.parse::<f64>().expect("a number");
        let page = document.root_element().attribute("viewBox").expect("a page");
        let height = number(page.rsplit(' ').next().expect("four numbers"));
        let places = document.descendants().filter_map(|node| node.attribute("transform"));
        let row = |place: &str| number(place.rsplit([' ', ')']).nth(1).expect("a place"));
        let rows: Vec<f64> = places.map(row).collect();
        let picture_height = 0.5 * WIDTH;
        assert_eq!(rows.len(), seams.len());
        assert!(rows.iter().all(|y| *y > picture_height && *y < height), "{rows:?} of {height}");
        assert!(rows[2 * COLUMNS] > height - ROW - 2.0 * EDGE, "{rows:?} of {height}");
    }
}
