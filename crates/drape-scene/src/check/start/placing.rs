//! Placing of garments: checks whether a garment starts round a body, and finds the shift that
//! would bring the garment there.
//!
//! A garment is about a body if its horizontal outline goes round a part of the body. A garment
//! that hangs from the waist, as the number of its openings shows, is brought to the lowest place
//! where it is wide enough and the body below is too wide for it. Any other garment is brought to
//! the place where its particles are nearest to the bodies on average without being inside a body.
//! Particles at the top count for more, since a garment hangs from its top.

use std::cmp::Ordering;

use drape_collide::{Body, Shape, Triangulation};

use crate::check::checker::Checker;
use crate::scene::Scene;
use crate::scene::garment::Garment;
use crate::surfaces::StartSurfaces;
use drape_collide::section::{SectionPlane, convex_hull, encloses};

use super::girth::{Fit, Girths};

/// Number of heights at which the outline of a garment is compared with the bodies.
const HEIGHTS: usize = 24;

/// Least fraction of the heights at which a garment that is worn goes round a body. The shipped
/// garments go round it at 9 of 10.
const AROUND_MIN: f64 = 0.25;

/// Least height of a garment over its width if it goes round a body. Lower garments lie flat and
/// fall on the body.
const FLAT: f64 = 0.1;

/// A garment below this fraction of a figure's height is about its feet.
const FEET: f64 = 0.3;

/// A garment taller than this fraction of a figure's height is neither a shoe nor a sock.
const TALL: f64 = 0.25;

/// Largest fraction of a garment's particles inside a body at which its place still counts as
/// right.
const INSIDE_MAX: f64 = 0.002;

/// Number of particles by which all tried places are compared.
const SAMPLES_COARSE: usize = 100;
/// Number of particles by which places near the best one are compared.
const SAMPLES: usize = 250;

/// Distance from a body at which a garment should start, in m. Surfaces are apart there.
const MARGIN: f64 = 0.005;

/// Increase of the weight of a distance with the distance, in 1/m. Among places with equal mean
/// distance, the most centred place then costs least.
const CENTRING: f64 = 2.0;

/// Weight of a depth below [`MARGIN`] over the weight of a distance outside a body.
const DEPTH_WEIGHT: f64 = 50.0;

/// Fraction of a garment's height that counts as its top.
const TOP: f64 = 0.1;
/// Weight of a distance at the top of a garment.
const TOP_WEIGHT: f64 = 10.0;

/// Step of the heights that are tried, in m.
const STEP: f64 = 0.04;
/// Step at which the search near the best place ends, in m.
const STEP_LAST: f64 = 0.004;

/// Shifts to the back and to the front that are tried at each height, in steps of [`STEP`].
const ASIDE: [f64; 7] = [-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5];

/// A waist position holds if the garment no longer fits this far below it, in m.
const SLIDE: f64 = 0.12;

/// Least distance of a garment from every body at an advised place, in m.
pub(crate) const CLEAR: f64 = 0.002;
/// Particles farther from the bodies than this are skipped in the local search, in m.
const NEAR: f64 = 0.12;

/// Number of the best places of all heights from which a local search begins if none is clear of
/// the bodies.
const CLOSE: usize = 4;
/// Number of the best places of one height from which a local search begins.
const CLOSE_AT_HEIGHT: usize = 2;

/// Distances by which an advised place is shifted along each axis, in m, if surfaces cross there.
const NUDGES: [f64; 5] = [0.005, 0.01, 0.015, 0.02, 0.03];

/// Factor on the cost of a place where the garment has to stretch.
const STRETCHED: f64 = 1.5;

/// Bodies that a garment can be worn on: all but floors.
pub(crate) struct Solids<'a> {
    bodies: Vec<&'a Body>,
    pub(crate) outlines: Vec<Triangulation>,
    low: [f64; 3],
    high: [f64; 3],
}

