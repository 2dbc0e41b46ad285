//! Reader of drafts of FreeSewing, in JSON: parts with paths and named points, in mm, with y down.
//!
//! The outline of a part is its path `seam`. Its edges are named by the points at their ends; of
//! several points at one position the first by the alphabet counts. A part that is cut on the fold
//! is unfolded.

use std::collections::BTreeMap;

use drape_input::{Diagnostic, Diagnostics, Document};
use serde::Deserialize;

use super::diagnostic::{diagnostic, syntax, wrong_unit};
use crate::edge::{Curve, Edge, difference, distance};
use crate::note::Note;
use crate::panel::Panel;
use crate::pattern::Pattern;

/// Unit of drafts, in m.
const UNIT: f64 = 0.001;

/// Distance below which two points count as one, in m.
const SAME: f64 = 1e-6;

#[derive(Deserialize)]
struct Draft {
    parts: BTreeMap<String, Part>,
}

#[derive(Deserialize)]
struct Part {
    #[serde(default)]
    hidden: bool,
    #[serde(default)]
    paths: BTreeMap<String, Path>,
    #[serde(default)]
    points: BTreeMap<String, [f64; 2]>,
}

#[derive(Deserialize)]
struct Path {
    ops: Vec<Operation>,
}

#[derive(Deserialize)]
struct Operation {
    t: String,
    p: Option<[f64; 2]>,
    cp1: Option<[f64; 2]>,
    cp2: Option<[f64; 2]>,
}

/// Reader of one document with the mistakes and notes so far.
struct Reader<'a> {
    document: &'a Document,
    mistakes: Vec<Diagnostic>,
    notes: Vec<Note>,
    grainless: Vec<String>,
}

/// Returns the pattern of a draft. It has no seams: a draft does not say which edges are sewn.
pub(crate) fn read(document: &Document) -> Result<Pattern, Diagnostics> {
    let draft: Draft = serde_json::from_str(document.text()).map_err(|error| {
        syntax(document, &error).help("a draft has parts with paths, of ops, and points")
    })?;
    let mut reader =
        Reader { document, mistakes: Vec::new(), notes: Vec::new(), grainless: Vec::new() };
    let shown = draft.parts.iter().filter(|(_, part)| !part.hidden);
    let panels: Vec<Panel> = shown.filter_map(|(name, part)| reader.panel(name, part)).collect();
    if panels.is_empty() && reader.mistakes.is_empty() {
        let message = "no part of the draft is shown";
        reader.mistakes.push(Diagnostic::new(document.path(), message).help("draft it again"));
    }
    if !reader.grainless.is_empty() {
        reader.notes.push(Note::NoGrain { panels: reader.grainless });
    }
    if reader.mistakes.is_empty() {
        match Pattern::new(panels, Vec::new()) {
            Ok(pattern) => return Ok(pattern.with_notes(reader.notes)),
            Err(all) => reader.mistakes.extend(all.iter().map(|m| diagnostic(document, m))),
        }
    }
    Err(Diagnostics(reader.mistakes))
}

/// Returns a point of the draft in the panel's frame, in m, with y up.
fn flipped([x, y]: [f64; 2]) -> [f64; 2] {
    [UNIT * x, -UNIT * y]
}

