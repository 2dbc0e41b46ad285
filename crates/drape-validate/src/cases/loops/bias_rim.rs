//! Case `bias-rim`: bending specimens cut on the bias, as a grid and as a grid with a rim of
//! triangles.
//!
//! Both are compared with the moment of the laws, and with each other.

use drape_dynamics::Simulation;
use drape_fabric::Fabric;
use drape_input::Document;
use drape_scene::Scene;

use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::instrument::on_the_bias_along;
use crate::setup::ALONE;
use crate::setup::fabrics::{COTTON, CUPRO, fabric};

/// Width of a specimen, its length between the clamps and in each of them, in m.
const WIDTH: f64 = 0.2;

const GAUGE: f64 = 0.03;

const CLAMPED: f64 = 0.01;

/// Part of the width in which curvatures are read: particles of ragged sides are not on the
/// cylinder.
const MIDDLE: f64 = 0.8;

/// Spacing of the particles along the yarns, in m.
const SPACING: f64 = 0.0025;

/// Curvature up to which it is bent, in 1/m: where the shear of folded cells adds half a per cent
/// at most.
const LARGEST: f64 = 40.0;

/// Steps in which it is, and how long each takes, in s.
const STEPS: usize = 20;

const STEP: f64 = 0.1;

/// Distance of the places that a clamp is told to hold, in m, and how far around them it does.
const GRIP: f64 = 1e-3;

const REACH: f64 = 0.75e-3;

/// How the specimen is made.
#[derive(Clone, Copy, PartialEq)]
enum Making {
    /// A rectangle whose cells at the sides are cut.
    Grid,
    /// A pattern that is cut, with triangles between the full cells and the sides.
    Rim,
}

/// The places of a panel that a clamp holds, which begins so far from the panel's left end, in m.
fn held(start: f64) -> String {
    let count = |length: f64| (length / GRIP).round() as usize;
    let places = (0..=count(CLAMPED)).flat_map(|along| {
        (0..=count(WIDTH)).map(move |across| [start + along as f64 * GRIP, across as f64 * GRIP])
    });
    places.map(|[x, y]| format!("[{x:.4}, {y:.4}], ")).collect()
}

fn specimen(making: Making, fabric: &Fabric) -> Result<Scene, ValidationError> {
    let length = GAUGE + 2.0 * CLAMPED;
    let list = |of: &dyn Fn(f64) -> String| -> String {
        (0..=STEPS).map(|k| of(LARGEST * k as f64 / STEPS as f64) + ", ").collect()
    };
    let shifts = list(&|curvature| match curvature * GAUGE {
        0.0 => "[0, 0, 0]".to_owned(),
        turn => {
            let [along, up] = [turn.sin() / curvature - GAUGE, (1.0 - turn.cos()) / curvature];
            format!("[{along:e}, {up:e}, 0]")
        }
    });
    let turns = list(&|curvature| format!("[0, 0, {:e}]", (curvature * GAUGE).to_degrees()));
    let times: Vec<f64> = (0..=STEPS).map(|k| k as f64 * STEP).collect();
    let panel = match making {
        Making::Grid => format!(
            "[[panel]]\nname = \"specimen\"\nfabric = \"specimen\"\nrectangle = [{length}, {WIDTH}]\ngrain = 45\n\
             center = [{}, 0, 0]\nturn = [-90, 0, 0]\n",
            0.5 * GAUGE
        ),
        Making::Rim => "[[garment]]\npattern = \"specimen.toml\"\nfabric = \"specimen\"\n".into(),
    };
    let pattern = format!(
        "length = \"m\"\n[panel.specimen]\ngrain = 45\nrectangle = [{length}, {WIDTH}]\n\
         origin = [{}, 0, {}]\nturn = [-90, 0, 0]\n",
        -CLAMPED,
        0.5 * WIDTH
    );
    let scene = format!(
        "name = \"specimen\"\nspacing = {SPACING:e}\ngravity = [0, 0, 0]\nair = {{ density = 0 }}\n{ALONE}\
         fabric.specimen.file = \"fabric.toml\"\n{panel}\
         [[pin]]\npanel = \"specimen\"\nradius = {REACH:e}\npoints = [{}]\n\
         [[pin]]\npanel = \"specimen\"\nradius = {REACH:e}\npoints = [{}]\n\
         [pin.motion]\ntimes = {times:?}\ncenter = [{GAUGE:e}, 0, 0]\nshift = [{shifts}]\nturn = [{turns}]\n\
         [time]\nstep = {STEP}\nend = {:e}\n[output]\nenergy = false\n",
        held(0.0),
        held(CLAMPED + GAUGE),
        STEP * STEPS as f64
    );
    let fabric = Document::new("fabric.toml", fabric.to_toml());
    let pattern = Document::new("specimen.toml", pattern);
    Ok(Scene::from_documents(&Document::new("scene.toml", scene), &[fabric, pattern])?)
}

