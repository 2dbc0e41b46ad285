//! Reader of drafts of FreeSewing, in JSON: parts with paths and named points, in mm, with y down.
//!
//! The outline of a part is its path `seam`, or else its largest closed path. A part without a
//! closed path is left out. Edges are named by the points at their ends. Of several points at one
//! position the first by the alphabet counts. A part that is cut on the fold is unfolded.

use std::collections::BTreeMap;

use drape_input::{Diagnostic, Diagnostics, Document};
use serde::Deserialize;
use serde_json::Value;

use super::diagnostic::{diagnostic, syntax};
use super::marks::{add_notch, grain_angle, says_on_fold, unfold};
use super::size::{Doubt, wrong_size};
use crate::edge::{Curve, Edge, distance};
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::sketch::Sketch;

/// Unit of drafts, in m.
const UNIT: f64 = 0.001;

/// Distance below which two points count as one, in m.
const SAME: f64 = 1e-6;

#[derive(Deserialize)]
struct Draft {
    /// Parts by name, as scripts write them.
    #[serde(default)]
    parts: BTreeMap<String, DraftPart>,
    /// Stacks of parts, as FreeSewing hands them to programs that draw.
    #[serde(default)]
    stacks: BTreeMap<String, DraftStack>,
}

#[derive(Deserialize)]
struct DraftStack {
    parts: Vec<DraftPart>,
}

#[derive(Deserialize)]
struct DraftPart {
    #[serde(default)]
    hidden: bool,
    #[serde(default)]
    paths: BTreeMap<String, DraftPath>,
    #[serde(default)]
    points: BTreeMap<String, DraftPoint>,
    #[serde(default)]
    snippets: BTreeMap<String, Snippet>,
}

#[derive(Deserialize)]
struct DraftPath {
    ops: Vec<Operation>,
    hidden: Option<bool>,
    /// Whether older versions of FreeSewing draw it.
    render: Option<bool>,
    #[serde(default)]
    attributes: Value,
}

/// Returns the values of `key` in `attributes`, attributes of a path or a point.
fn values<'a>(attributes: &'a Value, key: &str) -> Vec<&'a str> {
    match &attributes["list"][key] {
        Value::Array(all) => all.iter().filter_map(Value::as_str).collect(),
        value => value.as_str().into_iter().collect(),
    }
}

impl DraftPath {
    /// Returns whether the draft shows the path.
    fn is_shown(&self) -> bool {
        let values = |key: &str| values(&self.attributes, key);
        let classes = values("class").join(" ");
        let style: String = values("style").join(";").split_whitespace().collect();
        !(self.hidden == Some(true)
            || self.render == Some(false)
            || classes.split_whitespace().any(|class| class == "hidden")
            || values("display").contains(&"none")
            || values("visibility").contains(&"hidden")
            || values("opacity").contains(&"0")
            || ["display:none", "visibility:hidden"].iter().any(|hidden| style.contains(hidden)))
    }

    /// Returns the first and the last point, in m.
    fn ends(&self) -> Option<[[f64; 2]; 2]> {
        let mut points = self.ops.iter().filter_map(|operation| operation.p.as_ref());
        Some([points.next()?.flipped(), points.next_back()?.flipped()])
    }
}

impl DraftPart {
    /// Returns the texts that the draft shows along paths and at points.
    fn texts(&self) -> impl Iterator<Item = &str> {
        let along = self.paths.values().map(|path| &path.attributes);
        let at = self.points.values().filter_map(DraftPoint::attributes);
        along.chain(at).flat_map(|attributes| values(attributes, "data-text"))
    }

    /// Returns the ends of a path along which the draft says that the part is cut on the fold, in
    /// m.
    fn said_fold(&self) -> Option<[[f64; 2]; 2]> {
        let mut paths = self.paths.values();
        let path = paths
            .find(|path| values(&path.attributes, "data-text").into_iter().any(says_on_fold))?;
        path.ends()
    }

