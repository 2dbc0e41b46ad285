//! Marks on panels that other formats draw: grain lines, folds, notches.

use super::fit::distance_from_segment;
use crate::edge::{Curve, Edge, difference, distance};
use crate::note::PatternNote;

/// Distance below which a point lies on a line, in m.
const ON_LINE: f64 = 5e-5;

/// Angle to an edge below which a line runs along it, in rad: 5°.
const ALONG: f64 = 0.09;

/// Distance from the outline below which a mark is a notch of it, in m.
const NOTCH: f64 = 2e-3;

/// Returns the grain, in rad, of a line along the warp. The line has no sense: the warp is taken
/// within a right angle of the y axis.
pub(crate) fn grain_of([from, to]: [[f64; 2]; 2]) -> f64 {
    let along = difference(to, from);
    let up = if along[1] < 0.0 { -1.0 } else { 1.0 };
    // Not −0.
    (0.0 - up * along[0]).atan2(up * along[1])
}

/// Adds a notch to the edge nearest to a point; returns whether one is near enough.
pub(crate) fn add_notch(edges: &mut [Edge], at: [f64; 2]) -> bool {
    let finite = edges.iter().enumerate().filter(|(_, edge)| edge.is_finite());
    let nearest = finite.map(|(k, edge)| (k, edge.nearest(at)));
    let Some((number, [along, off])) = nearest.min_by(|a, b| a.1[1].total_cmp(&b.1[1])) else {
        return false;
    };
    if off > NOTCH {
        return false;
    }
    let notches = &mut edges[number].notches;
    notches.push(along);
    notches.sort_by(f64::total_cmp);
    true
}

/// Reflects an outline in its edges that lie on a line, and returns the name of the first of them;
/// `None` if no edge does, or if there are others between them.
pub(crate) fn unfold(edges: &mut Vec<Edge>, [from, to]: [[f64; 2]; 2]) -> Option<String> {
    let length = distance(from, to);
    let along = difference(to, from).map(|x| x / length);
    let off = |p: [f64; 2]| {
        let arm = difference(p, from);
        along[0] * arm[1] - along[1] * arm[0]
    };
    let is_on = |e: &Edge| {
        e.curve == Curve::Line && off(e.start).abs() < ON_LINE && off(e.end).abs() < ON_LINE
    };
    let count = edges.iter().filter(|edge| is_on(edge)).count();
    let before = |k: usize| &edges[(k + edges.len() - 1) % edges.len()];
    let first = (0..edges.len()).find(|&k| is_on(&edges[k]) && !is_on(before(k)))?;
    let in_a_row = (0..count).all(|k| is_on(&edges[(first + k) % edges.len()]));
    if !in_a_row || count == edges.len() {
        return None;
    }
    let mirror = |p: [f64; 2]| {
        let twice = 2.0 * off(p);
        [p[0] + twice * along[1], p[1] - twice * along[0]]
    };
    edges.rotate_left(first);
    let name = edges.drain(..count).next()?.name;
    let other: Vec<Edge> = edges.iter().rev().map(|e| e.reversed().mapped(true, mirror)).collect();
    edges.extend(other.into_iter().map(|e| Edge { name: format!("{} mirrored", e.name), ..e }));
    Some(name)
}

/// Reflects an outline in its straight edge that runs along a line, no farther from the line than a
/// distance in m, and returns the name of the edge; `None` if no edge does.
///
/// A line that says where the fold is may be drawn beside it.
pub(crate) fn unfold_beside(
    edges: &mut Vec<Edge>,
    line: [[f64; 2]; 2],
    reach: f64,
) -> Option<String> {
    let middle = [0, 1].map(|k| 0.5 * (line[0][k] + line[1][k]));
    let along = difference(line[1], line[0]);
    let turn = |chord: [f64; 2]| {
        let [cross, dot] =
            [chord[0] * along[1] - chord[1] * along[0], chord[0] * along[0] + chord[1] * along[1]];
        cross.abs().atan2(dot.abs())
    };
    let beside = edges
        .iter()
        .filter(|edge| edge.curve == Curve::Line && turn(difference(edge.end, edge.start)) < ALONG);
    let off = |edge: &&Edge| distance_from_segment(middle, [edge.start, edge.end]);
    let nearest = beside.min_by(|a, b| off(a).total_cmp(&off(b)))?;
    let fold = [nearest.start, nearest.end];
    (distance_from_segment(middle, fold) <= reach).then(|| unfold(edges, fold)).flatten()
}

/// Words by which a part says that it is cut on the fold, in small letters.
const ON_FOLD: [&str; 19] = [
    "on fold",
    "on the fold",
    "cutonfold",
    "stoffbruch",
    "im bruch",
    "au pli",
    "sur le pli",
    "sur la pliure",
    "op de vouw",
    "aan de vouw",
    "stofvouw",
    "al doblez",
    "en el doblez",
    "sobre el doblez",
    "sulla piega",
    "na dobra",
    "по сгибу",
    "わ裁",
    "わに裁",
];