impl Reader<'_> {
    /// Returns the panel of a part.
    fn panel(&mut self, name: &str, part: &Part) -> Option<Panel> {
        let place = format!("parts.{name}.paths");
        let Some(path) = part.paths.get("seam") else {
            let known: Vec<&str> = part.paths.keys().map(String::as_str).collect();
            let help = format!("an outline is the path \"seam\"; there are: {}", known.join(", "));
            let message = format!("{place} has no \"seam\"");
            self.mistakes.push(Diagnostic::new(self.document.path(), message).help(help));
            return None;
        };
        let mut edges = match edges(path, &part.points) {
            Ok(edges) => edges,
            Err(index) => {
                let message = format!("{place}.seam.ops[{index}] is no part of an outline");
                let help = "ops are M with p first, L with p, C with cp1, cp2 and p, Z last";
                self.mistakes.push(Diagnostic::new(self.document.path(), message).help(help));
                return None;
            }
        };
        let line = |word: &str| {
            let mut all = part.paths.iter().filter(|(key, _)| key.starts_with(word));
            let ops = &all.find(|(key, _)| key.ends_with("_line"))?.1.ops;
            Some([flipped(ops.first()?.p?), flipped(ops.last()?.p?)])
        };
        let fold = line("__macro_cutonfold");
        if let Some(edge) = fold.and_then(|fold| unfold(&mut edges, fold)) {
            self.notes.push(Note::Unfolded { panel: name.into(), edge });
        }
        // The fold lies along the grain where a draft shows no grainline.
        let grain = line("__macro_grainline").or(fold).map(|[from, to]| {
            let along = difference(to, from);
            // The line has no sense: the warp is taken within a right angle of the y axis.
            let up = if along[1] < 0.0 { -1.0 } else { 1.0 };
            (-up * along[0]).atan2(up * along[1])
        });
        if grain.is_none() {
            self.grainless.push(name.into());
        }
        let panel = match Panel::new(name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                self.mistakes.extend(all.iter().map(|m| diagnostic(self.document, m)));
                return None;
            }
        };
        self.mistakes.extend(wrong_unit(&panel).map(|m| diagnostic(self.document, &m)));
        if panel.was_clockwise() {
            self.notes.push(Note::Reversed { panel: name.into() });
        }
        panel.with_grain(grain.unwrap_or_default()).ok()
    }
}

/// Returns the edges of a path, or the number of the first operation that cannot belong to an
/// outline.
fn edges(path: &Path, points: &BTreeMap<String, [f64; 2]>) -> Result<Vec<Edge>, usize> {
    let mut edges: Vec<Edge> = Vec::new();
    let mut ends: Option<([f64; 2], [f64; 2])> = None;
    let mut closed = false;
    let mut push = |start: [f64; 2], end: [f64; 2], curve: Curve| {
        // Drafts contain lines without length.
        if distance(start, end) > SAME {
            let mut name = format!("{}-{}", point_name(points, start), point_name(points, end));
            let same = |e: &&Edge| e.name == name || e.name.starts_with(&format!("{name} "));
            match edges.iter().filter(same).count() {
                0 => {}
                n => name = format!("{name} {}", n + 1),
            }
            edges.push(Edge::line(name, start, end).curved(curve));
        }
    };
    for (index, operation) in path.ops.iter().enumerate() {
        let Operation { t, p, cp1, cp2 } = operation;
        let end = p.map(flipped);
        match (t.as_str(), ends, end) {
            _ if closed => return Err(index),
            ("M", None, Some(end)) => ends = Some((end, end)),
            ("L", Some((start, at)), Some(end)) => {
                push(at, end, Curve::Line);
                ends = Some((start, end));
            }
            ("C", Some((start, at)), Some(end)) => {
                let controls = [cp1.ok_or(index)?, cp2.ok_or(index)?].map(flipped);
                push(at, end, Curve::Cubic(controls));
                ends = Some((start, end));
            }
            ("Z", Some((start, at)), _) => {
                push(at, start, Curve::Line);
                closed = true;
            }
            _ => return Err(index),
        }
    }
    Ok(edges)
}

/// Returns the name of the point at a position: the first by the alphabet that a designer gave.
fn point_name(points: &BTreeMap<String, [f64; 2]>, at: [f64; 2]) -> String {
    let here = |p: &[f64; 2]| distance(flipped(*p), at) < SAME;
    let mut names: Vec<&String> =
        points.iter().filter(|(_, p)| here(p)).map(|(name, _)| name).collect();
    // Points that FreeSewing adds itself come last.
    names.sort_by_key(|name| name.starts_with('_') || *name == "gridAnchor");
    match names.first() {
        Some(name) => (*name).clone(),
        None => format!("({:.0},{:.0})", at[0] / UNIT, -at[1] / UNIT),
    }
}

/// Reflects an outline in its edge that lies on a line, and returns the name of that edge; `None`
/// if no edge does.
fn unfold(edges: &mut Vec<Edge>, [from, to]: [[f64; 2]; 2]) -> Option<String> {
    let length = distance(from, to);
    let along = difference(to, from).map(|x| x / length);
    let off = |p: [f64; 2]| {
        let arm = difference(p, from);
        along[0] * arm[1] - along[1] * arm[0]
    };
    let on_line =
        |e: &Edge| e.curve == Curve::Line && off(e.start).abs() < SAME && off(e.end).abs() < SAME;
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
