pub(crate) mod bend;
pub(crate) mod block;
mod rim;

use drape_fabric::{BendingLaw, Fabric, Law, Memory, ShearLaw, TractionLaw};

use crate::connectors::{Bending, segments};
use crate::field::{Vector, add, dot, scale, subtract};
use crate::reference::bend::{bend, curvature, folded};
use crate::reference::block::{Block, one, outer, sum, transposed};
use crate::reference::rim::{Fitted, Membrane};
use crate::rim::Near;
use crate::{Lattice, Sparsity, State};

/// The connectors of a cloth one by one through the scalar laws, by the textbook.
///
/// It is what [`Cloth`](crate::Cloth) is tested and measured against: the same numbers up to
/// rounding, from code that shares with it which particles a connector joins, the weights of the fits at a rim, and
/// nothing else.
#[derive(Debug, Clone)]
pub struct Reference {
    segments: Vec<Connector<TractionLaw, 2>>,
    corners: Vec<Connector<ShearLaw, 3>>,
    triples: Vec<Connector<BendingLaw, 3>>,
    membranes: Vec<Membrane>,
    fitted: Vec<Fitted>,
    sparsity: Sparsity,
    /// Unit normals at the particles.
    normals: Vec<f64>,
}

/// A connector: a law, the particles of its measure, and the cloth that it stands for.
#[derive(Debug, Clone)]
struct Connector<L, const N: usize> {
    law: L,
    particles: [u32; N],
    /// Rest length of a segment; sign of a corner.
    measure: f64,
    area: f64,
    /// What a fold adds to the rest curvature of a triple, in 1/m.
    fold: f64,
    memory: Memory,
    /// Blocks of the pairs 00, 11, 01 and, with three particles, 22, 02, 12.
    blocks: [usize; 6],
}

/// Places in [`Connector::particles`] of the pairs in [`Connector::blocks`].
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (0, 1), (2, 2), (0, 2), (1, 2)];

fn at(flat: &[f64], particle: u32) -> Vector {
    let start = 3 * particle as usize;
    [flat[start], flat[start + 1], flat[start + 2]]
}

fn push(flat: &mut [f64], particle: u32, vector: Vector) {
    let start = 3 * particle as usize;
    for (value, part) in flat[start..start + 3].iter_mut().zip(vector) {
        *value += part;
    }
}

/// Length and direction of the way from the first to the second particle.
fn way(positions: &[f64], from: u32, to: u32) -> (f64, Vector) {
    let span = subtract(at(positions, to), at(positions, from));
    let length = dot(span, span).sqrt();
    (length, scale(span, 1.0 / length))
}

/// A corner's sine, the directions and lengths of its two edges, and the gradients of the sine.
struct Corner {
    sine: f64,
    units: [Vector; 2],
    lengths: [f64; 2],
    gradients: [Vector; 2],
}

impl Connector<ShearLaw, 3> {
    fn corner(&self, positions: &[f64]) -> Corner {
        let [centre, warp, weft] = self.particles;
        let (warp_length, warp) = way(positions, centre, warp);
        let (weft_length, weft) = way(positions, centre, weft);
        let cosine = dot(warp, weft);
        let gradient = |along: Vector, other: Vector, length: f64| {
            scale(subtract(other, scale(along, cosine)), self.measure / length)
        };
        Corner {
            sine: self.measure * cosine,
            units: [warp, weft],
            lengths: [warp_length, weft_length],
            gradients: [gradient(warp, weft, warp_length), gradient(weft, warp, weft_length)],
        }
    }

