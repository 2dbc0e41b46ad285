//! Case `bias-rim`: bending specimens cut on the bias, as a grid and as a grid with a rim of
//! triangles.
//!
//! Both specimens are compared with the moment of the laws, and with each other.

use std::sync::Arc;

use drape_dynamics::Simulation;
use drape_fabric::Fabric;
use drape_input::Document;
use drape_pattern::Pattern;
use drape_scene::{
    FabricSpec, FileOr, GarmentSpec, MotionSpec, PanelSpec, PinSpec, Scene, SceneSpec, TimeSpec,
};

use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::instrument::on_the_bias_along;
use crate::setup::alone;
use crate::setup::fabrics::{COTTON, CUPRO, fabric};

/// Width of a specimen, in m.
const WIDTH: f64 = 0.2;

/// Length of a specimen between the clamps, in m.
const GAUGE: f64 = 0.03;

/// Length of a specimen in each clamp, in m.
const CLAMPED: f64 = 0.01;

/// Largest curvature of a specimen, in 1/m. The shear of folded cells adds at most half a per cent
/// to the moment.
const LARGEST: f64 = 40.0;

/// Steps in which a specimen is bent.
const STEPS: usize = 20;

/// Mesh of a specimen.
#[derive(Clone, Copy, PartialEq)]
enum Mesh {
    /// A rectangle whose cells at the sides are cut.
    Grid,
    /// A cut pattern, with triangles between the full cells and the sides.
    Rim,
}

/// Returns the points of the panel that a clamp holds, in m. The clamp begins at the distance
/// `start`, in m, from the left end of the panel.
fn clamped_points(start: f64) -> Vec<[f64; 2]> {
    /// Distance of the points, in m.
    const GRIP: f64 = 1e-3;

    /// Parts of a metre to which the points are rounded.
    const PARTS: f64 = 1e4;

    let [along, across] = [CLAMPED, WIDTH].map(|length| (length / GRIP).round() as usize);
    let points = (0..=along).flat_map(|along| {
        (0..=across).map(move |across| [start + along as f64 * GRIP, across as f64 * GRIP])
    });
    points.map(|point| point.map(|x| (x * PARTS).round() / PARTS)).collect()
}

/// Returns the shift of the moving clamp that bends the specimen to `curvature`, in 1/m.
fn clamp_shift(curvature: f64) -> [f64; 3] {
    let turn = curvature * GAUGE;
    if turn == 0.0 {
        return [0.0; 3];
    }
    [turn.sin() / curvature - GAUGE, (1.0 - turn.cos()) / curvature, 0.0]
}

/// Returns the scene of a specimen of `fabric` with `mesh`, which is bent step by step.
fn specimen(mesh: Mesh, fabric: &Fabric) -> Result<Scene, ValidationError> {
    /// Distance of the particles along the yarns, in m.
    const SPACING: f64 = 0.0025;

    /// Length of a step, in s.
    const STEP: f64 = 0.1;

    /// Distance from a point of a clamp within which particles are held, in m.
    const REACH: f64 = 0.75e-3;

    // The moving clamp follows an arc of constant length.
    let length = GAUGE + 2.0 * CLAMPED;
    let curvatures: Vec<f64> = (0..=STEPS).map(|k| LARGEST * k as f64 / STEPS as f64).collect();
    let motion = MotionSpec {
        times: (0..=STEPS).map(|k| k as f64 * STEP).collect(),
        shift: curvatures.iter().map(|&k| clamp_shift(k)).collect(),
        turn: curvatures.iter().map(|k| [0.0, 0.0, (k * GAUGE).to_degrees()]).collect(),
        center: Some([GAUGE, 0.0, 0.0]),
    };

    let mut spec = SceneSpec {
        name: Some("specimen".into()),
        spacing: SPACING,
        gravity: [0.0; 3],
        time: TimeSpec { step: STEP, end: STEP * STEPS as f64, ..TimeSpec::default() },
        ..alone()
    };
    spec.air.density = 0.0;
    let clamp = |start: f64| PinSpec {
        panel: "specimen".into(),
        radius: Some(REACH),
        points: clamped_points(start),
        ..PinSpec::default()
    };
    spec.pin = vec![clamp(0.0), PinSpec { motion: Some(motion), ..clamp(CLAMPED + GAUGE) }];

    // A panel of a scene is a grid. A panel of a pattern has a rim.
    let file = FileOr::Value(Arc::new(fabric.clone()));
    spec.fabric.insert("specimen".into(), FabricSpec { file, ..FabricSpec::default() });
    match mesh {
        Mesh::Grid => spec.panel.push(PanelSpec {
            name: "specimen".into(),
            fabric: "specimen".into(),
            rectangle: Some([length, WIDTH]),
            grain: 45.0,
            center: [0.5 * GAUGE, 0.0, 0.0],
            turn: [-90.0, 0.0, 0.0],
            ..PanelSpec::default()
        }),
        Mesh::Rim => {
            let pattern = format!(
                "length = \"m\"\n[panel.specimen]\ngrain = 45\nrectangle = [{length}, {WIDTH}]\n\
                 origin = [{}, 0, {}]\nturn = [-90, 0, 0]\n",
                -CLAMPED,
                0.5 * WIDTH
            );
            let pattern = Pattern::parse(&Document::new("specimen.toml", pattern))?;
            spec.garment.push(GarmentSpec {
                pattern: FileOr::Value(Arc::new(pattern)),
                fabric: "specimen".into(),
                ..GarmentSpec::default()
            });
        }
    }
    Ok(spec.build()?)
}

