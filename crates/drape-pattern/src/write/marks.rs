//! Marks that are drawn on a panel: grain line, name, notches, folds, letters and ticks of seams.

use std::fmt::Write;

use super::number::decimal;
use super::xml::escape;
use crate::edge::{Edge, difference, distance};
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::pattern::seam::{EdgeId, Seam};

/// Length of notches and ticks, in mm.
const TICK: f64 = 5.0;

/// Panel with the map of its points, in m, to the sheet, in mm with y down.
pub(crate) struct Drawn<'a, F: Fn([f64; 2]) -> [f64; 2]> {
    pub(crate) pattern: &'a Pattern,
    pub(crate) panel: &'a Panel,
    pub(crate) on_sheet: &'a F,
}

/// Point on the outline with the direction inwards, on the sheet.
struct Rim {
    at: [f64; 2],
    inward: [f64; 2],
}

impl<F: Fn([f64; 2]) -> [f64; 2]> Drawn<'_, F> {
    /// Writes the marks.
    pub(crate) fn write(&self, svg: &mut String) {
        self.grain_and_name(svg);
        for edge in self.panel.edges() {
            for notch in &edge.notches {
                self.tick("notch", &self.rim(edge, notch / edge.length()), svg);
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

    /// Draws the grain line through the middle of the panel, and the name beside it.
    fn grain_and_name(&self, svg: &mut String) {
        let polygon: Vec<[f64; 2]> =
            self.panel.outline().iter().flat_map(Edge::polyline).map(self.on_sheet).collect();
        let (middle, clearance) = inner_point(&polygon);
        let (sine, cosine) = self.panel.grain().sin_cos();
        let along = [-sine, -cosine];
        let room = [-1.0, 1.0].map(|s| ray(&polygon, middle, along.map(|x| s * x)));
        let half = (0.8 * room[0].min(room[1])).min(120.0);
        let end = |s: f64| [middle[0] + s * half * along[0], middle[1] + s * half * along[1]];
        let (tail, tip) = (end(-1.0), end(1.0));
        let wing = |s: f64| {
            let back = [-3.0 * along[0] + s * 1.5 * along[1], -3.0 * along[1] - s * 1.5 * along[0]];
            [tip[0] + back[0], tip[1] + back[1]]
        };
        let (a, b) = (wing(1.0), wing(-1.0));
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
        text(
            svg,
            self.panel.name(),
            &Text { at: [middle[0] + 2.0, middle[1]], size, anchor: "start" },
        );
        if let Some(fabric) = self.panel.fabric() {
            let at = [middle[0] + 2.0, middle[1] + 1.2 * size];
            text(svg, fabric, &Text { at, size: 0.8 * size, anchor: "start" });
        }
    }

    /// Writes the name of an edge, with the letter of the seam that it is sewn in, inside its
    /// middle.
    fn label(&self, edge: &Edge, svg: &mut String) {
        let sewn = |id: &EdgeId| {
            self.pattern.panels()[id.panel].name() == self.panel.name()
                && self.pattern.edge(*id).name == edge.name
        };
        let seams = self.pattern.seams().iter();
        let letter =
            seams.map(|seam| seam.sides.iter().flatten().any(sewn)).position(|found| found);
        let words = match letter {
            Some(number) => format!("{} · {}", letters(number), edge.name),
            None => edge.name.clone(),
        };
        let Rim { at, inward } = self.rim(edge, 0.5);
        let anchor = match inward[0] {
            0.5.. => "start",
            ..-0.5 => "end",
            _ => "middle",
        };
        let size = if letter.is_some() { 4.5 } else { 3.0 };
        let off = TICK + 0.5 * size;
        let at = [at[0] + off * inward[0], at[1] + off * inward[1] + 0.35 * size];
        text(svg, &words, &Text { at, size, anchor });
    }

    /// Draws a dot at the first stitch of a side of a seam, and ticks at its middle and where edges
    /// of the other side end.
    fn seam(&self, seam: &Seam, side: usize, svg: &mut String) {
        let against = side == 1 && !seam.reversed;
        let lengths =
            |side: usize| seam.sides[side].iter().map(|&id| self.pattern.edge(id).length());
        let total: f64 = lengths(side).sum();
        let other: f64 = lengths(1 - side).sum();
        let mut met = vec![0.5];
        let mut sum = 0.0;
        for length in lengths(1 - side) {
            sum += length;
            met.push(sum / other);
        }
        let mut before = 0.0;
        for (number, &id) in seam.sides[side].iter().enumerate() {
            let edge = self.pattern.edge(id);
            let length = edge.length();
            let own = self.pattern.panels()[id.panel].name() == self.panel.name();
            for &fraction in met.iter().filter(|_| own) {
                let along = (fraction * total - before) / length;
                if 0.01 < along && along < 0.99 {
                    let along = if against { 1.0 - along } else { along };
                    self.tick("match", &self.rim(edge, along), svg);
                }
            }
            if own && number == 0 {
                let along = (4.0e-3 / length).min(0.2);
                let rim = self.rim(edge, if against { 1.0 - along } else { along });
                let at = [rim.at[0] + 2.5 * rim.inward[0], rim.at[1] + 2.5 * rim.inward[1]];
                let _ = writeln!(
                    svg,
                    "<circle class=\"first\" cx=\"{}\" cy=\"{}\" r=\"0.8\" fill=\"#000000\"/>",
                    decimal(at[0], 100.0),
                    decimal(at[1], 100.0)
                );
            }
            before += length;
        }
    }

    /// Draws a line from the outline inwards.
    fn tick(&self, class: &str, rim: &Rim, svg: &mut String) {
        let Rim { at, inward } = rim;
        let end = [at[0] + TICK * inward[0], at[1] + TICK * inward[1]];
        let _ = writeln!(svg, "<path class=\"{class}\" d=\"M{}L{}\"/>", pair(*at), pair(end));
    }

    /// Returns the point at a fraction of an edge, with the direction inwards.
    fn rim(&self, edge: &Edge, fraction: f64) -> Rim {
        let near = |f: f64| (self.on_sheet)(edge.at(f.clamp(0.0, 1.0)));
        let along = difference(near(fraction + 1e-3), near(fraction - 1e-3));
        let size = along[0].hypot(along[1]).max(f64::MIN_POSITIVE);
        // The outline runs anticlockwise: inside is to its left, which is its right where y is
        // down.
        Rim { at: near(fraction), inward: [along[1] / size, -along[0] / size] }
    }
}

/// Returns the letters of a seam: A to Z, AA, AB and so on.
fn letters(number: usize) -> String {
    let last = char::from(b'A' + (number % 26) as u8).to_string();
    if number < 26 { last } else { letters(number / 26 - 1) + &last }
}

/// Returns a point of a polygon far from its sides, and how far that is.
fn inner_point(polygon: &[[f64; 2]]) -> ([f64; 2], f64) {
    let range = |axis: usize| {
        let all = polygon.iter().map(|p| p[axis]);
        (all.clone().fold(f64::MAX, f64::min), all.fold(f64::MIN, f64::max))
    };
    let ((left, right), (top, bottom)) = (range(0), range(1));
    let steps = 24;
    let at = |k: i32| (f64::from(k) + 0.5) / f64::from(steps);
    let grid = (0..steps * steps)
        .map(|k| [left + at(k % steps) * (right - left), top + at(k / steps) * (bottom - top)]);
    let inside = grid.filter(|&p| crossings(polygon, p) % 2 == 1);
    let clear = inside.map(|p| (p, clearance(polygon, p)));
    let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
    clear.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((middle, 0.0))
}

/// Returns the sides of a polygon.
fn sides(polygon: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    polygon.iter().copied().zip(polygon.iter().copied().cycle().skip(1))
}

/// Returns the number of sides that a ray to the right crosses.
pub(crate) fn crossings(polygon: &[[f64; 2]], p: [f64; 2]) -> usize {
    let crosses = |(a, b): &([f64; 2], [f64; 2])| {
        (a[1] > p[1]) != (b[1] > p[1])
            && p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    sides(polygon).filter(crosses).count()
}

/// Returns the distance of a point from the nearest side of a polygon.
fn clearance(polygon: &[[f64; 2]], p: [f64; 2]) -> f64 {
    let of = |(a, b): ([f64; 2], [f64; 2])| {
        let (side, arm) = (difference(b, a), difference(p, a));
        let square = side[0] * side[0] + side[1] * side[1];
        let t =
            ((arm[0] * side[0] + arm[1] * side[1]) / square.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        distance(p, [a[0] + t * side[0], a[1] + t * side[1]])
    };
    sides(polygon).map(of).fold(f64::MAX, f64::min)
}

/// Returns the distance from a point in a direction to the first side of a polygon; 0 if none is
/// there.
fn ray(polygon: &[[f64; 2]], p: [f64; 2], along: [f64; 2]) -> f64 {
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let met = sides(polygon).filter_map(|(a, b)| {
        let (side, arm) = (difference(b, a), difference(a, p));
        let det = cross(along, side);
        let (t, s) = (cross(arm, side) / det, cross(arm, along) / det);
        (t > 0.0 && (0.0..=1.0).contains(&s)).then_some(t)
    });
    let first = met.fold(f64::MAX, f64::min);
    if first < f64::MAX { first } else { 0.0 }
}

/// Text at a point of the sheet.
struct Text {
    at: [f64; 2],
    size: f64,
    anchor: &'static str,
}

fn text(svg: &mut String, words: &str, place: &Text) {
    let Text { at: [x, y], size, anchor } = place;
    let _ = writeln!(
        svg,
        "<text x=\"{}\" y=\"{}\" font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"#000000\" \
         stroke=\"none\">{}</text>",
        decimal(*x, 100.0),
        decimal(*y, 100.0),
        decimal(*size, 100.0),
        escape(words)
    );
}

/// Returns a point as it stands in path data.
fn pair([x, y]: [f64; 2]) -> String {
    format!("{} {}", decimal(x, 1e4), decimal(y, 1e4))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangle with sides of 300, 400 and 500 mm; the circle in it has a radius of 100 mm.
    const TRIANGLE: [[f64; 2]; 3] = [[50.0, 20.0], [450.0, 20.0], [50.0, 320.0]];

    #[test]
    fn the_inner_point_is_near_the_centre_of_the_largest_circle_inside() {
        let (point, clear) = inner_point(&TRIANGLE);
        // The points that are tried are up to 17 mm apart.
        assert!(distance(point, [150.0, 120.0]) < 17.0, "{point:?}");
        assert!(clear > 85.0 && clear <= 100.0, "{clear}");
        let rectangle = [[50.0, 20.0], [450.0, 20.0], [450.0, 120.0], [50.0, 120.0]];
        let (point, clear) = inner_point(&rectangle);
        assert!((point[1] - 70.0).abs() < 5.0 && clear > 45.0 && clear <= 50.0, "{point:?}");
    }

    #[test]
    fn the_clearance_of_a_point_is_its_distance_from_the_nearest_side_or_corner() {
        for (point, expected) in [
            ([150.0, 120.0], 100.0),
            ([57.0, 120.0], 7.0),
            ([150.0, 23.0], 3.0),
            // 3x + 4y = 1200 from the right angle, at (180, 140) and at (240, 95).
            ([230.0, 160.0], 20.0),
            ([290.0, 115.0], 20.0),
            ([20.0, -20.0], 50.0),
        ] {
            let found = clearance(&TRIANGLE, point);
            assert!((found - expected).abs() < 1e-9, "{point:?}: {found}");
        }
    }

    #[test]
    fn seams_beyond_the_alphabet_have_two_letters_and_then_three() {
        let names = [0, 25, 26, 27, 51, 53, 701, 702].map(letters);
        assert_eq!(names, ["A", "Z", "AA", "AB", "AZ", "BB", "ZZ", "AAA"]);
    }
}
