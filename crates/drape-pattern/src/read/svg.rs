//! Reader of drawings in SVG: closed shapes are panels.
//!
//! `shapes` collects what is drawn, in the drawing's unit, with transforms applied (`geometry`);
//! `style` says what the drawing hides, `folds` what is cut on the fold; `scale` says how long that
//! unit is. Then outlines are told from marks by size, by what lies in what, and by name. A drawing
//! that this project wrote has names, origins and seams in it; of others the edges are numbered and
//! nothing is sewn.
//!
//! The tree is `roxmltree`'s and paths, lengths and transforms are read by `svgtypes`: unlike
//! `usvg`, which renders, they keep names and double precision.

mod folds;
mod geometry;
mod scale;
mod shapes;
mod style;

use drape_input::{Diagnostic, Diagnostics, Document, Subject};

use self::folds::{FoldMark, fold_marks};
use self::scale::scale;
use self::shapes::{Role, Shape, collect};
use self::style::Styles;
use super::chains::joined;
use super::diagnostic::diagnostic;
use super::fit::distance_from_segment;
use super::marks::{Outline, add_notch, grain_of, inside, outlines, unfold_beside};
use super::request::Request;
use super::size::{Doubt, wrong_size};
use super::toml_file;
use super::unit::Unit;
use crate::edge::Edge;
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::sketch::Sketch;

/// Namespace of what this project writes into a drawing.
const NAMESPACE: &str = "urn:drape:pattern";

/// Largest number of elements and attributes of a drawing.
const NODES: u32 = 1_000_000;

/// Largest number of edges of an outline; more are a picture that was traced.
const EDGES: usize = 20_000;

/// Largest distance of a fold from the line or the text that says that it is one, in m: FreeSewing
/// draws the line 15 mm inside.
const FOLD_REACH: f64 = 0.03;

/// Largest distance of a text outside of a panel that still belongs to the panel, in m.
const BESIDE: f64 = 0.01;

/// Returns the pattern of a drawing.
pub(crate) fn read(
    document: &Document,
    request: &Request,
    sketch: &mut Sketch,
) -> Result<Pattern, Diagnostics> {
    let options =
        roxmltree::ParsingOptions { allow_dtd: true, nodes_limit: NODES, ..Default::default() };
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
    let styles = Styles::new(&tree);
    let collected = collect(&tree, &styles);
    let (scale, taken) = scale(document, &tree, request, &collected.shapes)?;
    let largest = scale * collected.shapes.iter().map(Shape::extent).fold(0.0, f64::max);
    let why = taken.to_string();
    let mut notes = collected.notes;
    notes.push(taken);
    let up = |[x, y]: [f64; 2]| [scale * x, -scale * y];
    let folds = fold_marks(&tree, &styles).into_iter();
    let folds = folds.map(|mark| FoldMark { line: mark.line.map(up), ..mark }).collect();
    let mut reader = Reader { document, sketch, scale, folds, mistakes: Vec::new(), notes };
    let panels = reader.panels(collected.shapes);
    if panels.is_empty() && reader.mistakes.is_empty() {
        let message = format!(
            "the drawing has no closed shape of 20 mm or more; its largest shape is {:.1} mm: {why}",
            1e3 * largest
        );
        let help = "close the outlines of the panels, and convert clones to paths; if the unit is \
                    wrong, say it: drape convert … --unit mm (cm, m, in, pt, px)";
        return Err(fail(&message, help));
    }
    reader.pattern(panels, &tree, request)
}

/// Returns the answer to a mistake of the XML.
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
    /// Length of the drawing's unit, in m.
    scale: f64,
    /// Statements that a part is cut on the fold, in m with y up.
    folds: Vec<FoldMark>,
    mistakes: Vec<Diagnostic>,
    notes: Vec<PatternNote>,
}

/// Returns the corners of the bounding box of edges, with their control points.
fn extent(edges: &[Edge]) -> [[f64; 2]; 2] {
    let numbers: Vec<f64> = edges.iter().flat_map(Edge::coordinates).collect();
    let axis = |axis: usize| numbers.iter().skip(axis).step_by(2).copied();
    let low = [0, 1].map(|k| axis(k).fold(f64::MAX, f64::min));
    [low, [0, 1].map(|k| axis(k).fold(f64::MIN, f64::max))]
}

