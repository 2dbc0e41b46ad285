//! Panels of a pattern in the project's format: with a shape from the file, or as changes of
//! another panel.

use std::collections::BTreeMap;

use drape_input::{
    Advice, Diagnostic, Document, Edit, Faults, Given, Length, closest, figures, toml_key,
    toml_string,
};

use super::keys::{EdgeKeys, FoldKeys, PanelKeys};
use crate::edge::{Curve, Edge};
use crate::length::Millimetres;
use crate::mistake::Mistake;
use crate::note::PatternNote;
use crate::panel::placement::Placement;
use crate::panel::{Fold, Panel};
use crate::read::seams::{PatternTable, located};
use crate::read::size::{Doubt, wrong_size};
use crate::read::svg_path;
use crate::sketch::Sketch;

/// Distance of two points that are one but for rounding, in m. Programs round points to a
/// ten-thousandth of a millimetre. A notch may lie beyond the end of an edge by this distance.
pub(crate) const ROUNDING: f64 = 1e-6;

/// Reader of the panels of one document, with the mistakes and notes so far.
pub(crate) struct Reader<'a> {
    pub(crate) document: &'a Document,
    /// Mistakes of spelling and type, and the keys whose values they leave unknown.
    pub(crate) faults: &'a Faults,
    pub(crate) sketch: &'a mut Sketch,
    pub(crate) mistakes: Vec<Diagnostic>,
    pub(crate) notes: Vec<PatternNote>,
    /// Unit of lengths of the file, in m; NaN if it is not known.
    pub(crate) metres: f64,
}

impl<'a> Reader<'a> {
    /// Returns the reader of `document`, with `faults` of its decoding, before its unit is known.
    pub(crate) fn new(document: &'a Document, faults: &'a Faults, sketch: &'a mut Sketch) -> Self {
        let (mistakes, notes) = (Vec::new(), Vec::new());
        Self { document, faults, sketch, mistakes, notes, metres: f64::NAN }
    }

