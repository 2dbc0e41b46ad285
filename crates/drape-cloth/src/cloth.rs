//! The cloth: constant data of all panels, and what is measured on a state.

use drape_fabric::{Fabric, Memories};

use crate::layout::connectors::BendingConnectors;
use crate::layout::grid::{GridPanel, PanelStart, Yarns};
use crate::layout::sparsity::Sparsity;
use crate::layout::strip::Strip;
use crate::measure::triangle_strain::TriangleStrain;
use crate::measure::vector::vector_at;
use crate::measure::yarn_tangent::{YarnTangent, surface_normal, yarn_tangents};
use crate::panel::lattice::Lattice;
use crate::rim::connectors::{Rim, RimStart};
use crate::rim::neighbourhood::Neighbourhoods;
use crate::seam::description::Tie;
use crate::state::State;

/// Cloth: particles joined by traction, shear and bending connectors. Constant in time.
///
/// A connector is a measure `$s$` (a strain of a few particles) × a law `$T$` of the fabric × the
/// area `$W$` of cloth that it stands for. Its forces are the negative derivatives of area times
/// work density,
///
/// ```math
/// f_i = -W\,T(s)\,\frac{\partial s}{\partial x_i}
/// ```
///
/// which conserves momentum exactly and does not depend on the spacing of the particles. The forces
/// of \[NB04, eqs. 4–5\] agree with it to first order if their lever arm is the length of a yarn
/// segment.
///
/// ```
/// use drape_cloth::{Cloth, Lattice};
/// # let text = r#"
/// #     name = "plain"
/// #     density = 0.12
/// #     thickness = 0.0003
/// #     shear.stiffness = 35
/// #     [warp]
/// #     traction.polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
/// #     bending.rigidity = 1.2e-5
/// #     [weft]
/// #     traction.polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
/// #     bending.rigidity = 0.8e-5
/// # "#;
/// # let document = drape_input::Document::new("plain.toml", text);
/// # let fabric = drape_fabric::Fabric::from_document(&document)?;
/// let lattice = Lattice::rectangle(0.2, 0.3, 0.01)?;
/// let cloth = Cloth::new(&[(&lattice, &fabric)]);
/// // Every kind of connector stands for the whole panel.
/// let areas = cloth.connector_areas();
/// assert!((areas.shear - 0.06).abs() < 1e-12 && (areas.bending[0] - 0.06).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Cloth {
    masses: Vec<f64>,
    areas: Vec<f64>,
    spacings: Vec<f64>,
    coordinates: Vec<[f64; 2]>,
    triangles: Vec<[u32; 3]>,
    tangents: Vec<[YarnTangent; 2]>,
    /// First particle of each panel.
    starts: Vec<usize>,
    /// Grids of the panels; a graded panel has several.
    pub(crate) panels: Vec<GridPanel>,
    pub(crate) strips: Vec<Strip>,
    pub(crate) rims: Vec<Rim>,
    sparsity: Sparsity,
}

/// Areas that the connectors of each kind stand for; each is the area of the cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Areas {
    /// Area of the segments along warp and along weft, in m².
    pub traction: [f64; 2],
    /// Area of the corners, in m².
    pub shear: f64,
    /// Area of the triples along warp and along weft, in m².
    pub bending: [f64; 2],
}

/// Deformation of a cloth: extremes and percentiles over its connectors.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Strains {
    /// Largest strain of a segment, a ratio.
    pub traction_max: f64,
    /// 99th percentile of the strains of the segments, a ratio.
    pub traction_p99: f64,
    /// Largest shear angle of a corner, in rad.
    pub shear_max: f64,
    /// 99th percentile of the curvatures of the triples, in 1/m.
    pub curvature_p99: f64,
}

