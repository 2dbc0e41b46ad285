//! Marks on panels that other formats draw: grain lines, folds, notches.

use crate::edge::{Curve, Edge, cross, difference, distance, distance_from_segment, dot};
use crate::note::PatternNote;
use crate::polygon::{contains, range};

/// Distance below which a point lies on a line, in m.
const ON_LINE: f64 = 5e-5;

/// Angle to an edge below which a line is parallel to it, in rad: 5°.
const ALONG: f64 = 0.09;

/// Distance from the outline below which a mark is a notch of the outline, in m.
const NOTCH: f64 = 2e-3;

/// Returns the angle of the grain, in rad, for the line from `from` to `to` along the warp. The
/// line may point either way: the warp is taken within a right angle of the y axis.
pub(crate) fn grain_angle([from, to]: [[f64; 2]; 2]) -> f64 {
    let along = difference(to, from);
    let up = if along[1] < 0.0 { -1.0 } else { 1.0 };
    // The subtraction turns −0 into 0.
    (0.0 - up * along[0]).atan2(up * along[1])
}

/// Adds a notch to the nearest of `edges` to `at`. Returns whether an edge is near enough.
pub(crate) fn add_notch(edges: &mut [Edge], at: [f64; 2]) -> bool {
    let finite = edges.iter().enumerate().filter(|(_, edge)| edge.is_finite());
    let nearest = finite.map(|(k, edge)| (k, edge.nearest(at)));
    let Some((number, [along, gap])) = nearest.min_by(|a, b| a.1[1].total_cmp(&b.1[1])) else {
        return false;
    };
    if gap > NOTCH {
        return false;
    }
    let notches = &mut edges[number].notches;
    notches.push(along);
    notches.sort_by(f64::total_cmp);
    true
}

/// Straight line that an outline is reflected in.
struct FoldLine {
    from: [f64; 2],
    /// Unit vector.
    along: [f64; 2],
}

impl FoldLine {
    /// Returns the line through `from` and `to`.
    fn new([from, to]: [[f64; 2]; 2]) -> Self {
        let length = distance(from, to);
        Self { from, along: difference(to, from).map(|x| x / length) }
    }

    /// Returns the signed distance of `p` from the line, in m.
    fn distance(&self, p: [f64; 2]) -> f64 {
        cross(self.along, difference(p, self.from))
    }

    /// Returns the mirror image of `p`.
    fn reflect(&self, p: [f64; 2]) -> [f64; 2] {
        let twice = 2.0 * self.distance(p);
        [p[0] + twice * self.along[1], p[1] - twice * self.along[0]]
    }

    /// Returns whether `edge` is straight and lies on the line.
    fn has(&self, edge: &Edge) -> bool {
        edge.curve == Curve::Line
            && self.distance(edge.start).abs() < ON_LINE
            && self.distance(edge.end).abs() < ON_LINE
    }
}

/// Reflects the outline `edges` in its edges that lie on the line through both points of `line`,
/// and returns the name of the first of them; `None` if no edge does, or if there are other edges
/// between them.
pub(crate) fn unfold(edges: &mut Vec<Edge>, line: [[f64; 2]; 2]) -> Option<String> {
    let line = FoldLine::new(line);
    let count = edges.iter().filter(|edge| line.has(edge)).count();
    let first = (0..edges.len()).find(|&k| {
        let before = &edges[(k + edges.len() - 1) % edges.len()];
        line.has(&edges[k]) && !line.has(before)
    })?;
    let in_a_row = (0..count).all(|k| line.has(&edges[(first + k) % edges.len()]));
    if !in_a_row || count == edges.len() {
        return None;
    }

    edges.rotate_left(first);
    let name = edges.drain(..count).next()?.name;
    let mirrored: Vec<Edge> = edges
        .iter()
        .rev()
        .map(|edge| edge.reversed().mapped(true, |p| line.reflect(p)))
        .map(|edge| Edge { name: format!("{} mirrored", edge.name), ..edge })
        .collect();
    edges.extend(mirrored);
    Some(name)
}

