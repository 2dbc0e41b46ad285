//! Surfaces of a scene at its start, for checks and for the simulation.
//!
//! Every panel and every body is a group of the surface, with contact distances of its own: of a
//! panel half of its fabric's thickness, as half of the distance between two layers.

use std::ops::Range;

use drape_collide::{
    ContactDistances, Error, Surface, SurfaceContact, SurfaceParts, SurfaceSettings,
};
use drape_fabric::Fabric;

use crate::scene::Scene;
use crate::scene::motion::BodyMotion;
use crate::scene::panel::Panel;
use crate::scene::seam::SeamPairs;

/// Minimum separation of surfaces as a fraction of the fabric's thickness under pressure.
const CRUSHED: f64 = 0.5;

/// Largest thickness under pressure, as a fraction of the thickness, that contact takes into
/// account: a fabric that is not compressed at all would have infinitely stiff contact.
const PRESSED: f64 = 0.95;

/// Least gap over its range at the pressure of the compression test: a linearity of 0.15.
///
/// The stiffness there is `$1/4x^2$` times that at first touch: less would cost the solver more than
/// the last few percent of the measured work are worth.
const LEAST_GAP: f64 = 0.02;

/// Least minimum separation over the thickness under pressure.
const LEAST_SEPARATION: f64 = 0.05;

/// Surfaces of a scene's panels and bodies at its start.
#[derive(Debug)]
pub struct StartSurfaces {
    /// Contact of the surfaces, with bodies as small as they start and seams open.
    pub contact: SurfaceContact,
    /// Names of the panels and, behind them, of the bodies: of the groups of the surface.
    pub names: Vec<String>,
    /// Vertices of each body among those of all bodies.
    pub vertices: Vec<Range<usize>>,
    /// Positions at which the vertices of the bodies belong, in m.
    pub bodies: Vec<f64>,
    /// Displacements from there to where the vertices start, in m: inward where bodies grow.
    pub inward: Vec<f64>,
    /// Half of the smallest minimum separation, in m.
    pub min_separation: f64,
}

/// Coefficient of friction of a group of the surface.
#[derive(Debug, Clone, Copy)]
enum Friction {
    /// Of a fabric with itself.
    Fabric(f64),
    /// Of a body with cloth.
    Body(f64),
}

impl Friction {
    /// Coefficient of a pair of groups: of two fabrics the geometric mean, with a body that of the
    /// body.
    fn pair(self, other: Self) -> f64 {
        match (self, other) {
            (Self::Fabric(a), Self::Fabric(b)) => (a * b).sqrt(),
            (Self::Body(body), _) | (_, Self::Body(body)) => body,
        }
    }
}

