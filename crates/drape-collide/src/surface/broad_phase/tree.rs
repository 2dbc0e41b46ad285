//! Tree of boxes over primitives, four to a node.

use std::borrow::Borrow;

use wide::{f32x4, u32x4};

use crate::surface::geometry::{SpatialOrder, WIDTH};
use crate::threads::*;
use crate::vector::Vector;

/// Number of nodes in a chunk, which one thread handles at a time.
const CHUNK: usize = 1024;

/// Capacity of the stack of nodes to visit: three for each level of a tree over 4^16 primitives,
/// and one.
const DEPTH: usize = 3 * 16 + 1;

/// Returns the lower of `a` and `b`. Positions are checked, so NaN needs no care as in `min`.
fn lower<T: PartialOrd>(a: T, b: T) -> T {
    if b < a { b } else { a }
}

/// Returns the higher of `a` and `b`.
fn higher<T: PartialOrd>(a: T, b: T) -> T {
    if b > a { b } else { a }
}

/// Number of directions of a box.
const DIRECTIONS: usize = 9;

/// Factor of a margin along the diagonals: their length `$\sqrt 2$`, and a little more for the
/// rounding of the sum or difference of two coordinates.
const DIAGONAL: f64 = std::f64::consts::SQRT_2 * (1.0 + 1e-12);

/// Returns the heights of a point along the directions of a box, in m. The directions are the axes
/// `x`, `y`, `z` and the diagonals between every two axes, not normalised.
fn heights([x, y, z]: Vector) -> [f64; DIRECTIONS] {
    [x, y, z, x + y, x - y, y + z, y - z, z + x, z - x]
}

/// Box along nine directions (an 18-DOP \[Klo98\]), in single precision and never smaller than its
/// content.
///
/// For sheets that lie on each other at a slope, boxes along the axes overlap many layers. The
/// diagonals separate the layers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    low: [f32; DIRECTIONS],
    high: [f32; DIRECTIONS],
}

impl Bounds {
    /// Box that overlaps nothing.
    pub(crate) const EMPTY: Bounds =
        Bounds { low: [f32::INFINITY; DIRECTIONS], high: [f32::NEG_INFINITY; DIRECTIONS] };

    /// Returns the box around all boxes in `list`.
    pub(crate) fn union(list: impl IntoIterator<Item = impl Borrow<Bounds>>) -> Bounds {
        let mut all = Bounds::EMPTY;
        for bounds in list {
            let bounds = bounds.borrow();
            for k in 0..DIRECTIONS {
                all.low[k] = lower(all.low[k], bounds.low[k]);
                all.high[k] = higher(all.high[k], bounds.high[k]);
            }
        }
        all
    }

    /// Returns whether this box and `other` overlap.
    pub(crate) fn overlaps(&self, other: &Bounds) -> bool {
        (0..DIRECTIONS).all(|k| self.low[k] <= other.high[k] && self.high[k] >= other.low[k])
    }

    /// Returns the box around `points`, widened by `margin`, in m.
    pub(crate) fn around(points: impl IntoIterator<Item = Vector>, margin: f64) -> Bounds {
        let (mut lows, mut highs) = ([f64::INFINITY; DIRECTIONS], [f64::NEG_INFINITY; DIRECTIONS]);
        for point in points {
            for (k, height) in heights(point).into_iter().enumerate() {
                lows[k] = lower(lows[k], height);
                highs[k] = higher(highs[k], height);
            }
        }
        // One step outward exceeds the rounding to single precision and the rounding of the sum.
        let widening: [f64; DIRECTIONS] =
            std::array::from_fn(|k| if k < 3 { margin } else { DIAGONAL * margin });
        Bounds {
            low: std::array::from_fn(|k| ((lows[k] - widening[k]) as f32).next_down()),
            high: std::array::from_fn(|k| ((highs[k] + widening[k]) as f32).next_up()),
        }
    }
}

/// Four boxes side by side, one in each lane.
#[derive(Debug, Clone, Copy)]
struct Quad {
    low: [f32x4; DIRECTIONS],
    high: [f32x4; DIRECTIONS],
}

impl Quad {
    /// Boxes that overlap nothing.
    const EMPTY: Quad = Quad {
        low: [f32x4::new([f32::INFINITY; WIDTH]); DIRECTIONS],
        high: [f32x4::new([f32::NEG_INFINITY; WIDTH]); DIRECTIONS],
    };

    /// Sets the box in `lane` to `bounds`.
    fn set(&mut self, lane: usize, bounds: &Bounds) {
        for k in 0..DIRECTIONS {
            self.low[k].as_mut_array()[lane] = finite_low(bounds.low[k]);
            self.high[k].as_mut_array()[lane] = finite_high(bounds.high[k]);
        }
    }

