//! The seams of a cloth: their forces, stiffness and memory.

use drape_fabric::{Fabric, Law, Memory};
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::measure::bending::BendingResponse;
use crate::measure::vector::{Vector, WeightedNode, add_at, scale};
use crate::panel::lattice::Lattice;
use crate::seam::builder::{SeamBuilder, SeamProblem};
use crate::seam::connector::SeamConnector;
use crate::seam::description::Seam;

/// Bending of seams, in addition to that of the panels, whose own connectors end at their outlines.
///
/// A seam adds a strip of its own, as wide as the mean height of the triangles beside it and
/// [`Seam::stiffness`] times as stiff as the fabric. It stands for the layers of the allowances,
/// and keeps the panels from turning freely about the seam.
///
/// * **Across** a segment the second difference is `$(\hat{p} + \hat{q})/w$` with the directions
///   `$\hat{p}$`, `$\hat{q}$` in which the two triangles leave the segment and the mean height
///   `$w$`. Its length is `$\frac{2}{w}\sin\frac{\theta}{2}$` with the angle `$\theta$` between the
///   panels, and the curvature follows as for a triple of a yarn: `$\theta/w$`.
/// * **Along** the seam the second difference is, on each side, that of three nodes in a row, and
///   of the next node inside where they do not lie on a line, so that a curved seam on a flat panel
///   has none. In a gather it is that of the shorter side alone, which the longer one follows.
///
/// A curvature `$\kappa$` in a direction at an angle `$\vartheta$` to a yarn bends it by
/// `$\kappa\cos^2\vartheta$`, as on a cylinder. Each side has the laws of its own two yarns, with
/// friction, for half of the strip.
///
/// ```
/// use drape_cloth::{Cloth, Lattice, Seam, SeamBending};
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
/// // Two squares of 3 × 3 particles: the right side of the first is sewn to the left side of the
/// // second.
/// let square = Lattice::rectangle(0.02, 0.02, 0.01)?;
/// let panels = [(&square, &fabric), (&square, &fabric)];
/// let seams = SeamBending::new(&panels, &[Seam::new(vec![[2, 9], [5, 12], [8, 15]])])?;
/// let place = |shift: f64| square.coordinates.iter().flat_map(move |c| [c[0] + shift, c[1], 0.0]);
/// let flat: Vec<f64> = place(0.0).chain(place(0.02)).collect();
/// let state = seams.state(&flat)?;
/// assert!(seams.potential(&state, &flat).abs() < 1e-18);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SeamBending {
    connectors: Vec<SeamConnector>,
    particles: usize,
}

/// Memories of seams, and the normals at the last commit. Only [`SeamBending::commit`] writes it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SeamState {
    memories: Vec<Memory>,
    normals: Vec<Vector>,
}

impl SeamState {
    /// Returns whether this may follow another state of the same seams: it has as many memories, and
    /// normals that are finite.
    #[must_use]
    pub fn may_follow(&self, other: &Self) -> bool {
        let lengths = |own: &Self| [own.memories.len(), own.normals.len()];
        lengths(self) == lengths(other) && self.normals.iter().flatten().all(|x| x.is_finite())
    }

    /// All memories, for hashing and comparing, in a fixed order.
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
    /// Returns the seams of a [`Cloth`](crate::Cloth) of the same panels, whose particles have the
    /// same numbers.
    ///
    /// Where two neighbours on one side are the same particle, as where a seam runs over the mouth
    /// of a dart, and at the breaks of a seam, nothing bends between them.
    ///
    /// # Errors
    /// When a seam has fewer than two pairs, a particle does not exist, neighbours on a side of the
    /// seam are not neighbours on the outline of the panel, a particle is tied to particles that are not
    /// on the other side of the seam, or a stiffness or an angle is out of range.
    pub fn new(panels: &[(&Lattice, &Fabric)], seams: &[Seam]) -> Result<Self, Error> {
        let builder = SeamBuilder::of(panels);
        let mut connectors = Vec::new();
        for (index, seam) in seams.iter().enumerate() {
            let wrong = |problem: SeamProblem| Error::Seam {
                seam: index,
                pair: problem.pair,
                what: problem.what,
            };
            builder.append(seam, &mut connectors).map_err(wrong)?;
        }
        Ok(Self { connectors, particles: builder.particles() })
    }

