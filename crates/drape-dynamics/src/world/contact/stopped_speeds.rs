//! Speeds of bodies and pins that contact can stop, and the settings that let contact stop more.

use drape_input::figure_above;
use drape_scene::Scene;

use crate::error::Error;

/// Speeds of bodies and pins that the contact of surfaces can stop.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StoppedSpeeds {
    /// Largest speed that contact stops, in m/s.
    pub(crate) largest: f64,
    /// Largest speed that the stiffest contact would stop, in m/s.
    limit: f64,
    /// Stiffness of the contact, in N/m³.
    stiffness: f64,
    /// Whether the scene names the stiffness.
    is_stiffness_named: bool,
}

impl StoppedSpeeds {
    /// Returns the speeds that the contact of `scene` can stop.
    pub(crate) fn new(scene: &Scene) -> Self {
        Self {
            largest: scene.stopped_speed(),
            limit: scene.top_speed_max(),
            stiffness: scene.contact_stiffness(),
            is_stiffness_named: scene.contact.stiffness.is_some(),
        }
    }

    /// Checks that contact can stop bodies and pins at the top speed that a program declares for
    /// `scene`.
    ///
    /// # Errors
    ///
    /// Returns [`Error::Unsuited`] if it cannot.
    pub(crate) fn check_top_speed(scene: &Scene) -> Result<(), Error> {
        let Some(speed) = scene.contact.top_speed else { return Ok(()) };
        let limit = match scene.contact.stiffness {
            Some(_) => scene.stopped_speed(),
            None => scene.top_speed_max(),
        };
        if speed >= 0.0 && speed <= limit {
            return Ok(());
        }
        let reason = format!(
            "contact.top_speed is {speed} m/s; contact keeps these fabrics apart from 0 to {limit:.3} \
             m/s"
        );
        Err(Error::Unsuited { reason })
    }

    /// Returns the key of a scene, with its value, whose contact can stop `speed`, in m/s. Returns
    /// `None` if no contact can.
    pub(crate) fn remedy(&self, speed: f64) -> Option<String> {
        let top_speed = figure_above(speed);
        if !top_speed.parse::<f64>().is_ok_and(|top_speed| top_speed <= self.limit) {
            return None;
        }
        Some(if self.is_stiffness_named {
            let stiffness = self.stiffness * (speed / self.largest).powi(2);
            format!("contact.stiffness = {}", figure_above(stiffness))
        } else {
            format!("contact.top_speed = {top_speed}")
        })
    }
}
