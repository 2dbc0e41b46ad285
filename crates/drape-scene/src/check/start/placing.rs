//! Places of garments: whether a garment starts about its body, and the shift that would bring it
//! there.
//!
//! A garment is about a body where its horizontal outline goes round a part of it. One that hangs
//! from the waist, as its openings tell, is brought to the lowest place where it is wide enough and
//! the body below is too wide for it. Others are brought to where their particles are nearest to the
//! bodies on average, without being inside of them; those at the top count for more, since a garment
//! hangs from there.

use std::cmp::Ordering;

use drape_collide::{Body, Shape, Triangulation};

use crate::check::checker::Checker;
use crate::scene::Scene;
use crate::scene::garment::Garment;
use crate::surfaces::StartSurfaces;
use drape_collide::section::{SectionPlane, convex_hull, encloses};

use super::girth::{Fit, Girths};

/// Number of heights at which a garment is looked at.
const HEIGHTS: usize = 24;

/// Fraction of its heights at which a garment goes round a body, at least. The shipped garments do
/// so at 9 of 10.
const AROUND_MIN: f64 = 0.25;

/// Fraction of its width that a garment is high, at least, for it to go round a body: lower ones
/// lie flat and fall on it.
const FLAT: f64 = 0.1;

/// Fraction of a figure's height below which a garment is about its feet.
const FEET: f64 = 0.3;

/// Fraction of a figure's height from which on a garment is more than a shoe or a sock.
const TALL: f64 = 0.25;

/// Fraction of its particles that may start inside a body before another place is looked for.
const INSIDE_MAX: f64 = 0.002;

/// Number of particles by which places are compared: of all that are tried, and near the best.
const SAMPLES_COARSE: usize = 100;
const SAMPLES: usize = 250;

/// Distance from a body at which a garment is to start, in m: its surfaces are apart there.
const MARGIN: f64 = 0.005;

/// Increase of the weight of a distance with it, in 1/m: of places with one mean distance, that in
/// the middle is taken.
const CENTRING: f64 = 2.0;

/// Weight of a depth below the margin against a distance outside of a body.
const DEPTH_WEIGHT: f64 = 50.0;

/// Fraction of a garment's height that is its top, and the weight of a distance there.
const TOP: f64 = 0.1;
const TOP_WEIGHT: f64 = 10.0;

/// Step of the heights that are tried, in m, and the last step of the search around the best.
const STEP: f64 = 0.04;
const STEP_LAST: f64 = 0.004;

/// Places to the back and to the front that are tried at each height, in steps.
const ASIDE: [f64; 7] = [-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5];

/// Way down on which a garment that is worn at the waist comes to where the body is too wide for it,
/// in m.
const SLIDE: f64 = 0.12;

/// Distance from bodies that all particles of a garment have at a place that is advised, in m, and
/// distance beyond which those are that the search around it need not look at.
pub(crate) const CLEAR: f64 = 0.002;
const NEAR: f64 = 0.12;

/// Number of the best places around which a search begins where none is clear of the bodies: of all
/// heights, and of one.
const CLOSE: usize = 4;
const CLOSE_AT_HEIGHT: usize = 2;

/// Ways up and down, to the front and to the back, and to the sides by which a place that is advised is
/// changed where surfaces cross, in m.
const NUDGES: [f64; 5] = [0.005, 0.01, 0.015, 0.02, 0.03];

/// Weight of the cost of a place where a garment has to stretch.
const STRETCHED: f64 = 1.5;

/// Bodies without floors.
pub(crate) struct Solids<'a> {
    bodies: Vec<&'a Body>,
    outlines: Vec<Triangulation>,
    low: [f64; 3],
    high: [f64; 3],
}

/// Place of a garment against its bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    About,
    Feet,
    Inside { fraction: f64 },
    Beside { fraction: f64 },
}

impl<'a> Solids<'a> {
    /// Returns the solid ones of some bodies, if there are some.
    pub(crate) fn new(bodies: impl Iterator<Item = &'a Body>) -> Option<Self> {
        let solid = bodies.filter(|body| !matches!(body.shape, Shape::Plane));
        let both = solid.filter_map(|body| Some((body, body.triangulate().ok()?)));
        let (bodies, outlines): (Vec<_>, Vec<_>) = both.unzip();
        let vertices = || outlines.iter().flat_map(|outline: &Triangulation| &outline.vertices);
        let [low, high] = extent(vertices());
        (!bodies.is_empty()).then_some(Self { bodies, outlines, low, high })
    }

