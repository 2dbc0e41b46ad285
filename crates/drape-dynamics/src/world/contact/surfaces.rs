//! Surfaces of panels and bodies, kept apart by a barrier and a step filter.
//!
//! Bodies move here vertex by vertex: from where they belong at the start of the simulation, less
//! what is left of their inflation, by their motion. The solver's step filter asks here how far a
//! trial step may go, and whether an accepted one is free of intersections.

use std::ops::Range;

use drape_collide::{
    Body, Error, PairDistance, SeamIntersections, Shape, SurfaceContact, SurfaceStep, Triangulation,
};
use drape_implicit::{AllowedStep, TrialStep};
use drape_scene::{BodyMotion, DistanceGrowth, Inflation, MotionResolution, Scene, StartSurfaces};
use serde::{Deserialize, Serialize};

use super::step::{ContactEnergy, ContactStep};

/// Fraction of the distance that surfaces keep by which what moves by prescription may deviate from
/// a straight path within a step; what turns faster is given more steps.
const DEVIATION: f64 = 0.05;

/// Multiple of its length that the growth of distances may take before the run fails.
const PATIENCE: f64 = 2.0;

/// Surfaces of a world.
#[derive(Debug)]
pub(crate) struct Surfaces {
    pub(crate) contact: SurfaceContact,
    bodies: Vec<Body>,
    /// Names of the panels and, behind them, of the bodies: of the groups of the surface.
    names: Vec<String>,
    /// Positions at which the bodies' vertices belong at the start of the simulation, in m.
    start: Vec<f64>,
    inflation: Option<Inflating>,
    growth: Option<DistanceGrowth>,
    /// Time at which the growth of distances begins, in s.
    growth_start: f64,
    /// Fraction of the distances that is kept at the start, 0 to 1.
    pub(crate) start_growth_fraction: f64,
    moving: Vec<MovingSurface>,
    /// Vertices of each body among those of all bodies.
    vertices: Vec<Range<usize>>,
    /// Largest speed at which contact stops what moves, in m/s.
    speed_max: f64,
    /// Stiffness of the contact, in N/m³.
    stiffness: f64,
    /// Largest motion of a vertex of a body and of a held particle within a step.
    resolution: MotionResolution,
    /// Number of intersections that were found after steps, which were then taken back.
    pub(crate) intersections_found: usize,
    held: Vec<usize>,
    /// Positions of the bodies' vertices at the end of the step, in m.
    ends: Vec<f64>,
    #[cfg(test)]
    pub(crate) omitted: Omitted,
}

/// Safeguards that tests take away, to see that each is needed.
#[cfg(test)]
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Omitted {
    /// Whether steps are not limited.
    pub(crate) step_filter: bool,
    /// Whether steps are accepted without a test for intersections.
    pub(crate) intersection_test: bool,
    /// Whether the sides of a seam are exempt from contact before they meet.
    pub(crate) open_seams: bool,
    /// Whether the work of bodies that move is left out of the balance of the energy.
    pub(crate) body_work: bool,
}

/// Bodies that start smaller than they are.
#[derive(Debug)]
struct Inflating {
    inflation: Inflation,
    /// Displacements from where the bodies' vertices belong to where they start, in m.
    inward: Vec<f64>,
    /// Positions of the vertices before the motion of their bodies, in m.
    positions: Vec<f64>,
}

/// Surface of a body that moves.
#[derive(Debug)]
struct MovingSurface {
    /// Its vertices among those of all bodies.
    vertices: Range<usize>,
    motion: BodyMotion,
    /// Whether it is a floor, whose corners are too far out for their paths to matter.
    is_floor: bool,
}

/// Growth of distances that began in the run.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct SavedGrowth {
    /// Time until surfaces keep their whole distances, in s.
    pub(crate) seconds: f64,
    /// Time at which it began, in s.
    pub(crate) start: f64,
    /// Fraction of the distances that was kept then.
    pub(crate) fraction: f64,
}

/// Cloth and bodies at new places.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlacedSurfaces<'a> {
    /// Positions of the particles, in m.
    pub(crate) positions: &'a [f64],
    /// Positions of the bodies' vertices, in m.
    pub(crate) bodies: &'a [f64],
    /// Time over which distances that are too short grow, in s.
    pub(crate) growth_seconds: f64,
}

