//! Garments of a scene, and how they are sewn.

use std::collections::BTreeMap;
use std::ops::Range;

use drape_cloth::{Cloth, SeamBending};

use crate::scene::seam::{Seam, SeamPairs};

/// Garment of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Garment {
    /// Name, or the name of the file of the pattern.
    pub name: String,
    /// Its particles.
    pub particles: Range<usize>,
    /// Heights at which girth and ease are measured, in m, by the names that the scene gives them.
    pub measured_heights: BTreeMap<String, f64>,
}

/// Sewing of the garments of a scene before they hang: the sides of all seams are drawn together,
/// without gravity and inertia, and their particles are then merged.
#[derive(Debug, Clone)]
pub struct Sewing {
    /// Seams.
    pub seams: Vec<Seam>,
    /// Pairs and ties of all seams.
    pub pairs: SeamPairs,
    /// Cloth while it is sewn: its laws have no friction, so that the closing of the seams is no
    /// history.
    pub cloth: Cloth,
    /// Time until the seams are to be closed, in s.
    pub seconds: f64,
    /// Bending across the closed seams.
    pub bending: SeamBending,
}
