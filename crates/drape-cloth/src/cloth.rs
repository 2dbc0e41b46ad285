use drape_fabric::{Fabric, Memories};

use crate::connectors::Bending;
use crate::field::{Vector, dot};
use crate::panel::{Panel, Strip};
use crate::rim::{Near, Rim};
use crate::state::{History, State};
use crate::tangent::{Tangent, tangents};
use crate::workspace::Trial;
use crate::{Error, Lattice, Sparsity, Tie, Workspace};

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
    pub(crate) panels: Vec<Panel>,
    pub(crate) strips: Vec<Strip>,
    pub(crate) rims: Vec<Rim>,
    sparsity: Sparsity,
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
            panels: Vec::new(),
            strips: Vec::new(),
            rims: Vec::new(),
            sparsity: Sparsity::default(),
        };
        panels.iter().for_each(|(lattice, fabric)| cloth.add_panel(lattice, fabric));
        let pairs = cloth.panels.iter().flat_map(Panel::pairs);
        let pairs = pairs.chain(cloth.rims.iter().flat_map(Rim::pairs));
        cloth.sparsity = Sparsity::new(cloth.particles(), pairs);
        for (index, panel) in cloth.panels.iter_mut().enumerate() {
            panel.connect(&cloth.sparsity);
            panel.cut(index, &cloth.sparsity, &mut cloth.strips);
        }
        cloth.rims.iter_mut().for_each(|rim| rim.connect(&cloth.sparsity));
        cloth
    }

    fn add_panel(&mut self, lattice: &Lattice, fabric: &Fabric) {
        let first = self.particles() as u32;
        let areas = lattice.areas();
        let near = Near::of(lattice);
        let bending = Bending::of(lattice, &areas, near.as_ref());
        if let Some(near) = &near {
            let ends = self.rims.last().map_or([0; 2], Rim::end);
            let rim = Rim::new((lattice, first), &bending, near, ends);
            self.rims.push(Rim { index: self.rims.len(), panel: self.panels.len(), ..rim });
        }
        let tangents = tangents(&lattice.yarns(), first, areas.len());
        self.tangents.extend(tangents);
        let base = self.panels.iter().map(Panel::length).sum();
        let panel = Panel::new(lattice, fabric, (first, base), &bending);
        self.panels.push(panel);
        let weighed = lattice.weighed(&areas);
        self.masses.extend(weighed.iter().map(|area| area * fabric.density));
        self.coordinates.extend(&lattice.coordinates);
        self.triangles.extend(lattice.triangles().iter().map(|t| t.map(|p| first + p)));
        self.areas.extend(areas);
    }

    /// Returns the cloth with the masses of tied particles moved to the two particles that each lies
    /// between; their sum and their centre stay.
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

    /// Masses of the particles, in kg: of the areas that they stand for, and of allowances.
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
    pub fn sparsity(&self) -> &Sparsity {
        &self.sparsity
    }

    /// Area that the connectors of each kind stand for, in m².
    #[must_use]
    pub fn connector_areas(&self) -> Areas {
        let sum = |column: fn(&Panel, usize) -> &[f64], which: usize| -> f64 {
            self.panels.iter().flat_map(|p| column(p, which)).sum()
        };
        let traction = |d| sum(|panel, d| &panel.yarns[d].segment_areas, d);
        let bending = |d| sum(|panel, d| &panel.yarns[d].triple_areas, d);
        let triangles: f64 = self.rims.iter().flat_map(|rim| &rim.triangles.areas).sum();
        let stencils =
            |d: usize| -> f64 { self.rims.iter().flat_map(|rim| &rim.stencils.areas[d]).sum() };
        Areas {
            traction: [0, 1].map(|d| traction(d) + triangles),
            shear: (0..4).map(|c| sum(|panel, c| &panel.corners[c], c)).sum::<f64>() + triangles,
            bending: [0, 1].map(|d| bending(d) + stencils(d)),
        }
    }

    /// The cloth at rest in a given shape, with no friction in any connector.
    ///
    /// # Errors
    /// When there are not three numbers for every particle.
    pub fn state(&self, positions: Vec<f64>) -> Result<State, Error> {
        let particles = self.particles();
        if positions.len() != 3 * particles {
            return Err(Error::Positions { found: positions.len(), particles });
        }
        let mut state = State {
            velocities: vec![0.0; positions.len()],
            normals: vec![0.0; positions.len()],
            history: History::new(&self.panels, &self.rims),
            positions,
        };
        self.turn_normals(&mut state);
        self.workspace().start(self, &mut state);
        Ok(state)
    }

    /// Returns trial positions of this cloth from a state, for a [`Workspace`].
    #[must_use]
    pub fn trial<'a>(&'a self, state: &'a State, positions: &'a [f64]) -> Trial<'a> {
        Trial { cloth: self, state, positions }
    }

    /// Room for evaluating this cloth again and again without allocating.
    #[must_use]
    pub fn workspace(&self) -> Workspace {
        Workspace::new(self)
    }

    /// Adds the forces of all connectors at trial positions, in N. See [`Workspace`] for doing it
    /// often.
    pub fn add_forces(&self, state: &State, trial: &[f64], forces: &mut [f64]) {
        self.workspace().add_forces(self.trial(state, trial), forces);
    }

    /// Potential of the connectors within a step, in J: its negative derivative with respect to the
    /// trial positions is [`Cloth::add_forces`]. Only differences at one state mean anything.
    #[must_use]
    pub fn potential(&self, state: &State, trial: &[f64]) -> f64 {
        self.workspace().potential(self.trial(state, trial))
    }

    /// Adds the derivative of the forces with respect to the trial positions, negated, in N/m, to
    /// the blocks of [`Cloth::sparsity`].
    ///
    /// With `definite`, parts that make the matrix indefinite are left out: compression across a
    /// segment, and the turning of the shear's gradient.
    pub fn add_stiffness(&self, state: &State, trial: &[f64], definite: bool, values: &mut [f64]) {
        self.workspace().add_stiffness(self.trial(state, trial), definite, values);
    }

    /// Accepts a step: advances positions, velocities and all memories, which nothing else writes.
    /// Returns the energy dissipated by the fabric's friction, in J.
    pub fn commit(&self, state: &mut State, positions: &[f64], velocities: &[f64]) -> f64 {
        self.workspace().commit(self, state, positions, velocities)
    }

    /// Energy that the connectors can give back, in J.
    #[must_use]
    pub fn stored(&self, state: &State) -> f64 {
        self.workspace().stored(self, state)
    }

    /// How far the cloth is deformed.
    #[must_use]
    pub fn strains(&self, state: &State) -> Strains {
        let (mut traction, mut shear, mut curvature) = (Vec::new(), Vec::new(), Vec::new());
        let History { traction: strains, shear: sines, bending: bends, rim, .. } = &state.history;
        for panel in &self.panels {
            let at = |memories: &Memories, places: &[usize], map: fn(f64) -> f64| -> Vec<f64> {
                let positions = &memories.positions()[panel.base..];
                places.iter().map(|&place| map(positions[place])).collect()
            };
            for (direction, yarns) in panel.yarns.iter().enumerate() {
                traction.extend(at(&strains[direction], &yarns.segments, |s| s));
                curvature.extend(at(&bends[direction], &yarns.triples, f64::abs));
            }
            for memories in sines {
                shear.extend(at(memories, &panel.cells, f64::abs));
            }
        }
        for Rim { triangles, stencils, .. } in &self.rims {
            for direction in 0..2 {
                let positions = &rim.traction[direction].positions()[triangles.base..];
                traction.extend(&positions[..triangles.count]);
                let bends = rim.bending[direction].positions()[stencils.base..].iter();
                let areas = &stencils.areas[direction];
                let bends = bends.zip(areas).filter(|(_, area)| **area > 0.0);
                curvature.extend(bends.map(|(bend, _)| bend.abs()));
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

    /// Turns the normals with the surface: `$u \times v$` of the yarns' tangents.
    pub(crate) fn turn_normals(&self, state: &mut State) {
        let positions = &state.positions;
        let normals = state.normals.chunks_exact_mut(3);
        for (normal, [warp, weft]) in normals.zip(&self.tangents) {
            normal.copy_from_slice(&normal_of([warp.at(positions), weft.at(positions)]));
        }
        for slopes in self.rims.iter().flat_map(|rim| &rim.slopes) {
            let normal = normal_of(slopes.at(positions));
            state.normals[3 * slopes.particle as usize..][..3].copy_from_slice(&normal);
        }
        for panel in &self.panels {
            for (point, _) in panel.occupied.iter().enumerate().filter(|(_, o)| **o) {
                let place = panel.margin + point;
                let start = 3 * panel.particles[place] as usize;
                let normal = std::array::from_fn(|axis| state.normals[start + axis]);
                state.history.normals.set(panel.base + place, normal);
            }
        }
    }
}

/// Unit normal of a surface with tangents along warp and weft.
fn normal_of([v, u]: [Vector; 2]) -> Vector {
    let across = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = dot(across, across).sqrt();
    if length > 0.0 { across.map(|c| c / length) } else { [0.0, 1.0, 0.0] }
}