impl Surfaces {
    /// Surfaces of a scene that has been checked, at its start.
    pub(crate) fn new(scene: &Scene) -> Result<Self, Error> {
        let StartSurfaces { mut contact, names, vertices, bodies, inward, min_separation } =
            StartSurfaces::new(scene)?;
        let positions = &scene.start.positions;
        contact.summary_at(positions)?;
        let growth = scene.contact.growth;
        if growth.is_some() {
            contact.shrink_distances(positions)?;
        }
        let moving = scene.bodies.iter().zip(&vertices).filter_map(|(moving, vertices)| {
            let motion = moving.motion.clone()?;
            let is_floor = matches!(moving.body.shape, Shape::Plane);
            Some(MovingSurface { vertices: vertices.clone(), motion, is_floor })
        });
        let held = scene.held_particles();
        Ok(Self {
            start_growth_fraction: contact.growth_fraction(),
            contact,
            bodies: scene.bodies.iter().map(|moving| moving.body.clone()).collect(),
            names,
            inflation: scene.contact.inflation.map(|inflation| Inflating {
                inflation,
                inward,
                positions: bodies.clone(),
            }),
            growth,
            growth_start: 0.0,
            moving: moving.collect(),
            vertices,
            speed_max: scene.stopped_speed(),
            stiffness: scene.contact_stiffness(),
            resolution: MotionResolution {
                path: scene.spacing(),
                deviation: 2.0 * DEVIATION * min_separation,
            },
            intersections_found: 0,
            held: (0..held.len()).filter(|&particle| held[particle]).collect(),
            ends: bodies.clone(),
            start: bodies,
            #[cfg(test)]
            omitted: Omitted::default(),
        })
    }

    /// Bodies at the start of the simulation.
    pub(crate) fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Triangles of a body at a time on the clock of motions, in s, in its own size.
    pub(crate) fn outline(&self, body: usize, time: f64) -> Triangulation {
        let mut outline = self.bodies[body].triangulate().expect("contact has checked it");
        let own = &self.vertices[body];
        let start = &self.start[3 * own.start..3 * own.end];
        let mut places = start.to_vec();
        if let Some(moving) = self.moving.iter().find(|moving| moving.vertices == *own) {
            moving.motion.write_positions(time, start, &mut places);
        }
        outline.vertices = places.as_chunks::<3>().0.to_vec();
        outline
    }

    /// Leads a body along a motion that begins where its vertices are.
    pub(crate) fn lead(&mut self, body: usize, from: &Triangulation, motion: BodyMotion) {
        let vertices = self.vertices[body].clone();
        self.start[3 * vertices.start..3 * vertices.end]
            .copy_from_slice(from.vertices.as_flattened());
        let is_floor = matches!(self.bodies[body].shape, Shape::Plane);
        self.moving.retain(|moving| moving.vertices != vertices);
        self.moving.push(MovingSurface { vertices, motion, is_floor });
    }

    /// Largest speed at which contact stops what moves, in m/s.
    pub(crate) fn speed_max(&self) -> f64 {
        self.speed_max
    }

    /// Stiffness of the contact that stops what moves at a speed, in m/s, in N/m³.
    pub(crate) fn stiffness_of_speed(&self, speed: f64) -> f64 {
        self.stiffness * (speed / self.speed_max).powi(2)
    }

    /// End of the growth of the bodies to their size, in s; none if it is over at a time.
    pub(crate) fn end_of_inflation(&self, time: f64) -> Option<f64> {
        let inflation = self.inflation.as_ref()?.inflation;
        (inflation.remaining(time) > 0.0).then_some(inflation.seconds)
    }

    /// Largest motion within a step of what moves by prescription.
    pub(crate) fn resolution(&self) -> MotionResolution {
        self.resolution
    }

    /// Whether a step between two times on the clock of motions, in s, resolves the motions of all
    /// bodies.
    pub(crate) fn bodies_are_resolved(&self, times: [f64; 2]) -> bool {
        let places = self.start.as_chunks::<3>().0;
        let bodies = self.moving.iter().filter(|moving| !moving.is_floor);
        bodies.into_iter().all(|MovingSurface { vertices, motion, .. }| {
            motion.is_resolved(times, &places[vertices.clone()], self.resolution)
        })
    }

    /// Time from which bodies have their size, in s; infinite as long as surfaces keep less than
    /// their distances.
    pub(crate) fn full_size_time(&self) -> f64 {
        if self.contact.growth_fraction() < 1.0 {
            return f64::INFINITY;
        }
        self.inflation.as_ref().map_or(0.0, |inflating| inflating.inflation.seconds)
    }

    /// Whether the distances should have grown long before a time, in s, and have not.
    pub(crate) fn growth_is_stuck(&self, time: f64) -> bool {
        let late = |growth: DistanceGrowth| time >= self.growth_start + PATIENCE * growth.seconds;
        self.contact.growth_fraction() < 1.0 && self.growth.is_some_and(late)
    }

    /// Places sewn cloth and bodies anew at a time, in s, where they intersect nowhere. Distances shrink to
    /// what there is, and grow again.
    ///
    /// # Errors
    /// Positions that are not finite, or another number of coordinates of bodies.
    pub(crate) fn place(&mut self, time: f64, placed: &PlacedSurfaces<'_>) -> Result<(), Error> {
        self.contact.close_seams();
        self.contact.place_bodies(placed.bodies)?;
        self.contact.shrink_to_separation(placed.positions)?;
        if self.contact.growth_fraction() < 1.0 {
            let seconds = self.growth.map_or(placed.growth_seconds, |growth| growth.seconds);
            self.growth = Some(DistanceGrowth { seconds });
            self.growth_start = time;
            self.start_growth_fraction = self.contact.growth_fraction();
        }
        Ok(())
    }

