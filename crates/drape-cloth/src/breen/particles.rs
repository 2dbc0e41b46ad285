//! The cloth of Breen, House & Wozny (1994).

mod hinge;
mod near;
mod well;

use drape_fabric::{BreenWork, Fabric};

use crate::breen::hinge::Hinge;
use crate::breen::near::Near;
use crate::breen::well::Well;
use crate::connectors::{segments, triples};
use crate::field::{Vector, scale, subtract};
use crate::{Error, Lattice};

/// Block of a pair of particles: second derivatives of the energy, in N/m, row by row.
pub type Block = [f64; 9];

/// Particles that interact as Breen, House & Wozny (1994) have it: no friction, no memory.
///
/// Four energies hold them [eq. 3.1]. **Stretching** ties neighbours along a yarn, and **repulsion** keeps every two
/// particles apart that come nearer than the spacing, wherever they are in the cloth; both rise with the fifth power
/// [eqs. 3.2–3.5], so that a cloth under its own weight hardly stretches and does not meet itself. **Bending** is of the
/// angle of three particles along a yarn [eqs. 5.4, 5.5], **trellising** of the angle between the two lines through the
/// neighbours of a particle [eq. 5.7]; their curves are the first branches of the fabric's ([`BreenWork::from_laws`]).
///
/// Read otherwise than printed, besides what [`BreenWork`] says:
/// * Eqs. 3.2 and 3.3 have one factor for energies of different units. In lengths counted in spacings both are energies,
///   and they make one well, even about the spacing up to the fifth order.
/// * The factor is not published. Here it is such that the weight of a metre of the cloth stretches it by
///   [`Breen::WELL_STRAIN`], whatever the spacing.
/// * Every particle stands for a square of the spacing in the paper, at the hem too. Here it stands for its own area,
///   and the line through the neighbours of a particle at the hem ends at the particle.
///
/// The minimiser of the paper is stochastic, and perturbs the grid. Here the start is perturbed, by the heights that a
/// scene may give its particles.
#[derive(Debug, Clone)]
pub struct Breen {
    edges: Vec<Edge>,
    hinges: Vec<Hinge>,
    /// One for each direction of each panel.
    works: Vec<BreenWork>,
    wells: Vec<Well>,
    near: Near,
}

/// Neighbours along a yarn.
#[derive(Debug, Clone, Copy)]
struct Edge {
    particles: [u32; 2],
    well: Well,
}

impl Breen {
    /// Strain at which a metre of the cloth hangs from its end, a ratio: "threads do not stretch significantly" (§3).
    ///
    /// Smaller ones make the wells steeper and the steps harder to solve. On a cube the wells make the yarns of the
    /// corners 2 % longer at most.
    pub const WELL_STRAIN: f64 = 0.01;

    /// The particles of a [`Cloth`](crate::Cloth) of the same panels, with the same numbers.
    ///
    /// # Errors
    /// When a panel has a rim of triangles, or folds.
    pub fn new(panels: &[(&Lattice, &Fabric)]) -> Result<Self, Error> {
        if panels.iter().any(|(lattice, _)| !lattice.rim.is_empty()) {
            return Err(Error::Rim);
        }
        if panels.iter().any(|(lattice, _)| !lattice.folds().is_empty()) {
            let what = "is unknown to the model of Breen, House & Wozny";
            return Err(Error::Fold { fold: 0, what });
        }
        let (mut edges, mut hinges, mut works) = (Vec::new(), Vec::new(), Vec::new());
        let mut wells = Vec::new();
        let mut tied = Vec::new();
        for (lattice, fabric) in panels {
            let first = wells.len() as u32;
            let depth = Well::depth(fabric.density, Self::WELL_STRAIN);
            let areas = lattice.areas();
            let [across, along] = lattice.spacing;
            let spacing = across.min(along);
            wells.extend(areas.iter().map(|area| Well { spacing, energy: depth * area }));
            tied.resize(wells.len(), [u32::MAX; 4]);
            let lines = lattice.yarns();
            for (direction, (laws, spacing)) in
                [(&fabric.warp, along), (&fabric.weft, across)].into_iter().enumerate()
            {
                let work = works.len() as u32;
                works.push(BreenWork::from_laws(&laws.bending, &fabric.shear));
                for (ends, area) in segments(lattice, &lines[direction], direction) {
                    let particles = ends.map(|end| first + end);
                    edges.push(Edge { particles, well: Well { spacing, energy: depth * area } });
                    let [a, b] = particles;
                    tied[a as usize][direction] = b;
                    tied[b as usize][2 + direction] = a;
                }
                for (ends, area) in triples(lattice, &lines[direction], &areas) {
                    let yarn = ends.map(|particle| first + particle);
                    hinges.push(Hinge::bend(yarn, (area, work), spacing));
                }
            }
            let work = works.len() as u32 - 1;
            for (particle, area) in areas.iter().enumerate() {
                let own = first + particle as u32;
                let [up, right, down, left] =
                    tied[own as usize].map(|other| if other == u32::MAX { own } else { other });
                if up != down && left != right {
                    hinges.push(Hinge::trellis([[left, right], [down, up]], (*area, work)));
                }
            }
        }
        let near = Near::new(&wells, tied);
        Ok(Self { edges, hinges, works, wells, near })
    }

