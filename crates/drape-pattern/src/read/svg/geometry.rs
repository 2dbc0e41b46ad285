//! Geometry of the elements of a drawing: their path data, their transforms, and both together.

use std::str::FromStr;

use kurbo::{Affine, Point};
use roxmltree::Node;

use crate::edge::{Curve, Edge};
use crate::read::svg_path::{Subpath, subpaths};

/// Longest list of elements that are followed upwards for the transform of an element.
pub(crate) const DEPTH: usize = 200;

/// Returns the lines of an element in the drawing's unit, with y down; `None` if its data cannot be
/// read.
pub(crate) fn lines(node: Node<'_, '_>) -> Option<Vec<Subpath>> {
    let transform = transform(node);
    let parts = subpaths(&data(node)?).ok()?;
    let drawn = parts.into_iter().filter(|part| !part.edges.is_empty());
    let moved = drawn.map(|mut part| {
        part.edges = part.edges.iter().flat_map(|edge| moved(edge, transform)).collect();
        part
    });
    Some(moved.collect())
}

/// Returns the outline of an element as path data.
fn data(node: Node<'_, '_>) -> Option<String> {
    let number = |key: &str| match node.attribute(key) {
        None => Some(0.0),
        // A size may have a unit; without one it is in the drawing's.
        Some(text) => Some(svgtypes::Length::from_str(text).ok()?)
            .filter(|length| {
                matches!(length.unit, svgtypes::LengthUnit::None | svgtypes::LengthUnit::Px)
            })
            .map(|length| length.number),
    };
    match node.tag_name().name() {
        "path" => Some(node.attribute("d").unwrap_or_default().to_owned()),
        "polygon" => Some(format!("M{}Z", node.attribute("points")?)),
        "polyline" => Some(format!("M{}", node.attribute("points")?)),
        "line" => {
            let [a, b, c, d] = ["x1", "y1", "x2", "y2"].map(number);
            Some(format!("M{} {} L{} {}", a?, b?, c?, d?))
        }
        "rect" => {
            let [x, y, w, h] = ["x", "y", "width", "height"].map(number);
            let (x, y, w, h) = (x?, y?, w?, h?);
            let radius = number("rx")?.max(number("ry")?).min(0.5 * w).min(0.5 * h);
            if !(radius > 0.0) {
                return Some(format!("M{x} {y} h{w} v{h} h{} Z", -w));
            }
            let (across, down, r) = (w - 2.0 * radius, h - 2.0 * radius, radius);
            Some(format!(
                "M{} {y} h{across} a{r} {r} 0 0 1 {r} {r} v{down} a{r} {r} 0 0 1 {} {r} h{} \
                 a{r} {r} 0 0 1 {} {} v{} a{r} {r} 0 0 1 {r} {} Z",
                x + r,
                -r,
                -across,
                -r,
                -r,
                -down,
                -r
            ))
        }
        "circle" | "ellipse" => {
            let [x, y, r, rx, ry] = ["cx", "cy", "r", "rx", "ry"].map(number);
            let (rx, ry) = (rx?.max(r?), ry?.max(r?));
            let (x, y) = (x?, y?);
            Some(format!(
                "M{} {y} A{rx} {ry} 0 0 1 {} {y} A{rx} {ry} 0 0 1 {} {y} Z",
                x - rx,
                x + rx,
                x - rx
            ))
        }
        _ => None,
    }
}

/// Returns the transform of an element and of all that it lies in. Nested drawings shift by x and
/// y.
pub(crate) fn transform(node: Node<'_, '_>) -> Affine {
    let mut all = Affine::IDENTITY;
    for n in node.ancestors().take(DEPTH).filter(Node::is_element) {
        if let Some(t) =
            n.attribute("transform").and_then(|t| svgtypes::Transform::from_str(t).ok())
        {
            all = Affine::new([t.a, t.b, t.c, t.d, t.e, t.f]) * all;
        }
    }
    all
}

/// Returns an edge after a transform. A circular arc stays one under a similarity, and becomes
/// Bézier curves under another transform.
fn moved(edge: &Edge, transform: Affine) -> Vec<Edge> {
    let map = |[x, y]: [f64; 2]| {
        let p = transform * Point::new(x, y);
        [p.x, p.y]
    };
    let [a, b, c, d, ..] = transform.as_coeffs();
    let size = a.abs().max(b.abs()).max(c.abs()).max(d.abs());
    let similar = (a * a + b * b - c * c - d * d).abs() < 1e-9 * size * size
        && (a * c + b * d).abs() < 1e-9 * size * size;
    match edge.curve {
        Curve::Arc { sweep } if !similar => {
            let count = (sweep.abs() / 0.5).ceil().clamp(1.0, 20.0);
            let length = edge.length();
            let places: Vec<f64> = (1..count as usize).map(|k| k as f64 / count * length).collect();
            let pieces = edge.split(&places);
            pieces.iter().map(|piece| as_cubic(piece).mapped(false, map)).collect()
        }
        _ => vec![edge.mapped(a * d - b * c < 0.0, map)],
    }
}

/// Returns a short arc as a Bézier curve that has its tangents at its ends.
fn as_cubic(arc: &Edge) -> Edge {
    let Curve::Arc { sweep } = arc.curve else { return arc.clone() };
    let [from, to] = arc.tangents();
    let chord = crate::edge::distance(arc.start, arc.end);
    let radius = 0.5 * chord / (0.5 * sweep).sin().abs().max(f64::MIN_POSITIVE);
    let handle = 4.0 / 3.0 * (0.25 * sweep.abs()).tan() * radius;
    let along = |p: [f64; 2], t: [f64; 2], s: f64| {
        let size = t[0].hypot(t[1]).max(f64::MIN_POSITIVE);
        [p[0] + s * handle * t[0] / size, p[1] + s * handle * t[1] / size]
    };
    let controls = [along(arc.start, from, 1.0), along(arc.end, to, -1.0)];
    Edge { curve: Curve::Cubic(controls), ..arc.clone() }
}