    /// Returns the box around all four, as [`Bounds`].
    fn bounds(&self) -> Bounds {
        Bounds {
            low: self.low.map(|four| four.to_array().into_iter().fold(f32::INFINITY, lower)),
            high: self.high.map(|four| four.to_array().into_iter().fold(f32::NEG_INFINITY, higher)),
        }
    }

    /// Returns `bounds` in all four lanes.
    fn splat(bounds: &Bounds) -> Quad {
        Quad {
            low: bounds.low.map(|low| f32x4::splat(finite_low(low))),
            high: bounds.high.map(|high| f32x4::splat(finite_high(high))),
        }
    }

    /// Returns a bit for each lane in which this box and the box of `other` overlap.
    fn overlaps(&self, other: &Quad) -> u8 {
        // The axes alone separate most boxes.
        let along_axes = self.overlaps_along(other, 0)
            & self.overlaps_along(other, 1)
            & self.overlaps_along(other, 2);
        if along_axes.to_bitmask() == 0 {
            return 0;
        }
        let along_all =
            (3..DIRECTIONS).fold(along_axes, |all, k| all & self.overlaps_along(other, k));
        along_all.to_bitmask() as u8
    }

    /// Returns a mask of the lanes in which this box and the box of `other` overlap along direction
    /// `k`.
    #[inline(always)]
    fn overlaps_along(&self, other: &Quad, k: usize) -> f32x4 {
        self.low[k].simd_le(other.high[k]) & self.high[k].simd_ge(other.low[k])
    }
}

/// Returns the lower end of a box. The end of an infinite box is the least number, so that the box
/// does not overlap an empty one.
fn finite_low(low: f32) -> f32 {
    low.max(f32::MIN)
}

/// Returns the higher end of a box, at most the largest number; see [`finite_low`].
fn finite_high(high: f32) -> f32 {
    high.min(f32::MAX)
}

/// Query of a tree for up to four primitives at once.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Probe {
    /// Box of each primitive, empty in unused lanes.
    pub(crate) bounds: [Bounds; WIDTH],
    /// Whether only free primitives are searched.
    pub(crate) only_free: bool,
    /// Number of a primitive, if only later ones are searched.
    pub(crate) after: Option<u32>,
}

/// Tree of boxes over primitives in a fixed order.
///
/// The tree is implicit and complete. Quad `q` of a level holds the boxes of quads `4q` to `4q + 3`
/// of the level below. At the lowest level it holds the boxes of slots `4q` to `4q + 3`. Only the
/// boxes change.
#[derive(Debug, Clone, Default)]
pub(crate) struct BoxTree {
    levels: Vec<Vec<Quad>>,
}

impl BoxTree {
    /// Fits the boxes to the `bounds` of the primitives in `order`. With `keeps_bodies`, the boxes
    /// of bodies from the last fit are still valid, and `order` is unchanged.
    pub(crate) fn fit(
        &mut self,
        order: &SpatialOrder,
        keeps_bodies: bool,
        bounds: impl Fn(u32) -> Bounds + Sync,
    ) {
        self.levels.resize_with(order.free.len(), Vec::new);
        for (quads, free) in self.levels.iter_mut().zip(&order.free) {
            quads.resize(free.len(), Quad::EMPTY);
        }
        let Some((lowest, above)) = self.levels.split_first_mut() else { return };

        // The lowest level holds the boxes of the slots.
        let items = order.items.par_chunks(WIDTH * CHUNK);
        let parts = lowest.par_chunks_mut(CHUNK).zip(items).zip(order.free[0].par_chunks(CHUNK));
        parts.for_each(|((quads, items), free)| {
            let quads = quads.iter_mut().zip(items.chunks(WIDTH)).zip(free);
            for ((quad, items), _) in quads.filter(|(_, free)| !keeps_bodies || **free != 0) {
                for (lane, &item) in items.iter().enumerate() {
                    quad.set(lane, &bounds(item));
                }
            }
        });

        // Each level above holds the boxes of the level below.
        let mut below: &[Quad] = lowest;
        for (level, free) in above.iter_mut().zip(&order.free[1..]) {
            let quads = level.iter_mut().zip(below.chunks(WIDTH)).zip(free);
            for ((quad, four), _) in quads.filter(|(_, free)| !keeps_bodies || **free != 0) {
                for (lane, child) in four.iter().enumerate() {
                    quad.set(lane, &child.bounds());
                }
            }
            below = level;
        }
    }

