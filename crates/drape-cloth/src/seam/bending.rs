//! What bends across and along seams.

mod pieces;

use drape_fabric::{BendingLaw, Fabric, Law, Memory};

use crate::angle::Angle;
use crate::field::{Vector, add, dot, scale, subtract};
use crate::reference::bend::{bend, curvature};
use crate::reference::block::{Block, outer, sum};
use crate::seam::pieces::Pieces;
use crate::{Error, Lattice};

/// A seam: the nodes that are sewn to each other, and how it bends.
#[derive(Debug, Clone, PartialEq)]
pub struct Seam {
    /// Pairs of particles, one of each side, in the order in which the seam runs; both may be one, as at the tip of a dart.
    pub pairs: Vec<[u32; 2]>,
    /// Particles of the longer side of a gather between them, in the order in which the seam runs.
    pub ties: Vec<Tie>,
    /// How many times as stiff as the fabric a strip along the seam is that is added to the panels.
    pub stiffness: f64,
    /// Angle by which the panels are turned towards their right sides at rest, in rad: 0 if the seam is pressed open.
    pub rest_angle: f64,
}

/// A particle that is sewn to a place between two others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tie {
    /// The particle.
    pub particle: u32,
    /// The two that it lies between: of two pairs that follow each other in a seam those of the other side.
    pub ends: [u32; 2],
    /// Position between them: 0 at the first, 1 at the second.
    pub fraction: f64,
}

/// Bending of seams, besides that of the panels, whose own connectors end at their outlines.
///
/// A seam adds a strip of its own, as wide as the triangles beside it are high on the average and
/// [`Seam::stiffness`] times as stiff as the fabric; so it stands for the plies of the allowances, and holds the panels
/// together where they would meet like the leaves of a book.
///
/// * **Across** a segment the bow is `$(\hat{p} + \hat{q})/w$` with the directions `$\hat{p}$`, `$\hat{q}$` in which the
///   two triangles leave the segment and the mean height `$w$`. Its length is `$\frac{2}{w}\sin\frac{\theta}{2}$` with
///   the angle `$\theta$` between the panels, and the curvature follows as for a triple of a yarn: `$\theta/w$`.
/// * **Along** the seam the bow is, on each side, that of three nodes in a row, and of the next one inside where they do
///   not lie on a line, so that a curved seam on a flat panel has none. In a gather it is that of the shorter side alone,
///   which the longer one follows.
///
/// A curvature `$\kappa$` in a direction at an angle `$\vartheta$` to a yarn bends it by `$\kappa\cos^2\vartheta$`, as on
/// a cylinder; each side has the laws of its own two yarns, friction and all, for half of the strip.
#[derive(Debug, Clone)]
pub struct SeamBending {
    bows: Vec<Bow>,
    particles: usize,
}

/// What seams remember, and the normals that they were measured along. [`SeamBending::commit`] alone writes it.
#[derive(Debug, Clone, PartialEq)]
pub struct SeamState {
    memories: Vec<Memory>,
    normals: Vec<Vector>,
}

/// Bending along one yarn.
#[derive(Debug, Clone)]
struct Bow {
    law: BendingLaw,
    /// Particles in rising order with their weights in the bow, in 1/m².
    parts: Vec<(u32, f64)>,
    /// Over which the angle is measured, in m.
    length: f64,
    /// Area times stiffness, in m².
    area: f64,
    /// Triangles with which the normal turns.
    faces: Vec<Face>,
}

/// A triangle beside a seam.
#[derive(Debug, Clone, Copy)]
struct Face {
    /// Anticlockwise on the right side of its panel.
    corners: [u32; 3],
    /// −1 if its wrong side is on the right side of the seam, 1 otherwise.
    sign: f64,
}

impl Seam {
    /// Stiffness when none is chosen: more than that of two plies that slide on each other, twice
    /// that of one, and less than that of two that do not, eight times.
    pub const STIFFNESS: f64 = 3.0;

    /// Largest rest angle, in rad: up to it angles are exact.
    pub const REST_ANGLE_MAX: f64 = 140.0 * std::f64::consts::PI / 180.0;