/// Reflects the outline `edges` in its straight edge that is parallel to `line`, no farther from it
/// than `reach`, in m, and returns the name of the edge; `None` if there is no such edge.
///
/// Drawings may draw the line that says where the fold is beside the fold.
pub(crate) fn unfold_beside(
    edges: &mut Vec<Edge>,
    line: [[f64; 2]; 2],
    reach: f64,
) -> Option<String> {
    let middle = [0, 1].map(|k| 0.5 * (line[0][k] + line[1][k]));
    let along = difference(line[1], line[0]);
    let parallel = edges.iter().filter(|edge| {
        let chord = difference(edge.end, edge.start);
        edge.curve == Curve::Line
            && cross(chord, along).abs().atan2(dot(chord, along).abs()) < ALONG
    });
    let distances = parallel.map(|edge| {
        let fold = [edge.start, edge.end];
        (fold, distance_from_segment(middle, fold))
    });
    let (fold, gap) = distances.min_by(|a, b| a.1.total_cmp(&b.1))?;
    if gap <= reach { unfold(edges, fold) } else { None }
}

/// Words that say that a part is cut on the fold, in small letters.
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

/// Returns whether `text` says that a part is cut on the fold.
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
    /// Origin of its frame, if this project wrote the file. The outline then is a panel.
    pub(crate) origin: Option<[f64; 2]>,
    /// Names of its edges, if the file says them.
    pub(crate) names: Vec<String>,
}

/// Size below which a closed shape is a mark, in m.
const MARK: f64 = 0.02;

/// Least share of the area of an outline that an inner outline has if it is its sewing line.
const SEWING: f64 = 0.6;

/// Returns the panels among `all`, each under another name. Small outlines are marks. An
/// outline inside another one is its sewing line if it is nearly as large, and else a mark or a
/// hole. Adds `notes` on the outlines that are left out.
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
        // Outlines that are not finite are answered where the panel is made.
        if size(&polygon) < MARK && outline.origin.is_none() {
            small += 1;
        } else {
            measured.push(Measured { number, outline, polygon, area });
        }
    }

    if small > 0 {
        let reason = "marks, not panels".into();
        let part = format!("{small} closed shapes under 20 mm");
        notes.push(PatternNote::LeftOut { part, reason });
    }

    // The larger of two outlines comes first, so that it is known when the inner one is looked at.
    measured.sort_by(|a, b| b.area.total_cmp(&a.area));
    let mut kept: Vec<Measured> = Vec::new();
    for inner in measured {
        let index = kept.iter().position(|outer| {
            outer.outline.origin.is_none()
                && inner.outline.origin.is_none()
                && inner.area < outer.area
                && sample(&inner.polygon).all(|p| contains(&outer.polygon, p))
        });
        let Some(index) = index else {
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
    kept.sort_by_key(|outline| outline.number);
    let mut kept: Vec<Outline> = kept.into_iter().map(|measured| measured.outline).collect();
    number_repeated_names(&mut kept);
    kept
}

/// Adds a number to names that an earlier one of `outlines` has.
fn number_repeated_names(outlines: &mut [Outline]) {
    let mut names: Vec<String> = Vec::new();
    for outline in outlines {
        let wanted = outline.name.clone();
        let mut number = 1;
        while names.contains(&outline.name) {
            number += 1;
            outline.name = format!("{wanted} {number}");
        }
        names.push(outline.name.clone());
    }
}

/// Returns at most 64 corners of `polygon`, evenly spaced.
fn sample(polygon: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> {
    polygon.iter().copied().step_by(polygon.len() / 64 + 1)
}

/// Larger side of the bounding box of `points`.
fn size(points: &[[f64; 2]]) -> f64 {
    let [width, height] =
        [0, 1].map(|axis| range(points.iter().map(|p| p[axis]))).map(|[low, high]| high - low);
    width.max(height)
}

/// Low corner of the bounding box of `points`.
pub(crate) fn low_corner(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|axis| points.iter().map(|p| p[axis]).fold(f64::MAX, f64::min))
}
