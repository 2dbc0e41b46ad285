//! Shapes of a drawing in its own unit, with y down: paths, polygons, rectangles, circles,
//! ellipses, lines.

use std::str::FromStr;

use kurbo::{Affine, Point};
use roxmltree::Node;

use crate::edge::{Curve, Edge};
use crate::note::Note;
use crate::read::svg_path::{Subpath, subpaths};

/// Longest list of references that are followed upwards for the transform of an element.
const DEPTH: usize = 200;

/// Meaning of a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// Outline of a panel, as this project writes it.
    Outline,
    /// Line along the warp.
    Grain,
    /// Line across the outline.
    Notch,
    /// To be told by its form.
    Other,
}

/// Words of this project about a panel.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Own {
    /// Origin of its frame.
    pub(crate) origin: [f64; 2],
    /// Names of its edges.
    pub(crate) edges: Vec<String>,
}

/// Shape of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shape {
    pub(crate) name: String,
    pub(crate) line: usize,
    pub(crate) role: Role,
    pub(crate) parts: Vec<Subpath>,
    pub(crate) own: Option<Own>,
}

impl Shape {
    /// Larger side of its bounding box, with control points.
    pub(crate) fn extent(&self) -> f64 {
        let edges = self.parts.iter().flat_map(|part| &part.edges);
        let numbers: Vec<f64> = edges.flat_map(Edge::coordinates).collect();
        let side = |axis: usize| {
            let all = numbers.iter().skip(axis).step_by(2).copied();
            all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
        };
        if numbers.is_empty() { 0.0 } else { side(0).max(side(1)) }
    }
}

/// Shapes of a drawing, with notes on what is none.
pub(crate) struct Collected {
    pub(crate) shapes: Vec<Shape>,
    pub(crate) notes: Vec<Note>,
}

/// Returns the shapes that a drawing shows.
pub(crate) fn collect(tree: &roxmltree::Document<'_>) -> Collected {
    let mut found = Collected { shapes: Vec::new(), notes: Vec::new() };
    let mut clones = 0;
    let mut unread = Vec::new();
    for node in tree.descendants().filter(Node::is_element) {
        let tag = node.tag_name().name();
        clones += usize::from(tag == "use" && shown(node));
        if !matches!(tag, "path" | "polygon" | "polyline" | "rect" | "circle" | "ellipse" | "line")
            || !shown(node)
        {
            continue;
        }
        let Some(role) = role(node) else { continue };
        let line = tree.text_pos_at(node.range().start).row as usize;
        let Some(parts) = data(node).and_then(|data| subpaths(&data).ok()) else {
            unread.push(format!("{} of line {line}", name(node)));
            continue;
        };
        let transform = transform(node);
        let parts: Vec<Subpath> = parts
            .into_iter()
            .filter(|part| !part.edges.is_empty())
            .map(|mut part| {
                part.edges = part.edges.iter().flat_map(|edge| moved(edge, transform)).collect();
                part
            })
            .collect();
        if parts.is_empty() {
            continue;
        }
        let own = own(node, transform);
        found.shapes.push(Shape { name: name(node), line, role, parts, own });
    }
    if clones > 0 {
        let reason = "clones are not followed: unlink them in the drawing".into();
        found.notes.push(Note::LeftOut { part: format!("{clones} clones (<use>)"), reason });
    }
    for part in unread {
        let reason = "its path cannot be read".into();
        found.notes.push(Note::LeftOut { part, reason });
    }
    found
}

/// Returns the words that tell what an element is: its class, identifier and label.
fn words(node: Node<'_, '_>) -> String {
    let label = node.attributes().find(|a| a.name() == "label").map(|a| a.value());
    let all = [node.attribute("class"), node.attribute("id"), label];
    all.into_iter().flatten().collect::<Vec<_>>().join(" ").to_lowercase()
}

/// Returns the group of a panel that this project wrote, round an element.
fn own_group<'a, 'i>(node: Node<'a, 'i>) -> Option<Node<'a, 'i>> {
    node.ancestors().take(DEPTH).find(|n| n.attribute("data-panel").is_some())
}