    /// Pairs of particles that are near each other in space and not tied by a yarn, the first less than the second: those
    /// nearer than the spacing, and those that are so soon.
    pub fn close_pairs(&mut self, positions: &[f64]) -> &[[u32; 2]] {
        self.near.find(positions)
    }

    /// Energy of the particles, in J; its negative derivative is [`Breen::add_forces`].
    #[must_use]
    pub fn energy(&mut self, positions: &[f64]) -> f64 {
        let at = |particle: u32| place(positions, particle);
        let well = |well: &Well, [a, b]: [u32; 2]| {
            let way = subtract(at(b), at(a));
            well.at(length(way)).energy
        };
        let ties: f64 = self.edges.iter().map(|edge| well(&edge.well, edge.particles)).sum();
        let angles = self.hinges.iter().map(|hinge| hinge.energy(&self.works, positions));
        let angles: f64 = angles.sum();
        let near = self.near.find(positions);
        let repelled: f64 = near
            .iter()
            .map(|&[a, b]| {
                let mean = Well::between(&self.wells[a as usize], &self.wells[b as usize]);
                let way = length(subtract(at(b), at(a)));
                if way < mean.spacing { mean.at(way).energy } else { 0.0 }
            })
            .sum();
        ties + angles + repelled
    }

    /// Adds the forces on the particles, three numbers for each, in N.
    pub fn add_forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        let pull = |well: &Well, [a, b]: [u32; 2], forces: &mut [f64]| {
            let way = subtract(place(positions, b), place(positions, a));
            let distance = length(way);
            let pull = scale(way, well.at(distance).first / distance);
            for axis in 0..3 {
                forces[3 * a as usize + axis] += pull[axis];
                forces[3 * b as usize + axis] -= pull[axis];
            }
        };
        self.edges.iter().for_each(|edge| pull(&edge.well, edge.particles, forces));
        self.hinges.iter().for_each(|hinge| hinge.add_forces(&self.works, positions, forces));
        for &[a, b] in self.near.find(positions) {
            let mean = Well::between(&self.wells[a as usize], &self.wells[b as usize]);
            if length(subtract(place(positions, b), place(positions, a))) < mean.spacing {
                pull(&mean, [a, b], forces);
            }
        }
    }

    /// Gives the second derivatives of the energy, block by block, each with its two particles, the first less than or
    /// equal to the second. A pair may come several times; its blocks add up.
    ///
    /// With `definite`, what makes the matrix indefinite is left out: compression across a pair, and the turning of the
    /// gradients of angles.
    pub fn stiffness(
        &mut self,
        positions: &[f64],
        definite: bool,
        visit: &mut dyn FnMut([u32; 2], &Block),
    ) {
        let pair = |well: &Well, [a, b]: [u32; 2], visit: &mut dyn FnMut([u32; 2], &Block)| {
            let way = subtract(place(positions, b), place(positions, a));
            let block = well.block(way, definite);
            visit([a, a], &block);
            visit([b, b], &block);
            let against = block.map(|entry| -entry);
            visit([a.min(b), a.max(b)], &against);
        };
        self.edges.iter().for_each(|edge| pair(&edge.well, edge.particles, visit));
        for hinge in &self.hinges {
            hinge.stiffness(&self.works, (positions, definite), visit);
        }
        for &[a, b] in self.near.find(positions) {
            let mean = Well::between(&self.wells[a as usize], &self.wells[b as usize]);
            if length(subtract(place(positions, b), place(positions, a))) < mean.spacing {
                pair(&mean, [a, b], visit);
            }
        }
    }
}

fn place(positions: &[f64], particle: u32) -> Vector {
    let start = 3 * particle as usize;
    [positions[start], positions[start + 1], positions[start + 2]]
}

fn length(way: Vector) -> f64 {
    crate::field::dot(way, way).sqrt()
}