    /// Returns the ends of the line that the macro `name` draws, in m.
    fn macro_line(&self, name: &str) -> Option<[[f64; 2]; 2]> {
        let mut paths = self.paths.iter();
        let (_, path) = paths.find(|(key, _)| key.starts_with(name) && key.ends_with("_line"))?;
        path.ends()
    }

    /// Returns the points by their names, in m, with y up.
    fn flipped_points(&self) -> Points {
        self.points.iter().map(|(name, point)| (name.clone(), point.flipped())).collect()
    }
}

#[derive(Deserialize)]
struct Operation {
    #[serde(alias = "type")]
    t: String,
    #[serde(alias = "to")]
    p: Option<DraftPoint>,
    cp1: Option<DraftPoint>,
    cp2: Option<DraftPoint>,
}

#[derive(Deserialize)]
struct Snippet {
    #[serde(default)]
    def: String,
    anchor: Option<DraftPoint>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum DraftPoint {
    Pair([f64; 2]),
    Named {
        x: f64,
        y: f64,
        #[serde(default)]
        attributes: Value,
    },
}

impl DraftPoint {
    /// Returns the point in the panel's frame, in m, with y up.
    fn flipped(&self) -> [f64; 2] {
        let [x, y] = match self {
            Self::Pair(pair) => *pair,
            Self::Named { x, y, .. } => [*x, *y],
        };
        [UNIT * x, -UNIT * y]
    }

    /// Returns the attributes of the point, if it has some.
    fn attributes(&self) -> Option<&Value> {
        match self {
            Self::Pair(_) => None,
            Self::Named { attributes, .. } => Some(attributes),
        }
    }
}

/// Points of a part by name, in m, with y up.
type Points = BTreeMap<String, [f64; 2]>;

/// Reader of one document with the mistakes and notes so far.
struct Reader<'a> {
    document: &'a Document,
    sketch: &'a mut Sketch,
    mistakes: Vec<Diagnostic>,
    notes: Vec<PatternNote>,
    /// Names of panels without a grainline.
    grainless: Vec<String>,
}

/// Returns the pattern of the draft `document`, and adds its lines to `sketch`. The pattern has no
/// seams: a draft does not say which edges are sewn.
pub(crate) fn read(document: &Document, sketch: &mut Sketch) -> Result<Pattern, Diagnostics> {
    let draft: Draft = serde_json::from_str(document.text()).map_err(|error| {
        syntax(document, &error).help("a draft has parts with paths, of ops, and points")
    })?;
    let mut reader =
        Reader { document, sketch, mistakes: Vec::new(), notes: Vec::new(), grainless: Vec::new() };

    // A stack with several parts gives them numbers.
    let mut parts: Vec<(String, &DraftPart)> =
        draft.parts.iter().map(|(name, part)| (name.clone(), part)).collect();
    for (name, stack) in &draft.stacks {
        parts.extend(stack.parts.iter().enumerate().map(|(number, part)| match number {
            0 => (name.clone(), part),
            _ => (format!("{name} {}", number + 1), part),
        }));
    }
    let shown = parts.iter().filter(|(_, part)| !part.hidden);
    let panels: Vec<Panel> = shown.filter_map(|(name, part)| reader.panel(name, part)).collect();
    if panels.is_empty() && reader.mistakes.is_empty() {
        let reasons: Vec<String> = reader.notes.iter().map(ToString::to_string).collect();
        let message = if reasons.is_empty() {
            "no part of the draft is shown".to_owned()
        } else {
            format!("no part of the draft is a panel: {}", reasons.join("; "))
        };
        let help = "draft it again, with parts whose outline is the path \"seam\"";
        reader.mistakes.push(Diagnostic::new(document.path(), message).help(help));
    }

    if !reader.grainless.is_empty() {
        reader.notes.push(PatternNote::NoGrain { panels: reader.grainless });
    }
    reader.notes.push(PatternNote::NoSeams { format: "a FreeSewing draft" });
    if reader.mistakes.is_empty() {
        let doubt = Doubt::for_file(&panels, UNIT);
        reader.notes.extend(doubt.map(|doubt| doubt.note()));
        match Pattern::new(panels, Vec::new()) {
            Ok(pattern) => return Ok(pattern.with_notes(reader.notes)),
            Err(all) => reader.mistakes.extend(all.iter().map(|m| diagnostic(document, m))),
        }
    }
    Err(Diagnostics(reader.mistakes))
}

