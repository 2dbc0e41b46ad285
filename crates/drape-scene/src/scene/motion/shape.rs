//! Motion of a body that changes its shape: all its vertices at times.

/// Motion of a body that changes its shape: positions of all its vertices at times, between which
/// they move straight; at rest before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeMotion {
    /// Times, in s, rising; at least one.
    times: Vec<f64>,
    /// Three coordinates per vertex for each time, in m.
    positions: Vec<Vec<f64>>,
    /// Largest speed of a vertex between each two times, in m/s.
    speeds: Vec<f64>,
}

impl ShapeMotion {
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
}
