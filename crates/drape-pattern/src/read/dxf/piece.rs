//! Panel of a piece: its sewing line, or its cut line, divided into edges at its corners.

use drape_input::{Advice, Diagnostic, Document, Remedy, Subject};

use super::entities::{Block, Form, field, layer, texts};
use super::slit::{close_slits, drop_specks};
use crate::edge::{Curve, Edge, difference, distance, distance_from_segment, turning_angle};
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::read::chains::joined;
use crate::read::diagnostic::diagnostic;
use crate::read::fit::{TURN, fitted};
use crate::read::marks::{add_notch, grain_angle, low_corner, says_on_fold, unfold};
use crate::read::size::wrong_size;
use crate::read::unit::{DXF_UNITS, Unit};
use crate::sketch::Sketch;
use crate::write::as_written;

/// Largest distance between a vertex and the corner point that marks it, in m.
const CORNER: f64 = 2e-4;

/// Largest distance between a slit and a mark of the same notch, in m.
const SLIT_MARK: f64 = 4e-3;

/// Number of points at which the width of a seam allowance is measured.
const ALLOWANCE_POINTS: usize = 60;

/// Largest number of edges of an outline.
const MOST_EDGES: usize = 50_000;

/// Reader of the pieces of one file, with the mistakes and notes so far.
pub(crate) struct Reader<'a> {
    pub(crate) document: &'a Document,
    pub(crate) sketch: &'a mut Sketch,
    pub(crate) unit: Unit,
    /// Largest distance of curves from the chords that they replace, in m.
    pub(crate) tolerance: f64,
    pub(crate) mistakes: Vec<Diagnostic>,
    pub(crate) notes: Vec<PatternNote>,
}

/// Returns the name of the piece `block`: the name that its text states, or the name of the block.
pub(crate) fn name(block: &Block) -> String {
    let name = field(block, "piece name").unwrap_or_else(|| block.name.clone());
    if name.is_empty() { "piece".into() } else { name }
}

