use rayon::prelude::*;

use crate::course::Sweep;
use crate::detector::Detector;
use crate::error::{Error, check};
use crate::filter::CcdFilter;
use crate::gap::{Gap, Gradient};
use crate::guards::Guards;
use crate::margin::Margin;
use crate::pair::Pair;
use crate::pinch::Grip;
use crate::slip::{Anchor, FrictionEnergy, Slip};
use crate::surface::Surface;
use crate::surface_settings::SurfaceSettings;
use crate::vector::{Block, at, norm, outer, subtract};
use crate::way::longest_ways;

/// CandidatePairs that are looked at as one, whatever the number of threads.
const CHUNK: usize = 256;

/// ParticleContact of a surface with itself and with bodies: barrier and friction, their forces and derivatives, and a guard
/// of the ways on which it moves.
///
/// The free vertices are the caller's; those of the bodies lie behind them and go straight from where they are at the
/// start of a step to where [`begin`](SurfaceContact::begin) says that they end.
#[derive(Debug)]
pub struct SurfaceContact {
    pub(crate) surface: Surface,
    pub(crate) settings: SurfaceSettings,
    pub(crate) detector: Detector,
    pub(crate) filter: CcdFilter,
    /// Where the bodies' vertices are at the start and at the end of the step, in m.
    pub(crate) bodies: [Vec<f64>; 2],
    pub(crate) progress: f64,
    /// Places of all vertices at which `touching` holds, in m.
    pub(crate) places: Vec<f64>,
    /// How far each vertex is there from where it was detected, in m.
    pub(crate) moved: Vec<f64>,
    /// The pairs within their activation_distance, of every chunk of the list.
    pub(crate) touching: Vec<Vec<Touching>>,
    /// How the free vertices met bodies when the last step was closed; empty if all did as usual.
    pub(crate) grips: Vec<Grip>,
    /// Part of their distances that surfaces kept when the last step was closed.
    pub(crate) grown: f64,
    /// Energy that its growth in the open step put into contact, in J.
    pub(crate) growth_work: f64,
    slips: Vec<Slip>,
    anchors: Vec<Anchor>,
    /// What kept the last detection from being made.
    pub(crate) failure: Option<Error>,
    /// What of a step leads off the course of the pairs, in m.
    pub(crate) astray: Vec<f64>,
    pub(crate) margin: Margin,
    /// Longest ways of a step, in m.
    pub(crate) longest: [f64; 2],
}

/// A pair within its activation_distance.
#[derive(Debug, Clone)]
pub(crate) struct Touching {
    pub(crate) pair: Pair,
    pub(crate) gap: Gap,
}

/// What a [`SurfaceContact`] remembers between two steps: the stretches of friction, where the bodies are, which cloth
/// they pinch, and which part of their distances surfaces keep.
#[derive(Debug, Clone)]
pub struct SurfaceMemory {
    anchors: Vec<Anchor>,
    bodies: Vec<f64>,
    grips: Vec<Grip>,
    grown: f64,
}

