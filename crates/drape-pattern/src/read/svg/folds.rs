//! Statements of a drawing that a part is cut on the fold: texts, and lines with such names.
//!
//! A text may run along a line that shows where the fold is, as texts of FreeSewing do, or along
//! the fold. Points are in the unit of the drawing, with y down.

use std::str::FromStr;

use kurbo::Point;
use roxmltree::Node;

use super::geometry::{lines, transform};
use super::shapes::{is_aside, panel_group, words};
use super::style::Styles;
use crate::read::marks::says_on_fold;

/// Statement that a part is cut on the fold.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FoldMark {
    /// Words of the drawing.
    pub(crate) text: String,
    /// Two points on a line along the fold or beside it.
    pub(crate) line: [[f64; 2]; 2],
}

/// Returns the statements that the drawing `tree` shows.
pub(crate) fn fold_marks(tree: &roxmltree::Document<'_>, styles: &Styles<'_>) -> Vec<FoldMark> {
    let mut marks = Vec::new();
    for node in tree.descendants().filter(Node::is_element) {
        let is_aside = node.parent().is_some_and(is_aside);
        if !is_aside && panel_group(node).is_none() && styles.shows(node) {
            marks.extend(fold_mark(tree, node));
        }
    }
    marks.retain(|mark| mark.line.iter().flatten().all(|x| x.is_finite()));
    marks
}

/// Returns the statement that `node` makes, if it makes one.
fn fold_mark(tree: &roxmltree::Document<'_>, node: Node<'_, '_>) -> Option<FoldMark> {
    match node.tag_name().name() {
        "text" => text_mark(tree, node),
        "path" | "line" | "polyline" if says_on_fold(&words(node).replace(['-', '_'], " ")) => {
            Some(FoldMark { text: words(node), line: ends(node)? })
        }
        _ => None,
    }
}

/// Returns the statement of the text `node`, if it is one.
fn text_mark(tree: &roxmltree::Document<'_>, node: Node<'_, '_>) -> Option<FoldMark> {
    let parts = node.descendants().filter_map(|part| part.is_text().then(|| part.text())?);
    let text = parts.collect::<Vec<_>>().join(" ").split_whitespace().collect::<Vec<_>>().join(" ");
    if !says_on_fold(&text) {
        return None;
    }
    let along = node.descendants().find(|part| part.tag_name().name() == "textPath");
    let along = along.and_then(|part| {
        let link = part.attributes().find(|a| a.name() == "href")?.value().strip_prefix('#')?;
        ends(tree.descendants().find(|other| other.attribute("id") == Some(link))?)
    });
    Some(FoldMark { text, line: along.or_else(|| baseline(node))? })
}

/// Returns two points on the line on which the text `node` stands.
fn baseline(node: Node<'_, '_>) -> Option<[[f64; 2]; 2]> {
    let mut placed = node.descendants().filter(|part| {
        part.is_element() && (part.attribute("x").is_some() || part.attribute("y").is_some())
    });
    let part = placed.next().unwrap_or(node);
    let [x, y] = ["x", "y"].map(|key| first_length(part, key).unwrap_or(0.0));
    let transform = transform(part);
    Some([x, x + 1.0].map(|x| {
        let point = transform * Point::new(x, y);
        [point.x, point.y]
    }))
}

/// Returns the first of the lengths that the attribute `key` of `part` lists.
fn first_length(part: Node<'_, '_>, key: &str) -> Option<f64> {
    let first = part.attribute(key)?.split([' ', ',']).next()?;
    Some(svgtypes::Length::from_str(first).ok()?.number)
}

/// Returns the first and the last point of the line `node`.
fn ends(node: Node<'_, '_>) -> Option<[[f64; 2]; 2]> {
    let parts = lines(node)?;
    Some([parts.first()?.edges.first()?.start, parts.last()?.edges.last()?.end])
}