/// Place of a garment relative to the bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
enum GarmentPlace {
    /// The garment goes round a body.
    About,
    /// The garment goes round the feet of a figure.
    Feet,
    /// A `fraction` of the particles is inside a body.
    Inside { fraction: f64 },
    /// The garment goes round a body at no more than a `fraction` of its heights.
    Beside { fraction: f64 },
}

impl<'a> Solids<'a> {
    /// Returns the solid ones among `bodies`, or `None` if all `bodies` are floors.
    pub(crate) fn new(bodies: impl Iterator<Item = &'a Body>) -> Option<Self> {
        let solid = bodies.filter(|body| !matches!(body.shape, Shape::Plane));
        let outlined = solid.filter_map(|body| Some((body, body.triangulate().ok()?)));
        let (bodies, outlines): (Vec<_>, Vec<Triangulation>) = outlined.unzip();
        let [low, high] = extent(outlines.iter().flat_map(|outline| &outline.vertices));
        (!bodies.is_empty()).then_some(Self { bodies, outlines, low, high })
    }

    /// Returns the signed distance of `point` from the nearest body, in m.
    pub(crate) fn distance(&self, point: [f64; 3]) -> f64 {
        let distances = self.bodies.iter().filter_map(|body| body.signed_distance(point).ok());
        distances.map(|near| near.distance).fold(f64::INFINITY, f64::min)
    }

    /// Returns the fraction of [`HEIGHTS`] at which the horizontal outline of `points` goes round a
    /// part of a body.
    fn fraction_around(&self, points: &[[f64; 3]]) -> f64 {
        let [low, high] = extent(points.iter());
        let band = (high[1] - low[1]) / HEIGHTS as f64;
        let around = (0..HEIGHTS).filter(|k| {
            let height = low[1] + (*k as f64 + 0.5) * band;
            let plane = SectionPlane::horizontal(height);
            let near = points.iter().filter(|point| (point[1] - height).abs() <= band);
            let outline = convex_hull(near.map(|&point| plane.flat(point)).collect());
            self.outlines.iter().any(|body| {
                let corners = |t: &[u32; 3]| t.map(|corner| body.vertices[corner as usize]);
                let mut cuts = body.triangles.iter().flat_map(|t| plane.cuts(corners(t)));
                cuts.any(|point| encloses(&outline, point))
            })
        });
        around.count() as f64 / HEIGHTS as f64
    }

    /// Returns the fraction of `points` that are inside a body.
    fn fraction_inside(&self, points: &[[f64; 3]]) -> f64 {
        let inside = points.iter().filter(|&&point| self.distance(point) < 0.0).count();
        inside as f64 / points.len().max(1) as f64
    }

    /// Returns the place of a garment whose particles are at `points`.
    fn place(&self, points: &[[f64; 3]]) -> GarmentPlace {
        let [low, high] = extent(points.iter());
        let width = (high[0] - low[0]).max(high[2] - low[2]);
        let [figure, garment] = [self.high[1] - self.low[1], high[1] - low[1]];
        if garment < FLAT * width {
            return GarmentPlace::About;
        }
        let around = self.fraction_around(points);
        let inside = self.fraction_inside(points);
        let is_figure = figure > (self.high[0] - self.low[0]).max(self.high[2] - self.low[2]);
        let is_at_feet = garment > TALL * figure && high[1] < self.low[1] + FEET * figure;

        if around < AROUND_MIN {
            GarmentPlace::Beside { fraction: around }
        } else if inside > INSIDE_MAX {
            GarmentPlace::Inside { fraction: inside }
        } else if is_figure && is_at_feet {
            GarmentPlace::Feet
        } else {
            GarmentPlace::About
        }
    }

    /// Returns the shift, in m, that brings a garment with particles at `points` about a body, or
    /// `None` if no place was found. A garment that `girths` shows to be worn at the waist comes to
    /// the place where it holds there. Any other garment comes to the nearest place at which it
    /// fits and is clear of bodies.
    pub(crate) fn shift(
        &self,
        points: &[[f64; 3]],
        girths: Option<&Girths<'_>>,
    ) -> Option<[f64; 3]> {
        let waist = girths.filter(|girths| girths.is_worn_at_waist());
        let waist = waist.and_then(|girths| self.place_at_waist(points, girths));
        let place = waist.or_else(|| {
            let near = self.place_near(points, girths)?;
            Some(self.refine(points, near, Search { axes: &[0, 1, 2], clear: true }))
        });
        place.map(|place| place.map(|x| (1e3 * x).round() / 1e3))
    }