impl SurfaceContact {
    /// ParticleContact of a surface whose bodies are at flat positions, in m.
    ///
    /// # Errors
    /// ParticleSettings that are none, or bodies with another number of vertices.
    pub fn new(
        surface: Surface,
        settings: SurfaceSettings,
        bodies: Vec<f64>,
    ) -> Result<SurfaceContact, Error> {
        let positive = |what: &str, value: f64| check(what, value, "above 0", value > 0.0);
        positive("the contact stiffness (N/m³)", settings.stiffness)?;
        positive("the way before sliding (m)", settings.sticking_displacement)?;
        let groups = surface.group_distances().len();
        let prescribed = 3 * (surface.vertex_count() - surface.free_count());
        for (what, needed, found) in [
            ("coefficients of friction", groups * groups, settings.friction_coefficients.len()),
            ("coordinates of bodies", prescribed, bodies.len()),
        ] {
            if needed != found {
                return Err(Error::WrongLength { what, found, needed });
            }
        }
        for &coefficient in &settings.friction_coefficients {
            check("a coefficient of friction", coefficient, "0 or more", coefficient >= 0.0)?;
        }
        let activation_distance = surface
            .group_distances()
            .iter()
            .map(|skin| skin.activation_distance)
            .fold(0.0, f64::max);
        let edge = surface.median_edge_length();
        Ok(SurfaceContact {
            surface,
            settings,
            detector: Detector::default(),
            filter: CcdFilter::default(),
            bodies: [bodies.clone(), bodies],
            progress: 1.0,
            places: Vec::new(),
            moved: Vec::new(),
            touching: Vec::new(),
            grips: Vec::new(),
            grown: 1.0,
            growth_work: 0.0,
            slips: Vec::new(),
            anchors: Vec::new(),
            failure: None,
            astray: Vec::new(),
            margin: Margin::new(activation_distance, edge),
            longest: longest_ways(edge, activation_distance),
        })
    }

    /// What keeps the surfaces apart, for tests to take away.
    #[doc(hidden)]
    pub fn guards(&mut self) -> &mut Guards {
        &mut self.filter.guards
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Where the vertices of the bodies were when the last step was closed, in m.
    pub fn body_positions(&self) -> &[f64] {
        &self.bodies[0]
    }

    /// What kept the last detection from being made: forces are then NaN.
    pub fn failure(&self) -> Option<&Error> {
        self.failure.as_ref()
    }

    /// Opens a step from the free vertices' positions, in m, to the bodies' at its end.
    ///
    /// The bodies go back to where they were when the last step was closed. Friction takes its normal forces from
    /// here.
    pub fn begin(&mut self, start: &[f64], bodies: &[f64]) {
        self.bodies[1].copy_from_slice(bodies);
        self.progress = 0.0;
        self.slips.clear();
        self.grip(start);
        self.look(start);
        let groups = self.surface.group_distances().len();
        let mut slips = std::mem::take(&mut self.slips);
        for Touching { pair, gap } in self.touching() {
            let [a, b] = [pair.vertices[0], pair.vertices[3]];
            let [a, b] = [a, b].map(|vertex| self.surface.group(vertex) as usize);
            let coefficient = self.settings.friction_coefficients[a * groups + b];
            let limit = coefficient * gap.normal_force(self.settings.stiffness);
            if limit > 0.0 {
                slips.push(Slip::new(pair, (gap, &self.places), limit, &self.anchors));
            }
        }
        self.slips = slips;
    }

    /// Puts the bodies to a part of their way in the open step, from 0 to 1.
    pub fn set_obstacle_time(&mut self, progress: f64) {
        self.progress = progress;
    }

    /// Closes a step at the free vertices' positions, in m: what slid stays where it is.
    pub fn commit(&mut self, positions: &[f64]) {
        self.progress = 1.0;
        self.look(positions);
        let stick = self.settings.sticking_displacement;
        self.anchors.clear();
        self.anchors.extend(self.slips.iter().map(|slip| slip.kept(&self.places, stick)));
        let [start, end] = &mut self.bodies;
        start.copy_from_slice(end);
        self.grips.clone_from(&self.surface.grips);
        self.grown = self.surface.grown;
    }

    /// What the contact remembers between two steps.
    pub fn memory(&self) -> SurfaceMemory {
        SurfaceMemory {
            anchors: self.anchors.clone(),
            bodies: self.bodies[0].clone(),
            grips: self.grips.clone(),
            grown: self.grown,
        }
    }

    /// Goes back to what it remembered, as if the steps since had not been closed.
    pub fn restore(&mut self, memory: SurfaceMemory) {
        let SurfaceMemory { anchors, bodies, grips, grown } = memory;
        (self.anchors, self.grips, self.grown) = (anchors, grips.clone(), grown);
        self.hold(grips);
        self.keep(grown);
        self.bodies = [bodies.clone(), bodies];
        self.progress = 1.0;
    }

    /// Adds the forces on the free vertices, in N; NaN where something has no place.
    pub fn add_forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        self.look(positions);
        if self.failure.is_some() {
            return forces.fill(f64::NAN);
        }
        self.each_gradient(|vertices, gradient| {
            for (corner, &vertex) in vertices.iter().enumerate() {
                let first = 3 * vertex as usize;
                if first < forces.len() {
                    for axis in 0..3 {
                        forces[first + axis] -= gradient[3 * corner + axis];
                    }
                }
            }
        });
    }

