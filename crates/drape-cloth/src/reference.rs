use drape_fabric::Fabric;

use crate::bending::Bending;
use crate::shear::Shear;
use crate::state::State;
use crate::tangent::{Tangent, tangents};
use crate::traction::Traction;
use crate::vector::Vector;
use crate::{ClothError, Lattice, Pattern};

/// A cloth: particles joined by traction, shearing and bending connectors. Constant in time.
///
/// A connector is a measure (a strain of a few particles) × a law of the fabric × the area of cloth
/// that it stands for, and pulls its particles with the derivative of area times work density,
///
/// ```math
/// f_i = -W\,T(s)\,\frac{\partial s}{\partial x_i}
/// ```
///
/// which conserves momentum exactly and does not depend on the spacing of the particles. The forces
/// of [Ngo Ngoc & Boivin 2004, eqs. 4–5] agree with it to first order if the lever arm is the length
/// of a yarn segment.
#[derive(Debug, Clone)]
pub struct Cloth {
    masses: Vec<f64>,
    areas: Vec<f64>,
    coordinates: Vec<[f64; 2]>,
    triangles: Vec<[u32; 3]>,
    tangents: Vec<[Tangent; 2]>,
    traction: Vec<Traction>,
    shear: Vec<Shear>,
    bending: Vec<Bending>,
    pattern: Pattern,
}

/// Area that the connectors of each kind stand for, in m²; each is the area of the cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Areas {
    /// Segments along the warp and along the weft.
    pub traction: [f64; 2],
    /// Corners.
    pub shear: f64,
    /// Triples along the warp and along the weft.
    pub bending: [f64; 2],
}

/// How far a cloth is deformed.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Strains {
    /// Largest strain of a segment, a ratio.
    pub traction_max: f64,
    /// Strain that 99 of 100 segments do not exceed, a ratio.
    pub traction_p99: f64,
    /// Largest shear angle of a corner, in rad.
    pub shear_max: f64,
    /// Curvature that 99 of 100 triples do not exceed, in 1/m.
    pub curvature_p99: f64,
}

/// What a step has cost.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Committed {
    /// Energy lost in the fabric's friction, in J.
    pub dissipated: f64,
}

impl Cloth {
    /// A cloth of panels, each with its fabric; the particles are numbered panel by panel.
    #[must_use]
    pub fn new(panels: &[(&Lattice, &Fabric)]) -> Self {
        let mut cloth = Self {
            masses: Vec::new(),
            areas: Vec::new(),
            coordinates: Vec::new(),
            triangles: Vec::new(),
            tangents: Vec::new(),
            traction: Vec::new(),
            shear: Vec::new(),
            bending: Vec::new(),
            pattern: Pattern {
                offsets: Vec::new(),
                columns: Vec::new(),
            },
        };
        panels
            .iter()
            .for_each(|(lattice, fabric)| cloth.add_panel(lattice, fabric));
        let edges = cloth
            .traction
            .iter()
            .flat_map(|t| &t.ends)
            .map(|e| e.as_slice());
        let corners = cloth
            .shear
            .iter()
            .flat_map(|s| &s.corners)
            .map(|c| c.as_slice());
        let triples = cloth
            .bending
            .iter()
            .flat_map(|b| &b.triples)
            .map(|t| t.as_slice());
        cloth.pattern = Pattern::new(cloth.particles(), edges.chain(corners).chain(triples));
        cloth
            .traction
            .iter_mut()
            .for_each(|t| t.connect(&cloth.pattern));
        cloth
            .shear
            .iter_mut()
            .for_each(|s| s.connect(&cloth.pattern));
        cloth
            .bending
            .iter_mut()
            .for_each(|b| b.connect(&cloth.pattern));
        cloth
    }

