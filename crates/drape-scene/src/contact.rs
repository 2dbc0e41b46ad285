use drape_collide::{ParticleSettings, PinchPolicy, SurfaceSettings};
use serde::Deserialize;

use crate::file::SceneFile;
use crate::growth::Growth;
use crate::inflation::{InflateFile, Inflation};
use crate::reader::Reader;

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactFile {
    /// Distance at which contact begins.
    pub(crate) offset: Option<f64>,
    /// In N/m³.
    pub(crate) stiffness: Option<f64>,
    /// In m/s.
    pub(crate) slip_speed: Option<f64>,
    /// Whether surfaces are kept apart, and not particles out of bodies only; wherever that can be if missing.
    pub(crate) surfaces: Option<bool>,
    /// How far surfaces that stick give way before they slide.
    pub(crate) stick: Option<f64>,
    /// `error`, `thin` or `release`: what becomes of cloth that bodies close on.
    pub(crate) pinch: Option<String>,
    /// Room for cloth that starts in a body.
    pub(crate) inflate: Option<InflateFile>,
    /// How long the distances that surfaces keep grow, in s, for cloth that starts nearer.
    pub(crate) grow: Option<f64>,
}

/// How cloth and bodies touch.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSettings {
    /// Whether surfaces are kept apart, and not particles out of bodies only.
    pub surfaces: bool,
    /// Contact of particles with bodies, where surfaces are not kept apart.
    pub particles: ParticleSettings,
    /// Stiffness of the contact of surfaces, in N/m³; without one, the fabrics' thickness under pressure gives it.
    pub stiffness: Option<f64>,
    /// How far surfaces that stick give way before they slide, in m.
    pub stick: f64,
    /// What becomes of cloth that bodies close on.
    pub pinch: PinchPolicy,
    /// How bodies grow at the start.
    pub inflation: Option<Inflation>,
    /// How the distances that are kept grow.
    pub growth: Option<Growth>,
}

impl SceneFile {
    /// Whether surfaces are kept apart: if the scene does not say, wherever the solver's ways can be cut. Explicit steps
    /// are never cut, and the particles of Breen's model repel each other at a spacing.
    pub(crate) fn keeps_apart(&self) -> bool {
        let is = |key: &Option<String>, word: &str| key.as_deref() == Some(word);
        let cannot = is(&self.solver.integrator, "explicit") || is(&self.model, "breen-1994");
        self.contact.surfaces.unwrap_or(!cannot)
    }
}

impl Reader<'_> {
    pub(crate) fn contact(
        &mut self,
        file: &SceneFile,
        (unit, spacing): (f64, f64),
        (step, end): (f64, f64),
    ) -> ContactSettings {
        let particles = self.particle_contact(file, unit);
        let stick =
            file.contact.stick.map_or(SurfaceSettings::STICKING_DISPLACEMENT, |stick| stick * unit);
        self.within("contact.stick", stick, (1e-9, 1e-2), "some micrometres are usual");
        let pinch = self.pinch(file);
        let inflation = self.inflation(file, unit, (step, spacing));
        let growth = self.growth(file, (step, end));
        ContactSettings {
            surfaces: file.keeps_apart(),
            particles,
            stiffness: file.contact.stiffness,
            stick,
            pinch,
            inflation,
            growth,
        }
    }

    fn particle_contact(&mut self, file: &SceneFile, unit: f64) -> ParticleSettings {
        let mut settings = ParticleSettings::default();
        if let Some(offset) = file.contact.offset {
            settings.activation_distance = offset * unit;
            let help = "the distance at which contact begins; 1 mm is usual";
            self.within("contact.offset", settings.activation_distance, (1e-5, 0.1), help);
        }
        if let Some(stiffness) = file.contact.stiffness {
            settings.stiffness = stiffness;
            self.within("contact.stiffness", stiffness, (1.0, 1e12), "in N/m³");
        }
        if let Some(speed) = file.contact.slip_speed {
            settings.slip_speed = speed;
            self.within("contact.slip_speed", speed, (1e-9, 1.0), "in m/s; 0.001 is usual");
        }
        settings
    }

    /// What becomes of cloth that bodies close on.
    fn pinch(&mut self, file: &SceneFile) -> PinchPolicy {
        let policies = [
            ("error", PinchPolicy::Error),
            ("thin", PinchPolicy::Thin),
            ("release", PinchPolicy::Release),
        ];
        let word = file.contact.pinch.as_deref();
        if word.is_some() && !file.keeps_apart() {
            let message = "nothing is kept apart here".to_owned();
            self.fail("contact.pinch", message, "it needs contact.surfaces = true");
        }
        self.choice("contact.pinch", word, &policies)
    }
}
