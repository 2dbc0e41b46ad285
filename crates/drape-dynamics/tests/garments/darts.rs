//! Cloth that is shaped by its darts: its girth, and the angle of its cone.

use std::f64::consts::{PI, TAU};

use drape_dynamics::{Simulation, Status};
use drape_input::Document;
use drape_scene::Scene;

/// Fabric without friction: its shape at rest does not depend on the motion before.
const FABRIC: &str = r#"name = "elastic"
density = 0.15
thickness = 0.0003
shear.stiffness = 35.0
[warp]
traction.primed = { stiffness = 5000.0, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
bending.rigidity = 1e-5
[weft]
traction.primed = { stiffness = 5000.0, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
bending.rigidity = 1e-5
"#;

/// Simulates a garment of a pattern without weight, at a spacing in m, until it is at rest.
fn sewn(pattern: &str, spacing: f64) -> (Scene, Simulation) {
    let text = format!(
        "spacing = {spacing}\ngravity = [0, 0, 0]\nfabric.plain.file = \"plain.toml\"\n\
         [[garment]]\npattern = \"darts.toml\"\nfabric = \"plain\"\n[time]\nstep = 0.005\nend = 60\n[settle]\n"
    );
    let documents = [Document::new("plain.toml", FABRIC), Document::new("darts.toml", pattern)];
    let read = || Scene::from_documents(&Document::new("scene.toml", &text), &documents);
    let scene = read().unwrap_or_else(|error| panic!("{error}"));
    let mut simulation = Simulation::new(read().unwrap()).unwrap();
    let summary = simulation.run(&mut ()).unwrap();
    assert_eq!(summary.status, Status::Ok, "{:?}", summary.reason);
    assert_eq!(summary.contact.intersections, 0);
    (scene, simulation)
}

/// Returns the length of the section of the cloth at a height, in m.
fn girth((scene, simulation): &(Scene, Simulation), height: f64) -> f64 {
    let positions = simulation.positions().to_vec();
    let place = |corner: u32| -> [f64; 3] {
        std::array::from_fn(|axis| positions[3 * corner as usize + axis])
    };
    let cut = |triangle: &[u32; 3]| -> f64 {
        let corners = triangle.map(place);
        let sides = [0, 1, 2].map(|k| [corners[k], corners[(k + 1) % 3]]);
        let crossed = sides.iter().filter(|[a, b]| (a[1] < height) != (b[1] < height));
        let points: Vec<[f64; 3]> = crossed
            .map(|[a, b]| {
                let part = (height - a[1]) / (b[1] - a[1]);
                std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis]))
            })
            .collect();
        match points[..] {
            [a, b] => (a[0] - b[0]).hypot(a[2] - b[2]),
            _ => 0.0,
        }
    };
    scene.cloth.triangles().iter().map(cut).sum()
}

