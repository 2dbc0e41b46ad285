//! Panel of a piece: its sewing line, or its cut line, divided at its corners into edges.

use drape_input::{Diagnostic, Document, Subject};

use super::entities::{Block, Form, field, layer, texts};
use super::slit::{close_slits, drop_specks};
use crate::edge::{Curve, Edge, difference, distance};
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::read::chains::joined;
use crate::read::diagnostic::diagnostic;
use crate::read::fit::{TURN, fitted};
use crate::read::marks::{add_notch, grain_of, low_corner, says_on_fold, unfold};
use crate::read::size::wrong_size;
use crate::read::unit::Unit;
use crate::sketch::Sketch;
use crate::write::as_written;

/// Distance of a vertex from a corner point that is meant to be it, in m.
const CORNER: f64 = 2e-4;

/// Distance of a slit from a mark of the same notch, in m.
const SLIT_MARK: f64 = 4e-3;

/// Number of places at which the width of a seam allowance is measured.
const PLACES: usize = 60;

/// Largest number of edges of an outline.
const EDGES: usize = 50_000;

/// Reader of the pieces of one file, with the mistakes and notes so far.
pub(crate) struct Reader<'a> {
    pub(crate) document: &'a Document,
    pub(crate) sketch: &'a mut Sketch,
    pub(crate) unit: Unit,
    /// Largest distance of curves from the chords that they take the place of, in m.
    pub(crate) tolerance: f64,
    pub(crate) mistakes: Vec<Diagnostic>,
    pub(crate) notes: Vec<PatternNote>,
}

/// Returns the name of a piece: what its text says, or the block's.
pub(crate) fn name(block: &Block) -> String {
    let name = field(block, "piece name").unwrap_or_else(|| block.name.clone());
    if name.is_empty() { "piece".into() } else { name }
}

