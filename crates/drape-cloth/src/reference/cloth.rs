//! The reference cloth: all connectors in lists, and loops over them.

use std::collections::BTreeSet;

use drape_fabric::{BendingLaw, Fabric, Law, ShearLaw, TractionLaw};

use crate::cloth::Cloth;
use crate::error::{Error, check_length};
use crate::layout::connectors::{BendingConnectors, Segment, Triple, segments};
use crate::layout::sparsity::Sparsity;
use crate::measure::block::{Matrix, identity, outer, sum, transposed};
use crate::measure::vector::{add, add_at, scale};
use crate::panel::grid::Grid;
use crate::panel::lattice::Lattice;
use crate::reference::connector::{Connector, Corner, CornerBlocks, Edge, commit_memory};
use crate::reference::stencil::ReferenceStencil;
use crate::reference::triangle::ReferenceTriangle;
use crate::rim::neighbourhood::Neighbourhoods;
use crate::state::State;

/// The connectors of a cloth one by one through the scalar laws.
///
/// Tests and benches compare [`Cloth`](crate::Cloth) with this reference. Both give the same
/// numbers up to rounding. They share only which particles a connector joins, the weights of the
/// fits at a rim, and the turning angle of a second difference.
///
/// ```
/// use drape_cloth::{Cloth, Lattice, ReferenceCloth};
/// let fabric = drape_fabric::samples::plain_weave();
/// let lattice = Lattice::rectangle(0.1, 0.1, 0.01)?;
/// let panels = [(&lattice, &fabric)];
/// let cloth = Cloth::new(&panels)?;
/// let place = |s: f64| -> Vec<f64> {
///     lattice.coordinates().iter().flat_map(|&[u, v]| [u, v, s * u * v]).collect()
/// };
/// let state = cloth.state(place(0.0))?;
/// let reference = ReferenceCloth::new(&panels, &cloth, &state)?;
/// let mut fast = vec![0.0; 3 * cloth.particle_count()];
/// let mut exact = fast.clone();
/// cloth.add_forces(&state, &place(2.0), &mut fast)?;
/// reference.add_forces(&place(2.0), &mut exact)?;
/// assert!(fast.iter().zip(&exact).all(|(a, b)| (a - b).abs() < 1e-12));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct ReferenceCloth {
    segments: Vec<Connector<TractionLaw, 2>>,
    corners: Vec<Connector<ShearLaw, 3>>,
    triples: Vec<Connector<BendingLaw, 3>>,
    triangles: Vec<ReferenceTriangle>,
    stencils: Vec<ReferenceStencil>,
    sparsity: Sparsity,
    /// Unit normals at the particles at the last commit.
    normals: Vec<f64>,
}

impl ReferenceCloth {
    /// Returns the connectors of `panels` at the positions of `state`, without friction. `cloth` is
    /// the cloth of the same panels.
    ///
    /// # Errors
    /// The panels make no cloth, or `cloth` or `state` belong to other panels.
    pub fn new(
        panels: &[(&Lattice, &Fabric)],
        cloth: &Cloth,
        state: &State,
    ) -> Result<Self, Error> {
        if Cloth::new(panels)?.fingerprint() != cloth.fingerprint() {
            return Err(Error::OtherCloth { what: "list of panels" });
        }
        cloth.check_state(state)?;
        let (positions, normals) = (state.positions.as_slice(), state.normals());
        let mut all = Self {
            segments: Vec::new(),
            corners: Vec::new(),
            triples: Vec::new(),
            triangles: Vec::new(),
            stencils: Vec::new(),
            sparsity: cloth.sparsity().clone(),
            normals: normals.to_vec(),
        };
        let mut first = 0;
        for (lattice, fabric) in panels {
            all.add_panel(lattice, fabric, first);
            first += lattice.coordinates.len() as u32;
        }

        // Memories start at the measures of the state.
        for segment in &mut all.segments {
            segment.memory.position = segment.strain(positions);
            segment.memory.peak = segment.memory.position.max(0.0);
        }
        for corner in &mut all.corners {
            corner.memory.position = corner.corner(positions).sine;
            corner.memory.peak = corner.memory.position.abs();
        }
        for triple in &mut all.triples {
            triple.memory.position = triple.curvature(positions, normals);
            triple.memory.peak = triple.memory.position.abs();
        }
        all.triangles.iter_mut().for_each(|triangle| triangle.start(positions));
        all.stencils.iter_mut().for_each(|stencil| stencil.start(positions, normals));
        Ok(all)
    }

    /// Checks that the list called `name` has three numbers for every particle.
    fn check(&self, name: &'static str, numbers: &[f64]) -> Result<(), Error> {
        check_length(name, self.normals.len(), numbers.len())
    }

