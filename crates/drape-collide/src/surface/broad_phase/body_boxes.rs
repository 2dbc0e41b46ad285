//! Boxes of bodies, one for each chunk of runs of primitives: chunks far from all cloth are skipped.

use super::tree::Bounds;
use crate::surface::geometry::Run;

/// Box of each chunk of runs of primitives; none for chunks with free ones.
#[derive(Debug, Clone, Default)]
pub(crate) struct BodyBoxes {
    boxes: Vec<Option<Bounds>>,
}

impl BodyBoxes {
    /// Refits the boxes to chunks, unless they are kept. `is_free` tells whether a primitive is free,
    /// `bounds` is its box.
    pub(crate) fn fit(
        &mut self,
        chunks: std::slice::Chunks<'_, Run>,
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

    /// Returns whether a chunk may be near a box around all free primitives.
    pub(crate) fn may_meet(&self, chunk: usize, free: &Bounds) -> bool {
        self.boxes[chunk].is_none_or(|bounds| bounds.overlaps(free))
    }
}
