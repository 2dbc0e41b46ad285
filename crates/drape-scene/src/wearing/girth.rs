//! Girths of garments against the body that they go round.
//!
//! A ring of cloth of girth `$G$`, of `$n$` particles, lies at a distance `$d$` round a section
//! whose convex hull has the perimeter `$H$` only if it is as long as the polygon round it:
//!
//! ```math
//! G \ge (H + 2\pi d)\,\frac{n}{\pi}\tan\frac{\pi}{n}
//! ```
//!
//! The section has the limbs of the body of which the ring encloses at least half. A shorter ring
//! has to stretch, which a note says. The body at the start is not the body that the cloth lies on
//! when it is sewn, so only the sewing shows whether the seams close. A place at which the garment
//! would pull harder than the tensile test of a fabric does is not advised.

use std::f64::consts::{PI, TAU};

use drape_collide::Triangulation;
use drape_collide::section::{SectionPlane, convex_hull, encloses, perimeter};

use crate::scene::Scene;
use crate::scene::garment::Garment;

use super::rings::{Ring, RingFinder, openings};

/// Load of the tensile test, 500 gf/cm, in N/m: no garment is worn so tight, and seams that are to
/// close against it hardly do.
const PULL_MAX: f64 = 490.3325;

/// Smallest stretch that is reported.
const STRETCH_MIN: f64 = 0.01;

/// Largest distance of a ring from the place where it starts, in m. An opening that is too narrow
/// there slides to where the body is narrower.
const SLACK: f64 = 0.05;

/// Least distance between the heights at which a garment is measured, in m.
const STEP_MIN: f64 = 0.01;

/// Least fraction of a limb's section inside a ring that goes round the limb. Flat panels beside
/// the trunk enclose some of an arm at the start.
const LIMB_MIN: f64 = 0.5;

/// Number of the rings by which places are compared.
const RINGS: usize = 12;

/// Girth of a ring that is too short for its body.
pub(crate) struct TightRing {
    ring: Ring,
    /// Perimeter of the hull of the body, in m.
    hull: f64,
    /// Perimeter at the contact offset, in m.
    with_offset: f64,
    /// Length of the ring that would lie there, in m.
    needed: f64,
}

impl TightRing {
    fn stretch(&self) -> f64 {
        self.needed / self.ring.girth - 1.0
    }
}

/// Fit of a garment at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fit {
    /// It goes round the body.
    Wide,
    /// It goes round the body stretched.
    Stretched,
    /// It is too narrow.
    Narrow,
}

/// Girths of a garment, and the bodies that it goes round.
pub(crate) struct Girths<'a> {
    scene: &'a Scene,
    pub(crate) garment: &'a Garment,
    bodies: &'a [Triangulation],
    rings: Vec<Ring>,
    /// Number of openings of the garment. The openings are the first of `rings`.
    openings: usize,
}

impl<'a> Girths<'a> {
    /// Measures `garment` of `scene`. `bodies` are the solid bodies of `scene`.
    pub(crate) fn new(scene: &'a Scene, bodies: &'a [Triangulation], garment: &'a Garment) -> Self {
        let panels = scene.panels_of(garment);
        let openings = openings(scene).into_iter();
        let mut rings: Vec<Ring> = openings.filter(|ring| panels.contains(&ring.panel)).collect();
        let count = rings.len();
        let finder = RingFinder::new(scene);
        rings.extend(heights(scene, &panels).flat_map(|height| finder.at_height(&panels, height)));
        Self { scene, garment, bodies, rings, openings: count }
    }

    /// Returns the ring of `rings` that stretches most where the garment is moved by `shift`, in m.
    fn tightest(&self, rings: &[&Ring], shift: [f64; 3]) -> Option<TightRing> {
        let tight =
            rings.iter().filter_map(|ring| tight(self.scene, self.bodies, ring.moved(shift)));
        tight.max_by(|a, b| a.stretch().total_cmp(&b.stretch()))
    }

    /// Returns the ring round `point` that is nearest to `height`, in m, or `None` if no ring is
    /// near.
    pub(crate) fn around(&self, height: f64, point: [f64; 2]) -> Option<&Ring> {
        let away = |ring: &Ring| (ring.plane.height() - height).abs();
        let goes_round = |ring: &&Ring| {
            let plane = SectionPlane::horizontal(height);
            let outline = ring.points.iter().map(|&place| plane.flat(place)).collect();
            away(ring) <= SLACK && encloses(&convex_hull(outline), point)
        };
        let near = self.rings.iter().filter(goes_round);
        near.min_by(|a, b| away(a).total_cmp(&away(b)))
    }

    /// Returns whether the garment is worn at the waist, as skirts with two openings and trousers
    /// with three are; shirts have more.
    pub(crate) fn is_worn_at_waist(&self) -> bool {
        matches!(self.openings, 2 | 3)
    }

    /// Returns how the garment fits where it is moved by `shift`, in m, by about [`RINGS`] of its
    /// rings.
    pub(crate) fn fit(&self, shift: [f64; 3]) -> Fit {
        let step = self.rings.len().div_ceil(RINGS).max(1);
        let some: Vec<&Ring> = self.rings.iter().step_by(step).collect();
        match self.tightest(&some, shift) {
            None => Fit::Wide,
            Some(worst) if pull(self.scene, &worst) <= PULL_MAX => Fit::Stretched,
            Some(_) => Fit::Narrow,
        }
    }
}

