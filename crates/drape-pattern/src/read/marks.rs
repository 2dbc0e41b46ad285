//! Marks on panels that other formats draw: grain lines, folds, notches.

use crate::edge::{Curve, Edge, difference, distance};

/// Distance below which a point lies on a line, in m.
const ON_LINE: f64 = 1e-5;

/// Distance from the outline below which a mark is a notch of it, in m.
const NOTCH: f64 = 2e-3;

/// Returns the grain, in rad, of a line along the warp. The line has no sense: the warp is taken within a right
/// angle of the y axis.
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

/// Reflects an outline in its edge that lies on a line, and returns the name of that edge; `None` if no
/// edge does.
pub(crate) fn unfold(edges: &mut Vec<Edge>, [from, to]: [[f64; 2]; 2]) -> Option<String> {
    let length = distance(from, to);
    let along = difference(to, from).map(|x| x / length);
    let off = |p: [f64; 2]| {
        let arm = difference(p, from);
        along[0] * arm[1] - along[1] * arm[0]
    };
    let on_line =
        |e: &Edge| e.curve == Curve::Line && off(e.start).abs() < ON_LINE && off(e.end).abs() < ON_LINE;
    let fold = edges.iter().position(on_line)?;
    let mirror = |p: [f64; 2]| {
        let twice = 2.0 * off(p);
        [p[0] + twice * along[1], p[1] - twice * along[0]]
    };
    edges.rotate_left(fold);
    let name = edges.remove(0).name;
    let other: Vec<Edge> = edges.iter().rev().map(|e| e.reversed().mapped(true, mirror)).collect();
    edges.extend(other.into_iter().map(|e| Edge { name: format!("{} mirrored", e.name), ..e }));
    Some(name)
}
