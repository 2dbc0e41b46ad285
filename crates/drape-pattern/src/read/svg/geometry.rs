//! Geometry of the elements of a drawing: path data, and transforms applied to it.

use std::str::FromStr;

use kurbo::{Affine, Point};
use roxmltree::Node;
use svgtypes::PathParser;

use crate::edge::{Curve, Edge};
use crate::read::svg_path::{Subpath, subpaths};

/// Largest number of ancestors of an element that are looked at.
pub(crate) const DEPTH: usize = 200;

/// Returns the lines of the element `node` in the unit of the drawing, with y down; `None` if its
/// data cannot be read.
pub(crate) fn lines(node: Node<'_, '_>) -> Option<Vec<Subpath>> {
    let transform = transform(node);
    let parts = subpaths(&data(node)?).ok()?;
    let drawn = parts.into_iter().filter(|part| !part.edges.is_empty());
    let transformed = drawn.map(|mut part| {
        part.edges = part.edges.iter().flat_map(|edge| transformed(edge, transform)).collect();
        part
    });
    Some(transformed.collect())
}

/// Returns the number of segments of the lines of the element `node`.
pub(crate) fn segment_count(node: Node<'_, '_>) -> usize {
    data(node).map_or(0, |data| PathParser::from(data.as_str()).count())
}

/// Returns the number that the attribute `key` of `node` states, in the unit of the drawing; 0 if
/// it is missing. Returns `None` for a length in another unit.
fn number(node: Node<'_, '_>, key: &str) -> Option<f64> {
    let Some(text) = node.attribute(key) else { return Some(0.0) };
    let length = svgtypes::Length::from_str(text).ok()?;
    matches!(length.unit, svgtypes::LengthUnit::None | svgtypes::LengthUnit::Px)
        .then_some(length.number)
}

/// Returns the outline of the element `node` as path data.
fn data(node: Node<'_, '_>) -> Option<String> {
    match node.tag_name().name() {
        "path" => Some(node.attribute("d").unwrap_or_default().to_owned()),
        "polygon" => Some(format!("M{}Z", node.attribute("points")?)),
        "polyline" => Some(format!("M{}", node.attribute("points")?)),
        "line" => {
            let [a, b, c, d] = ["x1", "y1", "x2", "y2"].map(|key| number(node, key));
            Some(format!("M{} {} L{} {}", a?, b?, c?, d?))
        }
        "rect" => {
            let [x, y, w, h] = ["x", "y", "width", "height"].map(|key| number(node, key));
            let (x, y, w, h) = (x?, y?, w?, h?);
            let radius = number(node, "rx")?.max(number(node, "ry")?).min(0.5 * w).min(0.5 * h);
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
            let [x, y, r, rx, ry] = ["cx", "cy", "r", "rx", "ry"].map(|key| number(node, key));
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

/// Returns the transform of the element `node` together with the transforms of all its ancestors.
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

/// Returns `edge` after `transform`. A circular arc stays an arc under a similarity, and becomes
/// Bézier curves under another transform.
fn transformed(edge: &Edge, transform: Affine) -> Vec<Edge> {
    let map = |[x, y]: [f64; 2]| {
        let p = transform * Point::new(x, y);
        [p.x, p.y]
    };
    let [a, b, c, d, ..] = transform.as_coeffs();
    let size = a.abs().max(b.abs()).max(c.abs()).max(d.abs());
    let is_similarity = (a * a + b * b - c * c - d * d).abs() < 1e-9 * size * size
        && (a * c + b * d).abs() < 1e-9 * size * size;
    match edge.curve {
        Curve::Arc { sweep } if !is_similarity => {
            let count = (sweep.abs() / 0.5).ceil().clamp(1.0, 20.0);
            let length = edge.length();
            let places: Vec<f64> = (1..count as usize).map(|k| k as f64 / count * length).collect();
            let pieces = edge.split(&places);
            pieces.iter().map(|piece| as_cubic(piece).mapped(false, map)).collect()
        }
        _ => vec![edge.mapped(a * d - b * c < 0.0, map)],
    }
}

/// Returns the short arc `arc` as a Bézier curve with the tangents of the arc at its ends.
fn as_cubic(arc: &Edge) -> Edge {
    let Curve::Arc { sweep } = arc.curve else { return arc.clone() };
    let [from, to] = arc.tangents();
    let chord = crate::edge::distance(arc.start, arc.end);
    let radius = 0.5 * chord / (0.5 * sweep).sin().abs().max(f64::MIN_POSITIVE);
    let handle = 4.0 / 3.0 * (0.25 * sweep.abs()).tan() * radius;
    let controls = [(arc.start, from, 1.0), (arc.end, to, -1.0)].map(|(p, tangent, sense)| {
        let size = tangent[0].hypot(tangent[1]).max(f64::MIN_POSITIVE);
        [0, 1].map(|k| p[k] + sense * handle * tangent[k] / size)
    });
    Edge { curve: Curve::Cubic(controls), ..arc.clone() }
}
