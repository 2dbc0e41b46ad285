//! Case `fold`: a strip that is folded at rest.
//!
//! The strip starts flat, without weight and without friction, and is held at one end. Its energy
//! is zero, which is the minimum, when both parts are flat and turned by the angle of the fold. So
//! the strip comes to this angle whatever its rigidities.

use drape_dynamics::Simulation;
use drape_scene::{FoldSpec, PanelSpec, PinSpec, SceneSpec, SettleSpec, TimeSpec};
use nalgebra::Vector3;

use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Layout, Source};
use crate::setup::fabrics::fabric;
use crate::setup::{alone, finish, with_panel};

/// Width and height of the strip, in m.
const SIZE: [f64; 2] = [0.06, 0.16];

/// Height at which the fold crosses the middle of the strip, in m. No particle lies there.
const HEIGHT: f64 = 0.083;

/// Distance of the particles, in m.
const SPACING: f64 = 0.005;

/// A fabric of different rigidities along warp and weft.
const FABRIC: &str = "name = \"elastic\"\ndensity = 0.2\nthickness = 0.0004\nshear.stiffness = 40\n\
    [warp]\ntraction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, \
    toe_strain_after = 0.01 }\nbending.rigidity = 1.2e-5\n\
    [weft]\ntraction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, \
    toe_strain_after = 0.02 }\nbending.rigidity = 0.8e-5\n";

/// Folded strip at rest.
struct FoldedStrip {
    /// Angle between the two flat parts, towards the right side, in degrees.
    angle: f64,
    /// Middle line of the strip, seen from the side: depth and height, in m.
    line: Vec<[f64; 2]>,
}

/// Returns a strip at rest with a fold of `angle`. The line of the fold is at the angle `slant` to
/// the width of the strip. Both angles are in degrees.
fn folded(angle: f64, slant: f64) -> Result<FoldedStrip, ValidationError> {
    /// Distance from a fold beyond which its parts are flat, in spacings. A slanted fold is rounded
    /// over two spacings on each side.
    const FLAT: f64 = 2.0;

    // The line of the fold ends beyond the sides of the strip.
    let [width, height] = SIZE;
    let (sin, cos) = slant.to_radians().sin_cos();
    let [from, to] =
        [-0.1, 0.1].map(|distance| [0.5 * width + distance * cos, HEIGHT + distance * sin]);
    let mut spec = SceneSpec {
        spacing: SPACING,
        gravity: [0.0; 3],
        time: TimeSpec { step: 0.005, end: 1000.0, ..TimeSpec::default() },
        settle: Some(SettleSpec { residual: 1e-6, ..SettleSpec::default() }),
        ..alone()
    };
    spec.air.density = 0.0;
    let panel = PanelSpec {
        name: "strip".into(),
        fabric: "strip".into(),
        rectangle: Some([width, height]),
        center: [0.5 * width, 0.5 * height, 0.0],
        fold: vec![FoldSpec { from, to, angle }],
        ..PanelSpec::default()
    };
    spec.pin.push(PinSpec {
        panel: "strip".into(),
        points: vec![[0.5 * width, 0.0]],
        radius: Some(0.015),
        ..PinSpec::default()
    });
    let scene = with_panel(spec, panel, &fabric(FABRIC)?).build()?;
    let coordinates = scene.panels[0].lattice.panel_coordinates();
    let mut simulation = Simulation::new(scene)?;
    finish(&mut simulation)?;
    let frame = simulation.positions().to_vec();
    let positions: Vec<Vector3<f64>> =
        frame.chunks_exact(3).map(Vector3::from_column_slice).collect();

    // Mean normals of the flat parts below and above the fold.
    let distances: Vec<f64> =
        coordinates.iter().map(|[x, y]| cos * (y - HEIGHT) - sin * (x - 0.5 * width)).collect();
    let mut normals = [Vector3::zeros(); 2];
    for triangle in simulation.triangles() {
        let nodes = triangle.map(|node| node as usize);
        let [a, b, c] = nodes.map(|node| positions[node]);
        let normal = (b - a).cross(&(c - a));
        for (part, sign) in [-1.0, 1.0].into_iter().enumerate() {
            if nodes.iter().all(|&node| sign * distances[node] > FLAT * SPACING) {
                normals[part] += normal;
            }
        }
    }

    // The pin holds the lower part in its plane, so the line of the fold keeps its direction.
    let [lower, upper] = normals;
    let turned = lower.cross(&upper).dot(&Vector3::new(cos, sin, 0.0));
    let line = coordinates
        .iter()
        .zip(&positions)
        .filter(|([x, _], _)| (x - 0.5 * width).abs() < 1e-9)
        .map(|(_, position)| [position.z, position.y])
        .collect();
    Ok(FoldedStrip { angle: turned.atan2(lower.dot(&upper)).to_degrees(), line })
}

/// Compares the angles of folded strips with the angles of their folds. Three folds run across the
/// strip, and one fold slants.
pub(crate) fn fold() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let axes = [Axis::new("depth", "mm", 1e-3), Axis::new("height", "mm", 1e-3)];
    let mut graph = Graph::new("folded strips from the side", axes).laid_out(Layout::ToScale);
    for (angle, slant) in [(90.0, 0.0), (-40.0, 0.0), (130.0, 0.0), (90.0, 30.0)] {
        let strip = folded(angle, slant)?;

        // Only folds across the strip are sharp when seen from the side.
        let along = if slant == 0.0 {
            let (sin, cos) = f64::to_radians(angle).sin_cos();
            let rest = SIZE[1] - HEIGHT;
            let sharp = vec![[0.0; 2], [0.0, HEIGHT], [rest * sin, HEIGHT + rest * cos]];
            graph.add(Source::Simulated, format!("{angle}°"), strip.line);
            graph.add(Source::Reference, "sharp", sharp);
            "along the weft".to_owned()
        } else {
            format!("at {slant}° to the weft")
        };

        let what = format!("angle of a fold of {angle}° {along}, 5 mm, °");
        checks.push(Check::within(what, strip.angle, angle, 0.01));
    }
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}