    /// A seam of the usual stiffness that is pressed open.
    #[must_use]
    pub fn new(pairs: Vec<[u32; 2]>) -> Self {
        Self { pairs, ties: Vec::new(), stiffness: Self::STIFFNESS, rest_angle: 0.0 }
    }
}

impl SeamState {
    /// All memories, for hashing and comparing, in a fixed order.
    pub fn memories(&self) -> impl Iterator<Item = Memory> {
        self.memories.iter().copied()
    }
}

fn at(positions: &[f64], particle: u32) -> Vector {
    let start = 3 * particle as usize;
    [positions[start], positions[start + 1], positions[start + 2]]
}

impl Bow {
    fn bow(&self, positions: &[f64]) -> Vector {
        let parts = self.parts.iter();
        parts.fold([0.0; 3], |bow, &(node, weight)| add(bow, scale(at(positions, node), weight)))
    }

    /// Unit normal of the seam: the mean of its faces'.
    fn normal(&self, positions: &[f64]) -> Vector {
        let mut sum = [0.0; 3];
        for &Face { corners, sign } in &self.faces {
            let [a, b, c] = corners.map(|node| at(positions, node));
            let (u, v) = (subtract(b, a), subtract(c, a));
            let across =
                [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            let length = dot(across, across).sqrt();
            if length > 0.0 {
                sum = add(sum, scale(across, sign / length));
            }
        }
        let length = dot(sum, sum).sqrt();
        if length > 0.0 { scale(sum, 1.0 / length) } else { [0.0, 1.0, 0.0] }
    }

    fn curvature(&self, positions: &[f64], normal: Vector) -> f64 {
        curvature(self.bow(positions), normal, self.length)
    }

    /// First and second derivative of the energy per area with respect to the bow, and the energy.
    ///
    /// Away from an angle at rest the angle is counted about the normal, as friction is: the difference of two bows is
    /// that of the angles only where these are small.
    fn bend(
        &self,
        (memory, normal): (&Memory, Vector),
        positions: &[f64],
        definite: bool,
    ) -> (Vector, Block, f64) {
        let bow = self.bow(positions);
        if self.law.rest_curvature == 0.0 {
            return bend((&self.law, memory), (bow, normal), self.length, definite);
        }
        let along = dot(bow, normal);
        let angle = Angle::of(along * along, self.length);
        let (first, second) = angle.derivatives(along);
        let to = angle.curvature(along);
        let response = self.law.respond(memory, to);
        let slope = response.tangent * first * first + response.load * second;
        let slope = if definite { slope.max(0.0) } else { slope };
        let elastic = self.law.backbone.energy(to - self.law.rest_curvature);
        let energy = elastic + self.law.friction.work(memory.friction, to - memory.position);
        (scale(normal, response.load * first), sum([(slope, outer(normal, normal))]), energy)
    }
}

impl SeamBending {
    /// The seams of a [`Cloth`](crate::Cloth) of the same panels, whose particles have the same numbers.
    ///
    /// Where two neighbours on one side are the same particle, as where a seam runs over the mouth of a dart, nothing
    /// bends between them.
    ///
    /// # Errors
    /// When a seam has less than two pairs, a particle does not exist, neighbours on a side are not on one side of the
    /// outline, a particle is tied to others than those of the other side, or stiffness or angle are out of bounds.
    pub fn new(panels: &[(&Lattice, &Fabric)], seams: &[Seam]) -> Result<Self, Error> {
        let pieces = Pieces::of(panels);
        let mut bows = Vec::new();
        for (index, seam) in seams.iter().enumerate() {
            let wrong = |(pair, what)| Error::Seam { seam: index, pair, what };
            pieces.sew(seam, &mut bows).map_err(wrong)?;
        }
        Ok(Self { bows, particles: pieces.particles() })
    }

    /// Seams that start in a given shape without friction.
    ///
    /// # Errors
    /// When there are not three numbers for every particle.
    pub fn state(&self, positions: &[f64]) -> Result<SeamState, Error> {
        if positions.len() != 3 * self.particles {
            let (found, particles) = (positions.len(), self.particles);
            return Err(Error::Positions { found, particles });
        }
        let normals: Vec<Vector> = self.bows.iter().map(|bow| bow.normal(positions)).collect();
        let memory = |(bow, normal): (&Bow, &Vector)| {
            let position = bow.curvature(positions, *normal);
            Memory { position, peak: position.abs(), ..Memory::default() }
        };
        let memories = self.bows.iter().zip(&normals).map(memory).collect();
        Ok(SeamState { memories, normals })
    }

