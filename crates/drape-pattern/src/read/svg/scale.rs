//! Length of the unit of a drawing: from its size, from the program that wrote it, or from a
//! request.

use std::str::FromStr;

use drape_input::{Diagnostic, Diagnostics, Document, Remedy};
use svgtypes::{Length, LengthUnit, ViewBox};

use super::shapes::Shape;
use crate::note::PatternNote;
use crate::read::request::Request;
use crate::read::unit::{SVG_UNITS, Unit};

/// Pixel of Inkscape before version 0.92, in m: 1/90 inch.
const OLD_PIXEL: f64 = 0.0254 / 90.0;

/// Width or height of a drawing, in the unit of its attribute.
#[derive(Clone, Copy)]
struct Size {
    number: f64,
    /// `None` for pixels and bare numbers, whose real size is unknown.
    unit: Option<Unit>,
}

/// Returns the length of the unit of the drawing `tree`, in m, with a note on the reason. The
/// largest of `shapes` stands in the question for the unit.
pub(crate) fn scale(
    document: &Document,
    tree: &roxmltree::Document<'_>,
    request: &Request,
    shapes: &[Shape],
) -> Result<(f64, PatternNote), Diagnostics> {
    let root = tree.root_element();
    if let Some(unit) = request.unit {
        let reason = format!("{} is asked for", unit.word());
        return Ok((unit.metres(), scale_note(unit.metres(), reason)));
    }

    let view = root.attribute("viewBox").map(ViewBox::from_str);
    if let Some(Err(_)) = view {
        let message = format!("viewBox is \"{}\"", root.attribute("viewBox").unwrap_or_default());
        return Err(fail(
            document,
            message,
            "four numbers: x, y, width and height, such as 0 0 210 297".into(),
        ));
    }
    let view = view.and_then(Result::ok);

    // Width and height each state a scale, if they have a unit.
    let sides = [("width", view.map(|v| v.w)), ("height", view.map(|v| v.h))];
    // Without a viewBox, the unit is the pixel of the program.
    let pixel = if is_old_inkscape(tree) { OLD_PIXEL } else { Unit::PIXEL.metres() };
    let mut scales = Vec::new();
    for (name, units) in sides {
        let Some(size) = root.attribute(name).and_then(size) else { continue };
        let Some(unit) = size.unit else { continue };
        let metres = match units {
            Some(units) => size.number * unit.metres() / units,
            None => pixel,
        };
        if !(metres.is_finite() && metres > 0.0) {
            let message = format!("{name} is \"{}\"", root.attribute(name).unwrap_or_default());
            return Err(fail(document, message, "a positive length, such as 210mm".into()));
        }
        scales.push((name, metres));
    }

    match scales[..] {
        [] => {}
        [(_, a), (_, b)] if (a / b - 1.0).abs() > 1e-3 => {
            if root.attribute("preserveAspectRatio").is_some_and(|word| word.starts_with("none")) {
                let message = "its width and height stretch the drawing differently".to_owned();
                let help = "make width : height that of the viewBox".to_owned();
                return Err(fail(document, message, help));
            }
            let least = a.min(b);
            let reason = "the smaller of what width and height say for the viewBox".to_owned();
            return Ok((least, scale_note(least, reason)));
        }
        [(name, metres), ..] => {
            let length = root.attribute(name).unwrap_or_default();
            let reason = match view {
                Some(view) => {
                    let units = if name == "width" { view.w } else { view.h };
                    format!("its {name} is {length} for {units} units of the viewBox")
                }
                None => {
                    let per_inch = (0.0254 / pixel).round();
                    format!(
                        "its {name} is {length} and there is no viewBox: pixels, {per_inch} to the inch"
                    )
                }
            };
            return Ok((metres, scale_note(metres, reason)));
        }
    }
    if let Some((metres, reason)) = by_program(document, tree, view) {
        return Ok((metres, scale_note(metres, reason)));
    }
    Err(ambiguous(document, shapes))
}

/// Returns the mistake `message` of `document`, with the remedy `help`.
fn fail(document: &Document, message: String, help: String) -> Diagnostics {
    Diagnostic::new(document.path(), message).help(help).into()
}

