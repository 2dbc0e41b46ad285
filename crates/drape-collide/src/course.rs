use crate::pair::PairKind;
use crate::vector::{Vector, at, dot, scale, subtract};

/// Where the vertices of a surface may go from the positions at which its pairs are detected.
///
/// Ways are flat, one for each vertex, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sweep<'a> {
    /// They stay.
    Still,
    /// All go the same share of their straight ways. What they have in common brings no two of
    /// them nearer.
    Common(&'a [f64]),
    /// Each goes its own share of its straight way.
    Individual(&'a [f64]),
}

impl<'a> Sweep<'a> {
    /// The ways, unless they stay.
    pub(crate) fn ways(self) -> Option<&'a [f64]> {
        match self {
            Sweep::Still => None,
            Sweep::Common(ways) | Sweep::Individual(ways) => Some(ways),
        }
    }

    /// The mean way of the first vertices of those that go together.
    pub(crate) fn drift(self, free: usize) -> Vector {
        let Sweep::Common(ways) = self else { return [0.0; 3] };
        let mut sum = [0.0; 3];
        for way in ways.chunks_exact(3).take(free) {
            sum = [0, 1, 2].map(|k| sum[k] + way[k]);
        }
        scale(sum, 1.0 / free.max(1) as f64)
    }

    /// By how much two primitives can come nearer.
    ///
    /// Two points of them move against each other by no more than their vertices do, and that is
    /// largest at the ends of the ways.
    pub(crate) fn approach(self, kind: PairKind, vertices: [u32; 4]) -> f64 {
        let Some(flat) = self.ways() else { return 0.0 };
        let ways = vertices.map(|vertex| at(flat, vertex as usize));
        let square = |way: Vector| dot(way, way);
        let (first, second) = ways.split_at(match kind {
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
            most = ways.into_iter().map(square).fold(most, f64::max);
        }
        most.sqrt()
    }
}

/// The share of a way, from 0 to 1, at which it comes nearest to a place, both from its start and
/// given by components.
pub(crate) fn nearest(components: impl Iterator<Item = [f64; 2]>) -> f64 {
    let (mut square, mut along) = (0.0, 0.0);
    for [way, place] in components {
        square += way * way;
        along += way * place;
    }
    // Written so that no way gives the start.
    if square > 0.0 { (along / square).clamp(0.0, 1.0) } else { 0.0 }
}