    /// Returns a box around all free primitives in `order`.
    pub(crate) fn free_bounds(&self, order: &SpatialOrder) -> Bounds {
        let Some(lowest) = self.levels.first() else { return Bounds::EMPTY };
        let quads = lowest.iter().zip(&order.free[0]).filter(|(_, free)| **free != 0);
        Bounds::union(quads.map(|(quad, _)| quad.bounds()))
    }

    /// Calls `visit` with a lane of `probe` and a slot for all slots of primitives whose box
    /// overlaps the box in the lane. Primitives that `probe` does not search may be among them.
    pub(crate) fn visit(
        &self,
        order: &SpatialOrder,
        probe: &Probe,
        mut visit: impl FnMut(usize, usize),
    ) {
        let all = Quad::splat(&Bounds::union(probe.bounds));
        let each = probe.bounds.map(|bounds| Quad::splat(&bounds));
        let after = probe.after.map(u32x4::splat);
        let mut stack = [(0u32, 0u8); DEPTH];
        let Some(top) = self.levels.len().checked_sub(1) else { return };
        if order.items.is_empty() {
            return;
        }

        // From the top node down, nodes whose boxes overlap the union of the probe's boxes are
        // stacked. At the lowest level the boxes of the lanes decide.
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

/// Returns the values of `item` for the first `count` lanes, and `rest` in the others.
pub(crate) fn fill_lanes<T: Copy>(count: usize, rest: T, item: impl Fn(usize) -> T) -> [T; WIDTH] {
    std::array::from_fn(|k| if k < count { item(k) } else { rest })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{add, cross, norm, scale};

    #[test]
    fn boxes_overlap_where_points_are_as_near_as_their_margins() {
        // Along the axes and the diagonals a box is tight.
        let signs = [-1.0, 0.0, 1.0];
        let directions = signs.iter().flat_map(|x| signs.iter().map(move |y| [*x, *y]));
        let directions = directions.flat_map(|[x, y]| signs.iter().map(move |z| [x, y, *z]));
        for direction in directions.filter(|direction| norm(*direction) > 0.0) {
            for margin in [1e-9, 7e-4, 0.3] {
                for place in [[0.0; 3], [0.3, -0.1, 1e-3], [1e4, 3e5 + 0.1, -7e2]] {
                    let apart = scale(direction, (1.0 - 1e-13) * 2.0 * margin / norm(direction));
                    let [one, other] =
                        [place, add(place, apart)].map(|point| Bounds::around([point], margin));
                    assert!(one.overlaps(&other), "{direction:?} {margin} {place:?}");
                    assert_eq!(Quad::splat(&one).overlaps(&Quad::splat(&other)), 0xf);
                }
            }
        }
    }

    #[test]
    fn an_infinite_box_overlaps_no_empty_one() {
        let all =
            Bounds { low: [f32::NEG_INFINITY; DIRECTIONS], high: [f32::INFINITY; DIRECTIONS] };
        assert_eq!(Quad::splat(&all).overlaps(&Quad::EMPTY), 0);
        let mut quad = Quad::EMPTY;
        quad.set(2, &all);
        assert_eq!(Quad::splat(&Bounds::EMPTY).overlaps(&quad), 0);
        let point = Bounds::around([[1e30, -2.0, 0.0]], 1e-3);
        assert_eq!(Quad::splat(&all).overlaps(&Quad::splat(&point)), 0xf);
    }

    #[test]
    fn boxes_of_layers_on_a_slope_part_where_those_along_the_axes_overlap() {
        // Cells of 10 mm on a slope of 45°, one 3 mm off the other, with margins of 1 mm.
        for tilt in [[1.0, 1.0, 0.0], [0.0, 1.0, -1.0], [-1.0, 0.0, 1.0]] {
            let normal = scale(tilt, 0.5_f64.sqrt());
            let level = cross(normal, [0.36, 0.48, 0.8]);
            let level = scale(level, 1.0 / norm(level));
            let steep = cross(normal, level);
            let layer = |height: f64| {
                let corner = |[u, v]: [f64; 2]| add(scale(level, u), scale(steep, v));
                let corners = [[0.0, 0.0], [0.01, 0.0], [0.01, 0.01], [0.0, 0.01]].map(corner);
                Bounds::around(corners.map(|own| add(own, scale(normal, height))), 1e-3)
            };
            let [low, high] = [0.0, 3e-3].map(layer);
            let along_axes =
                (0..3).all(|k| low.low[k] <= high.high[k] && low.high[k] >= high.low[k]);
            assert!(along_axes && !low.overlaps(&high), "{tilt:?}");
        }
    }
}