#[test]
fn a_tube_with_closed_darts_has_the_girth_that_they_leave() {
    // 400 mm round and 240 mm high, with four darts of 16 mm, widest at half the height.
    let (width, intake) = (0.4, 0.016);
    let darts: String = [-150, -50, 50, 150]
        .iter()
        .map(|x| format!("[[panel.tube.dart]]\nfrom = [{x}, 220]\nto = [{x}, 20]\nwidth = 16\n"))
        .collect();
    let pattern = format!(
        "length = \"mm\"\n[panel.tube]\ngrain = 0\nstart = [-200, 0]\noutline = [\n\
         {{ name = \"bottom\", to = [200, 0] }},\n{{ name = \"right\", to = [200, 240] }},\n\
         {{ name = \"top\", to = [-200, 240] }},\n{{ name = \"left\", to = [-200, 0] }},\n]\n\
         origin = [0, 0, 70]\nwrap = 70\n{darts}[seam.back]\nsides = [[\"tube.right\"], [\"tube.left\"]]\n"
    );
    let tube = sewn(&pattern, 0.01);
    let (scene, simulation) = &tube;
    // Each seam is closed: the pairs of each are in one place.
    let sewing = scene.sewing.as_ref().unwrap();
    assert_eq!(sewing.seams.len(), 5);
    let positions = simulation.positions().to_vec();
    assert!(sewing.pairs.gaps(&positions).all(|gap| gap < 1e-12));
    // Between the tips a dart takes in as much as its width there. The weave is soft across its
    // yarns where it is bent to a dome: 2 %.
    for height in [0.06, 0.09, 0.12, 0.15, 0.18] {
        let open = 1.0 - (height - 0.12_f64).abs() / 0.1;
        let expected = width - 4.0 * intake * open;
        let measured = girth(&tube, height);
        assert!(
            (measured / expected - 1.0).abs() < 0.02,
            "{measured} m at {height} m for {expected} m"
        );
    }
    // Above and below the darts the tube keeps its width.
    for name in ["top", "bottom"] {
        let edge = scene.panels[0].edges.iter().find(|edge| edge.name == name).unwrap();
        let length = |two: &[u32]| -> f64 {
            let place = |node: u32| &positions[3 * node as usize..][..3];
            let squares = place(two[0]).iter().zip(place(two[1])).map(|(a, b)| (a - b) * (a - b));
            squares.sum::<f64>().sqrt()
        };
        let round: f64 = edge.nodes.windows(2).map(length).sum();
        assert!((round / width - 1.0).abs() < 0.01, "{name}: {round} m for {width} m");
    }
}

#[test]
fn a_disc_with_an_open_dart_is_the_cone_of_the_angle_that_is_left() {
    // A dart from the rim to the middle of a disc of 120 mm takes out a sector. The disc starts a
    // little bent: a flat one would be upset in its plane.
    let radius = 0.12;
    for sector in [PI / 6.0, PI / 3.0] {
        let mouth = 1e3 * radius * sector;
        let pattern = format!(
            "length = \"mm\"\n[panel.disc]\ngrain = 20\nstart = [120, 0]\noutline = [\n\
             {{ name = \"upper\", to = [-120, 0], radius = 120 }},\n\
             {{ name = \"lower\", to = [120, 0], radius = 120 }},\n]\norigin = [0, 0, 0]\nwrap = 300\n\
             [[panel.disc.dart]]\nname = \"gore\"\nedge = \"lower\"\nat = 150\nwidth = {mouth}\nto = [0, 0]\n"
        );
        let (scene, simulation) = sewn(&pattern, 0.01);
        let positions = simulation.positions().to_vec();
        let place = |particle: usize| -> [f64; 3] {
            std::array::from_fn(|axis| positions[3 * particle + axis])
        };
        // The rim: its middle, and its mean distance from there.
        let edges = scene.panels[0].edges.iter();
        let rim =
            edges.filter(|edge| edge.name.starts_with("upper") || edge.name.starts_with("lower"));
        let rim: Vec<[f64; 3]> =
            rim.flat_map(|edge| edge.nodes.iter().map(|&node| place(node as usize))).collect();
        let middle: [f64; 3] =
            std::array::from_fn(|axis| rim.iter().map(|p| p[axis]).sum::<f64>() / rim.len() as f64);
        let apart = |p: [f64; 3], q: [f64; 3]| -> f64 {
            (0..3).map(|axis| (p[axis] - q[axis]).powi(2)).sum::<f64>().sqrt()
        };
        let mean = rim.iter().map(|&p| apart(p, middle)).sum::<f64>() / rim.len() as f64;
        let coordinates = scene.cloth.coordinates();
        let from_tip = |k: &usize| coordinates[*k][0].hypot(coordinates[*k][1]);
        let tip =
            (0..coordinates.len()).min_by(|a, b| from_tip(a).total_cmp(&from_tip(b))).unwrap();
        let height = apart(place(tip), middle);
        // A cone whose sides are the radius has a rim of the arc that is left.
        let left = radius * (TAU - sector) / TAU;
        let expected = (radius * radius - left * left).sqrt();
        assert!((mean / left - 1.0).abs() < 0.01, "rim {mean} m for {left} m");
        assert!((height / expected - 1.0).abs() < 0.02, "height {height} m for {expected} m");
    }
}
