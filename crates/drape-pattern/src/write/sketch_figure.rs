//! Drawing of a sketch as SVG: the lines of a pattern file, with its faults in red.

use std::fmt::Write;

use drape_input::{Diagnostic, Subject, xml_text};

use super::layout::Rows;
use super::text_anchor::text_anchor;
use crate::edge::{Edge, difference};
use crate::sketch::{Sketch, SketchFault, SketchPanel};

/// Approximate ratio of the width of the drawing to its height.
const SHAPE: f64 = 2.2;

/// Colour of faults.
const RED: &str = "#d11a1a";

/// Colour of lines without a fault.
const BLACK: &str = "#222222";

/// Largest number of mistakes that are written below the panels.
const MOST_MISTAKES: usize = 8;

/// Largest number of letters of a mistake.
const MOST_LETTERS: usize = 160;

/// Drawing of one sketch. Lengths are in mm.
struct SketchDrawing<'a> {
    sketch: &'a Sketch,
    faults: &'a [SketchFault],
    /// Size of letters.
    letter: f64,
    svg: String,
}

/// Panel at its position in the drawing.
struct PlacedPanel<'a> {
    panel: &'a SketchPanel,
    origin: [f64; 2],
}

impl PlacedPanel<'_> {
    /// Returns a point of the panel, given in m, in the drawing.
    fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + 1000.0 * x, self.origin[1] - 1000.0 * y]
    }

    /// Returns `edge` as path data.
    fn path(&self, edge: &Edge) -> String {
        let mut path = String::new();
        for (k, p) in edge.polyline().into_iter().chain([edge.end]).enumerate() {
            let [x, y] = self.point(p);
            let _ = write!(path, "{}{x:.1} {y:.1}", if k == 0 { 'M' } else { 'L' });
        }
        path
    }
}

impl Sketch {
    /// Returns a drawing of the panels, side by side, as SVG in mm. Red are the `faults`, with
    /// edges, panels, seams and points, and also gaps between edges and edges that cross. The first
    /// `mistakes` are written below.
    #[must_use]
    pub fn figure(&self, faults: &[SketchFault], mistakes: &[Diagnostic]) -> String {
        let extents: Vec<[[f64; 2]; 2]> = self.panels.iter().map(extent).collect();
        let area: f64 =
            extents.iter().map(|[low, high]| difference(*high, *low)).map(|[x, y]| x * y).sum();
        let row = (SHAPE * area).sqrt().max(100.0);
        let letter = 0.014 * row;
        let Rows { size, origins } = Rows::new(&extents, 3.0 * letter, 1.15 * row);

        // The mistakes take a line each, below the panels.
        let lines = mistakes.len().min(MOST_MISTAKES);
        let width = size[0].max(0.6 * letter * MOST_LETTERS as f64);
        let height = size[1] + 1.6 * letter * (lines as f64 + 1.0);
        let [width, height] = [width, height].map(|x| x.ceil().max(1.0));
        let mut drawing = SketchDrawing { sketch: self, faults, letter, svg: String::new() };
        // Writing to a string cannot fail.
        let _ = writeln!(
            drawing.svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"{letter:.1}\" \
             fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>"
        );
        for (panel, origin) in self.panels.iter().zip(origins) {
            drawing.panel(&PlacedPanel { panel, origin });
        }
        for (line, mistake) in mistakes.iter().take(MOST_MISTAKES).enumerate() {
            let at = [letter, size[1] + 1.6 * letter * (line as f64 + 1.0)];
            let mut text: String = mistake.message.chars().take(MOST_LETTERS).collect();
            if text.len() < mistake.message.len() {
                text.push('…');
            }
            drawing.text(&text, at, TextStyle { colour: RED, anchor: "start" });
        }
        drawing.svg + "</svg>\n"
    }
}

/// Colour of a text, and whether it starts, ends or is centred at its point (`text-anchor` of SVG).
struct TextStyle {
    colour: &'static str,
    anchor: &'static str,
}

