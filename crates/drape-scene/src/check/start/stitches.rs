//! Stitches that start across a body or another panel: their straight ways, along which closing
//! springs draw them, lead through it.
//!
//! Cloth then slides round the body or the panel, or is caught behind it.

use std::collections::BTreeSet;
use std::ops::Range;

use drape_collide::segment_meets_triangle;
use drape_input::{Advice, Remedy};

use crate::scene::Scene;
use crate::scene::panel::Panel;
use crate::scene::seam::Seam;

use crate::wearing::solids::Solids;

/// Least depth in a body at which a stitch counts as leading through it, in m. Cloth slides round
/// less.
const DEPTH: f64 = 0.03;

/// Fraction of the stitches of a seam that lead through a body or a panel, above which the seam is
/// reported.
const PART: f64 = 0.2;

/// Least number of stitches through a panel that is reported. An edge of one or two spacings, which
/// is sewn at its ends, follows its neighbours.
const FEWEST: usize = 3;

/// Number of points of a stitch that are looked at.
const POINTS: u32 = 9;

/// Number of triangles of a panel in one box.
const BLOCK: usize = 8;

/// Part of a stitch at either end that may touch a panel beside it, as the pieces of a sleeve do.
const END: f64 = 0.05;

/// Returns notes on the seams of a scene whose stitches lead through a body.
pub(crate) fn stitches_through_bodies(scene: &Scene) -> Vec<String> {
    let solids = Solids::new(scene.bodies.iter().map(|moving| &moving.body));
    let (Some(solids), Some(sewing)) = (solids, &scene.sewing) else { return Vec::new() };
    sewing.seams.iter().filter_map(|seam| through(scene, &solids, seam)).collect()
}

/// Returns a note on a seam of which many stitches lead through a body.
fn through(scene: &Scene, solids: &Solids<'_>, seam: &Seam) -> Option<String> {
    let (mut count, mut deepest, mut at) = (0, 0.0, [0.0; 3]);
    for [one, other] in &seam.pairs.pairs {
        let [from, to] = [*one, *other].map(|particle| place(scene, particle));
        let points = (1..POINTS).map(|k| {
            let part = f64::from(k) / f64::from(POINTS);
            [0, 1, 2].map(|axis| from[axis] + part * (to[axis] - from[axis]))
        });
        let depths = points.map(|point| (-solids.distance(point), point));
        let Some((depth, point)) = depths.max_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
        count += usize::from(depth > DEPTH);
        if depth > deepest {
            (deepest, at) = (depth, point);
        }
    }
    let [x, y, z] = at;
    let all = seam.pairs.pairs.len();
    (count as f64 > PART * all as f64).then(|| {
        format!(
            "seam \"{}\": {count} of {all} stitches lead through a body at the start, {:.0} mm deep near \
             ({x:.3}, {y:.3}, {z:.3}) m; place its panels round the body (wrap), or on the same side of it",
            seam.name,
            1e3 * deepest
        )
    })
}

/// Returns notes on the seams of a scene whose stitches lead through a panel that they do not sew.
pub(crate) fn stitches_through_panels(scene: &Scene) -> Vec<Advice> {
    let Some(sewing) = &scene.sewing else { return Vec::new() };
    let sheets: Vec<Sheet<'_>> =
        scene.panels.iter().map(|panel| Sheet::new(scene, panel)).collect();
    sewing.seams.iter().filter_map(|seam| through_panel(scene, &sheets, seam)).collect()
}

/// Panel at the start.
struct Sheet<'a> {
    name: &'a str,
    particles: Range<usize>,
    /// Corners of its triangles, in m.
    triangles: Vec<[[f64; 3]; 3]>,
    /// Boxes around its triangles: around each [`BLOCK`] of them, then around each two boxes of the
    /// level before, and at last around all. Triangles that follow each other lie together.
    boxes: Vec<Vec<Extent>>,
}

/// Box along the axes, in m.
#[derive(Debug, Clone, Copy)]
struct Extent {
    low: [f64; 3],
    high: [f64; 3],
}

impl Extent {
    /// Returns the box around `points`.
    fn around<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> Self {
        let nothing = Self { low: [f64::MAX; 3], high: [f64::MIN; 3] };
        points.fold(nothing, |Self { low, high }, point| Self {
            low: [0, 1, 2].map(|k| low[k].min(point[k])),
            high: [0, 1, 2].map(|k| high[k].max(point[k])),
        })
    }

    /// Returns whether this box and `other` have a point in common.
    fn meets(&self, other: &Self) -> bool {
        (0..3).all(|k| self.low[k] <= other.high[k] && self.high[k] >= other.low[k])
    }
}

impl<'a> Sheet<'a> {
    fn new(scene: &Scene, panel: &'a Panel) -> Self {
        let triangles = scene.triangles_of(panel).iter();
        let triangles: Vec<_> =
            triangles.map(|corners| corners.map(|corner| place(scene, corner))).collect();
        let boxes = boxes(&triangles);
        Self { name: &panel.name, particles: panel.particles(), triangles, boxes }
    }

    /// Returns the box around the whole panel, or `None` if it has no triangles.
    fn extent(&self) -> Option<&Extent> {
        self.boxes.last()?.first()
    }

