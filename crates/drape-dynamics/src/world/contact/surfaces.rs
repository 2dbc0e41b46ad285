//! Surfaces of panels and bodies, kept apart by a barrier and a step filter.
//!
//! Bodies move vertex by vertex. The motion of a body applies to its full-size positions at the
//! start of the simulation, minus the remaining part of its inflation. The solver's step filter
//! asks here how far a trial step may go, and whether an accepted one is free of intersections.

use std::ops::Range;

use drape_collide::{
    Body, Error, OpenStep, SeamIntersections, Shape, SurfaceContact, SurfaceStart, SurfaceTrial,
    Triangulation,
};
use drape_frames::CLOSED_GAP;
use drape_implicit::{AllowedStep, TrialStep};
use drape_scene::{BodyMotion, DistanceGrowth, Inflation, MotionResolution, Scene, StartSurfaces};
use serde::{Deserialize, Serialize};

use super::closest_place::ClosestPlace;
use super::step::{ALL_PARTICLES, ContactEnergy, ContactStep};
use super::stopped_speeds::StoppedSpeeds;

/// Largest deviation from a straight path of a prescribed motion within a step, as a fraction of
/// the minimum separation. Faster rotations are divided into more steps.
const DEVIATION: f64 = 0.05;

/// Multiple of its prescribed duration that the growth of distances may take before the run fails.
const PATIENCE: f64 = 2.0;

/// Surfaces of a world.
#[derive(Debug)]
pub(crate) struct Surfaces {
    pub(crate) contact: SurfaceContact,
    bodies: Vec<Body>,
    /// Names of the panels and then of the bodies: one for each group of the surface.
    names: Vec<String>,
    /// Full-size positions of the bodies' vertices at the start of the simulation, in m.
    start: Vec<f64>,
    inflation: Option<Inflating>,
    growth: Option<DistanceGrowth>,
    /// Time at which the growth of distances begins, in s.
    growth_start: f64,
    /// Fraction of the distances that surfaces keep at the start, 0 to 1.
    pub(crate) start_growth_fraction: f64,
    /// Bodies that the scene moves.
    moving: Vec<MovingSurface>,
    /// Bodies that a program leads, with motions that replace the motions of the scene.
    led: Vec<LedSurface>,
    /// Range of the vertices of each body among the vertices of all bodies.
    vertices: Vec<Range<usize>>,
    /// Speeds of bodies and pins that contact can stop.
    pub(crate) speeds: StoppedSpeeds,
    /// Largest motion within a step of a body's vertex or a held particle.
    resolution: MotionResolution,
    /// Number of intersections found after steps that were then rejected.
    pub(crate) intersections_found: usize,
    held: Vec<usize>,
    /// Positions of the bodies' vertices at the end of the step, in m.
    ends: Vec<f64>,
    #[cfg(test)]
    pub(crate) omitted: Omitted,
}

/// Safeguards that a test can switch off, to show that each is needed.
#[cfg(test)]
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Omitted {
    /// Whether steps are not limited.
    pub(crate) step_filter: bool,
    /// Whether steps are accepted without a test for intersections.
    pub(crate) intersection_test: bool,
    /// Whether the sides of a seam are exempt from contact before they meet.
    pub(crate) open_seams: bool,
    /// Whether the work of moving bodies is missing from the energy balance.
    pub(crate) body_work: bool,
}

/// Bodies that start smaller than their full size.
#[derive(Debug)]
struct Inflating {
    inflation: Inflation,
    /// Displacements of the bodies' vertices from full size to their start, in m.
    inward: Vec<f64>,
    /// Positions of the vertices before the motion of their bodies, in m.
    positions: Vec<f64>,
}

/// Surface of a moving body.
#[derive(Debug)]
struct MovingSurface {
    /// Range of the body's vertices among the vertices of all bodies.
    vertices: Range<usize>,
    motion: BodyMotion,
    /// Whether the body is a floor. The corners of a floor are too far away for their paths to
    /// matter.
    is_floor: bool,
}

/// Surface of a body that a program leads.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct LedSurface {
    body: usize,
    /// Positions of the body's vertices at the start of the motion, in m.
    start: Vec<f64>,
    motion: BodyMotion,
}

/// Growth of distances that began during the run.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct SavedGrowth {
    /// Duration until surfaces keep their full distances, in s.
    pub(crate) seconds: f64,
    /// Time at which the growth began, in s.
    pub(crate) start: f64,
    /// Fraction of the distances at the beginning of the growth.
    pub(crate) fraction: f64,
}

