//! Drawing of cut panels as SVG.

use drape_input::xml_text;
use std::collections::BTreeSet;
use std::fmt::Write;

use super::layout::Rows;
use super::text_anchor::text_anchor;
use crate::cut::{Cut, CutPattern, NodeId, SeamNodes};
use crate::edge::{cross, difference, distance, dot};
use crate::panel::{Fold, Panel};
use crate::pattern::Pattern;
use crate::polygon::range;

/// Approximate ratio of the width of the drawing to its height.
const SHAPE: f64 = 2.2;

/// Hue between the colours of successive seams, in degrees. It is the golden angle, so that few
/// colours are alike.
const HUE_STEP: f64 = 137.508;

/// Returns a drawing of the panels of `cut`, the cut of `pattern`, side by side, as SVG in mm.
///
/// Cells are grey, the rim is brown, the outline and the holes of darts are black. Both sides of a
/// seam have the same colour, with a dot at the first stitch and an arrowhead in the direction of
/// the seam. An arrow along the warp shows the grain, and small letters name the edges. Dashed
/// lines are folds, with their angles in degrees.
#[must_use]
pub fn figure(pattern: &Pattern, cut: &CutPattern) -> String {
    let layout = FigureLayout::new(cut);
    let [width, height] = layout.size.map(|x| x.ceil().max(1.0));
    let letter = layout.letter;
    let mut svg = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"{letter:.1}\" \
         fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>"
    );
    for (number, panel) in pattern.panels().iter().enumerate() {
        let drawing = PanelDrawing { layout: &layout, cut: &cut.panels[number], number };
        drawing.mesh(&mut svg);
        drawing.seams(cut, &mut svg);
        drawing.folds(panel, &mut svg);
        drawing.names(panel, &mut svg);
    }
    svg.push_str("</svg>\n");
    svg
}

/// Layout of the panels in the drawing. Lengths are in mm.
struct FigureLayout {
    size: [f64; 2],
    /// Position of the origin of each panel.
    origins: Vec<[f64; 2]>,
    /// Size of letters.
    letter: f64,
}

/// Returns the low and the high corner of the bounding box of `cut`, in mm.
fn extent(cut: &Cut) -> [[f64; 2]; 2] {
    let [[left, right], [bottom, top]] =
        [0, 1].map(|axis| range(cut.positions.iter().map(|p| 1000.0 * p[axis])));
    [[left, bottom], [right, top]]
}

impl FigureLayout {
    /// Returns the layout of the panels of `cut` in rows.
    fn new(cut: &CutPattern) -> Self {
        let extents: Vec<_> = cut.panels.iter().map(extent).collect();
        let area: f64 =
            extents.iter().map(|[low, high]| difference(*high, *low)).map(|[x, y]| x * y).sum();
        let row = (SHAPE * area).sqrt();
        let letter = 0.012 * row;
        let gap = 3.0 * letter;
        let Rows { size, origins } = Rows::new(&extents, gap, 1.15 * row);
        Self { size, origins, letter }
    }
}

/// Text at a point of the drawing.
struct Label<'a> {
    text: &'a str,
    /// Whether the text starts, ends or is centred at the point: `text-anchor` of SVG.
    anchor: &'static str,
    at: [f64; 2],
    /// Size of letters, in mm.
    size: f64,
}

/// Point on a line of the drawing, with a direction along the line.
struct LinePoint {
    at: [f64; 2],
    along: [f64; 2],
}

/// Drawing of one panel.
struct PanelDrawing<'a> {
    layout: &'a FigureLayout,
    cut: &'a Cut,
    /// Number of the panel.
    number: usize,
}

