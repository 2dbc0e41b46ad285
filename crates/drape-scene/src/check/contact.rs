//! Settings of the contact of cloth and bodies.

pub(crate) mod speed;

use drape_collide::{ParticleSettings, PinchPolicy, SurfaceSettings};
use drape_input::{Given, figure};

use crate::check::checker::Checker;
use crate::contact_stiffness::STIFFNESS_MAX;
use crate::scene::contact::{ContactSettings, DistanceGrowth, Inflation};

/// Time over which bodies grow when the scene does not say, in s.
const INFLATION_SECONDS: f64 = 0.5;

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
    let (file, unit) = (&checker.file.contact, checker.unit);
    let particles = particles(checker);
    check_stiffness(checker, &particles, bounds);
    let stick = SurfaceSettings::STICKING_DISPLACEMENT;
    let sticking_displacement = file.stick.map_or(stick, |stick| stick * unit);
    let help = "some micrometres are usual";
    checker.within("contact.stick", sticking_displacement, 1e-9..=1e-2, help);
    ContactSettings {
        surfaces: checker.file.keeps_surfaces_apart(),
        particles,
        stiffness: file.stiffness.map(Given::value),
        sticking_displacement,
        pinch: pinch(checker),
        inflation: inflation(checker, bounds),
        growth: growth(checker, bounds),
    }
}

/// Checks the settings of the contact of particles.
fn particles(checker: &mut Checker<'_>) -> ParticleSettings {
    let (file, unit) = (&checker.file.contact, checker.unit);
    let mut settings = ParticleSettings::default();
    if let Some(offset) = file.offset {
        settings.activation_distance = offset * unit;
        let help = "the distance at which contact begins; 1 mm is usual";
        checker.within("contact.offset", settings.activation_distance, 1e-5..=0.1, help);
    }
    if let Some(stiffness) = file.stiffness.map(Given::value) {
        settings.stiffness = stiffness;
        checker.within("contact.stiffness", stiffness, 1.0..=STIFFNESS_MAX, "in N/m³");
    }
    if let Some(speed) = file.slip_speed.map(Given::value) {
        settings.slip_speed = speed;
        checker.within("contact.slip_speed", speed, 1e-9..=1.0, "in m/s; 0.001 is usual");
    }
    settings
}

/// Checks that contact carries the cloth, some layers of it, at a distance that is left.
fn check_stiffness(checker: &mut Checker<'_>, settings: &ParticleSettings, bounds: ContactBounds) {
    let Some(stiffness) = checker.file.contact.stiffness.map(Given::value) else { return };
    let ContactBounds { weight, thickness, .. } = bounds;
    // The pressure of a stiffness of one: of particles that touch their body, of surfaces that have
    // a hundredth of their distance left.
    let unit = if checker.file.keeps_surfaces_apart() {
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

/// Checks the treatment of cloth that bodies close on.
fn pinch(checker: &mut Checker<'_>) -> PinchPolicy {
    let policies = [
        ("error", PinchPolicy::Error),
        ("thin", PinchPolicy::Thin),
        ("release", PinchPolicy::Release),
    ];
    let word = checker.file.contact.pinch.as_deref();
    if word.is_some() {
        check_surfaces(checker, "contact.pinch");
    }
    checker.choice("contact.pinch", word, &policies)
}

/// Checks the growth of bodies at the start, if there is one.
fn inflation(checker: &mut Checker<'_>, bounds: ContactBounds) -> Option<Inflation> {
    let inflate = checker.file.contact.inflate.as_ref()?;
    check_surfaces(checker, "contact.inflate");
    let depth = inflate.depth * checker.unit;
    let seconds = inflate.seconds.map_or(INFLATION_SECONDS, Given::value);
    let help = "how far inside of where it belongs the surface of a body starts; 10 mm is usual";
    checker.within("contact.inflate.depth", depth, 1e-6..=0.1, help);
    let help = "in s; cloth follows a body by a spacing in a step at most";
    let least = (depth * bounds.step / bounds.spacing).max(bounds.step);
    checker.within("contact.inflate.seconds", seconds, least..=1e3, help);
    Some(Inflation { depth, seconds })
}

/// Checks the growth of the distances that surfaces keep, if there is one.
fn growth(checker: &mut Checker<'_>, bounds: ContactBounds) -> Option<DistanceGrowth> {
    let seconds = checker.file.contact.grow?.value();
    check_surfaces(checker, "contact.grow");
    let help = "in s, from a step to the whole run; 0.2 is usual";
    checker.within("contact.grow", seconds, bounds.step..=bounds.end, help);
    Some(DistanceGrowth { seconds })
}

/// Checks that surfaces are kept apart, as a key asks for.
fn check_surfaces(checker: &mut Checker<'_>, key: &str) {
    if !checker.file.keeps_surfaces_apart() {
        checker.fail(key, "nothing is kept apart here", SURFACES);
    }
}
