//! Reader of drawings in SVG: closed shapes are panels.
//!
//! `shapes` collects the drawn shapes, in the unit of the drawing, with transforms applied
//! (`geometry`). `style` says which shapes the drawing hides, `folds` which parts are cut on the
//! fold, and `scale` how long the unit is. Size, enclosure and name distinguish outlines from
//! marks. A drawing that this project wrote has names, origins and seams in it. In other drawings
//! edges are numbered and nothing is sewn.
//!
//! `roxmltree` reads the tree, `svgtypes` reads paths, lengths and transforms. Unlike `usvg`, which
//! renders, they keep names and double precision.

mod folds;
mod geometry;
mod scale;
mod shapes;
mod style;

use drape_input::{Advice, Diagnostic, Diagnostics, Document, Remedy, Subject};

use self::folds::{FoldMark, fold_marks};
use self::geometry::segment_count;
use self::scale::scale;
use self::shapes::{Role, Shape, collect};
use self::style::Styles;
use super::chains::joined;
use super::diagnostic::diagnostic;
use super::marks::{Outline, add_notch, grain_angle, outlines, unfold_beside};
use super::request::Request;
use super::size::{Doubt, wrong_size};
use super::toml_file;
use super::unit::{SVG_UNITS, Unit};
use crate::edge::{Edge, control_box, distance_from_segment};
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::polygon::contains;
use crate::sketch::Sketch;

/// Namespace of the metadata that this project writes into a drawing.
const NAMESPACE: &str = "urn:drape:pattern";

/// Largest number of elements and attributes of a drawing.
const MOST_NODES: u32 = 1_000_000;

/// Largest number of edges of an outline. A shape with more is a picture that was traced.
const MOST_EDGES: usize = 20_000;

/// Largest number of segments of all lines of a drawing. More are a picture, and take gigabytes.
const MOST_SEGMENTS: usize = 1_000_000;

/// Largest distance of a fold from the line or the text that marks it, in m. FreeSewing draws the
/// line 15 mm inside.
const FOLD_REACH: f64 = 0.03;

/// Largest distance of a text outside of a panel that still belongs to the panel, in m.
const BESIDE: f64 = 0.01;

/// Returns the pattern of the drawing `document`, and adds its lines to `sketch`. `request` may
/// state the unit.
pub(crate) fn read(
    document: &Document,
    request: &Request,
    sketch: &mut Sketch,
) -> Result<Pattern, Diagnostics> {
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        nodes_limit: MOST_NODES,
        ..Default::default()
    };
    let tree = roxmltree::Document::parse_with_options(document.text(), options)
        .map_err(|error| syntax(document, &error))?;
    let root = tree.root_element();
    let fail = |message: &str, help: &str| {
        Diagnostics::from(Diagnostic::new(document.path(), message).help(help))
    };
    if root.tag_name().name() != "svg" {
        return Err(fail("the file is no SVG: its root is no <svg>", "save the drawing as SVG"));
    }
    if let Some(page) = root.attribute("data-page") {
        let message = format!("this is page {page} of a print, not the whole drawing");
        return Err(fail(&message, "read the *.toml or the drawing that was printed"));
    }

    let segments: usize = tree.descendants().map(segment_count).sum();
    if segments > MOST_SEGMENTS {
        let message = format!("its lines have {segments} segments, more than {MOST_SEGMENTS}");
        return Err(fail(&message, "delete what is no part of the pattern, such as a picture"));
    }

    let styles = Styles::new(&tree);
    let collected = collect(&tree, &styles);
    let (scale, taken) = scale(document, &tree, request, &collected.shapes)?;
    let largest = scale * collected.shapes.iter().map(Shape::extent).fold(0.0, f64::max);
    let scale_reason = taken.to_string();
    let mut notes = collected.notes;
    notes.push(taken);

    let mut folds = fold_marks(&tree, &styles);
    for mark in &mut folds {
        mark.line = mark.line.map(|point| up(scale, point));
    }
    let mut reader = Reader { document, sketch, scale, folds, mistakes: Vec::new(), notes };
    let panels = reader.panels(collected.shapes);
    if panels.is_empty() && reader.mistakes.is_empty() {
        let message = format!(
            "the drawing has no closed shape of 20 mm or more; its largest shape is {:.1} mm: {scale_reason}",
            1e3 * largest
        );
        let file = document.path().to_owned();
        let help = Advice::from("close the outlines of the panels, and convert clones to paths")
            .with(Remedy::CorrectUnit { file, units: SVG_UNITS });
        return Err(Diagnostic::new(document.path(), message).help(help).into());
    }
    reader.pattern(panels, &tree, request)
}

