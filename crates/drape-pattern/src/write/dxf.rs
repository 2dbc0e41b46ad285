//! Pattern in DXF, as programs of pattern makers read it: ASTM D6673, which continues AAMA-292.
//!
//! Every panel is a block, in mm. Layer 1 has its outline as a closed polyline with its texts, 2
//! the corners, 3 the points of curves, 4 the notches, 7 the grain line, and 8 the lines inside:
//! folds and closed darts. The section `ENTITIES` places the blocks in rows and says that lengths
//! are metric.

use std::fmt::Write;

use super::dxf_text::escaped;
use super::grain_line::GrainLine;
use super::layout::{Rows, usual_width};
use super::number::millimetres;
use super::svg::extent;
use crate::length::Millimetres;
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::pattern::Pattern;

/// Largest distance of a curve from its chords, in m.
const TOLERANCE: f64 = 1e-4;

/// Gap between panels where the file places them, in mm.
const GAP: f64 = 30.0;

/// Height of texts, in mm.
const TEXT: f64 = 6.0;

/// Longest name of a block in DXF of release 12.
const LONGEST_NAME: usize = 31;

/// Layers of ASTM D6673.
mod layers {
    /// Boundary of the piece, and texts.
    pub(super) const OUTLINE: u32 = 1;
    pub(super) const CORNERS: u32 = 2;
    pub(super) const CURVE_POINTS: u32 = 3;
    pub(super) const NOTCHES: u32 = 4;
    pub(super) const GRAIN: u32 = 7;
    pub(super) const INSIDE: u32 = 8;
}

/// Pattern in DXF.
#[derive(Debug, Clone, PartialEq)]
pub struct DxfDrawing {
    /// Text of the file.
    pub text: String,
    /// Notes on the parts of the pattern that DXF cannot express, for the user.
    pub notes: Vec<PatternNote>,
}

impl Pattern {
    /// Returns the pattern in DXF of ASTM D6673 (AAMA), in mm, under the name `style`: for programs
    /// of pattern makers.
    ///
    /// Curves become chords within 0.1 mm. The outline of a panel is the line on which it is sewn.
    /// DXF has no words for seams, for names of edges, and for places in space. Allowances and hems
    /// are not added to the outline. The notes of the result name what is missing.
    ///
    /// ```
    /// use drape_input::Document;
    /// use drape_pattern::Pattern;
    ///
    /// let text = "length = \"cm\"\n[panel.band]\ngrain = 0\nrectangle = [80, 6]\n";
    /// let pattern = Pattern::parse(&Document::new("band.toml", text))?;
    /// let drawing = pattern.to_dxf("waistband");
    /// let again = Pattern::parse(&Document::new("band.dxf", drawing.text))?;
    /// assert!((again.panels()[0].area() - 0.048).abs() < 1e-9);
    /// # Ok::<(), drape_input::Diagnostics>(())
    /// ```
    #[must_use]
    pub fn to_dxf(&self, style: &str) -> DxfDrawing {
        let mut file = DxfText::default();
        file.open_section("HEADER");
        for (variable, code, value) in
            [("$ACADVER", 1, "AC1009"), ("$INSUNITS", 70, "4"), ("$MEASUREMENT", 70, "1")]
        {
            file.pair(9, variable);
            file.pair(code, value);
        }
        file.pair(0, "ENDSEC");

        file.open_section("BLOCKS");
        let names = block_names(self.panels());
        for (panel, name) in self.panels().iter().zip(&names) {
            file.block(panel, name);
        }
        file.pair(0, "ENDSEC");

        file.open_section("ENTITIES");
        let extents: Vec<_> = self.panels().iter().map(extent).collect();
        let rows = Rows::new(&extents, GAP, usual_width(&extents));
        for (name, [x, y]) in names.iter().zip(rows.origins) {
            file.entity("INSERT", layers::OUTLINE);
            file.pair(2, name);
            file.point(0, [1e-3 * x, -1e-3 * y]);
        }
        let facts = [
            ("STYLE NAME", style),
            ("SAMPLE SIZE", SIZE),
            ("UNITS", "METRIC"),
            ("CURVE TOLERANCE", "0.1"),
        ];
        for (line, (key, value)) in facts.into_iter().enumerate() {
            // The texts stand over the pieces, the first on top.
            file.text(key, value, [0.0, 1e-3 * 2.0 * TEXT * (4 - line) as f64]);
        }
        file.pair(0, "ENDSEC");
        file.pair(0, "EOF");
        DxfDrawing { text: file.0, notes: missing(self) }
    }
}

