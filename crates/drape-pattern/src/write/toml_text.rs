//! Pattern as text in the project's format.

use std::fmt::Write;

use drape_input::{figure_in_decimals, toml_key, toml_string};

use super::number::{as_written, millimetres, point};
use crate::ease::{DEFAULT_EASE, MAX_EASE};
use crate::edge::{Curve, Edge, distance};
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::pattern::seam::Seam;

impl Pattern {
    /// Returns the pattern in the project's format, in mm, with `heading` and its notes as
    /// comments.
    ///
    /// ```
    /// use drape_input::Document;
    /// use drape_pattern::Pattern;
    ///
    /// let text = "length = \"cm\"\n[panel.a]\ngrain = 0\nrectangle = [20, 30]\n";
    /// let pattern = Pattern::parse(&Document::new("strip.toml", text))?;
    /// let again = Pattern::parse(&Document::new("again.toml", pattern.to_toml("A strip.")))?;
    /// assert_eq!(again.panels()[0].outline()[1].end, [0.2, 0.3]);
    /// # Ok::<(), drape_input::Diagnostics>(())
    /// ```
    #[must_use]
    pub fn to_toml(&self, heading: &str) -> String {
        let mut text = String::new();
        heading.lines().for_each(|line| comment(&mut text, line));
        if !self.notes().is_empty() {
            text += "#\n# Notes:\n";
            self.notes().iter().for_each(|note| comment(&mut text, &format!("- {note}")));
        }
        text += "length = \"mm\"\n";
        for panel in self.panels() {
            self.panel(panel, &mut text);
        }
        for seam in self.seams().iter().filter(|seam| !self.is_dart(seam)) {
            self.seam(seam, &mut text);
        }
        if self.seams().is_empty() {
            text += "\n# [seam.side]\n# sides = [[\"PANEL.EDGE\"], [\"PANEL.EDGE\"]]\n";
        }
        text
    }

    /// Writes the table of `panel` to `text`.
    fn panel(&self, panel: &Panel, text: &mut String) {
        let key = toml_key(panel.name());
        let _ = writeln!(text, "\n[panel.{key}]");
        let is_assumed = self.notes().iter().any(|note| match note {
            PatternNote::NoGrain { panels } => panels.iter().any(|name| name == panel.name()),
            _ => false,
        });
        let remark = if is_assumed { "    # assumed" } else { "" };
        let _ = writeln!(text, "grain = {}{remark}", degrees(panel.grain()));
        if let Some(fabric) = panel.fabric() {
            let _ = writeln!(text, "fabric = {}", toml_string(fabric));
        }

        let outline = panel.outline();
        let _ = writeln!(text, "start = {}", point(&outline[0].start));
        text.push_str("outline = [\n");
        for edge in outline {
            let remark = match self.seam_of(panel, edge) {
                Some(seam) => format!(", seam {}", plain(&seam.name)),
                None => String::new(),
            };
            let length = figure_in_decimals(1e3 * edge.length(), 1);
            let _ = writeln!(text, "    {},    # {length} mm{remark}", edge_text(edge));
        }
        text.push_str("]\n");

        write_placement(panel, text);
        write_darts(panel, text);
        for fold in panel.folds() {
            let [from, to] = fold.ends.map(|end| point(&end));
            let angle = degrees(fold.angle);
            let _ =
                writeln!(text, "\n[[panel.{key}.fold]]\nfrom = {from}\nto = {to}\nangle = {angle}");
        }
    }

    /// Returns the seam that sews `edge` of `panel`.
    fn seam_of(&self, panel: &Panel, edge: &Edge) -> Option<&Seam> {
        let mut seams = self.seams().iter();
        seams.find(|seam| seam.sides.iter().flatten().any(|&id| self.is_edge_of(id, panel, edge)))
    }

    /// Writes the table of `seam` to `text`.
    pub(crate) fn seam(&self, seam: &Seam, text: &mut String) {
        let sides = seam.sides.each_ref().map(|side| {
            let words = side.iter().map(|&id| toml_string(&self.edge_word(id)));
            words.collect::<Vec<_>>().join(", ")
        });
        let lengths =
            seam.sides.each_ref().map(|side| figure_in_decimals(1e3 * self.side_length(side), 1));
        let _ = writeln!(
            text,
            "\n[seam.{}]\nsides = [[{}], [{}]]    # {} mm on {} mm",
            toml_key(&seam.name),
            sides[0],
            sides[1],
            lengths[0],
            lengths[1]
        );
        // A key is left out if it has its default.
        if seam.reversed {
            text.push_str("reversed = true\n");
        }
        if seam.max_ease != DEFAULT_EASE {
            let is_most = seam.max_ease == MAX_EASE;
            let remark = if is_most { "    # the most that can be cut" } else { "" };
            let _ = writeln!(text, "max_ease = {}{remark}", seam.max_ease);
        }
        if seam.angle != 0.0 {
            let _ = writeln!(text, "angle = {}", degrees(seam.angle));
        }
        if seam.allowance != 0.0 {
            let _ = writeln!(text, "allowance = {}", millimetres(seam.allowance));
        }
    }
}

