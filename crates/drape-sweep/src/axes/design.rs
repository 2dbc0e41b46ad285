//! Designs: points that fill the unit cube evenly.

use crate::axes::random::Random;

/// Method of a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Method {
    /// Sobol's sequence with Owen's scrambling (Burley 2020).
    Sobol,
    /// Latin hypercube: each interval of each coordinate contains one point (McKay, Beckman &
    /// Conover 1979).
    LatinHypercube,
}

impl Method {
    /// Returns the largest number of points. Sobol's sequence here has 2¹⁶ points.
    pub(crate) fn points_max(self) -> u32 {
        match self {
            Self::Sobol => 1 << 16,
            Self::LatinHypercube => 100_000,
        }
    }

    /// Returns the largest number of coordinates.
    pub(crate) fn dimensions_max(self) -> usize {
        sobol_burley::NUM_DIMENSIONS as usize
    }

    /// Returns `count` points with `dimensions` coordinates from 0 to 1, as a list for each
    /// coordinate.
    pub(crate) fn coordinates(self, dimensions: usize, count: u32, seed: u32) -> Vec<Vec<f64>> {
        (0..dimensions as u32).map(|dimension| self.coordinate(dimension, count, seed)).collect()
    }

    /// Returns the coordinate `dimension` of `count` points.
    fn coordinate(self, dimension: u32, count: u32, seed: u32) -> Vec<f64> {
        match self {
            Self::Sobol => (0..count)
                .map(|index| f64::from(sobol_burley::sample(index, dimension, seed)))
                .collect(),
            Self::LatinHypercube => {
                let mut random = Random::new("latin hypercube", &[seed, dimension]);
                latin_hypercube_coordinate(count, &mut random)
            }
        }
    }
}

/// Returns one coordinate of a Latin hypercube: a number in each of `count` intervals, shuffled.
fn latin_hypercube_coordinate(count: u32, random: &mut Random) -> Vec<f64> {
    let mut intervals: Vec<u32> = (0..count).collect();
    for last in (1..intervals.len()).rev() {
        let other = (random.uniform() * (last + 1) as f64) as usize;
        intervals.swap(last, other.min(last));
    }
    intervals
        .into_iter()
        .map(|interval| (f64::from(interval) + random.uniform()) / f64::from(count))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the largest difference between the part of points in a box at the origin and its
    /// volume.
    fn discrepancy(points: &[Vec<f64>]) -> f64 {
        let count = points[0].len();
        let mut worst: f64 = 0.0;
        for [x, y] in (1..=16).flat_map(|i| (1..=16).map(move |j| [i, j].map(f64::from))) {
            let [x, y] = [x / 16.0, y / 16.0];
            let inside = (0..count).filter(|&k| points[0][k] < x && points[1][k] < y).count();
            worst = worst.max((inside as f64 / count as f64 - x * y).abs());
        }
        worst
    }

    #[test]
    fn each_interval_of_a_latin_hypercube_has_one_point() {
        for seed in 0..20 {
            for coordinate in Method::LatinHypercube.coordinates(3, 17, seed) {
                let mut intervals: Vec<usize> =
                    coordinate.iter().map(|x| (17.0 * x) as usize).collect();
                intervals.sort_unstable();
                assert_eq!(intervals, (0..17).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn sobol_points_fill_the_square_more_evenly_than_random_ones() {
        let random: Vec<Vec<f64>> = (0..2)
            .map(|dimension| {
                let mut random = Random::new("test", &[7, dimension]);
                (0..256).map(|_| random.uniform()).collect()
            })
            .collect();
        for seed in 0..10 {
            let sobol = discrepancy(&Method::Sobol.coordinates(2, 256, seed));
            assert!(sobol < 0.012, "{sobol}");
            assert!(sobol < 0.5 * discrepancy(&random), "{sobol}");
        }
    }

    #[test]
    fn a_seed_chooses_the_sample() {
        for method in [Method::Sobol, Method::LatinHypercube] {
            let sample = |seed| method.coordinates(4, 8, seed);
            assert_eq!(sample(1), sample(1));
            assert_ne!(sample(1), sample(2));
            assert!(sample(3).iter().flatten().all(|x| (0.0..1.0).contains(x)));
        }
    }
}