/// Bends a specimen of `fabric` with `mesh`. Returns the curvatures in the middle half of its
/// length, in 1/m, and the moments per width there, in N, after each step.
fn bend(mesh: Mesh, fabric: &Fabric) -> Result<[Vec<f64>; 2], ValidationError> {
    /// Part of the width in which curvatures are read: particles at ragged sides do not lie on the
    /// cylinder.
    const MIDDLE: f64 = 0.8;

    let scene = specimen(mesh, fabric)?;
    let particles = scene.pins[1].particles.clone();
    let starts: Vec<f64> = scene.start.positions.iter().step_by(3).copied().collect();
    let mut simulation = Simulation::new(scene)?;
    let [mut curvatures, mut moments] = [Vec::new(), Vec::new()];
    for _ in 0..STEPS {
        simulation.step()?;
        let frame = simulation.positions().to_vec();
        let positions = frame.as_chunks::<3>().0;

        // Middles of the measured particles and of the particles in the clamp.
        let middle: Vec<[f64; 2]> = starts
            .iter()
            .zip(positions)
            .filter(|(start, [_, _, z])| {
                (*start / GAUGE - 0.5).abs() < 0.25 && z.abs() < 0.5 * MIDDLE * WIDTH
            })
            .map(|(_, &[x, y, _])| [x, y])
            .collect();
        let count = middle.len() as f64;
        let [x, y] = [0, 1].map(|axis| middle.iter().map(|p| p[axis]).sum::<f64>() / count);
        let held = [0, 1].map(|axis| {
            particles.iter().map(|&p| positions[p][axis]).sum::<f64>() / particles.len() as f64
        });

        // The moment in the middle is the moment of the clamp and the moment of its force.
        let load = simulation.pin_loads()[1];
        let moment = load.moment[2] + (held[0] - x) * load.force[1] - (held[1] - y) * load.force[0];
        curvatures.push(curvature(&middle));
        moments.push(-moment / WIDTH);
    }
    Ok([curvatures, moments])
}

/// Returns the curvature of the circle through `points`, by least squares of their powers
/// \[Kas76\].
fn curvature(points: &[[f64; 2]]) -> f64 {
    let mut normal = nalgebra::SMatrix::<f64, 3, 3>::zeros();
    let mut right = nalgebra::SVector::<f64, 3>::zeros();
    for [x, y] in points {
        let row = nalgebra::SVector::from([*x, *y, 1.0]);
        normal += row * row.transpose();
        right += row * (x * x + y * y);
    }
    // The power of the point (x, y) is x² + y² − 2ax − 2by − c, with the middle (a, b) of the
    // circle.
    normal.lu().solve(&right).map_or(f64::NAN, |solution| {
        let [a, b] = [0.5 * solution[0], 0.5 * solution[1]];
        1.0 / (solution[2] + a * a + b * b).sqrt()
    })
}

/// Compares specimens of two fabrics with both meshes with the laws and with each other.
///
/// The end of a clamp among the particles of a rim is known only to half a spacing. So the
/// curvature is read in the middle of the specimen. The moment there is the moment of the clamp
/// less the moment of its force.
pub(crate) fn bias_rim() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        let mut ratios = Vec::new();

        for (mesh, name) in [(Mesh::Grid, "grid"), (Mesh::Rim, "rim")] {
            let [curvatures, moments] = bend(mesh, &fabric)?;
            let ideal = on_the_bias_along(&fabric, &curvatures);
            let ratio = moments[STEPS - 1] / ideal[STEPS - 1];
            let what = format!(
                "{}, {name}: moment at {:.2} cm⁻¹ over the laws'",
                fabric.name,
                0.01 * curvatures[STEPS - 1]
            );
            checks.push(Check::within(what, ratio, 1.0, 0.03));
            ratios.push(ratio);
        }

        let what = format!("{}: rim over grid", fabric.name);
        checks.push(Check::within(what, ratios[1] / ratios[0], 1.0, 0.03));
    }
    Ok(checks.into())
}
