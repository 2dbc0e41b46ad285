//! Seams: pairs of particles that become one, and particles that are tied between two others.

use drape_cloth::Tie;

/// Line along which two edges are sewn together.
#[derive(Debug, Clone, PartialEq)]
pub struct Seam {
    /// Name in the pattern.
    pub name: String,
    /// Particles of both sides, in the order in which the seam runs. At the tip of a dart both
    /// particles of a pair are the same particle.
    pub pairs: SeamPairs,
    /// Numbers of the pairs, from 0, after which it goes on elsewhere, as over the mouth of a dart.
    pub breaks: Vec<usize>,
    /// Angle by which its sides are turned towards their right sides at rest, in rad.
    pub rest_angle: f64,
}

/// Particles that seams hold together.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SeamPairs {
    /// Pairs that become one.
    pub pairs: Vec<[u32; 2]>,
    /// Particles that then lie between two other particles: the longer side of a gather.
    pub ties: Vec<Tie>,
}

/// Constraint of a seam pair or a tie: a weighted sum of positions, the gap, is to vanish.
#[derive(Debug, Clone, PartialEq)]
pub struct SeamConstraint {
    /// Particles with their weights, which sum up to zero.
    pub weights: Vec<SeamWeight>,
}

/// Weight of a particle in a constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeamWeight {
    /// Particle.
    pub particle: u32,
    /// Weight.
    pub weight: f64,
}

impl SeamPairs {
    /// Returns whether there are neither pairs nor ties.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty() && self.ties.is_empty()
    }

    /// Returns the constraints of the pairs, then the constraints of the ties.
    pub fn constraints(&self) -> impl Iterator<Item = SeamConstraint> {
        let constraint = |weights: &[(u32, f64)]| {
            let weight = |&(particle, weight)| SeamWeight { particle, weight };
            SeamConstraint { weights: weights.iter().map(weight).collect() }
        };
        let pairs = self.pairs.iter().map(move |&[a, b]| constraint(&[(a, 1.0), (b, -1.0)]));
        let ties = self.ties.iter().map(move |&Tie { particle, ends: [a, b], fraction }| {
            constraint(&[(particle, 1.0), (a, fraction - 1.0), (b, -fraction)])
        });
        pairs.chain(ties)
    }

    /// Returns the tied particles, each with the two that it lies between.
    #[must_use]
    pub fn tied_triples(&self) -> Vec<[u32; 3]> {
        self.ties.iter().map(|&Tie { particle, ends: [a, b], .. }| [particle, a, b]).collect()
    }

    /// Returns the gap at each particle for positions of all, in m: the narrowest that is to vanish
    /// there, infinite where none is.
    #[must_use]
    pub fn gaps_at_particles(&self, positions: &[f64]) -> Vec<f64> {
        let mut gaps = vec![f64::INFINITY; positions.len() / 3];
        for constraint in self.constraints() {
            constraint.narrow(constraint.width(positions), &mut gaps);
        }
        gaps
    }

    /// Returns the widths of the gaps at positions of all particles, in m, one for each constraint.
    pub fn gaps(&self, positions: &[f64]) -> impl Iterator<Item = f64> {
        self.constraints().map(|constraint| constraint.width(positions))
    }
}

impl SeamConstraint {
    /// Returns the gap at positions of all particles, in m.
    #[must_use]
    pub fn gap(&self, positions: &[f64]) -> [f64; 3] {
        let mut gap = [0.0; 3];
        for &SeamWeight { particle, weight } in &self.weights {
            for (axis, gap) in gap.iter_mut().enumerate() {
                *gap += weight * positions[3 * particle as usize + axis];
            }
        }
        gap
    }

    /// Lowers the gaps of the particles that are to meet, both of a pair or the tied one, to a
    /// width, all in m.
    pub fn narrow(&self, width: f64, gaps: &mut [f64]) {
        let whole = self.weights.iter().filter(|weight| weight.weight.abs() == 1.0);
        for &SeamWeight { particle, .. } in whole {
            let gap = &mut gaps[particle as usize];
            *gap = gap.min(width);
        }
    }

    /// Returns the width of the gap at positions of all particles, in m.
    #[must_use]
    pub fn width(&self, positions: &[f64]) -> f64 {
        self.gap(positions).iter().map(|x| x * x).sum::<f64>().sqrt()
    }
}