    /// Returns the shifts of `points`, in m, that are tried: for each height from the foot of the
    /// bodies to their top, the shifts to the back and to the front.
    fn places(&self, points: &[[f64; 3]]) -> Vec<[[f64; 3]; 7]> {
        let [low, high] = extent(points.iter());
        let middle = [0, 1, 2].map(|k| 0.5 * (self.low[k] + self.high[k] - low[k] - high[k]));
        let [first, last] = [self.low[1] - low[1], self.high[1] - high[1]];
        let count = ((last - first) / STEP).clamp(0.0, 1000.0) as usize;
        let heights = (0..=count).map(|k| first + k as f64 * STEP);
        heights.map(|y| ASIDE.map(|part| [middle[0], y, middle[2] + part * STEP])).collect()
    }

    /// Returns the shift of `points`, in m, to the lowest place at which the garment of `girths`
    /// does not slide down. Places where the garment goes round the body without a stretch come
    /// first.
    fn place_at_waist(&self, points: &[[f64; 3]], girths: &Girths<'_>) -> Option<[f64; 3]> {
        let places = self.places(points);
        let fits: Vec<Fit> =
            places.iter().map(|shifts| girths.fit(shifts[shifts.len() / 2])).collect();
        [Fit::Wide, Fit::Stretched].into_iter().find_map(|wanted| {
            let fitting = places.iter().zip(&fits).filter(|(_, fit)| **fit == wanted);
            let mut held = fitting.filter(|(places, _)| {
                let middle = places[places.len() / 2];
                let lower = girths.fit([middle[0], middle[1] - SLIDE, middle[2]]);
                lower == Fit::Narrow || (lower == Fit::Stretched && wanted == Fit::Wide)
            });
            held.find_map(|(places, _)| self.clear_place(points, places))
        })
    }

    /// Returns one of the shifts `places` to one height, in m, or a shift near them, at which
    /// `points` are clear of the bodies.
    fn clear_place(&self, points: &[[f64; 3]], places: &[[f64; 3]]) -> Option<[f64; 3]> {
        let samples = samples(points, SAMPLES_COARSE);
        let mut costed: Vec<(f64, [f64; 3])> =
            places.iter().map(|&place| (self.cost(&samples, place), place)).collect();
        costed.sort_by(|a, b| a.0.total_cmp(&b.0));
        let all = costed.iter().map(|(_, place)| *place);
        if let Some(place) = all.clone().find(|place| self.is_free(points, *place)) {
            return Some(self.refine(points, place, Search { axes: &[0, 2], clear: true }));
        }
        self.close_place(points, all.take(CLOSE_AT_HEIGHT))
    }

    /// Returns a shift, in m, near one of the shifts `places` at which `points` are clear of the
    /// bodies and go round one. A close garment is clear of the body at one place only.
    fn close_place(
        &self,
        points: &[[f64; 3]],
        places: impl Iterator<Item = [f64; 3]>,
    ) -> Option<[f64; 3]> {
        let search = Search { axes: &[0, 1, 2], clear: false };
        let mut refined = places.map(|place| self.refine(points, place, search));
        refined.find(|place| self.is_free(points, *place))
    }

