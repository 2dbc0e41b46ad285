//! Placing of garments: the shift that brings a garment about a body.
//!
//! A garment that hangs from the waist, as the number of its openings shows, is brought to the
//! lowest place where it is wide enough and the body below is too wide for it. Any other garment is
//! brought to the place where its particles are nearest to the bodies on average without being
//! inside a body. Particles at the top count for more, since a garment hangs from its top.

use std::cmp::Ordering;

use crate::scene::Scene;
use crate::scene::garment::Garment;
use crate::surfaces::StartSurfaces;

use super::girth::{Fit, Girths};
use super::solids::{Solids, extent, moved};

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

impl Solids<'_> {
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

/// Returns the shift of `garment` nearest to `shift`, in m, at which the garment crosses nothing,
/// or `shift` if there is none. A place that is clear at all particles can still be crossed, since
/// fingers fit between the particles of a coarse panel.
pub(crate) fn free_shift(scene: &Scene, garment: &Garment, shift: [f64; 3]) -> [f64; 3] {
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

/// Returns about `count` of `points`, evenly spaced in the list.
fn samples(points: &[[f64; 3]], count: usize) -> Vec<[f64; 3]> {
    points.iter().step_by((points.len() / count).max(1)).copied().collect()
}
