//! Shapes of a drawing in its unit, with y down: paths, polygons, rectangles, circles, ellipses,
//! lines.

use kurbo::{Affine, Point};
use roxmltree::Node;

use super::geometry::{DEPTH, lines, transform};
use super::style::Styles;
use crate::edge::control_extent;
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
    /// Shape whose role its form decides.
    Other,
}

/// Attributes that this project writes about a panel.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WrittenPanel {
    /// Origin of its frame.
    pub(crate) origin: [f64; 2],
    /// Names of its edges.
    pub(crate) edges: Vec<String>,
}

/// Shape of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shape {
    pub(crate) name: String,
    /// Line of the file.
    pub(crate) line: usize,
    pub(crate) role: Role,
    pub(crate) parts: Vec<Subpath>,
    /// Attributes of its panel, if this project wrote the drawing.
    pub(crate) written: Option<WrittenPanel>,
}

impl Shape {
    /// Larger side of its bounding box, with control points, in the unit of the drawing.
    pub(crate) fn extent(&self) -> f64 {
        control_extent(self.parts.iter().flat_map(|part| &part.edges))
    }
}

/// Shapes of a drawing, with notes on elements that are left out.
pub(crate) struct Collected {
    pub(crate) shapes: Vec<Shape>,
    pub(crate) notes: Vec<PatternNote>,
}

/// Returns the shapes that the drawing `tree` shows.
pub(crate) fn collect(tree: &roxmltree::Document<'_>, styles: &Styles<'_>) -> Collected {
    let mut collected = Collected { shapes: Vec::new(), notes: Vec::new() };
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
        let written = written_panel(node, transform(node));
        collected.shapes.push(Shape { name: name(node), line, role, parts, written });
    }

    // A user must know of shapes that are left out: a panel may be among them.
    if clones > 0 {
        let reason = "clones are not followed: unlink them in the drawing".into();
        let part = format!("{clones} clones (<use>)");
        collected.notes.push(PatternNote::LeftOut { part, reason });
    }
    if hidden > 0 {
        let reason = "the drawing hides them: show their layer or style if they are meant".into();
        let part = format!("{hidden} hidden shapes");
        collected.notes.push(PatternNote::LeftOut { part, reason });
    }
    for part in unread {
        let reason = "its path cannot be read".into();
        collected.notes.push(PatternNote::LeftOut { part, reason });
    }
    collected
}

/// Returns the words that describe the element `node`: its class, identifier and label.
pub(crate) fn words(node: Node<'_, '_>) -> String {
    let label = node.attributes().find(|a| a.name() == "label").map(|a| a.value());
    let all = [node.attribute("class"), node.attribute("id"), label];
    all.into_iter().flatten().collect::<Vec<_>>().join(" ").to_lowercase()
}

/// Returns the group of a panel that this project wrote and that `node` lies in.
pub(crate) fn panel_group<'a, 'i>(node: Node<'a, 'i>) -> Option<Node<'a, 'i>> {
    node.ancestors().take(DEPTH).find(|n| n.attribute("data-panel").is_some())
}

/// Returns the role of the element `node`; `None` if it has none.
fn role(node: Node<'_, '_>) -> Option<Role> {
    let words = words(node);
    let classes: Vec<&str> = words.split_whitespace().collect();
    if panel_group(node).is_some() {
        return if classes.contains(&"outline") {
            Some(Role::Outline)
        } else if classes.contains(&"grain") {
            Some(Role::Grain)
        } else if classes.contains(&"notch") {
            Some(Role::Notch)
        } else {
            node.attribute("data-edges").map(|_| Role::Outline)
        };
    }

    if words.contains("grain") {
        Some(Role::Grain)
    } else if words.contains("notch") {
        Some(Role::Notch)
    } else if ["sa", "note", "help", "hidden"].iter().any(|class| classes.contains(class)) {
        // Allowances, notes and hidden paths of FreeSewing.
        None
    } else {
        Some(Role::Other)
    }
}

/// Returns whether the element `node` only defines or describes something.
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

/// Returns the name of the element `node`: its label, title or identifier, or else the name of the
/// nearest group round it.
fn name(node: Node<'_, '_>) -> String {
    if let Some(panel) = panel_group(node).and_then(|group| group.attribute("data-panel")) {
        return panel.into();
    }
    let around =
        node.ancestors().take(DEPTH).filter(|n| n.is_element() && n.tag_name().name() != "svg");
    let given = around.filter(|n| !is_layer(*n)).find_map(given_name);
    match given.or_else(|| node.attribute("id").map(str::to_owned)) {
        Some(name) => {
            // FreeSewing names groups `fs-stack-STACK-part-PART`.
            let part = name.strip_prefix("fs-stack-").and_then(|rest| rest.split_once("-part-"));
            let name = part.map_or(name.as_str(), |(_, part)| part);
            name.split_whitespace().collect::<Vec<_>>().join(" ")
        }
        None => node.tag_name().name().into(),
    }
}

/// Returns the name that a person gave to `node`: its label, its title or its identifier.
fn given_name(node: Node<'_, '_>) -> Option<String> {
    let label = node.attributes().find(|a| a.name() == "label").map(|a| a.value());
    let mut children = node.children();
    let name = label
        .or_else(|| children.find(|child| child.tag_name().name() == "title")?.text())
        .or_else(|| node.attribute("id").filter(|id| !is_automatic(id)))?;
    (!name.trim().is_empty()).then(|| name.to_owned())
}

/// Returns whether the group `node` is a layer. The name of a layer is not the name of a panel.
fn is_layer(node: Node<'_, '_>) -> bool {
    node.attributes().any(|a| a.name() == "groupmode" && a.value() == "layer")
}

/// Returns whether a program made the identifier `id`, such as `path1234`.
fn is_automatic(id: &str) -> bool {
    let rest =
        id.trim_end_matches(|letter: char| letter.is_ascii_digit() || matches!(letter, '-' | '_'));
    let words = [
        "path", "rect", "g", "polygon", "polyline", "circle", "ellipse", "svg", "layer", "line",
        "fs",
    ];
    words.contains(&rest) || rest.is_empty()
}

/// Returns the attributes that this project wrote about the panel of `node`. `transform` is the
/// transform of `node`.
fn written_panel(node: Node<'_, '_>, transform: Affine) -> Option<WrittenPanel> {
    let group = panel_group(node)?;
    let numbers = group.attribute("data-origin")?.split_whitespace().map(str::parse);
    let [x, y] = numbers.collect::<Result<Vec<f64>, _>>().ok()?.try_into().ok()?;
    let moved = transform * Point::new(x, y);
    let edges = node.attribute("data-edges").map(|all| all.split('|').map(unlisted).collect());
    Some(WrittenPanel { origin: [moved.x, moved.y], edges: edges.unwrap_or_default() })
}

/// Returns the name that `entry`, an entry of a list that bars divide, stands for.
fn unlisted(entry: &str) -> String {
    entry.replace("%7C", "|").replace("%25", "%")
}
