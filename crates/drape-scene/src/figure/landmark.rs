//! Landmarks of a body: the heights of bust, waist and hip.
//!
//! A figure stands on two legs and has a neck. The bust of a figure is at the level of the bust
//! points, where the chest is deepest. The hip is at the most prominent level of the buttocks
//! \[ISO17\]. The waist is where the trunk is thinnest. The feet point to the front. Each landmark
//! is searched for within a range of fractions of the stature, in which people have it.
//!
//! A dress form has no legs, and may have no head. The waist of a dress form is where its girth is
//! least between two swellings, which are the bust and the hip. The distances between them must be
//! distances that people have. A body that is neither a figure nor a dress form, such as a ball or
//! a pole, has no landmarks.

use std::ops::RangeInclusive;

use drape_collide::Triangulation;

use super::trunk::{Trunk, along};

/// Number of heights at which a body is cut. On an adult the heights are 17 mm apart.
const SLICES: usize = 100;

/// Number of heights that are tried within a step to each side of the best slice.
const FINE: usize = 10;

/// Fractions of the stature between which the crotch is.
const CROTCH: RangeInclusive<f64> = 0.36..=0.56;

/// Fractions of the stature between which the neck is.
const NECK: RangeInclusive<f64> = 0.79..=0.93;

/// Least fraction of the slices below the crotch that cut two legs.
const LEGS_MIN: f64 = 0.75;

/// Largest ratio of the girth of a neck to the girth of the chest.
const NECK_MAX: f64 = 0.7;

/// Fractions of the stature between which the waist is.
const WAIST: RangeInclusive<f64> = 0.57..=0.70;

/// Fractions of the stature between which the bust is.
const BUST: RangeInclusive<f64> = 0.66..=0.79;

/// Fractions of the stature between which the hip is.
const HIP: RangeInclusive<f64> = 0.42..=0.58;

/// Fraction of the stature at which the waist is taken if the shape of the body shows none.
const USUAL_WAIST: f64 = 0.62;

/// Fraction of the stature at which the bust is taken if the shape of the body shows none.
const USUAL_BUST: f64 = 0.72;

/// Fraction of the stature at which the hip is taken if the shape of the body shows none.
const USUAL_HIP: f64 = 0.51;

/// Ratio of the girths of a slice and of the slice below from which arms have begun.
const ARMPIT: f64 = 1.1;

/// Least distance of the hip above the crotch, as a fraction of the stature. Thighs swell near the
/// crotch.
const ABOVE_CROTCH: f64 = 0.02;

/// Distances of the swellings of a dress form from its waist, over the girth of the waist.
const SWELLING_HEIGHTS: RangeInclusive<f64> = 0.12..=0.6;

/// Girths of the swellings of a dress form over the girth of its waist.
const SWELLING_GIRTHS: RangeInclusive<f64> = 1.04..=1.8;

/// Least fraction by which the girth falls beyond a swelling.
const FALL: f64 = 0.02;

/// Ratios of width and depth at the waist of a dress form. A body that was turned on a lathe has 1.
const WAIST_SHAPE: RangeInclusive<f64> = 1.1..=2.2;

/// Evidence by which the height of a landmark was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FoundBy {
    /// The shape of the body.
    Shape,
    /// A usual fraction of the stature, if the shape of the body shows no landmark.
    Stature,
    /// The scene, which names the height.
    Scene,
}

impl FoundBy {
    /// Returns the word for this evidence in results.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Shape => "shape",
            Self::Stature => "stature",
            Self::Scene => "scene",
        }
    }
}

/// Height at which a body is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Landmark {
    /// Name, such as `waist`.
    pub name: String,
    /// Height, in m.
    pub height: f64,
    /// Evidence by which the height was found.
    pub found_by: FoundBy,
}

impl Landmark {
    fn new(name: &str, (height, found_by): (f64, FoundBy)) -> Self {
        Self { name: name.into(), height, found_by }
    }
}