impl Reader<'_> {
    /// Returns the panels among the shapes.
    fn panels(&mut self, shapes: Vec<Shape>) -> Vec<Panel> {
        let scale = self.scale;
        let up = |[x, y]: [f64; 2]| [scale * x, -scale * y];
        let (mut outlines_found, mut grains, mut notches) = (Vec::new(), Vec::new(), Vec::new());
        let mut opened = Vec::new();
        for shape in shapes {
            let line = shape.line;
            let mut parts = Vec::new();
            let mut open = Vec::new();
            for part in shape.parts {
                let mut part = part;
                part.edges = part.edges.iter().map(|edge| edge.mapped(true, up)).collect();
                let closed = part.closed;
                let edges = part.settled();
                if closed { parts.push(edges) } else { open.push(edges) }
            }
            let ends = |edges: &Vec<Edge>| Some([edges.first()?.start, edges.last()?.end]);
            match shape.role {
                Role::Grain => grains.extend(open.iter().filter_map(ends)),
                Role::Notch => notches.extend(open.iter().filter_map(ends)),
                Role::Other => {
                    parts.extend(joined(&mut open));
                    opened.extend(open.into_iter().map(|edges| (shape.name.clone(), line, edges)));
                }
                Role::Outline => parts.extend(open.into_iter().filter(|e| !e.is_empty())),
            }
            for edges in parts {
                if edges.len() > EDGES {
                    self.fine(&shape.name, line, edges.len());
                    continue;
                }
                outlines_found.push(Outline {
                    name: shape.name.clone(),
                    edges,
                    line: Some(line),
                    own: shape.own.as_ref().map(|own| up(own.origin)),
                    names: shape.own.as_ref().map(|own| own.edges.clone()).unwrap_or_default(),
                });
            }
        }
        let found = outlines(outlines_found, &mut self.notes);
        let boxes: Vec<[[f64; 2]; 2]> =
            found.iter().map(|outline| extent(&outline.edges)).collect();
        for (name, line, edges) in opened {
            let [low, high] = extent(&edges);
            let within = |[from, to]: &[[f64; 2]; 2]| {
                (0..2).all(|k| from[k] - 1e-3 <= low[k] && high[k] <= to[k] + 1e-3)
            };
            // Lines on a panel are marks.
            if !boxes.iter().any(within) {
                self.opened(name, line, &edges);
            }
        }
        found.into_iter().filter_map(|outline| self.panel(outline, &grains, &notches)).collect()
    }

    /// Adds the mistake of an outline with too many edges.
    fn fine(&mut self, name: &str, line: usize, edges: usize) {
        let message = format!("the outline \"{name}\" has {edges} edges, more than {EDGES}");
        let help = "simplify the path in the drawing, or delete it if it is a picture";
        let mistake = Diagnostic::new(self.document.path(), message).on_line(line).help(help);
        self.mistakes.push(mistake);
    }

    /// Adds a mistake of a shape that is almost an outline; other open lines are marks.
    fn opened(&mut self, name: String, line: usize, edges: &[Edge]) {
        let (Some(first), Some(last)) = (edges.first(), edges.last()) else { return };
        let length: f64 = edges.iter().map(Edge::length).sum();
        let gap = crate::edge::distance(first.start, last.end);
        if edges.len() > 1 && length > 0.1 && gap < 0.05 * length {
            let message = format!(
                "the outline \"{name}\" is open: {} between its ends",
                crate::length::Millimetres(gap)
            );
            let help = "join the ends in the drawing, or delete the line";
            self.sketch.add(&name, edges);
            let mistake = Diagnostic::new(self.document.path(), message).on_line(line).help(help);
            self.mistakes.push(mistake.about(Subject::Panel(name)));
        }
    }

    /// Returns the panel of an outline, with the grain and the notches that are drawn on it.
    fn panel(
        &mut self,
        outline: Outline,
        grains: &[[[f64; 2]; 2]],
        notches: &[[[f64; 2]; 2]],
    ) -> Option<Panel> {
        let Outline { name, mut edges, line, own, names } = outline;
        let at = |mut answer: Diagnostic| {
            answer.line = line;
            answer
        };
        if names.len() == edges.len() {
            edges.iter_mut().zip(names).for_each(|(edge, name)| edge.name = name);
        } else {
            let numbers = 1..;
            edges
                .iter_mut()
                .zip(numbers)
                .for_each(|(edge, n): (_, usize)| edge.name = n.to_string());
            if own.is_some() {
                let taken = format!("panel {name}: its edges are numbered anew");
                let reason = "their number is another than when the drawing was written".into();
                self.notes.push(PatternNote::Taken { taken, reason });
            }
        }
        let polygon: Vec<[f64; 2]> = edges.iter().flat_map(Edge::polyline).collect();
        let middle = |[a, b]: &[[f64; 2]; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let grain = grains.iter().find(|line| inside(&polygon, middle(line)));
        for [from, to] in notches.iter().filter(|line| inside(&polygon, middle(line))) {
            let _ = add_notch(&mut edges, *from) || add_notch(&mut edges, *to);
        }
        if own.is_none() {
            self.unfold(&name, &mut edges, &polygon);
        }
        let polygon: Vec<[f64; 2]> = edges.iter().flat_map(Edge::polyline).collect();
        let origin = own.unwrap_or_else(|| super::marks::low_corner(&polygon));
        let moved = edges.iter().map(|e| e.mapped(false, |p| crate::edge::difference(p, origin)));
        let edges: Vec<Edge> = moved.collect();
        self.sketch.add(&name, &edges);
        let panel = match Panel::new(name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                self.mistakes.extend(all.iter().map(|m| at(diagnostic(self.document, m))));
                return None;
            }
        };
        self.mistakes.extend(wrong_size(&panel).map(|m| {
            let help =
                "if the unit is wrong, say it: drape convert … --unit mm (cm, m, in, pt, px)";
            at(diagnostic(self.document, &m).help(help))
        }));
        match grain {
            Some(line) => panel.with_grain(grain_of(*line)).ok(),
            None => {
                match self.notes.last_mut() {
                    Some(PatternNote::NoGrain { panels }) => panels.push(panel.name().into()),
                    _ => {
                        self.notes.push(PatternNote::NoGrain { panels: vec![panel.name().into()] })
                    }
                }
                Some(panel)
            }
        }
    }

    /// Unfolds a panel that is cut on the fold, as the drawing says, or notes that it is a half.
    fn unfold(&mut self, name: &str, edges: &mut Vec<Edge>, polygon: &[[f64; 2]]) {
        let middle = |[a, b]: [[f64; 2]; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        let off = |p: [f64; 2]| {
            let sides = polygon.iter().zip(polygon.iter().cycle().skip(1));
            sides.map(|(a, b)| distance_from_segment(p, [*a, *b])).fold(f64::MAX, f64::min)
        };
        let is_here = |mark: &&FoldMark| {
            let at = middle(mark.line);
            inside(polygon, at) || off(at) < BESIDE
        };
        let marks: Vec<&FoldMark> = self.folds.iter().filter(is_here).collect();
        let Some(mark) = marks.first() else { return };
        let fold = marks.iter().find_map(|mark| unfold_beside(edges, mark.line, FOLD_REACH));
        self.notes.push(match fold {
            Some(edge) => PatternNote::Unfolded { panel: name.into(), edge },
            None => PatternNote::Half { panel: name.into(), text: mark.text.clone() },
        });
    }

    /// Returns the pattern of the panels, with what this project wrote into the drawing.
    fn pattern(
        mut self,
        panels: Vec<Panel>,
        tree: &roxmltree::Document<'_>,
        request: &Request,
    ) -> Result<Pattern, Diagnostics> {
        Diagnostics::check(std::mem::take(&mut self.mistakes))?;
        let more = tree.descendants().find(|node| node.has_tag_name((NAMESPACE, "pattern")));
        if more.is_none() {
            self.notes.push(PatternNote::NoSeams { format: "a drawing" });
        }
        if let Some(doubt) = Doubt::of_drawing(&panels, self.scale) {
            // What nobody can confirm by the name of a unit is not asked.
            let asks = request.unit.is_none() && more.is_none();
            match Unit::of_length(self.scale).filter(|_| asks) {
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
        let Some(text) = more.and_then(|node| node.text()) else { return Ok(pattern) };
        let inner = Document::new(self.document.path(), text);
        let all = toml_file::decode(&inner).and_then(|mut file| {
            let lost = file.fit(&pattern);
            let read = file.pattern(Some(pattern), self.sketch)?;
            let mut notes = read.reader_notes();
            if !lost.is_empty() {
                notes.push(PatternNote::SeamsLeftOut { seams: lost });
            }
            Ok(read.with_notes(notes))
        });
        all.map_err(|mistakes| {
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
