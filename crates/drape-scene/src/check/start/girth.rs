//! Girths of garments against the body that they go round.
//!
//! A ring of cloth of girth `$G$`, of `$n$` particles, lies at a distance `$d$` round a section
//! whose convex hull has the perimeter `$H$` only if it is as long as the polygon round it:
//!
//! ```math
//! G \ge (H + 2\pi d)\,\frac{n}{\pi}\tan\frac{\pi}{n}
//! ```
//!
//! What is missing it has to stretch. A garment that would pull harder than the tensile test of a
//! fabric does is refused; one that stretches less is told.

use std::f64::consts::{PI, TAU};

use drape_collide::{Shape, Triangulation};

use crate::check::checker::Checker;
use crate::scene::Scene;
use drape_collide::section::{SectionPlane, convex_hull, encloses, perimeter};

use super::rings::{Ring, RingFinder, openings};

/// Load of the tensile test, 500 gf/cm, in N/m: no garment is worn so tight, and seams that are to
/// close against it do not.
const PULL_MAX: f64 = 490.3325;

/// Stretch from which on it is told.
const STRETCH_MIN: f64 = 0.01;

/// Distance by which a ring may lie away from where it starts, in m: an opening that is too narrow
/// there goes to where its body is narrower.
const SLACK: f64 = 0.05;

/// Distance of the heights at which garments are measured, in m, at least.
const STEP_MIN: f64 = 0.01;

/// Girth of a ring that is too short for its body.
struct TightRing<'a> {
    ring: &'a Ring,
    /// Perimeter of the hull of the body, in m.
    hull: f64,
    /// Perimeter at the contact offset, in m.
    with_offset: f64,
    /// Length of the ring that would lie there, in m.
    needed: f64,
}

impl TightRing<'_> {
    fn stretch(&self) -> f64 {
        self.needed / self.ring.girth - 1.0
    }
}

/// Checks the girths of the garments of a scene; returns notes on those that stretch.
pub(crate) fn check_girths(checker: &mut Checker<'_>, scene: &Scene) -> Vec<String> {
    let solid = scene.bodies.iter().map(|moving| &moving.body);
    let solid = solid.filter(|body| !matches!(body.shape, Shape::Plane));
    let bodies: Vec<Triangulation> = solid.filter_map(|body| body.triangulate().ok()).collect();
    let mut notes = Vec::new();
    if bodies.is_empty() || scene.sewing.is_none() {
        return notes;
    }
    let finder = RingFinder::new(scene);
    let openings = openings(scene);
    for (number, garment) in scene.garments.iter().enumerate() {
        let own = |panel: usize| garment.particles.contains(&scene.panels[panel].first);
        let panels: Vec<usize> = (0..scene.panels.len()).filter(|&panel| own(panel)).collect();
        let cuts = heights(scene, &panels).flat_map(|height| finder.at_height(&panels, height));
        let cuts: Vec<Ring> = cuts.collect();
        let rings = openings.iter().filter(|ring| own(ring.panel)).chain(&cuts);
        let tight = rings.filter_map(|ring| tight(scene, &bodies, ring));
        let Some(worst) = tight.max_by(|a, b| a.stretch().total_cmp(&b.stretch())) else {
            continue;
        };
        let pull = pull(scene, &worst);
        let fault = describe(&garment.name, &worst, pull);
        let help = remedy(&worst);
        if pull > PULL_MAX {
            checker.fail(&format!("garment[{number}].pattern"), fault, &help);
        } else {
            notes.push(format!("{fault}; {help}"));
        }
    }
    notes
}

