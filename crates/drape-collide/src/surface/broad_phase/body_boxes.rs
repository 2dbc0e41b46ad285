//! Boxes of bodies, one for each chunk of primitive runs. Chunks far from all cloth are skipped.

use super::tree::Bounds;
use crate::surface::geometry::PrimitiveRun;

/// Box of each chunk of primitive runs, `None` for chunks with free primitives.
#[derive(Debug, Clone, Default)]
pub(crate) struct BodyBoxes {
    boxes: Vec<Option<Bounds>>,
}

impl BodyBoxes {
    /// Fits the boxes to `chunks`, unless `keeps_bodies` is set and they exist. `is_free` tells
    /// whether a primitive is free, `bounds` returns its box.
    pub(crate) fn fit(
        &mut self,
        chunks: std::slice::Chunks<'_, PrimitiveRun>,
        keeps_bodies: bool,
        is_free: impl Fn(u32) -> bool,
        bounds: impl Fn(u32) -> Bounds,
    ) {
        if keeps_bodies && self.boxes.len() == chunks.len() {
            return;
        }
        self.boxes.clear();
        self.boxes.extend(chunks.map(|runs| {
            if runs.iter().any(|run| is_free(run.first)) {
                return None;
            }
            let items = runs.iter().flat_map(|run| run.first..run.first + run.count as u32);
            Some(Bounds::union(items.map(&bounds)))
        }));
    }

    /// Returns whether the boxes of `chunk` and `free`, a box around all free primitives, overlap.
    pub(crate) fn may_meet(&self, chunk: usize, free: &Bounds) -> bool {
        self.boxes[chunk].is_none_or(|bounds| bounds.overlaps(free))
    }
}