    /// Returns the shift, in m, to the place at which `points` are nearest to the bodies, are clear
    /// of them, and fit by `girths`.
    fn place_near(&self, points: &[[f64; 3]], girths: Option<&Girths<'_>>) -> Option<[f64; 3]> {
        let coarse = samples(points, SAMPLES_COARSE);
        let places = self.places(points).into_iter().flatten();
        let mut costed: Vec<(f64, [f64; 3])> =
            places.map(|shift| (self.cost(&coarse, shift), shift)).collect();
        costed.sort_by(|a, b| a.0.total_cmp(&b.0));

        // Costs rise along the list, so the search ends where even a wide fit could not beat the
        // best place.
        let mut best: Option<Candidate> = None;
        for &(cost, shift) in &costed {
            let candidate = Candidate { fit: Fit::Wide, cost, shift };
            if best.is_some_and(|best| best.compare(&candidate).is_lt()) {
                break;
            }
            if self.is_free(points, shift) {
                let fit = girths.map_or(Fit::Wide, |girths| girths.fit(shift));
                let candidate = Candidate { fit, ..candidate };
                if best.is_none_or(|best| candidate.compare(&best).is_lt()) {
                    best = Some(candidate);
                }
            }
        }

        let near = costed.iter().take(CLOSE).map(|(_, shift)| *shift);
        best.map(|best| best.shift).or_else(|| self.close_place(points, near))
    }

    /// Returns whether `points` moved by `shift`, in m, are clear of the bodies and go round one.
    fn is_free(&self, points: &[[f64; 3]], shift: [f64; 3]) -> bool {
        self.is_clear(points, shift) && self.is_around(points, shift)
    }

    /// Returns whether all `points` moved by `shift`, in m, are clear of the bodies.
    fn is_clear(&self, points: &[[f64; 3]], shift: [f64; 3]) -> bool {
        points.iter().all(|point| self.distance(moved(point, shift)) > CLEAR)
    }

    /// Returns whether `points` moved by `shift`, in m, go round a body.
    fn is_around(&self, points: &[[f64; 3]], shift: [f64; 3]) -> bool {
        let moved: Vec<[f64; 3]> = points.iter().map(|point| moved(point, shift)).collect();
        self.fraction_around(&moved) >= AROUND_MIN
    }

    /// Returns the cost of a garment with particles at `points` that is moved by `shift`: its
    /// weighted mean distance from the bodies, in m.
    fn cost(&self, points: &[[f64; 3]], shift: [f64; 3]) -> f64 {
        let [low, high] = extent(points.iter());
        let top = high[1] - TOP * (high[1] - low[1]);
        let costs = points.iter().map(|point| {
            let distance = self.distance(moved(point, shift));
            let weight = if point[1] > top { TOP_WEIGHT } else { 1.0 };
            let depth = (MARGIN - distance).max(0.0);
            weight * distance.max(0.0) * (1.0 + CENTRING * distance) + DEPTH_WEIGHT * depth
        });
        costs.sum::<f64>() / points.len() as f64
    }

    /// Returns the shift near `start`, in m, at which `points` are nearest to the bodies: a pattern
    /// search that halves its step where no step lowers the cost.
    fn refine(&self, points: &[[f64; 3]], start: [f64; 3], search: Search<'_>) -> [f64; 3] {
        let samples = samples(points, SAMPLES);
        let near = points.iter().filter(|point| self.distance(moved(point, start)) < NEAR);
        let near: Vec<[f64; 3]> = near.copied().collect();

        let (mut best, mut least) = (start, self.cost(&samples, start));
        let mut step = 0.5 * STEP;
        while step > STEP_LAST {
            let mut improved = false;
            for (axis, sign) in search.axes.iter().flat_map(|&k| [(k, -1.0), (k, 1.0)]) {
                let mut shift = best;
                shift[axis] += sign * step;
                let cost = self.cost(&samples, shift);
                let is_here = (0..3).all(|k| (shift[k] - start[k]).abs() <= 0.5 * NEAR);
                if cost < least && is_here && (!search.clear || self.is_clear(&near, shift)) {
                    (best, least, improved) = (shift, cost, true);
                }
            }
            if !improved {
                step *= 0.5;
            }
        }
        best
    }
}

/// Settings of the search for the best place near another one.
#[derive(Clone, Copy)]
struct Search<'a> {
    /// Axes along which a garment is moved.
    axes: &'a [usize],
    /// Whether particles that start near the bodies stay clear of them.
    clear: bool,
}

