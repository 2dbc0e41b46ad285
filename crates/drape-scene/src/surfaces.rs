use std::borrow::Cow;
use std::ops::Range;

use drape_cloth::Cloth;
use drape_collide::{
    Body, ContactDistances, Error, PinchPolicy, Shape, Surface, SurfaceContact, SurfaceParts,
    SurfaceSettings, SurfaceStep,
};
use drape_fabric::Fabric;
use drape_implicit::{StepLimit, TrialStep};

use crate::course::Course;
use crate::growth::Growth;
use crate::inflation::Inflation;
use crate::material::Material;
use crate::panel::Panel;
use crate::stitching::Stitching;

/// Part of a fabric's thickness under pressure that its surfaces keep between them under any load.
const CRUSHED: f64 = 0.5;

/// Part of the distance that surfaces keep by which a body's vertex may stray from its straight way within a step; what
/// turns more is given more steps.
const BOW: f64 = 0.05;

/// Largest part of its thickness that a fabric has under pressure, for its contact: one that is not compressed at all
/// would have contact without end.
const PRESSED: f64 = 0.95;

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

/// What the surfaces of a scene are made of.
pub(crate) struct Parts<'a> {
    pub(crate) panels: &'a [Panel],
    pub(crate) materials: &'a [Material],
    pub(crate) cloth: &'a Cloth,
    pub(crate) bodies: &'a [Body],
    pub(crate) courses: &'a [Option<Course>],
    pub(crate) held: &'a [bool],
    /// The particles of the seams.
    pub(crate) sewn: Option<&'a Stitching>,
    /// Distance of the middle of the cloth from a body at which contact begins, in m.
    pub(crate) offset: f64,
    /// In N/m³; what the fabrics' thickness under pressure asks for if there is none.
    pub(crate) stiffness: Option<f64>,
    /// In m.
    pub(crate) stick: f64,
    /// What becomes of cloth that bodies close on.
    pub(crate) pinch: PinchPolicy,
    /// How bodies grow at the start.
    pub(crate) inflation: Option<Inflation>,
    /// How the distances that are kept grow.
    pub(crate) growth: Option<Growth>,
}