    /// Blocks of the pairs warp–warp, weft–weft and warp–weft.
    fn blocks(&self, positions: &[f64], definite: bool) -> [Block; 3] {
        let Corner { sine, units: [p, q], lengths: [lp, lq], gradients: [gp, gq] } =
            self.corner(positions);
        let response = self.law.respond(&self.memory, sine);
        let tangent = self.area * response.tangent;
        if definite {
            let tangent = tangent.max(0.0);
            return [(gp, gp), (gq, gq), (gp, gq)].map(|(a, b)| sum([(tangent, outer(a, b))]));
        }
        let (load, sign) = (self.area * response.load, self.measure);
        let cosine = sign * sine;
        let across = |e: Vector| sum([(1.0, one()), (-1.0, outer(e, e))]);
        // Second derivatives of the cosine of the angle between two vectors.
        let own = |e: Vector, gradient: Vector, length: f64| {
            sum([
                (tangent, outer(gradient, gradient)),
                (-load / length, outer(gradient, e)),
                (-load / length, outer(e, gradient)),
                (-load * sign * cosine / (length * length), across(e)),
            ])
        };
        let (left, right) = (across(p), across(q));
        let both = [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(left[i], right[j])));
        let mixed = sum([(tangent, outer(gp, gq)), (load * sign / (lp * lq), both)]);
        [own(p, gp, lp), own(q, gq, lq), mixed]
    }
}

impl<L, const N: usize> Connector<L, N> {
    fn new(law: L, particles: [u32; N], (measure, area): (f64, f64), sparsity: &Sparsity) -> Self {
        let block = |(i, j): (usize, usize)| {
            let pair = (particles.get(i)?, particles.get(j)?);
            sparsity.block(*pair.0.min(pair.1), *pair.0.max(pair.1))
        };
        Self {
            law,
            particles,
            measure,
            area,
            fold: 0.0,
            memory: Memory::default(),
            // A segment has the first three.
            blocks: PAIRS.map(|pair| block(pair).unwrap_or(usize::MAX)),
        }
    }

    /// Adds a block of one of the [`PAIRS`].
    fn put(&self, pair: usize, block: Block, values: &mut [f64]) {
        let (i, j) = PAIRS[pair];
        let turned = self.particles[i] > self.particles[j];
        let block = if turned { transposed(block) } else { block };
        let values = &mut values[9 * self.blocks[pair]..][..9];
        for (value, entry) in values.iter_mut().zip(block.as_flattened()) {
            *value += entry;
        }
    }
}

impl<L> Connector<L, 3> {
    /// Bow of a triple whose segments are `measure` long.
    fn bow(&self, positions: &[f64]) -> Vector {
        let [before, middle, after] = self.particles.map(|p| at(positions, p));
        let bow = subtract(add(before, after), scale(middle, 2.0));
        scale(bow, 1.0 / (self.measure * self.measure))
    }

    /// Curvature about the normal.
    fn curvature(&self, positions: &[f64], normal: Vector) -> f64 {
        curvature(self.bow(positions), normal, self.measure)
    }
}

impl Connector<BendingLaw, 3> {
    /// Derivatives of the energy at the trial with respect to the bow, and the energy.
    fn bend(&self, positions: &[f64], normals: &[f64], definite: bool) -> (Vector, Block, f64) {
        let bow = (self.bow(positions), at(normals, self.particles[1]));
        let law = (&self.law, &self.memory);
        if self.fold != 0.0 {
            return folded(law, bow, (self.measure, self.fold), definite);
        }
        bend(law, bow, self.measure, definite)
    }
}

/// Moves a memory on; returns the energy lost per area, in J/m².
fn move_on(law: &impl Law, memory: &mut Memory, to: f64) -> f64 {
    let after = law.commit(memory, to);
    let lost = law.work(memory, to) - (law.stored(&after) - law.stored(memory));
    *memory = after;
    lost
}

impl Reference {
    /// The connectors of panels in a given shape, with no friction in any of them. The sparsity and
    /// the normals are those of the cloth and its state.
    #[must_use]
    pub fn new(panels: &[(&Lattice, &Fabric)], sparsity: &Sparsity, state: &State) -> Self {
        let (positions, normals) = (state.positions.as_slice(), state.normals());
        let mut all = Self {
            segments: Vec::new(),
            corners: Vec::new(),
            triples: Vec::new(),
            membranes: Vec::new(),
            fitted: Vec::new(),
            sparsity: sparsity.clone(),
            normals: normals.to_vec(),
        };
        let mut first = 0;
        for (lattice, fabric) in panels {
            all.add_panel(lattice, fabric, first);
            first += lattice.coordinates.len() as u32;
        }
        for segment in &mut all.segments {
            let (length, _) = way(positions, segment.particles[0], segment.particles[1]);
            segment.memory.position = length / segment.measure - 1.0;
            segment.memory.peak = segment.memory.position.max(0.0);
        }
        for corner in &mut all.corners {
            corner.memory.position = corner.corner(positions).sine;
            corner.memory.peak = corner.memory.position.abs();
        }
        for triple in &mut all.triples {
            let normal = at(normals, triple.particles[1]);
            triple.memory.position = triple.curvature(positions, normal);
            triple.memory.peak = triple.memory.position.abs();
        }
        all.membranes.iter_mut().for_each(|membrane| membrane.start(positions));
        all.fitted.iter_mut().for_each(|fitted| fitted.start(positions, normals));
        all
    }

