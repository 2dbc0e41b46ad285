//! Tree of boxes over primitives, four to a node.

use std::borrow::Borrow;

use rayon::prelude::*;
use wide::{f32x4, u32x4};

use crate::surface::geometry::{Order, WIDTH};
use crate::vector::Vector;

/// Number of nodes of a chunk, for one thread at a time.
const CHUNK: usize = 1024;

/// Capacity of the stack of nodes still to be visited: three for each level of a tree of 4^16
/// primitives, and one.
const DEPTH: usize = 3 * 16 + 1;

/// Returns the lower of two numbers; `min` would also handle NaN, but positions are checked.
fn lower<T: PartialOrd>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// Returns the higher of two numbers.
fn higher<T: PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

/// Box along the axes, in single precision and never smaller than what it encloses.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub(crate) low: [f32; 3],
    pub(crate) high: [f32; 3],
}

impl Bounds {
    /// Box that overlaps nothing.
    pub(crate) const EMPTY: Bounds =
        Bounds { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// Returns the box around several.
    pub(crate) fn union(list: impl IntoIterator<Item = impl Borrow<Bounds>>) -> Bounds {
        let mut all = Bounds::EMPTY;
        for bounds in list {
            let bounds = bounds.borrow();
            for k in 0..3 {
                all.low[k] = lower(all.low[k], bounds.low[k]);
                all.high[k] = higher(all.high[k], bounds.high[k]);
            }
        }
        all
    }

    /// Returns whether two boxes overlap.
    pub(crate) fn overlaps(&self, other: &Bounds) -> bool {
        (0..3).all(|k| self.low[k] <= other.high[k] && self.high[k] >= other.low[k])
    }

    /// Returns the box of some points, widened by a margin, in m.
    pub(crate) fn around(points: impl IntoIterator<Item = Vector>, margin: f64) -> Bounds {
        let (mut lows, mut highs) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for point in points {
            for k in 0..3 {
                lows[k] = lower(lows[k], point[k]);
                highs[k] = higher(highs[k], point[k]);
            }
        }
        // One step outward exceeds the rounding to single precision and that of the sum.
        Bounds {
            low: lows.map(|low| ((low - margin) as f32).next_down()),
            high: highs.map(|high| ((high + margin) as f32).next_up()),
        }
    }
}

/// Four boxes side by side.
#[derive(Debug, Clone, Copy)]
struct Quad {
    low: [f32x4; 3],
    high: [f32x4; 3],
}

impl Quad {
    /// Boxes that overlap nothing.
    const EMPTY: Quad = Quad {
        low: [f32x4::new([f32::INFINITY; WIDTH]); 3],
        high: [f32x4::new([f32::NEG_INFINITY; WIDTH]); 3],
    };

    /// Sets the box of a lane.
    fn set(&mut self, lane: usize, bounds: &Bounds) {
        for k in 0..3 {
            self.low[k].as_mut_array()[lane] = bounds.low[k];
            self.high[k].as_mut_array()[lane] = bounds.high[k];
        }
    }

    /// Returns the box around all four.
    fn bounds(&self) -> Bounds {
        Bounds {
            low: self.low.map(|four| four.to_array().into_iter().fold(f32::INFINITY, lower)),
            high: self.high.map(|four| four.to_array().into_iter().fold(f32::NEG_INFINITY, higher)),
        }
    }

    /// Returns one box in all four lanes.
    fn splat(bounds: &Bounds) -> Quad {
        Quad { low: bounds.low.map(f32x4::splat), high: bounds.high.map(f32x4::splat) }
    }

    /// Returns, as bits, which of the four overlap the box in their lane.
    fn overlaps(&self, other: &Quad) -> u8 {
        let meet =
            |k: usize| self.low[k].simd_le(other.high[k]) & self.high[k].simd_ge(other.low[k]);
        (meet(0) & meet(1) & meet(2)).to_bitmask() as u8
    }
}

/// Query of a tree: up to four primitives at once.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Probe {
    /// Box of each primitive; an empty one in lanes that are not used.
    pub(crate) bounds: [Bounds; WIDTH],
    /// Whether only free primitives are searched.
    pub(crate) only_free: bool,
    /// Number of a primitive; only later ones are searched.
    pub(crate) after: Option<u32>,
}

