//! Motion of a body that changes its shape: all its vertices at times.

/// Motion of a body that changes its shape: positions of all its vertices at times, between which they move straight; at
/// rest before the first and after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeMotion {
    /// Times, in s, rising; at least one.
    times: Vec<f64>,
    /// Three coordinates per vertex for each time, in m.
    positions: Vec<Vec<f64>>,
}

impl ShapeMotion {
    /// Motion through positions at rising times, at least one.
    pub(crate) fn new(times: Vec<f64>, positions: Vec<Vec<f64>>) -> Self {
        Self { times, positions }
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
        let mut most = 0.0_f64;
        for (positions, times) in self.positions.windows(2).zip(self.times.windows(2)) {
            let [from, to] = [positions[0].as_chunks::<3>().0, positions[1].as_chunks::<3>().0];
            let square = |(a, b): (&[f64; 3], &[f64; 3])| {
                a.iter().zip(b).map(|(a, b)| (b - a) * (b - a)).sum::<f64>()
            };
            let distance = from.iter().zip(to).map(square).fold(0.0, f64::max).sqrt();
            most = most.max(distance / (times[1] - times[0]));
        }
        most
    }
}
