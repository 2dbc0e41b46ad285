//! Chords of an edge: points between which straight lines stay near its curve.

use super::{Curve, Edge, difference, distance_from_segment, turning_angle};

/// Largest angle between two chords of a curve, in rad: 10°. Readers of drawings take turns of 20°
/// for corners.
const TURN: f64 = 0.175;

/// Largest number of chords of one edge.
const MOST_CHORDS: usize = 1024;

impl Edge {
    /// Returns points from the start of the edge up to, but not including, its end, in m. They are
    /// equally far apart along the edge.
    ///
    /// The chords between them stay within `tolerance`, in m, of the curve, and two chords in a row
    /// turn by 10° or less. An edge has at most 1024 chords, also where `tolerance` asks for more.
    ///
    /// ```
    /// use drape_pattern::{Curve, Edge};
    ///
    /// let line = Edge::line("hem", [0.0, 0.0], [0.3, 0.0]);
    /// assert_eq!(line.chords(1e-4), [[0.0, 0.0]]);
    /// let half_circle = line.curved(Curve::Arc { sweep: std::f64::consts::PI });
    /// assert!(half_circle.chords(1e-4).len() >= 18);
    /// ```
    #[must_use]
    pub fn chords(&self, tolerance: f64) -> Vec<[f64; 2]> {
        if self.curve == Curve::Line {
            return vec![self.start];
        }
        // The middle of a curve may lie on its chord, so that two chords are the fewest.
        let mut count = 2;
        loop {
            let at = |k: usize, shift: f64| self.at((k as f64 + shift) / count as f64);
            let points: Vec<[f64; 2]> = (0..=count).map(|k| at(k, 0.0)).collect();
            let is_near = |k: usize| {
                let ends = [points[k], points[k + 1]];
                let between = [0.25, 0.5, 0.75];
                between.iter().all(|&t| distance_from_segment(at(k, t), ends) <= tolerance)
            };
            let is_smooth = points.windows(3).all(|p| {
                turning_angle(difference(p[1], p[0]), difference(p[2], p[1])).abs() <= TURN
            });
            if count >= MOST_CHORDS || is_smooth && (0..count).all(is_near) {
                return points[..count].to_vec();
            }
            count = (count + count.div_ceil(4)).min(MOST_CHORDS);
        }
    }
}
