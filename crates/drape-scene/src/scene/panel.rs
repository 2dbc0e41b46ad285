//! Panels of a scene.

use std::ops::Range;

use drape_cloth::Lattice;

/// Panel of a scene.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Name in the scene.
    pub name: String,
    /// Index of its fabric.
    pub material: usize,
    /// Its particles before deformation.
    pub lattice: Lattice,
    /// Number of its first particle.
    pub first: usize,
    /// Named edges of a panel of a garment.
    pub edges: Vec<PanelEdge>,
    /// Layer in which it is worn: panels of a higher layer start outside panels of a lower layer.
    pub layer: u32,
}

/// Named edge of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelEdge {
    /// Name in the pattern.
    pub name: String,
    /// Numbers of its particles in the panel, in their order.
    pub nodes: Vec<u32>,
}

impl Panel {
    /// Returns the numbers of its particles.
    #[must_use]
    pub fn particles(&self) -> Range<usize> {
        self.first..self.first + self.lattice.coordinates().len()
    }
}
