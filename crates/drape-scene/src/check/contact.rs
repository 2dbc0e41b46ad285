//! Settings of the contact of cloth and bodies.

pub(crate) mod speed;

use drape_collide::ParticleSettings;
use drape_input::figure;

use crate::check::checker::Checker;
use crate::scene::contact::{ContactSettings, DistanceGrowth, Inflation};
use crate::spec::contact::{InflateSpec, Pinch};

/// Number of layers of the heaviest fabric that contact carries at least.
const LAYERS: f64 = 10.0;

/// Fraction of the distance of surfaces that is left under this load.
const NEAR: f64 = 0.01;

/// Remedy where settings of surfaces have nothing to act on.
const SURFACES: &str = "it needs contact.surfaces = true";

/// Times and lengths of a scene that bound the settings of contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ContactBounds {
    /// Smallest distance of particles, in m.
    pub(crate) spacing: f64,
    /// Length of a step, in s.
    pub(crate) step: f64,
    /// Time of the end, in s.
    pub(crate) end: f64,
    /// Largest weight of a fabric per area, in Pa.
    pub(crate) weight: f64,
    /// Thickness of the thinnest fabric, in m.
    pub(crate) thickness: f64,
}

/// Checks the settings of contact.
pub(crate) fn contact(checker: &mut Checker<'_>, bounds: ContactBounds) -> ContactSettings {
    let spec = &checker.spec.contact;
    let particles = ParticleSettings {
        activation_distance: spec.offset,
        stiffness: spec.stiffness.unwrap_or(ParticleSettings::default().stiffness),
        slip_speed: spec.slip_speed,
    };
    check_stiffness(checker, &particles, bounds);
    if spec.pinch != Pinch::Error {
        check_surfaces(checker, "contact.pinch");
    }
    ContactSettings {
        surfaces: checker.spec.keeps_surfaces_apart(),
        particles,
        stiffness: spec.stiffness,
        top_speed: spec.top_speed,
        sticking_displacement: spec.stick,
        pinch: spec.pinch.into(),
        inflation: inflation(checker, bounds),
        growth: growth(checker, bounds),
    }
}

/// Checks that contact carries the cloth, some layers of it, at a distance that is left.
fn check_stiffness(checker: &mut Checker<'_>, settings: &ParticleSettings, bounds: ContactBounds) {
    let Some(stiffness) = checker.spec.contact.stiffness else { return };
    let ContactBounds { weight, thickness, .. } = bounds;
    // The pressure of a stiffness of one: of particles that touch their body, of surfaces that have
    // a hundredth of their distance left.
    let unit = if checker.spec.keeps_surfaces_apart() {
        0.25 * thickness / NEAR
    } else {
        ParticleSettings { stiffness: 1.0, ..*settings }.pressure(0.0)
    };
    let least = LAYERS * weight / unit;
    if checker.is_sound("contact.stiffness") && least.is_finite() && stiffness < least {
        let message = format!(
            "{} N/m³ does not carry the cloth, which weighs {weight:.2} Pa",
            figure(stiffness)
        );
        let enough = format!("{:.0e}", 1.6 * least);
        let help = format!("write {enough} or more, or leave it out");
        let mistake = checker.fail("contact.stiffness", message, &help);
        checker.remedy(mistake, "contact.stiffness", Some(&enough));
    }
}

/// Checks the growth of bodies at the start, if there is one.
fn inflation(checker: &mut Checker<'_>, bounds: ContactBounds) -> Option<Inflation> {
    let inflate = checker.spec.contact.inflate.as_ref()?;
    check_surfaces(checker, "contact.inflate");
    let &InflateSpec { depth, seconds } = inflate;
    let help = "in s; cloth follows a body by a spacing in a step at most";
    let least = (depth * bounds.step / bounds.spacing).max(bounds.step);
    checker.within("contact.inflate.seconds", seconds, least..=1e3, help);
    Some(Inflation { depth, seconds })
}

/// Checks the growth of the distances that surfaces keep, if there is one.
fn growth(checker: &mut Checker<'_>, bounds: ContactBounds) -> Option<DistanceGrowth> {
    let seconds = checker.spec.contact.grow?;
    check_surfaces(checker, "contact.grow");
    let help = "in s, from a step to the whole run; 0.2 is usual";
    checker.within("contact.grow", seconds, bounds.step..=bounds.end, help);
    Some(DistanceGrowth { seconds })
}

/// Checks that surfaces are kept apart, as a key asks for.
pub(super) fn check_surfaces(checker: &mut Checker<'_>, key: &str) {
    if !checker.spec.keeps_surfaces_apart() {
        checker.fail(key, "nothing is kept apart here", SURFACES);
    }
}