impl SketchDrawing<'_> {
    /// Draws a panel.
    fn panel(&mut self, placed: &PlacedPanel<'_>) {
        let PlacedPanel { panel, .. } = placed;
        let (crossed, crossings) = panel.crossings();

        // Edges with a fault are one path, which is drawn over the other edges.
        let mut red = String::new();
        let all = panel.outline.iter().chain(panel.holes.iter().flatten());
        for (number, edge) in all.enumerate() {
            let path = placed.path(edge);
            let is_wrong =
                self.sketch.is_wrong(panel, edge, self.faults) || crossed.contains(&number);
            if is_wrong {
                red.push_str(&path);
            } else {
                let width = 0.12 * self.letter;
                let _ = writeln!(
                    self.svg,
                    "<path d=\"{path}\" stroke=\"{BLACK}\" stroke-width=\"{width:.2}\"/>"
                );
            }
            self.edge_name(placed, edge, if is_wrong { RED } else { BLACK });
        }

        let width = 0.35 * self.letter;
        if !red.is_empty() {
            let _ = writeln!(
                self.svg,
                "<path class=\"wrong\" d=\"{red}\" stroke=\"{RED}\" stroke-width=\"{width:.2}\"/>"
            );
        }
        for gap in panel.gaps() {
            let [a, b] = gap.map(|p| placed.point(p));
            let _ = writeln!(
                self.svg,
                "<path class=\"gap\" d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"{RED}\" stroke-width=\"{width:.2}\" \
                 stroke-dasharray=\"{:.1} {:.1}\"/>",
                a[0],
                a[1],
                b[0],
                b[1],
                0.8 * self.letter,
                0.6 * self.letter
            );
            self.circle([0, 1].map(|k| 0.5 * (a[k] + b[k])));
        }
        self.fault_points(placed, crossings);
        let middle = self.middle(placed);
        self.text(&panel.name, middle, TextStyle { colour: BLACK, anchor: "middle" });
    }

    /// Draws circles about the points of faults and about `crossings`, which are in m.
    fn fault_points(&mut self, placed: &PlacedPanel<'_>, crossings: Vec<[f64; 2]>) {
        let faults = self.faults.iter().filter(|fault| match &fault.subject {
            Subject::Panel(name) | Subject::Edge { panel: name, .. } => *name == placed.panel.name,
            _ => false,
        });
        let points: Vec<[f64; 2]> = faults.filter_map(|fault| fault.at).chain(crossings).collect();
        for at in points.into_iter().filter(|at| at.iter().all(|x| x.is_finite())) {
            self.circle(placed.point(at));
        }
    }

    /// Draws a circle about a point of the drawing.
    fn circle(&mut self, [x, y]: [f64; 2]) {
        let _ = writeln!(
            self.svg,
            "<circle class=\"place\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\" stroke=\"{RED}\" \
             stroke-width=\"{:.2}\"/>",
            1.2 * self.letter,
            0.25 * self.letter
        );
    }

    /// Writes the name of `edge` beside its middle, inside.
    fn edge_name(&mut self, placed: &PlacedPanel<'_>, edge: &Edge, colour: &'static str) {
        let [from, to] = [0.49, 0.51].map(|fraction| placed.point(edge.at(fraction)));
        let [x, y] = difference(to, from);
        let length = x.hypot(y).max(f64::MIN_POSITIVE);
        let inward = [y / length, -x / length];
        let anchor = text_anchor(inward[0]);
        let at = [0, 1].map(|k| 0.5 * (from[k] + to[k]) + 0.9 * self.letter * inward[k]);
        self.text(&edge.name, at, TextStyle { colour, anchor });
    }

    /// Returns the middle of the bounding box of a panel in the drawing.
    fn middle(&self, placed: &PlacedPanel<'_>) -> [f64; 2] {
        let [low, high] = extent(placed.panel);
        placed.point([0, 1].map(|k| 0.0005 * (low[k] + high[k])))
    }

    /// Writes `text` at a point of the drawing, on a white halo.
    fn text(&mut self, text: &str, [x, y]: [f64; 2], style: TextStyle) {
        let TextStyle { colour, anchor } = style;
        let letter = self.letter;
        let _ = writeln!(
            self.svg,
            "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" fill=\"{colour}\" stroke=\"#ffffff\" \
             stroke-width=\"{:.2}\" paint-order=\"stroke\">{}</text>",
            y + 0.35 * letter,
            0.25 * letter,
            xml_text(text)
        );
    }
}

/// Returns the low and the high corner of the bounding box of `panel`, in mm.
fn extent(panel: &SketchPanel) -> [[f64; 2]; 2] {
    let edges = panel.outline.iter().chain(panel.holes.iter().flatten());
    let points = edges.flat_map(|edge| edge.polyline().into_iter().chain([edge.end]));
    points.fold([[f64::MAX; 2], [f64::MIN; 2]], |[low, high], p| {
        let p = p.map(|x| 1e3 * x);
        [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
    })
}
