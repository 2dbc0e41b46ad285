//! Ease: girths of a garment and of the body at bust, waist and hip, and at heights that the scene
//! names.
//!
//! The girth of the body is the length of a tape round the trunk, without the arms. The girth of
//! the garment is the length of its section round the trunk, along the folds: as worn, and in the
//! flat pattern. Ease is the girth of the garment minus the girth of the body. Ease as worn is
//! negative where the cloth is stretched. Ease in the pattern is negative where the cloth has to
//! stretch.

use std::f64::consts::TAU;

use drape_collide::Triangulation;

use crate::figure::cloth_section::{ClothPlaces, ClothSection, Surface};
use crate::figure::landmark::{FoundBy, Landmark, landmarks};
use crate::figure::trunk::Trunk;
use crate::scene::Scene;
use crate::scene::garment::Garment;

/// Number of sectors into which directions from the trunk are divided.
const SECTORS: usize = 36;

/// Least number of sectors that an open section covers if the garment is worn there. A jacket
/// covers them, a towel over one shoulder does not.
const WORN_SECTORS: usize = 20;

/// Largest distance below a landmark at which the sleeves part from a garment, in m. An armhole is
/// deeper than the armpit.
const ARMHOLE: f64 = 0.1;

/// Distance between the heights that are tried below a landmark, in m.
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
    /// Height of the measurement, with its name.
    pub landmark: Landmark,
    /// Girth of the body.
    pub body: f64,
    /// Girth of the garment, if it is known.
    pub garment: Result<GarmentGirth, NoGirth>,
}

/// Girth of a garment, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GarmentGirth {
    /// Height of the section, in m. It is below the landmark if the sleeves part from the garment
    /// only there.
    pub height: f64,
    /// Length along the cloth, in m.
    pub worn: f64,
    /// Length of the convex hull, in m.
    pub hull: f64,
    /// Length of the section in the flat pattern, in m.
    pub pattern: f64,
}

/// Reason why a garment that is worn at a height has no girth there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoGirth {
    /// The section of the garment is not closed.
    Open,
    /// The section goes round arms too.
    Arms,
    /// Three layers or more meet in the section.
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
    /// Finds bust, waist and hip of each of `bodies`, which are solid, and of all together.
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

    /// Returns each figure: its bodies and its landmarks.
    pub(crate) fn candidates(&self) -> &[(Vec<Triangulation>, Vec<Landmark>)] {
        &self.candidates
    }
}

impl MeasuredGarment {
    /// Returns the garments of `scene`.
    #[must_use]
    pub fn all(scene: &Scene) -> Vec<Self> {
        let measured = scene.garments.iter().map(|garment| Self {
            name: garment.name.clone(),
            surface: Surface::new(scene, &garment.particles),
            named: named(garment),
        });
        measured.collect()
    }

    /// Measures the garment, as `cloth` is, on the first of `figures` that wears it. Returns a pair
    /// for each height at which the garment is worn, from the top down.
    #[must_use]
    pub fn girths(&self, cloth: ClothPlaces<'_>, figures: &Figures) -> Vec<GirthPair> {
        for (bodies, landmarks) in &figures.candidates {
            let landmarks = merged(landmarks, &self.named);
            let girths = landmarks.iter().filter_map(|landmark| self.at(cloth, bodies, landmark));
            let girths: Vec<GirthPair> = girths.collect();
            if !girths.is_empty() {
                return girths;
            }
        }
        Vec::new()
    }

    /// Measures the garment round `bodies` at `landmark`. Returns `None` if it is not worn there.
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

    /// Measures the garment where its sleeves part from it, at most [`ARMHOLE`] below `height`.
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

    /// Measures the garment round `trunk` at `height`, in m. Returns `None` if it is not worn
    /// there.
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

/// Returns the landmarks `detected` on a body and the landmarks `named` in a scene, from the top
/// down. A named landmark replaces a detected one with the same name.
pub(crate) fn merged(detected: &[Landmark], named: &[Landmark]) -> Vec<Landmark> {
    let unnamed =
        detected.iter().filter(|landmark| named.iter().all(|other| other.name != landmark.name));
    let mut all: Vec<Landmark> = unnamed.chain(named).cloned().collect();
    all.sort_by(|a, b| b.height.total_cmp(&a.height));
    all
}

/// Returns whether open `sections` lie in most directions from the point (`x`, `z`).
fn covers<'a>(sections: impl Iterator<Item = &'a ClothSection>, [x, z]: [f64; 2]) -> bool {
    let mut is_covered = [false; SECTORS];
    for point in sections.flat_map(|section| &section.pieces).flatten() {
        let angle = (point[1] - z).atan2(point[0] - x).rem_euclid(TAU);
        is_covered[((angle / TAU * SECTORS as f64) as usize).min(SECTORS - 1)] = true;
    }
    is_covered.iter().filter(|covered| **covered).count() >= WORN_SECTORS
}

/// Returns the landmarks that the scene names for `garment`.
pub(crate) fn named(garment: &Garment) -> Vec<Landmark> {
    garment
        .measured_heights
        .iter()
        .map(|(name, &height)| Landmark { name: name.clone(), height, found_by: FoundBy::Scene })
        .collect()
}
