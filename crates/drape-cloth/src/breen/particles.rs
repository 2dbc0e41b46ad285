//! The cloth of Breen, House & Wozny.

use drape_fabric::{BreenWork, Fabric};

use crate::breen::close_pairs::ClosePairs;
use crate::breen::hinge::{Hinge, HingeSize};
use crate::breen::well::Well;
use crate::cloth::check_panels;
use crate::error::{Error, check_length};
use crate::layout::connectors::{Segment, Triple, segments, triples};
use crate::measure::block::Block;
use crate::measure::vector::{Vector, add_at, length, scale, subtract, vector_at};
use crate::panel::lattice::Lattice;

/// Interacting particles of Breen, House & Wozny \[BHW94\], without friction and memory.
///
/// Four energies act \[BHW94, eq. 3.1\]. **Stretching** holds neighbours along a yarn together.
/// **Repulsion** keeps any two particles apart that come nearer than the spacing, wherever they are
/// in the cloth. Both rise with the fifth power \[eqs. 3.2–3.5\], so a cloth under its weight
/// hardly stretches and does not intersect itself. **Bending** depends on the angle of three
/// particles along a yarn \[eqs. 5.4, 5.5\]. **Trellising** depends on the angle between the two
/// lines through the neighbours of a particle \[eq. 5.7\]. The curves of bending and trellising are
/// the first branches of the fabric's curves ([`BreenWork::from_laws`]).
///
/// Differences from the printed paper, besides the differences of [`BreenWork`]:
/// * Eqs. 3.2 and 3.3 have one factor for energies of different units. With lengths in units of the
///   spacing both are energies, and they form one well, even about the spacing up to the fifth
///   order.
/// * The factor is not published. Here the weight of a metre of the cloth stretches it by
///   [`Breen::WELL_STRAIN`], whatever the spacing.
/// * In the paper every particle stands for a square of the spacing, at the hem too. Here every
///   particle stands for its exact area, and the line through the neighbours of a particle at the
///   hem ends at the particle.
///
/// The minimiser of the paper is stochastic and perturbs the grid. Here the start is perturbed, by
/// the heights that a scene may give its particles.
#[derive(Debug, Clone)]
pub struct Breen {
    edges: Vec<Edge>,
    hinges: Vec<Hinge>,
    /// Works of the hinges, one for each direction of each panel.
    works: Vec<BreenWork>,
    /// Well of each particle, for repulsion.
    wells: Vec<Well>,
    close_pairs: ClosePairs,
}

/// Neighbours along a yarn.
#[derive(Debug, Clone, Copy)]
struct Edge {
    particles: [u32; 2],
    well: Well,
}

impl Breen {
    /// Strain of the cloth under the weight of a metre of cloth, a ratio: "threads do not stretch
    /// significantly" \[BHW94, §3\].
    ///
    /// Smaller values make the potential wells of the yarns steeper and the steps harder to solve.
    /// In cloth that is draped over a cube, the yarns at the corners are stretched by 2 % at most.
    pub const WELL_STRAIN: f64 = 0.01;