/// Returns bust, waist and hip of `bodies`, which are one figure, from the top down. Landmarks that
/// are not found are missing.
pub(crate) fn landmarks(bodies: &[Triangulation]) -> Vec<Landmark> {
    let Some(profile) = Profile::new(bodies) else { return Vec::new() };
    match profile.crotch().filter(|_| profile.has_neck()) {
        Some(crotch) => profile.of_figure(crotch),
        None => profile.of_dress_form(),
    }
}

/// Sections of bodies from the bottom to the top.
struct Profile<'a> {
    bodies: &'a [Triangulation],
    low: f64,
    stature: f64,
    slices: Vec<Slice>,
}

/// Section of bodies.
struct Slice {
    /// Height over the stature.
    fraction: f64,
    trunk: Trunk,
    girth: f64,
}

impl<'a> Profile<'a> {
    fn new(bodies: &'a [Triangulation]) -> Option<Self> {
        let heights = bodies.iter().flat_map(|body| &body.vertices).map(|vertex| vertex[1]);
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = heights.fold(none, |[low, high], y| [low.min(y), high.max(y)]);
        let stature = high - low;
        if !(stature > 0.0 && stature.is_finite()) {
            return None;
        }
        let slice = |k: usize| {
            let fraction = (k as f64 + 0.5) / SLICES as f64;
            let trunk = Trunk::at(bodies, low + fraction * stature)?;
            Some(Slice { fraction, girth: trunk.girth(), trunk })
        };
        let slices: Vec<Slice> = (0..SLICES).filter_map(slice).collect();
        Some(Self { bodies, low, stature, slices })
    }

    fn height(&self, fraction: f64) -> f64 {
        self.low + fraction * self.stature
    }

