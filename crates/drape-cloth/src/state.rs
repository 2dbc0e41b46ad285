use drape_fabric::{Memories, Memory};

use crate::field::Field;
use crate::panel::Panel;

/// Where a cloth is and what its yarns remember: everything that changes in time.
///
/// Vectors are flat: particle `i` has the numbers `3i`, `3i + 1`, `3i + 2`. The memory is written by
/// [`Cloth::commit`](crate::Cloth::commit) alone.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Positions of the particles, in m.
    pub positions: Vec<f64>,
    /// Velocities of the particles, in m/s.
    pub velocities: Vec<f64>,
    /// Unit normals of the surface at the particles.
    pub(crate) normals: Vec<f64>,
    pub(crate) panels: Vec<PanelState>,
}

/// Memories of a panel's connectors in the panel's columns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PanelState {
    /// Of the segments along the warp and the weft.
    pub(crate) traction: [Memories; 2],
    /// Of the four corners of the cells.
    pub(crate) shear: [Memories; 4],
    /// Of the triples along the warp and the weft.
    pub(crate) bending: [Memories; 2],
    /// Unit normals, as in [`State::normals`].
    pub(crate) normals: Field,
}

impl PanelState {
    /// Memories of a virgin panel.
    pub(crate) fn new(panel: &Panel) -> Self {
        let [warp, weft] = &panel.yarns;
        let length = panel.length();
        let corner = || Memories::new(&panel.shear, length);
        Self {
            traction: [warp, weft].map(|yarns| Memories::new(&yarns.traction, length)),
            shear: [corner(), corner(), corner(), corner()],
            bending: [warp, weft].map(|yarns| Memories::new(&yarns.bending, length)),
            normals: Field::new(length),
        }
    }
}

impl State {
    /// Unit normals of the surface at the particles, along `$u \times v$`.
    #[must_use]
    pub fn normals(&self) -> &[f64] {
        &self.normals
    }

    /// All memories, for hashing and comparing, in a fixed order. Where there is no connector, as at
    /// the end of a row, the memory is that of a virgin one.
    pub fn memories(&self) -> impl Iterator<Item = Memory> {
        self.panels.iter().flat_map(|panel| {
            let sets = panel
                .traction
                .iter()
                .chain(&panel.shear)
                .chain(&panel.bending);
            sets.flat_map(Memories::iter)
        })
    }
}