/// Writes the closed darts of `panel` to `text`. Legs of open darts are edges of the outline, and
/// their seams are written as seams.
pub(crate) fn write_darts(panel: &Panel, text: &mut String) {
    let key = toml_key(panel.name());
    for dart in panel.darts().iter().filter(|dart| !dart.hole().is_empty()) {
        let legs = dart.leg_edges();
        let Some(from) = legs[0].first().map(|edge| point(&edge.start)) else { continue };
        let name = toml_string(&dart.name);
        let _ = writeln!(text, "\n[[panel.{key}.dart]]\nname = {name}\nfrom = {from}");
        for (side, leg) in ["left", "right"].iter().zip(&legs) {
            // The legs have no names: reading names their edges after the dart.
            let edges: Vec<String> =
                leg.iter().map(|edge| format!("{{ {} }}", shape(edge))).collect();
            let _ = writeln!(text, "{side} = [{}]", edges.join(", "));
        }
    }
}

/// Writes the placement of `panel` in space to `text`.
pub(crate) fn write_placement(panel: &Panel, text: &mut String) {
    let Some(placement) = panel.placement() else { return };
    let turn = placement.angles().map(degrees).join(", ");
    let _ = writeln!(text, "origin = {}\nturn = [{turn}]", point(&placement.translation));
    if let Some(wrap) = placement.wrap {
        let _ = writeln!(text, "wrap = {}", millimetres(wrap));
    }
}

/// Returns `edge` as an inline table.
fn edge_text(edge: &Edge) -> String {
    let mut text = format!("{{ name = {}, {}", toml_string(&edge.name), shape(edge));
    if edge.hem != 0.0 {
        let _ = write!(text, ", hem = {}", millimetres(edge.hem));
    }
    if !edge.notches.is_empty() {
        // A notch at the very end stays within the edge, whose ends are rounded.
        let length = edge.mapped(false, |p| p.map(as_written)).length();
        let inside = edge.notches.iter().map(|at| (at.min(length) - 1e-7).max(0.0));
        let all: Vec<String> = inside.map(millimetres).collect();
        let _ = write!(text, ", notches = [{}]", all.join(", "));
    }
    text + " }"
}

/// Returns the end and the curve of `edge`, as keys of an inline table.
fn shape(edge: &Edge) -> String {
    let mut text = format!("to = {}", point(&edge.end));
    let _ = match edge.curve {
        Curve::Line => Ok(()),
        Curve::Quadratic(control) => write!(text, ", quadratic = {}", point(&control)),
        Curve::Cubic([first, second]) => {
            write!(text, ", cubic = [{}, {}]", point(&first), point(&second))
        }
        Curve::Arc { sweep } => {
            // The radius belongs to the rounded ends. It has all its digits, because near a half
            // circle a small change of the radius is a large change of the arc.
            let [start, end] = [edge.start, edge.end].map(|p| p.map(|x| (1e7 * x).round() / 1e7));
            let half = 0.5e3 * distance(start, end);
            let radius = half / (0.5 * sweep).sin();
            let large = if sweep.abs() > std::f64::consts::PI { ", large = true" } else { "" };
            // The sine of half a negative angle is negative: the arc turns right.
            write!(text, ", radius = {radius}{large}")
        }
    };
    text
}

/// Returns `angle`, in rad, as a number of degrees.
pub(crate) fn degrees(angle: f64) -> String {
    figure_in_decimals(angle.to_degrees(), 6)
}

/// Returns `name` without the letters that would end a comment.
fn plain(name: &str) -> String {
    name.chars().map(|letter| if letter.is_control() { ' ' } else { letter }).collect()
}

/// Writes `line` as a line of a comment to `text`.
fn comment(text: &mut String, line: &str) {
    text.push_str("# ");
    text.push_str(&plain(line));
    text.push('\n');
}
