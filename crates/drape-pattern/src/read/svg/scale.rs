//! Length of the unit of a drawing: as its size says, or its program, or who asks for it.

use std::str::FromStr;

use drape_input::{Diagnostic, Diagnostics, Document};
use svgtypes::{Length, LengthUnit, ViewBox};

use super::shapes::Shape;
use crate::note::PatternNote;
use crate::read::request::Request;
use crate::read::unit::Unit;

/// Pixel of Inkscape before version 0.92, in m: 90 to the inch.
const OLD_PIXEL: f64 = 0.0254 / 90.0;

/// Size of a drawing, in the unit of its attribute.
#[derive(Clone, Copy)]
struct Size {
    number: f64,
    unit: Option<Unit>,
}

/// Returns the length of the unit of a drawing, in m, with a note on why.
pub(crate) fn scale(
    document: &Document,
    tree: &roxmltree::Document<'_>,
    request: &Request,
    shapes: &[Shape],
) -> Result<(f64, PatternNote), Diagnostics> {
    let root = tree.root_element();
    let taken = |metres: f64, reason: String| {
        let note = PatternNote::Taken {
            taken: format!("a unit of the drawing is {:.6} mm", 1e3 * metres),
            reason,
        };
        (metres, note)
    };
    if let Some(unit) = request.unit {
        return Ok(taken(unit.metres(), format!("{} is asked for", unit.word())));
    }
    let fail = |message: String, help: String| {
        Diagnostics::from(Diagnostic::new(document.path(), message).help(help))
    };
    let view = root.attribute("viewBox").map(ViewBox::from_str);
    if let Some(Err(_)) = view {
        let message = format!("viewBox is \"{}\"", root.attribute("viewBox").unwrap_or_default());
        return Err(fail(
            message,
            "four numbers: x, y, width and height, such as 0 0 210 297".into(),
        ));
    }
    let view = view.and_then(Result::ok);
    let sides = [("width", view.map(|v| v.w)), ("height", view.map(|v| v.h))];
    // Where a drawing has no viewBox, its unit is the pixel of its program.
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
            return Err(fail(message, "a positive length, such as 210mm".into()));
        }
        scales.push((name, metres));
    }
    match scales[..] {
        [] => {}
        [(_, a), (_, b)] if (a / b - 1.0).abs() > 1e-3 => {
            if root.attribute("preserveAspectRatio").is_some_and(|word| word.starts_with("none")) {
                let message = "its width and height stretch the drawing differently".to_owned();
                let help = "make width : height that of the viewBox".to_owned();
                return Err(fail(message, help));
            }
            let least = a.min(b);
            return Ok(taken(
                least,
                "the smaller of what width and height say for the viewBox".into(),
            ));
        }
        [(name, metres), ..] => {
            let of = root.attribute(name).unwrap_or_default();
            let reason = match view {
                Some(view) => {
                    let units = if name == "width" { view.w } else { view.h };
                    format!("its {name} is {of} for {units} units of the viewBox")
                }
                None => {
                    let per_inch = (0.0254 / pixel).round();
                    format!(
                        "its {name} is {of} and there is no viewBox: pixels, {per_inch} to the inch"
                    )
                }
            };
            return Ok(taken(metres, reason));
        }
    }
    if let Some((metres, reason)) = by_program(document, tree, view) {
        return Ok(taken(metres, reason));
    }
    Err(ambiguous(document, shapes))
}

/// Returns the size that an attribute states; its unit is none where it is in pixels or without
/// one, which may be anything.
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

/// Returns the version of Inkscape that wrote a drawing, such as `0.91 r13725`.
fn inkscape<'a>(tree: &'a roxmltree::Document<'_>) -> Option<&'a str> {
    let of_inkscape = |namespace: &str| namespace.contains("inkscape");
    let mut attributes = tree.root_element().attributes();
    let version =
        attributes.find(|a| a.name() == "version" && a.namespace().is_some_and(of_inkscape))?;
    Some(version.value())
}

/// Returns whether a version of Inkscape before 0.92 wrote a drawing.
fn is_old_inkscape(tree: &roxmltree::Document<'_>) -> bool {
    let numbers = |version: &str| -> Option<[u32; 2]> {
        let mut parts = version.split(|letter: char| !letter.is_ascii_digit());
        let [major, minor] = [parts.next()?, parts.next()?];
        Some([major.parse().ok()?, minor.parse().ok()?])
    };
    inkscape(tree).and_then(numbers).is_some_and(|version| version < [0, 92])
}

/// Returns the unit by what is known of the program that wrote the drawing.
fn by_program(
    document: &Document,
    tree: &roxmltree::Document<'_>,
    view: Option<ViewBox>,
) -> Option<(f64, String)> {
    let root = tree.root_element();
    // Pixels of the drawing's size for a unit of its viewBox.
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

/// Returns the question for the unit, with what the drawing would be in each.
fn ambiguous(document: &Document, shapes: &[Shape]) -> Diagnostics {
    let largest = shapes.iter().filter(|s| s.parts.iter().any(|p| p.edges.len() > 1));
    let largest = largest.map(|shape| (shape.extent(), &shape.name));
    let (size, name) = match largest.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((size, name)) => (size, name.as_str()),
        None => (0.0, "?"),
    };
    let in_unit = |unit: Unit| format!("{:.0} mm", 1e3 * size * unit.metres());
    let message = format!(
        "the drawing does not say how long its unit is: its largest shape, \"{name}\", is {size:.1} units, \
         which are {} if a unit is 1 mm, {} if it is 1 pt (Illustrator), {} if it is 1 px (CSS, Inkscape)",
        in_unit(Unit::MM),
        in_unit(Unit::POINT),
        in_unit(Unit::PIXEL)
    );
    let help = format!(
        "say it: drape convert {} --unit mm (or cm, m, in, pt, px), or unit = \"mm\" in the [from] of a pattern",
        document.path().display()
    );
    Diagnostic::new(document.path(), message).help(help).into()
}