impl PanelDrawing<'_> {
    /// Returns a point of the panel, given in m, in the drawing.
    fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, top] = self.layout.origins[self.number];
        [left + 1000.0 * x, top - 1000.0 * y]
    }

    /// Returns the point of `node` in the drawing.
    fn node(&self, node: u32) -> [f64; 2] {
        self.point(self.cut.position(node))
    }

    /// Adds a line between two nodes to `path`.
    fn line(&self, [from, to]: [u32; 2], path: &mut String) {
        let (a, b) = (self.node(from), self.node(to));
        let _ = write!(path, "M{:.1} {:.1}l{:.1} {:.1}", a[0], a[1], b[0] - a[0], b[1] - a[1]);
    }

    /// Draws the outline, cells and rim.
    fn mesh(&self, svg: &mut String) {
        let width = 0.06 * self.layout.letter;
        let lines = self.cut.lines().map(|line| polygon(line.iter().map(|&n| self.node(n))));
        let outline: String = lines.collect();
        let cells = self.cells();
        let rim = self.rim();
        let _ = writeln!(
            svg,
            "<path d=\"{outline}\" fill=\"#faf7f2\" fill-rule=\"evenodd\" stroke=\"#222222\" stroke-width=\"{:.2}\"/>\n\
             <path d=\"{cells}\" stroke=\"#9aa5b1\" stroke-width=\"{width:.2}\"/>\n\
             <path d=\"{rim}\" stroke=\"#c9a27a\" stroke-width=\"{width:.2}\"/>",
            2.5 * width,
        );
    }

    /// Returns the sides of the cells as a path. Sides that continue each other are one line.
    fn cells(&self) -> String {
        // Each side by its axis, its column or row, and its position along it, with both ends.
        let mut sides = BTreeSet::new();
        for &[a, b, c, d] in &self.cut.quads {
            for [from, to] in [[a, b], [d, c], [a, d], [b, c]] {
                let [[column, row], [to_column, _]] =
                    [from, to].map(|node| self.cut.lattice[node as usize].unwrap_or_default());
                let is_upright = column == to_column;
                let line = if is_upright { (0, column, row) } else { (1, row, column) };
                sides.insert((line, from, to));
            }
        }

        let mut path = String::new();
        let mut run: Option<(u32, u32, u32, [u32; 2])> = None;
        for ((axis, across, along), from, to) in sides {
            run = Some(match run {
                Some((a, b, next, [start, _])) if (a, b, next) == (axis, across, along) => {
                    (axis, across, along + 1, [start, to])
                }
                finished => {
                    if let Some((.., ends)) = finished {
                        self.line(ends, &mut path);
                    }
                    (axis, across, along + 1, [from, to])
                }
            });
        }
        if let Some((.., ends)) = run {
            self.line(ends, &mut path);
        }
        path
    }

    /// Returns the sides between triangles as a path.
    fn rim(&self) -> String {
        let mut path = String::new();
        let triangles = self.cut.triangles.iter();
        let sides: BTreeSet<[u32; 2]> =
            triangles.flat_map(|t| (0..3).map(|k| [t[k], t[(k + 1) % 3]])).collect();
        for &[a, b] in sides.iter().filter(|[a, b]| a < b && sides.contains(&[*b, *a])) {
            self.line([a, b], &mut path);
        }
        path
    }

    /// Draws the sides of seams that lie in this panel.
    /// Draws the parts of the seams of `cut` that lie in this panel.
    fn seams(&self, cut: &CutPattern, svg: &mut String) {
        let mut sides: BTreeSet<[u32; 2]> = BTreeSet::new();
        for line in self.cut.lines() {
            let next = line.iter().cycle().skip(1);
            sides.extend(line.iter().zip(next).flat_map(|(&a, &b)| [[a, b], [b, a]]));
        }
        for (number, seam) in cut.seams.iter().enumerate() {
            let (mut path, mut marks) = (String::new(), String::new());
            for side in 0..2 {
                self.direction(seam, side, &mut marks);
                let here = seam.side(side).filter(|id| id.panel == self.number);
                let mut last = None;
                for node in here.map(|id| id.node) {
                    let [x, y] = self.node(node);
                    // A chain may continue elsewhere, as at the mouth of a dart.
                    let is_next = last.is_some_and(|last| sides.contains(&[last, node]));
                    let _ = write!(path, "{}{x:.1} {y:.1}", if is_next { 'L' } else { 'M' });
                    last = Some(node);
                }
            }
            if !path.is_empty() {
                let [red, green, blue] = seam_colour(number);
                let colour = format!("#{red:02x}{green:02x}{blue:02x}");
                let width = 0.35 * self.layout.letter;
                let _ = writeln!(
                    svg,
                    "<path d=\"{path}\" stroke=\"{colour}\" stroke-width=\"{width:.2}\"/>\n\
                     <path d=\"{marks}\" fill=\"{colour}\"/>"
                );
            }
        }
    }

    /// Adds the marks of `side` of `seam` to the path `marks`: a dot at its first stitch, if that
    /// is in this panel, and an arrowhead in the middle of the part in this panel, in the direction
    /// of the seam.
    fn direction(&self, seam: &SeamNodes, side: usize, marks: &mut String) {
        let letter = self.layout.letter;
        let all: Vec<NodeId> = seam.side(side).collect();
        if let Some(first) = all.first().filter(|id| id.panel == self.number) {
            let [x, y] = self.node(first.node);
            let radius = 0.5 * letter;
            let _ = write!(
                marks,
                "M{:.1} {y:.1}a{radius:.1} {radius:.1} 0 1 0 {:.1} 0a{radius:.1} {radius:.1} 0 1 0 {:.1} 0Z",
                x - radius,
                2.0 * radius,
                -2.0 * radius
            );
        }

        let here: Vec<u32> =
            all.iter().filter(|id| id.panel == self.number).map(|id| id.node).collect();
        let half = here.len() / 2;
        if half == 0 {
            return;
        }
        let (from, to) = (self.node(here[half - 1]), self.node(here[half]));
        let along = difference(to, from);
        let length = along[0].hypot(along[1]);
        if length == 0.0 {
            return;
        }
        let [x, y] = along.map(|part| letter * part / length);
        let _ = write!(
            marks,
            "M{:.1} {:.1}L{:.1} {:.1}L{:.1} {:.1}Z",
            to[0],
            to[1],
            to[0] - x + 0.5 * y,
            to[1] - y - 0.5 * x,
            to[0] - x - 0.5 * y,
            to[1] - y + 0.5 * x,
        );
    }

    /// Draws the parts of fold lines inside the outline, each line with its angle beside its
    /// longest part.
    fn folds(&self, panel: &Panel, svg: &mut String) {
        let lines = self.cut.lines();
        let polygons: Vec<Vec<[f64; 2]>> =
            lines.map(|line| line.iter().map(|&node| self.cut.position(node)).collect()).collect();
        let letter = self.layout.letter;
        for Fold { ends: [from, to], angle } in panel.folds() {
            let pieces = inside(&polygons, [*from, *to]);
            let mut path = String::new();
            for piece in &pieces {
                let [a, b] = piece.map(|fraction| self.point(interpolate(*from, *to, fraction)));
                let _ = write!(path, "M{:.1} {:.1}L{:.1} {:.1}", a[0], a[1], b[0], b[1]);
            }
            let longest = pieces.iter().max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
            let Some([start, end]) = longest else { continue };
            let _ = writeln!(
                svg,
                "<path d=\"{path}\" stroke=\"#222222\" stroke-width=\"{:.2}\" \
                 stroke-dasharray=\"{:.1} {:.1}\"/>",
                0.15 * letter,
                0.9 * letter,
                0.6 * letter,
            );

            // The angle stands at a third of the part: the panel's name may be in the middle.
            let at = self.point(interpolate(*from, *to, start + (end - start) / 3.0));
            let angle = format!("{}°", (10.0 * angle.to_degrees()).round() / 10.0);
            let along = difference(self.point(*to), self.point(*from));
            self.label_beside(&angle, &LinePoint { at, along }, svg);
        }
    }

    /// Draws the grain, the name of `panel` and the names of its edges.
    fn names(&self, panel: &Panel, svg: &mut String) {
        let letter = self.layout.letter;
        let middle = self.middle();
        let (sine, cosine) = panel.grain().sin_cos();

        // The arrow along the warp, a third of the way through the panel.
        let [low, high] = extent(self.cut);
        let [width, height] = difference(high, low);
        let through = (width / sine.abs()).min(height / cosine.abs());
        let half = (through / 6.0).min(4.0 * letter);
        let along = [-sine, -cosine];
        let tip = [middle[0] + half * along[0], middle[1] + half * along[1]];
        let back = [0.7 * letter * along[0], 0.7 * letter * along[1]];
        let [[a, b], [c, d]] = [1.0, -1.0].map(|side| {
            [tip[0] - back[0] - side * 0.5 * back[1], tip[1] - back[1] + side * 0.5 * back[0]]
        });
        let _ = writeln!(
            svg,
            "<path d=\"M{:.1} {:.1}L{:.1} {:.1}M{a:.1} {b:.1}L{:.1} {:.1}L{c:.1} {d:.1}\" \
             stroke=\"#222222\" stroke-width=\"{:.2}\"/>",
            middle[0] - half * along[0],
            middle[1] - half * along[1],
            tip[0],
            tip[1],
            tip[0],
            tip[1],
            0.15 * letter,
        );

        let at = [middle[0], middle[1] + half * along[1].abs() + 1.4 * letter];
        let size = 1.2 * letter;
        Label { text: panel.name(), anchor: "middle", at, size }.draw(svg);
        for (edge, nodes) in panel.edges().zip(&self.cut.edges) {
            // Beside the middle of the edge, inside.
            let half = nodes.len() / 2;
            let (from, to) = (self.node(nodes[half.saturating_sub(1)]), self.node(nodes[half]));
            let at = [0, 1].map(|k| 0.5 * (from[k] + to[k]));
            let along = difference(to, from);
            self.label_beside(&edge.name, &LinePoint { at, along }, svg);
        }
    }

    /// Draws the small text `text` beside a line: inside the panel, where the line is its outline.
    fn label_beside(&self, text: &str, line: &LinePoint, svg: &mut String) {
        let LinePoint { at, along: [x, y] } = *line;
        let letter = self.layout.letter;
        let length = x.hypot(y).max(f64::MIN_POSITIVE);
        let inward = [y / length, -x / length];
        let anchor = text_anchor(inward[0]);
        let at = [0, 1].map(|k| at[k] + 0.9 * letter * inward[k]);
        Label { text, anchor, at, size: 0.75 * letter }.draw(svg);
    }

    /// Returns the centre of the cell that is farthest from the outline; without cells, the centre
    /// of the bounding box.
    fn middle(&self) -> [f64; 2] {
        let outline: Vec<[f64; 2]> = self.cut.lines().flatten().map(|&n| self.node(n)).collect();
        let step = (self.cut.quads.len() / 400).max(1);
        let centres = self.cut.quads.iter().step_by(step).map(|quad| {
            let (a, c) = (self.node(quad[0]), self.node(quad[2]));
            [0.5 * (a[0] + c[0]), 0.5 * (a[1] + c[1])]
        });
        let clear = centres.map(|centre| {
            let distances = outline.iter().map(|corner| distance(centre, *corner));
            (centre, distances.fold(f64::MAX, f64::min))
        });
        match clear.max_by(|a, b| a.1.total_cmp(&b.1)) {
            Some((centre, _)) => centre,
            None => {
                let [low, high] = extent(self.cut);
                self.point([0, 1].map(|k| 0.0005 * (low[k] + high[k])))
            }
        }
    }
}