    fn add_panel(&mut self, lattice: &Lattice, fabric: &Fabric) {
        let first = self.particles() as u32;
        let mut areas = vec![0.0; lattice.coordinates.len()];
        let mut corners = Vec::new();
        for cell in &lattice.cells {
            let [a, b, c, d] = cell.corners;
            // Corner, neighbour along the warp (v), neighbour along the weft (u), sign.
            let around = [
                (a, d, b, 1.0),
                (b, c, a, -1.0),
                (c, b, d, 1.0),
                (d, a, c, -1.0),
            ];
            for ((corner, warp, weft, sign), area) in around.into_iter().zip(cell.quadrants) {
                areas[corner as usize] += area;
                corners.push(([corner, warp, weft].map(|p| first + p), sign, area));
            }
        }
        let yarns = lattice.yarns();
        self.tangents.extend(tangents(&yarns, first, areas.len()));
        let laws = [&fabric.warp, &fabric.weft];
        let [across, along] = lattice.spacing;
        for (direction, length) in [along, across].into_iter().enumerate() {
            let mut edges = segments(lattice, &yarns[direction], length, direction);
            let mut bends = triples(lattice, &yarns[direction], &areas);
            edges
                .iter_mut()
                .for_each(|edge| edge.0 = edge.0.map(|p| first + p));
            bends
                .iter_mut()
                .for_each(|bend| bend.0 = bend.0.map(|p| first + p));
            self.traction
                .push(Traction::new(laws[direction].traction, edges));
            self.bending
                .push(Bending::new(laws[direction].bending, length, bends));
        }
        self.shear.push(Shear::new(fabric.shear, corners));
        self.masses
            .extend(areas.iter().map(|area| area * fabric.density));
        self.coordinates.extend(&lattice.coordinates);
        self.triangles
            .extend(lattice.triangles().iter().map(|t| t.map(|p| first + p)));
        self.areas.extend(areas);
    }

    /// Number of particles.
    #[must_use]
    pub fn particles(&self) -> usize {
        self.masses.len()
    }

    /// Masses of the particles, in kg.
    #[must_use]
    pub fn masses(&self) -> &[f64] {
        &self.masses
    }

    /// Areas that the particles stand for, in m².
    #[must_use]
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// Material coordinates (u along the weft, v along the warp) of the particles, in m.
    #[must_use]
    pub fn coordinates(&self) -> &[[f64; 2]] {
        &self.coordinates
    }

    /// Triangles of the surface.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Which pairs of particles the connectors couple.
    #[must_use]
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Area that the connectors of each kind stand for, in m².
    #[must_use]
    pub fn connector_areas(&self) -> Areas {
        // Sets of connectors alternate between warp and weft.
        let traction = |direction: usize| -> f64 {
            self.traction
                .iter()
                .skip(direction)
                .step_by(2)
                .flat_map(|t| &t.areas)
                .sum()
        };
        let bending = |direction: usize| -> f64 {
            self.bending
                .iter()
                .skip(direction)
                .step_by(2)
                .flat_map(|b| &b.areas)
                .sum()
        };
        Areas {
            traction: [traction(0), traction(1)],
            shear: self.shear.iter().flat_map(|s| &s.areas).sum(),
            bending: [bending(0), bending(1)],
        }
    }

    /// The cloth at rest in a given shape, with no friction in any connector.
    ///
    /// # Errors
    /// When there are not three numbers for every particle.
    pub fn state(&self, positions: Vec<f64>) -> Result<State, ClothError> {
        let particles = self.particles();
        if positions.len() != 3 * particles {
            return Err(ClothError::Positions {
                found: positions.len(),
                particles,
            });
        }
        let mut normals = vec![0.0; positions.len()];
        self.write_normals(&positions, &mut normals);
        Ok(State {
            velocities: vec![0.0; positions.len()],
            traction: self.traction.iter().map(|t| t.start(&positions)).collect(),
            shear: self.shear.iter().map(|s| s.start(&positions)).collect(),
            bending: self
                .bending
                .iter()
                .map(|b| b.start(&normals, &positions))
                .collect(),
            normals,
            positions,
        })
    }