/// Returns the heights at which panels are cut, in m.
fn heights(scene: &Scene, panels: &[usize]) -> impl Iterator<Item = f64> {
    let particles = panels.iter().flat_map(|&panel| scene.panels[panel].particles());
    let heights = particles.map(|particle| scene.start.positions[3 * particle + 1]);
    let [low, high] =
        heights.fold([f64::MAX, f64::MIN], |[low, high], y| [low.min(y), high.max(y)]);
    let spacing = panels.iter().flat_map(|&panel| scene.panels[panel].lattice.spacing);
    let step = spacing.fold(STEP_MIN, f64::max);
    let count = ((high - low) / step).max(0.0) as usize;
    (0..count).map(move |k| low + (k as f64 + 0.5) * step)
}

/// Returns the girths of a ring that is shorter than what it goes round, wherever near its place it
/// lies.
fn tight<'a>(scene: &Scene, bodies: &[Triangulation], ring: &'a Ring) -> Option<TightRing<'a>> {
    let outline = convex_hull(ring.points.iter().map(|&point| ring.plane.flat(point)).collect());
    let mut hull = f64::INFINITY;
    for part in [0.0, -1.0, -0.5, 0.5, 1.0] {
        let own = hull_inside(bodies, &outline, &ring.plane.moved(part * SLACK))?;
        hull = hull.min(own);
    }
    let with_offset = hull + TAU * scene.contact.particles.activation_distance;
    let [across, along] = scene.panels[ring.panel].lattice.spacing;
    let arcs = (ring.girth / across.max(along)).round().max(3.0);
    let needed = with_offset * arcs / PI * (PI / arcs).tan();
    (needed > (1.0 + STRETCH_MIN) * ring.girth).then_some(TightRing {
        ring,
        hull,
        with_offset,
        needed,
    })
}

/// Returns the perimeter of the hull of what a plane cuts of bodies inside an outline, in m.
fn hull_inside(
    bodies: &[Triangulation],
    outline: &[[f64; 2]],
    plane: &SectionPlane,
) -> Option<f64> {
    let cuts = bodies.iter().flat_map(|body| {
        let corners = |t: &[u32; 3]| t.map(|corner| body.vertices[corner as usize]);
        body.triangles.iter().flat_map(move |triangle| plane.cuts(corners(triangle)))
    });
    let inside: Vec<[f64; 2]> = cuts.filter(|&point| encloses(outline, point)).collect();
    (inside.len() > 2).then(|| perimeter(&convex_hull(inside)))
}

/// Returns the pull of the fabric of a ring that is stretched to what it needs, in N/m: along the
/// softer of its yarns.
fn pull(scene: &Scene, tight: &TightRing<'_>) -> f64 {
    let fabric = &scene.materials[scene.panels[tight.ring.panel].material].fabric;
    let stretch = tight.stretch();
    let laws = [&fabric.warp.traction, &fabric.weft.traction];
    laws.map(|law| law.elastic(stretch, stretch).load).into_iter().fold(f64::INFINITY, f64::min)
}

/// Describes a garment that is too narrow.
fn describe(garment: &str, tight: &TightRing<'_>, pull: f64) -> String {
    let TightRing { ring, hull, with_offset, needed } = tight;
    format!(
        "\"{garment}\" is too narrow at a height of {:.2} m: {} measure {:.0} mm round, and the body's hull {:.0} mm there, \
         {:.0} mm with contact.offset, {:.0} mm for its particles at this spacing; it would stretch by {:.1} % and pull \
         with {pull:.0} N/m",
        ring.plane.height(),
        ring.parts.join(" + "),
        1e3 * ring.girth,
        1e3 * hull,
        1e3 * with_offset,
        1e3 * needed,
        100.0 * tight.stretch()
    )
}

/// Returns the remedy for a garment that is too narrow.
fn remedy(tight: &TightRing<'_>) -> String {
    let TightRing { ring, with_offset, needed, .. } = tight;
    let wider = (1e3 * (needed - ring.girth)).ceil();
    let coarse = match ring.girth > *with_offset {
        true => ", choose a smaller spacing",
        false => "",
    };
    format!(
        "widen it there by {wider:.0} mm in all{coarse}, or start it where the body is narrower (center)"
    )
}
