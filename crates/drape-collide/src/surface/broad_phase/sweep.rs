//! Trajectories of vertices, along which pairs are detected.

use crate::surface::pair::PairKind;
use crate::vector::{Vector, at_or_zero, dot, scale, subtract};

/// Straight trajectories of the vertices of a surface from the positions at which its pairs are
/// detected.
///
/// Displacements are flat, one for each vertex or, where bodies rest, for each free one, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sweep<'a> {
    /// No trajectories: the vertices stay.
    Still,
    /// All vertices move by a common fraction of their displacements. The mean displacement
    /// changes no distance.
    Common(&'a [f64]),
    /// Each vertex moves by a fraction of its own.
    Individual(&'a [f64]),
}

impl<'a> Sweep<'a> {
    /// Returns the displacements, if there are any.
    pub(crate) fn displacements(self) -> Option<&'a [f64]> {
        match self {
            Sweep::Still => None,
            Sweep::Common(displacements) | Sweep::Individual(displacements) => Some(displacements),
        }
    }

    /// Returns the mean displacement of the free vertices of a surface, in m, if the fraction is
    /// common. Taken off all displacements, it makes the boxes of falling cloth smaller and those of
    /// bodies at rest larger, which then cannot be kept: none if most vertices are those of bodies.
    pub(crate) fn mean_displacement(self, free: usize, vertices: usize) -> Option<Vector> {
        let Sweep::Common(displacements) = self else { return None };
        if displacements.len() < 3 * vertices && vertices > 2 * free {
            return None;
        }
        let mut sum = [0.0; 3];
        for displacement in displacements.chunks_exact(3).take(free) {
            sum = [0, 1, 2].map(|k| sum[k] + displacement[k]);
        }
        Some(scale(sum, 1.0 / free.max(1) as f64))
    }

    /// Returns a bound of the decrease of the distance of two primitives, in m.
    ///
    /// Two points of them move relative to each other by no more than their vertices do, and that
    /// is largest at the ends of the trajectories.
    pub(crate) fn largest_approach(self, kind: PairKind, vertices: [u32; 4]) -> f64 {
        let Some(flat) = self.displacements() else { return 0.0 };
        let displacements = vertices.map(|vertex| at_or_zero(flat, vertex as usize));
        let square = |displacement: Vector| dot(displacement, displacement);
        let (first, second) = displacements.split_at(match kind {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        });
        let mut most: f64 = 0.0;
        for a in first {
            for b in second {
                most = most.max(square(subtract(*a, *b)));
            }
        }
        if let Sweep::Individual(_) = self {
            most = displacements.into_iter().map(square).fold(most, f64::max);
        }
        most.sqrt()
    }
}

/// Returns the fraction of a displacement, 0 to 1, at which it comes nearest to an offset; both are
/// given by components `[displacement, offset]`.
pub(crate) fn nearest_fraction(components: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (mut square, mut along) = (0.0, 0.0);
    for [displacement, offset] in components {
        square += displacement * displacement;
        along += displacement * offset;
    }
    // Without a displacement it is the start.
    if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 }
}