    /// Adds the forces of all connectors at trial positions, in N.
    pub fn add_forces(&self, state: &State, trial: &[f64], forces: &mut [f64]) {
        for (set, memory) in self.traction.iter().zip(&state.traction) {
            set.add_forces(memory, trial, forces);
        }
        for (set, memory) in self.shear.iter().zip(&state.shear) {
            set.add_forces(memory, trial, forces);
        }
        for (set, memory) in self.bending.iter().zip(&state.bending) {
            set.add_forces((memory, &state.normals), trial, forces);
        }
    }

    /// Potential of the connectors within a step, in J: its negative derivative with respect to the
    /// trial positions is [`Cloth::add_forces`]. Only differences at one state mean anything.
    #[must_use]
    pub fn potential(&self, state: &State, trial: &[f64]) -> f64 {
        let traction = self
            .traction
            .iter()
            .zip(&state.traction)
            .map(|(s, m)| s.work(m, trial));
        let shear = self
            .shear
            .iter()
            .zip(&state.shear)
            .map(|(s, m)| s.work(m, trial));
        let bending = self.bending.iter().zip(&state.bending);
        let bending = bending.map(|(s, m)| s.work((m, &state.normals), trial));
        traction.chain(shear).chain(bending).sum()
    }

    /// Adds the derivative of the forces with respect to the trial positions, negated, in N/m, to
    /// the blocks of [`Cloth::pattern`].
    ///
    /// With `definite`, parts that make the matrix indefinite are left out: compression across a
    /// segment, and the turning of the shear's gradient.
    pub fn add_stiffness(&self, state: &State, trial: &[f64], definite: bool, values: &mut [f64]) {
        for (set, memory) in self.traction.iter().zip(&state.traction) {
            set.add_stiffness(memory, trial, definite, values);
        }
        for (set, memory) in self.shear.iter().zip(&state.shear) {
            set.add_stiffness(memory, trial, definite, values);
        }
        for (set, memory) in self.bending.iter().zip(&state.bending) {
            set.add_stiffness((memory, &state.normals), trial, definite, values);
        }
    }

    /// Accepts a step: moves positions, velocities and all memories on. Nothing else writes memory.
    pub fn commit(&self, state: &mut State, positions: &[f64], velocities: &[f64]) -> Committed {
        state.positions.copy_from_slice(positions);
        state.velocities.copy_from_slice(velocities);
        self.write_normals(positions, &mut state.normals);
        let mut dissipated = 0.0;
        for (set, memory) in self.traction.iter().zip(&mut state.traction) {
            dissipated += set.commit(memory, positions);
        }
        for (set, memory) in self.shear.iter().zip(&mut state.shear) {
            dissipated += set.commit(memory, positions);
        }
        for (set, memory) in self.bending.iter().zip(&mut state.bending) {
            dissipated += set.commit(memory, &state.normals, positions);
        }
        Committed { dissipated }
    }

    /// Energy that the connectors can give back, in J.
    #[must_use]
    pub fn stored(&self, state: &State) -> f64 {
        let traction = self
            .traction
            .iter()
            .zip(&state.traction)
            .map(|(s, m)| s.stored(m));
        let shear = self
            .shear
            .iter()
            .zip(&state.shear)
            .map(|(s, m)| s.stored(m));
        let bending = self.bending.iter().zip(&state.bending);
        let bending = bending.map(|(s, m)| s.stored((m, &state.normals), &state.positions));
        traction.chain(shear).chain(bending).sum()
    }

