//! Stiffness of contact: the stiffness of the fabric in compression, or the stiffness that stops
//! the fastest impact.

use drape_collide::{Body, ContactDistances, Shape, SurfaceSettings};
use drape_fabric::Fabric;
use drape_input::figure;

use crate::scene::motion::BodyMotion;
use crate::scene::{MovingBody, Scene};

/// Minimum separation of surfaces as a fraction of the fabric's thickness under pressure.
const CRUSHED: f64 = 0.5;

/// Largest thickness under pressure, as a fraction of the thickness, that contact takes into
/// account: a fabric that is not compressed at all would have infinitely stiff contact.
const PRESSED: f64 = 0.95;

/// Least gap over its range at the pressure of the compression test: a linearity of 0.15.
///
/// The stiffness there is `$1/4x^2$` times the stiffness at first touch. A smaller gap would cost
/// the solver more than the last few percent of the measured work are worth.
const LEAST_GAP: f64 = 0.02;

/// Least minimum separation over the thickness under pressure.
const LEAST_SEPARATION: f64 = 0.05;

/// Largest stiffness of contact, in N/m³.
pub(crate) const STIFFNESS_MAX: f64 = 1e12;

/// Ratio of the speed at which cloth hits cloth or a body to the largest prescribed speed. Tension
/// waves make parts of the cloth faster than the edge that is pulled. With a ratio of 1 an edge at
/// 10 m/s was not stopped, with 3 all impacts were.
const SPEED_RATIO: f64 = 4.0;

impl Scene {
    /// Returns the stiffness of the contact of surfaces, in N/m³: the stiffness that the scene
    /// names, or the larger of two others. One follows from the fabrics in compression, the other
    /// stops the fastest impact, which includes the top speed of [`ContactSettings::top_speed`].
    ///
    /// [`ContactSettings::top_speed`]: crate::ContactSettings::top_speed
    #[must_use]
    pub fn contact_stiffness(&self) -> f64 {
        self.contact.stiffness.unwrap_or_else(|| {
            let speed = self.prescribed_speed();
            let impact = self.largest(|fabric| stiffness_of_impact(fabric, speed));
            impact.max(self.largest(stiffness_of_compression))
        })
    }

    /// Note on a contact that is stiffer than the fabrics are.
    pub(crate) fn stiffness_note(&self) -> Option<String> {
        if !self.contact.surfaces || self.contact.stiffness.is_some() {
            return None;
        }
        let speed = self.prescribed_speed();
        let impact = self.largest(|fabric| stiffness_of_impact(fabric, speed));
        let compression = self.largest(stiffness_of_compression);
        (impact > compression).then(|| {
            format!(
                "contact is {} times as stiff as the fabric's compression, to stop what moves at {} m/s",
                figure(impact / compression),
                figure(speed)
            )
        })
    }

    /// Largest speed of what moves by prescription, in m/s, that the contact of this scene stops.
    #[must_use]
    pub fn stopped_speed(&self) -> f64 {
        let stiffness = self.contact_stiffness();
        let fabrics = self.panels.iter().map(|panel| &self.materials[panel.material].fabric);
        fabrics.map(|fabric| stopped_speed(fabric, stiffness)).fold(f64::INFINITY, f64::min)
    }

    /// Returns the largest speed of bodies and pins, in m/s, that the stiffest contact stops: the
    /// largest [`ContactSettings::top_speed`](crate::ContactSettings::top_speed).
    #[must_use]
    pub fn top_speed_max(&self) -> f64 {
        let fabrics = self.panels.iter().map(|panel| &self.materials[panel.material].fabric);
        fabrics.map(max_impact_speed).fold(f64::INFINITY, f64::min)
    }

    /// Largest value of a fabric's quantity over the panels.
    fn largest(&self, of: impl Fn(&Fabric) -> f64) -> f64 {
        let fabrics = self.panels.iter().map(|panel| &self.materials[panel.material].fabric);
        fabrics.map(of).fold(0.0, f64::max)
    }

