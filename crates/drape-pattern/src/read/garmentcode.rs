//! Reader of patterns of GarmentCode and of its predecessor, the Garment-Pattern-Generator, in
//! JSON.
//!
//! The predecessor writes a curve as one control point, GarmentCode as a type with parameters.
//! Control points are relative to the edge: along it, and to its left, as fractions of its length.
//! Rotations are about x, then y, then z.

use std::collections::BTreeMap;

use drape_input::{Diagnostic, Diagnostics, Document, closest};
use serde::Deserialize;
use serde_json::Value;

use super::diagnostic::{diagnostic, syntax};
use super::size::{Doubt, wrong_size};
use crate::ease::MAX_EASE;
use crate::edge::{Curve, Edge};
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::panel::placement::Placement;
use crate::pattern::Pattern;
use crate::pattern::seam::{EdgeId, Seam};
use crate::sketch::Sketch;

#[derive(Deserialize)]
struct File {
    pattern: PatternPart,
    properties: Properties,
}

#[derive(Deserialize)]
struct Properties {
    units_in_meter: f64,
    #[serde(default)]
    curvature_coords: Option<String>,
}

#[derive(Deserialize)]
struct PatternPart {
    panels: BTreeMap<String, PanelPart>,
    #[serde(default)]
    stitches: Vec<Vec<Value>>,
    #[serde(default)]
    panel_order: Vec<String>,
}

#[derive(Deserialize)]
struct PanelPart {
    vertices: Vec<[f64; 2]>,
    edges: Vec<EdgePart>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct EdgePart {
    endpoints: [usize; 2],
    curvature: Option<Value>,
}

/// Fault of a curve of the file.
struct CurveFault {
    message: String,
    help: &'static str,
}

/// Reader of one document with the mistakes and notes so far.
struct Reader<'a> {
    document: &'a Document,
    sketch: &'a mut Sketch,
    mistakes: Vec<Diagnostic>,
    notes: Vec<PatternNote>,
    /// Unit of lengths of the file, in m.
    metres: f64,
    /// Whether control points are absolute.
    absolute: bool,
}

/// Panels of the file with the order in which the pattern has them.
struct Panels<'a> {
    file: &'a PatternPart,
    order: &'a [String],
}

/// Returns the pattern of a document in this format.
pub(crate) fn read(document: &Document, sketch: &mut Sketch) -> Result<Pattern, Diagnostics> {
    let file: File = serde_json::from_str(document.text()).map_err(|error| {
        let help = "a specification has pattern.panels with vertices and edges, pattern.stitches \
                    and properties.units_in_meter";
        syntax(document, &error).help(help)
    })?;
    let unit = file.properties.units_in_meter;
    let coords = file.properties.curvature_coords.as_deref();
    let mut reader = Reader {
        document,
        sketch,
        mistakes: Vec::new(),
        notes: Vec::new(),
        metres: unit.recip(),
        absolute: coords == Some("absolute"),
    };
    if !(1e-3..=1e6).contains(&unit) {
        let message = format!("properties.units_in_meter is {unit}");
        reader.fail(message, "100 for centimetres, 1000 for millimetres");
        reader.metres = f64::NAN;
    }
    if !matches!(coords, None | Some("relative" | "absolute")) {
        let message = format!("properties.curvature_coords is {:?}", coords.unwrap_or_default());
        reader.fail(message, "it is \"relative\" or \"absolute\"");
    }
    reader.pattern(file.pattern)
}

