//! Fill that a factor without fill drops, and its replacement on the diagonal.

use crate::linear::lane_block::{
    Blocks, SymmetricBlocks, lane_of, symmetric_part, transposed_times,
};
use crate::linear::lanes::{Number, Single};

/// Treatment of the updates that fall outside the sparsity.
#[derive(Clone, Copy, Debug)]
pub(crate) enum DroppedFill {
    /// This fraction of the dropped updates is subtracted from the diagonal.
    ///
    /// With all of it the factor would treat a translation of all particles as the matrix does, and
    /// the number of iterations would grow with the square root of the number of particles across
    /// (\[Gus78\], for scalars); but then pivots collapse. On hung cloth of 2500 and 10 000
    /// particles, 0.95 took 27 % and 39 % fewer iterations than 0; on 40 000 particles that swing,
    /// steps took 54, 51, 50, 79 and 157 iterations with 0.95, 0.97, 0.98, 0.99 and 1.
    Compensated(f64),
    /// This fraction of a bound of the dropped updates is added to the diagonal.
    ///
    /// With all of it the matrix that is factorised is the given one plus a positive one, and the
    /// pivots of a definite matrix are positive (\[AJ84\], for scalars).
    Stabilised(f64),
}

impl DroppedFill {
    /// Blocks to subtract from the pivots of both columns in place of a dropped update.
    #[inline(always)]
    pub(crate) fn replacement<T: Number>(self, update: &DroppedUpdate<'_, T>) -> Replacement<T> {
        let DroppedUpdate { left, right, left_square, right_square } = update;
        match self {
            DroppedFill::Compensated(part) => {
                let half = times(symmetric_part(&transposed_times(left, right)), T::of(part));
                Replacement { left: half, right: half }
            }
            DroppedFill::Stabilised(part) => Replacement {
                left: left_square.against(right_square, part),
                right: right_square.against(left_square, part),
            },
        }
    }
}

/// Update `leftᵀ D⁻¹ right` of two blocks of a row that is dropped.
pub(crate) struct DroppedUpdate<'a, T> {
    /// Block of the left column.
    pub left: &'a Blocks<T>,
    /// Block of the right column, already times `D⁻¹`.
    pub right: &'a Blocks<T>,
    /// Blocks that both subtract from the pivots of their own columns.
    pub left_square: &'a Square<T>,
    pub right_square: &'a Square<T>,
}

/// Blocks that are subtracted from the pivots of two columns.
pub(crate) struct Replacement<T> {
    pub left: SymmetricBlocks<T>,
    pub right: SymmetricBlocks<T>,
}

/// Blocks times a factor.
#[inline(always)]
fn times<T: Number>(mut blocks: SymmetricBlocks<T>, factor: T) -> SymmetricBlocks<T> {
    for entry in &mut blocks {
        *entry = *entry * factor;
    }
    blocks
}

/// Positive semi-definite blocks `Sᵀ D⁻¹ S` that a row subtracts from the pivot of a column.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Square<T> {
    pub blocks: SymmetricBlocks<T>,
    /// Root of the trace and its inverse; 0 where the block is. Only stabilisation needs them.
    size: T,
    inverse: T,
}

impl<T: Number> Square<T> {
    #[inline(always)]
    pub(crate) fn new(blocks: SymmetricBlocks<T>, fill: DroppedFill) -> Self {
        let [size, inverse] = match fill {
            DroppedFill::Compensated(_) => [T::of(0.0); 2],
            DroppedFill::Stabilised(_) => (blocks[0] + blocks[3] + blocks[5]).root_and_inverse(),
        };
        Self { blocks, size, inverse }
    }

    /// Block to subtract from the pivot of this square for a dropped update with another one; it is
    /// negative.
    ///
    /// Both squares with the dropped blocks beside them would be positive, and stay so if one is
    /// scaled up and the other down, here to the same size.
    #[inline(always)]
    fn against(&self, other: &Self, part: f64) -> SymmetricBlocks<T> {
        times(self.blocks, T::of(-part) * (other.size * self.inverse))
    }
}

impl Square<Single> {
    /// Square of one lane.
    #[inline(always)]
    pub(crate) fn lane(&self, lane: u32) -> Square<f32> {
        let [size, inverse] = lane_of(&[self.size, self.inverse], lane);
        Square { blocks: lane_of(&self.blocks, lane), size, inverse }
    }
}
