//! Reader of drafts of FreeSewing, in JSON: parts with paths and named points, in mm, with y down.
//!
//! The outline of a part is its path `seam`, or else its largest closed path; a part without one is
//! left out. Its edges are named by the points at their ends; of several points at one position the
//! first by the alphabet counts. A part that is cut on the fold is unfolded.

use std::collections::BTreeMap;

use drape_input::{Diagnostic, Diagnostics, Document};
use serde::Deserialize;
use serde_json::Value;

use super::diagnostic::{diagnostic, syntax};
use super::marks::{add_notch, grain_of, says_on_fold, unfold};
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
    parts: BTreeMap<String, Part>,
    /// What FreeSewing itself hands to programs that draw: stacks of parts.
    #[serde(default)]
    stacks: BTreeMap<String, Stack>,
}

#[derive(Deserialize)]
struct Stack {
    parts: Vec<Part>,
}

#[derive(Deserialize)]
struct Part {
    #[serde(default)]
    hidden: bool,
    #[serde(default)]
    paths: BTreeMap<String, Path>,
    #[serde(default)]
    points: BTreeMap<String, Point>,
    #[serde(default)]
    snippets: BTreeMap<String, Snippet>,
}

#[derive(Deserialize)]
struct Path {
    ops: Vec<Operation>,
    hidden: Option<bool>,
    /// Whether older versions of FreeSewing draw it.
    render: Option<bool>,
    #[serde(default)]
    attributes: Value,
}

/// Returns the values of an attribute in the attributes of what is drawn: classes, styles, texts.
fn values<'a>(attributes: &'a Value, key: &str) -> Vec<&'a str> {
    match &attributes["list"][key] {
        Value::Array(all) => all.iter().filter_map(Value::as_str).collect(),
        value => value.as_str().into_iter().collect(),
    }
}

impl Path {
    /// Returns whether the draft shows it.
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

    /// Returns the first and the last point.
    fn ends(&self) -> Option<[[f64; 2]; 2]> {
        let mut points = self.ops.iter().filter_map(|operation| operation.p.as_ref());
        Some([points.next()?.flipped(), points.next_back()?.flipped()])
    }
}

impl Part {
    /// Returns the texts that the draft shows along paths and at points.
    fn texts(&self) -> impl Iterator<Item = &str> {
        let along = self.paths.values().map(|path| &path.attributes);
        let at = self.points.values().filter_map(Point::attributes);
        along.chain(at).flat_map(|attributes| values(attributes, "data-text"))
    }

    /// Returns the ends of a path along which the draft says that the part is cut on the fold.
    fn said_fold(&self) -> Option<[[f64; 2]; 2]> {
        let says =
            |path: &&Path| values(&path.attributes, "data-text").into_iter().any(says_on_fold);
        self.paths.values().find(says)?.ends()
    }
}

#[derive(Deserialize)]
struct Operation {
    #[serde(alias = "type")]
    t: String,
    #[serde(alias = "to")]
    p: Option<Point>,
    cp1: Option<Point>,
    cp2: Option<Point>,
}

#[derive(Deserialize)]
struct Snippet {
    #[serde(default)]
    def: String,
    anchor: Option<Point>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Point {
    Pair([f64; 2]),
    Named {
        x: f64,
        y: f64,
        #[serde(default)]
        attributes: Value,
    },
}

impl Point {
    /// Returns the point in the panel's frame, in m, with y up.
    fn flipped(&self) -> [f64; 2] {
        let [x, y] = match self {
            Self::Pair(pair) => *pair,
            Self::Named { x, y, .. } => [*x, *y],
        };
        [UNIT * x, -UNIT * y]
    }

    /// Returns its attributes, if it has some.
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
    grainless: Vec<String>,
}

/// Returns the pattern of a draft. It has no seams: a draft does not say which edges are sewn.
pub(crate) fn read(document: &Document, sketch: &mut Sketch) -> Result<Pattern, Diagnostics> {
    let draft: Draft = serde_json::from_str(document.text()).map_err(|error| {
        syntax(document, &error).help("a draft has parts with paths, of ops, and points")
    })?;
    let mut reader =
        Reader { document, sketch, mistakes: Vec::new(), notes: Vec::new(), grainless: Vec::new() };
    let mut parts: Vec<(String, &Part)> =
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
        let left: Vec<String> = reader.notes.iter().map(ToString::to_string).collect();
        let message = match left.is_empty() {
            true => "no part of the draft is shown".to_owned(),
            false => format!("no part of the draft is a panel: {}", left.join("; ")),
        };
        let help = "draft it again, with parts whose outline is the path \"seam\"";
        reader.mistakes.push(Diagnostic::new(document.path(), message).help(help));
    }
    if !reader.grainless.is_empty() {
        reader.notes.push(PatternNote::NoGrain { panels: reader.grainless });
    }
    reader.notes.push(PatternNote::NoSeams { format: "a FreeSewing draft" });
    if reader.mistakes.is_empty() {
        let doubt = Doubt::of_file(&panels, UNIT);
        reader.notes.extend(doubt.map(|doubt| doubt.note()));
        match Pattern::new(panels, Vec::new()) {
            Ok(pattern) => return Ok(pattern.with_notes(reader.notes)),
            Err(all) => reader.mistakes.extend(all.iter().map(|m| diagnostic(document, m))),
        }
    }
    Err(Diagnostics(reader.mistakes))
}

