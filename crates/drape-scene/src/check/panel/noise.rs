//! Noise: random heights at which cloth begins, so that it need not stay symmetric.

use crate::spec::panel::NoiseSpec;

/// Heights of a panel's particles: independent ones, or smooth over a length, whatever the spacing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Noise {
    /// Largest height, in m.
    amplitude: f64,
    /// Distance over which heights change, in m.
    length: Option<f64>,
    seed: u64,
    random: Random,
}

impl Noise {
    /// Returns the heights that `spec` describes.
    pub(crate) fn new(spec: &NoiseSpec) -> Self {
        let NoiseSpec { amplitude, length, seed } = *spec;
        Self { amplitude, length, seed, random: Random(seed) }
    }

    /// Noise of a panel's copy of some number: other heights.
    pub(crate) fn copied(&self, copy: u64) -> Self {
        let seed = self.seed.wrapping_add(copy);
        Self { seed, random: Random(seed), ..self.clone() }
    }

    /// Height of the next particle, whose position on its panel is given, in m.
    pub(crate) fn height(&mut self, place: [f64; 2]) -> f64 {
        self.amplitude
            * match self.length {
                Some(length) => self.smooth(place.map(|x| x / length)),
                None => self.random.next(),
            }
    }

    /// Cubic B-spline with random coefficients between −1 and 1 at whole numbers.
    fn smooth(&self, place: [f64; 2]) -> f64 {
        let first = place.map(f64::floor);
        let [u, v] = [0, 1].map(|axis| weights(place[axis] - first[axis]));
        let at = |i: usize, j: usize| {
            let [i, j] = [first[0] + i as f64, first[1] + j as f64].map(|x| x as i64 as u64);
            let row = Random(self.seed ^ Random(i).bits()).bits();
            Random(row ^ Random(j).bits()).next()
        };
        let pairs = (0..4).flat_map(|i| (0..4).map(move |j| (i, j)));
        pairs.map(|(i, j)| u[i] * v[j] * at(i, j)).sum()
    }
}

/// Weights of the cubic B-spline at four places in a row, at the fraction `t` between the middle
/// two.
fn weights(t: f64) -> [f64; 4] {
    let s = 1.0 - t;
    let middle = |t: f64| (4.0 + 3.0 * t * t * (t - 2.0)) / 6.0;
    [s * s * s / 6.0, middle(t), middle(s), t * t * t / 6.0]
}

/// SplitMix64 generator \[SLF14\]: the same numbers on every machine.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Random number between −1 and 1.
    pub(crate) fn next(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(length: Option<f64>, seed: u64) -> Noise {
        let length = length.map(|length| 1e-3 * length);
        Noise::new(&NoiseSpec { amplitude: 2e-4, length, seed })
    }

    #[test]
    fn smooth_heights_are_a_matter_of_the_place_alone() {
        let mut one = noise(Some(20.0), 7);
        let places: Vec<[f64; 2]> = (0..400)
            .map(|k| [1.7e-3 * f64::from(k % 20), 2.1e-3 * f64::from(k / 20) - 0.02])
            .collect();
        let there: Vec<f64> = places.iter().map(|place| one.height(*place)).collect();
        let mut again = noise(Some(20.0), 7);
        let mut back: Vec<f64> = places.iter().rev().map(|place| again.height(*place)).collect();
        back.reverse();
        assert_eq!(there, back);
        let mut other = noise(Some(20.0), 8);
        assert!(places.iter().zip(&there).all(|(place, height)| other.height(*place) != *height));
    }

    #[test]
    fn smooth_heights_curve_as_a_spline_may() {
        let mut noise = noise(Some(20.0), 3);
        let step = 1e-4;
        let (mut squares, mut count) = (0.0, 0.0);
        for k in 0..20_000 {
            let place = [0.013 * f64::from(k % 200), -0.011 * f64::from(k / 200)];
            let [before, here, after] =
                [-step, 0.0, step].map(|by| noise.height([place[0] + by, place[1]]));
            assert!(here.abs() <= 2e-4, "{here}");
            // The second derivative of the spline is one of numbers up to 1, minus twice their
            // neighbours', plus theirs.
            let curvature = (before + after - 2.0 * here) / (step * step);
            assert!(curvature.abs() < 4.0 * 2e-4 / (0.02 * 0.02), "{curvature}");
            (squares, count) = (squares + here * here, count + 1.0);
        }
        // Squares of the weights sum up to 0.479 along a line, on the average; a number between −1
        // and 1 has 1/3.
        let expected = 2e-4 * 0.479 / 3_f64.sqrt();
        let deviation = f64::sqrt(squares / count);
        assert!((deviation / expected - 1.0).abs() < 0.05, "{deviation} for {expected}");
    }
}