impl Surfaces {
    pub(crate) fn new(parts: &Parts<'_>) -> Result<Self, Error> {
        let Parts { panels, materials, cloth, bodies, courses, .. } = parts;
        let fabric = |panel: &Panel| &materials[panel.material].fabric;
        let skin = |fabric: &Fabric| ContactDistances {
            activation_distance: 0.5 * fabric.thickness,
            min_separation: 0.5 * CRUSHED * fabric.thickness_under_pressure(),
        };
        let skins = panels.iter().map(|panel| skin(fabric(panel)));
        let thinnest = skins.min_by(|a, b| a.activation_distance.total_cmp(&b.activation_distance));
        let thinnest =
            thinnest.unwrap_or(ContactDistances { activation_distance: 0.0, min_separation: 0.0 });
        let mut surface = SurfaceParts {
            rest_positions: cloth.coordinates().iter().flat_map(|[u, v]| [*u, *v, 0.0]).collect(),
            triangles: cloth.triangles().to_vec(),
            areas: cloth.areas().to_vec(),
            groups: Vec::new(),
            distances: Vec::new(),
            free_vertices: cloth.particles(),
            seam_pairs: parts.sewn.map_or_else(Vec::new, |sewn| sewn.pairs.clone()),
            ties: parts.sewn.map_or_else(Vec::new, Stitching::triples),
        };
        let mut frictions = Vec::new();
        for (index, panel) in panels.iter().enumerate() {
            surface
                .groups
                .extend(std::iter::repeat_n(index as u32, panel.lattice.coordinates.len()));
            surface.distances.push(skin(fabric(panel)));
            frictions.push(Err(materials[panel.material].fabric.surface_friction));
        }
        let (mut start, mut inward) = (Vec::new(), Vec::new());
        let mut moving = Vec::new();
        for (body, course) in bodies.iter().zip(*courses) {
            let outline = body.triangulate()?;
            let first = surface.groups.len();
            let count = outline.vertices.len();
            let own = start.len() / 3..start.len() / 3 + count;
            start.extend(outline.vertices.iter().flatten());
            // What goes from frame to frame has its size from there.
            let grows = !matches!(course, Some(Course::Shapes(_)));
            let depth =
                parts.inflation.map_or(0.0, |inflation| if grows { inflation.depth } else { 0.0 });
            inward.extend(outline.normals().iter().flatten().map(|n| -depth * n));
            let corners = |t: &[u32; 3]| t.map(|corner| corner + first as u32);
            surface.triangles.extend(outline.triangles.iter().map(corners));
            surface.areas.extend(std::iter::repeat_n(0.0, count));
            surface.groups.extend(std::iter::repeat_n(surface.distances.len() as u32, count));
            // Half of the cloth's thickness is its own.
            let half = thinnest.activation_distance;
            let activation_distance = (parts.offset - half).max(half);
            surface.distances.push(ContactDistances { activation_distance, ..thinnest });
            frictions.push(Ok(body.friction));
            if let Some(course) = course {
                let endless = matches!(body.shape, Shape::Plane);
                moving.push(Mover { own, course: course.clone(), endless });
            }
        }
        surface.rest_positions.extend(&start);
        let pair = |a: &Result<f64, f64>, b: &Result<f64, f64>| match (a, b) {
            // Of two fabrics the geometric mean; a body's coefficient is that with cloth.
            (Err(a), Err(b)) => (a * b).sqrt(),
            (Ok(body), _) | (_, Ok(body)) => *body,
        };
        let friction = frictions.iter().flat_map(|a| frictions.iter().map(move |b| pair(a, b)));
        let settings = SurfaceSettings {
            stiffness: parts.stiffness.unwrap_or_else(|| {
                panels.iter().map(|panel| stiffness(fabric(panel))).fold(0.0, f64::max)
            }),
            sticking_displacement: parts.stick,
            friction_coefficients: friction.collect(),
            pinch: parts.pinch,
        };
        let inflation = parts.inflation.map(|inflation| (inflation, inward));
        let bodies_at_start = shrunk(&start, &inflation, 0.0);
        let contact =
            SurfaceContact::new(Surface::new(surface)?, settings, bodies_at_start.into_owned())?;
        let held = (0..parts.held.len()).filter(|&particle| parts.held[particle]).collect();
        let names = panels.iter().map(|panel| &panel.name);
        let names = names.chain(bodies.iter().map(|body| &body.name)).cloned().collect();
        let bow = 2.0 * BOW * thinnest.min_separation;
        Ok(Self {
            contact,
            names,
            start,
            inflation,
            growth: parts.growth,
            grown_from: 1.0,
            moving,
            bow,
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

    /// Whether surfaces may start nearer than they keep.
    pub(crate) fn may_grow(&self) -> bool {
        self.growth.is_some()
    }

    /// Lets surfaces that do not cross keep less at the start.
    pub(crate) fn shrink(&mut self, positions: &[f64]) -> Result<(), Error> {
        self.contact.shrink_distances(positions)?;
        self.grown_from = self.contact.growth_fraction();
        Ok(())
    }

    /// Whether what surfaces keep has had time enough to grow at a time since the start, in s, and did not.
    pub(crate) fn is_stuck(&self, since: f64) -> bool {
        let late = |growth: Growth| since >= Growth::PATIENCE * growth.seconds;
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

/// Stiffness of contact that presses two layers of a fabric as its compression test does, in N/m³.
fn stiffness(fabric: &Fabric) -> f64 {
    let pressed = fabric.thickness_under_pressure();
    let distance = pressed.min(PRESSED * fabric.thickness);
    let of_pair = ContactDistances {
        activation_distance: fabric.thickness,
        min_separation: CRUSHED * pressed,
    };
    SurfaceSettings::stiffness_for_pressure(Fabric::PRESSURE, distance, of_pair)
}