    fn add_panel(&mut self, lattice: &Lattice, fabric: &Fabric, first: u32) {
        let Self { sparsity, .. } = self;
        for (cell, areas) in lattice.cells.iter().zip(lattice.sheared()) {
            let [a, b, c, d] = cell.corners;
            // Corner, neighbour along the warp (v), neighbour along the weft (u), sign.
            let around = [(a, d, b, 1.0), (b, c, a, -1.0), (c, b, d, 1.0), (d, a, c, -1.0)];
            for ((corner, warp, weft, sign), area) in around.into_iter().zip(areas) {
                let particles = [corner, warp, weft].map(|p| first + p);
                let corner = Connector::new(fabric.shear, particles, (sign, area), sparsity);
                self.corners.push(corner);
            }
        }
        let near = Near::of(lattice);
        let bending = Bending::of(lattice, &lattice.areas(), near.as_ref());
        if let Some(near) = &near {
            self.membranes.extend(Membrane::of(lattice, fabric, first));
            self.fitted.extend(Fitted::of((lattice, near, &bending), fabric, first));
        }
        let [across, along] = lattice.spacing;
        let sides = [(&fabric.warp, along), (&fabric.weft, across)];
        for (direction, yarns) in lattice.yarns().iter().enumerate() {
            let (laws, measure) = sides[direction];
            for (ends, area) in segments(lattice, yarns, direction) {
                let (ends, size) = (ends.map(|p| first + p), (measure, area));
                self.segments.push(Connector::new(laws.traction, ends, size, sparsity));
            }
            for (triple, area) in &bending[direction].triples {
                let fold = bending[direction].folded.get(triple[1] as usize);
                let (triple, size) = (triple.map(|p| first + p), (measure, *area));
                let connector = Connector::new(laws.bending, triple, size, sparsity);
                self.triples.push(Connector { fold: fold.copied().unwrap_or(0.0), ..connector });
            }
        }
    }

    /// As [`Cloth::add_forces`](crate::Cloth::add_forces).
    pub fn add_forces(&self, trial: &[f64], forces: &mut [f64]) {
        for segment in &self.segments {
            let [a, b] = segment.particles;
            let (length, unit) = way(trial, a, b);
            let strain = length / segment.measure - 1.0;
            let load = segment.law.respond(&segment.memory, strain).load;
            let pull = scale(unit, load * segment.area / segment.measure);
            push(forces, a, pull);
            push(forces, b, scale(pull, -1.0));
        }
        for corner in &self.corners {
            let [c, p, f] = corner.particles;
            let Corner { sine, gradients: [warp, weft], .. } = corner.corner(trial);
            let load = corner.area * corner.law.respond(&corner.memory, sine).load;
            push(forces, p, scale(warp, -load));
            push(forces, f, scale(weft, -load));
            push(forces, c, scale(add(warp, weft), load));
        }
        for triple in &self.triples {
            let (moment, ..) = triple.bend(trial, &self.normals, false);
            let pull = scale(moment, triple.area / (triple.measure * triple.measure));
            for (particle, weight) in triple.particles.into_iter().zip([-1.0, 2.0, -1.0]) {
                push(forces, particle, scale(pull, weight));
            }
        }
        self.membranes.iter().for_each(|membrane| membrane.add_forces(trial, forces));
        for fitted in &self.fitted {
            fitted.add_forces(trial, &self.normals, forces);
        }
    }

