//! Marks that are drawn on a panel: grain line, name, notches, folds, letters and ticks of seams.

use drape_input::{figure_in_decimals, xml_text};
use std::fmt::Write;

use super::grain_line::GrainLine;
use super::number::letters;
use super::text_anchor::text_anchor;
use crate::edge::{Edge, difference};
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::pattern::seam::Seam;

/// Length of notches and ticks, in mm.
const TICK: f64 = 5.0;

/// Marks of a panel. `on_sheet` maps its points, in m, to the sheet, in mm with y down.
pub(crate) struct PanelMarks<'a, F: Fn([f64; 2]) -> [f64; 2]> {
    pub(crate) pattern: &'a Pattern,
    pub(crate) panel: &'a Panel,
    pub(crate) on_sheet: &'a F,
}

/// Point on the outline with the direction inwards, on the sheet.
struct OutlinePoint {
    at: [f64; 2],
    inward: [f64; 2],
}

impl<F: Fn([f64; 2]) -> [f64; 2]> PanelMarks<'_, F> {
    /// Writes the marks to `svg`.
    pub(crate) fn write(&self, svg: &mut String) {
        self.grain_and_name(svg);
        for edge in self.panel.edges() {
            for notch in &edge.notches {
                self.tick("notch", &self.outline_point(edge, notch / edge.length()), svg);
            }
            self.label(edge, svg);
        }
        for fold in self.panel.folds() {
            let [a, b] = fold.ends.map(self.on_sheet);
            let _ = writeln!(
                svg,
                "<path class=\"fold\" stroke-dasharray=\"6 4\" d=\"M{}L{}\"/>",
                pair(a),
                pair(b)
            );
        }
        for (seam, side) in self.pattern.seams().iter().flat_map(|seam| [(seam, 0), (seam, 1)]) {
            self.seam(seam, side, svg);
        }
    }

    /// Draws the grain line through the middle of the panel, with the names of the panel and of its
    /// fabric beside it.
    fn grain_and_name(&self, svg: &mut String) {
        let polygon: Vec<[f64; 2]> =
            self.panel.outline().iter().flat_map(Edge::polyline).map(self.on_sheet).collect();
        let (sine, cosine) = self.panel.grain().sin_cos();
        let along = [-sine, -cosine];
        let GrainLine { middle, clearance, ends: [tail, tip] } = GrainLine::new(&polygon, along);
        let [a, b] = [1.0, -1.0].map(|s| {
            let back = [-3.0 * along[0] + s * 1.5 * along[1], -3.0 * along[1] - s * 1.5 * along[0]];
            [tip[0] + back[0], tip[1] + back[1]]
        });
        let _ = writeln!(
            svg,
            "<path class=\"grain\" d=\"M{}L{}\"/>\n<path class=\"arrow\" d=\"M{}L{}L{}\"/>",
            pair(tail),
            pair(tip),
            pair(a),
            pair(tip),
            pair(b)
        );

        let size = (0.25 * clearance).clamp(2.0, 8.0);
        let at = [middle[0] + 2.0, middle[1]];
        Label { text: self.panel.name(), at, size, anchor: "start" }.draw(svg);
        if let Some(fabric) = self.panel.fabric() {
            let at = [middle[0] + 2.0, middle[1] + 1.2 * size];
            Label { text: fabric, at, size: 0.8 * size, anchor: "start" }.draw(svg);
        }
    }

    /// Writes the name of `edge` inside its middle, with the letter of the seam that sews it.
    fn label(&self, edge: &Edge, svg: &mut String) {
        let mut seams = self.pattern.seams().iter();
        let number = seams.position(|seam| {
            seam.sides.iter().flatten().any(|&id| self.pattern.is_edge_of(id, self.panel, edge))
        });
        let text = match number {
            Some(number) => format!("{} · {}", letters(number), edge.name),
            None => edge.name.clone(),
        };

        let OutlinePoint { at, inward } = self.outline_point(edge, 0.5);
        let anchor = text_anchor(inward[0]);
        let size = if number.is_some() { 4.5 } else { 3.0 };
        let gap = TICK + 0.5 * size;
        let at = [at[0] + gap * inward[0], at[1] + gap * inward[1] + 0.35 * size];
        Label { text: &text, at, size, anchor }.draw(svg);
    }

    /// Draws the marks of `side` of `seam` on this panel: a dot at the first stitch, and ticks at
    /// the middle and where edges of the other side end.
    fn seam(&self, seam: &Seam, side: usize, svg: &mut String) {
        let runs_against = side == 1 && !seam.reversed;
        let total = self.pattern.side_length(&seam.sides[side]);
        let opposite_total = self.pattern.side_length(&seam.sides[1 - side]);

        // Fractions of the side at which ticks stand.
        let mut fractions = vec![0.5];
        let mut sum = 0.0;
        for &id in &seam.sides[1 - side] {
            sum += self.pattern.edge(id).length();
            fractions.push(sum / opposite_total);
        }

        // Length of the edges before an edge, in m.
        let mut before = 0.0;
        for (number, &id) in seam.sides[side].iter().enumerate() {
            let edge = self.pattern.edge(id);
            let length = edge.length();
            let is_here = self.pattern.panels()[id.panel].name() == self.panel.name();
            for &fraction in fractions.iter().filter(|_| is_here) {
                let along = (fraction * total - before) / length;
                if 0.01 < along && along < 0.99 {
                    let along = if runs_against { 1.0 - along } else { along };
                    self.tick("match", &self.outline_point(edge, along), svg);
                }
            }
            if is_here && number == 0 {
                let along = (4.0e-3 / length).min(0.2);
                let point =
                    self.outline_point(edge, if runs_against { 1.0 - along } else { along });
                let at = [0, 1].map(|k| point.at[k] + 2.5 * point.inward[k]);
                let _ = writeln!(
                    svg,
                    "<circle class=\"first\" cx=\"{}\" cy=\"{}\" r=\"0.8\" fill=\"#000000\"/>",
                    figure_in_decimals(at[0], 2),
                    figure_in_decimals(at[1], 2)
                );
            }
            before += length;
        }
    }

    /// Draws a line of the class `class` from `point` inwards.
    fn tick(&self, class: &str, point: &OutlinePoint, svg: &mut String) {
        let OutlinePoint { at, inward } = point;
        let end = [at[0] + TICK * inward[0], at[1] + TICK * inward[1]];
        let _ = writeln!(svg, "<path class=\"{class}\" d=\"M{}L{}\"/>", pair(*at), pair(end));
    }

    /// Returns the point at `fraction` of `edge`, with the direction inwards.
    fn outline_point(&self, edge: &Edge, fraction: f64) -> OutlinePoint {
        let [before, at, after] = [fraction - 1e-3, fraction, fraction + 1e-3]
            .map(|fraction| (self.on_sheet)(edge.at(fraction.clamp(0.0, 1.0))));
        let along = difference(after, before);
        let size = along[0].hypot(along[1]).max(f64::MIN_POSITIVE);
        // The outline runs anticlockwise with y up. Where y is down, inside is to its right.
        OutlinePoint { at, inward: [along[1] / size, -along[0] / size] }
    }
}

/// Text at a point of the sheet. Lengths are in mm.
struct Label<'a> {
    text: &'a str,
    at: [f64; 2],
    /// Size of letters.
    size: f64,
    /// Whether the text starts, ends or is centred at the point: `text-anchor` of SVG.
    anchor: &'static str,
}

impl Label<'_> {
    /// Writes the text to `svg`.
    fn draw(&self, svg: &mut String) {
        let Self { text, at: [x, y], size, anchor } = self;
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"#000000\" \
             stroke=\"none\">{}</text>",
            figure_in_decimals(*x, 2),
            figure_in_decimals(*y, 2),
            figure_in_decimals(*size, 2),
            xml_text(text)
        );
    }
}

/// Returns a point as it stands in path data.
fn pair([x, y]: [f64; 2]) -> String {
    format!("{} {}", figure_in_decimals(x, 4), figure_in_decimals(y, 4))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seams_beyond_the_alphabet_have_two_letters_and_then_three() {
        let names = [0, 25, 26, 27, 51, 53, 701, 702].map(letters);
        assert_eq!(names, ["A", "Z", "AA", "AB", "AZ", "BB", "ZZ", "AAA"]);
    }
}
