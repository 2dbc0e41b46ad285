//! Strips: runs of grid points that are evaluated at once.

use std::ops::Range;

use drape_fabric::LANES;

use crate::layout::grid::GridPanel;
use crate::layout::sparsity::Sparsity;

/// Approximate number of particles in a strip. With fewer, more margins are evaluated twice. With
/// more, the buffers leave the cache.
const STRIP_POINTS: usize = 1024;

/// Least number of rows in a strip. Two rows at each side are computed twice.
const STRIP_ROWS: usize = 16;

/// Run of points that is evaluated at once, for any number of threads.
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
    /// Index of the strip's panel.
    pub(crate) panel: usize,
    /// Index of the first point, less the panel's margin, in the columns of the cloth.
    pub(crate) offset: usize,
    /// Points, starting at a multiple of [`LANES`].
    pub(crate) points: Range<usize>,
    /// Particles at the points, counted over the cloth. Particles of a rim's outline follow the
    /// last strip.
    pub(crate) particles: Range<usize>,
    /// Blocks in the rows of the particles.
    pub(crate) blocks: Range<usize>,
}

/// Index of the first connector of a batch in three kinds of columns.
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
    /// Cuts the points of `panel`, which has the number `index`, into strips of about equal length
    /// and appends them to `strips`.
    ///
    /// A panel has one strip, or an even number of strips, which two threads share equally. Each of
    /// these has at least three quarters of the wanted length.
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

        // A block belongs to the strip of its row.
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

    /// Returns the length of the strip's buffers in a panel with the given `margin`.
    pub(crate) fn buffer_length(&self, margin: usize) -> usize {
        self.points.len() + 2 * margin + LANES
    }

    /// Returns the indices of the batch that begins at index `buffer` of the buffers.
    #[inline(always)]
    pub(crate) fn batch(&self, buffer: usize) -> BatchIndex {
        BatchIndex { buffer, panel: self.points.start + buffer, cloth: self.offset + buffer }
    }
}