    /// Returns the signed distance of a point from the nearest body, in m.
    pub(crate) fn distance(&self, point: [f64; 3]) -> f64 {
        let distances = self.bodies.iter().filter_map(|body| body.signed_distance(point).ok());
        distances.map(|near| near.distance).fold(f64::INFINITY, f64::min)
    }

    /// Returns the fraction of the heights of points at which their outline goes round a body.
    fn fraction_around(&self, points: &[[f64; 3]]) -> f64 {
        let [low, high] = extent(points.iter());
        let band = (high[1] - low[1]) / HEIGHTS as f64;
        let is_round = |k: &usize| {
            let height = low[1] + (*k as f64 + 0.5) * band;
            let plane = SectionPlane::horizontal(height);
            let near = points.iter().filter(|point| (point[1] - height).abs() <= band);
            let outline = convex_hull(near.map(|&point| plane.flat(point)).collect());
            self.outlines.iter().any(|body| {
                let corners = |t: &[u32; 3]| t.map(|corner| body.vertices[corner as usize]);
                let mut cuts = body.triangles.iter().flat_map(|t| plane.cuts(corners(t)));
                cuts.any(|point| encloses(&outline, point))
            })
        };
        (0..HEIGHTS).filter(is_round).count() as f64 / HEIGHTS as f64
    }

    /// Returns the fraction of points that are inside a body.
    fn fraction_inside(&self, points: &[[f64; 3]]) -> f64 {
        let inside = points.iter().filter(|&&point| self.distance(point) < 0.0).count();
        inside as f64 / points.len().max(1) as f64
    }

    /// Returns the place of a garment with particles at some points.
    fn place(&self, points: &[[f64; 3]]) -> Place {
        let [low, high] = extent(points.iter());
        let width = (high[0] - low[0]).max(high[2] - low[2]);
        let [figure, own] = [self.high[1] - self.low[1], high[1] - low[1]];
        if own < FLAT * width {
            return Place::About;
        }
        let around = self.fraction_around(points);
        let inside = self.fraction_inside(points);
        let is_figure = figure > (self.high[0] - self.low[0]).max(self.high[2] - self.low[2]);
        match () {
            () if around < AROUND_MIN => Place::Beside { fraction: around },
            () if inside > INSIDE_MAX => Place::Inside { fraction: inside },
            () if is_figure && own > TALL * figure && high[1] < self.low[1] + FEET * figure => {
                Place::Feet
            }
            () => Place::About,
        }
    }

    /// Returns the shift, in m, that brings a garment with particles at some points about a body,
    /// if there is one: where it holds at the waist, if it is worn there by its girths, or else the
    /// nearest place at which it fits and is clear of bodies.
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

    /// Returns the shifts, in m, to a height, from the foot of the bodies to their top, and there to
    /// the front and to the back.
    fn places(&self, points: &[[f64; 3]]) -> Vec<[[f64; 3]; 7]> {
        let [low, high] = extent(points.iter());
        let middle = [0, 1, 2].map(|k| 0.5 * (self.low[k] + self.high[k] - low[k] - high[k]));
        let [first, last] = [self.low[1] - low[1], self.high[1] - high[1]];
        let count = ((last - first) / STEP).clamp(0.0, 1000.0) as usize;
        let heights = (0..=count).map(|k| first + k as f64 * STEP);
        heights.map(|y| ASIDE.map(|part| [middle[0], y, middle[2] + part * STEP])).collect()
    }

    /// Returns the shift, in m, to the lowest place at which a garment does not slide down: where it
    /// goes round the body without a stretch, or else with one.
    fn place_at_waist(&self, points: &[[f64; 3]], girths: &Girths<'_>) -> Option<[f64; 3]> {
        let places = self.places(points);
        let fits: Vec<Fit> = places.iter().map(|own| girths.fit(own[own.len() / 2])).collect();
        [Fit::Wide, Fit::Stretched].into_iter().find_map(|wanted| {
            let held = places.iter().zip(&fits).filter(|(_, fit)| **fit == wanted);
            let mut held = held.filter(|(places, _)| {
                let middle = places[places.len() / 2];
                let lower = girths.fit([middle[0], middle[1] - SLIDE, middle[2]]);
                lower == Fit::Narrow || (lower == Fit::Stretched && wanted == Fit::Wide)
            });
            held.find_map(|(places, _)| self.clear_place(points, places))
        })
    }