    /// Work that the bodies do in the open step if it ends at these positions, in J: the forces on them there times
    /// their way.
    pub fn body_work(&mut self, positions: &[f64]) -> f64 {
        self.look(positions);
        let free = 3 * self.surface.free_count();
        let [start, end] = &self.bodies;
        let mut work = 0.0;
        self.each_gradient(|vertices, gradient| {
            for (corner, &vertex) in vertices.iter().enumerate() {
                if let Some(first) = (3 * vertex as usize).checked_sub(free) {
                    for axis in 0..3 {
                        let way = end[first + axis] - start[first + axis];
                        work += gradient[3 * corner + axis] * way;
                    }
                }
            }
        });
        work
    }

    fn each_gradient(&self, mut visit: impl FnMut(&[u32; 4], &Gradient)) {
        let stiffness = self.settings.stiffness;
        let of = |touching: &Touching| touching.gap.gradient(stiffness);
        let gradients = self.touching.par_iter().map(|list| list.iter().map(of).collect());
        let gradients: Vec<Vec<Gradient>> = gradients.collect();
        for (touching, gradient) in self.touching().zip(gradients.iter().flatten()) {
            visit(&touching.pair.vertices, gradient);
        }
        for slip in &self.slips {
            visit(
                &slip.vertices,
                &slip.gradient(&self.places, self.settings.sticking_displacement),
            );
        }
    }

    /// Energy of the contact, the potential of friction in it, in J; infinite or NaN where something has no place.
    pub fn potential(&mut self, positions: &[f64]) -> f64 {
        self.look(positions);
        if self.failure.is_some() {
            return f64::NAN;
        }
        self.barrier() + self.friction_energy().potential
    }

    /// Energy of the barriers at the places looked at last, in J.
    pub(crate) fn barrier(&self) -> f64 {
        let stiffness = self.settings.stiffness;
        self.touching().map(|touching| touching.gap.energy(stiffness)).sum()
    }

    /// Potential of friction at the places looked at last, and the part of it that is lost if the step ends there,
    /// in J.
    pub fn friction_energy(&self) -> FrictionEnergy {
        let stick = self.settings.sticking_displacement;
        let free = self.surface.free_count();
        self.slips.iter().fold(FrictionEnergy::default(), |sum, slip| {
            let FrictionEnergy { potential, dissipated, .. } = slip.energy(&self.places, stick);
            let is_free = |vertex: &u32| (*vertex as usize) < free;
            let on_cloth = if slip.vertices.iter().all(is_free) { dissipated } else { 0.0 };
            FrictionEnergy {
                potential: sum.potential + potential,
                dissipated: sum.dissipated + dissipated,
                dissipated_on_cloth: sum.dissipated_on_cloth + on_cloth,
            }
        })
    }