    /// Largest speed of a body or a pin that moves by prescription, in m/s: in the motions of the
    /// scene, or the declared top speed.
    fn prescribed_speed(&self) -> f64 {
        let bodies = self
            .bodies
            .iter()
            .filter_map(|MovingBody { body, motion, .. }| Some(body_speed(body, motion.as_ref()?)));
        let pins =
            self.pins.iter().filter_map(|pin| Some(pin.motion.as_ref()?.max_speed(&pin.start)));
        bodies.chain(pins).chain(self.contact.top_speed).fold(0.0, f64::max)
    }
}

/// Returns the largest speed of the surface of `body` in `motion`, in m/s. The corners of a floor
/// are far out, so the speed of its middle is taken.
pub(crate) fn body_speed(body: &Body, motion: &BodyMotion) -> f64 {
    match body.shape {
        Shape::Plane => motion.max_speed(&[body.pose.position]),
        _ => body.triangulate().map_or(0.0, |outline| motion.max_speed(&outline.vertices)),
    }
}

/// Stiffness of contact that stops a layer of a fabric within half of the range of contact, in
/// N/m³, where something moves at a speed, in m/s: the barrier takes the energy of
/// [`SPEED_RATIO`] `$= a$` times the speed,
///
/// ```math
/// 2 k\, b(\hat g/2) = \tfrac14 k \hat g^2 = \tfrac12 \rho\, (a v)^2,
/// ```
///
/// with the mass `$\rho$` of the fabric per area.
fn stiffness_of_impact(fabric: &Fabric, speed: f64) -> f64 {
    let range = fabric.thickness - min_separation(fabric);
    let stiffness = 2.0 * fabric.density * (SPEED_RATIO * speed / range).powi(2);
    stiffness.min(STIFFNESS_MAX)
}

/// Largest speed of what moves by prescription, in m/s, at which contact keeps a fabric apart.
pub(crate) fn max_impact_speed(fabric: &Fabric) -> f64 {
    stopped_speed(fabric, STIFFNESS_MAX)
}

/// Speed whose impact a contact of some stiffness, in N/m³, stops, in m/s: the inverse of
/// [`stiffness_of_impact`].
fn stopped_speed(fabric: &Fabric, stiffness: f64) -> f64 {
    let range = fabric.thickness - min_separation(fabric);
    range / SPEED_RATIO * (stiffness / (2.0 * fabric.density)).sqrt()
}

/// Minimum separation of two layers of a fabric, in m.
///
/// The barrier of the range `$r = T_0 - s$` gives way by `$T_0 - T_m$` under the pressure of the
/// compression test, where its gap is `$x r$`. The ratio of the work up to this gap to the work of
/// a straight line is
///
/// ```math
/// LC = \frac{2x\,(\tfrac12 - \ln 2x)}{1 - x} \quad (x < \tfrac12), \qquad 1 \quad (x \ge
/// \tfrac12), \qquad s = \frac{T_m - x T_0}{1 - x}
/// ```
///
/// which the measured LC solves for `$x$`. Where LC was not measured, `$s$` is [`CRUSHED`] of
/// `$T_m$`.
pub(crate) fn min_separation(fabric: &Fabric) -> f64 {
    let pressed = fabric.thickness_under_pressure();
    let Some(linearity) = fabric.compression_linearity else { return CRUSHED * pressed };
    let pressed = pressed.min(PRESSED * fabric.thickness);
    let gap = gap_of_linearity(linearity);
    let separation = (pressed - gap * fabric.thickness) / (1.0 - gap);
    // A fabric that gives way by more than half of itself in a straight line has none left over.
    separation.max(LEAST_SEPARATION * pressed)
}