impl Reader<'_> {
    /// Adds a mistake.
    fn fail(&mut self, message: impl Into<String>, help: impl Into<String>) {
        self.mistakes.push(Diagnostic::new(self.document.path(), message).help(help));
    }

    /// Returns the pattern of the panels and the seams of the file.
    fn pattern(mut self, mut file: PatternPart) -> Result<Pattern, Diagnostics> {
        let mut order = Vec::new();
        for name in &file.panel_order {
            match file.panels.contains_key(name) {
                true if !order.contains(name) => order.push(name.clone()),
                true => {}
                false => self.no_panel("pattern.panel_order", name, &file),
            }
        }
        order.extend(file.panels.keys().filter(|k| !file.panel_order.contains(k)).cloned());
        if order.is_empty() {
            self.fail("pattern.panels is empty", "add a panel");
        }
        let stitches = std::mem::take(&mut file.stitches);
        let known = Panels { file: &file, order: &order };
        let mut seams = Vec::new();
        for (index, sides) in stitches.iter().enumerate() {
            let seam = self.seam(&known, index, sides);
            let word = |id: &EdgeId| format!("{}.{}", order[id.panel], id.edge);
            let words =
                seam.iter().flat_map(|seam| seam.sides.iter().flatten()).map(word).collect();
            self.sketch.add_seam(&index.to_string(), words);
            seams.extend(seam);
        }
        let mut panels = Vec::new();
        for name in &order {
            panels.extend(self.panel(name, &file.panels[name]));
        }
        if self.mistakes.is_empty() {
            let doubt = Doubt::of_file(&panels, self.metres);
            self.notes.extend(doubt.map(|doubt| doubt.note()));
            match Pattern::new(panels, seams) {
                Ok(pattern) => {
                    // The format has no grain.
                    self.notes.push(PatternNote::NoGrain { panels: order });
                    return Ok(pattern.with_notes(self.notes));
                }
                Err(all) => self.mistakes.extend(all.iter().map(|m| diagnostic(self.document, m))),
            }
        }
        Err(Diagnostics(self.mistakes))
    }

    /// Adds the mistake of a panel that does not exist.
    fn no_panel(&mut self, place: &str, name: &str, file: &PatternPart) {
        let known: Vec<&str> = file.panels.keys().map(String::as_str).collect();
        let help = match closest(name, known.iter().copied()) {
            Some(word) => format!("did you mean \"{word}\"?"),
            None => format!("the panels are: {}", known.join(", ")),
        };
        self.fail(format!("{place}: there is no panel \"{name}\""), help);
    }

    /// Returns a panel of the file.
    fn panel(&mut self, name: &str, part: &PanelPart) -> Option<Panel> {
        let before = self.mistakes.len();
        let mut edges = Vec::new();
        for (index, edge) in part.edges.iter().enumerate() {
            let place = format!("pattern.panels.{name}.edges[{index}]");
            let ends = edge.endpoints.map(|k| part.vertices.get(k));
            let [Some(start), Some(end)] = ends else {
                let message = format!("{place}.endpoints are {:?}", edge.endpoints);
                let help = match part.vertices.len() {
                    0 => "the panel has no vertices".to_owned(),
                    n => format!("the vertices are 0 to {}", n - 1),
                };
                self.fail(message, help);
                continue;
            };
            let [start, end] = [start, end].map(|p| p.map(|x| x * self.metres));
            let line = Edge::line(index.to_string(), start, end);
            match edge.curvature.as_ref().map_or(Ok(Curve::Line), |value| self.curve(&line, value))
            {
                Ok(curve) => edges.push(line.curved(curve)),
                Err(CurveFault { message, help }) => {
                    self.fail(format!("{place}.curvature {message}"), help);
                }
            }
        }
        if self.mistakes.len() > before {
            return None;
        }
        self.sketch.add(name, &edges);
        let panel = match Panel::new(name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                self.mistakes.extend(all.iter().map(|m| diagnostic(self.document, m)));
                return None;
            }
        };
        self.mistakes.extend(wrong_size(&panel).map(|m| diagnostic(self.document, &m)));
        let angles = part.rotation.unwrap_or_default().map(f64::to_radians);
        let placement = part
            .translation
            .map(|translation| Placement::new(angles, translation.map(|x| x * self.metres)));
        let panel = match placement.map(|p| panel.clone().with_placement(p)) {
            None => panel,
            Some(Ok(panel)) => panel,
            Some(Err(mistake)) => {
                self.mistakes.push(diagnostic(self.document, &mistake));
                return None;
            }
        };
        // The right side is the one from which the outline runs anticlockwise.
        if !panel.was_clockwise() {
            return Some(panel);
        }
        self.notes.push(PatternNote::TurnedOver { panel: name.into() });
        Some(panel.turned_over())
    }

    /// Returns the curve of an edge.
    fn curve(&self, edge: &Edge, value: &Value) -> Result<Curve, CurveFault> {
        let help =
            "a curve is [x, y], or a type \"quadratic\", \"cubic\" or \"circle\" with params";
        let wrong = || CurveFault { message: format!("is {value}"), help };
        if value.is_null() {
            return Ok(Curve::Line);
        }
        if value.is_array() {
            return Ok(Curve::Quadratic(self.control(edge, value).ok_or_else(wrong)?));
        }
        let params = value.get("params").and_then(Value::as_array).ok_or_else(wrong)?;
        match (value.get("type").and_then(Value::as_str), params.as_slice()) {
            (Some("quadratic"), [control]) => {
                Ok(Curve::Quadratic(self.control(edge, control).ok_or_else(wrong)?))
            }
            (Some("cubic"), [first, second]) => {
                let control = |value| self.control(edge, value).ok_or_else(wrong);
                Ok(Curve::Cubic([control(first)?, control(second)?]))
            }
            (Some("circle"), [radius, large, right]) => {
                let flag = |value: &Value| {
                    value.as_bool().or_else(|| value.as_f64().map(|x| x != 0.0)).ok_or_else(wrong)
                };
                let radius = radius.as_f64().filter(|r| *r > 0.0).ok_or_else(wrong)? * self.metres;
                // An arc that bulges to the right turns left.
                Ok(Curve::Arc { sweep: edge.arc_sweep(radius, flag(large)?, flag(right)?) })
            }
            _ => Err(wrong()),
        }
    }

    /// Returns a control point in the panel's frame, in m.
    fn control(&self, edge: &Edge, value: &Value) -> Option<[f64; 2]> {
        let [x, y] = value.as_array()?.as_slice() else { return None };
        let (x, y) = (x.as_f64()?, y.as_f64()?);
        if self.absolute {
            return Some([x * self.metres, y * self.metres]);
        }
        let chord = [edge.end[0] - edge.start[0], edge.end[1] - edge.start[1]];
        Some([
            edge.start[0] + x * chord[0] - y * chord[1],
            edge.start[1] + x * chord[1] + y * chord[0],
        ])
    }

    /// Returns the seam of a stitch of the file.
    fn seam(&mut self, known: &Panels<'_>, index: usize, sides: &[Value]) -> Option<Seam> {
        let place = format!("pattern.stitches[{index}]");
        let reversed = match sides {
            [_, _] => false,
            [_, _, Value::String(word)] if word == "right_wrong" => true,
            _ => {
                let help =
                    "a stitch is two sides, and \"right_wrong\" if a right side meets a wrong one";
                self.fail(format!("{place} has {} entries", sides.len()), help);
                return None;
            }
        };
        let sides = [0, 1].map(|side| self.side(&format!("{place}[{side}]"), known, &sides[side]));
        let [Some(first), Some(second)] = sides else { return None };
        let (name, sides) = (index.to_string(), [vec![first], vec![second]]);
        // The format has gathers, but no word for how much ease is intended.
        Some(Seam { name, sides, reversed, max_ease: MAX_EASE, angle: 0.0, allowance: 0.0 })
    }

    /// Returns the edge of a side of a stitch.
    fn side(&mut self, place: &str, known: &Panels<'_>, value: &Value) -> Option<EdgeId> {
        let Panels { file, order } = known;
        let panel = value.get("panel").and_then(Value::as_str);
        let edge = value.get("edge").and_then(Value::as_u64);
        let (Some(panel), Some(edge)) = (panel, edge) else {
            self.fail(format!("{place} is {value}"), "name a panel and the number of an edge");
            return None;
        };
        let Some(part) = file.panels.get(panel) else {
            self.no_panel(place, panel, file);
            return None;
        };
        let edges = part.edges.len();
        if edge >= edges as u64 {
            let help = match edges {
                0 => "it has no edges".to_owned(),
                n => format!("its edges are 0 to {}", n - 1),
            };
            self.fail(format!("{place}: panel {panel} has no edge {edge}"), help);
            return None;
        }
        let panel = order.iter().position(|name| name == panel)?;
        Some(EdgeId { panel, edge: edge as usize })
    }
}
