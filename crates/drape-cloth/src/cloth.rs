//! The cloth: constant data of all panels, and measures of a state.

use drape_fabric::Fabric;

use crate::error::{Error, check_length};
use crate::layout::connectors::BendingConnectors;
use crate::layout::fingerprint::Fingerprint;
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
/// area `$W$` of cloth that the connector stands for. Its forces are the negative derivatives of
/// area times work density,
///
/// ```math
/// f_i = -W\,T(s)\,\frac{\partial s}{\partial x_i}
/// ```
///
/// which conserves momentum exactly and does not depend on the spacing of the particles. The forces
/// of \[NB04, eqs. 4–5\] agree with them to first order if their lever arm is the length of a yarn
/// segment.
///
/// ```
/// use drape_cloth::{Cloth, Lattice};
/// let fabric = drape_fabric::samples::plain_weave();
/// let lattice = Lattice::rectangle(0.2, 0.3, 0.01)?;
/// let cloth = Cloth::new(&[(&lattice, &fabric)])?;
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
    /// Grids of the panels. A graded panel has several.
    pub(crate) panels: Vec<GridPanel>,
    pub(crate) strips: Vec<Strip>,
    pub(crate) rims: Vec<Rim>,
    sparsity: Sparsity,
    fingerprint: Fingerprint,
}