/// Returns a point of a drawing whose unit is `scale`, in m, as a point in m with y up.
fn up(scale: f64, [x, y]: [f64; 2]) -> [f64; 2] {
    [scale * x, -scale * y]
}

/// Returns the diagnostic of `error`, a mistake of the XML of `document`.
fn syntax(document: &Document, error: &roxmltree::Error) -> Diagnostics {
    let place = error.pos();
    let text = error.to_string();
    let message = text.split(" at ").next().unwrap_or(&text).to_owned();
    let mut diagnostic = Diagnostic::new(document.path(), message).on_line(place.row as usize);
    diagnostic.column = Some(place.col as usize);
    diagnostic.help("save the drawing again as plain SVG").into()
}

/// Reader of one drawing with the mistakes and notes so far.
struct Reader<'a> {
    document: &'a Document,
    sketch: &'a mut Sketch,
    /// Length of the unit of the drawing, in m.
    scale: f64,
    /// Statements that a part is cut on the fold, in m with y up.
    folds: Vec<FoldMark>,
    mistakes: Vec<Diagnostic>,
    notes: Vec<PatternNote>,
}

/// Open line of a drawing.
struct OpenLine {
    name: String,
    /// Line of the file.
    line: usize,
    edges: Vec<Edge>,
}

/// Outlines and marks among the shapes of a drawing, in m with y up.
#[derive(Default)]
struct Sorted {
    outlines: Vec<Outline>,
    /// Ends of grain lines.
    grains: Vec<[[f64; 2]; 2]>,
    /// Ends of notches.
    notches: Vec<[[f64; 2]; 2]>,
    open: Vec<OpenLine>,
}

/// Returns the first and the last point of `edges`, which are in a row.
fn ends(edges: &[Edge]) -> Option<[[f64; 2]; 2]> {
    Some([edges.first()?.start, edges.last()?.end])
}

/// Returns the middle of the line between two points.
fn middle([a, b]: [[f64; 2]; 2]) -> [f64; 2] {
    [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]
}