impl Reader<'_> {
    /// Returns the panel of `part`, under the name `name`. Adds a note on a part that is no panel.
    fn panel(&mut self, name: &str, part: &DraftPart) -> Option<Panel> {
        let points = part.flipped_points();
        let (key, path) = self.outline(name, part)?;
        let mut edges = match edges(path, &points) {
            Ok(edges) => edges,
            Err(index) => {
                let message =
                    format!("parts.{name}.paths.{key}.ops[{index}] is no part of an outline");
                let help = "ops are M with p first, L with p, C with cp1, cp2 and p, Z last";
                self.mistakes.push(Diagnostic::new(self.document.path(), message).help(help));
                return None;
            }
        };

        notches(&mut edges, part);
        let fold = part.macro_line("__macro_cutonfold").or_else(|| part.said_fold());
        match fold.and_then(|fold| unfold(&mut edges, fold)) {
            Some(edge) => self.notes.push(PatternNote::Unfolded { panel: name.into(), edge }),
            None => {
                let text = part.texts().find(|text| says_on_fold(text));
                let text = text.or(fold.map(|_| "cut on fold"));
                let panel = name.to_owned();
                self.notes.extend(text.map(|text| PatternNote::Half { panel, text: text.into() }));
            }
        }

        // The fold lies along the grain where a draft shows no grainline.
        let grain = part.macro_line("__macro_grainline").or(fold).map(grain_angle);
        self.sketch.add_outline(name, &edges);
        let panel = match Panel::new(name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                self.mistakes.extend(all.iter().map(|m| diagnostic(self.document, m)));
                return None;
            }
        };
        if grain.is_none() {
            self.grainless.push(name.into());
        }
        self.mistakes.extend(wrong_size(&panel).map(|m| diagnostic(self.document, &m)));
        if panel.was_clockwise() {
            self.notes.push(PatternNote::Reversed { panel: name.into() });
        }
        panel.with_grain(grain.unwrap_or_default()).ok()
    }

    /// Returns the outline of the part `name` with its key: the path `seam`, or else the closed
    /// path round the largest area. Adds a note if there is none.
    fn outline<'p>(&mut self, name: &str, part: &'p DraftPart) -> Option<(&'p str, &'p DraftPath)> {
        if let Some((key, path)) = part.paths.get_key_value("seam")
            && path.is_shown()
        {
            return Some((key, path));
        }

        let closed = part.paths.iter().filter(|(key, path)| {
            let is_closed = path.ops.last().is_some_and(|operation| letter(operation) == "Z");
            is_closed && path.is_shown() && !key.starts_with("__") && !is_allowance(key)
        });
        let areas = closed.filter_map(|(key, path)| {
            let edges = edges(path, &Points::new()).ok()?;
            let area: f64 = edges.iter().map(Edge::area).sum();
            Some((area.abs(), key, path))
        });
        let (_, key, path) = match areas.max_by(|a, b| a.0.total_cmp(&b.0)) {
            Some(largest) if largest.0 > 0.0 => largest,
            _ => {
                let shown = part.paths.iter().filter(|(_, path)| path.is_shown());
                let known: Vec<&str> = shown.map(|(key, _)| key.as_str()).collect();
                let reason = if part.paths.is_empty() {
                    "the part is empty".to_owned()
                } else if known.is_empty() {
                    "all of its paths are hidden".to_owned()
                } else {
                    format!("no closed path among {}", known.join(", "))
                };
                self.notes.push(PatternNote::LeftOut { part: format!("part {name}"), reason });
                return None;
            }
        };

        self.notes.push(PatternNote::Taken {
            taken: format!("panel {name}: its outline is the path \"{key}\""),
            reason: "there is no \"seam\", and it is the closed path round the largest area".into(),
        });
        Some((key, path))
    }
}

