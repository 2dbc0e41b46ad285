use crate::order::Order;
use rayon::prelude::*;

/// Boxes under each node, which are tested at once.
pub(crate) const WIDTH: usize = 4;

/// Quads that one thread fits at a time.
const CHUNK: usize = 1024;

/// Room for the nodes still to be visited: three for each level of a tree of 4^16 primitives, and
/// one.
const DEPTH: usize = 3 * 16 + 1;

/// A box along the axes, in single precision and never smaller than what it holds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub(crate) low: [f32; 3],
    pub(crate) high: [f32; 3],
}

impl Bounds {
    /// The box of some points with so much around.
    pub(crate) fn around<const N: usize>(points: [[f64; 3]; N], margin: f64) -> Bounds {
        let mut bounds = Bounds { low: [0.0; 3], high: [0.0; 3] };
        for k in 0..3 {
            let low = points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
            let high = points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
            // One step out from the nearest number is more than the rounding to it and that of
            // the sum.
            bounds.low[k] = ((low - margin) as f32).next_down();
            bounds.high[k] = ((high + margin) as f32).next_up();
        }
        bounds
    }
}

/// Four boxes side by side.
#[derive(Debug, Clone, Copy)]
struct Quad {
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
}

impl Quad {
    /// Boxes that overlap nothing.
    const EMPTY: Quad =
        Quad { low: [[f32::INFINITY; WIDTH]; 3], high: [[f32::NEG_INFINITY; WIDTH]; 3] };

    fn set(&mut self, lane: usize, bounds: &Bounds) {
        for k in 0..3 {
            self.low[k][lane] = bounds.low[k];
            self.high[k][lane] = bounds.high[k];
        }
    }

    /// The box around all four.
    fn bounds(&self) -> Bounds {
        Bounds {
            low: self.low.map(|four| four.into_iter().fold(f32::INFINITY, f32::min)),
            high: self.high.map(|four| four.into_iter().fold(f32::NEG_INFINITY, f32::max)),
        }
    }

    /// Which of the four overlap a box, as bits.
    fn overlaps(&self, bounds: &Bounds) -> u8 {
        let mut hits = [true; WIDTH];
        for k in 0..3 {
            for (lane, hit) in hits.iter_mut().enumerate() {
                *hit &=
                    (self.low[k][lane] <= bounds.high[k]) & (self.high[k][lane] >= bounds.low[k]);
            }
        }
        hits.iter().rev().fold(0, |bits, &hit| 2 * bits + u8::from(hit))
    }
}

/// A tree of boxes over primitives in a fixed order.
///
/// Implicit and complete: the quad `q` of a level holds the boxes of the quads `4q` to `4q + 3` of
/// the level below, and of those slots at the lowest. Only the boxes change.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tree {
    levels: Vec<Vec<Quad>>,
}

impl Tree {
    /// Takes on the boxes of the primitives in an order.
    pub(crate) fn fit(&mut self, order: &Order, bounds: impl Fn(u32) -> Bounds + Sync) {
        self.levels.resize_with(order.free.len(), Vec::new);
        for (quads, free) in self.levels.iter_mut().zip(&order.free) {
            quads.resize(free.len(), Quad::EMPTY);
        }
        let Some((lowest, above)) = self.levels.split_first_mut() else { return };
        let items = order.items.par_chunks(WIDTH * CHUNK);
        lowest.par_chunks_mut(CHUNK).zip(items).for_each(|(quads, items)| {
            for (quad, items) in quads.iter_mut().zip(items.chunks(WIDTH)) {
                for (lane, &item) in items.iter().enumerate() {
                    quad.set(lane, &bounds(item));
                }
            }
        });
        let mut below: &[Quad] = lowest;
        for level in above {
            for (quad, four) in level.iter_mut().zip(below.chunks(WIDTH)) {
                for (lane, child) in four.iter().enumerate() {
                    quad.set(lane, &child.bounds());
                }
            }
            below = level;
        }
    }

    /// Visits the primitives whose box overlaps a box; if asked so, only where some are free.
    pub(crate) fn visit(&self, order: &Order, query: (&Bounds, bool), mut visit: impl FnMut(u32)) {
        let (bounds, only_free) = query;
        let mut stack = [(0u32, 0u8); DEPTH];
        let Some(top) = self.levels.len().checked_sub(1) else { return };
        if order.items.is_empty() {
            return;
        }
        stack[0] = (0, top as u8);
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let (index, level) = stack[waiting];
            let (index, level) = (index as usize, level as usize);
            let mut hits = self.levels[level][index].overlaps(bounds);
            if only_free {
                hits &= order.free[level][index];
            }
            while hits != 0 {
                let child = WIDTH * index + hits.trailing_zeros() as usize;
                hits &= hits - 1;
                if level == 0 {
                    visit(order.items[child]);
                } else {
                    stack[waiting] = (child as u32, level as u8 - 1);
                    waiting += 1;
                }
            }
        }
    }
}