/// Returns the point at `fraction` of the line from `from` to `to`.
fn interpolate(from: [f64; 2], to: [f64; 2], fraction: f64) -> [f64; 2] {
    let line = difference(to, from);
    [from[0] + fraction * line[0], from[1] + fraction * line[1]]
}

/// Returns the parts of the line from `from` to `to` that lie inside `polygons`, as fractions of
/// its length. The first polygon is the outline, the others are holes.
fn inside(polygons: &[Vec<[f64; 2]>], [from, to]: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
    let line = difference(to, from);
    let sides = polygons
        .iter()
        .flat_map(|polygon| polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1)));
    // A corner belongs to one of its two sides, so that the line is alternately outside and inside.
    let crossed = sides.filter_map(|(a, b)| {
        let [arm_a, arm_b] = [a, b].map(|corner| difference(corner, from));
        let (here, there) = (cross(line, arm_a), cross(line, arm_b));
        let fraction = here / (here - there);
        let [along_a, along_b] =
            [arm_a, arm_b].map(|arm| dot(line, arm) / (line[0].powi(2) + line[1].powi(2)));
        ((here > 0.0) != (there > 0.0)).then_some(along_a + fraction * (along_b - along_a))
    });
    let mut fractions: Vec<f64> = crossed.collect();
    fractions.sort_by(f64::total_cmp);
    let pieces = fractions.chunks_exact(2).map(|piece| [piece[0].max(0.0), piece[1].min(1.0)]);
    pieces.filter(|[start, end]| end > start).collect()
}

