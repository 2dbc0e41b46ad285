//! The seams of a cloth: their forces, stiffness and memory.

use drape_fabric::{Fabric, Law, Memory};
use serde::{Deserialize, Serialize};

use crate::error::{Error, check_length};
use crate::layout::fingerprint::Fingerprint;
use crate::measure::bending::BendingResponse;
use crate::measure::vector::{Vector, WeightedNode, add_at, scale};
use crate::panel::lattice::Lattice;
use crate::seam::builder::{SeamBuilder, SeamProblem};
use crate::seam::connector::SeamConnector;
use crate::seam::description::Seam;

/// Bending of seams, which is added to the bending of the panels, whose connectors end at their
/// outlines.
///
/// A seam adds a strip, as wide as the mean height of the triangles beside it and
/// [`Seam::stiffness`] times as stiff as the fabric. The strip stands for the layers of the
/// allowances, and keeps the panels from turning freely about the seam.
///
/// * **Across** a segment the second difference is `$(\hat{p} + \hat{q})/w$` with the directions
///   `$\hat{p}$`, `$\hat{q}$` in which the two triangles leave the segment and the mean height
///   `$w$`. Its length is `$\frac{2}{w}\sin\frac{\theta}{2}$` with the angle `$\theta$` between the
///   panels. The curvature follows as for a triple of a yarn: `$\theta/w$`.
/// * **Along** the seam, each side has the second difference of three nodes in a row. Where they do
///   not lie on a line, it includes the next node inside, so that a curved seam on a flat panel has
///   no curvature. In a gather only the shorter side bends, and the longer one follows it.
///
/// A curvature `$\kappa$` in a direction at an angle `$\vartheta$` to a yarn bends the yarn by
/// `$\kappa\cos^2\vartheta$`, as on a cylinder. Each side has the laws of its two yarns, with
/// friction, for half of the strip.
///
/// ```
/// use drape_cloth::{Cloth, Lattice, Seam, SeamBending};
/// let fabric = drape_fabric::samples::plain_weave();
/// // Two squares of 3 × 3 particles: the right side of the first is sewn to the left side of the
/// // second.
/// let square = Lattice::rectangle(0.02, 0.02, 0.01)?;
/// let panels = [(&square, &fabric), (&square, &fabric)];
/// let seams = SeamBending::new(&panels, &[Seam::new(vec![[2, 9], [5, 12], [8, 15]])])?;
/// let place = |shift: f64| square.coordinates().iter().flat_map(move |c| [c[0] + shift, c[1], 0.0]);
/// let flat: Vec<f64> = place(0.0).chain(place(0.02)).collect();
/// let state = seams.state(&flat)?;
/// assert!(seams.potential(&state, &flat)?.abs() < 1e-18);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SeamBending {
    connectors: Vec<SeamConnector>,
    particles: usize,
    fingerprint: Fingerprint,
}

/// Memories of seams, and the normals at the last commit. Only [`SeamBending::commit`] writes them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SeamBendingState {
    memories: Vec<Memory>,
    normals: Vec<Vector>,
    /// Fingerprint of the seams.
    fingerprint: u64,
}

impl SeamBendingState {
    /// Returns whether this may follow `earlier`, another state of the same seams: it has as many
    /// memories, and normals that are finite.
    #[must_use]
    pub fn may_follow(&self, earlier: &Self) -> bool {
        self.fingerprint == earlier.fingerprint
            && self.memories.len() == earlier.memories.len()
            && self.normals.len() == earlier.normals.len()
            && self.normals.iter().flatten().all(|x| x.is_finite())
    }

    /// Returns each [`Memory`], for hashes and comparisons, in a fixed order.
    pub fn memories(&self) -> impl Iterator<Item = Memory> {
        self.memories.iter().copied()
    }
}

/// A connector with its memory and normal.
struct ConnectorState<'a> {
    connector: &'a SeamConnector,
    memory: &'a Memory,
    normal: Vector,
}

