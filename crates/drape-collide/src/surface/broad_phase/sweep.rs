//! Trajectories of vertices along which pairs are detected.

use crate::surface::pair::PairKind;
use crate::vector::{Vector, at_or_zero, dot, scale, subtract};

/// Straight trajectories of the vertices of a surface from the positions at which its pairs are
/// detected.
///
/// Displacements are flat, in m. They belong to all vertices or, where bodies rest, to the free
/// vertices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sweep<'a> {
    /// No trajectories: the vertices stay.
    Still,
    /// All vertices move by a common fraction of their displacements. The mean displacement then
    /// changes no distance.
    Common(&'a [f64]),
    /// Each vertex moves by its individual fraction of its displacement.
    Individual(&'a [f64]),
}

impl<'a> Sweep<'a> {
    /// Returns the displacements, or `None` without trajectories.
    pub(crate) fn displacements(self) -> Option<&'a [f64]> {
        match self {
            Sweep::Still => None,
            Sweep::Common(displacements) | Sweep::Individual(displacements) => Some(displacements),
        }
    }

    /// Returns the mean displacement of the first `free` of all `vertices`, in m, if the fraction
    /// is common.
    ///
    /// Subtracting it from all displacements makes the boxes of falling cloth smaller. It makes the
    /// boxes of bodies at rest larger, which then cannot be kept: the result is `None` if most
    /// vertices belong to bodies.
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

    /// Returns a bound of the decrease of the distance of two primitives of a pair of `kind` with
    /// `vertices`, in m.
    ///
    /// Two points of the primitives move relative to each other by at most the relative
    /// displacement of two vertices. It is largest at the ends of the trajectories.
    pub(crate) fn largest_approach(self, kind: PairKind, vertices: [u32; 4]) -> f64 {
        let Some(flat) = self.displacements() else { return 0.0 };
        let displacements = vertices.map(|vertex| at_or_zero(flat, vertex as usize));
        let (first, second) = displacements.split_at(kind.first_vertex_count());
        let mut most: f64 = 0.0;
        for a in first {
            for b in second {
                let relative = subtract(*a, *b);
                most = most.max(dot(relative, relative));
            }
        }
        if let Sweep::Individual(_) = self {
            most = displacements.into_iter().map(|d| dot(d, d)).fold(most, f64::max);
        }
        most.sqrt()
    }
}

/// Returns the fraction of a displacement, 0 to 1, at which it comes nearest to an offset.
/// `components` yields `[displacement, offset]` for each component.
pub(crate) fn nearest_fraction(components: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (mut square, mut along) = (0.0, 0.0);
    for [displacement, offset] in components {
        square += displacement * displacement;
        along += displacement * offset;
    }
    // Without a displacement the start is nearest.
    if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 }
}
