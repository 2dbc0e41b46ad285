//! Motion of a body that changes its shape: all its vertices at times.

use serde::{Deserialize, Serialize};

/// Largest distance in another frame of vertices that are one in the first frame, in m: some digits
/// of a 32-bit float.
const PARTED: f64 = 1e-6;

/// Square of the sine of the sharpest triangle of a frame, about: what the mesh of a body may have
/// too.
const FLAT: f64 = 1e-12;

/// Motion of a body that changes its shape: positions of all its vertices at times, between which
/// they move straight; at rest before the first and after the last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ShapeMotion {
    /// Times, in s, rising; at least one.
    times: Vec<f64>,
    /// Three coordinates per vertex for each time, in m.
    positions: Vec<Vec<f64>>,
    /// Largest speed of a vertex between each two times, in m/s.
    speeds: Vec<f64>,
}

impl ShapeMotion {
    /// Returns a straight motion between two rising times, in s, from positions of vertices to
    /// others, in m, with the triangles of the body.
    ///
    /// # Errors
    /// Vertices that are too far out, or a triangle without an area at the end, in words.
    pub fn between(
        times: [f64; 2],
        positions: [Vec<f64>; 2],
        triangles: &[[u32; 3]],
    ) -> Result<Self, String> {
        let end = positions[1].as_chunks::<3>().0;
        check_frame(end, &[], triangles)?;
        let is_point = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|vertex| end[vertex as usize]);
            a == b && b == c
        };
        if let Some(number) = triangles.iter().position(is_point) {
            return Err(format!("triangle {number} has no area"));
        }
        Ok(Self::new(times.to_vec(), positions.into()))
    }

    /// Motion through positions at rising times, at least one.
    pub(crate) fn new(times: Vec<f64>, positions: Vec<Vec<f64>>) -> Self {
        let pairs = positions.windows(2).zip(times.windows(2));
        let speeds = pairs.map(|(places, times)| {
            let [from, to] = [places[0].as_chunks::<3>().0, places[1].as_chunks::<3>().0];
            let square = |(a, b): (&[f64; 3], &[f64; 3])| {
                a.iter().zip(b).map(|(a, b)| (b - a) * (b - a)).sum::<f64>()
            };
            let distance = from.iter().zip(to).map(square).fold(0.0, f64::max).sqrt();
            distance / (times[1] - times[0])
        });
        Self { speeds: speeds.collect(), times, positions }
    }

    /// Returns whether there are frames of `vertex_count` vertices at rising times, with finite
    /// numbers.
    pub(crate) fn is_sound(&self, vertex_count: usize) -> bool {
        let Self { times, positions, speeds } = self;
        !times.is_empty()
            && times.windows(2).all(|pair| pair[0] < pair[1])
            && positions.len() == times.len()
            && speeds.len() + 1 == times.len()
            && positions.iter().all(|frame| frame.len() == 3 * vertex_count)
            && self.numbers().chain(speeds.iter().copied()).all(f64::is_finite)
    }

    /// Writes the positions of the vertices at a time, in s.
    pub fn write_positions(&self, time: f64, positions: &mut [f64]) {
        let next = self.times.partition_point(|t| *t <= time);
        let before = next.saturating_sub(1);
        let last = self.positions.len() - 1;
        let (from, to) = (&self.positions[before], &self.positions[next.min(last)]);
        if next == 0 || next == self.times.len() {
            return positions.copy_from_slice(from);
        }
        let part = (time - self.times[before]) / (self.times[next] - self.times[before]);
        for ((position, from), to) in positions.iter_mut().zip(from).zip(to) {
            *position = from + part * (to - from);
        }
    }

    /// Returns all times and positions, for hashing.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        self.times.iter().chain(self.positions.iter().flatten()).copied()
    }

    /// Returns the largest speed of a vertex, in m/s.
    #[must_use]
    pub fn max_speed(&self) -> f64 {
        self.speeds.iter().copied().fold(0.0, f64::max)
    }

    /// Returns an upper bound of the length of the paths of the vertices between two times, in s,
    /// in m.
    pub(crate) fn path(&self, [from, to]: [f64; 2]) -> f64 {
        let pieces = self.times.windows(2).zip(&self.speeds);
        let length = |(piece, speed): (&[f64], &f64)| {
            speed * (to.min(piece[1]) - from.max(piece[0])).max(0.0)
        };
        pieces.map(length).sum()
    }
}

/// Checks a frame: its vertices are near, coincident ones stay so, and triangles keep an area.
pub(crate) fn check_frame(
    sample: &[[f64; 3]],
    coincident: &[[u32; 2]],
    triangles: &[[u32; 3]],
) -> Result<(), String> {
    let at = |vertex: u32| sample[vertex as usize];
    let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
    let square = |a: [f64; 3]| a.iter().map(|x| x * x).sum::<f64>();
    // Written so that NaN fails.
    let far = |place: &[f64; 3]| !place.iter().all(|x| x.abs() <= 1e6);
    if let Some(vertex) = sample.iter().position(far) {
        return Err(format!("vertex {vertex} is at {:?} m", sample[vertex]));
    }
    for &[a, b] in coincident {
        if square(minus(at(a), at(b))) > PARTED * PARTED {
            return Err(format!("the vertices {a} and {b} part, which are one in the first frame"));
        }
    }
    for (number, &[a, b, c]) in triangles.iter().enumerate() {
        let (e, f) = (minus(at(b), at(a)), minus(at(c), at(a)));
        let longest = square(e).max(square(f)).max(square(minus(f, e)));
        let dot: f64 = e.iter().zip(f).map(|(e, f)| e * f).sum();
        let area = square(e) * square(f) - dot * dot;
        if !(area > FLAT * longest * longest) && longest > 0.0 {
            return Err(format!("triangle {number} has no area"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_counts_each_frame_with_its_own_speed() {
        // The second vertex moves by 3 m in 1 s, the first by 1 m in 2 s.
        let frames = vec![
            vec![0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            vec![0.0, 0.0, 0.0, 0.0, 3.0, 0.0],
            vec![1.0, 0.0, 0.0, 0.0, 3.0, 0.0],
        ];
        let motion = ShapeMotion::new(vec![1.0, 2.0, 4.0], frames);
        assert_eq!(motion.max_speed(), 3.0);
        for (times, length) in
            [([0.0, 1.0], 0.0), ([1.0, 2.0], 3.0), ([1.5, 3.0], 2.0), ([0.0, 9.0], 4.0)]
        {
            assert_eq!(motion.path(times), length, "between {times:?}");
        }
    }

    #[test]
    fn vertices_move_straight_from_frame_to_frame() {
        let frames = vec![vec![0.0, 0.0, 1.0], vec![0.0, 2.0, 1.0], vec![4.0, 2.0, 0.0]];
        let motion = ShapeMotion::new(vec![1.0, 2.0, 4.0], frames);
        for (time, place) in [
            (0.0, [0.0, 0.0, 1.0]),
            (1.25, [0.0, 0.5, 1.0]),
            (2.0, [0.0, 2.0, 1.0]),
            (2.5, [1.0, 2.0, 0.75]),
            (4.0, [4.0, 2.0, 0.0]),
            (9.0, [4.0, 2.0, 0.0]),
        ] {
            let mut found = [f64::NAN; 3];
            motion.write_positions(time, &mut found);
            assert_eq!(found, place, "at {time} s");
        }
    }
}