    /// Returns a shift, in m, among some to one height or near them, at which points are clear of the
    /// bodies.
    fn clear_place(&self, points: &[[f64; 3]], places: &[[f64; 3]]) -> Option<[f64; 3]> {
        let samples = samples(points, SAMPLES_COARSE);
        let costed = places.iter().map(|&place| (self.cost(&samples, place), place));
        let mut costed: Vec<(f64, [f64; 3])> = costed.collect();
        costed.sort_by(|a, b| a.0.total_cmp(&b.0));
        let all = costed.iter().map(|(_, place)| *place);
        if let Some(place) = all.clone().find(|place| self.is_free(points, *place)) {
            return Some(self.refine(points, place, Search { axes: &[0, 2], clear: true }));
        }
        self.close_place(points, all.take(CLOSE_AT_HEIGHT))
    }

    /// Returns a shift, in m, near some others at which points are clear of the bodies and go round one:
    /// a close garment is clear of the body at one place only.
    fn close_place(
        &self,
        points: &[[f64; 3]],
        places: impl Iterator<Item = [f64; 3]>,
    ) -> Option<[f64; 3]> {
        let search = Search { axes: &[0, 1, 2], clear: false };
        let mut near = places.map(|place| self.refine(points, place, search));
        near.find(|place| self.is_free(points, *place))
    }

    /// Returns the shift, in m, to the place at which a garment is nearest to the bodies, fits, and
    /// is clear of them.
    fn place_near(&self, points: &[[f64; 3]], girths: Option<&Girths<'_>>) -> Option<[f64; 3]> {
        let coarse = samples(points, SAMPLES_COARSE);
        let places = self.places(points).into_iter().flatten();
        let mut costed: Vec<(f64, [f64; 3])> =
            places.map(|shift| (self.cost(&coarse, shift), shift)).collect();
        costed.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut best: Option<Candidate> = None;
        for &(cost, shift) in &costed {
            let own = Candidate { fit: Fit::Wide, cost, shift };
            if best.is_some_and(|best| best.compare(&own).is_lt()) {
                break;
            }
            if self.is_free(points, shift) {
                let fit = girths.map_or(Fit::Wide, |girths| girths.fit(shift));
                let own = Candidate { fit, ..own };
                if best.is_none_or(|best| own.compare(&best).is_lt()) {
                    best = Some(own);
                }
            }
        }
        let near = costed.iter().take(CLOSE).map(|(_, shift)| *shift);
        best.map(|best| best.shift).or_else(|| self.close_place(points, near))
    }

    /// Returns whether points are clear of the bodies and go round one where they are moved by a shift,
    /// in m.
    fn is_free(&self, points: &[[f64; 3]], shift: [f64; 3]) -> bool {
        self.is_clear(points, shift) && self.is_around(points, shift)
    }

    /// Returns whether all points are clear of the bodies where they are moved by a shift, in m.
    fn is_clear(&self, points: &[[f64; 3]], shift: [f64; 3]) -> bool {
        let moved = |point: &[f64; 3]| [0, 1, 2].map(|k| point[k] + shift[k]);
        points.iter().all(|point| self.distance(moved(point)) > CLEAR)
    }

    /// Returns whether points go round a body where they are moved by a shift, in m.
    fn is_around(&self, points: &[[f64; 3]], shift: [f64; 3]) -> bool {
        let moved = |point: &[f64; 3]| [0, 1, 2].map(|k| point[k] + shift[k]);
        self.fraction_around(&points.iter().map(moved).collect::<Vec<_>>()) >= AROUND_MIN
    }

    /// Returns how far a garment with particles at some points is from the bodies where it is moved
    /// by a shift, in m.
    fn cost(&self, points: &[[f64; 3]], shift: [f64; 3]) -> f64 {
        let [low, high] = extent(points.iter());
        let top = high[1] - TOP * (high[1] - low[1]);
        let costs = points.iter().map(|point| {
            let distance = self.distance([0, 1, 2].map(|k| point[k] + shift[k]));
            let weight = if point[1] > top { TOP_WEIGHT } else { 1.0 };
            let depth = (MARGIN - distance).max(0.0);
            weight * distance.max(0.0) * (1.0 + CENTRING * distance) + DEPTH_WEIGHT * depth
        });
        costs.sum::<f64>() / points.len() as f64
    }

