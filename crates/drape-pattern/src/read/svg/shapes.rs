//! Shapes of a drawing in its own unit, with y down: paths, polygons, rectangles, circles,
//! ellipses, lines.

use kurbo::{Affine, Point};
use roxmltree::Node;

use super::geometry::{DEPTH, lines, transform};
use super::style::Styles;
use crate::edge::Edge;
use crate::note::PatternNote;
use crate::read::svg_path::Subpath;

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
    pub(crate) notes: Vec<PatternNote>,
}

/// Returns the shapes that a drawing shows.
pub(crate) fn collect(tree: &roxmltree::Document<'_>, styles: &Styles<'_>) -> Collected {
    let mut found = Collected { shapes: Vec::new(), notes: Vec::new() };
    let (mut clones, mut hidden) = (0, 0);
    let mut unread = Vec::new();
    for node in tree.descendants().filter(Node::is_element) {
        let tag = node.tag_name().name();
        clones += usize::from(tag == "use" && !is_aside(node) && styles.shows(node));
        if !matches!(tag, "path" | "polygon" | "polyline" | "rect" | "circle" | "ellipse" | "line")
            || is_aside(node)
        {
            continue;
        }
        if !styles.shows(node) {
            hidden += 1;
            continue;
        }
        let Some(role) = role(node) else { continue };
        let line = tree.text_pos_at(node.range().start).row as usize;
        let Some(parts) = lines(node) else {
            unread.push(format!("{} of line {line}", name(node)));
            continue;
        };
        if parts.is_empty() {
            continue;
        }
        let own = own(node, transform(node));
        found.shapes.push(Shape { name: name(node), line, role, parts, own });
    }
    if clones > 0 {
        let reason = "clones are not followed: unlink them in the drawing".into();
        found.notes.push(PatternNote::LeftOut { part: format!("{clones} clones (<use>)"), reason });
    }
    if hidden > 0 {
        let reason = "the drawing hides them: show their layer or style if they are meant".into();
        found.notes.push(PatternNote::LeftOut { part: format!("{hidden} hidden shapes"), reason });
    }
    for part in unread {
        let reason = "its path cannot be read".into();
        found.notes.push(PatternNote::LeftOut { part, reason });
    }
    found
}

/// Returns the words that tell what an element is: its class, identifier and label.
pub(crate) fn words(node: Node<'_, '_>) -> String {
    let label = node.attributes().find(|a| a.name() == "label").map(|a| a.value());
    let all = [node.attribute("class"), node.attribute("id"), label];
    all.into_iter().flatten().collect::<Vec<_>>().join(" ").to_lowercase()
}

/// Returns the group of a panel that this project wrote, round an element.
pub(crate) fn own_group<'a, 'i>(node: Node<'a, 'i>) -> Option<Node<'a, 'i>> {
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

/// Returns whether an element only defines or describes something.
pub(crate) fn is_aside(node: Node<'_, '_>) -> bool {
    node.ancestors().filter(Node::is_element).any(|n| {
        matches!(
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
        )
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

/// Returns an entry of a list that bars divide as a name.
fn unlisted(entry: &str) -> String {
    entry.replace("%7C", "|").replace("%25", "%")
}
