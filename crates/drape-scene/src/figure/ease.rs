//! Ease: girths of a garment against those of the body at bust, waist and hip, and at heights that the
//! scene names.
//!
//! The body's girth is that of a tape round its trunk, without the arms; the garment's is the length of its
//! section round the trunk, folds followed, as worn and in the flat pattern. Ease is garment less body. It is
//! negative where the cloth is stretched; ease in the pattern is negative where the cloth has to stretch.

use std::f64::consts::TAU;

use drape_collide::Triangulation;

use crate::figure::cloth_section::{ClothPlaces, ClothSection, Surface};
use crate::figure::landmark::{FoundBy, Landmark, landmarks};
use crate::figure::trunk::Trunk;
use crate::scene::Scene;
use crate::scene::garment::Garment;

/// Number of sectors round the trunk, and how many of them an open section covers that is worn there: a jacket
/// does, a towel over one shoulder does not.
const SECTORS: usize = 36;
const WORN_SECTORS: usize = 20;

/// Way down on which sleeves part from a garment, in m, and its step: an armhole is deeper than the
/// armpit.
const ARMHOLE: f64 = 0.1;
const ARMHOLE_STEP: f64 = 0.005;

/// Garment that can be measured at heights.
#[derive(Debug, Clone)]
pub struct MeasuredGarment {
    /// Name, as in the scene.
    pub name: String,
    surface: Surface,
    /// Heights that the scene names.
    named: Vec<Landmark>,
}

/// Figures that garments may be worn on: the bodies of a scene one by one, and all together.
#[derive(Debug)]
pub struct Figures {
    candidates: Vec<(Vec<Triangulation>, Vec<Landmark>)>,
}

/// Girths of a garment and its body at a height, in m.
#[derive(Debug, Clone, PartialEq)]
pub struct GirthPair {
    /// Where it is.
    pub landmark: Landmark,
    /// Girth of the body.
    pub body: f64,
    /// Girth of the garment, if it is known.
    pub garment: Result<GarmentGirth, NoGirth>,
}

/// Girth of a garment, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GarmentGirth {
    /// Height at which it was measured: lower than the landmark where sleeves part from the garment below.
    pub height: f64,
    /// Length along the cloth.
    pub worn: f64,
    /// Length of the convex hull.
    pub hull: f64,
    /// Length of the same section in the flat pattern.
    pub pattern: f64,
}

/// Reason why a garment that is worn at a height has no girth there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoGirth {
    /// Its section is not closed.
    Open,
    /// It goes round arms too.
    Arms,
    /// Three layers or more meet in it.
    Layers,
}

impl NoGirth {
    /// Returns the reason in words.
    #[must_use]
    pub fn reason(self) -> &'static str {
        match self {
            Self::Open => "open",
            Self::Arms => "round the arms too",
            Self::Layers => "layers are joined in it",
        }
    }
}

impl Figures {
    /// Looks for bust, waist and hip of solid bodies at their places.
    #[must_use]
    pub fn new(bodies: Vec<Triangulation>) -> Self {
        let all = (bodies.len() > 1).then(|| bodies.clone());
        let each = bodies.into_iter().map(|body| vec![body]);
        let candidates = each.chain(all).map(|figure| {
            let landmarks = landmarks(&figure);
            (figure, landmarks)
        });
        Self { candidates: candidates.collect() }
    }

    /// Returns the landmarks of each figure, with its bodies.
    pub(crate) fn candidates(&self) -> &[(Vec<Triangulation>, Vec<Landmark>)] {
        &self.candidates
    }
}

impl MeasuredGarment {
    /// Takes the garments of a scene.
    #[must_use]
    pub fn all(scene: &Scene) -> Vec<Self> {
        let measured = scene.garments.iter().map(|garment| Self {
            name: garment.name.clone(),
            surface: Surface::new(scene, &garment.particles),
            named: named(garment),
        });
        measured.collect()
    }

