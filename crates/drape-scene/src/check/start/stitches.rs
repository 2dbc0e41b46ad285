//! Stitches that start across a body: their straight ways, along which closing springs draw them,
//! lead through it.
//!
//! Cloth then slides round the body, or is caught behind it.

use crate::scene::Scene;
use crate::scene::seam::Seam;

use super::placing::Solids;

/// Depth in a body from which on a stitch leads through it, in m: cloth slides round less.
const DEPTH: f64 = 0.03;

/// Fraction of the stitches of a seam that lead through a body, from which on it is told.
const PART: f64 = 0.2;

/// Number of points of a stitch that are looked at.
const POINTS: u32 = 9;

/// Returns notes on the seams of a scene whose stitches lead through a body.
pub(crate) fn stitches_through_bodies(scene: &Scene) -> Vec<String> {
    let solids = Solids::new(scene.bodies.iter().map(|moving| &moving.body));
    let (Some(solids), Some(sewing)) = (solids, &scene.sewing) else { return Vec::new() };
    sewing.seams.iter().filter_map(|seam| through(scene, &solids, seam)).collect()
}

/// Returns a note on a seam of which many stitches lead through a body.
fn through(scene: &Scene, solids: &Solids<'_>, seam: &Seam) -> Option<String> {
    let place =
        |particle: u32| [0, 1, 2].map(|axis| scene.start.positions[3 * particle as usize + axis]);
    let (mut count, mut deepest, mut at) = (0, 0.0, [0.0; 3]);
    for [one, other] in &seam.pairs.pairs {
        let [from, to] = [*one, *other].map(place);
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