    /// Pairs of particles that seams couple, the first of each less than the second; some are there more than once.
    pub fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        self.bows.iter().flat_map(|bow| {
            let with = |(k, &(first, _)): (usize, &(u32, f64))| {
                bow.parts[k + 1..].iter().map(move |&(second, _)| [first, second])
            };
            bow.parts.iter().enumerate().flat_map(with)
        })
    }

    fn each<'a>(
        &'a self,
        state: &'a SeamState,
    ) -> impl Iterator<Item = (&'a Bow, &'a Memory, Vector)> {
        let all = self.bows.iter().zip(&state.memories).zip(&state.normals);
        all.map(|((bow, memory), normal)| (bow, memory, *normal))
    }

    /// Adds the forces of all seams at trial positions, in N.
    pub fn add_forces(&self, state: &SeamState, trial: &[f64], forces: &mut [f64]) {
        for (bow, memory, normal) in self.each(state) {
            let (moment, ..) = bow.bend((memory, normal), trial, false);
            for &(node, weight) in &bow.parts {
                let force = scale(moment, -bow.area * weight);
                let own = &mut forces[3 * node as usize..][..3];
                own.iter_mut().zip(force).for_each(|(sum, f)| *sum += f);
            }
        }
    }

    /// Potential of the seams within a step, in J: its negative derivative is [`SeamBending::add_forces`]. Only
    /// differences at one state mean anything.
    #[must_use]
    pub fn potential(&self, state: &SeamState, trial: &[f64]) -> f64 {
        let energy = |(bow, memory, normal): (&Bow, &Memory, Vector)| {
            bow.area * bow.bend((memory, normal), trial, false).2
        };
        self.each(state).map(energy).sum()
    }

    /// Hands on the derivative of the forces with respect to the trial positions, negated, in N/m: blocks of nine
    /// numbers, row by row, with the particles of row and column, the row never greater than the column.
    ///
    /// Every block is symmetric. One of two different particles stands for its mirror image too; where both are sewn into
    /// one particle, it counts twice there. With `definite`, parts that make the matrix indefinite are left out.
    pub fn add_stiffness(
        &self,
        state: &SeamState,
        trial: &[f64],
        definite: bool,
        mut put: impl FnMut(u32, u32, [f64; 9]),
    ) {
        for (bow, memory, normal) in self.each(state) {
            let (_, block, _) = bow.bend((memory, normal), trial, definite);
            let block = block.as_flattened();
            for (k, &(row, weight)) in bow.parts.iter().enumerate() {
                for &(column, factor) in &bow.parts[k..] {
                    let size = bow.area * weight * factor;
                    put(row, column, std::array::from_fn(|k| size * block[k]));
                }
            }
        }
    }

    /// Accepts a step: advances all memories and normals, which nothing else writes. Returns the energy
    /// dissipated by friction, in J.
    pub fn commit(&self, state: &mut SeamState, positions: &[f64]) -> f64 {
        let mut dissipated = 0.0;
        let memories = state.memories.iter_mut().zip(&mut state.normals);
        for (bow, (memory, normal)) in self.bows.iter().zip(memories) {
            *normal = bow.normal(positions);
            let to = bow.curvature(positions, *normal);
            let after = bow.law.commit(memory, to);
            let gained = bow.law.stored(&after) - bow.law.stored(memory);
            dissipated += bow.area * (bow.law.work(memory, to) - gained);
            *memory = after;
        }
        dissipated
    }

    /// Energy that the seams can give back, in J; the positions are those of the last accepted step.
    #[must_use]
    pub fn stored(&self, state: &SeamState, positions: &[f64]) -> f64 {
        let energy = |(bow, memory, normal): (&Bow, &Memory, Vector)| {
            // Where the memory was written the friction does no work.
            let elastic = bow.bend((memory, normal), positions, false).2;
            bow.area * (elastic + bow.law.friction.stored(memory.friction))
        };
        self.each(state).map(energy).sum()
    }
}