    /// Returns the state of seams that start at given positions without friction.
    ///
    /// # Errors
    /// When there are not three numbers for every particle.
    pub fn state(&self, positions: &[f64]) -> Result<SeamState, Error> {
        if positions.len() != 3 * self.particles {
            let (found, particles) = (positions.len(), self.particles);
            return Err(Error::Positions { found, particles });
        }
        let connectors = self.connectors.iter();
        let normals: Vec<Vector> = connectors.map(|one| one.normal(positions)).collect();
        let memory = |(connector, normal): (&SeamConnector, &Vector)| {
            let position = connector.curvature(positions, *normal);
            Memory { position, peak: position.abs(), ..Memory::default() }
        };
        let memories = self.connectors.iter().zip(&normals).map(memory).collect();
        Ok(SeamState { memories, normals })
    }

    /// Pairs of particles that seams join, the first of each less than the second; some occur more
    /// than once.
    pub fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        self.connectors.iter().flat_map(|connector| {
            let nodes = connector.nodes.iter().enumerate();
            nodes.flat_map(|(k, first)| {
                connector.nodes[k + 1..].iter().map(move |second| [first.node, second.node])
            })
        })
    }

    fn each<'a>(&'a self, state: &'a SeamState) -> impl Iterator<Item = ConnectorState<'a>> {
        let all = self.connectors.iter().zip(&state.memories).zip(&state.normals);
        all.map(|((connector, memory), normal)| ConnectorState {
            connector,
            memory,
            normal: *normal,
        })
    }

    /// Adds the forces of all seams at trial positions, in N.
    pub fn add_forces(&self, state: &SeamState, trial: &[f64], forces: &mut [f64]) {
        for one in self.each(state) {
            let moment = one.respond(trial, false).gradient;
            for &WeightedNode { node, weight } in &one.connector.nodes {
                add_at(forces, node, scale(moment, -one.connector.area * weight));
            }
        }
    }

    /// Returns the potential of the seams within a step, in J: its negative derivative is
    /// [`SeamBending::add_forces`]. Only differences at one state are meaningful.
    #[must_use]
    pub fn potential(&self, state: &SeamState, trial: &[f64]) -> f64 {
        let energy =
            |one: ConnectorState<'_>| one.connector.area * one.respond(trial, false).energy;
        self.each(state).map(energy).sum()
    }

    /// Passes the derivative of the forces with respect to the trial positions, negated, in N/m, to
    /// `put`: blocks of nine numbers, row by row, with the particles of row and column, the row
    /// never greater than the column.
    ///
    /// Every block is symmetric. A block of two different particles stands for its transpose too;
    /// where both are sewn into one particle, it counts twice there. With `definite`, parts that
    /// make the matrix indefinite are left out.
    pub fn add_stiffness(
        &self,
        state: &SeamState,
        trial: &[f64],
        definite: bool,
        mut put: impl FnMut(u32, u32, [f64; 9]),
    ) {
        for one in self.each(state) {
            let hessian = one.respond(trial, definite).hessian;
            let hessian = hessian.as_flattened();
            let SeamConnector { nodes, area, .. } = one.connector;
            for (k, row) in nodes.iter().enumerate() {
                for column in &nodes[k..] {
                    let size = area * row.weight * column.weight;
                    put(row.node, column.node, std::array::from_fn(|k| size * hessian[k]));
                }
            }
        }
    }

    /// Accepts a step: advances all memories and normals, which nothing else writes. Returns the
    /// energy dissipated by friction, in J.
    pub fn commit(&self, state: &mut SeamState, positions: &[f64]) -> f64 {
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
        dissipated
    }

    /// Returns the energy that the seams can return, in J; the positions are those of the last
    /// accepted step.
    #[must_use]
    pub fn stored(&self, state: &SeamState, positions: &[f64]) -> f64 {
        let energy = |one: ConnectorState<'_>| {
            // At the remembered positions the friction has done no work since.
            let elastic = one.respond(positions, false).energy;
            one.connector.area * (elastic + one.connector.law.friction.stored(one.memory.friction))
        };
        self.each(state).map(energy).sum()
    }
}
