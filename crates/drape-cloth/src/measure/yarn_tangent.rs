use crate::field::Vector;

/// Direction of a yarn at a particle, as a combination of three positions on the yarn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tangent {
    particles: [u32; 3],
    weights: [f64; 3],
}

impl Tangent {
    /// A vector along the yarn, in the rising direction of its material coordinate.
    pub(crate) fn at(&self, positions: &[f64]) -> Vector {
        let [a, b, c] = self.particles.map(|particle| 3 * particle as usize);
        let [wa, wb, wc] = self.weights;
        [0, 1, 2].map(|k| wa * positions[a + k] + wb * positions[b + k] + wc * positions[c + k])
    }
}

/// Tangents along the warp and the weft at every particle: central differences, and at the ends of a
/// yarn the one-sided difference of second order, so that the normals of a cylinder are right at its
/// edges too. `first` is the number of the panel's first particle.
pub(crate) fn tangents(
    yarns: &[Vec<Vec<u32>>; 2],
    first: u32,
    particles: usize,
) -> Vec<[Tangent; 2]> {
    let none = Tangent { particles: [0; 3], weights: [0.0; 3] };
    let mut tangents = vec![[none; 2]; particles];
    for (direction, yarns) in yarns.iter().enumerate() {
        for yarn in yarns {
            let last = yarn.len() - 1;
            for (index, &particle) in yarn.iter().enumerate() {
                let (places, weights) = match (index, last) {
                    (_, 1) => ([0, 0, 1], [-1.0, 0.0, 1.0]),
                    (0, _) => ([0, 1, 2], [-3.0, 4.0, -1.0]),
                    (i, _) if i == last => ([last - 2, last - 1, last], [1.0, -4.0, 3.0]),
                    (i, _) => ([i - 1, i, i + 1], [-1.0, 0.0, 1.0]),
                };
                let particles = places.map(|place| first + yarn[place]);
                tangents[particle as usize][direction] = Tangent { particles, weights };
            }
        }
    }
    tangents
}