impl Reader<'_> {
    /// Returns the panel of the piece `block`.
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
        let unmarked = slits
            .iter()
            .filter(|slit| marked.iter().all(|mark| distance(**slit, *mark) > SLIT_MARK));
        for at in unmarked.chain(&marked) {
            add_notch(&mut edges, *at);
        }

        let [fold, grain] = [6, 7].map(|layer| self.line(block, layer));
        match fold.and_then(|fold| unfold(&mut edges, fold)) {
            Some(edge) => self.notes.push(PatternNote::Unfolded { panel: name.clone(), edge }),
            None => {
                let text = texts(block).find(|text| says_on_fold(text)).map(str::to_owned);
                let text = text.or(fold.map(|_| "a mirror line, layer 6".into()));
                self.notes.extend(text.map(|text| PatternNote::Half { panel: name.clone(), text }));
            }
        }
        self.remarks(block, &name);

        // Points get the digits that a pattern is written with. Curves that are fitted to chords
        // may come within rounding of each other, and a sound panel must be sound when it is read
        // again.
        let polygon: Vec<[f64; 2]> = edges.iter().flat_map(Edge::polyline).collect();
        let origin = low_corner(&polygon);
        let edges: Vec<Edge> = edges
            .iter()
            .map(|edge| edge.mapped(false, |p| difference(p, origin).map(as_written)))
            .collect();
        self.sketch.add_outline(&name, &edges);
        let panel = match Panel::new(&name, edges) {
            Ok(panel) => panel,
            Err(all) => {
                let answers = all.iter().map(|mistake| diagnostic(self.document, mistake));
                self.mistakes.extend(answers.map(|answer| answer.on_line(block.line)));
                return None;
            }
        };
        if let Some(mistake) = wrong_size(&panel) {
            let unit = self.unit.word();
            let file = self.document.path().to_owned();
            let help = Advice::from(format!("lengths were taken in {unit}"))
                .with(Remedy::CorrectUnit { file, units: DXF_UNITS });
            let answer = diagnostic(self.document, &mistake).help(help);
            self.mistakes.push(answer.on_line(block.line));
        }
        if self.mistakes.len() > before {
            return None;
        }
        match grain {
            Some(line) => panel.with_grain(grain_angle(line)).ok(),
            None => {
                self.notes.push(PatternNote::NoGrain { panels: vec![name] });
                Some(panel)
            }
        }
    }

    /// Returns the first and the last point of the chains of `block` on the layer `wanted`, in m.
    fn line(&self, block: &Block, wanted: u32) -> Option<[[f64; 2]; 2]> {
        let chains = self.chains(block, wanted);
        let mut edges = chains.iter().flatten();
        let first = edges.next()?;
        Some([first.start, edges.last().unwrap_or(first).end])
    }

    /// Returns the points and the starts of lines of `block` on `layers`, in m.
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

    /// Returns the chains of `block` on the layer `wanted`, in m.
    fn chains(&self, block: &Block, wanted: u32) -> Vec<Vec<Edge>> {
        let metres = self.unit.metres();
        let mut chains = Vec::new();
        for entity in block.entities.iter().filter(|e| layer(&e.layer) == Some(wanted)) {
            if let Form::Chain(edges) = &entity.form
                && !edges.is_empty()
            {
                let scaled = edges.iter().map(|edge| edge.mapped(false, |p| p.map(|x| x * metres)));
                chains.push(scaled.collect());
            }
        }
        chains
    }

    /// Returns the largest closed chain of `block` on the layer `wanted`, and the chains that stay
    /// open.
    fn closed(&self, block: &Block, wanted: u32) -> (Option<Vec<Edge>>, Vec<Vec<Edge>>) {
        let mut chains = self.chains(block, wanted);
        let closed = joined(&mut chains).into_iter().map(|chain| {
            let area = chain.iter().map(Edge::area).sum::<f64>().abs();
            (area, chain)
        });
        let largest = closed.max_by(|a, b| a.0.total_cmp(&b.0));
        (largest.map(|(_, chain)| chain), chains)
    }

    /// Returns the outline of `block`, the piece `name`: its sewing line if that is closed, or else
    /// its cut line.
    fn outline(&mut self, block: &Block, name: &str) -> Option<Vec<Edge>> {
        let (sewing, open_sewing) = self.closed(block, 14);
        let (cut, open_cut) = self.closed(block, 1);
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
                Some(sewing).filter(|edges| self.check_edge_count(edges, name, block.line))
            }
            (None, Some(cut)) => {
                let taken = format!("panel {name}: its outline is the cut line, layer 1");
                let reason = if open_sewing.is_empty() {
                    "there is no sewing line; a seam allowance, if it has one, is part of the panel"
                } else {
                    "the sewing line, layer 14, is open; a seam allowance is part of the panel"
                };
                self.notes.push(PatternNote::Taken { taken, reason: reason.into() });
                Some(cut).filter(|edges| self.check_edge_count(edges, name, block.line))
            }
            // The longest open chain shows how far the outline is from closed.
            (None, None) => {
                let chain = open_cut.iter().max_by_key(|chain| chain.len());
                chain.iter().for_each(|chain| self.sketch.add_outline(name, chain));
                let gap =
                    chain.map_or(0.0, |chain| distance(chain[0].start, chain[chain.len() - 1].end));
                let message = format!(
                    "piece {name}: its outline is open, by {}",
                    crate::length::Millimetres(gap)
                );
                let mistake = Diagnostic::new(self.document.path(), message)
                    .on_line(block.line)
                    .help("close the piece in the program that wrote it");
                self.mistakes.push(mistake.about(Subject::Panel(name.to_owned())));
                None
            }
        }
    }

    /// Returns whether `edges`, the outline of the piece `name` on `line` of the file, are few
    /// enough. Adds a mistake if not.
    fn check_edge_count(&mut self, edges: &[Edge], name: &str, line: usize) -> bool {
        if edges.len() > MOST_EDGES {
            let message = format!(
                "piece {name}: its outline has {} points, more than {MOST_EDGES}",
                edges.len()
            );
            let mistake = Diagnostic::new(self.document.path(), message).on_line(line);
            self.mistakes.push(mistake.help("export it with fewer points"));
        }
        edges.len() <= MOST_EDGES
    }

    /// Returns `outline` divided at its corners, with curves for the runs of chords between them.
    /// Edges have numbers. `marked` are the corners that the piece `name` marks.
    fn divided(&mut self, name: &str, outline: Vec<Edge>, marked: &[[f64; 2]]) -> Vec<Edge> {
        let by_mark: Vec<bool> = outline
            .iter()
            .map(|edge| marked.iter().any(|mark| distance(edge.start, *mark) < CORNER))
            .collect();
        let has_marks = by_mark.iter().filter(|is_corner| **is_corner).count() >= 2;
        let is_corner = if has_marks { by_mark } else { turns(&outline) };

        let (mut edges, mut chord_count) = (Vec::new(), 0);
        let (mut from_points, mut from_chords) = (0.0_f64, 0.0_f64);
        for (number, run) in runs(outline, is_corner).into_iter().enumerate() {
            let is_polyline = run.len() > 1 && run.iter().all(|edge| edge.curve == Curve::Line);
            let pieces = if is_polyline {
                chord_count += run.len();
                let mut points = vec![run[0].start];
                points.extend(run.iter().map(|edge| edge.end));
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

        if chord_count > edges.len() {
            let taken = format!(
                "panel {name}: {chord_count} chords are {} edges within {:.2} mm of their points and {:.2} mm of the chords",
                edges.len(),
                1e3 * from_points,
                1e3 * from_chords
            );
            let reason = if has_marks {
                "corners are those of layer 2"
            } else {
                "corners are turns of 20° or more"
            };
            self.notes.push(PatternNote::Taken { taken, reason: reason.into() });
        }
        edges
    }

    /// Adds notes on facts about the piece `name` that a pattern cannot state.
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

        for (number, content) in [(8, "lines inside"), (11, "cut-outs"), (13, "drill holes")] {
            let on_layer = block.entities.iter().filter(|e| layer(&e.layer) == Some(number));
            let count = on_layer.count();
            if count > 0 {
                let part = format!("panel {name}: {count} {content} on layer {number}");
                self.notes.push(PatternNote::LeftOut {
                    part,
                    reason: "the pattern has no words for them".into(),
                });
            }
        }

        // One note is enough for all entities that are not read.
        let mut unread = block.entities.iter().filter_map(|entity| match &entity.form {
            Form::Other(kind) if matches!(layer(&entity.layer), Some(1 | 14)) => Some(kind),
            _ => None,
        });
        if let Some(kind) = unread.next() {
            let part = format!("panel {name}: entities {kind}");
            self.notes.push(PatternNote::LeftOut {
                part,
                reason: "outlines are read of lines, arcs and polylines".into(),
            });
        }
    }
}