/// Areas of the connectors of each kind. Each is the area of the whole cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConnectorAreas {
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
    /// Returns a cloth of `panels`, each with its fabric. Particles are numbered panel by panel.
    ///
    /// # Errors
    /// There is no panel, a panel has no area, or a number of a fabric is out of range.
    pub fn new(panels: &[(&Lattice, &Fabric)]) -> Result<Self, Error> {
        check_panels(panels)?;
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
            fingerprint: Fingerprint::new(),
        };
        panels.iter().for_each(|(lattice, fabric)| cloth.add_panel(lattice, fabric));

        // Blocks are known once all connectors are.
        let pairs = cloth.panels.iter().flat_map(GridPanel::pairs);
        let pairs = pairs.chain(cloth.rims.iter().flat_map(Rim::pairs));
        cloth.sparsity = Sparsity::new(cloth.particle_count(), pairs);
        for (index, panel) in cloth.panels.iter_mut().enumerate() {
            panel.find_slots(&cloth.sparsity);
            Strip::append(&mut cloth.strips, panel, index, &cloth.sparsity);
        }
        cloth.rims.iter_mut().for_each(|rim| rim.find_slots(&cloth.sparsity));
        cloth.fingerprint = cloth.take_fingerprint();
        Ok(cloth)
    }

    /// Returns the fingerprint of the layout: of what the state of one cloth may share with no
    /// other cloth.
    fn take_fingerprint(&self) -> Fingerprint {
        let mut fingerprint = Fingerprint::new();
        fingerprint.add(self.starts.iter().map(|&start| start as u64));
        fingerprint
            .add(self.panels.iter().flat_map(|panel| [panel.base, panel.stride]).map(|n| n as u64));
        fingerprint.add(self.triangles.iter().flatten().map(|&particle| u64::from(particle)));
        fingerprint.add(self.coordinates.iter().flatten().map(|coordinate| coordinate.to_bits()));
        fingerprint
    }

    /// Checks that `state` belongs to this cloth and has three numbers for every particle.
    pub(crate) fn check_state(&self, state: &State) -> Result<(), Error> {
        if state.fingerprint != self.fingerprint.number() {
            return Err(Error::OtherCloth { what: "state" });
        }
        self.check_vectors("positions of the state", &state.positions)?;
        self.check_vectors("velocities of the state", &state.velocities)
    }

    /// Checks that the list called `name` has three numbers for every particle.
    pub(crate) fn check_vectors(&self, name: &'static str, numbers: &[f64]) -> Result<(), Error> {
        check_length(name, 3 * self.particle_count(), numbers.len())
    }

    /// Returns the fingerprint, which the states of this cloth share.
    pub(crate) fn fingerprint(&self) -> u64 {
        self.fingerprint.number()
    }

    /// Appends the particles and connectors of a panel of `fabric` with the shape `lattice`.
    fn add_panel(&mut self, lattice: &Lattice, fabric: &Fabric) {
        let first = self.particle_count() as u32;
        self.starts.push(first as usize);
        let areas = lattice.areas();

        // Where a panel has a rim, stencils bend about nodes that are no middle of a triple.
        let neighbourhoods = Neighbourhoods::new(lattice);
        let bending = BendingConnectors::along_yarns(lattice, &areas, neighbourhoods.is_some());
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
        self.tangents.extend(yarn_tangents(&lattice.yarns(), first, areas.len()));

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

    /// Returns the cloth with the masses of tied particles moved to the two particles between which
    /// each of `ties` lies. The sum and the centre of the masses stay.
    ///
    /// # Errors
    /// A tie names a particle that does not exist, or has a fraction outside of 0 to 1.
    pub fn with_ties<'a>(mut self, ties: impl IntoIterator<Item = &'a Tie>) -> Result<Self, Error> {
        for (tie, &Tie { particle, ends, fraction }) in ties.into_iter().enumerate() {
            let mut particles = ends.into_iter().chain([particle]);
            let exist = particles.all(|particle| (particle as usize) < self.masses.len());
            if !exist || !(0.0..=1.0).contains(&fraction) {
                return Err(Error::Tie { tie });
            }
            let mass = std::mem::take(&mut self.masses[particle as usize]);
            for (end, part) in ends.into_iter().zip([1.0 - fraction, fraction]) {
                self.masses[end as usize] += part * mass;
            }
        }
        Ok(self)
    }

    /// Returns the number of particles, each with three coordinates in a [`State`].
    #[must_use]
    pub fn particle_count(&self) -> usize {
        self.masses.len()
    }

    /// Returns the masses of the particles, in kg, including [allowances](crate::Allowance).
    #[must_use]
    pub fn masses(&self) -> &[f64] {
        &self.masses
    }

    /// Returns the areas of the particles, in m², without [allowances](crate::Allowance).
    #[must_use]
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// Returns for each particle the spacing of its grid, in m.
    #[must_use]
    pub fn spacings(&self) -> &[f64] {
        &self.spacings
    }

    /// Returns the material coordinates of the particles (`u` along the weft, `v` along the warp),
    /// in m.
    #[must_use]
    pub fn coordinates(&self) -> &[[f64; 2]] {
        &self.coordinates
    }

    /// Returns the number of the first particle of each panel.
    #[must_use]
    pub fn panel_starts(&self) -> &[usize] {
        &self.starts
    }

    /// Returns the triangles of the surface as particle numbers.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns the [`Sparsity`] of the stiffness: the pairs of particles that a connector joins.
    #[must_use]
    pub fn sparsity(&self) -> &Sparsity {
        &self.sparsity
    }

    /// Returns the areas of the connectors of each kind as [`ConnectorAreas`].
    #[must_use]
    pub fn connector_areas(&self) -> ConnectorAreas {
        let triangles: f64 = self.rims.iter().flat_map(|rim| &rim.triangles.areas).sum();
        ConnectorAreas {
            traction: [0, 1].map(|d| {
                let segments: f64 =
                    self.panels.iter().flat_map(|panel| &panel.yarns[d].segment_areas).sum();
                segments + triangles
            }),
            shear: (0..4)
                .map(|c| self.panels.iter().flat_map(|panel| &panel.corner_areas[c]).sum::<f64>())
                .sum::<f64>()
                + triangles,
            bending: [0, 1].map(|d| {
                let triples: f64 =
                    self.panels.iter().flat_map(|panel| &panel.yarns[d].triple_areas).sum();
                let stencils: f64 = self.rims.iter().flat_map(|rim| &rim.stencils.areas[d]).sum();
                triples + stencils
            }),
        }
    }

    /// Returns the deformation at `state`, from the memories of its connectors, as [`Strains`].
    ///
    /// # Errors
    /// The state belongs to another cloth.
    pub fn strains(&self, state: &State) -> Result<Strains, Error> {
        self.check_state(state)?;
        let (mut traction, mut shear, mut curvature) = (Vec::new(), Vec::new(), Vec::new());
        let State { grid, rim, .. } = state;

        // Connectors of the grids. Columns also hold places without a connector.
        for panel in &self.panels {
            for (direction, Yarns { segments, triples, .. }) in panel.yarns.iter().enumerate() {
                let strains = &grid.traction[direction].positions()[panel.base..];
                traction.extend(segments.iter().map(|&index| strains[index]));
                let curvatures = &grid.bending[direction].positions()[panel.base..];
                curvature.extend(triples.iter().map(|&index| curvatures[index].abs()));
            }
            for memories in &grid.shear {
                let sines = &memories.positions()[panel.base..];
                shear.extend(panel.cells.iter().map(|&index| sines[index].abs()));
            }
        }

        // Connectors of the rims.
        for Rim { triangles, stencils, .. } in &self.rims {
            for direction in 0..2 {
                let strains = &rim.traction[direction].positions()[triangles.base..];
                traction.extend(&strains[..triangles.count]);
                let curvatures = rim.bending[direction].positions()[stencils.base..].iter();
                let areas = &stencils.areas[direction];
                let curvatures = curvatures.zip(areas).filter(|(_, area)| **area > 0.0);
                curvature.extend(curvatures.map(|(curvature, _)| curvature.abs()));
            }
            let sines = &rim.shear.positions()[triangles.base..][..triangles.count];
            shear.extend(sines.iter().map(|sine| sine.abs()));
        }

        for values in [&mut traction, &mut shear, &mut curvature] {
            values.sort_by(f64::total_cmp);
        }
        Ok(Strains {
            traction_max: traction.last().copied().unwrap_or(0.0),
            traction_p99: percentile_99(&traction),
            shear_max: shear.last().map_or(0.0, |sine| sine.min(1.0).asin()),
            curvature_p99: percentile_99(&curvature),
        })
    }

    /// Returns the strains of the triangles of the surface, in the order of
    /// [`triangles`](Cloth::triangles), with the particles at `positions` (three numbers each, in
    /// m).
    ///
    /// # Errors
    /// There are not three numbers for every particle.
    pub fn triangle_strains(&self, positions: &[f64]) -> Result<Vec<TriangleStrain>, Error> {
        self.check_vectors("positions", positions)?;
        let strains = self
            .triangles
            .iter()
            .map(|triangle| {
                let coordinates = triangle.map(|particle| self.coordinates[particle as usize]);
                TriangleStrain::new(coordinates, triangle.map(|p| vector_at(positions, p)))
            })
            .collect();
        Ok(strains)
    }

    /// Computes the normals of the surface at the positions of `state`, and stores them there.
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

/// Returns the 99th percentile of the sorted `values`, 0 without values.
fn percentile_99(values: &[f64]) -> f64 {
    values.get(values.len().saturating_sub(1) * 99 / 100).copied().unwrap_or(0.0)
}

/// Checks that there are `panels`, that each has an area, and that the numbers of its fabric are in
/// range.
pub(crate) fn check_panels(panels: &[(&Lattice, &Fabric)]) -> Result<(), Error> {
    if panels.is_empty() {
        return Err(Error::Empty);
    }
    for (panel, (lattice, fabric)) in panels.iter().enumerate() {
        let area = lattice.area();
        if !(area > 0.0 && area.is_finite()) {
            return Err(Error::Area { panel, area });
        }
        let problems = fabric.problems();
        if !problems.is_empty() {
            let problems = problems.iter().map(|p| format!("{}: {}", p.key, p.message)).collect();
            return Err(Error::Fabric { panel, problems });
        }
    }
    Ok(())
}
