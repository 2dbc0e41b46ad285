//! Reader of the project's own format, in TOML.
//!
//! ```toml
//! length = "cm"
//!
//! [panel.front]
//! grain = 0
//! start = [0, 0]
//! outline = [
//!     { name = "hem", to = [20, 0] },
//!     { name = "side", to = [18, 30], quadratic = [17, 15] },
//!     { name = "waist", to = [0, 30], cubic = [[12, 29], [6, 29]] },
//!     { name = "centre", to = [0, 0] },
//! ]
//!
//! [seam.side]
//! sides = [["front.side"], ["back.side"]]
//! ```

use std::collections::BTreeMap;

use drape_input::{Diagnostic, Diagnostics, Document, closest};
use serde::Deserialize;

use super::diagnostic::wrong_unit;
use super::svg_path;
use crate::ease::DEFAULT_EASE;
use crate::edge::{Curve, Edge};
use crate::mistake::{Mistake, Subject};
use crate::note::Note;
use crate::panel::{Fold, Panel};
use crate::pattern::{EdgeId, Pattern, Seam};
use crate::placement::Placement;

/// Largest angle of a fold or a seam, in degrees; beyond it the bending of yarns is not exact.
const ANGLE_MAX: f64 = 140.0;

/// Widest allowance or hem, in m; beyond it a length in the wrong unit is far more likely.
const WIDTH_MAX: f64 = 0.3;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PatternFile {
    length: Option<String>,
    #[serde(default)]
    panel: BTreeMap<String, PanelFile>,
    #[serde(default)]
    seam: BTreeMap<String, SeamFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PanelFile {
    start: Option<[f64; 2]>,
    outline: Option<Vec<EdgeFile>>,
    rectangle: Option<[f64; 2]>,
    path: Option<String>,
    edges: Option<Vec<String>>,
    grain: Option<f64>,
    origin: Option<[f64; 3]>,
    turn: Option<[f64; 3]>,
    wrap: Option<f64>,
    #[serde(default)]
    fold: Vec<FoldFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FoldFile {
    from: [f64; 2],
    to: [f64; 2],
    angle: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EdgeFile {
    name: Option<String>,
    to: [f64; 2],
    quadratic: Option<[f64; 2]>,
    cubic: Option<[[f64; 2]; 2]>,
    radius: Option<f64>,
    #[serde(default)]
    large: bool,
    #[serde(default)]
    hem: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SeamFile {
    sides: [Vec<String>; 2],
    #[serde(default)]
    reversed: bool,
    max_ease: Option<f64>,
    #[serde(default)]
    angle: f64,
    #[serde(default)]
    allowance: f64,
}

/// Reader of one document with the mistakes and notes so far.
struct Reader<'a> {
    document: &'a Document,
    mistakes: Vec<Diagnostic>,
    notes: Vec<Note>,
    /// Unit of lengths of the file, in m.
    metres: f64,
}

/// Panels of the file, by name; `None` for those with mistakes.
struct Panels<'a> {
    names: &'a [&'a str],
    panels: &'a [Option<Panel>],
}

/// Returns the pattern of a document in the project's own format.
pub(crate) fn read(document: &Document) -> Result<Pattern, Diagnostics> {
    let file: PatternFile = document.decode()?;
    let mut reader = Reader { document, mistakes: vec![], notes: vec![], metres: f64::NAN };
    let units = [("mm", 0.001), ("cm", 0.01), ("m", 1.0), ("in", 0.0254)];
    let unit = file.length.as_deref().unwrap_or_default();
    match units.iter().find(|(word, _)| *word == unit) {
        Some((_, metres)) => reader.metres = *metres,
        None => {
            let help = "set length = \"mm\", \"cm\", \"m\" or \"in\", the unit of all lengths";
            reader.fail("length", format!("the unit is {unit:?}"), help);
        }
    }
    if file.panel.is_empty() {
        let help = "add [panel.front] with start and outline, rectangle, or path";
        let message = "the pattern has no panel";
        reader.mistakes.push(Diagnostic::new(document.path(), message).help(help));
    }
    let panels = reader.panels(&file);
    reader.pattern(&file, panels)
}

impl Reader<'_> {
    /// Adds a mistake at a key.
    fn fail(&mut self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.mistakes.push(self.document.at(key, message).help(help));
    }

    /// Adds a mistake of the pattern at the key of its subject.
    fn mistake(&mut self, mistake: &Mistake) {
        let key = match mistake.subject() {
            Subject::Panel(panel) => format!("panel.{panel}.outline"),
            Subject::Seam(seam) => format!("seam.{seam}.sides"),
            Subject::Spacing => String::new(),
        };
        self.fail(&key, mistake.to_string(), mistake.help());
    }

    fn panels(&mut self, file: &PatternFile) -> Vec<Option<Panel>> {
        // Without a unit the sizes cannot be checked.
        if self.metres.is_nan() {
            return vec![None; file.panel.len()];
        }
        let panels: Vec<Option<Panel>> =
            file.panel.iter().map(|(name, panel)| self.panel(name, panel)).collect();
        let grainless = file.panel.iter().filter(|(_, panel)| panel.grain.is_none());
        let grainless: Vec<String> = grainless.map(|(name, _)| name.clone()).collect();
        if !grainless.is_empty() {
            self.notes.push(Note::NoGrain { panels: grainless });
        }
        panels
    }

    /// Returns a panel with its grain, folds and place.
    fn panel(&mut self, name: &str, file: &PanelFile) -> Option<Panel> {
        let key = format!("panel.{name}");
        let edges = self.edges(name, file)?;
        let panel = match Panel::new(name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                all.iter().for_each(|mistake| self.mistake(mistake));
                return None;
            }
        };
        if let Some(mistake) = wrong_unit(&panel) {
            self.mistake(&mistake);
        }
        if panel.was_clockwise() {
            self.notes.push(Note::Reversed { panel: name.into() });
        }
        let grain = file.grain.unwrap_or_default();
        let panel = match panel.with_grain(grain.to_radians()) {
            Ok(panel) => panel,
            Err(_) => {
                let help = "degrees from the panel's y axis to its warp, anticlockwise";
                self.fail(&format!("{key}.grain"), format!("is {grain}"), help);
                return None;
            }
        };
        let panel = self.folded(panel, &file.fold)?;
        if file.origin.is_none() && file.turn.is_none() && file.wrap.is_none() {
            return Some(panel);
        }
        let angles = file.turn.unwrap_or_default().map(f64::to_radians);
        let origin = file.origin.unwrap_or_default().map(|x| x * self.metres);
        let wrap = file.wrap.map(|radius| radius * self.metres);
        match panel.with_placement(Placement::new(angles, origin).with_wrap(wrap)) {
            Ok(panel) => Some(panel),
            Err(mistake @ Mistake::Wrap { .. }) => {
                self.fail(&format!("{key}.wrap"), mistake.to_string(), mistake.help());
                None
            }
            Err(_) => {
                let help = "origin is three lengths, turn three angles in degrees about x, y and z, \
                            wrap a radius";
                self.fail(&key, "its place is not finite", help);
                None
            }
        }
    }

    /// Returns a panel with its folds.
    fn folded(&mut self, panel: Panel, folds: &[FoldFile]) -> Option<Panel> {
        let key = format!("panel.{}.fold", panel.name());
        for (index, fold) in folds.iter().enumerate() {
            self.angle(&format!("{key}[{index}].angle"), fold.angle);
        }
        let scaled = |p: [f64; 2]| p.map(|x| x * self.metres);
        let fold = |fold: &FoldFile| Fold {
            ends: [scaled(fold.from), scaled(fold.to)],
            angle: fold.angle.to_radians(),
        };
        let folds = folds.iter().map(fold).collect();
        let folded = panel.with_folds(folds);
        let help = "from and to are the ends of a line, such as [0, 10] and [40, 10]";
        folded.map_err(|_| self.fail(&key, "a fold has no length, or is not finite", help)).ok()
    }

    /// Checks the angle of a fold or a seam, in degrees.
    fn angle(&mut self, key: &str, angle: f64) {
        if !(angle.abs() <= ANGLE_MAX) {
            let help = "degrees towards the right side of the cloth, from -140 to 140; 0 is flat";
            self.fail(key, format!("is {angle}"), help);
        }
    }

    /// Checks the width of an allowance or a hem, and returns it in m.
    fn width(&mut self, key: &str, width: f64) -> f64 {
        let metres = width * self.metres;
        if !(0.0..=WIDTH_MAX).contains(&metres) {
            self.fail(key, format!("is {width}"), "a length from 0 to 300 mm; 0 is none");
        }
        metres
    }

    /// Returns the edges of a panel, whichever shape it is given by.
    fn edges(&mut self, name: &str, file: &PanelFile) -> Option<Vec<Edge>> {
        let key = format!("panel.{name}");
        let mut edges = match (&file.outline, file.rectangle, &file.path) {
            (Some(outline), None, None) => self.outline(&key, file.start, outline)?,
            (None, Some([x, y]), None) => {
                let corner = |x: f64, y: f64| [x * self.metres, y * self.metres];
                let corners = [corner(0.0, 0.0), corner(x, 0.0), corner(x, y), corner(0.0, y)];
                let names = ["bottom", "right", "top", "left"];
                (0..4).map(|k| Edge::line(names[k], corners[k], corners[(k + 1) % 4])).collect()
            }
            (None, None, Some(path)) => match svg_path::edges(name, path, self.metres) {
                Ok(edges) => edges,
                Err(mistake) => {
                    self.fail(&format!("{key}.path"), mistake.to_string(), mistake.help());
                    return None;
                }
            },
            _ => {
                let help = "give one of start and outline, rectangle = [width, height], path";
                self.fail(&key, format!("panel {name} has no single shape"), help);
                return None;
            }
        };
        if file.start.is_some() && file.outline.is_none() {
            self.fail(&format!("{key}.start"), "belongs to an outline", "remove it");
        }
        let Some(names) = &file.edges else { return Some(edges) };
        if names.len() != edges.len() || file.outline.is_some() {
            let message = format!("names {} edges of {}", names.len(), edges.len());
            let help = "name each edge of a path or rectangle; those of an outline have `name`";
            self.fail(&format!("{key}.edges"), message, help);
            return None;
        }
        edges.iter_mut().zip(names).for_each(|(edge, name)| edge.name.clone_from(name));
        Some(edges)
    }

    /// Returns the edges of an outline.
    fn outline(
        &mut self,
        key: &str,
        start: Option<[f64; 2]>,
        outline: &[EdgeFile],
    ) -> Option<Vec<Edge>> {
        let Some(mut at) = start else {
            self.fail(key, "start is missing", "set start = [x, y], where the first edge begins");
            return None;
        };
        let before = self.mistakes.len();
        let mut edges = Vec::new();
        for (index, file) in outline.iter().enumerate() {
            let scaled = |p: [f64; 2]| p.map(|x| x * self.metres);
            let name = file.name.clone().unwrap_or_else(|| (index + 1).to_string());
            let line = Edge::line(name, scaled(at), scaled(file.to));
            let curve = match (file.quadratic, file.cubic, file.radius) {
                (None, None, None) => Some(Curve::Line),
                (Some(control), None, None) => Some(Curve::Quadratic(scaled(control))),
                (None, Some(controls), None) => Some(Curve::Cubic(controls.map(scaled))),
                (None, None, Some(radius)) => {
                    let (size, left) = ((radius * self.metres).abs(), radius > 0.0);
                    Some(Curve::Arc { sweep: line.arc_sweep(size, file.large, left) })
                }
                _ => None,
            };
            let place = format!("{key}.outline[{index}]");
            let hem = self.width(&format!("{place}.hem"), file.hem);
            if file.large && file.radius.is_none() {
                self.fail(&place, "large belongs to a radius", "remove it, or add radius");
            }
            match curve {
                Some(curve) => edges.push(line.curved(curve).hemmed(hem)),
                None => {
                    let help = "give at most one of quadratic, cubic and radius";
                    self.fail(&place, "the edge has no single curve", help);
                }
            }
            at = file.to;
        }
        (self.mistakes.len() == before).then_some(edges)
    }

    /// Returns the pattern of the panels and the seams of the file.
    fn pattern(
        mut self,
        file: &PatternFile,
        panels: Vec<Option<Panel>>,
    ) -> Result<Pattern, Diagnostics> {
        let names: Vec<&str> = file.panel.keys().map(String::as_str).collect();
        let known = Panels { names: &names, panels: &panels };
        let mut seams = Vec::new();
        for (name, seam) in &file.seam {
            let sides = [0, 1].map(|side| {
                let key = format!("seam.{name}.sides[{side}]");
                let edge = |word: &String| self.sewn_edge(&key, word, &known);
                seam.sides[side].iter().filter_map(edge).collect::<Vec<EdgeId>>()
            });
            self.angle(&format!("seam.{name}.angle"), seam.angle);
            seams.push(Seam {
                name: name.clone(),
                sides,
                reversed: seam.reversed,
                max_ease: seam.max_ease.unwrap_or(DEFAULT_EASE),
                angle: seam.angle.to_radians(),
                allowance: self.width(&format!("seam.{name}.allowance"), seam.allowance),
            });
        }
        let made = match self.mistakes.is_empty() {
            true => Pattern::new(panels.into_iter().flatten().collect(), seams),
            false => Err(Vec::new()),
        };
        match made {
            Ok(pattern) => Ok(pattern.with_notes(self.notes)),
            Err(all) => {
                all.iter().for_each(|mistake| self.mistake(mistake));
                Err(sorted(self.mistakes))
            }
        }
    }

    /// Returns the edge that a word such as `front.side` names.
    fn sewn_edge(&mut self, key: &str, word: &str, known: &Panels<'_>) -> Option<EdgeId> {
        let Panels { names, panels } = known;
        let (panel, edge) = word.rsplit_once('.').unwrap_or((word, ""));
        let Some(number) = names.iter().position(|name| *name == panel) else {
            let help = match closest(panel, names.iter().copied()) {
                Some(similar) => format!("did you mean \"{similar}.{edge}\"?"),
                None => format!("write panel.edge; the panels are: {}", names.join(", ")),
            };
            self.fail(key, format!("\"{word}\": there is no panel \"{panel}\""), help);
            return None;
        };
        let known: Vec<&str> =
            panels[number].as_ref()?.outline().iter().map(|e| e.name.as_str()).collect();
        let found = known.iter().position(|name| *name == edge);
        if found.is_none() {
            let help = match closest(edge, known.iter().copied()) {
                Some(similar) => format!("did you mean \"{panel}.{similar}\"?"),
                None => format!("its edges are: {}", known.join(", ")),
            };
            self.fail(key, format!("panel {panel} has no edge \"{edge}\""), help);
        }
        Some(EdgeId { panel: number, edge: found? })
    }
}

/// Returns the mistakes in the order of the text.
fn sorted(mistakes: Vec<Diagnostic>) -> Diagnostics {
    match Diagnostics::check(mistakes) {
        Err(all) => all,
        Ok(()) => Diagnostics(Vec::new()),
    }
}