    /// Returns the shift near another, in m, at which points are nearest to the bodies.
    fn refine(&self, points: &[[f64; 3]], start: [f64; 3], search: Search<'_>) -> [f64; 3] {
        let samples = samples(points, SAMPLES);
        let at_start =
            |point: &&[f64; 3]| self.distance([0, 1, 2].map(|k| point[k] + start[k])) < NEAR;
        let near: Vec<[f64; 3]> = points.iter().filter(at_start).copied().collect();
        let (mut best, mut least) = (start, self.cost(&samples, start));
        let mut step = 0.5 * STEP;
        while step > STEP_LAST {
            let mut moved = false;
            for (axis, sign) in search.axes.iter().flat_map(|&k| [(k, -1.0), (k, 1.0)]) {
                let mut shift = best;
                shift[axis] += sign * step;
                let cost = self.cost(&samples, shift);
                let is_here = (0..3).all(|k| (shift[k] - start[k]).abs() <= 0.5 * NEAR);
                if cost < least && is_here && (!search.clear || self.is_clear(&near, shift)) {
                    (best, least, moved) = (shift, cost, true);
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
        best
    }
}

/// Search for the best place near another.
#[derive(Clone, Copy)]
struct Search<'a> {
    /// Axes along which a garment is moved.
    axes: &'a [usize],
    /// Whether it stays clear of the bodies where it is so at the start of the search.
    clear: bool,
}

/// Place of a garment that is looked at.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    fit: Fit,
    /// Cost of the place, in m.
    cost: f64,
    /// Shift, in m.
    shift: [f64; 3],
}

impl Candidate {
    /// Compares two places, the better one first.
    fn compare(&self, other: &Self) -> Ordering {
        let rank = |own: &Self| match own.fit {
            Fit::Wide => (false, own.cost),
            Fit::Stretched => (false, STRETCHED * own.cost),
            Fit::Narrow => (true, own.cost),
        };
        let ((narrow, cost), (other_narrow, other_cost)) = (rank(self), rank(other));
        narrow.cmp(&other_narrow).then(cost.total_cmp(&other_cost))
    }
}

/// What is said of the places of garments.
#[derive(Default)]
pub(crate) struct Places {
    /// Notes on those about the feet.
    pub(crate) notes: Vec<String>,
    /// Whether one is wrong, and its garment has got another.
    pub(crate) advised: bool,
}

/// Checks the places of the garments of a scene.
pub(crate) fn check_places(checker: &mut Checker<'_>, scene: &Scene) -> Places {
    let mut places = Places::default();
    let Some(solids) = Solids::new(scene.bodies.iter().map(|moving| &moving.body)) else {
        return places;
    };
    for (number, garment) in scene.garments.iter().enumerate() {
        // What is held needs no body.
        let held = |particle: &usize| garment.particles.contains(particle);
        if scene.pins.iter().any(|pin| pin.particles.iter().any(held)) {
            continue;
        }
        let points = points(scene, garment);
        let place = solids.place(&points);
        if place == Place::About || (matches!(place, Place::Inside { .. }) && grows(scene)) {
            continue;
        }
        let fault = describe(&garment.name, place, &points, &solids);
        let girths = Girths::new(scene, number);
        let shift = solids.shift(&points, Some(&girths)).map(|shift| apart(scene, garment, shift));
        let remedy = PlaceRemedy::new(checker, number, shift);
        match place {
            Place::Feet => places.notes.push(format!("{fault}; {}", remedy.help)),
            _ => {
                let key = format!("garment[{number}].pattern");
                let mistake = checker.fail(&key, fault, &remedy.help);
                remedy.attach(checker, mistake, number);
                places.advised |= shift.is_some();
            }
        }
    }
    places
}

/// Returns whether bodies grow at the start.
fn grows(scene: &Scene) -> bool {
    scene.contact.inflation.is_some()
}

fn points(scene: &Scene, garment: &Garment) -> Vec<[f64; 3]> {
    let place = |particle| [0, 1, 2].map(|axis| scene.start.positions[3 * particle + axis]);
    garment.particles.clone().map(place).collect()
}

/// Returns the place next to a shift of a garment, in m, at which it crosses nothing, or the same if there
/// is none: fingers can be between the particles of a coarse panel.
fn apart(scene: &Scene, garment: &Garment, shift: [f64; 3]) -> [f64; 3] {
    let surfaces = scene.contact.surfaces.then(|| StartSurfaces::new(scene).ok()).flatten();
    let Some(StartSurfaces { mut contact, .. }) = surfaces else { return shift };
    let own = 3 * garment.particles.start..3 * garment.particles.end;
    let mut crosses_nothing = |shift: &[f64; 3]| {
        let mut positions = scene.start.positions.clone();
        let places = positions[own.clone()].as_chunks_mut::<3>().0;
        places
            .iter_mut()
            .for_each(|place| *place = [0, 1, 2].map(|axis| place[axis] + shift[axis]));
        contact.intersections(&positions).is_ok_and(<[_]>::is_empty)
    };
    let ways = NUDGES.iter().flat_map(|way| [1, 2, 0].map(|axis| (axis, way)));
    let nudged = ways.flat_map(|(axis, way)| {
        [*way, -way].map(|way| {
            let mut nudged = shift;
            nudged[axis] += way;
            nudged
        })
    });
    std::iter::once(shift).chain(nudged).find(&mut crosses_nothing).unwrap_or(shift)
}

/// Describes where a garment starts.
fn describe(garment: &str, place: Place, points: &[[f64; 3]], solids: &Solids<'_>) -> String {
    let [low, high] = extent(points.iter());
    let [bottom, top] = [solids.low[1], solids.high[1]];
    let heights = format!(
        "between {:.2} and {:.2} m, and the body is between {bottom:.2} and {top:.2} m",
        low[1], high[1]
    );
    match place {
        Place::Feet | Place::About => {
            format!("\"{garment}\" starts about the feet of the body: it is {heights}")
        }
        Place::Inside { fraction } => {
            let percent = match 100.0 * fraction {
                percent if percent < 1.0 => "Less than 1".to_owned(),
                percent => format!("{percent:.0}"),
            };
            format!("{percent} % of \"{garment}\" starts inside the body: it is {heights}")
        }
        Place::Beside { fraction } => {
            let side = match () {
                () if high[1] < bottom + FEET * (top - bottom) => "at the feet of",
                () if low[1] > top => "above",
                () => "beside",
            };
            format!(
                "\"{garment}\" starts {side} the body, not about it: it goes round it at {:.0} % of its heights; it is \
                 {heights}",
                100.0 * fraction
            )
        }
    }
}

/// Remedy of a place: in words, and as the centre of the garment in TOML, if one was found.
pub(crate) struct PlaceRemedy {
    pub(crate) help: String,
    center: Option<String>,
}

impl PlaceRemedy {
    /// Returns the remedy for a garment with a number, by the shift to a place that was found, in m.
    pub(crate) fn new(checker: &Checker<'_>, garment: usize, shift: Option<[f64; 3]>) -> Self {
        let (Some(shift), Some(entry)) = (shift, checker.file.garment.get(garment)) else {
            let help = "no place about the body was found: does the pattern fit it? turn or move its panels";
            return Self { help: help.into(), center: None };
        };
        let [x, y, z] =
            [0, 1, 2].map(|k| (entry.center[k] * checker.unit + shift[k]) / checker.unit);
        let digits = if checker.unit == 1.0 { 3 } else { 0 };
        let center = format!("[{x:.digits$}, {y:.digits$}, {z:.digits$}]");
        let help =
            format!("write center = {center} in its [[garment]]; there it is about the body");
        Self { help, center: Some(center) }
    }

    /// Gives a mistake, by its index, the change that makes the remedy.
    pub(crate) fn attach(&self, checker: &mut Checker<'_>, mistake: usize, garment: usize) {
        if let Some(center) = &self.center {
            checker.remedy(mistake, &format!("garment[{garment}].center"), Some(center));
        }
    }
}

/// Returns about so many of many points, evenly.
fn samples(points: &[[f64; 3]], count: usize) -> Vec<[f64; 3]> {
    points.iter().step_by((points.len() / count).max(1)).copied().collect()
}

/// Returns the low and the high corner of the bounding box of points.
fn extent<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> [[f64; 3]; 2] {
    points.fold([[f64::MAX; 3], [f64::MIN; 3]], |[low, high], point| {
        [[0, 1, 2].map(|k| low[k].min(point[k])), [0, 1, 2].map(|k| high[k].max(point[k]))]
    })
}