    fn within<'s>(
        &'s self,
        range: &RangeInclusive<f64>,
    ) -> impl Iterator<Item = &'s Slice> + use<'s, 'a> {
        let range = range.clone();
        self.slices.iter().filter(move |slice| range.contains(&slice.fraction))
    }

    /// Returns the height of the lowest section that is in one piece, as a fraction of the stature.
    /// Returns `None` if the body has no two legs below.
    fn crotch(&self) -> Option<f64> {
        let above = self.slices.iter().rev().skip_while(|slice| slice.fraction > *CROTCH.end());
        let crotch = above.take_while(|slice| slice.trunk.part_count() == 1).last()?.fraction;
        let legs: Vec<&Slice> = self.within(&(0.08..=crotch - 0.01)).collect();
        let two = legs.iter().filter(|slice| slice.trunk.part_count() == 2).count();
        let is_split = two as f64 >= LEGS_MIN * legs.len() as f64;
        (CROTCH.contains(&crotch) && is_split).then_some(crotch)
    }

    /// Returns whether the body narrows to a neck below a head.
    fn has_neck(&self) -> bool {
        let least = |range: &RangeInclusive<f64>| {
            self.within(range).map(|slice| slice.girth).fold(f64::INFINITY, f64::min)
        };
        let neck = least(&NECK);
        let head = self.within(&(*NECK.start()..=1.0)).skip_while(|slice| slice.girth > neck);
        let head = head.map(|slice| slice.girth).fold(0.0, f64::max);
        neck < NECK_MAX * least(&BUST) && head > neck
    }

    /// Returns the landmarks of a figure whose crotch is at the fraction `crotch` of the stature.
    fn of_figure(&self, crotch: f64) -> Vec<Landmark> {
        // The chest ends where the arms begin.
        let chest: Vec<&Slice> = self.within(&BUST).collect();
        let arms = chest.windows(2).find(|pair| pair[1].girth > ARMPIT * pair[0].girth);
        let chest_end = arms.map_or(*BUST.end(), |pair| pair[0].fraction);
        let chest = *BUST.start()..=chest_end;
        let hips = HIP.start().max(crotch + ABOVE_CROTCH)..=*HIP.end();

        // The bust is where the chest is deepest, because a back that leans moves the chest
        // forwards or backwards. The hip is searched for at the back, which is opposite to the
        // feet. Without feet, the largest girth is taken.
        let across = self.across(crotch);
        let deepest = across.and_then(|across| self.peak(&chest, |trunk| trunk.depth(across)));
        let back = across.and_then(|across| self.back(across));
        let hindmost = back.and_then(|back| self.peak(&hips, |trunk| reach(trunk, back)));
        let bust = deepest.or_else(|| self.peak(&chest, Trunk::girth));
        let waist = self.peak(&WAIST, |trunk| -trunk.girth());
        let hip = hindmost.or_else(|| self.peak(&hips, Trunk::girth));
        let usual_hip = USUAL_HIP.max(crotch + ABOVE_CROTCH);
        vec![
            Landmark::new("bust", self.shaped_or_usual(bust, USUAL_BUST)),
            Landmark::new("waist", self.shaped_or_usual(waist, USUAL_WAIST)),
            Landmark::new("hip", self.shaped_or_usual(hip, usual_hip)),
        ]
    }

    /// Returns the height that the shape of the body shows, in m, or else the height at the `usual`
    /// fraction of the stature.
    fn shaped_or_usual(&self, shaped: Option<f64>, usual: f64) -> (f64, FoundBy) {
        match shaped {
            Some(height) => (height, FoundBy::Shape),
            None => (self.height(usual), FoundBy::Stature),
        }
    }

    /// Returns a direction across the hips, from front to back or from back to front.
    fn across(&self, crotch: f64) -> Option<[f64; 2]> {
        let hips = self.slices.iter().find(|slice| slice.fraction > crotch + 0.03)?;
        let ([x, z], _) = hips.trunk.longest();
        Some([-z, x])
    }

    /// Returns `across` or its opposite, whichever points to the back. Returns `None` if the feet,
    /// which point to the front, do not show it.
    fn back(&self, across: [f64; 2]) -> Option<[f64; 2]> {
        let middle = |range: RangeInclusive<f64>| {
            let middles: Vec<f64> =
                self.within(&range).map(|slice| along(slice.trunk.middle(), across)).collect();
            (!middles.is_empty()).then(|| middles.iter().sum::<f64>() / middles.len() as f64)
        };
        let ahead = middle(0.0..=0.025)? - middle(0.08..=0.2)?;
        (ahead.abs() > 0.01 * self.stature).then(|| across.map(|x| -ahead.signum() * x))
    }

    /// Returns the height within `range` at which `measure` of the section is largest, in m.
    /// Returns `None` if the largest measure is at an end of `range`.
    fn peak(&self, range: &RangeInclusive<f64>, measure: impl Fn(&Trunk) -> f64) -> Option<f64> {
        let slices: Vec<&Slice> = self.within(range).collect();
        let measures: Vec<f64> = slices.iter().map(|slice| measure(&slice.trunk)).collect();
        let most = (0..slices.len()).max_by(|&a, &b| measures[a].total_cmp(&measures[b]))?;
        if most == 0 || most + 1 == slices.len() {
            return None;
        }
        let step = 1.0 / (FINE * SLICES) as f64;
        let middle = slices[most].fraction;
        let (first, last) = (slices[0].fraction, slices[slices.len() - 1].fraction);
        let fractions = (0..=2 * FINE).map(|k| middle + (k as f64 - FINE as f64) * step);
        let heights = fractions.filter(|fraction| (first..=last).contains(fraction));
        let heights = heights.map(|fraction| self.height(fraction));
        let measured =
            heights.filter_map(|height| Some((height, measure(&Trunk::at(self.bodies, height)?))));
        measured.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(height, _)| height)
    }

    /// Returns the landmarks of a dress form. The thinnest place between two swellings is the
    /// waist.
    fn of_dress_form(&self) -> Vec<Landmark> {
        let waists = (1..self.slices.len().saturating_sub(1)).filter_map(|k| self.swellings(k));
        let girth = |candidate: &[usize; 3]| self.slices[candidate[1]].girth;
        let Some([hip, waist, bust]) = waists.min_by(|a, b| girth(a).total_cmp(&girth(b))) else {
            return Vec::new();
        };
        let at = |k: usize| (self.height(self.slices[k].fraction), FoundBy::Shape);
        let fine = |k: usize, sign: f64| {
            let [low, high] = [k - 1, k + 1].map(|k| self.slices[k].fraction);
            let peak = self.peak(&(low..=high), |trunk| sign * trunk.girth());
            peak.map_or_else(|| at(k), |height| (height, FoundBy::Shape))
        };
        vec![
            Landmark::new("bust", fine(bust, 1.0)),
            Landmark::new("waist", fine(waist, -1.0)),
            Landmark::new("hip", fine(hip, 1.0)),
        ]
    }

    /// Returns the slices of hip, waist and bust if the slice `waist` is a waist.
    fn swellings(&self, waist: usize) -> Option<[usize; 3]> {
        let waist_slice = &self.slices[waist];
        let (_, shape) = waist_slice.trunk.longest();
        if !WAIST_SHAPE.contains(&shape) {
            return None;
        }
        let up: Vec<usize> = (waist..self.slices.len()).collect();
        let down: Vec<usize> = (0..=waist).rev().collect();
        let [bust, hip] = [up, down].map(|slices| {
            let top = self.first_swelling(&slices)?;
            let swollen = &self.slices[top];
            let distance =
                (swollen.fraction - waist_slice.fraction).abs() * self.stature / waist_slice.girth;
            let is_right = SWELLING_HEIGHTS.contains(&distance)
                && SWELLING_GIRTHS.contains(&(swollen.girth / waist_slice.girth));
            is_right.then_some(top)
        });
        Some([hip?, waist, bust?])
    }

    /// Returns the first of `slices` after which the girth falls by [`FALL`]. The first of `slices`
    /// has the least girth.
    fn first_swelling(&self, slices: &[usize]) -> Option<usize> {
        let mut top = *slices.first()?;
        for &k in slices {
            let slice = &self.slices[k];
            if slice.trunk.part_count() != 1 || slice.girth < self.slices[slices[0]].girth {
                return None;
            }
            if slice.girth > self.slices[top].girth {
                top = k;
            } else if slice.girth < (1.0 - FALL) * self.slices[top].girth {
                return Some(top);
            }
        }
        None
    }
}