/// Returns a closed path through `points`.
fn polygon(points: impl Iterator<Item = [f64; 2]>) -> String {
    let mut path = String::new();
    for (k, [x, y]) in points.enumerate() {
        let _ = write!(path, "{}{x:.1} {y:.1}", if k == 0 { 'M' } else { 'L' });
    }
    path.push('Z');
    path
}

impl Label<'_> {
    /// Draws the text on a white halo.
    fn draw(&self, svg: &mut String) {
        let Self { text, anchor, at: [x, y], size } = self;
        let clean = xml_text(text);
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{:.1}\" font-size=\"{size:.1}\" text-anchor=\"{anchor}\" \
             fill=\"#222222\" stroke=\"#ffffff\" stroke-width=\"{:.2}\" \
             paint-order=\"stroke\">{clean}</text>",
            y + 0.35 * size,
            0.25 * size,
        );
    }
}

/// Returns the colour of the seam with the number `seam` in a drawing, as red, green and blue.
#[must_use]
pub fn seam_colour(seam: usize) -> [u8; 3] {
    // Hue in sixths of the circle; full saturation, and every other seam darker.
    let hue = (seam as f64 * HUE_STEP / 60.0).rem_euclid(6.0);
    let value = if seam.is_multiple_of(2) { 0.9 } else { 0.7 };
    [0.0, 4.0, 2.0].map(|shift| {
        let part = ((hue + shift).rem_euclid(6.0) - 3.0).abs() - 1.0;
        (255.0 * value * part.clamp(0.0, 1.0)).round() as u8
    })
}
