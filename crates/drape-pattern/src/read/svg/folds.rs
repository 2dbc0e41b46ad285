//! Statements of a drawing that a part is cut on the fold: texts, and lines that are named so.
//!
//! A text may run along a line that shows where the fold is, as FreeSewing's do, or along the fold
//! itself. Points are in the drawing's unit, with y down.

use std::str::FromStr;

use kurbo::Point;
use roxmltree::Node;

use super::geometry::{lines, transform};
use super::shapes::{is_aside, own_group, words};
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

/// Returns the statements that a drawing shows.
pub(crate) fn fold_marks(tree: &roxmltree::Document<'_>, styles: &Styles<'_>) -> Vec<FoldMark> {
    let shown = |node: &Node<'_, '_>| {
        let aside = node.parent().is_some_and(is_aside);
        node.is_element() && !aside && own_group(*node).is_none() && styles.shows(*node)
    };
    let mark = |node: Node<'_, '_>| match node.tag_name().name() {
        "text" => of_text(tree, node),
        "path" | "line" | "polyline" if says_on_fold(&words(node).replace(['-', '_'], " ")) => {
            Some(FoldMark { text: words(node), line: ends(node)? })
        }
        _ => None,
    };
    let marks = tree.descendants().filter(shown).filter_map(mark);
    marks.filter(|mark| mark.line.iter().flatten().all(|x| x.is_finite())).collect()
}

/// Returns the statement of a text, if it is one.
fn of_text(tree: &roxmltree::Document<'_>, node: Node<'_, '_>) -> Option<FoldMark> {
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

/// Returns two points on the line on which a text stands.
fn baseline(node: Node<'_, '_>) -> Option<[[f64; 2]; 2]> {
    let number = |part: Node<'_, '_>, key: &str| {
        let first = part.attribute(key)?.split([' ', ',']).next()?;
        Some(svgtypes::Length::from_str(first).ok()?.number)
    };
    let placed = node.descendants().filter(Node::is_element);
    let placed =
        placed.filter(|part| part.attribute("x").is_some() || part.attribute("y").is_some());
    let part = placed.into_iter().next().unwrap_or(node);
    let [x, y] = ["x", "y"].map(|key| number(part, key).unwrap_or(0.0));
    let moved = transform(part);
    let at = |x: f64, y: f64| {
        let point = moved * Point::new(x, y);
        [point.x, point.y]
    };
    Some([at(x, y), at(x + 1.0, y)])
}

/// Returns the first and the last point of a line.
fn ends(node: Node<'_, '_>) -> Option<[[f64; 2]; 2]> {
    let parts = lines(node)?;
    Some([parts.first()?.edges.first()?.start, parts.last()?.edges.last()?.end])
}