/// Tree of boxes over primitives in a fixed order.
///
/// It is implicit and complete: the quad `q` of a level has the boxes of the quads `4q` to `4q + 3`
/// of the level below, and of those slots at the lowest. Only the boxes change.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tree {
    levels: Vec<Vec<Quad>>,
}

impl Tree {
    /// Refits the boxes to the primitives in an order; with `keeps_bodies` those of bodies are as
    /// last time, in the same order.
    pub(crate) fn fit(
        &mut self,
        order: &Order,
        keeps_bodies: bool,
        bounds: impl Fn(u32) -> Bounds + Sync,
    ) {
        self.levels.resize_with(order.free.len(), Vec::new);
        for (quads, free) in self.levels.iter_mut().zip(&order.free) {
            quads.resize(free.len(), Quad::EMPTY);
        }
        let Some((lowest, above)) = self.levels.split_first_mut() else { return };
        let changes = |free: &u8| !keeps_bodies || *free != 0;
        let items = order.items.par_chunks(WIDTH * CHUNK);
        let parts = lowest.par_chunks_mut(CHUNK).zip(items).zip(order.free[0].par_chunks(CHUNK));
        parts.for_each(|((quads, items), free)| {
            let quads = quads.iter_mut().zip(items.chunks(WIDTH)).zip(free);
            for ((quad, items), _) in quads.filter(|(_, free)| changes(free)) {
                for (lane, &item) in items.iter().enumerate() {
                    quad.set(lane, &bounds(item));
                }
            }
        });
        let mut below: &[Quad] = lowest;
        for (level, free) in above.iter_mut().zip(&order.free[1..]) {
            let quads = level.iter_mut().zip(below.chunks(WIDTH)).zip(free);
            for ((quad, four), _) in quads.filter(|(_, free)| changes(free)) {
                for (lane, child) in four.iter().enumerate() {
                    quad.set(lane, &child.bounds());
                }
            }
            below = level;
        }
    }

    /// Returns a box around all free primitives.
    pub(crate) fn free_bounds(&self, order: &Order) -> Bounds {
        let Some(lowest) = self.levels.first() else { return Bounds::EMPTY };
        let quads = lowest.iter().zip(&order.free[0]).filter(|(_, free)| **free != 0);
        Bounds::union(quads.map(|(quad, _)| quad.bounds()))
    }

    /// Visits the slots of primitives whose box overlaps one of the probe's, with the lane of that.
    ///
    /// Primitives that the probe does not search may be among them.
    pub(crate) fn visit(&self, order: &Order, probe: &Probe, mut visit: impl FnMut(usize, usize)) {
        let all = Quad::splat(&Bounds::union(probe.bounds));
        let each = probe.bounds.map(|bounds| Quad::splat(&bounds));
        let after = probe.after.map(u32x4::splat);
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
            let quad = &self.levels[level][index];
            let mut searched = 0xff;
            if probe.only_free {
                searched &= order.free[level][index];
            }
            if let Some(after) = after {
                let last = u32x4::new(order.last[level][index]);
                searched &= last.simd_gt(after).to_bitmask() as u8;
            }
            if level == 0 {
                for (k, bounds) in each.iter().enumerate() {
                    let mut hits = searched & quad.overlaps(bounds);
                    while hits != 0 {
                        visit(k, WIDTH * index + hits.trailing_zeros() as usize);
                        hits &= hits - 1;
                    }
                }
            } else {
                let mut hits = searched & quad.overlaps(&all);
                while hits != 0 {
                    stack[waiting] =
                        ((WIDTH * index) as u32 + hits.trailing_zeros(), level as u8 - 1);
                    waiting += 1;
                    hits &= hits - 1;
                }
            }
        }
    }
}

/// Returns the values of an item function for the first `count` lanes, and `rest` for the others.
pub(crate) fn array<T: Copy>(count: usize, rest: T, item: impl Fn(usize) -> T) -> [T; WIDTH] {
    std::array::from_fn(|k| if k < count { item(k) } else { rest })
}