impl Cloth {
    /// Returns a cloth of panels, each with its fabric; the particles are numbered panel by panel.
    #[must_use]
    pub fn new(panels: &[(&Lattice, &Fabric)]) -> Self {
        let mut cloth = Self {
            masses: Vec::new(),
            areas: Vec::new(),
            spacings: Vec::new(),
            coordinates: Vec::new(),
            triangles: Vec::new(),
            tangents: Vec::new(),
            starts: Vec::new(),
            panels: Vec::new(),
            strips: Vec::new(),
            rims: Vec::new(),
            sparsity: Sparsity::default(),
        };
        panels.iter().for_each(|(lattice, fabric)| cloth.add_panel(lattice, fabric));
        let pairs = cloth.panels.iter().flat_map(GridPanel::pairs);
        let pairs = pairs.chain(cloth.rims.iter().flat_map(Rim::pairs));
        cloth.sparsity = Sparsity::new(cloth.particles(), pairs);
        for (index, panel) in cloth.panels.iter_mut().enumerate() {
            panel.find_slots(&cloth.sparsity);
            Strip::append(&mut cloth.strips, panel, index, &cloth.sparsity);
        }
        cloth.rims.iter_mut().for_each(|rim| rim.find_slots(&cloth.sparsity));
        cloth
    }

    fn add_panel(&mut self, lattice: &Lattice, fabric: &Fabric) {
        let first = self.particles() as u32;
        self.starts.push(first as usize);
        let areas = lattice.areas();
        let neighbourhoods = Neighbourhoods::of(lattice);
        let bending = BendingConnectors::of(lattice, &areas, neighbourhoods.is_some());
        if let Some(neighbourhoods) = &neighbourhoods {
            let start = RimStart {
                index: self.rims.len(),
                panel: self.panels.len(),
                particle: first,
                triangles: self.rims.last().map_or(0, Rim::triangles_end),
                stencils: self.rims.last().map_or(0, Rim::stencils_end),
            };
            self.rims.push(Rim::new(lattice, start, &bending, neighbourhoods));
        }
        let tangents = yarn_tangents(&lattice.yarns(), first, areas.len());
        self.tangents.extend(tangents);
        for grid in &lattice.grids {
            let base = self.panels.iter().map(GridPanel::length).sum();
            let start = PanelStart { particle: first, base };
            self.panels.push(GridPanel::new((lattice, grid), fabric, start, &bending));
        }
        let areas_of_mass = lattice.areas_of_mass(&areas);
        self.masses.extend(areas_of_mass.iter().map(|area| area * fabric.density));
        self.spacings.extend(lattice.spacings());
        self.coordinates.extend(&lattice.coordinates);
        self.triangles.extend(lattice.triangles().iter().map(|t| t.map(|p| first + p)));
        self.areas.extend(areas);
    }

