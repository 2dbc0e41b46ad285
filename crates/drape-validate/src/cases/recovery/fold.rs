//! Case `fold`: a strip that is folded at rest.
//!
//! It starts flat, without weight and without friction, and is held at one end. Its energy is
//! least, none, when both parts are flat and turned by the angle of the fold, so it comes to that
//! angle whatever its rigidities.

use drape_dynamics::Simulation;
use nalgebra::Vector3;

use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Layout, Source};
use crate::setup::{ALONE, finish, scene};

/// Width and height of the strip, and that at which the fold crosses its middle, off the nodes, in
/// m.
const SIZE: [f64; 2] = [0.06, 0.16];

const HEIGHT: f64 = 0.083;

/// Distance of the particles, in m.
const SPACING: f64 = 0.005;

/// How far from a fold its parts are flat, in spacings: slanting ones are rounded over two on each
/// side.
const FLAT: f64 = 2.0;

/// A fabric of different rigidities along warp and weft.
const FABRIC: &str = "name = \"elastic\"\ndensity = 0.2\nthickness = 0.0004\nshear.stiffness = 40\n\
    [warp]\ntraction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, \
    toe_strain_after = 0.01 }\nbending.rigidity = 1.2e-5\n\
    [weft]\ntraction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, \
    toe_strain_after = 0.02 }\nbending.rigidity = 0.8e-5\n";

/// What a strip has come to.
struct Folded {
    /// Angle between the two flat parts, towards the right side, in degrees.
    angle: f64,
    /// The middle of its width from the side, in m.
    line: Vec<[f64; 2]>,
}

/// A strip with a fold of an angle along a line that slants from its width, both in degrees, at
/// rest.
fn folded(angle: f64, slant: f64) -> Result<Folded, ValidationError> {
    let [width, height] = SIZE;
    let (sin, cos) = slant.to_radians().sin_cos();
    let end = |way: f64| [0.5 * width + way * cos, HEIGHT + way * sin];
    let text = format!(
        "{ALONE}spacing = {SPACING}\ngravity = [0, 0, 0]\nair.density = 0\n\
         fabric.strip.file = \"fabric.toml\"\n[[panel]]\nname = \"strip\"\nfabric = \"strip\"\n\
         rectangle = [{width}, {height}]\ncenter = [{}, {}, 0]\n\
         [[panel.fold]]\nfrom = {:?}\nto = {:?}\nangle = {angle}\n\
         [[pin]]\npanel = \"strip\"\npoints = [[{}, 0]]\nradius = 0.015\n\
         [time]\nstep = 0.005\nend = 1000\n[settle]\nresidual = 1e-6\n[output]\nenergy = false\n",
        0.5 * width,
        0.5 * height,
        end(-0.1),
        end(0.1),
        0.5 * width
    );
    let scene = scene(text, FABRIC.into())?;
    let places = scene.panels[0].lattice.panel_coordinates();
    let mut simulation = Simulation::new(scene)?;
    finish(&mut simulation)?;
    let positions = simulation.frame().positions;
    let at = |node: usize| Vector3::from_column_slice(&positions[3 * node..3 * node + 3]);
    let beyond =
        |node: usize| cos * (places[node][1] - HEIGHT) - sin * (places[node][0] - 0.5 * width);
    let mut normals = [Vector3::zeros(); 2];
    for triangle in simulation.triangles() {
        let nodes = triangle.map(|node| node as usize);
        let [a, b, c] = nodes.map(at);
        let normal = (b - a).cross(&(c - a));
        for (part, sign) in [-1.0, 1.0].into_iter().enumerate() {
            if nodes.iter().all(|&node| sign * beyond(node) > FLAT * SPACING) {
                normals[part] += normal;
            }
        }
    }
    let [lower, upper] = normals;
    // The lower part is held in its plane, and with it the line.
    let turned = lower.cross(&upper).dot(&Vector3::new(cos, sin, 0.0));
    let middle = (0..places.len()).filter(|&node| (places[node][0] - 0.5 * width).abs() < 1e-9);
    let line = middle.map(at).map(|place| [place.z, place.y]).collect();
    Ok(Folded { angle: turned.atan2(lower.dot(&upper)).to_degrees(), line })
}

/// Folds across the strip, and one that slants.
pub(crate) fn fold() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let axes = [Axis::new("depth", "mm", 1e-3), Axis::new("height", "mm", 1e-3)];
    let mut graph = Graph::new("folded strips from the side", axes).laid_out(Layout::ToScale);
    for (angle, slant) in [(90.0, 0.0), (-40.0, 0.0), (130.0, 0.0), (90.0, 30.0)] {
        let found = folded(angle, slant)?;
        let along = if slant == 0.0 {
            let (sin, cos) = f64::to_radians(angle).sin_cos();
            let rest = SIZE[1] - HEIGHT;
            let sharp = vec![[0.0; 2], [0.0, HEIGHT], [rest * sin, HEIGHT + rest * cos]];
            graph.add(Source::Simulated, format!("{angle}°"), found.line);
            graph.add(Source::Reference, "sharp", sharp);
            "along the weft".to_owned()
        } else {
            format!("at {slant}° to the weft")
        };
        let what = format!("angle of a fold of {angle}° {along}, 5 mm, °");
        checks.push(Check::within(what, found.angle, angle, 0.01));
    }
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}
