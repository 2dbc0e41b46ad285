//! Strips: the runs of grid points that are evaluated at once, and how a panel is cut into them.

use std::ops::Range;

use drape_fabric::LANES;

use crate::layout::grid::GridPanel;
use crate::layout::sparsity::Sparsity;

/// Number of particles of a strip, about: with fewer, more margins are evaluated twice; with more,
/// the buffers leave the cache.
const STRIP_POINTS: usize = 1024;

/// Least number of rows of a strip: two rows at each of its sides are computed twice.
const STRIP_ROWS: usize = 16;

/// Run of points that is evaluated at once, whatever the number of threads.
///
/// ```text
///    rows        ┌────────────────────────┐
///     r+2, r+1   │ margin, computed twice │  read: positions;  computed: edges, loads
///                ├────────────────────────┤
///     r          │ points of the strip    │
///     …          │                        │  written: forces, blocks, memories, sums
///     s          │                        │
///                ├────────────────────────┤
///     s−1, s−2   │ margin, computed twice │
///                └────────────────────────┘
/// ```
#[derive(Debug, Clone)]
pub(crate) struct Strip {
    /// Index among the strips of the cloth.
    pub(crate) index: usize,
    /// Panel that it is part of.
    pub(crate) panel: usize,
    /// Index of its first point, less the panel's margin, in the columns of the cloth.
    pub(crate) offset: usize,
    /// Points, starting at a multiple of [`LANES`].
    pub(crate) points: Range<usize>,
    /// Particles at the points, counted over the cloth. Those of a rim's outline follow the last
    /// strip's.
    pub(crate) particles: Range<usize>,
    /// Blocks in the rows of the particles.
    pub(crate) blocks: Range<usize>,
}

/// Index of the first connector of a batch in the three kinds of columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BatchIndex {
    /// In the buffers of the strip.
    pub(crate) buffer: usize,
    /// In the columns of the panel.
    pub(crate) panel: usize,
    /// In the columns of the cloth.
    pub(crate) cloth: usize,
}

impl Strip {
    /// Cuts the points of a panel into strips of about the same length and appends them.
    ///
    /// A panel has one strip, or an even number, which two threads share equally, each of at least
    /// three quarters of the wanted length.
    pub(crate) fn append(
        strips: &mut Vec<Self>,
        panel: &GridPanel,
        index: usize,
        sparsity: &Sparsity,
    ) {
        let wanted = STRIP_POINTS.max(STRIP_ROWS * panel.stride);
        let pairs = (panel.points as f64 / (2 * wanted) as f64 + 0.25) as usize;
        let count = (2 * pairs).max(1);
        let length = panel.points.div_ceil(count).next_multiple_of(LANES);
        let mut first = panel.first;
        for start in (0..panel.points).step_by(length) {
            let points = start..(start + length).min(panel.points);
            let occupied = panel.occupied[points.clone()].iter().filter(|o| **o);
            let particles = first..first + occupied.count();
            first = particles.end;
            strips.push(Self {
                index: strips.len(),
                panel: index,
                offset: panel.base + start,
                blocks: sparsity.offsets[particles.start]..sparsity.offsets[particles.end],
                points,
                particles,
            });
        }
    }

    /// Length of the buffers of a strip of a panel with the given margin.
    pub(crate) fn buffer_length(&self, margin: usize) -> usize {
        self.points.len() + 2 * margin + LANES
    }

    /// Returns the indices of the batch that begins at an index of the buffers.
    #[inline(always)]
    pub(crate) fn batch(&self, buffer: usize) -> BatchIndex {
        BatchIndex { buffer, panel: self.points.start + buffer, cloth: self.offset + buffer }
    }
}
