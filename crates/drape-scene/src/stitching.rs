use drape_cloth::Tie;

/// Which particles of a cloth seams hold together.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Stitching {
    /// Pairs that become one.
    pub pairs: Vec<[u32; 2]>,
    /// Particles that lie between two others then: those of the longer side of a gather.
    pub ties: Vec<Tie>,
}

/// What one stitch draws together.
#[derive(Debug, Clone)]
pub struct Thread {
    /// Particles, with weights that add up to nothing: how far they are apart is the sum of their places.
    pub parts: Vec<(u32, f64)>,
}

impl Stitching {
    /// Whether it holds nothing together.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty() && self.ties.is_empty()
    }

    /// Its stitches, those of the pairs first.
    pub fn threads(&self) -> impl Iterator<Item = Thread> {
        let pairs = self.pairs.iter().map(|&[a, b]| vec![(a, 1.0), (b, -1.0)]);
        let ties = self.ties.iter().map(|&Tie { particle, ends: [a, b], fraction }| {
            vec![(particle, 1.0), (a, fraction - 1.0), (b, -fraction)]
        });
        pairs.chain(ties).map(|parts| Thread { parts })
    }

    /// The tied particles, each with the two that it lies between.
    #[must_use]
    pub fn triples(&self) -> Vec<[u32; 3]> {
        self.ties.iter().map(|&Tie { particle, ends: [a, b], .. }| [particle, a, b]).collect()
    }

    /// How far what it holds together is apart at positions of the particles, stitch by stitch, in m.
    pub fn gaps(&self, positions: &[f64]) -> impl Iterator<Item = f64> {
        self.threads().map(|thread| thread.width(positions))
    }
}

impl Thread {
    /// What lies between its ends, in m.
    #[must_use]
    pub fn gap(&self, positions: &[f64]) -> [f64; 3] {
        let mut gap = [0.0; 3];
        for &(particle, weight) in &self.parts {
            for (axis, gap) in gap.iter_mut().enumerate() {
                *gap += weight * positions[3 * particle as usize + axis];
            }
        }
        gap
    }

    /// How far its ends are apart, in m.
    #[must_use]
    pub fn width(&self, positions: &[f64]) -> f64 {
        self.gap(positions).iter().map(|x| x * x).sum::<f64>().sqrt()
    }
}