    /// Measures it on the figure that it is worn on, at the heights at which it is worn, from the top down.
    #[must_use]
    pub fn girths(&self, cloth: ClothPlaces<'_>, figures: &Figures) -> Vec<GirthPair> {
        let on = |(bodies, found): &(Vec<Triangulation>, Vec<Landmark>)| -> Vec<GirthPair> {
            let all = merged(found, &self.named);
            all.iter().filter_map(|landmark| self.at(cloth, bodies, landmark)).collect()
        };
        let mut all = figures.candidates.iter().map(on);
        all.find(|girths| !girths.is_empty()).unwrap_or_default()
    }

    /// Measures it at a landmark; none where it is not worn there.
    fn at(
        &self,
        cloth: ClothPlaces<'_>,
        bodies: &[Triangulation],
        landmark: &Landmark,
    ) -> Option<GirthPair> {
        let trunk = Trunk::at(bodies, landmark.height)?;
        let garment = match self.girth(cloth, &trunk, landmark.height)? {
            Err(NoGirth::Arms) => self.below_arms(cloth, bodies, landmark.height),
            girth => girth,
        };
        Some(GirthPair { landmark: landmark.clone(), body: trunk.girth(), garment })
    }

    /// Measures it where its sleeves part from it, not far below a height.
    fn below_arms(
        &self,
        cloth: ClothPlaces<'_>,
        bodies: &[Triangulation],
        height: f64,
    ) -> Result<GarmentGirth, NoGirth> {
        let steps = (ARMHOLE / ARMHOLE_STEP).round() as usize;
        let mut heights = (1..=steps).map(|k| height - k as f64 * ARMHOLE_STEP);
        let girth =
            heights.find_map(|height| self.girth(cloth, &Trunk::at(bodies, height)?, height)?.ok());
        girth.ok_or(NoGirth::Arms)
    }

    /// Measures it round a trunk at a height; none where it is not worn there.
    fn girth(
        &self,
        cloth: ClothPlaces<'_>,
        trunk: &Trunk,
        height: f64,
    ) -> Option<Result<GarmentGirth, NoGirth>> {
        let sections = self.surface.sections(cloth, height);
        let is_round =
            |section: &&ClothSection| trunk.part_middles().all(|point| section.encloses(point));
        let closed = sections.iter().filter(|section| section.is_closed).filter(is_round);
        // Of a band within a garment, the narrower one is worn tighter.
        let Some(section) = closed.min_by(|a, b| a.pattern.total_cmp(&b.pattern)) else {
            let open = sections.iter().filter(|section| !section.is_closed);
            return covers(open, trunk.middle()).then_some(Err(NoGirth::Open));
        };
        Some(if section.is_branched {
            Err(NoGirth::Layers)
        } else if trunk.arm_middles().any(|arm| section.encloses(arm)) {
            Err(NoGirth::Arms)
        } else {
            let (worn, pattern) = (section.worn, section.pattern);
            Ok(GarmentGirth { height, worn, hull: section.hull(), pattern })
        })
    }
}

/// Returns landmarks with those that a scene names in their places, from the top down.
pub(crate) fn merged(found: &[Landmark], named: &[Landmark]) -> Vec<Landmark> {
    let unnamed =
        found.iter().filter(|landmark| named.iter().all(|other| other.name != landmark.name));
    let mut all: Vec<Landmark> = unnamed.chain(named).cloned().collect();
    all.sort_by(|a, b| b.height.total_cmp(&a.height));
    all
}

/// Returns whether open sections lie round most of a point.
fn covers<'a>(sections: impl Iterator<Item = &'a ClothSection>, [x, z]: [f64; 2]) -> bool {
    let mut is_covered = [false; SECTORS];
    for point in sections.flat_map(|section| &section.pieces).flatten() {
        let angle = (point[1] - z).atan2(point[0] - x).rem_euclid(TAU);
        is_covered[((angle / TAU * SECTORS as f64) as usize).min(SECTORS - 1)] = true;
    }
    is_covered.iter().filter(|covered| **covered).count() >= WORN_SECTORS
}

/// Returns the landmarks that a scene names for a garment.
pub(crate) fn named(garment: &Garment) -> Vec<Landmark> {
    let heights = garment.measured_heights.iter();
    let landmark = |(name, height): (&String, &f64)| Landmark {
        name: name.clone(),
        height: *height,
        found_by: FoundBy::Scene,
    };
    heights.map(landmark).collect()
}