impl Reader<'_> {
    /// Returns the panel of a piece.
    pub(crate) fn panel(&mut self, block: &Block) -> Option<Panel> {
        let name = name(block);
        let before = self.mistakes.len();
        let mut outline = self.outline(block, &name)?;
        drop_specks(&mut outline);
        let slits = close_slits(&mut outline);
        if !slits.is_empty() {
            let taken = format!("panel {name}: {} slits of its line are notches", slits.len());
            let reason = "the line runs in and back there";
            self.notes.push(PatternNote::Taken { taken, reason: reason.into() });
        }
        let corners: Vec<[f64; 2]> = self.points(block, &[2]);
        let mut edges = self.divided(&name, outline, &corners);
        let marked = self.points(block, &[4, 80, 81, 82, 83]);
        // A slit may be marked as well.
        let is_new = |at: &&[f64; 2]| marked.iter().all(|mark| distance(**at, *mark) > SLIT_MARK);
        for at in slits.iter().filter(is_new).chain(&marked) {
            add_notch(&mut edges, *at);
        }
        let line = |wanted: u32| {
            let chains = self.chains(block, wanted);
            let chain = chains.iter().flatten().collect::<Vec<_>>();
            Some([chain.first()?.start, chain.last()?.end])
        };
        let (fold, grain) = (line(6), line(7));
        match fold.and_then(|fold| unfold(&mut edges, fold)) {
            Some(edge) => self.notes.push(PatternNote::Unfolded { panel: name.clone(), edge }),
            None => {
                let text = texts(block).find(|text| says_on_fold(text)).map(str::to_owned);
                let text = text.or(fold.map(|_| "a mirror line, layer 6".into()));
                self.notes.extend(text.map(|text| PatternNote::Half { panel: name.clone(), text }));
            }
        }
        self.remarks(block, &name);
        let polygon: Vec<[f64; 2]> = edges.iter().flat_map(Edge::polyline).collect();
        let origin = low_corner(&polygon);
        let at = |answer: Diagnostic| answer.on_line(block.line);
        // With the digits that a pattern is written with: curves fitted to chords may come within
        // rounding of each other, and what is sound here is sound when it is read again.
        let place = |p| difference(p, origin).map(as_written);
        let edges: Vec<Edge> = edges.iter().map(|edge| edge.mapped(false, place)).collect();
        self.sketch.add(&name, &edges);
        let panel = match Panel::new(&name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                self.mistakes.extend(all.iter().map(|m| at(diagnostic(self.document, m))));
                return None;
            }
        };
        let unit = self.unit.word();
        self.mistakes.extend(wrong_size(&panel).map(|m| {
            let help = format!("lengths were taken in {unit}; if that is wrong: drape convert … --unit mm (cm, m, in)");
            at(diagnostic(self.document, &m).help(help))
        }));
        if self.mistakes.len() > before {
            return None;
        }
        match grain {
            Some(line) => panel.with_grain(grain_of(line)).ok(),
            None => {
                self.notes.push(PatternNote::NoGrain { panels: vec![name] });
                Some(panel)
            }
        }
    }

    /// Returns the points and midpoints of lines of a piece on some layers, in m.
    fn points(&self, block: &Block, layers: &[u32]) -> Vec<[f64; 2]> {
        let metres = self.unit.metres();
        let here =
            block.entities.iter().filter(|e| layer(&e.layer).is_some_and(|l| layers.contains(&l)));
        let ends = here.flat_map(|entity| match &entity.form {
            Form::Point(at) => vec![*at],
            Form::Chain(edges) => edges.iter().take(1).map(|edge| edge.start).collect(),
            _ => Vec::new(),
        });
        ends.map(|p| p.map(|x| x * metres)).collect()
    }

    /// Returns the chains of a piece on a layer, in m.
    fn chains(&self, block: &Block, wanted: u32) -> Vec<Vec<Edge>> {
        let metres = self.unit.metres();
        let scaled = |edge: &Edge| edge.mapped(false, |p| p.map(|x| x * metres));
        let here = block.entities.iter().filter(|entity| layer(&entity.layer) == Some(wanted));
        let chains = here.filter_map(|entity| match &entity.form {
            Form::Chain(edges) if !edges.is_empty() => {
                Some(edges.iter().map(scaled).collect::<Vec<Edge>>())
            }
            _ => None,
        });
        chains.collect()
    }

    /// Returns the largest closed chain of a layer, and how many chains stay open.
    fn closed(&self, block: &Block, wanted: u32) -> (Option<Vec<Edge>>, Vec<Vec<Edge>>) {
        let mut chains = self.chains(block, wanted);
        let closed = joined(&mut chains);
        let area = |chain: &Vec<Edge>| chain.iter().map(Edge::area).sum::<f64>().abs();
        (closed.into_iter().max_by(|a, b| area(a).total_cmp(&area(b))), chains)
    }

    /// Returns the outline of a piece: its sewing line if that is closed, or else its cut line.
    fn outline(&mut self, block: &Block, name: &str) -> Option<Vec<Edge>> {
        let (sewing, open) = self.closed(block, 14);
        let (cut, rest) = self.closed(block, 1);
        let fail = |reader: &mut Self, message: String, help: &str| {
            let mistake = Diagnostic::new(reader.document.path(), message);
            let mistake = mistake.on_line(block.line).help(help);
            reader.mistakes.push(mistake.about(Subject::Panel(name.to_owned())));
        };
        match (sewing, cut) {
            (Some(sewing), cut) => {
                if let Some(width) = cut.and_then(|cut| allowance(&sewing, &cut)) {
                    let taken = format!("panel {name}: its outline is the sewing line, layer 14");
                    let reason = format!(
                        "the cut line, layer 1, is {:.1} mm outside of it: give its seams allowance = {:.1}",
                        1e3 * width,
                        1e3 * width
                    );
                    self.notes.push(PatternNote::Taken { taken, reason });
                }
                Some(sewing).filter(|edges| self.few(edges, name, block.line))
            }
            (None, Some(cut)) => {
                let taken = format!("panel {name}: its outline is the cut line, layer 1");
                let reason = match open.is_empty() {
                    true => {
                        "there is no sewing line; a seam allowance, if it has one, is part of the panel"
                    }
                    false => {
                        "the sewing line, layer 14, is open; a seam allowance is part of the panel"
                    }
                };
                self.notes.push(PatternNote::Taken { taken, reason: reason.into() });
                Some(cut).filter(|edges| self.few(edges, name, block.line))
            }
            (None, None) => {
                let chain = rest.iter().max_by_key(|chain| chain.len());
                chain.iter().for_each(|chain| self.sketch.add(name, chain));
                let gap =
                    chain.map_or(0.0, |chain| distance(chain[0].start, chain[chain.len() - 1].end));
                let message = format!(
                    "piece {name}: its outline is open, by {}",
                    crate::length::Millimetres(gap)
                );
                fail(self, message, "close the piece in the program that wrote it");
                None
            }
        }
    }

    /// Adds a mistake if an outline has too many edges.
    fn few(&mut self, edges: &[Edge], name: &str, line: usize) -> bool {
        if edges.len() > EDGES {
            let message =
                format!("piece {name}: its outline has {} points, more than {EDGES}", edges.len());
            let mistake = Diagnostic::new(self.document.path(), message).on_line(line);
            self.mistakes.push(mistake.help("export it with fewer points"));
        }
        edges.len() <= EDGES
    }

    /// Returns an outline divided at its corners: runs of chords between them become curves.
    fn divided(&mut self, name: &str, mut outline: Vec<Edge>, marked: &[[f64; 2]]) -> Vec<Edge> {
        let on = |p: [f64; 2]| marked.iter().any(|q| distance(p, *q) < CORNER);
        let turn = |k: usize, outline: &[Edge]| {
            let before = &outline[(k + outline.len() - 1) % outline.len()];
            let (a, b) = (before.tangents()[1], outline[k].tangents()[0]);
            (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs()
        };
        let by_mark: Vec<bool> = outline.iter().map(|edge| on(edge.start)).collect();
        let marks = by_mark.iter().filter(|m| **m).count() >= 2;
        let mut corner: Vec<bool> = match marks {
            true => by_mark,
            false => (0..outline.len()).map(|k| turn(k, &outline) > TURN).collect(),
        };
        let first = corner.iter().position(|c| *c).unwrap_or(0);
        outline.rotate_left(first);
        corner.rotate_left(first);
        // A round piece has no corner; two edges are the fewest.
        let half = outline.len() / 2;
        if !corner[1..].contains(&true) && half > 0 {
            corner[half] = true;
        }
        corner[0] = true;
        let mut runs: Vec<Vec<Edge>> = Vec::new();
        for (edge, begins) in outline.into_iter().zip(corner) {
            match runs.last_mut() {
                Some(run) if !begins => run.push(edge),
                _ => runs.push(vec![edge]),
            }
        }
        let (mut edges, mut chords) = (Vec::new(), 0);
        let (mut from_points, mut from_chords) = (0.0_f64, 0.0_f64);
        for (number, run) in runs.into_iter().enumerate() {
            let chord = |edge: &Edge| edge.curve == Curve::Line;
            let pieces = if run.len() > 1 && run.iter().all(chord) {
                chords += run.len();
                let ends = run.iter().map(|edge| edge.end);
                let points: Vec<[f64; 2]> = [run[0].start].into_iter().chain(ends).collect();
                let fit = fitted(&points, self.tolerance);
                from_points = fit.from_points.max(from_points);
                from_chords = fit.from_chords.max(from_chords);
                fit.edges
            } else {
                run
            };
            edges.extend(pieces.into_iter().enumerate().map(|(part, edge)| {
                let name = match part {
                    0 => (number + 1).to_string(),
                    _ => format!("{}{}", number + 1, letters(part)),
                };
                Edge { name, ..edge }
            }));
        }
        if chords > edges.len() {
            let taken = format!(
                "panel {name}: {chords} chords are {} edges within {:.2} mm of their points and {:.2} mm of the chords",
                edges.len(),
                1e3 * from_points,
                1e3 * from_chords
            );
            let reason = if marks {
                "corners are those of layer 2"
            } else {
                "corners are turns of 20° or more"
            };
            self.notes.push(PatternNote::Taken { taken, reason: reason.into() });
        }
        edges
    }

    /// Adds notes on what the pattern has no words for.
    fn remarks(&mut self, block: &Block, name: &str) {
        for (key, advice) in [
            ("material", "give the panel a fabric"),
            ("quantity", "another one is a panel with copy_of, and mirrored = true"),
        ] {
            if let Some(value) =
                field(block, key).filter(|value| !matches!(value.as_str(), "1" | "1,0" | "1, 0"))
            {
                let taken = format!("panel {name}: the file says \"{key}: {value}\"");
                self.notes.push(PatternNote::Taken { taken, reason: advice.into() });
            }
        }
        let count =
            |wanted: u32| block.entities.iter().filter(|e| layer(&e.layer) == Some(wanted)).count();
        for (number, what) in [(8, "lines inside"), (11, "cut-outs"), (13, "drill holes")] {
            let found = count(number);
            if found > 0 {
                let part = format!("panel {name}: {found} {what} on layer {number}");
                self.notes.push(PatternNote::LeftOut {
                    part,
                    reason: "the pattern has no words for them".into(),
                });
            }
        }
        let others = block.entities.iter().filter_map(|entity| match &entity.form {
            Form::Other(kind) if matches!(layer(&entity.layer), Some(1 | 14)) => Some(kind),
            _ => None,
        });
        if let Some(kind) = others.into_iter().next() {
            let part = format!("panel {name}: entities {kind}");
            self.notes.push(PatternNote::LeftOut {
                part,
                reason: "outlines are read of lines, arcs and polylines".into(),
            });
        }
    }
}

