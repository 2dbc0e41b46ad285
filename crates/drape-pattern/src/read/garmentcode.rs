//! Reader of patterns of GarmentCode and of its predecessor, the Garment-Pattern-Generator, in
//! JSON.
//!
//! The predecessor writes a curve as one control point, GarmentCode as a type with parameters.
//! Control points are relative to the edge: along it, and to its left, as fractions of its length.
//! Rotations are about x, then y, then z.

use std::collections::BTreeMap;

use drape_input::{Advice, Diagnostic, Diagnostics, Document, closest};
use serde::Deserialize;
use serde_json::Value;

use super::diagnostic::{diagnostic, syntax};
use super::size::{Doubt, wrong_size};
use crate::ease::MAX_EASE;
use crate::edge::{Curve, Edge};
use crate::mistake::Mistake;
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::panel::placement::Placement;
use crate::pattern::Pattern;
use crate::pattern::seam::{EdgeId, Seam};
use crate::sketch::Sketch;

/// File, as its JSON states it.
#[derive(Deserialize)]
struct Specification {
    pattern: PatternObject,
    properties: Properties,
}

#[derive(Deserialize)]
struct Properties {
    units_in_meter: f64,
    #[serde(default)]
    curvature_coords: Option<String>,
}

#[derive(Deserialize)]
struct PatternObject {
    panels: BTreeMap<String, PanelObject>,
    #[serde(default)]
    stitches: Vec<Vec<Value>>,
    #[serde(default)]
    panel_order: Vec<String>,
}

#[derive(Deserialize)]
struct PanelObject {
    vertices: Vec<[f64; 2]>,
    edges: Vec<EdgeObject>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct EdgeObject {
    endpoints: [usize; 2],
    curvature: Option<Value>,
}

/// Mistake of a curve of the file.
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

/// Panels of the file, and their names in the order of the pattern.
struct Panels<'a> {
    file: &'a PatternObject,
    order: &'a [String],
}

