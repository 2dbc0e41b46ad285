//! Panels of a pattern in the project's own format: a shape of their own, or changes of another
//! panel.

use drape_input::{Diagnostic, Document, closest, toml_key};

use super::keys::{EdgeKeys, FoldKeys, PanelKeys};
use crate::edge::{Curve, Edge};
use crate::mistake::Mistake;
use crate::note::Note;
use crate::panel::{Fold, Panel};
use crate::placement::Placement;
use crate::read::diagnostic::wrong_unit;
use crate::read::seams::{Place, located};
use crate::read::svg_path;

/// Reader of the panels of one document, with the mistakes and notes so far.
pub(crate) struct Reader<'a> {
    pub(crate) document: &'a Document,
    pub(crate) mistakes: Vec<Diagnostic>,
    pub(crate) notes: Vec<Note>,
    /// Unit of lengths of the file, in m.
    pub(crate) metres: f64,
}

impl Reader<'_> {
    /// Place of the tables of the file.
    pub(crate) fn place(&self) -> Place<'_> {
        Place { document: self.document, prefix: "", unit: self.metres }
    }

    /// Adds a mistake at a key.
    pub(crate) fn fail(&mut self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.mistakes.push(self.document.at(key, message).help(help));
    }

    /// Adds a mistake of the pattern at the key of its subject.
    pub(crate) fn mistake(&mut self, mistake: &Mistake) {
        self.mistakes.push(located(&self.place(), mistake));
    }

    /// Returns a panel whose shape the file gives.
    pub(crate) fn own(&mut self, name: &str, keys: &PanelKeys) -> Option<Panel> {
        if keys.mirrored {
            let help = "remove it, or name the panel that this one mirrors: copy_of = \"…\"";
            self.fail(&format!("{}.mirrored", key(name)), "belongs to copy_of", help);
        }
        let edges = self.edges(name, keys)?;
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
        self.changed(panel, keys)
    }

    /// Returns a panel with the grain, fabric, hems, folds and place that the file gives it.
    pub(crate) fn changed(&mut self, panel: Panel, keys: &PanelKeys) -> Option<Panel> {
        let key = key(panel.name());
        let mut panel = self.split(panel, keys)?;
        if let Some(shift) = keys.shift {
            let by = shift.map(|x| x * self.metres);
            match panel.shifted(by) {
                Some(moved) => panel = moved,
                None => {
                    let help = "a length along x and one along y, within 1000 m";
                    self.fail(&format!("{key}.shift"), format!("is {shift:?}"), help);
                    return None;
                }
            }
        }
        self.check_hems(&panel, keys)?;
        let metres = self.metres;
        if !keys.hems.is_empty() {
            panel = panel.with_edges(|edge| {
                let width = keys.hems.get(&edge.name).map(|width| width * metres);
                vec![edge.clone().hemmed(width.unwrap_or(edge.hem))]
            });
        }
        if let Some(fabric) = &keys.fabric {
            panel = panel.with_fabric(fabric);
        }
        if let Some(grain) = keys.grain {
            panel = match panel.with_grain(grain.to_radians()) {
                Ok(panel) => panel,
                Err(_) => {
                    let help = "degrees from the panel's y axis to its warp, anticlockwise";
                    self.fail(&format!("{key}.grain"), format!("is {grain}"), help);
                    return None;
                }
            };
        }
        if !keys.fold.is_empty() {
            panel = self.folded(panel, &keys.fold)?;
        }
        self.placed(panel, keys)
    }

    /// Returns a panel at its place in space.
    fn placed(&mut self, panel: Panel, keys: &PanelKeys) -> Option<Panel> {
        if keys.origin.is_none() && keys.turn.is_none() && keys.wrap.is_none() {
            return Some(panel);
        }
        let key = key(panel.name());
        let given = panel.placement().copied();
        let flat = match (&keys.origin, &keys.turn, given) {
            (None, None, Some(given)) => given.with_wrap(None),
            (origin, turn, given) => {
                let angles = turn.map(|turn| turn.map(f64::to_radians));
                let angles = angles.or(given.map(|given| given.angles()));
                let origin = origin.map(|origin| origin.map(|x| x * self.metres));
                let origin = origin.or(given.map(|given| given.translation));
                Placement::new(angles.unwrap_or_default(), origin.unwrap_or_default())
            }
        };
        let wrap = keys.wrap.map(|radius| radius * self.metres);
        let wrap = wrap.or(given.and_then(|given| given.wrap));
        match panel.with_placement(flat.with_wrap(wrap)) {
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

    /// Returns a panel with some of its edges split at distances from their starts.
    fn split(&mut self, panel: Panel, keys: &PanelKeys) -> Option<Panel> {
        let before = self.mistakes.len();
        for (name, places) in &keys.split {
            let key = format!("{}.split.{}", key(panel.name()), toml_key(name));
            let Some(edge) = self.edge(&panel, &key, name) else { continue };
            let length = edge.length() / self.metres;
            let rising = places.windows(2).all(|pair| pair[0] < pair[1]);
            let inside = places.iter().all(|at| 0.0 < *at && *at < length);
            if !(rising && inside) {
                let help = format!("ascending distances from its start, between 0 and {length:.2}");
                self.fail(&key, format!("is {places:?}"), help);
            }
        }
        let metres = self.metres;
        let cut = |edge: &Edge| match keys.split.get(&edge.name) {
            Some(places) => edge.split(&places.iter().map(|at| at * metres).collect::<Vec<_>>()),
            None => vec![edge.clone()],
        };
        (self.mistakes.len() == before).then(|| panel.with_edges(cut))
    }

    /// Checks the hems of a panel that are given by the names of its edges.
    fn check_hems(&mut self, panel: &Panel, keys: &PanelKeys) -> Option<()> {
        let before = self.mistakes.len();
        for (name, width) in &keys.hems {
            let key = format!("{}.hems.{}", key(panel.name()), toml_key(name));
            let _ = self.edge(panel, &key, name);
            let mistake = self.place().width(&key, *width);
            self.mistakes.extend(mistake);
        }
        (self.mistakes.len() == before).then_some(())
    }

    /// Returns the edge of a panel of a name; adds a mistake if there is none.
    fn edge<'p>(&mut self, panel: &'p Panel, key: &str, name: &str) -> Option<&'p Edge> {
        let found = panel.outline().iter().find(|edge| edge.name == name);
        if found.is_none() {
            let known: Vec<&str> = panel.outline().iter().map(|e| e.name.as_str()).collect();
            let help = match closest(name, known.iter().copied()) {
                Some(similar) => format!("did you mean \"{similar}\"?"),
                None => format!("its edges are: {}", known.join(", ")),
            };
            self.fail(key, format!("panel {} has no edge \"{name}\"", panel.name()), help);
        }
        found
    }

    /// Returns a panel with its folds.
    fn folded(&mut self, panel: Panel, folds: &[FoldKeys]) -> Option<Panel> {
        let key = format!("{}.fold", key(panel.name()));
        for (index, fold) in folds.iter().enumerate() {
            let mistake = self.place().angle(&format!("{key}[{index}].angle"), fold.angle);
            self.mistakes.extend(mistake);
        }
        let scaled = |p: [f64; 2]| p.map(|x| x * self.metres);
        let fold = |fold: &FoldKeys| Fold {
            ends: [scaled(fold.from), scaled(fold.to)],
            angle: fold.angle.to_radians(),
        };
        let folds = folds.iter().map(fold).collect();
        let folded = panel.with_folds(folds);
        let help = "from and to are the ends of a line, such as [0, 10] and [40, 10]";
        folded.map_err(|_| self.fail(&key, "a fold has no length, or is not finite", help)).ok()
    }

    /// Returns the edges of a panel, whichever shape it is given by.
    fn edges(&mut self, name: &str, keys: &PanelKeys) -> Option<Vec<Edge>> {
        let key = key(name);
        let mut edges = match (&keys.outline, keys.rectangle, &keys.path) {
            (Some(outline), None, None) => self.outline(&key, keys.start, outline)?,
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
                let help =
                    "give one of start and outline, rectangle = [width, height], path, copy_of";
                self.fail(&key, format!("panel {name} has no single shape"), help);
                return None;
            }
        };
        if keys.start.is_some() && keys.outline.is_none() {
            self.fail(&format!("{key}.start"), "belongs to an outline", "remove it");
        }
        let Some(names) = &keys.edges else { return Some(edges) };
        if names.len() != edges.len() || keys.outline.is_some() {
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
        outline: &[EdgeKeys],
    ) -> Option<Vec<Edge>> {
        let Some(mut at) = start else {
            self.fail(key, "start is missing", "set start = [x, y], where the first edge begins");
            return None;
        };
        let before = self.mistakes.len();
        let mut edges = Vec::new();
        for (index, keys) in outline.iter().enumerate() {
            let scaled = |p: [f64; 2]| p.map(|x| x * self.metres);
            let name = keys.name.clone().unwrap_or_else(|| (index + 1).to_string());
            let line = Edge::line(name, scaled(at), scaled(keys.to));
            let curve = match (keys.quadratic, keys.cubic, keys.radius) {
                (None, None, None) => Some(Curve::Line),
                (Some(control), None, None) => Some(Curve::Quadratic(scaled(control))),
                (None, Some(controls), None) => Some(Curve::Cubic(controls.map(scaled))),
                (None, None, Some(radius)) => {
                    let (size, left) = ((radius * self.metres).abs(), radius > 0.0);
                    Some(Curve::Arc { sweep: line.arc_sweep(size, keys.large, left) })
                }
                _ => None,
            };
            let place = format!("{key}.outline[{index}]");
            let mistake = self.place().width(&format!("{place}.hem"), keys.hem);
            self.mistakes.extend(mistake);
            if keys.large && keys.radius.is_none() {
                self.fail(&place, "large belongs to a radius", "remove it, or add radius");
            }
            at = keys.to;
            let Some(curve) = curve else {
                let help = "give at most one of quadratic, cubic and radius";
                self.fail(&place, "the edge has no single curve", help);
                continue;
            };
            let mut edge = line.curved(curve).hemmed(keys.hem * self.metres);
            let length = edge.length() / self.metres;
            if !keys.notches.iter().all(|notch| (0.0..=length).contains(notch)) {
                let help = format!("distances from its start, from 0 to {length:.2}");
                self.fail(&format!("{place}.notches"), format!("are {:?}", keys.notches), help);
            }
            edge.notches = keys.notches.iter().map(|notch| notch * self.metres).collect();
            edges.push(edge);
        }
        (self.mistakes.len() == before).then_some(edges)
    }
}

/// Returns the key of a panel.
pub(crate) fn key(panel: &str) -> String {
    format!("panel.{}", toml_key(panel))
}