/// Returns the median distance of a sewing line from the cut line round it, in m.
fn allowance(sewing: &[Edge], cut: &[Edge]) -> Option<f64> {
    let total: f64 = sewing.iter().map(Edge::length).sum();
    let mut points = Vec::new();
    let mut before = 0.0;
    for edge in sewing {
        let length = edge.length();
        // Places at equal distances along the whole line.
        while points.len() < PLACES
            && before + length > (points.len() as f64 + 0.5) * total / PLACES as f64
        {
            let along = (points.len() as f64 + 0.5) * total / PLACES as f64 - before;
            points.push(edge.at(along / length));
        }
        before += length;
    }
    let off = |p: [f64; 2]| {
        let near = cut.iter().map(|edge| {
            let chord = difference(edge.end, edge.start);
            let arm = difference(p, edge.start);
            let square = chord[0] * chord[0] + chord[1] * chord[1];
            let t = ((arm[0] * chord[0] + arm[1] * chord[1]) / square).clamp(0.0, 1.0);
            distance(p, [edge.start[0] + t * chord[0], edge.start[1] + t * chord[1]])
        });
        near.fold(f64::MAX, f64::min)
    };
    let mut all: Vec<f64> = points.into_iter().map(off).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().filter(|width| width.is_finite())
}

/// Returns the letter of a further part of an edge: b, c, …, z, then b2 and so on.
fn letters(part: usize) -> String {
    let letter = char::from(b'a' + (part % 26) as u8);
    match part / 26 {
        0 => letter.to_string(),
        round => format!("{letter}{}", round + 1),
    }
}
