//! Description of a seam: the nodes that are sewn to each other, its stiffness and its rest angle.

/// Seam: the nodes that are sewn to each other, and how it bends.
#[derive(Debug, Clone, PartialEq)]
pub struct Seam {
    /// Pairs of particles of the [`Cloth`](crate::Cloth) by number, one of each side, in the order
    /// of the seam. Both may be one particle, as at the tip of a dart.
    pub pairs: Vec<[u32; 2]>,
    /// Particles of a gather's longer side between the pairs, in the order of the seam.
    pub ties: Vec<Tie>,
    /// Numbers of the pairs, from 0, after which the seam continues elsewhere: the next pair is no
    /// neighbour on the outlines.
    pub breaks: Vec<usize>,
    /// Stiffness of the strip that the seam adds to the panels, over the stiffness of the fabric.
    pub stiffness: f64,
    /// Angle by which the panels are turned towards their right sides at rest, in rad: 0 if the
    /// seam is pressed open.
    pub rest_angle: f64,
}

/// Particle that is tied to a point between two others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tie {
    /// Number of the tied particle in the [`Cloth`](crate::Cloth), from 0.
    pub particle: u32,
    /// The two particles between which it lies: particles of the other side, of two consecutive
    /// pairs.
    pub ends: [u32; 2],
    /// Position between the ends: 0 at the first, 1 at the second.
    pub fraction: f64,
}

impl Seam {
    /// Default bending stiffness of a seam, over the stiffness of one layer. Two layers that slide
    /// on each other would be twice as stiff as one layer, and two layers that do not slide eight
    /// times as stiff. The default lies between these two numbers.
    pub const STIFFNESS: f64 = 3.0;

    /// Largest rest angle, in rad. Up to this value angles are exact.
    pub const REST_ANGLE_MAX: f64 = 140.0 * std::f64::consts::PI / 180.0;

    /// Returns a seam of `pairs` with the default stiffness that is pressed open.
    #[must_use]
    pub fn new(pairs: Vec<[u32; 2]>) -> Self {
        let (ties, breaks) = (Vec::new(), Vec::new());
        Self { pairs, ties, breaks, stiffness: Self::STIFFNESS, rest_angle: 0.0 }
    }
}
