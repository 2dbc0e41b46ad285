//! Stitches that start across a body or another panel: their straight ways, along which closing
//! springs draw them, lead through it.
//!
//! Cloth then slides round the body or the panel, or is caught behind it.

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
    low: [f64; 3],
    high: [f64; 3],
}

impl<'a> Sheet<'a> {
    fn new(scene: &Scene, panel: &'a Panel) -> Self {
        let particles = panel.particles();
        let triangles = scene.cloth.triangles().iter();
        let triangles = triangles.filter(|triangle| particles.contains(&(triangle[0] as usize)));
        let triangles: Vec<_> =
            triangles.map(|corners| corners.map(|corner| place(scene, corner))).collect();
        let bound = |start: f64, pick: fn(f64, f64) -> f64| {
            [0, 1, 2].map(|k| triangles.iter().flatten().map(|point| point[k]).fold(start, pick))
        };
        let (low, high) = (bound(f64::MAX, f64::min), bound(f64::MIN, f64::max));
        Self { name: &panel.name, particles, triangles, low, high }
    }

    /// Returns whether a straight line between two points leads through the panel.
    fn is_crossed(&self, ends: [[f64; 3]; 2]) -> bool {
        let misses = |k: usize| {
            let [a, b] = ends.map(|end| end[k]);
            a.max(b) < self.low[k] || a.min(b) > self.high[k]
        };
        !(0..3).any(misses)
            && self.triangles.iter().any(|corners| segment_meets_triangle(ends, *corners))
    }
}

/// Returns the place of a particle at the start, in m.
fn place(scene: &Scene, particle: u32) -> [f64; 3] {
    [0, 1, 2].map(|axis| scene.start.positions[3 * particle as usize + axis])
}

/// Returns a note on a seam of which many stitches lead through a panel.
fn through_panel(scene: &Scene, sheets: &[Sheet<'_>], seam: &Seam) -> Option<Advice> {
    let all = &seam.pairs.pairs;
    let sewn = |sheet: &&Sheet<'_>| {
        all.iter().flatten().any(|&particle| sheet.particles.contains(&(particle as usize)))
    };
    let crossed = sheets.iter().filter(|sheet| !sewn(sheet)).map(|sheet| {
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