/// Returns what an element is; `None` for marks of this project that say nothing.
fn role(node: Node<'_, '_>) -> Option<Role> {
    let words = words(node);
    let token = |word: &str| words.split_whitespace().any(|other| other == word);
    if own_group(node).is_some() {
        return match () {
            () if token("outline") => Some(Role::Outline),
            () if token("grain") => Some(Role::Grain),
            () if token("notch") => Some(Role::Notch),
            () if node.attribute("data-edges").is_some() => Some(Role::Outline),
            () => None,
        };
    }
    match () {
        () if words.contains("grain") => Some(Role::Grain),
        () if words.contains("notch") => Some(Role::Notch),
        // FreeSewing's allowances, notes and hidden paths.
        () if token("sa") || token("note") || token("help") || token("hidden") => None,
        () => Some(Role::Other),
    }
}

/// Returns whether an element is drawn.
fn shown(node: Node<'_, '_>) -> bool {
    node.ancestors().filter(Node::is_element).all(|n| {
        let aside = matches!(
            n.tag_name().name(),
            "defs"
                | "symbol"
                | "clipPath"
                | "mask"
                | "pattern"
                | "marker"
                | "metadata"
                | "text"
                | "title"
        );
        let style: String = n.attribute("style").unwrap_or_default().split_whitespace().collect();
        let hidden = n.attribute("display") == Some("none") || style.contains("display:none");
        !(aside || hidden)
    })
}

/// Returns the name of an element: a label, an identifier or a title, its own or else that of a
/// group round it.
fn name(node: Node<'_, '_>) -> String {
    if let Some(panel) = own_group(node).and_then(|group| group.attribute("data-panel")) {
        return panel.into();
    }
    let named = |n: Node<'_, '_>| {
        let label = n.attributes().find(|a| a.name() == "label").map(|a| a.value().to_owned());
        let title =
            || n.children().find(|c| c.tag_name().name() == "title")?.text().map(str::to_owned);
        let id = || n.attribute("id").filter(|id| !is_automatic(id)).map(str::to_owned);
        label.or_else(title).or_else(id).filter(|name| !name.trim().is_empty())
    };
    let around =
        node.ancestors().take(DEPTH).filter(|n| n.is_element() && n.tag_name().name() != "svg");
    let found = around.filter(|n| !is_layer(*n)).find_map(named);
    let found = found.or_else(|| node.attribute("id").map(str::to_owned));
    // FreeSewing names groups `fs-stack-STACK-part-PART`.
    let clean = |name: String| {
        let part = name.strip_prefix("fs-stack-").and_then(|rest| rest.split_once("-part-"));
        let name = part.map_or(name.as_str(), |(_, part)| part);
        name.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    found.map(clean).unwrap_or_else(|| node.tag_name().name().into())
}

/// Returns whether a group is a layer, whose name is not that of a panel.
fn is_layer(node: Node<'_, '_>) -> bool {
    node.attributes().any(|a| a.name() == "groupmode" && a.value() == "layer")
}

/// Returns whether an identifier was made by a program, such as `path1234`.
fn is_automatic(id: &str) -> bool {
    let rest =
        id.trim_end_matches(|letter: char| letter.is_ascii_digit() || matches!(letter, '-' | '_'));
    let words = [
        "path", "rect", "g", "polygon", "polyline", "circle", "ellipse", "svg", "layer", "line",
        "fs",
    ];
    words.contains(&rest) || rest.is_empty()
}

/// Returns the words of this project about the panel of an element.
fn own(node: Node<'_, '_>, transform: Affine) -> Option<Own> {
    let group = own_group(node)?;
    let numbers = group.attribute("data-origin")?.split_whitespace().map(str::parse);
    let [x, y] = numbers.collect::<Result<Vec<f64>, _>>().ok()?.try_into().ok()?;
    let moved = transform * Point::new(x, y);
    let edges = node.attribute("data-edges").map(|all| all.split('|').map(unlisted).collect());
    Some(Own { origin: [moved.x, moved.y], edges: edges.unwrap_or_default() })
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
fn transform(node: Node<'_, '_>) -> Affine {
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

/// Returns an entry of a list that bars divide as a name.
fn unlisted(entry: &str) -> String {
    entry.replace("%7C", "|").replace("%25", "%")
}
