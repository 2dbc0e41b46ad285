//! Rigid motion along keys.

use drape_collide::Pose;
use serde::{Deserialize, Serialize};

use super::resolution::MotionResolution;

/// Largest rotation between two keys, in degrees, on a path that counts as straight. A path with a
/// larger rotation does not, however short it is.
const ROTATION_MAX: f64 = 90.0;

/// Key of a rigid motion: displacement and rotation at a time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MotionKey {
    /// Time, in s.
    pub time: f64,
    /// Displacement from the start, in m.
    pub shift: [f64; 3],
    /// Rotation about the centre: angles about x, then y, then z, in degrees.
    pub turn: [f64; 3],
}

/// Rigid motion of a pin or a body: displacement and angles are linear between its keys, and
/// constant before the first and after the last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RigidMotion {
    /// Centre of rotation, in m.
    center: [f64; 3],
    /// Keys in the order of their times; at least one.
    keys: Vec<MotionKey>,
}

impl RigidMotion {
    /// Returns a motion about a centre, in m, along keys in the order of their times. Without keys
    /// there is no motion.
    #[must_use]
    pub fn new(center: [f64; 3], keys: Vec<MotionKey>) -> Option<Self> {
        (!keys.is_empty()).then_some(Self { center, keys })
    }

    /// Returns whether there are keys at rising times, with finite numbers.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let numbers = |key: &MotionKey| [key.time].into_iter().chain(key.shift).chain(key.turn);
        let mut all = self.center.into_iter().chain(self.keys.iter().flat_map(numbers));
        !self.keys.is_empty()
            && all.all(f64::is_finite)
            && self.keys.windows(2).all(|pair| pair[0].time < pair[1].time)
    }

    /// Returns the map at a time, in s, from the positions of points at the start, in m, to those
    /// at that time.
    pub fn transform(&self, time: f64) -> impl Fn([f64; 3]) -> [f64; 3] + use<> {
        let (center, MotionKey { shift, turn, .. }) = (self.center, self.at(time));
        move |start| {
            let arm = rotate(std::array::from_fn(|axis| start[axis] - center[axis]), turn);
            std::array::from_fn(|axis| center[axis] + arm[axis] + shift[axis])
        }
    }

    /// Returns the pose at a time, in s, of a body that starts at one.
    #[must_use]
    pub fn pose_at(&self, time: f64, start: Pose) -> Pose {
        let rotated = rotate_pose(start, self.at(time).turn);
        Pose { position: self.transform(time)(start.position), ..rotated }
    }

    /// Returns the largest speed of points that start at some positions, in m/s, from a thousandth
    /// of the time between each two keys: in between a point turns at a steady rate.
    #[must_use]
    pub fn max_speed(&self, start: &[[f64; 3]]) -> f64 {
        let mut most = 0.0_f64;
        for pair in self.keys.windows(2) {
            let [from, time] = [pair[0].time, 1e-3 * (pair[1].time - pair[0].time)];
            most = most.max(self.longest_chord([from, from + time], start) / time);
        }
        most
    }

    /// Returns whether a step between two times, in s, resolves the motion of points that start at
    /// some positions, in m.
    #[must_use]
    pub fn is_resolved(
        &self,
        times: [f64; 2],
        start: &[[f64; 3]],
        resolution: MotionResolution,
    ) -> bool {
        self.path(times, start) <= resolution.path
            && self.deviation_from_straight(times, start) <= resolution.deviation
    }

    /// Returns an upper bound of the length of the paths between two times, in s, of points that
    /// start at some positions, in m: the sum of the longest chords from key to key.
    fn path(&self, [from, to]: [f64; 2], start: &[[f64; 3]]) -> f64 {
        let mut length = 0.0;
        let mut begin = from;
        for end in self.times_inside([from, to]).chain([to]) {
            length += self.longest_chord([begin, end], start);
            begin = end;
        }
        length
    }

    /// Returns the longest distance between the places at two times, in s, of points that start at
    /// some positions, in m. Without a rotation between the times it is the same for all points.
    fn longest_chord(&self, times: [f64; 2], start: &[[f64; 3]]) -> f64 {
        let [before, after] = times.map(|time| self.at(time));
        if before.turn == after.turn {
            return distance(before.shift, after.shift);
        }
        let [before, after] = times.map(|time| self.transform(time));
        start.iter().map(|&place| distance(before(place), after(place))).fold(0.0, f64::max)
    }

    /// Returns the times of the keys between two times, in s.
    fn times_inside(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
        self.keys.iter().map(|key| key.time).filter(move |time| from < *time && *time < to)
    }

    /// Returns the largest deviation from straight paths between two times, in s, of points that
    /// start at some positions, in m: that by which rotation bends their paths. Corners at keys do
    /// not count.
    fn deviation_from_straight(&self, [from, to]: [f64; 2], start: &[[f64; 3]]) -> f64 {
        let mut most = 0.0_f64;
        let mut begin = from;
        for end in self.times_inside([from, to]).chain([to]) {
            let Some(square) = self.squared_sagitta([begin, end], start) else {
                return f64::INFINITY;
            };
            most = most.max(square);
            begin = end;
        }
        most.sqrt()
    }

    /// Largest squared distance of a point in the middle of a time, in s, from the middle of its
    /// ends, in m²; none where the rotation is too large for that to be the deviation.
    fn squared_sagitta(&self, [from, to]: [f64; 2], start: &[[f64; 3]]) -> Option<f64> {
        let turns = [from, to].map(|time| self.at(time).turn);
        let angle = (0..3).map(|k| (turns[1][k] - turns[0][k]).abs()).fold(0.0, f64::max);
        if angle > ROTATION_MAX {
            return None;
        }
        let mut most = 0.0_f64;
        if angle == 0.0 {
            return Some(most);
        }
        let at = [from, 0.5 * (from + to), to].map(|time| self.transform(time));
        for &place in start {
            let [a, b, c] = [at[0](place), at[1](place), at[2](place)];
            let square = |k: usize| (b[k] - 0.5 * (a[k] + c[k])).powi(2);
            most = most.max((0..3).map(square).sum());
        }
        Some(most)
    }

    fn at(&self, time: f64) -> MotionKey {
        let next = self.keys.partition_point(|key| key.time <= time);
        let [Some(before), Some(after)] = [next.wrapping_sub(1), next].map(|k| self.keys.get(k))
        else {
            return *if next == 0 { &self.keys[0] } else { &self.keys[next - 1] };
        };
        let part = (time - before.time) / (after.time - before.time);
        let between = |from: [f64; 3], to: [f64; 3]| {
            std::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]))
        };
        let shift = between(before.shift, after.shift);
        MotionKey { time, shift, turn: between(before.turn, after.turn) }
    }
}