/// Size that every piece states, because a pattern has one size.
const SIZE: &str = "ONE";

/// Text of a file, pair by pair.
#[derive(Default)]
struct DxfText(String);

impl DxfText {
    /// Writes the group code `code` with `value`.
    fn pair(&mut self, code: i32, value: &str) {
        let _ = writeln!(self.0, "{code}\n{value}");
    }

    /// Writes the beginning of the section `name`.
    fn open_section(&mut self, name: &str) {
        self.pair(0, "SECTION");
        self.pair(2, name);
    }

    /// Writes the beginning of an entity of the kind `kind` on `layer`.
    fn entity(&mut self, kind: &str, layer: u32) {
        self.pair(0, kind);
        self.pair(8, &layer.to_string());
    }

    /// Writes `at`, in m, as the point with the number `number` of an entity.
    fn point(&mut self, number: i32, at: [f64; 2]) {
        self.pair(10 + number, &millimetres(at[0]));
        self.pair(20 + number, &millimetres(at[1]));
        self.pair(30 + number, "0");
    }

    /// Writes the text `key: value` at the point `at`, in m.
    fn text(&mut self, key: &str, value: &str, at: [f64; 2]) {
        self.entity("TEXT", layers::OUTLINE);
        self.point(0, at);
        self.pair(40, &TEXT.to_string());
        self.pair(1, &format!("{key}: {}", escaped(value)));
    }

    /// Writes marks at `points`, in m, on `layer`.
    fn marks(&mut self, layer: u32, points: impl IntoIterator<Item = [f64; 2]>) {
        for at in points {
            self.entity("POINT", layer);
            self.point(0, at);
        }
    }

    /// Writes the straight line between `ends`, in m, on `layer`.
    fn line(&mut self, layer: u32, ends: [[f64; 2]; 2]) {
        self.entity("LINE", layer);
        self.point(0, ends[0]);
        self.point(1, ends[1]);
    }

    /// Writes the closed polyline through `points`, in m, on `layer`.
    fn closed_line(&mut self, layer: u32, points: &[[f64; 2]]) {
        self.entity("POLYLINE", layer);
        self.pair(66, "1");
        self.point(0, [0.0; 2]);
        self.pair(70, "1");
        for at in points {
            self.entity("VERTEX", layer);
            self.point(0, *at);
        }
        self.entity("SEQEND", layer);
    }