/// Returns whether the path with the key `key` is named as a seam allowance.
fn is_allowance(key: &str) -> bool {
    key == "sa" || key.starts_with("saBase") || key.ends_with("SA") || key.ends_with("Sa")
}

/// Returns the letter of `operation` in SVG, from its letter or its word.
fn letter(operation: &Operation) -> &str {
    match operation.t.as_str() {
        "move" => "M",
        "line" => "L",
        "curve" => "C",
        "close" => "Z",
        "noop" => "",
        other => other,
    }
}

/// Adds the notches of `part` to its `edges`.
fn notches(edges: &mut [Edge], part: &DraftPart) {
    let all = part.snippets.values().filter(|snippet| snippet.def.ends_with("notch"));
    for at in all.filter_map(|snippet| Some(snippet.anchor.as_ref()?.flipped())) {
        add_notch(edges, at);
    }
}

/// Returns the edges of `path`, named by `points`.
///
/// # Errors
/// The number of the first operation that cannot belong to an outline.
fn edges(path: &DraftPath, points: &Points) -> Result<Vec<Edge>, usize> {
    let mut edges: Vec<Edge> = Vec::new();
    // The first point and the current point.
    let mut ends: Option<([f64; 2], [f64; 2])> = None;
    let mut closed = false;
    for (index, operation) in path.ops.iter().enumerate() {
        let Operation { p, cp1, cp2, .. } = operation;
        let end = p.as_ref().map(DraftPoint::flipped);
        match (letter(operation), ends, end) {
            ("", ..) => {}
            _ if closed => return Err(index),
            ("M", None, Some(end)) => ends = Some((end, end)),
            ("L", Some((start, at)), Some(end)) => {
                push(&mut edges, Edge::line(edge_name(points, at, end), at, end));
                ends = Some((start, end));
            }
            ("C", Some((start, at)), Some(end)) => {
                let [Some(first), Some(second)] = [cp1, cp2] else { return Err(index) };
                let controls = [first, second].map(DraftPoint::flipped);
                let line = Edge::line(edge_name(points, at, end), at, end);
                push(&mut edges, line.curved(Curve::Cubic(controls)));
                ends = Some((start, end));
            }
            ("Z", Some((start, at)), _) => {
                push(&mut edges, Edge::line(edge_name(points, at, start), at, start));
                closed = true;
            }
            _ => return Err(index),
        }
    }
    Ok(edges)
}

/// Adds `edge` to `edges`, unless it has no length: drafts contain such lines. A name that an edge
/// has already gets a number.
fn push(edges: &mut Vec<Edge>, mut edge: Edge) {
    if distance(edge.start, edge.end) <= SAME {
        return;
    }
    let numbered = format!("{} ", edge.name);
    let same = edges.iter().filter(|e| e.name == edge.name || e.name.starts_with(&numbered));
    match same.count() {
        0 => {}
        count => edge.name = format!("{} {}", edge.name, count + 1),
    }
    edges.push(edge);
}

/// Returns the name of the edge from `start` to `end`: the names of both points.
fn edge_name(points: &Points, start: [f64; 2], end: [f64; 2]) -> String {
    format!("{}-{}", point_name(points, start), point_name(points, end))
}

/// Returns the name of the point at `at`: the first by the alphabet that a designer gave.
fn point_name(points: &Points, at: [f64; 2]) -> String {
    let here = points.iter().filter(|(_, p)| distance(**p, at) < SAME);
    let mut names: Vec<&String> = here.map(|(name, _)| name).collect();
    // Points that FreeSewing adds itself come last.
    names.sort_by_key(|name| name.starts_with('_') || *name == "gridAnchor");
    match names.first() {
        Some(name) => (*name).clone(),
        None => format!("({:.0},{:.0})", at[0] / UNIT, -at[1] / UNIT),
    }
}