/// Curvatures in the middle half of a specimen's length, in 1/m, and the moments per width there,
/// in N, step by step.
fn bend(making: Making, fabric: &Fabric) -> Result<[Vec<f64>; 2], ValidationError> {
    let scene = specimen(making, fabric)?;
    let particles = scene.pins[1].particles.clone();
    let starts: Vec<f64> = scene.start.positions.iter().step_by(3).copied().collect();
    let mut simulation = Simulation::new(scene)?;
    let [mut curvatures, mut moments] = [Vec::new(), Vec::new()];
    for _ in 0..STEPS {
        simulation.step()?;
        let places = simulation.frame().positions;
        let places = places.as_chunks::<3>().0;
        let middle = starts.iter().zip(places).filter(|(start, place)| {
            (*start / GAUGE - 0.5).abs() < 0.25 && place[2].abs() < 0.5 * MIDDLE * WIDTH
        });
        let middle: Vec<[f64; 2]> = middle.map(|(_, &[x, y, _])| [x, y]).collect();
        let count = middle.len() as f64;
        let [x, y] = [0, 1].map(|axis| middle.iter().map(|p| p[axis]).sum::<f64>() / count);
        let held = [0, 1].map(|axis| {
            particles.iter().map(|&p| places[p][axis]).sum::<f64>() / particles.len() as f64
        });
        let load = simulation.pin_loads()[1];
        let moment = load.moment[2] + (held[0] - x) * load.force[1] - (held[1] - y) * load.force[0];
        curvatures.push(curvature(&middle));
        moments.push(-moment / WIDTH);
    }
    Ok([curvatures, moments])
}

/// Curvature of the circle through points of a plane, by least squares of their powers \[Kas76\].
fn curvature(points: &[[f64; 2]]) -> f64 {
    let mut normal = nalgebra::SMatrix::<f64, 3, 3>::zeros();
    let mut right = nalgebra::SVector::<f64, 3>::zeros();
    for [x, y] in points {
        let row = nalgebra::SVector::from([*x, *y, 1.0]);
        normal += row * row.transpose();
        right += row * (x * x + y * y);
    }
    // The power of a point is that of its place less twice the middle's part and a constant.
    normal.lu().solve(&right).map_or(f64::NAN, |found| {
        let [a, b] = [0.5 * found[0], 0.5 * found[1]];
        1.0 / (found[2] + a * a + b * b).sqrt()
    })
}

/// Both makings of two fabrics, against the laws and against each other.
///
/// Where the clamps end among the particles of a rim is known to half a spacing; so the curvature
/// is read in the middle, where the moment is the clamp's less what its force has for an arm.
pub(crate) fn bias_rim() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        let mut ratios = Vec::new();
        for (making, name) in [(Making::Grid, "grid"), (Making::Rim, "rim")] {
            let [curvatures, moments] = bend(making, &fabric)?;
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