impl Reader<'_> {
    /// Returns the panel of a part, or a note on why it is none.
    fn panel(&mut self, name: &str, part: &Part) -> Option<Panel> {
        let points: Points =
            part.points.iter().map(|(name, point)| (name.clone(), point.flipped())).collect();
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
        let line = |word: &str| {
            let mut all = part.paths.iter().filter(|(key, _)| key.starts_with(word));
            all.find(|(key, _)| key.ends_with("_line"))?.1.ends()
        };
        notches(&mut edges, part);
        let fold = line("__macro_cutonfold").or_else(|| part.said_fold());
        match fold.and_then(|fold| unfold(&mut edges, fold)) {
            Some(edge) => self.notes.push(PatternNote::Unfolded { panel: name.into(), edge }),
            None => {
                let text = part.texts().find(|text| says_on_fold(text));
                let text = text.or(fold.map(|_| "cut on fold"));
                let half =
                    text.map(|text| PatternNote::Half { panel: name.into(), text: text.into() });
                self.notes.extend(half);
            }
        }
        // The fold lies along the grain where a draft shows no grainline.
        let grain = line("__macro_grainline").or(fold).map(grain_of);
        self.sketch.add(name, &edges);
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

    /// Returns the path that is the outline of a part: the one of the usual name, or else the
    /// closed path round the largest area; a note if there is none.
    fn outline<'p>(&mut self, name: &str, part: &'p Part) -> Option<(&'p str, &'p Path)> {
        if let Some((key, path)) = part.paths.get_key_value("seam")
            && path.is_shown()
        {
            return Some((key, path));
        }
        let closed = part.paths.iter().filter(|(key, path)| {
            let last = path.ops.last().is_some_and(|op| kind(op) == "Z");
            last && path.is_shown() && !key.starts_with("__") && !is_allowance(key)
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

/// Returns whether a path is named as one of a seam allowance.
fn is_allowance(key: &str) -> bool {
    key == "sa" || key.starts_with("saBase") || key.ends_with("SA") || key.ends_with("Sa")
}

/// Returns the letter of an operation in SVG, however it is written.
fn kind(operation: &Operation) -> &str {
    match operation.t.as_str() {
        "move" => "M",
        "line" => "L",
        "curve" => "C",
        "close" => "Z",
        "noop" => "",
        other => other,
    }
}

/// Puts the notches of a part on its edges.
fn notches(edges: &mut [Edge], part: &Part) {
    let all = part.snippets.values().filter(|snippet| snippet.def.ends_with("notch"));
    for at in all.filter_map(|snippet| Some(snippet.anchor.as_ref()?.flipped())) {
        add_notch(edges, at);
    }
}

/// Returns the edges of a path, or the number of the first operation that cannot belong to an
/// outline.
fn edges(path: &Path, points: &Points) -> Result<Vec<Edge>, usize> {
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
        let Operation { p, cp1, cp2, .. } = operation;
        let end = p.as_ref().map(Point::flipped);
        match (kind(operation), ends, end) {
            ("", ..) => {}
            _ if closed => return Err(index),
            ("M", None, Some(end)) => ends = Some((end, end)),
            ("L", Some((start, at)), Some(end)) => {
                push(at, end, Curve::Line);
                ends = Some((start, end));
            }
            ("C", Some((start, at)), Some(end)) => {
                let [Some(first), Some(second)] = [cp1, cp2] else { return Err(index) };
                let controls = [first, second].map(Point::flipped);
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
fn point_name(points: &Points, at: [f64; 2]) -> String {
    let here = |p: &[f64; 2]| distance(*p, at) < SAME;
    let mut names: Vec<&String> =
        points.iter().filter(|(_, p)| here(p)).map(|(name, _)| name).collect();
    // Points that FreeSewing adds itself come last.
    names.sort_by_key(|name| name.starts_with('_') || *name == "gridAnchor");
    match names.first() {
        Some(name) => (*name).clone(),
        None => format!("({:.0},{:.0})", at[0] / UNIT, -at[1] / UNIT),
    }
}
