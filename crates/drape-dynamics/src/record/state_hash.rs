//! Hash of all bits of a state.

use drape_cloth::SeamBendingState;

use crate::world::World;

/// Returns the hash of the positions, velocities and memories of `world`.
pub(crate) fn state_hash(world: &World) -> String {
    let mut hasher = blake3::Hasher::new();
    let state = &world.state;
    for value in state.positions.iter().chain(&state.velocities) {
        hasher.update(&value.to_le_bytes());
    }
    let seams = world.internal.seam_state().into_iter().flat_map(SeamBendingState::memories);
    for memory in state.memories().chain(seams) {
        let [first, second] = memory.friction;
        for value in [memory.position, first, second, memory.peak] {
            hasher.update(&value.to_le_bytes());
        }
    }
    hasher.finalize().to_hex().to_string()
}