/// Returns for each edge of the closed line `outline` whether it begins at a sharp turn.
fn turns(outline: &[Edge]) -> Vec<bool> {
    (0..outline.len())
        .map(|k| {
            let before = &outline[(k + outline.len() - 1) % outline.len()];
            turning_angle(before.tangents()[1], outline[k].tangents()[0]).abs() > TURN
        })
        .collect()
}

/// Returns the runs of the closed line `outline` between its corners, the first from the first
/// corner on. `is_corner` says for each edge whether it begins at a corner.
fn runs(mut outline: Vec<Edge>, mut is_corner: Vec<bool>) -> Vec<Vec<Edge>> {
    let first = is_corner.iter().position(|is_corner| *is_corner).unwrap_or(0);
    outline.rotate_left(first);
    is_corner.rotate_left(first);

    // A round piece has no corner, and an outline needs two edges.
    let half = outline.len() / 2;
    if !is_corner[1..].contains(&true) && half > 0 {
        is_corner[half] = true;
    }
    is_corner[0] = true;

    let mut runs: Vec<Vec<Edge>> = Vec::new();
    for (edge, begins) in outline.into_iter().zip(is_corner) {
        match runs.last_mut() {
            Some(run) if !begins => run.push(edge),
            _ => runs.push(vec![edge]),
        }
    }
    runs
}

/// Returns the median distance of the sewing line `sewing` from the cut line `cut` round it, in m.
fn allowance(sewing: &[Edge], cut: &[Edge]) -> Option<f64> {
    let total: f64 = sewing.iter().map(Edge::length).sum();
    let mut points = Vec::new();
    let mut before = 0.0;
    for edge in sewing {
        let length = edge.length();
        // Points at equal distances along the whole line.
        while points.len() < ALLOWANCE_POINTS
            && before + length > (points.len() as f64 + 0.5) * total / ALLOWANCE_POINTS as f64
        {
            let along = (points.len() as f64 + 0.5) * total / ALLOWANCE_POINTS as f64 - before;
            points.push(edge.at(along / length));
        }
        before += length;
    }

    let distances = points.into_iter().map(|p| {
        let near = cut.iter().map(|edge| distance_from_segment(p, [edge.start, edge.end]));
        near.fold(f64::MAX, f64::min)
    });
    let mut distances: Vec<f64> = distances.collect();
    distances.sort_by(f64::total_cmp);
    distances.get(distances.len() / 2).copied().filter(|width| width.is_finite())
}

/// Returns the letter of the further part `part`, from 1, of an edge: b, c, …, z, then b2 and so
/// on.
fn letters(part: usize) -> String {
    let letter = char::from(b'a' + (part % 26) as u8);
    match part / 26 {
        0 => letter.to_string(),
        round => format!("{letter}{}", round + 1),
    }
}