/// Place that is compared with others.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    fit: Fit,
    /// Cost of the place, in m.
    cost: f64,
    /// Shift, in m.
    shift: [f64; 3],
}

impl Candidate {
    /// Compares this place with `other`. The better place is less.
    fn compare(&self, other: &Self) -> Ordering {
        let ((narrow, cost), (other_narrow, other_cost)) = (self.rank(), other.rank());
        narrow.cmp(&other_narrow).then(cost.total_cmp(&other_cost))
    }

    /// Returns whether the garment is too narrow at this place, and the weighted cost, in m.
    fn rank(&self) -> (bool, f64) {
        match self.fit {
            Fit::Wide => (false, self.cost),
            Fit::Stretched => (false, STRETCHED * self.cost),
            Fit::Narrow => (true, self.cost),
        }
    }
}

/// Results of the check of the places of all garments.
#[derive(Default)]
pub(crate) struct PlaceReport {
    /// Notes on garments about the feet of a figure.
    pub(crate) notes: Vec<String>,
    /// Whether a garment is at a wrong place for which another place is advised.
    pub(crate) advised: bool,
}

/// Checks the places of the garments of `scene`. Garments that pins hold need no body. A garment at
/// a wrong place is a mistake with the advised place as its remedy.
pub(crate) fn check_places(checker: &mut Checker<'_>, scene: &Scene) -> PlaceReport {
    let mut report = PlaceReport::default();
    let Some(solids) = Solids::new(scene.bodies.iter().map(|moving| &moving.body)) else {
        return report;
    };
    for (number, garment) in scene.garments.iter().enumerate() {
        if is_held(scene, garment) {
            continue;
        }
        let points = points(scene, garment);
        let place = solids.place(&points);
        if place == GarmentPlace::About
            || (matches!(place, GarmentPlace::Inside { .. }) && grows(scene))
        {
            continue;
        }

        let fault = describe(&garment.name, place, &points, &solids);
        let girths = Girths::new(scene, &solids.outlines, garment);
        let shift =
            solids.shift(&points, Some(&girths)).map(|shift| free_shift(scene, garment, shift));
        let remedy = PlaceRemedy::new(checker, number, shift);

        match place {
            GarmentPlace::Feet => report.notes.push(format!("{fault}; {}", remedy.help)),
            _ => {
                let key = format!("garment[{number}].pattern");
                let mistake = checker.fail(&key, fault, &remedy.help);
                remedy.attach(checker, mistake, number);
                report.advised |= shift.is_some();
            }
        }
    }
    report
}

/// Returns whether the bodies of `scene` grow at the start.
fn grows(scene: &Scene) -> bool {
    scene.contact.inflation.is_some()
}

/// Returns whether pins hold particles of `garment`.
pub(super) fn is_held(scene: &Scene, garment: &Garment) -> bool {
    let mut pinned = scene.pins.iter().flat_map(|pin| &pin.particles);
    pinned.any(|particle| garment.particles.contains(particle))
}

/// Returns the positions of the particles of `garment` at the start, in m.
fn points(scene: &Scene, garment: &Garment) -> Vec<[f64; 3]> {
    scene.start.positions.as_chunks::<3>().0[garment.particles.clone()].to_vec()
}

/// Returns the shift of `garment` nearest to `shift`, in m, at which the garment crosses nothing,
/// or `shift` if there is none. A place that is clear at all particles can still be crossed, since
/// fingers fit between the particles of a coarse panel.
fn free_shift(scene: &Scene, garment: &Garment, shift: [f64; 3]) -> [f64; 3] {
    let surfaces = scene.contact.surfaces.then(|| StartSurfaces::new(scene).ok()).flatten();
    let Some(StartSurfaces { mut contact, .. }) = surfaces else { return shift };

    // Small distances come first, and of each distance the vertical axis.
    let axes = NUDGES.iter().flat_map(|nudge| [1, 2, 0].map(|axis| (axis, nudge)));
    let nudged = axes.flat_map(|(axis, nudge)| {
        [*nudge, -nudge].map(|distance| {
            let mut nudged = shift;
            nudged[axis] += distance;
            nudged
        })
    });

    let mut shifts = std::iter::once(shift).chain(nudged);
    let free = shifts.find(|shift| {
        let mut positions = scene.start.positions.clone();
        for point in &mut positions.as_chunks_mut::<3>().0[garment.particles.clone()] {
            *point = moved(point, *shift);
        }
        contact.intersections(&positions).is_ok_and(<[_]>::is_empty)
    });
    free.unwrap_or(shift)
}