    /// Returns the growth of distances, to be restored.
    pub(crate) fn saved_growth(&self) -> Option<SavedGrowth> {
        let fraction = self.start_growth_fraction;
        self.growth.map(|DistanceGrowth { seconds }| SavedGrowth {
            seconds,
            start: self.growth_start,
            fraction,
        })
    }

    /// Restores the growth of distances.
    pub(crate) fn restore_growth(&mut self, saved: Option<SavedGrowth>) {
        let Some(SavedGrowth { seconds, start, fraction }) = saved else { return };
        self.growth = Some(DistanceGrowth { seconds });
        (self.growth_start, self.start_growth_fraction) = (start, fraction);
    }

    /// Opens a step and returns the energy of contact at its start if that is asked for.
    pub(crate) fn begin(&mut self, step: &ContactStep<'_>) -> Option<ContactEnergy> {
        if let Some(gaps) = step.seam_gaps {
            self.contact.set_seam_gaps(gaps);
        }
        #[cfg(test)]
        if self.omitted.open_seams {
            self.contact.close_seams();
        }
        if let Some(growth) = self.growth {
            let more = (1.0 - self.start_growth_fraction) * step.dt / growth.seconds;
            self.contact.grow_distances(step.positions, more);
        }
        let Self { start, inflation, ends, .. } = self;
        let start =
            inflation.as_mut().map_or(&start[..], |own| own.positions_at(step.end_time, start));
        ends.copy_from_slice(start);
        for MovingSurface { vertices, motion, .. } in &self.moving {
            let own = 3 * vertices.start..3 * vertices.end;
            motion.write_positions(step.motion_end, &start[own.clone()], &mut ends[own]);
        }
        self.contact.begin(step.positions, ends);
        step.with_energy.then(|| ContactEnergy {
            contact: self.contact.potential(step.positions),
            friction: 0.0,
            body_work: self.contact.growth_work(),
        })
    }

    /// Limits a step to a fraction that keeps all surfaces apart.
    pub(crate) fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep {
        #[cfg(test)]
        if self.omitted.step_filter {
            return AllowedStep::Whole;
        }
        let TrialStep { start, displacements, obstacle_time, mut obstacle_advance } = step;
        let whole = self.contact.limit_step(SurfaceStep {
            start,
            displacements,
            held: &self.held,
            obstacle_time,
            obstacle_advance: &mut obstacle_advance,
        });
        match whole {
            true => AllowedStep::Whole,
            false => AllowedStep::Shortened { obstacle_advance },
        }
    }

    /// Work of the bodies over their whole motion in the step with their forces at some positions
    /// and at the present obstacle time, in J.
    pub(crate) fn body_work(&mut self, positions: &[f64]) -> f64 {
        #[cfg(test)]
        if self.omitted.body_work {
            return 0.0;
        }
        self.contact.body_work(positions)
    }

    /// Whether no surface intersects another at some positions.
    pub(crate) fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        #[cfg(test)]
        if self.omitted.intersection_test {
            return true;
        }
        match self.contact.intersections(positions) {
            Ok(found) => {
                self.intersections_found += found.len();
                found.is_empty()
            }
            Err(_) => false,
        }
    }

    /// Exempt intersections at some positions, in m.
    pub(crate) fn exempt(&self, positions: &[f64]) -> SeamIntersections {
        // Positions that are not finite have no intersections; the test of the step reports them.
        self.contact.seam_intersections(positions).unwrap_or_default()
    }

    /// Description of the place where surfaces are closest to their minimum separation, with the
    /// positions of the particles, in m.
    pub(crate) fn describe_closest(&self, positions: &[f64]) -> Option<String> {
        let PairDistance { pair, distance } = self.contact.closest_pair()?;
        let of = |vertex: u32| &self.names[self.contact.surface().group(vertex) as usize];
        let [one, other] = [pair.vertices[0], pair.vertices[3]].map(of);
        let first = 3 * pair.vertices.into_iter().min()? as usize;
        let [x, y, z] = positions.get(first..first + 3)?.try_into().ok()?;
        Some(format!(
            "surfaces are nearest to what they keep between \"{one}\" and \"{other}\" near ({x:.4}, {y:.4}, {z:.4}) m, \
             {:.4} of {:.4} mm",
            1e3 * distance,
            1e3 * pair.min_separation
        ))
    }
}

impl Inflating {
    /// Positions of the bodies' vertices at a time, in s, from where they belong, without the
    /// motion of their bodies.
    fn positions_at<'a>(&'a mut self, time: f64, full: &'a [f64]) -> &'a [f64] {
        let remaining = self.inflation.remaining(time);
        if !(remaining > 0.0) {
            return full;
        }
        for ((position, full), inward) in self.positions.iter_mut().zip(full).zip(&self.inward) {
            *position = full + remaining * inward;
        }
        &self.positions
    }
}