/// Returns how far `trunk` reaches in `direction`, in m.
fn reach(trunk: &Trunk, direction: [f64; 2]) -> f64 {
    trunk.points().map(|point| along(point, direction)).fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::test_bodies::{Ring, column, ellipse_perimeter, person, placed, rings};
    use super::*;

    #[test]
    fn bust_waist_and_hip_of_a_person_are_where_the_rings_are() {
        let exact = [(0.725, [0.1, 0.07]), (0.64, [0.08, 0.055]), (0.52, [0.110, 0.075])];
        for place in [
            (0.0, 1.0, [0.0; 3]),
            (0.0, 1.72, [0.4, 0.0, -0.3]),
            (1.1, 1.6, [0.0, -0.8, 2.0]),
            (3.0, 1.2, [0.0, 5.0, 0.0]),
        ] {
            let body = placed(&person(), place);
            let found = landmarks(&body);
            let names: Vec<&str> = found.iter().map(|landmark| landmark.name.as_str()).collect();
            assert_eq!(names, ["bust", "waist", "hip"], "{place:?}");
            let (_, scale, shift) = place;
            for (landmark, (height, radii)) in found.iter().zip(exact) {
                assert_eq!(landmark.found_by, FoundBy::Shape, "{landmark:?} {place:?}");
                let off = (landmark.height - shift[1]) / scale - height;
                assert!(off.abs() < 0.002, "{landmark:?} is off by {off} {place:?}");
                let girth = Trunk::at(&body, landmark.height).expect("a section").girth() / scale;
                let ring = ellipse_perimeter(radii);
                assert!((girth / ring - 1.0).abs() < 0.01, "{landmark:?}: {girth} for {ring}");
            }
        }
    }

    #[test]
    fn a_dress_form_on_a_pole_has_the_girths_of_its_swellings() {
        let form = rings(&[
            (0.0, [0.0, 0.0], [0.2, 0.2]),
            (0.02, [0.0, 0.0], [0.2, 0.2]),
            (0.021, [0.0, 0.0], [0.02, 0.02]),
            (0.75, [0.0, 0.0], [0.02, 0.02]),
            (0.751, [0.0, 0.0], [0.14, 0.09]),
            (0.86, [0.0, 0.0], [0.18, 0.12]),
            (1.06, [0.0, 0.0], [0.125, 0.09]),
            (1.24, [0.0, 0.0], [0.155, 0.12]),
            (1.4, [0.0, 0.0], [0.14, 0.07]),
            (1.45, [0.0, 0.0], [0.06, 0.05]),
        ]);
        let heights: Vec<f64> = landmarks(&[form]).iter().map(|landmark| landmark.height).collect();
        assert_eq!(heights.len(), 3);
        for (height, exact) in heights.iter().zip([1.24, 1.06, 0.86]) {
            assert!((height - exact).abs() < 0.004, "{heights:?}");
        }
    }

    #[test]
    fn a_trunk_without_a_waist_has_it_at_a_fraction_of_the_stature_and_says_so() {
        let mut parts = person();
        // From the hip the girth grows up to the chest, so that no height is a waist.
        parts[0] = rings(&[
            (0.47, [0.0, 0.0], [0.105, 0.075]),
            (0.58, [0.0, 0.0], [0.108, 0.085]),
            (0.75, [0.0, 0.0], [0.115, 0.095]),
            (0.83, [0.0, 0.0], [0.06, 0.045]),
            (0.85, [0.0, 0.0], [0.032, 0.034]),
            (0.93, [0.0, 0.0], [0.046, 0.058]),
            (1.0, [0.0, 0.0], [0.02, 0.02]),
        ]);
        let found = landmarks(&placed(&parts, (0.0, 1.7, [0.0; 3])));
        let waist = found.iter().find(|landmark| landmark.name == "waist").expect("a waist");
        assert_eq!((waist.found_by, waist.height), (FoundBy::Stature, 1.7 * USUAL_WAIST));
        assert_eq!(found[0].found_by, FoundBy::Shape);
    }

    #[test]
    fn what_is_no_figure_has_no_landmarks() {
        let profile = |radius: fn(f64) -> f64, round: f64| {
            let ring = |k: u32| {
                let t = f64::from(k) / 60.0;
                (1.7 * t, [0.0, 0.0], [radius(t), round * radius(t)])
            };
            vec![rings(&(0..=60).map(ring).collect::<Vec<Ring>>())]
        };
        let ball = profile(|t| 0.001 + 0.85 * (1.0 - (2.0 * t - 1.0).powi(2)).sqrt(), 1.0);
        let pole = profile(|_| 0.1, 1.0);
        let cone = profile(|t| 0.3 - 0.25 * t, 0.7);
        let hourglass = profile(|t| 0.08 + 0.1 * (2.0 * t - 1.0).powi(2), 1.0);
        let egg = profile(|t| 0.001 + 0.3 * (std::f64::consts::PI * t).sin(), 0.6);
        let legs = [-0.2, 0.2].map(|x| column([x, 0.0], [0.03, 0.03], [0.0, 0.8]));
        let stool = [&legs[..], &[column([0.0, 0.0], [0.3, 0.2], [0.8, 0.85])]].concat();
        for (name, body) in [
            ("ball", ball),
            ("pole", pole),
            ("cone", cone),
            ("hourglass", hourglass),
            ("egg", egg),
            ("stool", stool),
            ("nothing", Vec::new()),
        ] {
            assert_eq!(landmarks(&body), [], "{name}");
        }
    }
}