/// Returns the gap over its range at which a barrier has a linearity, by halves.
fn gap_of_linearity(linearity: f64) -> f64 {
    let of = |x: f64| 2.0 * x * (0.5 - (2.0 * x).ln()) / (1.0 - x);
    let (mut low, mut high) = (LEAST_GAP, 0.5);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if of(middle) < linearity { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Stiffness of contact that presses two layers of a fabric as its compression test does, in N/m³.
fn stiffness_of_compression(fabric: &Fabric) -> f64 {
    let pressed = fabric.thickness_under_pressure();
    let distance = pressed.min(PRESSED * fabric.thickness);
    let of_pair = ContactDistances {
        activation_distance: fabric.thickness,
        min_separation: min_separation(fabric),
    };
    SurfaceSettings::stiffness_for_pressure(Fabric::PRESSURE, distance, of_pair)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_input::Document;

    const WEAVE: &str = r#"
        name = "weave"
        density = 0.12
        thickness = 0.0008
        shear = { stiffness = 35.0 }
        [warp]
        traction.polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
        bending.rigidity = 1.2e-5
        [weft]
        traction.polynomial = { quadratic = 6.0e4, quartic = 1.0e7 }
        bending.rigidity = 0.8e-5
    "#;

    fn fabric(keys: &str) -> Fabric {
        let text = WEAVE.replacen("thickness = 0.0008", &format!("thickness = 0.0008\n{keys}"), 1);
        Fabric::from_document(&Document::new("weave.toml", text)).expect("a good fabric")
    }

    /// Pressure of two layers at a distance, in Pa.
    fn pressure(fabric: &Fabric, distance: f64) -> f64 {
        let of_pair = ContactDistances {
            activation_distance: fabric.thickness,
            min_separation: min_separation(fabric),
        };
        stiffness_of_compression(fabric)
            / SurfaceSettings::stiffness_for_pressure(1.0, distance, of_pair)
    }

    #[test]
    fn an_impact_is_stopped_within_half_of_the_range() {
        let fabric = fabric("pressed_thickness = 0.0006\ncompression_linearity = 0.3");
        let (top, bottom) = (fabric.thickness, min_separation(&fabric));
        let of_pair = ContactDistances { activation_distance: top, min_separation: bottom };
        let speed = 7.0;
        let stiffness = stiffness_of_impact(&fabric, speed);
        let pressure = |distance: f64| {
            stiffness / SurfaceSettings::stiffness_for_pressure(1.0, distance, of_pair)
        };
        let (count, half) = (200_000, 0.5 * (top - bottom));
        let width = half / f64::from(count);
        let work: f64 = (0..count)
            .map(|step| width * pressure(bottom + half + width * (f64::from(step) + 0.5)))
            .sum();
        let kinetic = 0.5 * fabric.density * (SPEED_RATIO * speed).powi(2);
        assert!((work / kinetic - 1.0).abs() < 1e-6, "{work} J/m² of {kinetic} J/m²");
        let most = max_impact_speed(&fabric);
        assert!((stiffness_of_impact(&fabric, most) / STIFFNESS_MAX - 1.0).abs() < 1e-12);
    }

    #[test]
    fn two_layers_are_pressed_as_the_compression_test_presses_one() {
        for linearity in [0.2, 0.25, 0.35, 0.5, 0.9] {
            let keys = format!("pressed_thickness = 0.0006\ncompression_linearity = {linearity}");
            let fabric = fabric(&keys);
            let (from, to) = (fabric.thickness, fabric.thickness_under_pressure());
            let at_end = pressure(&fabric, to);
            assert!((at_end / Fabric::PRESSURE - 1.0).abs() < 1e-9, "{at_end} Pa");
            let steps = 200_000;
            let width = (from - to) / f64::from(steps);
            let middle = |step: i32| pressure(&fabric, to + width * (f64::from(step) + 0.5));
            let work: f64 = (0..steps).map(|step| width * middle(step)).sum();
            let found = work / (0.5 * Fabric::PRESSURE * (from - to));
            assert!((found / linearity - 1.0).abs() < 1e-3, "LC is {found}, not {linearity}");
        }
    }

    #[test]
    fn a_fabric_without_linearity_is_crushed_to_half_of_its_pressed_thickness() {
        for keys in ["", "pressed_thickness = 0.0006"] {
            let fabric = fabric(keys);
            assert_eq!(min_separation(&fabric), 0.5 * fabric.thickness_under_pressure());
        }
    }
}