    /// How far the cloth is deformed.
    #[must_use]
    pub fn strains(&self, state: &State) -> Strains {
        let sorted = |mut values: Vec<f64>| {
            values.sort_by(f64::total_cmp);
            values
        };
        let p99 = |values: &[f64]| values[(values.len() - 1) * 99 / 100];
        let set = |memories: &[Vec<drape_fabric::Memory>], map: fn(f64) -> f64| {
            sorted(memories.iter().flatten().map(|m| map(m.position)).collect())
        };
        let traction = set(&state.traction, |strain| strain);
        let shear = set(&state.shear, f64::abs);
        let curvature = set(&state.bending, f64::abs);
        Strains {
            traction_max: traction[traction.len() - 1],
            traction_p99: p99(&traction),
            shear_max: shear[shear.len() - 1].min(1.0).asin(),
            curvature_p99: p99(&curvature),
        }
    }

    /// Normals at the particles: `$u \times v$` of the yarns' tangents.
    fn write_normals(&self, positions: &[f64], normals: &mut [f64]) {
        for (normal, [warp, weft]) in normals.chunks_exact_mut(3).zip(&self.tangents) {
            let vector = weft.at(positions).cross(&warp.at(positions));
            let length = vector.norm();
            let unit = if length > 0.0 {
                vector / length
            } else {
                Vector::y()
            };
            normal.copy_from_slice(unit.as_slice());
        }
    }
}

/// Segments of the yarns with their rest length and area: half of each cell beside them.
fn segments(
    lattice: &Lattice,
    yarns: &[Vec<u32>],
    length: f64,
    direction: usize,
) -> Vec<([u32; 2], f64, f64)> {
    let mut halves = std::collections::BTreeMap::new();
    for cell in &lattice.cells {
        let [a, b, c, d] = cell.corners;
        let q = cell.quadrants;
        let sides = if direction == 0 {
            [([a, d], q[0] + q[3]), ([b, c], q[1] + q[2])]
        } else {
            [([a, b], q[0] + q[1]), ([d, c], q[3] + q[2])]
        };
        for (ends, area) in sides {
            *halves.entry(ends).or_insert(0.0) += area;
        }
    }
    let pairs = yarns.iter().flat_map(|yarn| yarn.windows(2));
    let segment = |pair: &[u32]| {
        let ends = [pair[0], pair[1]];
        halves.get(&ends).map(|&area| (ends, length, area))
    };
    pairs.filter_map(segment).collect()
}

/// Triples of the yarns with their area: that of the middle particle, and of particles that are in
/// the middle of no triple, which the nearest one takes over.
fn triples(lattice: &Lattice, yarns: &[Vec<u32>], areas: &[f64]) -> Vec<([u32; 3], f64)> {
    let mut triples: Vec<([u32; 3], f64)> = Vec::new();
    let mut middle_of = vec![None; areas.len()];
    let windows = yarns.iter().flat_map(|yarn| yarn.windows(3));
    for window in windows {
        middle_of[window[1] as usize] = Some(triples.len());
        triples.push(([window[0], window[1], window[2]], areas[window[1] as usize]));
    }
    // First the neighbour on the same yarn, which lies in the direction of the curvature.
    let mut along = vec![None; areas.len()];
    for yarn in yarns {
        let ends = [
            (yarn[0], yarn[1]),
            (yarn[yarn.len() - 1], yarn[yarn.len() - 2]),
        ];
        for (end, next) in ends {
            along[end as usize] = middle_of[next as usize];
        }
    }
    for (particle, &area) in areas.iter().enumerate() {
        if middle_of[particle].is_some() {
            continue;
        }
        let nearest = || {
            let [u, v] = lattice.coordinates[particle];
            let distance = |triple: &([u32; 3], f64)| {
                let [x, y] = lattice.coordinates[triple.0[1] as usize];
                (x - u).powi(2) + (y - v).powi(2)
            };
            let by_distance =
                |&a: &usize, &b: &usize| distance(&triples[a]).total_cmp(&distance(&triples[b]));
            (0..triples.len()).min_by(by_distance)
        };
        if let Some(taker) = along[particle].or_else(nearest) {
            triples[taker].1 += area;
        }
    }
    triples
}