impl Reader<'_> {
    /// Returns the panels among `shapes`.
    fn panels(&mut self, shapes: Vec<Shape>) -> Vec<Panel> {
        let Sorted { outlines: candidates, grains, notches, open } = self.sorted(shapes);
        let outlines = outlines(candidates, &mut self.notes);

        // Open lines on a panel are marks.
        let boxes: Vec<[[f64; 2]; 2]> =
            outlines.iter().map(|outline| control_box(&outline.edges)).collect();
        for line in open {
            let [low, high] = control_box(&line.edges);
            let is_on_panel = boxes.iter().any(|[from, to]| {
                (0..2).all(|k| from[k] - 1e-3 <= low[k] && high[k] <= to[k] + 1e-3)
            });
            if !is_on_panel {
                self.check_open(line);
            }
        }
        outlines.into_iter().filter_map(|outline| self.panel(outline, &grains, &notches)).collect()
    }

    /// Returns the outlines and marks of `shapes`.
    fn sorted(&mut self, shapes: Vec<Shape>) -> Sorted {
        let scale = self.scale;
        let mut sorted = Sorted::default();
        for shape in shapes {
            let line = shape.line;
            let mut closed = Vec::new();
            let mut open = Vec::new();
            for mut part in shape.parts {
                part.edges =
                    part.edges.iter().map(|edge| edge.mapped(true, |p| up(scale, p))).collect();
                let is_closed = part.closed;
                let edges = part.settled();
                if is_closed { closed.push(edges) } else { open.push(edges) }
            }

            match shape.role {
                Role::Grain => sorted.grains.extend(open.iter().filter_map(|edges| ends(edges))),
                Role::Notch => sorted.notches.extend(open.iter().filter_map(|edges| ends(edges))),
                Role::Other => {
                    closed.extend(joined(&mut open));
                    sorted.open.extend(open.into_iter().map(|edges| {
                        let name = shape.name.clone();
                        OpenLine { name, line, edges }
                    }));
                }
                Role::Outline => closed.extend(open.into_iter().filter(|e| !e.is_empty())),
            }
            for edges in closed {
                if edges.len() > MOST_EDGES {
                    self.fail_edge_count(&shape.name, line, edges.len());
                    continue;
                }
                let written = shape.written.as_ref();
                sorted.outlines.push(Outline {
                    name: shape.name.clone(),
                    edges,
                    line: Some(line),
                    origin: written.map(|written| up(scale, written.origin)),
                    names: written.map(|written| written.edges.clone()).unwrap_or_default(),
                });
            }
        }
        sorted
    }

    /// Adds the mistake that the outline `name` on `line` of the file has too many edges.
    fn fail_edge_count(&mut self, name: &str, line: usize, edges: usize) {
        let message = format!("the outline \"{name}\" has {edges} edges, more than {MOST_EDGES}");
        let help = "simplify the path in the drawing, or delete it if it is a picture";
        let mistake = Diagnostic::new(self.document.path(), message).on_line(line).help(help);
        self.mistakes.push(mistake);
    }

    /// Adds a mistake if `open` is almost an outline. Other open lines are marks.
    fn check_open(&mut self, open: OpenLine) {
        let OpenLine { name, line, edges } = open;
        let (Some(first), Some(last)) = (edges.first(), edges.last()) else { return };
        let length: f64 = edges.iter().map(Edge::length).sum();
        let gap = crate::edge::distance(first.start, last.end);
        if edges.len() > 1 && length > 0.1 && gap < 0.05 * length {
            let message = format!(
                "the outline \"{name}\" is open: {} between its ends",
                crate::length::Millimetres(gap)
            );
            let help = "join the ends in the drawing, or delete the line";
            self.sketch.add_outline(&name, &edges);
            let mistake = Diagnostic::new(self.document.path(), message).on_line(line).help(help);
            self.mistakes.push(mistake.about(Subject::Panel(name)));
        }
    }

    /// Returns the panel of `outline`, with the `grains` and `notches` that are drawn on it.
    fn panel(
        &mut self,
        outline: Outline,
        grains: &[[[f64; 2]; 2]],
        notches: &[[[f64; 2]; 2]],
    ) -> Option<Panel> {
        let Outline { name, mut edges, line, origin, names } = outline;
        if names.len() == edges.len() {
            edges.iter_mut().zip(names).for_each(|(edge, name)| edge.name = name);
        } else {
            for (number, edge) in (1_usize..).zip(&mut edges) {
                edge.name = number.to_string();
            }
            if origin.is_some() {
                let taken = format!("panel {name}: its edges are numbered anew");
                let reason = "their number is another than when the drawing was written".into();
                self.notes.push(PatternNote::Taken { taken, reason });
            }
        }

        // Marks belong to the panel that their middle lies on.
        let polygon: Vec<[f64; 2]> = edges.iter().flat_map(Edge::polyline).collect();
        let grain = grains.iter().find(|line| contains(&polygon, middle(**line)));
        for [from, to] in notches.iter().filter(|line| contains(&polygon, middle(**line))) {
            let _ = add_notch(&mut edges, *from) || add_notch(&mut edges, *to);
        }
        if origin.is_none() {
            self.unfold(&name, &mut edges, &polygon);
        }

        let polygon: Vec<[f64; 2]> = edges.iter().flat_map(Edge::polyline).collect();
        let origin = origin.unwrap_or_else(|| super::marks::low_corner(&polygon));
        let edges: Vec<Edge> = edges
            .iter()
            .map(|edge| edge.mapped(false, |p| crate::edge::difference(p, origin)))
            .collect();
        self.sketch.add_outline(&name, &edges);
        let panel = match Panel::new(name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                let answers = all.iter().map(|mistake| diagnostic(self.document, mistake));
                self.mistakes.extend(answers.map(|answer| Diagnostic { line, ..answer }));
                return None;
            }
        };
        if let Some(mistake) = wrong_size(&panel) {
            let file = self.document.path().to_owned();
            let remedy = Remedy::CorrectUnit { file, units: SVG_UNITS };
            let answer = diagnostic(self.document, &mistake).help(remedy);
            self.mistakes.push(Diagnostic { line, ..answer });
        }
        match grain {
            Some(line) => panel.with_grain(grain_angle(*line)).ok(),
            None => {
                match self.notes.last_mut() {
                    Some(PatternNote::NoGrain { panels }) => panels.push(panel.name().into()),
                    _ => {
                        self.notes.push(PatternNote::NoGrain { panels: vec![panel.name().into()] });
                    }
                }
                Some(panel)
            }
        }
    }

    /// Unfolds the outline `edges` of the panel `name` if the drawing marks it as cut on the fold.
    /// Adds a note on the fold, or on a half. `polygon` has the corners of the outline.
    fn unfold(&mut self, name: &str, edges: &mut Vec<Edge>, polygon: &[[f64; 2]]) {
        let marks = self.folds.iter().filter(|mark| {
            let at = middle(mark.line);
            let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
            let distances = sides.map(|(a, b)| distance_from_segment(at, [*a, *b]));
            contains(polygon, at) || distances.fold(f64::MAX, f64::min) < BESIDE
        });
        let marks: Vec<&FoldMark> = marks.collect();
        let Some(mark) = marks.first() else { return };
        let fold = marks.iter().find_map(|mark| unfold_beside(edges, mark.line, FOLD_REACH));
        self.notes.push(match fold {
            Some(edge) => PatternNote::Unfolded { panel: name.into(), edge },
            None => PatternNote::Half { panel: name.into(), text: mark.text.clone() },
        });
    }

    /// Returns the pattern of `panels`, with the metadata that this project wrote into the drawing
    /// `tree`.
    fn pattern(
        mut self,
        panels: Vec<Panel>,
        tree: &roxmltree::Document<'_>,
        request: &Request,
    ) -> Result<Pattern, Diagnostics> {
        Diagnostics::check(std::mem::take(&mut self.mistakes))?;
        let metadata = tree.descendants().find(|node| node.has_tag_name((NAMESPACE, "pattern")));
        if metadata.is_none() {
            self.notes.push(PatternNote::NoSeams { format: "a drawing" });
        }
        if let Some(doubt) = Doubt::for_drawing(&panels, self.scale) {
            // A user can confirm only a unit that has a name.
            let asks = request.unit.is_none() && metadata.is_none();
            match Unit::from_length(self.scale).filter(|_| asks) {
                Some(taken) => {
                    return Err(doubt.question(self.document, request, taken.word()).into());
                }
                None => self.notes.push(doubt.note()),
            }
        }

        let pattern = Pattern::new(panels, Vec::new()).map_err(|all| {
            Diagnostics(all.iter().map(|m| diagnostic(self.document, m)).collect())
        })?;
        let pattern = pattern.with_notes(self.notes);
        let Some(text) = metadata.and_then(|node| node.text()) else { return Ok(pattern) };

        let inner = Document::new(self.document.path(), text);
        let completed = toml_file::decode(&inner).and_then(|mut file| {
            let removed = file.remove_unknown(&pattern);
            let read = file.pattern(Some(pattern), self.sketch)?;
            let mut notes = read.file_notes();
            if !removed.is_empty() {
                notes.push(PatternNote::SeamsLeftOut { seams: removed });
            }
            Ok(read.with_notes(notes))
        });
        completed.map_err(|mistakes| {
            // Lines of the metadata are no lines of the drawing.
            let placed = mistakes.0.into_iter().map(|mistake| Diagnostic {
                message: format!("metadata of the drawing: {}", mistake.message),
                line: None,
                column: None,
                span: None,
                ..mistake
            });
            Diagnostics(placed.collect())
        })
    }
}
