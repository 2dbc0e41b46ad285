use drape_collide::Pose;

use crate::file::MotionFile;
use crate::placement::turned;
use crate::reader::Reader;

/// Angle, in degrees, that nothing turns by on a way that counts as straight, however small it is.
const TURN_MAX: f64 = 90.0;

/// Where something that moves is at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Key {
    /// In s.
    pub(crate) time: f64,
    /// Shift from where it started, in m.
    pub(crate) shift: [f64; 3],
    /// Turn about its center: angles about x, then y, then z, in degrees.
    pub(crate) turn: [f64; 3],
}

/// The way of a pin or a body, which it goes as one rigid thing: straight between its keys, at rest before the first
/// and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Track {
    /// The point it turns about, in m.
    center: [f64; 3],
    /// In the order of their times; at least one.
    keys: Vec<Key>,
}

impl Track {
    /// Where points are at a time, from where they start, in m.
    pub fn points(&self, time: f64) -> impl Fn([f64; 3]) -> [f64; 3] {
        let (center, Key { shift, turn, .. }) = (self.center, self.at(time));
        move |start| {
            let arm = turned(std::array::from_fn(|axis| start[axis] - center[axis]), turn);
            std::array::from_fn(|axis| center[axis] + arm[axis] + shift[axis])
        }
    }

    /// The pose at a time of what starts at one.
    #[must_use]
    pub fn pose(&self, time: f64, start: Pose) -> Pose {
        let turned = turn(start, self.at(time).turn);
        Pose { position: self.points(time)(start.position), ..turned }
    }

    /// The greatest speed of one of the points that start at these places, in m/s, from a thousandth of the time between
    /// each two keys: in between a point turns at a steady rate.
    #[must_use]
    pub fn speed_max(&self, start: &[[f64; 3]]) -> f64 {
        let mut most = 0.0_f64;
        for pair in self.keys.windows(2) {
            let [from, time] = [pair[0].time, 1e-3 * (pair[1].time - pair[0].time)];
            let (before, after) = (self.points(from), self.points(from + time));
            for &place in start {
                let (a, b) = (before(place), after(place));
                let square: f64 = a.iter().zip(b).map(|(a, b)| (b - a) * (b - a)).sum();
                most = most.max(square.sqrt() / time);
            }
        }
        most
    }

    /// How far the points that start at these places stray from straight ways between two times, in m: what turning
    /// bends their ways by. Corners at keys do not count.
    #[must_use]
    pub fn bow(&self, [from, to]: [f64; 2], start: &[[f64; 3]]) -> f64 {
        let inside = self.keys.iter().map(|key| key.time).filter(|time| from < *time && *time < to);
        let ends: Vec<f64> = std::iter::once(from).chain(inside).chain([to]).collect();
        let mut most = 0.0_f64;
        for pair in ends.windows(2) {
            let turns = [pair[0], pair[1]].map(|time| self.at(time).turn);
            let angle = (0..3).map(|k| (turns[1][k] - turns[0][k]).abs()).fold(0.0, f64::max);
            if angle > TURN_MAX {
                return f64::INFINITY;
            }
            if angle == 0.0 {
                continue;
            }
            let at = [pair[0], 0.5 * (pair[0] + pair[1]), pair[1]].map(|time| self.points(time));
            for &place in start {
                let [a, b, c] = [at[0](place), at[1](place), at[2](place)];
                let square = |k: usize| (b[k] - 0.5 * (a[k] + c[k])).powi(2);
                most = most.max((0..3).map(square).sum());
            }
        }
        most.sqrt()
    }

    fn at(&self, time: f64) -> Key {
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
        Key { time, shift, turn: between(before.turn, after.turn) }
    }
}

/// A pose turned about the world's x, then y, then z axis, by angles in degrees.
pub(crate) fn turn(pose: Pose, degrees: [f64; 3]) -> Pose {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let turns = axes.into_iter().zip(degrees).filter(|(_, angle)| *angle != 0.0);
    turns.fold(pose, |pose, (axis, angle)| pose.rotated(axis, angle.to_radians()))
}