    /// As [`Cloth::potential`](crate::Cloth::potential), but another constant.
    #[must_use]
    pub fn potential(&self, trial: &[f64]) -> f64 {
        let segments = self.segments.iter().map(|segment| {
            let (length, _) = way(trial, segment.particles[0], segment.particles[1]);
            let strain = length / segment.measure - 1.0;
            segment.area * segment.law.work(&segment.memory, strain)
        });
        let corners = self.corners.iter().map(|corner| {
            let sine = corner.corner(trial).sine;
            corner.area * corner.law.work(&corner.memory, sine)
        });
        let triples = self
            .triples
            .iter()
            .map(|triple| triple.area * triple.bend(trial, &self.normals, false).2);
        let membranes = self.membranes.iter().map(|membrane| membrane.potential(trial));
        let fitted = self.fitted.iter().map(|fitted| fitted.potential(trial, &self.normals));
        segments.chain(corners).chain(triples).chain(membranes).chain(fitted).sum()
    }

    /// As [`Cloth::add_stiffness`](crate::Cloth::add_stiffness).
    pub fn add_stiffness(&self, trial: &[f64], definite: bool, values: &mut [f64]) {
        for segment in &self.segments {
            let [a, b] = segment.particles;
            let (length, unit) = way(trial, a, b);
            let (rest, area) = (segment.measure, segment.area);
            let response = segment.law.respond(&segment.memory, length / rest - 1.0);
            let mut along = area * response.tangent / (rest * rest);
            let mut across = area * response.load / (rest * length);
            if definite {
                (along, across) = (along.max(0.0), across.max(0.0));
            }
            let block = sum([(across, one()), (along - across, outer(unit, unit))]);
            segment.put(0, block, values);
            segment.put(1, block, values);
            segment.put(2, sum([(-1.0, block)]), values);
        }
        for corner in &self.corners {
            let [pp, ff, pf] = corner.blocks(trial, definite);
            let cp = sum([(-1.0, pp), (-1.0, transposed(pf))]);
            let cf = sum([(-1.0, pf), (-1.0, ff)]);
            let cc = sum([(-1.0, cp), (-1.0, cf)]);
            for (pair, block) in [cc, pp, cp, ff, cf, pf].into_iter().enumerate() {
                corner.put(pair, block, values);
            }
        }
        for triple in &self.triples {
            let (_, block, _) = triple.bend(trial, &self.normals, definite);
            let size = triple.area / triple.measure.powi(4);
            // Products of the weights 1, −2, 1.
            for (pair, weight) in [1.0, 4.0, -2.0, 1.0, 1.0, -2.0].into_iter().enumerate() {
                triple.put(pair, sum([(weight * size, block)]), values);
            }
        }
        let mut put = |[row, column]: [u32; 2], block: Block| {
            let slot = self.sparsity.block(row, column).unwrap_or(usize::MAX);
            let values = &mut values[9 * slot..][..9];
            for (value, entry) in values.iter_mut().zip(block.as_flattened()) {
                *value += entry;
            }
        };
        for membrane in &self.membranes {
            membrane.add_stiffness(trial, definite, &mut put);
        }
        for fitted in &self.fitted {
            fitted.add_stiffness((trial, &self.normals), definite, &mut put);
        }
    }

    /// As [`Cloth::commit`](crate::Cloth::commit), with the normals of the state after it; returns
    /// the energy lost on the way, in J.
    pub fn commit(&mut self, positions: &[f64], normals: &[f64]) -> f64 {
        self.normals.copy_from_slice(normals);
        let mut lost = 0.0;
        for segment in &mut self.segments {
            let (length, _) = way(positions, segment.particles[0], segment.particles[1]);
            let strain = length / segment.measure - 1.0;
            lost += segment.area * move_on(&segment.law, &mut segment.memory, strain);
        }
        for corner in &mut self.corners {
            let sine = corner.corner(positions).sine;
            lost += corner.area * move_on(&corner.law, &mut corner.memory, sine);
        }
        for triple in &mut self.triples {
            let normal = at(normals, triple.particles[1]);
            let curvature = triple.curvature(positions, normal);
            lost += triple.area * move_on(&triple.law, &mut triple.memory, curvature);
        }
        let membranes = self.membranes.iter_mut();
        lost += membranes.map(|membrane| membrane.commit(positions)).sum::<f64>();
        let fitted = self.fitted.iter_mut();
        lost += fitted.map(|fitted| fitted.commit(positions, normals)).sum::<f64>();
        lost
    }
}