/// Returns whether a text says that a part is cut on the fold.
pub(crate) fn says_on_fold(text: &str) -> bool {
    let words = text.to_lowercase();
    let words = words.split_whitespace().collect::<Vec<_>>().join(" ");
    words == "わ" || ON_FOLD.iter().any(|phrase| words.contains(phrase))
}

/// Outline of a file that may be a panel.
#[derive(Debug, Clone)]
pub(crate) struct Outline {
    pub(crate) name: String,
    pub(crate) edges: Vec<Edge>,
    /// Line of the file.
    pub(crate) line: Option<usize>,
    /// Origin of its frame, if the file says it.
    pub(crate) own: Option<[f64; 2]>,
    /// Names of its edges, if the file says them.
    pub(crate) names: Vec<String>,
}

/// Size below which a closed shape is a mark, in m.
const MARK: f64 = 0.02;

/// Share of the area of an outline from which on another one in it is its sewing line.
const SEWING: f64 = 0.6;

/// Returns those outlines that are panels, each under a name of its own. Small ones are marks; one
/// that lies in another is its sewing line if it is nearly as large, and else a mark or a hole.
pub(crate) fn outlines(all: Vec<Outline>, notes: &mut Vec<PatternNote>) -> Vec<Outline> {
    struct Measured {
        number: usize,
        outline: Outline,
        polygon: Vec<[f64; 2]>,
        area: f64,
    }
    let mut small = 0;
    let mut measured = Vec::new();
    for (number, outline) in all.into_iter().enumerate() {
        let polygon: Vec<[f64; 2]> = outline.edges.iter().flat_map(Edge::polyline).collect();
        let area = outline.edges.iter().map(Edge::area).sum::<f64>().abs();
        // What is not finite is answered where the panel is made.
        if size(&polygon) < MARK && outline.own.is_none() {
            small += 1;
        } else {
            measured.push(Measured { number, outline, polygon, area });
        }
    }
    if small > 0 {
        let reason = "marks, not panels".into();
        notes.push(PatternNote::LeftOut {
            part: format!("{small} closed shapes under 20 mm"),
            reason,
        });
    }
    measured.sort_by(|a, b| b.area.total_cmp(&a.area));
    let mut kept: Vec<Measured> = Vec::new();
    for inner in measured {
        let lies_in = |outer: &Measured| {
            outer.outline.own.is_none()
                && inner.outline.own.is_none()
                && inner.area < outer.area
                && sample(&inner.polygon).all(|p| inside(&outer.polygon, p))
        };
        let Some(index) = kept.iter().position(lies_in) else {
            kept.push(inner);
            continue;
        };
        let outer = &mut kept[index];
        if inner.area > SEWING * outer.area {
            let taken = format!(
                "panel {}: its outline is the inner of two, the sewing line",
                inner.outline.name
            );
            let reason =
                format!("the other, \"{}\", runs round it and is the cut line", outer.outline.name);
            notes.push(PatternNote::Taken { taken, reason });
            *outer = inner;
        } else {
            let part = format!("a closed shape \"{}\"", inner.outline.name);
            let reason = format!("it lies in panel {}: a hole or a mark", outer.outline.name);
            notes.push(PatternNote::LeftOut { part, reason });
        }
    }
    // In the order of the file.
    kept.sort_by_key(|one| one.number);
    let mut names: Vec<String> = Vec::new();
    let mut kept: Vec<Outline> = kept.into_iter().map(|one| one.outline).collect();
    for outline in &mut kept {
        let wanted = outline.name.clone();
        let mut number = 1;
        while names.contains(&outline.name) {
            number += 1;
            outline.name = format!("{wanted} {number}");
        }
        names.push(outline.name.clone());
    }
    kept
}

/// Returns some points of a polygon.
fn sample(polygon: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> {
    polygon.iter().copied().step_by(polygon.len() / 64 + 1)
}

/// Larger side of the bounding box of points.
fn size(points: &[[f64; 2]]) -> f64 {
    let side = |axis: usize| {
        let all = points.iter().map(|p| p[axis]);
        all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
    };
    side(0).max(side(1))
}

/// Low corner of the bounding box of points.
pub(crate) fn low_corner(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|axis| points.iter().map(|p| p[axis]).fold(f64::MAX, f64::min))
}

/// Returns whether a point lies in a polygon.
pub(crate) fn inside(polygon: &[[f64; 2]], p: [f64; 2]) -> bool {
    let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
    let crosses = |(a, b): &(&[f64; 2], &[f64; 2])| {
        (a[1] > p[1]) != (b[1] > p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    sides.filter(crosses).count() % 2 == 1
}