    /// Returns the model of a [`Cloth`](crate::Cloth) of the same `panels`. Particles have the
    /// numbers of the cloth.
    ///
    /// # Errors
    /// A panel has a rim of triangles, or folds, or the panels make no
    /// [`Cloth`](crate::Cloth).
    pub fn new(panels: &[(&Lattice, &Fabric)]) -> Result<Self, Error> {
        check_panels(panels)?;
        if panels.iter().any(|(lattice, _)| !lattice.rim.is_empty()) {
            return Err(Error::Rim);
        }
        if panels.iter().any(|(lattice, _)| !lattice.folds().is_empty()) {
            let what = "is unknown to the model of Breen, House & Wozny";
            return Err(Error::Fold { fold: 0, what });
        }

        let (mut edges, mut hinges, mut works) = (Vec::new(), Vec::new(), Vec::new());
        let mut wells = Vec::new();
        let mut neighbours = Vec::new();

        for (lattice, fabric) in panels {
            // Particles repel each other with a well of their area.
            let first = wells.len() as u32;
            let depth = Well::depth(fabric.density, Self::WELL_STRAIN);
            let areas = lattice.areas();
            let [across, along] = lattice.spacing;
            let spacing = across.min(along);
            wells.extend(areas.iter().map(|area| Well { spacing, energy: depth * area }));
            neighbours.resize(wells.len(), [u32::MAX; 4]);

            // Each yarn direction has stretching edges and bending hinges.
            let lines = lattice.yarns();
            for (direction, (laws, spacing)) in
                [(&fabric.warp, along), (&fabric.weft, across)].into_iter().enumerate()
            {
                let work = works.len() as u32;
                works.push(BreenWork::from_laws(&laws.bending, &fabric.shear));
                for Segment { ends, area } in segments(lattice, &lines[direction], direction) {
                    let particles = ends.map(|end| first + end);
                    edges.push(Edge { particles, well: Well { spacing, energy: depth * area } });
                    let [a, b] = particles;
                    neighbours[a as usize][direction] = b;
                    neighbours[b as usize][2 + direction] = a;
                }
                for Triple { particles, area } in triples(lattice, &lines[direction], &areas) {
                    let yarn = particles.map(|particle| first + particle);
                    hinges.push(Hinge::bend(yarn, HingeSize { area, work }, spacing));
                }
            }

            // A trellis hinge needs neighbours on both lines.
            let work = works.len() as u32 - 1;
            for (particle, area) in areas.iter().enumerate() {
                let particle = first + particle as u32;
                let [up, right, down, left] = neighbours[particle as usize]
                    .map(|next| if next == u32::MAX { particle } else { next });
                if up != down && left != right {
                    let size = HingeSize { area: *area, work };
                    hinges.push(Hinge::trellis([[left, right], [down, up]], size));
                }
            }
        }
        let close_pairs = ClosePairs::new(&wells, neighbours);
        Ok(Self { edges, hinges, works, wells, close_pairs })
    }

    /// Returns the pairs of particles that are close in space at `positions` and no neighbours on a
    /// yarn, the first less than the second. All pairs nearer than the spacing are listed, and some
    /// that may soon be.
    ///
    /// # Errors
    /// There are not three numbers for every particle.
    pub fn close_pairs(&mut self, positions: &[f64]) -> Result<&[[u32; 2]], Error> {
        self.check("positions", positions)?;
        Ok(self.close_pairs.find(positions))
    }

    /// Checks that the list called `name` has three numbers for every particle.
    fn check(&self, name: &'static str, numbers: &[f64]) -> Result<(), Error> {
        check_length(name, 3 * self.wells.len(), numbers.len())
    }

    /// Returns the positions at which the close pairs were listed last, in m, empty before the
    /// first call of [`Breen::close_pairs`]. The list is kept while particles move little.
    #[must_use]
    pub fn listed_positions(&self) -> &[f64] {
        self.close_pairs.listed()
    }

    /// Lists the close pairs at `positions`, in m, as [`Breen::close_pairs`] does for a first call.
    ///
    /// # Errors
    /// There are not three numbers for every particle.
    pub fn list_pairs(&mut self, positions: &[f64]) -> Result<(), Error> {
        self.check("positions", positions)?;
        self.close_pairs.list(positions);
        Ok(())
    }