    /// Returns whether a straight line between two points leads through the panel.
    fn is_crossed(&self, ends: [[f64; 3]; 2]) -> bool {
        let line = Extent::around(ends.iter());
        // Boxes to look into, as their level and their number there.
        let mut waiting = vec![(self.boxes.len() - 1, 0)];
        while let Some((level, number)) = waiting.pop() {
            let extent = self.boxes[level].get(number);
            if !extent.is_some_and(|extent| extent.meets(&line)) {
                continue;
            }
            if level > 0 {
                waiting.extend([(level - 1, 2 * number), (level - 1, 2 * number + 1)]);
                continue;
            }
            let block = self.triangles.chunks(BLOCK).nth(number).unwrap_or_default();
            if block.iter().any(|corners| segment_meets_triangle(ends, *corners)) {
                return true;
            }
        }
        false
    }
}

/// Returns the boxes of [`Sheet::boxes`] around `triangles`.
fn boxes(triangles: &[[[f64; 3]; 3]]) -> Vec<Vec<Extent>> {
    let blocks = triangles.chunks(BLOCK).map(|block| Extent::around(block.iter().flatten()));
    let mut boxes: Vec<Vec<Extent>> = vec![blocks.collect()];
    while let Some(level) = boxes.last().filter(|level| level.len() > 1) {
        let around = |two: &[Extent]| {
            Extent::around(two.iter().flat_map(|extent| [&extent.low, &extent.high]))
        };
        boxes.push(level.chunks(2).map(around).collect());
    }
    boxes
}

/// Returns the place of a particle at the start, in m.
fn place(scene: &Scene, particle: u32) -> [f64; 3] {
    [0, 1, 2].map(|axis| scene.start.positions[3 * particle as usize + axis])
}

/// Returns a note on a seam of which many stitches lead through a panel.
fn through_panel(scene: &Scene, sheets: &[Sheet<'_>], seam: &Seam) -> Option<Advice> {
    let all = &seam.pairs.pairs;
    let ends: Vec<[f64; 3]> = all.iter().flatten().map(|&end| place(scene, end)).collect();
    let around = Extent::around(ends.iter());
    let sewn: BTreeSet<usize> = all
        .iter()
        .flatten()
        .map(|&end| sheets.partition_point(|sheet| sheet.particles.end <= end as usize))
        .collect();

    let near = sheets.iter().enumerate().filter(|(number, sheet)| {
        !sewn.contains(number) && sheet.extent().is_some_and(|extent| extent.meets(&around))
    });
    let crossed = near.map(|(_, sheet)| {
        let stitches = all.iter().map(|pair| pair.map(|particle| place(scene, particle)));
        let shortened = stitches.map(|[from, to]| {
            [END, 1.0 - END].map(|part| [0, 1, 2].map(|k| from[k] + part * (to[k] - from[k])))
        });
        let crossing: Vec<[[f64; 3]; 2]> =
            shortened.filter(|stitch| sheet.is_crossed(*stitch)).collect();
        (sheet, crossing)
    });
    let (sheet, crossing) = crossed.max_by_key(|(_, crossing)| crossing.len())?;
    if crossing.len() < FEWEST || crossing.len() as f64 <= PART * all.len() as f64 {
        return None;
    }
    let [from, to] = crossing[crossing.len() / 2];
    let [x, y, z] = [0, 1, 2].map(|k| 0.5 * (from[k] + to[k]));
    let note = format!(
        "seam \"{}\": {} of {} stitches lead through the panel \"{}\" at the start, near ({x:.3}, {y:.3}, {z:.3}) m; \
         move or turn panels so that nothing is between its sides",
        seam.name,
        crossing.len(),
        all.len(),
        sheet.name,
    );
    Some(Advice::from(note).with(Remedy::ShowStart { scene: scene.source.file.clone() }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_meets_a_sheet_where_it_meets_one_of_its_triangles() {
        // A wavy strip of 2 × 150 triangles, a number that fills no level of boxes.
        let point = |column: usize, row: usize| {
            let x = 0.01 * column as f64;
            [x, 0.02 * row as f64, 0.02 * (3.0 * x).sin()]
        };
        let cell = |k: usize| {
            let [a, b, c, d] = [point(k, 0), point(k + 1, 0), point(k + 1, 1), point(k, 1)];
            [[a, b, c], [a, c, d]]
        };
        let triangles: Vec<[[f64; 3]; 3]> = (0..150).flat_map(cell).collect();
        let sheet = Sheet { boxes: boxes(&triangles), name: "strip", particles: 0..302, triangles };

        let mut crossed = 0;
        for k in 0..400 {
            let x = -0.1 + 0.0043 * f64::from(k);
            let y = 0.03 * (1.0 + (0.7 * f64::from(k)).sin()) - 0.01;
            for top in [-0.03, 0.005, 0.03] {
                let ends = [[x, y, -0.03], [x + 0.02, y, top]];
                let meets = |corners: &[[f64; 3]; 3]| segment_meets_triangle(ends, *corners);
                let expected = sheet.triangles.iter().any(meets);
                assert_eq!(sheet.is_crossed(ends), expected, "{ends:?}");
                crossed += usize::from(expected);
            }
        }
        assert!(crossed > 100, "{crossed} lines meet the strip");

        let none = Sheet { name: "", particles: 0..0, boxes: boxes(&[]), triangles: Vec::new() };
        assert!(!none.is_crossed([[0.0; 3], [1.0; 3]]) && none.extent().is_none());
    }
}
