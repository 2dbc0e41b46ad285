use std::borrow::Cow;
use std::ops::Range;

use drape_collide::{Error, Shape, SurfaceContact, SurfaceStep};
use drape_implicit::{StepLimit, TrialStep};
use drape_scene::{Course, Growth, Inflation, Scene, StartSurfaces};

/// Part of the distance that surfaces keep by which a body's vertex may stray from its straight way within a step; what
/// turns more is given more steps.
const BOW: f64 = 0.05;

/// How much longer than it should the growth of what surfaces keep may take before the run fails.
const PATIENCE: f64 = 2.0;

/// The surfaces of panels and bodies, which never pass through each other.
#[derive(Debug)]
pub struct Surfaces {
    pub(crate) contact: SurfaceContact,
    /// Names of the panels and, behind them, of the bodies: of the groups of the surface.
    pub(crate) names: Vec<String>,
    /// Where the bodies' vertices belong at the start of the simulation, in m.
    start: Vec<f64>,
    /// How bodies grow, and how far inside of there each vertex then starts, in m.
    inflation: Option<(Inflation, Vec<f64>)>,
    /// How the distances that are kept grow.
    growth: Option<Growth>,
    /// Part of them that is kept at the start.
    pub(crate) grown_from: f64,
    moving: Vec<Mover>,
    /// How far a vertex of a body may stray from a straight way within a step, in m.
    bow: f64,
    /// Crossings that were found, whose steps were taken back.
    pub(crate) crossings: usize,
    held: Vec<usize>,
}

/// A body that moves.
#[derive(Debug)]
struct Mover {
    /// Its vertices among those of all bodies.
    own: Range<usize>,
    course: Course,
    /// Whether it is a floor, whose corners are too far out for their ways to matter.
    endless: bool,
}

impl Surfaces {
    /// The surfaces of a scene that has been checked, at its start.
    pub(crate) fn new(scene: &Scene) -> Result<Self, Error> {
        let StartSurfaces { mut contact, names, vertices, bodies, inward, separation } =
            StartSurfaces::new(scene)?;
        contact.summary_at(&scene.positions)?;
        let growth = scene.contact.growth;
        if growth.is_some() {
            contact.shrink_distances(&scene.positions)?;
        }
        let moves = scene.bodies.iter().zip(vertices).filter_map(|(moving, own)| {
            let course = moving.course.clone()?;
            Some(Mover { own, course, endless: matches!(moving.body.shape, Shape::Plane) })
        });
        let held = (0..scene.held.len()).filter(|&particle| scene.held[particle]).collect();
        Ok(Self {
            grown_from: contact.growth_fraction(),
            contact,
            names,
            start: bodies,
            inflation: scene.contact.inflation.map(|inflation| (inflation, inward)),
            growth,
            moving: moves.collect(),
            bow: 2.0 * BOW * separation,
            crossings: 0,
            held,
        })
    }

    /// Whether all bodies go nearly straight between two times, in s, as they do within a step.
    pub(crate) fn go_straight(&self, times: [f64; 2]) -> bool {
        let places = self.start.as_chunks::<3>().0;
        self.moving
            .iter()
            .filter(|mover| !mover.endless)
            .all(|Mover { own, course, .. }| course.bow(times, &places[own.clone()]) <= self.bow)
    }

    /// When all bodies have their size, in s; never as long as surfaces keep less than they should.
    pub(crate) fn grown_at(&self) -> f64 {
        if self.contact.growth_fraction() < 1.0 {
            return f64::INFINITY;
        }
        self.inflation.as_ref().map_or(0.0, |(inflation, _)| inflation.seconds)
    }

    /// Whether what surfaces keep has had time enough to grow at a time since the start, in s, and did not.
    pub(crate) fn is_stuck(&self, since: f64) -> bool {
        let late = |growth: Growth| since >= PATIENCE * growth.seconds;
        self.contact.growth_fraction() < 1.0 && self.growth.is_some_and(late)
    }

    /// Opens a step that ends at a time since the start, and at one on the clock of what moves, and its length, in s.
    pub(crate) fn begin(&mut self, ([since, end_time], dt): ([f64; 2], f64), positions: &[f64]) {
        if let Some(growth) = self.growth {
            self.contact.grow_distances(positions, (1.0 - self.grown_from) * dt / growth.seconds);
        }
        let start = shrunk(&self.start, &self.inflation, since);
        let mut ends = start.to_vec();
        for Mover { own, course, .. } in &self.moving {
            let own = 3 * own.start..3 * own.end;
            course.place(end_time, &start[own.clone()], &mut ends[own]);
        }
        self.contact.begin(positions, &ends);
    }

    /// Limits a step to a part that keeps all surfaces apart.
    pub(crate) fn limit_step(&mut self, step: TrialStep<'_>) -> StepLimit {
        let TrialStep { start, displacements, obstacle_time, mut obstacle_advance } = step;
        let whole = self.contact.limit_step(SurfaceStep {
            from: start,
            displacements,
            held: &self.held,
            progress: obstacle_time,
            advance: &mut obstacle_advance,
        });
        match whole {
            true => StepLimit::Whole,
            false => StepLimit::Shortened { obstacle_advance },
        }
    }

    /// Whether no surface intersects another at these positions.
    pub(crate) fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        match self.contact.intersections(positions) {
            Ok(crossings) => {
                self.crossings += crossings.len();
                crossings.is_empty()
            }
            Err(_) => false,
        }
    }
}

/// Where the vertices of bodies that have not moved are at a time since the start, in s.
fn shrunk<'a>(
    start: &'a [f64],
    inflation: &Option<(Inflation, Vec<f64>)>,
    time: f64,
) -> Cow<'a, [f64]> {
    match inflation {
        Some((inflation, inward)) if inflation.left(time) > 0.0 => {
            let left = inflation.left(time);
            start.iter().zip(inward).map(|(place, way)| place + left * way).collect()
        }
        _ => Cow::Borrowed(start),
    }
}