    /// Writes the block `name` of `panel`.
    fn block(&mut self, panel: &Panel, name: &str) {
        self.entity("BLOCK", layers::OUTLINE);
        self.pair(2, name);
        self.pair(70, "0");
        self.point(0, [0.0; 2]);

        // The outline, with marks at corners, points of curves and notches.
        let lines: Vec<Vec<[f64; 2]>> =
            panel.outline().iter().map(|edge| edge.chords(TOLERANCE)).collect();
        let points: Vec<[f64; 2]> = lines.concat();
        self.closed_line(layers::OUTLINE, &points);
        self.marks(layers::CORNERS, panel.outline().iter().map(|edge| edge.start));
        self.marks(layers::CURVE_POINTS, lines.iter().flat_map(|points| &points[1..]).copied());
        for edge in panel.outline() {
            let length = edge.length();
            self.marks(layers::NOTCHES, edge.notches.iter().map(|at| edge.at(at / length)));
        }

        // Lines inside.
        for hole in panel.loops().skip(1) {
            let points: Vec<[f64; 2]> =
                hole.iter().flat_map(|edge| edge.chords(TOLERANCE)).collect();
            self.closed_line(layers::INSIDE, &points);
        }
        panel.folds().iter().for_each(|fold| self.line(layers::INSIDE, fold.ends));

        // The grain line, with the texts beside its middle.
        let (sine, cosine) = panel.grain().sin_cos();
        let polygon: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| 1e3 * x)).collect();
        let grain = GrainLine::new(&polygon, [-sine, cosine]);
        self.line(layers::GRAIN, grain.ends.map(|p| p.map(|x| 1e-3 * x)));
        let [x, y] = grain.middle.map(|x| 1e-3 * x);
        let facts = [
            ("PIECE NAME", Some(panel.name())),
            ("SIZE", Some(SIZE)),
            ("QUANTITY", Some("1")),
            ("MATERIAL", panel.fabric()),
        ];
        let facts = facts.into_iter().filter_map(|(key, value)| Some((key, value?)));
        for (line, (key, value)) in facts.enumerate() {
            self.text(key, value, [x + 2e-3, y - 1.5e-3 * TEXT * line as f64]);
        }
        self.entity("ENDBLK", layers::OUTLINE);
    }
}

/// Returns a different block name for each of `panels`: the letters and digits of its name,
/// shortened to the length that DXF allows. A name that an earlier panel has gets a number.
fn block_names(panels: &[Panel]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for panel in panels {
        let letters = panel.name().chars().map(|letter| match letter {
            'a'..='z' | 'A'..='Z' | '0'..='9' => letter.to_ascii_uppercase(),
            _ => '_',
        });
        let name: String = letters.take(LONGEST_NAME).collect();
        let mut unique = name.clone();
        let mut number = 1;
        while names.contains(&unique) {
            number += 1;
            let suffix = format!("_{number}");
            let kept: String = name.chars().take(LONGEST_NAME - suffix.len()).collect();
            unique = kept + &suffix;
        }
        names.push(unique);
    }
    names
}

/// Returns a note for each part of `pattern` that DXF cannot express.
fn missing(pattern: &Pattern) -> Vec<PatternNote> {
    let mut notes = Vec::new();
    let mut leave_out = |part: String, reason: &str| {
        notes.push(PatternNote::LeftOut { part, reason: reason.into() });
    };

    let seams: Vec<_> = pattern.seams().iter().filter(|seam| !pattern.is_dart(seam)).collect();
    if !seams.is_empty() {
        let part = format!("{} seams, and the names of edges", seams.len());
        leave_out(part, "DXF has no words for them");
    }

    // Widths of the cloth beyond the outline.
    let outlines = pattern.panels().iter().flat_map(Panel::outline);
    let widths = seams.iter().map(|seam| seam.allowance).chain(outlines.map(|edge| edge.hem));
    let widest = widths.fold(0.0, f64::max);
    if widest > 0.0 {
        let part = format!("allowances and hems of up to {}", Millimetres(widest));
        leave_out(part, "the outlines are the lines of the seams; add them where the cloth is cut");
    }

    for panel in pattern.panels() {
        let closed = panel.loops().count() - 1;
        if closed > 0 {
            let part = format!("panel {}: the seams of {closed} closed darts", panel.name());
            leave_out(part, "the darts are lines inside, on layer 8");
        }
        if !panel.folds().is_empty() {
            let part =
                format!("panel {}: the angles of {} folds", panel.name(), panel.folds().len());
            leave_out(part, "the folds are lines inside, on layer 8");
        }
    }
    if pattern.panels().iter().any(|panel| panel.placement().is_some()) {
        leave_out("the places of panels in space".into(), "DXF has no words for them");
    }
    notes
}