    /// Top of the file as a table with panels and seams.
    pub(crate) fn table(&self) -> PatternTable<'a> {
        PatternTable { document: self.document, prefix: "", unit: self.metres }
    }

    /// Returns a point of the file in m.
    pub(crate) fn scaled(&self, point: [Given<Length>; 2]) -> [f64; 2] {
        point.map(|x| x * self.metres)
    }

    /// Adds the mistake `message` with the remedy `help` at `key`, unless its value could not be
    /// read, which is a mistake already.
    pub(crate) fn fail(&mut self, key: &str, message: impl Into<String>, help: impl Into<Advice>) {
        self.fail_with(key, message, help, Vec::new());
    }

    /// Adds a mistake as [`Reader::fail`] does, with `edits` that remedy it.
    pub(crate) fn fail_with(
        &mut self,
        key: &str,
        message: impl Into<String>,
        help: impl Into<Advice>,
        edits: Vec<Edit>,
    ) {
        if !self.faults.cover(key) {
            self.mistakes.push(self.document.at(key, message).help(help).with_edits(edits));
        }
    }

    /// Returns whether the outline of the panel `name` depends on values that could not be read.
    pub(crate) fn is_shapeless(&self, name: &str, keys: &PanelKeys) -> bool {
        const OF_SHAPES: [&str; 8] =
            ["start", "rectangle", "path", "edges", "copy_of", "mirrored", "shift", "split"];
        const OF_EDGES: [&str; 6] = ["name", "to", "quadratic", "cubic", "radius", "large"];
        if self.faults.is_empty() {
            return false;
        }
        let key = key(name);
        let is_unknown = |path: &str| self.faults.cover(&format!("{key}.{path}"));
        let edges = keys.outline.as_ref().map(Vec::len);
        OF_SHAPES.into_iter().any(is_unknown)
            || edges.is_none() && is_unknown("outline")
            || (0..edges.unwrap_or(0)).any(|index| {
                OF_EDGES.into_iter().any(|edge| is_unknown(&format!("outline[{index}].{edge}")))
            })
    }

    /// Checks the keys of the panel `name` that do not need its outline.
    pub(crate) fn check_without_outline(&mut self, name: &str, keys: &PanelKeys) {
        let key = key(name);
        for (edge, width) in &keys.hems {
            self.check_width(&format!("{key}.hems.{}", toml_key(edge)), *width);
        }
        for (index, edge) in keys.outline.iter().flatten().enumerate() {
            self.check_width(&format!("{key}.outline[{index}].hem"), edge.hem);
        }
        self.check_angles(&key, &keys.fold);
        if keys.grain.is_some_and(|grain| !grain.value().is_finite()) {
            self.fail_grain(&key, keys);
        }
    }

    /// Adds the mistake that the grain of the panel at `key` is not finite.
    fn fail_grain(&mut self, key: &str, keys: &PanelKeys) {
        let grain = keys.grain.map_or(f64::NAN, Given::value);
        let help = "degrees from the panel's y axis to its warp, anticlockwise";
        self.fail(&format!("{key}.grain"), format!("is {grain}"), help);
    }

    /// Checks `width`, the width of a hem at `key`.
    fn check_width(&mut self, key: &str, width: Given<Length>) {
        let mistake = self.table().width_mistake(key, width);
        self.mistakes.extend(mistake.filter(|_| !self.faults.cover(key)));
    }

    /// Checks the angles of `folds`, folds of the panel at `key`.
    fn check_angles(&mut self, key: &str, folds: &[FoldKeys]) {
        for (index, fold) in folds.iter().enumerate() {
            let key = format!("{key}.fold[{index}].angle");
            let mistake = self.table().angle_mistake(&key, fold.angle);
            self.mistakes.extend(mistake.filter(|_| !self.faults.cover(&key)));
        }
    }

    /// Adds `mistake`, a mistake of the pattern, at the key of its subject.
    pub(crate) fn mistake(&mut self, mistake: &Mistake) {
        self.mistakes.push(located(&self.table(), mistake));
    }

    /// Returns the panel `name`, whose shape `keys` give.
    pub(crate) fn shaped(&mut self, name: &str, keys: &PanelKeys) -> Option<Panel> {
        if keys.mirrored {
            let help = "remove it, or name the panel that this one mirrors: copy_of = \"…\"";
            self.fail(&format!("{}.mirrored", key(name)), "belongs to copy_of", help);
        }
        let edges = self.edges(name, keys)?;
        self.sketch.add_outline(name, &edges);
        let panel = match Panel::new(name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                all.iter().for_each(|mistake| self.mistake(mistake));
                return None;
            }
        };

        // The size of a panel may show that the unit of the file is wrong.
        if let Some(mistake) = wrong_size(&panel) {
            let doubt = Doubt::for_file(std::slice::from_ref(&panel), self.metres);
            let unit = doubt.map(|doubt| toml_string(doubt.likely_unit()));
            let edit = unit.as_ref().and_then(|unit| self.document.edit("length", Some(unit)));
            let mut located = located(&self.table(), &mistake).with_edits(edit);
            if let Some(unit) = unit {
                located.help = Some(format!("did you mean length = {unit}? {}", mistake.help()));
            }
            self.mistakes.push(located);
        }
        if panel.was_clockwise() {
            self.notes.push(PatternNote::Reversed { panel: name.into() });
        }
        self.changed(panel, keys)
    }

    /// Returns `panel` with the changes of `keys`: splits, shift, hems, darts, fabric, grain, folds
    /// and placement.
    pub(crate) fn changed(&mut self, panel: Panel, keys: &PanelKeys) -> Option<Panel> {
        let key = key(panel.name());

        // Hems and darts name edges as they are after splitting.
        let mut panel = self.split(panel, keys)?;
        if let Some(shift) = keys.shift {
            let by = self.scaled(shift);
            match panel.shifted(by) {
                Some(moved) => panel = moved,
                None => {
                    let help = "a length along x and one along y, within 1000 m";
                    self.fail(&format!("{key}.shift"), format!("is {} m", figures(&by)), help);
                    return None;
                }
            }
        }
        self.sketch.add_panel(&panel);
        self.check_hems(&panel, keys)?;
        let metres = self.metres;
        if !keys.hems.is_empty() {
            panel = panel.with_edges(|edge| {
                let width = keys.hems.get(&edge.name).map(|&width| width * metres);
                vec![edge.clone().hemmed(width.unwrap_or(edge.hem))]
            });
        }
        panel = self.darted(panel, &keys.dart)?;
        self.sketch.add_panel(&panel);

        if let Some(fabric) = &keys.fabric {
            panel = panel.with_fabric(fabric);
        }
        if let Some(grain) = keys.grain {
            panel = match panel.with_grain(grain.value().to_radians()) {
                Ok(panel) => panel,
                Err(_) => {
                    self.fail_grain(&key, keys);
                    return None;
                }
            };
        }
        if !keys.fold.is_empty() {
            panel = self.folded(panel, &keys.fold)?;
        }
        self.placed(panel, keys)
    }

    /// Returns `panel` at the placement that `keys` give. Parts of it that are missing stay as they
    /// are.
    fn placed(&mut self, panel: Panel, keys: &PanelKeys) -> Option<Panel> {
        if keys.origin.is_none() && keys.turn.is_none() && keys.wrap.is_none() {
            return Some(panel);
        }
        let given = panel.placement().copied();
        let flat = match (&keys.origin, &keys.turn, given) {
            (None, None, Some(given)) => given.with_wrap(None),
            (origin, turn, given) => {
                let angles = turn.map(|turn| turn.map(|angle| angle.value().to_radians()));
                let angles = angles.or(given.map(|given| given.angles()));
                let origin = origin.map(|origin| origin.map(|x| x * self.metres));
                let origin = origin.or(given.map(|given| given.translation));
                Placement::new(angles.unwrap_or_default(), origin.unwrap_or_default())
            }
        };
        let wrap = keys.wrap.map(|radius| radius * self.metres);
        let wrap = wrap.or(given.and_then(|given| given.wrap));

        let key = key(panel.name());
        match panel.with_placement(flat.with_wrap(wrap)) {
            Ok(panel) => Some(panel),
            Err(mistake @ Mistake::Wrap { .. }) => {
                self.fail(&format!("{key}.wrap"), mistake.to_string(), mistake.help());
                None
            }
            Err(_) => {
                let wrong_key = match (keys.origin, keys.turn) {
                    (Some(origin), _) if origin.iter().any(|x| !x.number().is_finite()) => "origin",
                    (_, Some(turn)) if turn.iter().any(|x| !x.number().is_finite()) => "turn",
                    _ => "wrap",
                };
                let help = "origin is three lengths, turn three angles in degrees about x, y and z, \
                            wrap a radius above 0";
                self.fail(&format!("{key}.{wrong_key}"), "does not give the panel a place", help);
                None
            }
        }
    }

    /// Returns `panel` with edges split as `keys` state.
    fn split(&mut self, panel: Panel, keys: &PanelKeys) -> Option<Panel> {
        let before = self.mistakes.len();
        let mut distances: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
        for (name, given) in &keys.split {
            let key = format!("{}.split.{}", key(panel.name()), toml_key(name));
            let Some(edge) = self.edge(&panel, &key, name) else { continue };
            let length = edge.length();
            let places: Vec<f64> = given.iter().map(|&at| at * self.metres).collect();
            let is_rising = places.windows(2).all(|pair| pair[0] < pair[1]);
            let is_inside = places.iter().all(|at| 0.0 < *at && *at < length);
            if !(is_rising && is_inside) {
                let length = Millimetres(length);
                let help = format!("ascending distances from its start, between 0 and {length}");
                self.fail(&key, format!("is {}", millimetres(&places)), help);
            }
            distances.insert(name, places);
        }
        if self.mistakes.len() > before {
            return None;
        }

        Some(panel.with_edges(|edge| match distances.get(edge.name.as_str()) {
            Some(places) => edge.split(places),
            None => vec![edge.clone()],
        }))
    }

    /// Checks the hems of `panel` that `keys` give by the names of its edges.
    fn check_hems(&mut self, panel: &Panel, keys: &PanelKeys) -> Option<()> {
        let before = self.mistakes.len();
        for (name, width) in &keys.hems {
            let key = format!("{}.hems.{}", key(panel.name()), toml_key(name));
            let _ = self.edge(panel, &key, name);
            self.check_width(&key, *width);
        }
        (self.mistakes.len() == before).then_some(())
    }

    /// Returns the edge `name` of `panel`. Adds a mistake at `key` if there is none.
    pub(crate) fn edge<'p>(&mut self, panel: &'p Panel, key: &str, name: &str) -> Option<&'p Edge> {
        let edge = panel.outline().iter().find(|edge| edge.name == name);
        if edge.is_none() {
            let known: Vec<&str> = panel.outline().iter().map(|e| e.name.as_str()).collect();
            let similar = closest(name, known.iter().copied());
            let help = match similar {
                Some(similar) => format!("did you mean \"{similar}\"?"),
                None => format!("its edges are: {}", known.join(", ")),
            };
            let table = key.strip_suffix(&toml_key(name)).zip(similar);
            let renamed = table.map(|(table, similar)| {
                self.document.renamed(key, &format!("{table}{}", toml_key(similar)))
            });
            let message = format!("panel {} has no edge \"{name}\"", panel.name());
            self.fail_with(key, message, help, renamed.unwrap_or_default());
        }
        edge
    }

    /// Returns `panel` with the folds `folds`.
    fn folded(&mut self, panel: Panel, folds: &[FoldKeys]) -> Option<Panel> {
        let key = key(panel.name());
        self.check_angles(&key, folds);
        let folds = folds.iter().map(|fold| Fold {
            ends: [self.scaled(fold.from), self.scaled(fold.to)],
            angle: fold.angle.value().to_radians(),
        });
        let folded = panel.with_folds(folds.collect());
        let help = "from and to are the ends of a line, such as [0, 10] and [40, 10]";
        let key = format!("{key}.fold");
        folded.map_err(|_| self.fail(&key, "a fold has no length, or is not finite", help)).ok()
    }

    /// Returns the edges of the panel `name`, from the shape that `keys` give.
    fn edges(&mut self, name: &str, keys: &PanelKeys) -> Option<Vec<Edge>> {
        let key = key(name);
        let mut edges = match (&keys.outline, keys.rectangle, &keys.path) {
            (Some(outline), None, None) => self.outline(&key, keys.start, outline)?,
            (None, Some(size), None) => {
                let [x, y] = self.scaled(size);
                if !(x > 0.0 && y > 0.0) {
                    let message = format!("is {}", millimetres(&[x, y]));
                    let help = "width and height of the panel, both above 0";
                    self.fail(&format!("{key}.rectangle"), message, help);
                    return None;
                }
                let corners = [[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]];
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
        // The key `edges` names the edges of a path or a rectangle.
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

    /// Returns the edges of `outline` from the point `start` on, for the panel at `key`.
    fn outline(
        &mut self,
        key: &str,
        start: Option<[Given<Length>; 2]>,
        outline: &[EdgeKeys],
    ) -> Option<Vec<Edge>> {
        let Some(start) = start else {
            self.fail(key, "start is missing", "set start = [x, y], where the first edge begins");
            return None;
        };
        self.chain(&format!("{key}.outline"), start, outline)
    }

    /// Returns the edges in a row that `outline` states at `key`, from the point `start` on.
    pub(crate) fn chain(
        &mut self,
        key: &str,
        start: [Given<Length>; 2],
        outline: &[EdgeKeys],
    ) -> Option<Vec<Edge>> {
        let mut at = start;
        let before = self.mistakes.len();
        let mut edges = Vec::new();
        for (index, keys) in outline.iter().enumerate() {
            let name = keys.name.clone().unwrap_or_else(|| (index + 1).to_string());
            let line = Edge::line(name, self.scaled(at), self.scaled(keys.to));
            let curve = match (keys.quadratic, keys.cubic, keys.radius) {
                (None, None, None) => Some(Curve::Line),
                (Some(control), None, None) => Some(Curve::Quadratic(self.scaled(control))),
                (None, Some(controls), None) => {
                    Some(Curve::Cubic(controls.map(|control| self.scaled(control))))
                }
                (None, None, Some(radius)) => {
                    let (size, left) = ((radius * self.metres).abs(), radius.number() > 0.0);
                    Some(Curve::Arc { sweep: line.arc_sweep(size, keys.large, left) })
                }
                _ => None,
            };
            let edge_key = format!("{key}[{index}]");
            self.check_width(&format!("{edge_key}.hem"), keys.hem);
            if keys.large && keys.radius.is_none() {
                self.fail(
                    &format!("{edge_key}.large"),
                    "belongs to a radius",
                    "remove it, or add radius",
                );
            }
            at = keys.to;
            let Some(curve) = curve else {
                let help = "give at most one of quadratic, cubic and radius";
                self.fail(&edge_key, "the edge has no single curve", help);
                continue;
            };

            // A notch at the end of an edge may lie beyond it by the rounding of the digits.
            let mut edge = line.curved(curve).hemmed(keys.hem * self.metres);
            let length = edge.length();
            let notches = keys.notches.iter().map(|&notch| notch * self.metres);
            edge.notches = notches
                .map(|notch| if notch < length + ROUNDING { notch.min(length) } else { notch })
                .collect();
            if !edge.notches.iter().all(|notch| (0.0..=length).contains(notch)) {
                let message = format!("are {}", millimetres(&edge.notches));
                let help = format!("distances from its start, from 0 to {}", Millimetres(length));
                self.fail(&format!("{edge_key}.notches"), message, help);
            }
            edges.push(edge);
        }
        (self.mistakes.len() == before).then_some(edges)
    }
}

/// Returns `lengths`, in m, as a list in mm.
fn millimetres(lengths: &[f64]) -> String {
    let lengths: Vec<f64> = lengths.iter().map(|length| 1000.0 * length).collect();
    format!("{} mm", figures(&lengths))
}

/// Returns the key of the panel with the name `panel`.
pub(crate) fn key(panel: &str) -> String {
    format!("panel.{}", toml_key(panel))
}