/// Returns a note on the garment of `girths` if it has to stretch.
pub(crate) fn girth_note(girths: &Girths<'_>) -> Option<String> {
    let all: Vec<&Ring> = girths.rings.iter().collect();
    let worst = girths.tightest(&all, [0.0; 3])?;
    let pull = pull(girths.scene, &worst);
    Some(format!("{}; {}", describe(&girths.garment.name, &worst, pull), remedy(&worst)))
}

/// Returns the heights at which `panels` are cut, in m.
fn heights(scene: &Scene, panels: &[usize]) -> impl Iterator<Item = f64> {
    let particles = panels.iter().flat_map(|&panel| scene.panels[panel].particles());
    let heights = particles.map(|particle| scene.start.positions[3 * particle + 1]);
    let [low, high] =
        heights.fold([f64::MAX, f64::MIN], |[low, high], y| [low.min(y), high.max(y)]);
    let spacing = panels.iter().flat_map(|&panel| scene.panels[panel].lattice.spacing());
    let step = spacing.fold(STEP_MIN, f64::max);
    let count = ((high - low) / step).max(0.0) as usize;
    (0..count).map(move |k| low + (k as f64 + 0.5) * step)
}

/// Returns the girths of `ring` if the ring is too short for `bodies`, wherever within [`SLACK`] of
/// its place it lies.
fn tight(scene: &Scene, bodies: &[Triangulation], ring: Ring) -> Option<TightRing> {
    let outline = convex_hull(ring.points.iter().map(|&point| ring.plane.flat(point)).collect());
    let mut hull = f64::INFINITY;
    for part in [0.0, -1.0, -0.5, 0.5, 1.0] {
        let moved = hull_inside(bodies, &outline, &ring.plane.moved(part * SLACK))?;
        hull = hull.min(moved);
    }
    let with_offset = hull + TAU * scene.contact.particles.activation_distance;
    let [across, along] = scene.panels[ring.panel].lattice.spacing();
    let arcs = (ring.girth / across.max(along)).round().max(3.0);
    let needed = with_offset * arcs / PI * (PI / arcs).tan();
    (needed > (1.0 + STRETCH_MIN) * ring.girth).then_some(TightRing {
        ring,
        hull,
        with_offset,
        needed,
    })
}

/// Returns the perimeter of the hull of the limbs of `bodies` that `plane` cuts inside `outline`,
/// in m.
fn hull_inside(
    bodies: &[Triangulation],
    outline: &[[f64; 2]],
    plane: &SectionPlane,
) -> Option<f64> {
    let is_inside = |limb: &Vec<[f64; 2]>| {
        let inside = limb.iter().filter(|&&point| encloses(outline, point)).count();
        inside as f64 >= LIMB_MIN * limb.len() as f64
    };
    let cuts = bodies.iter().flat_map(|body| plane.lines(body).unwrap_or_default());
    let limbs = cuts.filter(is_inside);
    let points: Vec<[f64; 2]> = limbs.flatten().collect();
    (points.len() > 2).then(|| perimeter(&convex_hull(points)))
}

/// Returns the load of the fabric of the ring `tight` at the needed stretch, in N/m, along the
/// softer yarns.
fn pull(scene: &Scene, tight: &TightRing) -> f64 {
    let fabric = &scene.materials[scene.panels[tight.ring.panel].material].fabric;
    let stretch = tight.stretch();
    let laws = [&fabric.warp.traction, &fabric.weft.traction];
    laws.map(|law| law.elastic(stretch, stretch).load).into_iter().fold(f64::INFINITY, f64::min)
}

/// Describes `garment`, which is too narrow and pulls with `pull`, in N/m.
fn describe(garment: &str, tight: &TightRing, pull: f64) -> String {
    let TightRing { ring, hull, with_offset, needed } = tight;
    let limit = if pull > PULL_MAX {
        ", more than the tensile test has: its seams may stay open"
    } else {
        ""
    };

    format!(
        "\"{garment}\" is too narrow at a height of {:.2} m: {}{} measure {:.0} mm round, and the body's hull {:.0} mm there, \
         {:.0} mm with contact.offset, {:.0} mm for its particles at this spacing; it would stretch by {:.1} % and pull \
         with {pull:.0} N/m{limit}",
        ring.plane.height(),
        ring.parts.join(" + "),
        seams(ring),
        1e3 * ring.girth,
        1e3 * hull,
        1e3 * with_offset,
        1e3 * needed,
        100.0 * tight.stretch()
    )
}

/// Names the seams that `ring` goes across.
fn seams(ring: &Ring) -> String {
    let named: Vec<String> = ring.seams.iter().map(|seam| format!("\"{seam}\"")).collect();
    match &named[..] {
        [] => String::new(),
        [one] => format!(" with seam {one}"),
        several => format!(" with seams {}", several.join(", ")),
    }
}

/// Returns the remedy for a garment with the ring `tight`.
fn remedy(tight: &TightRing) -> String {
    let TightRing { ring, with_offset, needed, .. } = tight;
    let wider = (1e3 * (needed - ring.girth)).ceil();
    let coarse = if ring.girth > *with_offset { ", choose a smaller spacing" } else { "" };
    format!(
        "widen it there by {wider:.0} mm in all{coarse}, or start it where the body is narrower (center)"
    )
}