/// New positions of cloth and bodies.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlacedSurfaces<'a> {
    /// Positions of the particles, in m.
    pub(crate) positions: &'a [f64],
    /// Positions of the bodies' vertices, in m.
    pub(crate) bodies: &'a [f64],
    /// Duration in which shortened distances grow again, in s.
    pub(crate) growth_seconds: f64,
}

impl Surfaces {
    /// Returns the surfaces of the checked `scene`, at its start.
    ///
    /// # Errors
    ///
    /// Returns an error if the surfaces of `scene` are invalid or intersect.
    pub(crate) fn new(scene: &Scene) -> Result<Self, Error> {
        let StartSurfaces { mut contact, names, vertices, bodies, inward, min_separation } =
            StartSurfaces::new(scene)?;
        let positions = &scene.start.positions;
        contact.detect(positions)?;
        let growth = scene.contact.growth;
        if growth.is_some() {
            contact.setup()?.shrink_distances(positions)?;
        }

        let moving = scene.bodies.iter().zip(&vertices).filter_map(|(moving, vertices)| {
            let motion = moving.motion.clone()?;
            let is_floor = matches!(moving.body.shape, Shape::Plane);
            Some(MovingSurface { vertices: vertices.clone(), motion, is_floor })
        });

        let held = scene.held_particles();
        Ok(Self {
            start_growth_fraction: contact.state().growth_fraction(),
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
            led: Vec::new(),
            vertices,
            speeds: StoppedSpeeds::new(scene),
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

    /// Returns the bodies at the start of the simulation.
    pub(crate) fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Returns the triangles of `body` at `time` on the motion clock, in s, in its full size.
    pub(crate) fn outline(&self, body: usize, time: f64) -> Triangulation {
        let mut outline = self.bodies[body].triangulate().expect("contact has checked it");
        let vertices = &self.vertices[body];
        let start = &self.start[3 * vertices.start..3 * vertices.end];
        let mut positions = start.to_vec();
        let moving = self.moving.iter().find(|moving| moving.vertices == *vertices);
        if let Some(led) = self.led.iter().find(|led| led.body == body) {
            led.motion.write_positions(time, &led.start, &mut positions);
        } else if let Some(moving) = moving {
            moving.motion.write_positions(time, start, &mut positions);
        }
        outline.vertices = positions.as_chunks::<3>().0.to_vec();
        outline
    }

    /// Replaces the motion of `body` by `motion`, which begins at the vertices `from`.
    pub(crate) fn lead(&mut self, body: usize, from: &Triangulation, motion: BodyMotion) {
        let start = from.vertices.as_flattened().to_vec();
        self.led.retain(|led| led.body != body);
        self.led.push(LedSurface { body, start, motion });
    }

    /// Returns the bodies that a program leads.
    pub(crate) fn led(&self) -> &[LedSurface] {
        &self.led
    }

    /// Restores the bodies `led` that a program leads. Returns `false` if they do not fit.
    pub(crate) fn restore_led(&mut self, led: Vec<LedSurface>) -> bool {
        let is_sound = |LedSurface { body, start, motion }: &LedSurface| {
            self.vertices.get(*body).is_some_and(|vertices| {
                start.len() == 3 * vertices.len()
                    && start.iter().all(|x| x.is_finite())
                    && motion.is_sound(vertices.len())
            })
        };
        let is_sound = led.iter().all(is_sound);
        if is_sound {
            self.led = led;
        }
        is_sound
    }

    /// Sets the particles that are held in all directions in this step.
    pub(crate) fn set_held(&mut self, held: &[bool]) {
        self.held.clear();
        self.held.extend((0..held.len()).filter(|&particle| held[particle]));
    }

    /// Returns the time at which the bodies reach their full size, in s, or `None` if they have it
    /// at `time`.
    pub(crate) fn end_of_inflation(&self, time: f64) -> Option<f64> {
        let inflation = self.inflation.as_ref()?.inflation;
        (inflation.remaining(time) > 0.0).then_some(inflation.seconds)
    }

    /// Returns the largest prescribed motion within a step.
    pub(crate) fn resolution(&self) -> MotionResolution {
        self.resolution
    }

    /// Returns whether a step between the two `times` on the motion clock, in s, resolves the
    /// motions of all bodies.
    pub(crate) fn bodies_are_resolved(&self, times: [f64; 2]) -> bool {
        let positions = self.start.as_chunks::<3>().0;
        let moving = self.moving.iter().filter(|moving| !moving.is_floor && !self.is_led(moving));
        let led = self.led.iter().filter(|led| !self.is_floor(led.body));
        moving.into_iter().all(|MovingSurface { vertices, motion, .. }| {
            motion.is_resolved(times, &positions[vertices.clone()], self.resolution)
        }) && led.into_iter().all(|LedSurface { start, motion, .. }| {
            motion.is_resolved(times, start.as_chunks::<3>().0, self.resolution)
        })
    }

    /// Returns whether `body` is a floor.
    fn is_floor(&self, body: usize) -> bool {
        matches!(self.bodies[body].shape, Shape::Plane)
    }

    /// Returns whether a program leads the body that the scene moves as `moving`.
    fn is_led(&self, moving: &MovingSurface) -> bool {
        self.led.iter().any(|led| self.vertices[led.body] == moving.vertices)
    }

    /// Returns the fraction of their distances that surfaces keep now, 0 to 1.
    pub(crate) fn growth_fraction(&self) -> f64 {
        self.contact.state().growth_fraction()
    }

    /// Returns the time from which bodies have their full size, in s. The time is infinite while
    /// surfaces keep less than their full distances.
    pub(crate) fn full_size_time(&self) -> f64 {
        if self.growth_fraction() < 1.0 {
            return f64::INFINITY;
        }
        self.inflation.as_ref().map_or(0.0, |inflating| inflating.inflation.seconds)
    }

    /// Returns whether distances should have grown to their full values well before `time`, in s,
    /// but have not.
    pub(crate) fn growth_is_stuck(&self, time: f64) -> bool {
        self.growth_fraction() < 1.0
            && self
                .growth
                .is_some_and(|growth| time >= self.growth_start + PATIENCE * growth.seconds)
    }

    /// Moves sewn cloth and bodies to the positions `placed` at `time`, in s. Nothing may intersect
    /// there. Minimum separations are reduced to the distances there, and grow again.
    ///
    /// # Errors
    ///
    /// Returns an error if positions are not finite or the number of body coordinates is wrong, or
    /// if a step is open.
    pub(crate) fn place(&mut self, time: f64, placed: &PlacedSurfaces<'_>) -> Result<(), Error> {
        let mut setup = self.contact.setup()?;
        setup.close_seams();
        setup.place_bodies(placed.bodies)?;
        setup.shrink_to_separation(placed.positions)?;
        if self.growth_fraction() < 1.0 {
            let seconds = self.growth.map_or(placed.growth_seconds, |growth| growth.seconds);
            self.growth = Some(DistanceGrowth { seconds });
            self.growth_start = time;
            self.start_growth_fraction = self.growth_fraction();
        }
        Ok(())
    }

    /// Returns the growth of distances, for [`Self::restore_growth`].
    pub(crate) fn saved_growth(&self) -> Option<SavedGrowth> {
        let fraction = self.start_growth_fraction;
        self.growth.map(|DistanceGrowth { seconds }| SavedGrowth {
            seconds,
            start: self.growth_start,
            fraction,
        })
    }

    /// Restores the growth of distances to `saved`.
    pub(crate) fn restore_growth(&mut self, saved: Option<SavedGrowth>) {
        let Some(SavedGrowth { seconds, start, fraction }) = saved else { return };
        self.growth = Some(DistanceGrowth { seconds });
        (self.growth_start, self.start_growth_fraction) = (start, fraction);
    }

    /// Prepares contact for `step`. Returns the energy of contact at its start, if `step` asks for
    /// it.
    pub(crate) fn begin(&mut self, step: &ContactStep<'_>) -> Option<ContactEnergy> {
        #[cfg(test)]
        if self.omitted.open_seams {
            self.close_seams();
        }

        // Motions apply to the bodies at the size that they have at the end of the step.
        let Self { start, inflation, ends, vertices, .. } = self;
        let inflated = inflation
            .as_mut()
            .map_or(&start[..], |inflating| inflating.positions_at(step.end_time, start));
        ends.copy_from_slice(inflated);
        for MovingSurface { vertices, motion, .. } in &self.moving {
            let range = 3 * vertices.start..3 * vertices.end;
            motion.write_positions(step.motion_end, &inflated[range.clone()], &mut ends[range]);
        }
        // A body is led only after it has its full size.
        for LedSurface { body, start, motion } in &self.led {
            let range = 3 * vertices[*body].start..3 * vertices[*body].end;
            motion.write_positions(step.motion_end, start, &mut ends[range]);
        }

        let growth_increment = match self.growth {
            Some(growth) => (1.0 - self.start_growth_fraction) * step.dt / growth.seconds,
            None => 0.0,
        };
        let opened = self.contact.begin(SurfaceStart {
            positions: step.positions,
            bodies: ends,
            seam_gaps: step.seam_gaps,
            growth_increment,
        });
        let mut open_step = opened.expect(ALL_PARTICLES);
        step.with_energy.then(|| {
            let body_work = open_step.growth_work();
            let energy = open_step.energy(step.positions).expect(ALL_PARTICLES);
            ContactEnergy {
                contact: energy.potential(),
                without_friction: energy.without_friction(),
                friction: 0.0,
                body_work,
            }
        })
    }

    /// Returns the step that [`begin`](Self::begin) opened.
    pub(crate) fn open_step(&mut self) -> OpenStep<'_> {
        self.contact.step().expect("the solver begins a step before it asks about the step")
    }

    /// Closes the seams. A step that failed and is still open is rejected, so that a simulation can
    /// resume after it.
    pub(crate) fn close_seams(&mut self) {
        if let Ok(step) = self.contact.step() {
            step.reject();
        }
        self.contact.setup().expect("no step is open").close_seams();
    }

    /// Limits `step` to the fraction that keeps all surfaces apart.
    pub(crate) fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep {
        #[cfg(test)]
        if self.omitted.step_filter {
            return AllowedStep::Whole;
        }
        let TrialStep { start, displacements, obstacle_time, mut obstacle_advance } = step;
        let Self { contact, held, .. } = self;
        let mut open_step = contact.step().expect("the solver begins a step before it limits one");
        let limited = open_step.limit(SurfaceTrial {
            start,
            displacements,
            held,
            obstacle_time,
            obstacle_advance: &mut obstacle_advance,
        });
        let is_whole = limited.expect(ALL_PARTICLES);
        if is_whole { AllowedStep::Whole } else { AllowedStep::Shortened { obstacle_advance } }
    }

    /// Returns the work of the bodies over their whole motion in the step, in J, with their forces
    /// at `positions` and at the current obstacle time.
    pub(crate) fn body_work(&mut self, positions: &[f64]) -> f64 {
        #[cfg(test)]
        if self.omitted.body_work {
            return 0.0;
        }
        self.open_step().body_work(positions).expect(ALL_PARTICLES)
    }

    /// Returns whether no surface intersects another at `positions`.
    pub(crate) fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        #[cfg(test)]
        if self.omitted.intersection_test {
            return true;
        }
        match self.contact.intersections(positions) {
            Ok(intersections) => {
                self.intersections_found += intersections.len();
                intersections.is_empty()
            }
            Err(_) => false,
        }
    }

    /// Returns the intersections at seams that are being closed, at `positions`, in m.
    pub(crate) fn at_seams(&self, positions: &[f64]) -> SeamIntersections {
        // Positions that are not finite are reported by the intersection test of the step.
        let inspection = self.contact.inspect(positions);
        let at_seams = inspection.and_then(|inspection| inspection.seam_intersections(CLOSED_GAP));
        at_seams.unwrap_or_default()
    }

    /// Returns the number of intersections at `positions`, in m, that a step does not reject:
    /// of cloth that let a body through, and of `seams` that are not closed.
    pub(crate) fn intersection_count(&self, positions: &[f64], seams: &SeamIntersections) -> usize {
        let inspection = self.contact.inspect(positions);
        let others = inspection.and_then(|inspection| inspection.intersections_with_released());
        others.map_or(usize::MAX, |others| others.len() + seams.open)
    }

    /// Returns where surfaces are closest to their minimum separation, with the particles at
    /// `positions`, in m. Returns `None` if no surfaces are near each other.
    pub(crate) fn closest_place(&self, positions: &[f64]) -> Option<ClosestPlace> {
        ClosestPlace::find(&self.contact, &self.names, positions)
    }
}

impl Inflating {
    /// Returns the positions of the bodies' vertices at `time`, in s, without the motions of the
    /// bodies. The vertices are at `full` at full size.
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