/// Describes where `garment`, with its particles at `points`, starts relative to `solids`.
fn describe(
    garment: &str,
    place: GarmentPlace,
    points: &[[f64; 3]],
    solids: &Solids<'_>,
) -> String {
    let [low, high] = extent(points.iter());
    let [bottom, top] = [solids.low[1], solids.high[1]];
    let heights = format!(
        "between {:.2} and {:.2} m, and the body is between {bottom:.2} and {top:.2} m",
        low[1], high[1]
    );

    match place {
        GarmentPlace::Feet | GarmentPlace::About => {
            format!("\"{garment}\" starts about the feet of the body: it is {heights}")
        }
        GarmentPlace::Inside { fraction } => {
            let percent = match 100.0 * fraction {
                percent if percent < 1.0 => "Less than 1".to_owned(),
                percent => format!("{percent:.0}"),
            };
            format!("{percent} % of \"{garment}\" starts inside the body: it is {heights}")
        }
        GarmentPlace::Beside { fraction } => {
            let side = if high[1] < bottom + FEET * (top - bottom) {
                "at the feet of"
            } else if low[1] > top {
                "above"
            } else {
                "beside"
            };
            format!(
                "\"{garment}\" starts {side} the body, not about it: it goes round it at {:.0} % of its heights; it is \
                 {heights}",
                100.0 * fraction
            )
        }
    }
}

/// Remedy for a wrong place of a garment, in words and as the TOML value of its `center`, if a
/// place was found.
pub(crate) struct PlaceRemedy {
    pub(crate) help: String,
    center: Option<String>,
}

impl PlaceRemedy {
    /// Returns the remedy for the garment with the number `garment`. `shift` leads to the place
    /// that was found, in m.
    pub(crate) fn new(checker: &Checker<'_>, garment: usize, shift: Option<[f64; 3]>) -> Self {
        let (Some(shift), Some(entry)) = (shift, checker.spec.garment.get(garment)) else {
            let help = "no place about the body was found: does the pattern fit it? turn or move its panels";
            return Self { help: help.into(), center: None };
        };
        let unit = checker.spec.length.metres();
        let [x, y, z] = [0, 1, 2].map(|k| (entry.center[k] + shift[k]) / unit);
        let digits = if unit == 1.0 { 3 } else { 0 };
        let center = format!("[{x:.digits$}, {y:.digits$}, {z:.digits$}]");
        let help =
            format!("write center = {center} in its [[garment]]; there it is about the body");
        Self { help, center: Some(center) }
    }

    /// Attaches the new `center` of the garment with the number `garment` to the mistake with the
    /// index `mistake`.
    pub(crate) fn attach(&self, checker: &mut Checker<'_>, mistake: usize, garment: usize) {
        if let Some(center) = &self.center {
            checker.remedy(mistake, &format!("garment[{garment}].center"), Some(center));
        }
    }
}

/// Returns `point` moved by `shift`.
pub(super) fn moved(point: &[f64; 3], shift: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| point[k] + shift[k])
}

/// Returns about `count` of `points`, evenly spaced in the list.
fn samples(points: &[[f64; 3]], count: usize) -> Vec<[f64; 3]> {
    points.iter().step_by((points.len() / count).max(1)).copied().collect()
}

/// Returns the low and the high corner of the bounding box of `points`.
fn extent<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> [[f64; 3]; 2] {
    points.fold([[f64::MAX; 3], [f64::MIN; 3]], |[low, high], point| {
        [[0, 1, 2].map(|k| low[k].min(point[k])), [0, 1, 2].map(|k| high[k].max(point[k]))]
    })
}