    /// Hands over the blocks of the second derivative of the potential by two free vertices, row by row, in N/m: for
    /// every two of a pair's once, in either order, and for each with itself.
    ///
    /// It is the part without negative eigenvalues: with the exact one a stack of sheets took no fewer iterations.
    pub fn add_stiffness(&mut self, positions: &[f64], add: &mut dyn FnMut([usize; 2], &[f64; 9])) {
        self.look(positions);
        let free = self.surface.free_count();
        // Both are blocks times the weights of two vertices.
        let mut hand_over = |vertices: [u32; 4], weights: [f64; 4], block: &Block| {
            for a in 0..4 {
                for b in a..4 {
                    let [i, j] = [vertices[a], vertices[b]].map(|vertex| vertex as usize);
                    let weight = weights[a] * weights[b];
                    if i < free && j < free && weight != 0.0 {
                        add([i, j], &block.map(|entry| weight * entry));
                    }
                }
            }
        };
        for Touching { pair, gap } in self.touching() {
            let curvature = gap.gauss_newton(self.settings.stiffness).factor;
            let block = outer(gap.normal()).map(|entry| curvature * entry);
            hand_over(pair.vertices, gap.weights(), &block);
        }
        for slip in &self.slips {
            let block = slip.stiffness(&self.places, self.settings.sticking_displacement);
            hand_over(slip.vertices, slip.weights, &block);
        }
    }

    /// Places of all vertices for the free ones' positions, with the bodies at a part of their way.
    pub(crate) fn all(&self, positions: &[f64], progress: f64) -> Vec<f64> {
        let [start, end] = &self.bodies;
        let way = start.iter().zip(end).map(|(start, end)| {
            // Exact at both ends.
            if progress == 1.0 { *end } else { start + progress * (end - start) }
        });
        positions.iter().copied().chain(way).collect()
    }

    /// Finds what touches at positions.
    pub(crate) fn look(&mut self, positions: &[f64]) {
        let places = self.all(positions, self.progress);
        // NaN is never equal, and so never taken from here.
        if places == self.places && self.failure.is_none() {
            return;
        }
        self.failure = None;
        self.touching.iter_mut().for_each(Vec::clear);
        self.detector.follow(&places);
        // Within half of the margin to both sides no pair comes into activation_distance that was not found.
        if !(self.stray(&places) <= 0.5 * self.detector.pairs().margin()) {
            self.failure = self.detect(&places, Sweep::Still).err();
            self.moved.fill(0.0);
        }
        self.places = places;
        if self.failure.is_some() {
            return;
        }
        let (places, moved) = (&self.places, &self.moved);
        let barrier = self.filter.guards.barrier;
        let near = |pair: &Pair| {
            if pair.distance - pair.most(moved) >= pair.activation_distance || !barrier {
                return None;
            }
            let gap = Gap::new(pair, places);
            // Written so that NaN counts as near.
            (!(gap.distance() >= pair.activation_distance)).then_some(Touching { pair: *pair, gap })
        };
        let chunks = self.detector.pairs().as_slice().par_chunks(CHUNK);
        self.touching.resize_with(chunks.len(), Vec::new);
        let lists = self.touching.par_iter_mut();
        chunks.zip(lists).for_each(|(pairs, list)| list.extend(pairs.iter().filter_map(near)));
    }

    /// The pairs within their activation_distance at the places looked at last.
    pub(crate) fn touching(&self) -> impl Iterator<Item = &Touching> {
        self.touching.iter().flatten()
    }

    /// Detects the pairs that are near each other at places or on a course from there, and how widely to look next.
    pub(crate) fn detect(&mut self, places: &[f64], course: Sweep<'_>) -> Result<(), Error> {
        let margin = self.margin.value();
        let found = self.detector.detect_swept(&self.surface, (places, course), margin)?;
        self.margin.follow(found.as_slice().len(), self.surface.vertex_count());
        Ok(())
    }

    /// Measures how far each vertex is from where it was detected. Returns the farthest, in m.
    pub(crate) fn stray(&mut self, places: &[f64]) -> f64 {
        let detected = self.detector.pairs().positions();
        let way = |vertex| norm(subtract(at(places, vertex), at(detected, vertex)));
        self.moved.clear();
        if detected.len() != places.len() {
            self.moved.resize(places.len() / 3, 0.0);
            return f64::INFINITY;
        }
        self.moved.extend((0..places.len() / 3).map(way));
        // A maximum that keeps NaN.
        self.moved.iter().fold(0.0, |most, &way| if way <= most { most } else { way })
    }
}