    /// Returns the cloth with the masses of tied particles moved to the two particles that each
    /// lies between; their sum and their centre stay.
    #[must_use]
    pub fn with_ties<'a>(mut self, ties: impl IntoIterator<Item = &'a Tie>) -> Self {
        for &Tie { particle, ends, fraction } in ties {
            let mass = std::mem::take(&mut self.masses[particle as usize]);
            for (end, part) in ends.into_iter().zip([1.0 - fraction, fraction]) {
                self.masses[end as usize] += part * mass;
            }
        }
        self
    }

    /// Number of particles.
    #[must_use]
    pub fn particles(&self) -> usize {
        self.masses.len()
    }

    /// Masses of the particles, in kg: of their areas and of allowances.
    #[must_use]
    pub fn masses(&self) -> &[f64] {
        &self.masses
    }

    /// Areas of the particles, in m².
    #[must_use]
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// Spacings of the grids that the particles are on, in m.
    #[must_use]
    pub fn spacings(&self) -> &[f64] {
        &self.spacings
    }

    /// Material coordinates of the particles (u along the weft, v along the warp), in m.
    #[must_use]
    pub fn coordinates(&self) -> &[[f64; 2]] {
        &self.coordinates
    }

    /// First particle of each panel.
    #[must_use]
    pub fn panel_starts(&self) -> &[usize] {
        &self.starts
    }

    /// Triangles of the surface.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Sparsity of the stiffness: the pairs of particles that a connector joins.
    #[must_use]
    pub fn sparsity(&self) -> &Sparsity {
        &self.sparsity
    }

    /// Returns the areas that the connectors of each kind stand for.
    #[must_use]
    pub fn connector_areas(&self) -> Areas {
        let sum = |column: fn(&GridPanel, usize) -> &[f64], which: usize| -> f64 {
            self.panels.iter().flat_map(|p| column(p, which)).sum()
        };
        let traction = |d| sum(|panel, d| &panel.yarns[d].segment_areas, d);
        let bending = |d| sum(|panel, d| &panel.yarns[d].triple_areas, d);
        let triangles: f64 = self.rims.iter().flat_map(|rim| &rim.triangles.areas).sum();
        let stencils =
            |d: usize| -> f64 { self.rims.iter().flat_map(|rim| &rim.stencils.areas[d]).sum() };
        Areas {
            traction: [0, 1].map(|d| traction(d) + triangles),
            shear: (0..4).map(|c| sum(|panel, c| &panel.corner_areas[c], c)).sum::<f64>()
                + triangles,
            bending: [0, 1].map(|d| bending(d) + stencils(d)),
        }
    }

    /// Returns the deformation of a state, from the memories of its connectors.
    #[must_use]
    pub fn strains(&self, state: &State) -> Strains {
        let (mut traction, mut shear, mut curvature) = (Vec::new(), Vec::new(), Vec::new());
        let State { grid, rim, .. } = state;
        for panel in &self.panels {
            let at = |memories: &Memories, indices: &[usize], map: fn(f64) -> f64| -> Vec<f64> {
                let positions = &memories.positions()[panel.base..];
                indices.iter().map(|&index| map(positions[index])).collect()
            };
            for (direction, Yarns { segments, triples, .. }) in panel.yarns.iter().enumerate() {
                traction.extend(at(&grid.traction[direction], segments, |s| s));
                curvature.extend(at(&grid.bending[direction], triples, f64::abs));
            }
            for memories in &grid.shear {
                shear.extend(at(memories, &panel.cells, f64::abs));
            }
        }
        for Rim { triangles, stencils, .. } in &self.rims {
            for direction in 0..2 {
                let positions = &rim.traction[direction].positions()[triangles.base..];
                traction.extend(&positions[..triangles.count]);
                let curvatures = rim.bending[direction].positions()[stencils.base..].iter();
                let areas = &stencils.areas[direction];
                let curvatures = curvatures.zip(areas).filter(|(_, area)| **area > 0.0);
                curvature.extend(curvatures.map(|(curvature, _)| curvature.abs()));
            }
            let sines = &rim.shear.positions()[triangles.base..][..triangles.count];
            shear.extend(sines.iter().map(|sine| sine.abs()));
        }
        let [traction, shear, curvature] = [traction, shear, curvature].map(|mut values| {
            values.sort_by(f64::total_cmp);
            values
        });
        let p99 = |values: &[f64]| values[(values.len() - 1) * 99 / 100];
        Strains {
            traction_max: traction[traction.len() - 1],
            traction_p99: p99(&traction),
            shear_max: shear[shear.len() - 1].min(1.0).asin(),
            curvature_p99: p99(&curvature),
        }
    }

    /// Returns the strains of the triangles of the surface, in their order, at positions of the
    /// particles (three numbers each, in m).
    ///
    /// # Panics
    /// If positions of some particles are missing.
    #[must_use]
    pub fn triangle_strains(&self, positions: &[f64]) -> Vec<TriangleStrain> {
        let strain = |triangle: &[u32; 3]| {
            let coordinates = triangle.map(|particle| self.coordinates[particle as usize]);
            TriangleStrain::of(coordinates, triangle.map(|p| vector_at(positions, p)))
        };
        self.triangles.iter().map(strain).collect()
    }

    /// Computes the normals of the surface at the positions of the state.
    pub(crate) fn update_normals(&self, state: &mut State) {
        let positions = &state.positions;
        let normals = state.normals.chunks_exact_mut(3);
        for (normal, [warp, weft]) in normals.zip(&self.tangents) {
            normal.copy_from_slice(&surface_normal([warp.at(positions), weft.at(positions)]));
        }
        for tangents in self.rims.iter().flat_map(|rim| &rim.tangents) {
            let normal = surface_normal(tangents.at(positions));
            state.normals[3 * tangents.particle as usize..][..3].copy_from_slice(&normal);
        }
        for panel in &self.panels {
            for (point, _) in panel.occupied.iter().enumerate().filter(|(_, o)| **o) {
                let index = panel.margin + point;
                let normal = vector_at(&state.normals, panel.particles[index]);
                state.grid.normals.set(panel.base + index, normal);
            }
        }
    }
}