impl StartSurfaces {
    /// Makes the surfaces of a scene.
    ///
    /// # Errors
    /// Settings or bodies that make no contact.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        let Scene { panels, materials, cloth, bodies, contact, .. } = scene;
        let fabric = |panel: &Panel| &materials[panel.material].fabric;
        let distances = |fabric: &Fabric| ContactDistances {
            activation_distance: 0.5 * fabric.thickness,
            min_separation: 0.5 * min_separation(fabric),
        };
        let all = panels.iter().map(|panel| distances(fabric(panel)));
        let thinnest = all.min_by(|a, b| a.activation_distance.total_cmp(&b.activation_distance));
        let thinnest =
            thinnest.unwrap_or(ContactDistances { activation_distance: 0.0, min_separation: 0.0 });
        let sewn = scene.sewing.as_ref().map(|sewing| &sewing.pairs);
        let mut surface = SurfaceParts {
            rest_positions: cloth.coordinates().iter().flat_map(|[u, v]| [*u, *v, 0.0]).collect(),
            triangles: cloth.triangles().to_vec(),
            areas: cloth.areas().to_vec(),
            groups: Vec::new(),
            distances: Vec::new(),
            free_vertices: cloth.particles(),
            seam_pairs: sewn.map_or_else(Vec::new, |sewn| sewn.pairs.clone()),
            ties: sewn.map_or_else(Vec::new, SeamPairs::tied_triples),
        };
        let mut frictions = Vec::new();
        for (index, panel) in panels.iter().enumerate() {
            surface
                .groups
                .extend(std::iter::repeat_n(index as u32, panel.lattice.coordinates.len()));
            surface.distances.push(distances(fabric(panel)));
            frictions.push(Friction::Fabric(fabric(panel).surface_friction));
        }
        let (mut start, mut inward) = (Vec::new(), Vec::new());
        let mut vertices = Vec::new();
        for moving in bodies {
            let outline = moving.body.triangulate()?;
            let first = surface.groups.len();
            let count = outline.vertices.len();
            vertices.push(start.len() / 3..start.len() / 3 + count);
            start.extend(outline.vertices.iter().flatten());
            // A body that changes its shape has its size from its frames.
            let grows = !matches!(moving.motion, Some(BodyMotion::Shapes(_)));
            let depth = contact
                .inflation
                .map_or(0.0, |inflation| if grows { inflation.depth } else { 0.0 });
            inward.extend(outline.normals().iter().flatten().map(|n| -depth * n));
            let corners = |t: &[u32; 3]| t.map(|corner| corner + first as u32);
            surface.triangles.extend(outline.triangles.iter().map(corners));
            surface.areas.extend(std::iter::repeat_n(0.0, count));
            surface.groups.extend(std::iter::repeat_n(surface.distances.len() as u32, count));
            // Half of the cloth's thickness is its own.
            let half = thinnest.activation_distance;
            let activation_distance = (contact.particles.activation_distance - half).max(half);
            surface.distances.push(ContactDistances { activation_distance, ..thinnest });
            frictions.push(Friction::Body(moving.body.friction));
        }
        surface.rest_positions.extend(&start);
        let friction = frictions.iter().flat_map(|a| frictions.iter().map(|b| a.pair(*b)));
        let settings = SurfaceSettings {
            stiffness: contact.stiffness.unwrap_or_else(|| {
                panels.iter().map(|panel| stiffness(fabric(panel))).fold(0.0, f64::max)
            }),
            sticking_displacement: contact.sticking_displacement,
            friction_coefficients: friction.collect(),
            pinch: contact.pinch,
        };
        let at_start: Vec<f64> = match contact.inflation {
            Some(_) => start.iter().zip(&inward).map(|(place, inward)| place + inward).collect(),
            None => start.clone(),
        };
        let mut contact = SurfaceContact::new(Surface::new(surface)?, settings, at_start)?;
        if let Some(seams) = sewn {
            let positions = &scene.start.positions;
            contact.open_seams(&seams.gaps_at_particles(positions), positions)?;
        }
        let names = panels.iter().map(|panel| &panel.name);
        let names = names.chain(bodies.iter().map(|moving| &moving.body.name)).cloned().collect();
        let min_separation = thinnest.min_separation;
        Ok(Self { contact, names, vertices, bodies: start, inward, min_separation })
    }
}

/// Minimum separation of two layers of a fabric, in m.
///
/// The barrier of the range `$r = T_0 - s$` gives way by `$T_0 - T_m$` under the pressure of the
/// compression test, where its gap is `$x r$`. Its work up to there, over that of a straight line, is
///
/// ```math
/// LC = \frac{2x\,(\tfrac12 - \ln 2x)}{1 - x} \quad (x < \tfrac12), \qquad 1 \quad (x \ge \tfrac12),
/// \qquad s = \frac{T_m - x T_0}{1 - x}
/// ```
///
/// which the measured LC solves for `$x$`. Where LC was not measured, `$s$` is [`CRUSHED`] of `$T_m$`.
fn min_separation(fabric: &Fabric) -> f64 {
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
fn stiffness(fabric: &Fabric) -> f64 {
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
        stiffness(fabric) / SurfaceSettings::stiffness_for_pressure(1.0, distance, of_pair)
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