    /// Appends the connectors of a panel in `fabric` whose first particle is `first`.
    fn add_panel(&mut self, lattice: &Lattice, fabric: &Fabric, first: u32) {
        let Self { sparsity, .. } = self;
        for (cell, areas) in lattice.cells.iter().zip(lattice.shear_areas()) {
            let [a, b, c, d] = cell.corners;
            // Corner, neighbour along the warp (v), neighbour along the weft (u), sign.
            let around = [(a, d, b, 1.0), (b, c, a, -1.0), (c, b, d, 1.0), (d, a, c, -1.0)];
            for ((corner, warp, weft, sign), area) in around.into_iter().zip(areas) {
                let particles = [corner, warp, weft].map(|p| first + p);
                let corner = Connector::new(fabric.shear, particles, sign, sparsity);
                self.corners.push(corner.with_area(area));
            }
        }
        let near = Neighbourhoods::new(lattice);
        let bending = BendingConnectors::along_yarns(lattice, &lattice.areas(), near.is_some());
        if let Some(near) = &near {
            self.triangles.extend(ReferenceTriangle::for_panel(lattice, fabric, first));
            let stencils = ReferenceStencil::for_panel(lattice, fabric, near, &bending);
            self.stencils.extend(stencils.into_iter().map(|stencil| stencil.shifted(first)));
        }
        for grid in &lattice.grids {
            self.add_yarns((lattice, grid), fabric, first, &bending);
        }
    }

    /// Appends the segments and triples of `grid`, a grid of `lattice`.
    fn add_yarns(
        &mut self,
        (lattice, grid): (&Lattice, &Grid),
        fabric: &Fabric,
        first: u32,
        bending: &[BendingConnectors; 2],
    ) {
        let Self { sparsity, .. } = self;
        let grid_particles: BTreeSet<u32> = grid.particles().collect();
        let [across, along] = grid.spacing;
        let sides = [(&fabric.warp, along), (&fabric.weft, across)];
        for (direction, yarns) in grid.yarns().iter().enumerate() {
            let (laws, measure) = sides[direction];
            for Segment { ends, area } in segments(lattice, yarns, direction) {
                let ends = ends.map(|p| first + p);
                let segment = Connector::new(laws.traction, ends, measure, sparsity);
                self.segments.push(segment.with_area(area));
            }

            // The list of triples covers all grids of the panel.
            for &Triple { particles, area } in &bending[direction].triples {
                if !grid_particles.contains(&particles[1]) {
                    continue;
                }
                let fold = bending[direction].folds.get(particles[1] as usize);
                let fold = fold.copied().unwrap_or(0.0);
                let particles = particles.map(|p| first + p);
                let triple = Connector::new(laws.bending, particles, measure, sparsity);
                self.triples.push(triple.with_area(area).with_fold(fold));
            }
        }
    }

    /// Adds the forces at the positions `trial` to `forces`, in N, like
    /// [`Cloth::add_forces`](crate::Cloth::add_forces).
    ///
    /// # Errors
    /// A list does not have three numbers for every particle.
    pub fn add_forces(&self, trial: &[f64], forces: &mut [f64]) -> Result<(), Error> {
        self.check("trial positions", trial)?;
        self.check("forces", forces)?;
        for segment in &self.segments {
            let [a, b] = segment.particles;
            let Edge { length, unit } = segment.edge(trial);
            let strain = length / segment.measure - 1.0;
            let load = segment.law.respond(&segment.memory, strain).load;
            let pull = scale(unit, load * segment.area / segment.measure);
            add_at(forces, a, pull);
            add_at(forces, b, scale(pull, -1.0));
        }

        for corner in &self.corners {
            let [c, p, f] = corner.particles;
            let Corner { sine, warp_gradient: warp, weft_gradient: weft, .. } =
                corner.corner(trial);
            let load = corner.area * corner.law.respond(&corner.memory, sine).load;
            add_at(forces, p, scale(warp, -load));
            add_at(forces, f, scale(weft, -load));
            add_at(forces, c, scale(add(warp, weft), load));
        }

        for triple in &self.triples {
            let moment = triple.respond(trial, &self.normals, false).gradient;
            let pull = scale(moment, triple.area / (triple.measure * triple.measure));
            for (particle, weight) in triple.particles.into_iter().zip([-1.0, 2.0, -1.0]) {
                add_at(forces, particle, scale(pull, weight));
            }
        }

        self.triangles.iter().for_each(|triangle| triangle.add_forces(trial, forces));
        for stencil in &self.stencils {
            stencil.add_forces(trial, &self.normals, forces);
        }
        Ok(())
    }