impl ConnectorState<'_> {
    fn respond(&self, positions: &[f64], definite: bool) -> BendingResponse {
        self.connector.respond(self.memory, self.normal, positions, definite)
    }
}

impl SeamBending {
    /// Returns the seams of a [`Cloth`](crate::Cloth) of the same `panels`. Particles have the
    /// numbers of the cloth.
    ///
    /// Where two neighbours on one side are one particle, as where a seam runs over the mouth of a
    /// dart, and at the breaks of a seam, nothing bends between them.
    ///
    /// # Errors
    /// A seam has fewer than two pairs; a particle does not exist; neighbours on a side of the seam
    /// are not neighbours on the outline of the panel; a particle is tied to particles that are not
    /// on the other side of the seam; or a stiffness or an angle is out of range.
    pub fn new(panels: &[(&Lattice, &Fabric)], seams: &[Seam]) -> Result<Self, Error> {
        let builder = SeamBuilder::new(panels);
        let mut connectors = Vec::new();
        for (index, seam) in seams.iter().enumerate() {
            builder.append(seam, &mut connectors).map_err(|problem: SeamProblem| Error::Seam {
                seam: index,
                pair: problem.pair,
                what: problem.what,
            })?;
        }

        let particles = builder.particle_count();
        let mut fingerprint = Fingerprint::new();
        fingerprint.add([particles as u64]);
        for SeamConnector { nodes, area, .. } in &connectors {
            fingerprint.add(nodes.iter().map(|node| u64::from(node.node)));
            fingerprint.add([area.to_bits()]);
        }
        Ok(Self { connectors, particles, fingerprint })
    }

    /// Returns the number of particles of the cloth.
    #[must_use]
    pub fn particle_count(&self) -> usize {
        self.particles
    }

    /// Checks that `state` belongs to these seams, and that the list called `name` has three
    /// numbers for every particle.
    fn check(
        &self,
        state: &SeamBendingState,
        name: &'static str,
        numbers: &[f64],
    ) -> Result<(), Error> {
        let count = self.connectors.len();
        let is_own = state.fingerprint == self.fingerprint.number()
            && state.memories.len() == count
            && state.normals.len() == count;
        if !is_own {
            return Err(Error::OtherCloth { what: "state of the seams" });
        }
        check_length(name, 3 * self.particles, numbers.len())
    }

    /// Returns the state of seams that start at `positions` without friction.
    ///
    /// # Errors
    /// There are not three numbers for every particle.
    pub fn state(&self, positions: &[f64]) -> Result<SeamBendingState, Error> {
        check_length("positions", 3 * self.particles, positions.len())?;
        let connectors = self.connectors.iter();
        let normals: Vec<Vector> =
            connectors.map(|connector| connector.normal(positions)).collect();
        let memories = self
            .connectors
            .iter()
            .zip(&normals)
            .map(|(connector, normal)| {
                let position = connector.curvature(positions, *normal);
                Memory { position, peak: position.abs(), ..Memory::default() }
            })
            .collect();
        Ok(SeamBendingState { memories, normals, fingerprint: self.fingerprint.number() })
    }