/// Distance of two points, in m.
fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (b - a) * (b - a)).sum::<f64>().sqrt()
}

/// Rotates a point about the x, y and z axes, one after the other, by angles in degrees.
pub(crate) fn rotate(point: [f64; 3], degrees: [f64; 3]) -> [f64; 3] {
    let mut point = point;
    for (axis, angle) in degrees.into_iter().enumerate() {
        let (sin, cos) = angle.to_radians().sin_cos();
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        (point[i], point[j]) = (cos * point[i] - sin * point[j], sin * point[i] + cos * point[j]);
    }
    point
}

/// Rotates a pose about the world's x, then y, then z axis, by angles in degrees.
pub(crate) fn rotate_pose(pose: Pose, degrees: [f64; 3]) -> Pose {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let turns = axes.into_iter().zip(degrees).filter(|(_, angle)| *angle != 0.0);
    turns.fold(pose, |pose, (axis, angle)| pose.rotated(axis, angle.to_radians()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion() -> RigidMotion {
        let key = |time: f64, shift: f64, turn: f64| MotionKey {
            time,
            shift: [shift, 0.0, 0.0],
            turn: [0.0, 0.0, turn],
        };
        RigidMotion {
            center: [1.0, 1.0, 0.0],
            keys: vec![key(1.0, 0.0, 0.0), key(2.0, 0.5, 180.0)],
        }
    }

    #[test]
    fn a_point_moves_rigidly_from_key_to_key_and_rests_outside_of_them() {
        let near = |a: [f64; 3], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-15;
        for (time, expected) in
            [(0.0, [2.0, 1.0]), (1.0, [2.0, 1.0]), (1.5, [1.25, 2.0]), (9.0, [0.5, 1.0])]
        {
            let place = motion().transform(time)([2.0, 1.0, 0.0]);
            assert!(near(place, expected), "{place:?} at {time}");
        }
    }

    #[test]
    fn rotation_bends_paths_by_the_sagitta_of_their_arcs() {
        let key =
            |time: f64, turn: f64| MotionKey { time, shift: [0.0; 3], turn: [0.0, 0.0, turn] };
        let turned =
            RigidMotion { center: [1.0, 1.0, 0.0], keys: vec![key(1.0, 0.0), key(2.0, 60.0)] };
        // The farther of the two is 1 m from the axis.
        let deviation = |times: [f64; 2]| {
            turned.deviation_from_straight(times, &[[2.0, 1.0, 0.0], [1.0, 1.5, 0.0]])
        };
        let sagitta = 1.0 - 15_f64.to_radians().cos();
        assert!((deviation([1.0, 1.5]) - sagitta).abs() < 1e-15, "{}", deviation([1.0, 1.5]));
        // At rest before, and the corner between does not count.
        assert_eq!(deviation([0.0, 1.0]), 0.0);
        assert!((deviation([0.5, 1.5]) - sagitta).abs() < 1e-15);
        assert_eq!(motion().deviation_from_straight([1.0, 2.0], &[[2.0, 1.0, 0.0]]), f64::INFINITY);
    }

    #[test]
    fn a_path_is_bounded_by_its_chords_from_key_to_key() {
        let key = |time: f64, x: f64| MotionKey { time, shift: [x, 0.0, 0.0], turn: [0.0; 3] };
        let back_and_forth = RigidMotion {
            center: [0.0; 3],
            keys: vec![key(1.0, 0.0), key(2.0, 0.5), key(3.0, 0.0)],
        };
        for (times, length) in
            [([0.0, 1.0], 0.0), ([1.0, 2.0], 0.5), ([1.5, 2.5], 0.5), ([0.0, 9.0], 1.0)]
        {
            let path = back_and_forth.path(times, &[[2.0, 1.0, 0.0]]);
            assert!((path - length).abs() < 1e-15, "{path} m between {times:?}");
        }
        let resolves = |path: f64| {
            let resolution = MotionResolution { path, deviation: 0.0 };
            back_and_forth.is_resolved([1.5, 2.5], &[[2.0, 1.0, 0.0]], resolution)
        };
        assert!(resolves(0.51) && !resolves(0.49));
    }

    #[test]
    fn a_body_turns_with_its_place() {
        let pose = motion().pose_at(1.5, Pose::new([2.0, 1.0, 0.0]));
        let [x, y, z, w] = pose.rotation;
        let half = std::f64::consts::FRAC_1_SQRT_2;
        assert!([x, y].iter().all(|q| q.abs() < 1e-15));
        assert!((z - half).abs() < 1e-15 && (w - half).abs() < 1e-15, "{pose:?}");
        assert!((pose.position[0] - 1.25).abs() < 1e-15, "{pose:?}");
    }
}