    /// Returns the potential at the positions `trial`, in J. It differs from
    /// [`Cloth::potential`](crate::Cloth::potential) by a constant.
    ///
    /// # Errors
    /// There are not three numbers for every particle.
    pub fn potential(&self, trial: &[f64]) -> Result<f64, Error> {
        self.check("trial positions", trial)?;
        let segments = self
            .segments
            .iter()
            .map(|segment| segment.area * segment.law.work(&segment.memory, segment.strain(trial)));
        let corners = self.corners.iter().map(|corner| {
            let sine = corner.corner(trial).sine;
            corner.area * corner.law.work(&corner.memory, sine)
        });
        let triples = self
            .triples
            .iter()
            .map(|triple| triple.area * triple.respond(trial, &self.normals, false).energy);
        let triangles = self.triangles.iter().map(|triangle| triangle.potential(trial));
        let stencils = self.stencils.iter().map(|stencil| stencil.potential(trial, &self.normals));
        Ok(segments.chain(corners).chain(triples).chain(triangles).chain(stencils).sum())
    }

    /// Adds the stiffness at the positions `trial` to the blocks `values`, in N/m, like
    /// [`Cloth::add_stiffness`](crate::Cloth::add_stiffness).
    ///
    /// # Errors
    /// `trial` does not have three numbers for every particle, or `values` does not have nine
    /// numbers for every block.
    pub fn add_stiffness(
        &self,
        trial: &[f64],
        definite: bool,
        values: &mut [f64],
    ) -> Result<(), Error> {
        self.check("trial positions", trial)?;
        check_length("stiffness values", 9 * self.sparsity.block_count(), values.len())?;
        for segment in &self.segments {
            let Edge { length, unit } = segment.edge(trial);
            let (rest, area) = (segment.measure, segment.area);
            let response = segment.law.respond(&segment.memory, length / rest - 1.0);
            let mut along = area * response.tangent / (rest * rest);
            let mut across = area * response.load / (rest * length);
            if definite {
                (along, across) = (along.max(0.0), across.max(0.0));
            }
            let block = sum([(across, identity()), (along - across, outer(unit, unit))]);
            segment.add_block(0, block, values);
            segment.add_block(1, block, values);
            segment.add_block(2, sum([(-1.0, block)]), values);
        }

        for corner in &self.corners {
            let CornerBlocks { warp: pp, weft: ff, mixed: pf } =
                corner.corner_blocks(trial, definite);
            let cp = sum([(-1.0, pp), (-1.0, transposed(pf))]);
            let cf = sum([(-1.0, pf), (-1.0, ff)]);
            let cc = sum([(-1.0, cp), (-1.0, cf)]);
            for (pair, block) in [cc, pp, cp, ff, cf, pf].into_iter().enumerate() {
                corner.add_block(pair, block, values);
            }
        }

        for triple in &self.triples {
            let block = triple.respond(trial, &self.normals, definite).hessian;
            let size = triple.area / triple.measure.powi(4);
            // Products of the weights 1, −2, 1.
            for (pair, weight) in [1.0, 4.0, -2.0, 1.0, 1.0, -2.0].into_iter().enumerate() {
                triple.add_block(pair, sum([(weight * size, block)]), values);
            }
        }

        // Triangles and stencils look up their blocks.
        let mut put = |[row, column]: [u32; 2], block: Matrix| {
            let slot = self.sparsity.block(row, column).unwrap_or(usize::MAX);
            let values = &mut values[9 * slot..][..9];
            for (value, entry) in values.iter_mut().zip(block.as_flattened()) {
                *value += entry;
            }
        };
        for triangle in &self.triangles {
            triangle.add_stiffness(trial, definite, &mut put);
        }
        for stencil in &self.stencils {
            stencil.add_stiffness(trial, &self.normals, definite, &mut put);
        }
        Ok(())
    }

    /// Accepts a step to `positions`, like [`Cloth::commit`](crate::Cloth::commit). `normals`
    /// belong to the state after the step. Returns the energy dissipated, in J.
    ///
    /// # Errors
    /// A list does not have three numbers for every particle.
    pub fn commit(&mut self, positions: &[f64], normals: &[f64]) -> Result<f64, Error> {
        self.check("positions", positions)?;
        self.check("normals", normals)?;
        self.normals.copy_from_slice(normals);
        let mut lost = 0.0;
        for segment in &mut self.segments {
            let strain = segment.strain(positions);
            lost += segment.area * commit_memory(&segment.law, &mut segment.memory, strain);
        }
        for corner in &mut self.corners {
            let sine = corner.corner(positions).sine;
            lost += corner.area * commit_memory(&corner.law, &mut corner.memory, sine);
        }
        for triple in &mut self.triples {
            let curvature = triple.curvature(positions, normals);
            lost += triple.area * commit_memory(&triple.law, &mut triple.memory, curvature);
        }
        let triangles = self.triangles.iter_mut();
        lost += triangles.map(|triangle| triangle.commit(positions)).sum::<f64>();
        let stencils = self.stencils.iter_mut();
        lost += stencils.map(|stencil| stencil.commit(positions, normals)).sum::<f64>();
        Ok(lost)
    }
}