    /// Returns the pairs of particles that seams join, the lower number first. Some pairs occur
    /// more than once.
    pub fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        self.connectors.iter().flat_map(|connector| {
            let nodes = connector.nodes.iter().enumerate();
            nodes.flat_map(|(k, first)| {
                connector.nodes[k + 1..].iter().map(move |second| [first.node, second.node])
            })
        })
    }

    /// Returns all connectors with their memories and normals in `state`.
    fn with_state<'a>(
        &'a self,
        state: &'a SeamBendingState,
    ) -> impl Iterator<Item = ConnectorState<'a>> {
        let all = self.connectors.iter().zip(&state.memories).zip(&state.normals);
        all.map(|((connector, memory), normal)| ConnectorState {
            connector,
            memory,
            normal: *normal,
        })
    }

    /// Adds the forces of all seams at the positions `trial` to `forces`, in N.
    ///
    /// # Errors
    /// The state belongs to other seams, or a list does not have three numbers for every
    /// particle.
    pub fn add_forces(
        &self,
        state: &SeamBendingState,
        trial: &[f64],
        forces: &mut [f64],
    ) -> Result<(), Error> {
        self.check(state, "trial positions", trial)?;
        self.check(state, "forces", forces)?;
        for current in self.with_state(state) {
            let moment = current.respond(trial, false).gradient;
            for &WeightedNode { node, weight } in &current.connector.nodes {
                add_at(forces, node, scale(moment, -current.connector.area * weight));
            }
        }
        Ok(())
    }

    /// Returns the potential of the seams within a step at the positions `trial`, in J. Its
    /// negative derivative is [`SeamBending::add_forces`]. Only differences at one `state` are
    /// meaningful.
    ///
    /// # Errors
    /// The state belongs to other seams, or there are not three numbers for every particle.
    pub fn potential(&self, state: &SeamBendingState, trial: &[f64]) -> Result<f64, Error> {
        self.check(state, "trial positions", trial)?;
        let current = self.with_state(state);
        Ok(current.map(|c| c.connector.area * c.respond(trial, false).energy).sum())
    }

    /// Passes the negative derivative of the forces with respect to `trial`, in N/m, to `put`: the
    /// particles of row and column, and the block of nine numbers, row by row. The row is never
    /// greater than the column.
    ///
    /// Every block is symmetric. A block of two different particles stands for its transpose too.
    /// Where both are sewn into one particle, it counts twice there. With `definite`, parts that
    /// make the matrix indefinite are left out.
    ///
    /// # Errors
    /// The state belongs to other seams, or there are not three numbers for every particle.
    pub fn add_stiffness(
        &self,
        state: &SeamBendingState,
        trial: &[f64],
        definite: bool,
        mut put: impl FnMut(u32, u32, [f64; 9]),
    ) -> Result<(), Error> {
        self.check(state, "trial positions", trial)?;
        for current in self.with_state(state) {
            let hessian = current.respond(trial, definite).hessian;
            let hessian = hessian.as_flattened();
            let SeamConnector { nodes, area, .. } = current.connector;
            for (k, row) in nodes.iter().enumerate() {
                for column in &nodes[k..] {
                    let size = area * row.weight * column.weight;
                    put(row.node, column.node, std::array::from_fn(|k| size * hessian[k]));
                }
            }
        }
        Ok(())
    }

    /// Accepts a step to `positions`: advances all memories and normals of `state`, which nothing
    /// else writes. Returns the energy dissipated by friction, in J.
    ///
    /// # Errors
    /// The state belongs to other seams, or there are not three numbers for every particle.
    pub fn commit(&self, state: &mut SeamBendingState, positions: &[f64]) -> Result<f64, Error> {
        self.check(state, "positions", positions)?;
        let mut dissipated = 0.0;
        let memories = state.memories.iter_mut().zip(&mut state.normals);
        for (connector, (memory, normal)) in self.connectors.iter().zip(memories) {
            let SeamConnector { law, area, .. } = connector;
            *normal = connector.normal(positions);
            let to = connector.curvature(positions, *normal);
            let after = law.commit(memory, to);
            let gained = law.stored(&after) - law.stored(memory);
            dissipated += area * (law.work(memory, to) - gained);
            *memory = after;
        }
        Ok(dissipated)
    }

    /// Returns the energy that the seams can return at `state`, in J. `positions` must belong to
    /// the last accepted step.
    ///
    /// # Errors
    /// The state belongs to other seams, or there are not three numbers for every particle.
    pub fn stored(&self, state: &SeamBendingState, positions: &[f64]) -> Result<f64, Error> {
        self.check(state, "positions", positions)?;
        let energies = self.with_state(state).map(|current| {
            // At the positions of the last commit the friction has done no work since.
            let elastic = current.respond(positions, false).energy;
            let friction = &current.connector.law.friction;
            current.connector.area * (elastic + friction.stored(current.memory.friction))
        });
        Ok(energies.sum())
    }
}