/// Returns the note that a unit of a drawing is `metres` long, for `reason`.
fn scale_note(metres: f64, reason: String) -> PatternNote {
    let taken = format!("a unit of the drawing is {:.6} mm", 1e3 * metres);
    PatternNote::Taken { taken, reason }
}

/// Parses `text`, a width or height. The unit is `None` for pixels and bare numbers, whose real
/// size is unknown.
fn size(text: &str) -> Option<Size> {
    let length = Length::from_str(text).ok()?;
    let unit = match length.unit {
        LengthUnit::Mm => Some(Unit::MM),
        LengthUnit::Cm => Unit::parse("cm"),
        LengthUnit::In => Some(Unit::INCH),
        LengthUnit::Pt => Some(Unit::POINT),
        _ => None,
    };
    Some(Size { number: length.number, unit })
}

/// Returns the version of Inkscape that wrote the drawing `tree`, such as `0.91 r13725`.
fn inkscape<'a>(tree: &'a roxmltree::Document<'_>) -> Option<&'a str> {
    let mut attributes = tree.root_element().attributes();
    let version = attributes.find(|attribute| {
        attribute.name() == "version"
            && attribute.namespace().is_some_and(|namespace| namespace.contains("inkscape"))
    })?;
    Some(version.value())
}

/// Returns whether a version of Inkscape before 0.92 wrote the drawing `tree`.
fn is_old_inkscape(tree: &roxmltree::Document<'_>) -> bool {
    inkscape(tree).and_then(version_numbers).is_some_and(|version| version < [0, 92])
}

/// Returns the major and the minor number of `version`.
fn version_numbers(version: &str) -> Option<[u32; 2]> {
    let mut parts = version.split(|letter: char| !letter.is_ascii_digit());
    let [major, minor] = [parts.next()?, parts.next()?];
    Some([major.parse().ok()?, minor.parse().ok()?])
}

/// Returns the unit of the drawing, in m, with the reason, if the program that wrote it is known.
fn by_program(
    document: &Document,
    tree: &roxmltree::Document<'_>,
    view: Option<ViewBox>,
) -> Option<(f64, String)> {
    let root = tree.root_element();
    // Pixels for a unit of the viewBox.
    let pixels = match (view, root.attribute("width").and_then(size)) {
        (Some(view), Some(size)) if view.w > 0.0 && size.number > 0.0 => size.number / view.w,
        _ => 1.0,
    };
    if inkscape(tree).is_some() {
        let (pixel, reason) = if is_old_inkscape(tree) {
            (OLD_PIXEL, "Inkscape's pixels are 90 to the inch before version 0.92")
        } else {
            (Unit::PIXEL.metres(), "Inkscape's pixels are 96 to the inch from version 0.92 on")
        };
        return Some((pixels * pixel, reason.into()));
    }
    let head: String = document.text().chars().take(2000).collect();
    if head.contains("Adobe Illustrator") {
        return Some((
            pixels * Unit::POINT.metres(),
            "Illustrator's pixels are 72 to the inch".into(),
        ));
    }
    None
}

/// Returns the question for the unit of `document`, with the size of the largest of `shapes` in
/// each unit.
fn ambiguous(document: &Document, shapes: &[Shape]) -> Diagnostics {
    let largest = shapes.iter().filter(|s| s.parts.iter().any(|p| p.edges.len() > 1));
    let largest = largest.map(|shape| (shape.extent(), &shape.name));
    let (size, name) = match largest.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((size, name)) => (size, name.as_str()),
        None => (0.0, "?"),
    };
    let [mm, point, pixel] = [Unit::MM, Unit::POINT, Unit::PIXEL]
        .map(|unit| format!("{:.0} mm", 1e3 * size * unit.metres()));
    let message = format!(
        "the drawing does not say how long its unit is: its largest shape, \"{name}\", is {size:.1} units, \
         which are {mm} if a unit is 1 mm, {point} if it is 1 pt (Illustrator), {pixel} if it is 1 px (CSS, Inkscape)"
    );
    let remedy = Remedy::StateUnit { file: document.path().to_owned(), units: SVG_UNITS };
    Diagnostic::new(document.path(), message).help(remedy).into()
}