impl Reader<'_> {
    /// The way of something whose middle starts at a place, in m.
    pub(crate) fn track(
        &mut self,
        key: &str,
        file: &MotionFile,
        (middle, unit): ([f64; 3], f64),
    ) -> Option<Track> {
        let count = file.times.len();
        let lists = [("shift", &file.shift), ("turn", &file.turn)];
        for (name, list) in lists {
            if !list.is_empty() && list.len() != count {
                let message = format!("{} places for {count} times", list.len());
                self.fail(&format!("{key}.{name}"), message, "give one for each of the times");
                return None;
            }
        }
        let rising = file.times.windows(2).all(|pair| pair[0] < pair[1]);
        let finite = |list: &[[f64; 3]]| list.iter().flatten().all(|x| x.is_finite());
        if count == 0 || !rising || !finite(&file.shift) || !finite(&file.turn) {
            let help = "give times = [0, 1, …] in s, each later than the one before, and as many \
                        shift = [[x, y, z], …] or turn = [[x, y, z], …]";
            self.fail(key, "the motion is not one".into(), help);
            return None;
        }
        let nought = [0.0; 3];
        let at = |list: &[[f64; 3]], k: usize| list.get(k).copied().unwrap_or(nought);
        let keys = file.times.iter().enumerate().map(|(k, &time)| Key {
            time,
            shift: at(&file.shift, k).map(|x| x * unit),
            turn: at(&file.turn, k),
        });
        let center = file.center.map_or(middle, |center| center.map(|x| x * unit));
        Some(Track { keys: keys.collect(), center })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track() -> Track {
        let key = |time: f64, shift: f64, turn: f64| Key {
            time,
            shift: [shift, 0.0, 0.0],
            turn: [0.0, 0.0, turn],
        };
        Track { center: [1.0, 1.0, 0.0], keys: vec![key(1.0, 0.0, 0.0), key(2.0, 0.5, 180.0)] }
    }

    #[test]
    fn a_point_moves_rigidly_from_key_to_key_and_rests_outside_of_them() {
        let near = |a: [f64; 3], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-15;
        for (time, expected) in
            [(0.0, [2.0, 1.0]), (1.0, [2.0, 1.0]), (1.5, [1.25, 2.0]), (9.0, [0.5, 1.0])]
        {
            let place = track().points(time)([2.0, 1.0, 0.0]);
            assert!(near(place, expected), "{place:?} at {time}");
        }
    }

    #[test]
    fn turning_bends_ways_by_the_sagitta_of_their_arcs() {
        let key = |time: f64, turn: f64| Key { time, shift: [0.0; 3], turn: [0.0, 0.0, turn] };
        let turned = Track { center: [1.0, 1.0, 0.0], keys: vec![key(1.0, 0.0), key(2.0, 60.0)] };
        // The farther of the two is 1 m from the axis.
        let bow = |times: [f64; 2]| turned.bow(times, &[[2.0, 1.0, 0.0], [1.0, 1.5, 0.0]]);
        let sagitta = 1.0 - 15_f64.to_radians().cos();
        assert!((bow([1.0, 1.5]) - sagitta).abs() < 1e-15, "{}", bow([1.0, 1.5]));
        // At rest before, and the corner between is none of its bow.
        assert_eq!(bow([0.0, 1.0]), 0.0);
        assert!((bow([0.5, 1.5]) - sagitta).abs() < 1e-15);
        assert_eq!(track().bow([1.0, 2.0], &[[2.0, 1.0, 0.0]]), f64::INFINITY);
    }

    #[test]
    fn a_body_turns_with_its_place() {
        let pose = track().pose(1.5, Pose::new([2.0, 1.0, 0.0]));
        let [x, y, z, w] = pose.rotation;
        let half = std::f64::consts::FRAC_1_SQRT_2;
        assert!([x, y].iter().all(|q| q.abs() < 1e-15));
        assert!((z - half).abs() < 1e-15 && (w - half).abs() < 1e-15, "{pose:?}");
        assert!((pose.position[0] - 1.25).abs() < 1e-15, "{pose:?}");
    }
}