    /// Returns the energy of the particles at `positions`, in J. Its negative derivative is
    /// [`Breen::add_forces`].
    ///
    /// # Errors
    /// There are not three numbers for every particle.
    pub fn energy(&mut self, positions: &[f64]) -> Result<f64, Error> {
        self.check("positions", positions)?;
        let stretched: f64 = self
            .edges
            .iter()
            .map(|edge| edge.well.at(length(span(positions, edge.particles))).energy)
            .sum();
        let angles = self.hinges.iter().map(|hinge| hinge.energy(&self.works, positions));
        let angles: f64 = angles.sum();
        let pairs = self.close_pairs.find(positions);
        let repelled: f64 = pairs
            .iter()
            .map(|&[a, b]| {
                let mean = Well::between(&self.wells[a as usize], &self.wells[b as usize]);
                let distance = length(span(positions, [a, b]));
                if distance < mean.spacing { mean.at(distance).energy } else { 0.0 }
            })
            .sum();
        Ok(stretched + angles + repelled)
    }

    /// Adds the forces on the particles at `positions` to `forces`, in N, three numbers each.
    ///
    /// # Errors
    /// A list does not have three numbers for every particle.
    pub fn add_forces(&mut self, positions: &[f64], forces: &mut [f64]) -> Result<(), Error> {
        self.check("positions", positions)?;
        self.check("forces", forces)?;
        for edge in &self.edges {
            add_pair_forces(&edge.well, edge.particles, positions, forces);
        }
        self.hinges.iter().for_each(|hinge| hinge.add_forces(&self.works, positions, forces));
        for &[a, b] in self.close_pairs.find(positions) {
            let mean = Well::between(&self.wells[a as usize], &self.wells[b as usize]);
            if length(span(positions, [a, b])) < mean.spacing {
                add_pair_forces(&mean, [a, b], positions, forces);
            }
        }
        Ok(())
    }

    /// Passes the second derivatives of the energy at `positions` to `put`, block by block. Each
    /// block comes with its two particles, the first at most the second. A pair may occur several
    /// times; its blocks add up.
    ///
    /// With `definite`, parts that make the matrix indefinite are left out: compression across a
    /// pair, and the rotation of the gradients of angles.
    ///
    /// # Errors
    /// There are not three numbers for every particle.
    pub fn add_stiffness(
        &mut self,
        positions: &[f64],
        definite: bool,
        put: &mut dyn FnMut([u32; 2], &Block),
    ) -> Result<(), Error> {
        self.check("positions", positions)?;
        for edge in &self.edges {
            let block = edge.well.block(span(positions, edge.particles), definite);
            put_pair_blocks(edge.particles, &block, put);
        }
        for hinge in &self.hinges {
            hinge.add_stiffness(&self.works, positions, definite, put);
        }
        for &[a, b] in self.close_pairs.find(positions) {
            let mean = Well::between(&self.wells[a as usize], &self.wells[b as usize]);
            let span = span(positions, [a, b]);
            if length(span) < mean.spacing {
                put_pair_blocks([a, b], &mean.block(span, definite), put);
            }
        }
        Ok(())
    }
}

/// Returns the vector from particle `a` to particle `b`, in m.
fn span(positions: &[f64], [a, b]: [u32; 2]) -> Vector {
    subtract(vector_at(positions, b), vector_at(positions, a))
}

/// Adds the forces of `well` on the particles `a` and `b`, in N.
fn add_pair_forces(well: &Well, [a, b]: [u32; 2], positions: &[f64], forces: &mut [f64]) {
    let span = span(positions, [a, b]);
    let distance = length(span);
    let pull = scale(span, well.at(distance).first / distance);
    add_at(forces, a, pull);
    subtract_at(forces, b, pull);
}

/// Passes the blocks of the particles `a` and `b` to `put`, from the block of one end of their
/// span.
fn put_pair_blocks([a, b]: [u32; 2], block: &Block, put: &mut dyn FnMut([u32; 2], &Block)) {
    put([a, a], block);
    put([b, b], block);
    let against = block.map(|entry| -entry);
    put([a.min(b), a.max(b)], &against);
}

fn subtract_at(flat: &mut [f64], particle: u32, vector: Vector) {
    let start = 3 * particle as usize;
    for (sum, part) in flat[start..start + 3].iter_mut().zip(vector) {
        *sum -= part;
    }
}
