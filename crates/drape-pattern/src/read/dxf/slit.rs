//! Notches that are drawn as part of a cut line: slits that run in and back, and small teeth. Also
//! steps so small that they come from rounding.
//!
//! A cutter follows the line into the cloth and out again. As an outline the line would touch
//! itself there. The line is therefore closed over the mouth, and the middle of the mouth becomes a
//! notch.

use crate::edge::{Curve, Edge, difference, distance, distance_from_segment, turning_angle};

/// Widest mouth of a slit, in m.
const SLIT: f64 = 1.5e-3;

/// Depths of slits, in m.
const DEPTHS: std::ops::RangeInclusive<f64> = 1.5e-3..=0.02;

/// Widest mouth of a tooth, in m: notches are cut up to a quarter of an inch wide.
const TOOTH: f64 = 7e-3;

/// Depths of teeth, in m.
const TOOTH_DEPTHS: std::ops::RangeInclusive<f64> = 2e-3..=0.01;

/// Least depth of a tooth over the width of its mouth.
const STEEP: f64 = 0.5;

/// Largest turn between the mouth of a tooth and the line on either side of it, in rad. Behind a
/// notch the line continues in its direction before the notch.
const THROUGH: f64 = 0.5;

/// Largest number of chords of a slit or a tooth.
const CHORDS: usize = 4;

/// Length of a chord below which it is no part of the shape, in m. Ends that should meet are this
/// far apart, and programs step back by this length.
const SPECK: f64 = 1e-4;

/// Removes the chords of the closed line `line` that are as short as its rounding.
pub(crate) fn drop_specks(line: &mut Vec<Edge>) {
    let mut k = 0;
    while line.len() > 3 && k < line.len() {
        let next = (k + 1) % line.len();
        let is_speck = line[k].curve == Curve::Line && line[k].length() < SPECK;
        if is_speck && line[next].curve == Curve::Line {
            line[next].start = line[k].start;
            line.remove(k);
        } else {
            k += 1;
        }
    }
}

/// Closes the slits and teeth of the closed line `line`, and returns the middles of their mouths.
pub(crate) fn close_slits(line: &mut Vec<Edge>) -> Vec<[f64; 2]> {
    let mut notches = Vec::new();
    let mut start = 0;
    while start < line.len() {
        match (2..=CHORDS).find(|&count| line.len() > count + 2 && is_notch(line, start, count)) {
            Some(count) => {
                let mouth = close_mouth(line, start, count);
                notches.push([0, 1].map(|k| 0.5 * (mouth[0][k] + mouth[1][k])));
                start = 0;
            }
            None => start += 1,
        }
    }
    notches
}

/// Returns whether `count` chords of `line` from the chord `start` on are a slit or a tooth.
fn is_notch(line: &[Edge], start: usize, count: usize) -> bool {
    let edge = |k: usize| &line[(start + k) % line.len()];
    if (0..count).any(|k| edge(k).curve != Curve::Line) {
        return false;
    }
    let mouth = [edge(0).start, edge(count - 1).end];
    let width = distance(mouth[0], mouth[1]);
    let inner = || (1..count).map(|k| edge(k).start);
    let depth = inner().map(|p| distance_from_segment(p, mouth)).fold(0.0, f64::max);
    // The chords run in and out again, without another detour.
    let length: f64 = (0..count).map(|k| edge(k).length()).sum();
    if length > 2.2 * depth + width {
        return false;
    }
    let is_slit = width <= SLIT && DEPTHS.contains(&depth);
    let is_deep = TOOTH_DEPTHS.contains(&depth) && depth >= STEEP * width;
    if is_slit || !(width <= TOOTH && is_deep) {
        return is_slit;
    }

    // Behind a tooth the line goes on as before.
    let along = difference(mouth[1], mouth[0]);
    let before = line[(start + line.len() - 1) % line.len()].tangents()[1];
    let after = edge(count).tangents()[0];
    [before, after].iter().all(|side| turning_angle(*side, along).abs() <= THROUGH)
}

/// Replaces `count` chords of `line` from the chord `start` on by one chord over the mouth, and
/// returns the ends of the mouth.
fn close_mouth(line: &mut Vec<Edge>, start: usize, count: usize) -> [[f64; 2]; 2] {
    line.rotate_left(start);
    let mouth = [line[0].start, line[count - 1].end];
    let over = (mouth[0] != mouth[1]).then(|| Edge::line("", mouth[0], mouth[1]));
    line.splice(..count, over);
    mouth
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed line through points, in mm.
    fn line(points: &[[f64; 2]]) -> Vec<Edge> {
        let next = points.iter().cycle().skip(1);
        let metres = |p: &[f64; 2]| p.map(|x| 1e-3 * x);
        points.iter().zip(next).map(|(a, b)| Edge::line("", metres(a), metres(b))).collect()
    }

    #[test]
    fn slits_and_teeth_are_closed_and_corners_and_darts_stay() {
        // On the lower side: a slit without width, one of 1 mm with a square end, a tooth inwards
        // and one outwards. Each side of the rectangle begins at a slit once.
        let mut points = vec![[0.0, 0.0]];
        points.extend([[40.0, 0.0], [40.0, 6.0], [40.0, 0.0]]);
        points.extend([[80.0, 0.0], [80.0, 5.0], [81.0, 5.0], [81.0, 0.0]]);
        points.extend([[118.0, 0.0], [120.0, 5.0], [122.0, 0.0]]);
        points.extend([[157.0, 0.0], [160.0, -4.0], [163.0, 0.0]]);
        points.extend([[200.0, 0.0], [200.0, 100.0], [0.0, 100.0]]);
        for turned in 0..points.len() {
            let mut points = points.clone();
            points.rotate_left(turned);
            let mut outline = line(&points);
            let mut notches = close_slits(&mut outline);
            notches.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let places: Vec<f64> = notches.iter().map(|p| (1e4 * p[0]).round() / 10.0).collect();
            assert_eq!(places, [40.0, 80.5, 120.0, 160.0], "from {turned}: {notches:?}");
            let area: f64 = outline.iter().map(Edge::area).sum();
            assert!((area - 0.02).abs() < 1e-12, "{area} m²");
            let next = outline.iter().cycle().skip(1);
            assert!(outline.iter().zip(next).all(|(edge, next)| edge.end == next.start));
        }
        // A dart of 20 mm, the point of a pocket flap, a step, and a small square are no notches.
        for points in [
            vec![
                [0.0, 0.0],
                [90.0, 0.0],
                [100.0, 60.0],
                [110.0, 0.0],
                [200.0, 0.0],
                [200.0, 90.0],
                [0.0, 90.0],
            ],
            vec![[0.0, 0.0], [40.0, 0.0], [44.0, 8.0], [40.0, 60.0], [0.0, 60.0]],
            vec![[0.0, 0.0], [40.0, 0.0], [40.0, 5.0], [45.0, 5.0], [45.0, 60.0], [0.0, 60.0]],
            vec![[0.0, 0.0], [5.0, 0.0], [5.0, 5.0], [0.0, 5.0]],
        ] {
            let mut outline = line(&points);
            assert_eq!(close_slits(&mut outline), [] as [[f64; 2]; 0], "{points:?}");
            assert_eq!(outline.len(), points.len());
        }
    }
}