/// Returns the pattern of `document`, and adds its lines to `sketch`.
pub(crate) fn read(document: &Document, sketch: &mut Sketch) -> Result<Pattern, Diagnostics> {
    let file: Specification = serde_json::from_str(document.text()).map_err(|error| {
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

    // The pattern is read in spite of a wrong unit, so that all mistakes are reported together.
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
    /// Adds the mistake `message` with the remedy `help`.
    fn fail(&mut self, message: impl Into<String>, help: impl Into<Advice>) {
        self.mistakes.push(Diagnostic::new(self.document.path(), message).help(help));
    }

    /// Adds `all`, mistakes of the pattern.
    fn fail_all(&mut self, all: &[Mistake]) {
        self.mistakes.extend(all.iter().map(|mistake| diagnostic(self.document, mistake)));
    }

    /// Returns the pattern of the panels and the seams of `file`.
    fn pattern(mut self, mut file: PatternObject) -> Result<Pattern, Diagnostics> {
        // Panels that the file does not order come last, by the alphabet.
        let mut order = Vec::new();
        for name in &file.panel_order {
            if !file.panels.contains_key(name) {
                self.fail_unknown_panel("pattern.panel_order", name, &file);
            } else if !order.contains(name) {
                order.push(name.clone());
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
            let ids = seam.iter().flat_map(|seam| seam.sides.iter().flatten());
            let words = ids.map(|id| format!("{}.{}", order[id.panel], id.edge)).collect();
            self.sketch.add_seam(&index.to_string(), words);
            seams.extend(seam);
        }

        let mut panels = Vec::new();
        for name in &order {
            panels.extend(self.panel(name, &file.panels[name]));
        }

        if self.mistakes.is_empty() {
            let doubt = Doubt::for_file(&panels, self.metres);
            self.notes.extend(doubt.map(|doubt| doubt.note()));
            match Pattern::new(panels, seams) {
                Ok(pattern) => {
                    // The format has no grain.
                    self.notes.push(PatternNote::NoGrain { panels: order });
                    return Ok(pattern.with_notes(self.notes));
                }
                Err(all) => self.fail_all(&all),
            }
        }
        Err(Diagnostics(self.mistakes))
    }

    /// Adds the mistake that `file` has no panel `name`, which `place` of the file names.
    fn fail_unknown_panel(&mut self, place: &str, name: &str, file: &PatternObject) {
        let known: Vec<&str> = file.panels.keys().map(String::as_str).collect();
        let help = match closest(name, known.iter().copied()) {
            Some(word) => format!("did you mean \"{word}\"?"),
            None => format!("the panels are: {}", known.join(", ")),
        };
        self.fail(format!("{place}: there is no panel \"{name}\""), help);
    }

    /// Returns the panel `name`, which `object` states.
    fn panel(&mut self, name: &str, object: &PanelObject) -> Option<Panel> {
        let before = self.mistakes.len();
        let mut edges = Vec::new();
        for (index, edge) in object.edges.iter().enumerate() {
            let place = format!("pattern.panels.{name}.edges[{index}]");
            let ends = edge.endpoints.map(|k| object.vertices.get(k));
            let [Some(start), Some(end)] = ends else {
                let message = format!("{place}.endpoints are {:?}", edge.endpoints);
                let help = match object.vertices.len() {
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

        self.sketch.add_outline(name, &edges);
        let panel = match Panel::new(name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                self.fail_all(&all);
                return None;
            }
        };
        self.mistakes.extend(wrong_size(&panel).map(|m| diagnostic(self.document, &m)));
        let placement = object.translation.map(|translation| {
            let angles = object.rotation.unwrap_or_default().map(f64::to_radians);
            Placement::new(angles, translation.map(|x| x * self.metres))
        });
        let panel = match placement {
            None => panel,
            Some(placement) => match panel.with_placement(placement) {
                Ok(panel) => panel,
                Err(mistake) => {
                    self.fail_all(&[mistake]);
                    return None;
                }
            },
        };

        // The right side is the one from which the outline runs anticlockwise.
        if !panel.was_clockwise() {
            return Some(panel);
        }
        self.notes.push(PatternNote::TurnedOver { panel: name.into() });
        Some(panel.turned_over())
    }

    /// Returns the curve that `value` states for `edge`.
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
                let first = self.control(edge, first).ok_or_else(wrong)?;
                Ok(Curve::Cubic([first, self.control(edge, second).ok_or_else(wrong)?]))
            }
            (Some("circle"), [radius, large, right]) => {
                let radius = radius.as_f64().filter(|r| *r > 0.0).ok_or_else(wrong)? * self.metres;
                let large = flag(large).ok_or_else(wrong)?;
                // An arc that bulges to the right turns left.
                let left = flag(right).ok_or_else(wrong)?;
                Ok(Curve::Arc { sweep: edge.arc_sweep(radius, large, left) })
            }
            _ => Err(wrong()),
        }
    }

    /// Returns the control point that `value` states for `edge`, in the panel's frame, in m.
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

    /// Returns the seam of the stitch with the number `index`, which has `sides`.
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
        // The format has gathers, but does not state how much ease is intended.
        Some(Seam { name, sides, reversed, max_ease: MAX_EASE, angle: 0.0, allowance: 0.0 })
    }

    /// Returns the edge that `value`, a side of a stitch at `place` of the file, names.
    fn side(&mut self, place: &str, known: &Panels<'_>, value: &Value) -> Option<EdgeId> {
        let Panels { file, order } = known;
        let panel = value.get("panel").and_then(Value::as_str);
        let edge = value.get("edge").and_then(Value::as_u64);
        let (Some(panel), Some(edge)) = (panel, edge) else {
            self.fail(format!("{place} is {value}"), "name a panel and the number of an edge");
            return None;
        };

        let Some(object) = file.panels.get(panel) else {
            self.fail_unknown_panel(place, panel, file);
            return None;
        };
        let edges = object.edges.len();
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

/// Returns the truth that `value` states as a boolean or a number.
fn flag(value: &Value) -> Option<bool> {
    value.as_bool().or_else(|| value.as_f64().map(|x| x != 0.0))
}
