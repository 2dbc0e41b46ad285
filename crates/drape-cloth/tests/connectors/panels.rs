//! Panels cut by the cutter of garments, and the fabric of the tests.

use std::sync::LazyLock;

use drape_cloth::{Grain, Lattice, Mesh, Seam};
use drape_fabric::Fabric;
use drape_input::Document;
use drape_pattern::{Cut, Cutter, NodeId, Panel, Pattern, SeamNodes};

/// Every feature on: toes with memory, two friction elements, growth, locking, a crease.
pub const RICH: &str = r#"
name = "rich"
density = 0.18
thickness = 0.0004
[shear]
stiffness = 40.0
growth = 6.0
friction = [{ plateau = 0.6, length = 0.006 }, { plateau = 0.2, length = 0.05 }]
locking = { onset = 0.139, limit = 0.867 }
[warp.traction]
friction = [{ plateau = 4.0, length = 0.001 }]
primed = { stiffness = 9000.0, toe_ratio = 0.6, toe_strain = 0.02, toe_strain_after = 0.03 }
[warp.bending]
rigidity = 2.5e-5
rest_curvature = 3.0
friction = [{ plateau = 9e-4, length = 3.0 }, { plateau = -2e-4, length = 20.0 }]
[weft.traction]
polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
friction = [{ plateau = 2.0, length = 0.002 }]
[weft.bending]
piecewise = { slope = 2e-5, intercept = 4e-4, knot = 40.0 }
"#;

/// Linen with every feature on: toe with memory, second-order bending, nested shear friction.
pub const LINEN: &str = r#"
name = "linen"
density = 0.18
thickness = 0.0004
[shear]
stiffness = 40.0
growth = 6.0
friction = [{ plateau = 0.6, length = 0.006 }, { plateau = 0.2, length = 0.05 }]
locking = { onset = 0.139, limit = 0.867 }
[warp.traction]
friction = [{ plateau = 4.0, length = 0.001 }]
primed = { stiffness = 9000.0, toe_ratio = 0.6, toe_strain = 0.02, toe_strain_after = 0.03 }
[warp.bending]
rigidity = 2.5e-5
rest_curvature = 3.0
friction = [{ plateau = 9e-4, length = 3.0 }, { plateau = -2e-4, length = 20.0 }]
[weft.traction]
polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
[weft.bending]
piecewise = { slope = 2e-5, intercept = 4e-4, knot = 40.0 }
"#;

/// Linear in everything, without memory.
pub const LINEAR: &str = r#"
name = "linear"
density = 0.2
thickness = 0.0003
shear.stiffness = 30.0
[warp]
traction.primed = { stiffness = 4000, toe_ratio = 1, toe_strain = 0.01, toe_strain_after = 0.01 }
bending.rigidity = 1.2e-5
[weft]
traction.primed = { stiffness = 2500, toe_ratio = 1, toe_strain = 0.01, toe_strain_after = 0.01 }
bending.rigidity = 0.7e-5
"#;

pub fn fabric(text: &str) -> Fabric {
    Fabric::from_document(&Document::new("fabric.toml", text)).expect("the fabric is right")
}

/// The mesh of a cut, its outline last, and the number of each node in it.
pub fn mesh(cut: &Cut) -> (Mesh, Vec<u32>) {
    let nodes = 0..cut.yarns.len();
    let (inner, outer): (Vec<usize>, Vec<usize>) = nodes.partition(|&k| cut.lattice[k].is_some());
    let order: Vec<usize> = inner.into_iter().chain(outer).collect();
    let mut number = vec![0; order.len()];
    for (k, &node) in order.iter().enumerate() {
        number[node] = k as u32;
    }
    let mesh = Mesh {
        spacing: cut.spacing,
        coordinates: order.iter().map(|&k| cut.yarns[k]).collect(),
        grid: order.iter().filter_map(|&k| cut.lattice[k]).collect(),
        cells: cut.quads.iter().map(|quad| quad.map(|k| number[k as usize])).collect(),
        triangles: cut.triangles.iter().map(|three| three.map(|k| number[k as usize])).collect(),
    };
    (mesh, number)
}

/// The panels of a pattern at 10 mm and its seams.
pub fn garment(file: &str) -> (Vec<Lattice>, Vec<Seam>) {
    let path = format!("{}/../drape-pattern/patterns/{file}", env!("CARGO_MANIFEST_DIR"));
    let pattern = Pattern::read(path).expect("it is read");
    let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
    let (mut panels, mut numbers, mut first) = (Vec::new(), Vec::new(), 0);
    for (panel, cut) in pattern.panels().iter().zip(&cut.panels) {
        panels.push(lattice(cut, panel.grain().to_degrees()));
        numbers.push(mesh(cut).1.into_iter().map(|node| first + node).collect::<Vec<u32>>());
        first += cut.yarns.len() as u32;
    }
    let number = |id: NodeId| numbers[id.panel][id.node as usize];
    let seam = |nodes: &SeamNodes| {
        assert!(nodes.ties.is_empty(), "none of them is gathered");
        Seam::new(nodes.pairs.iter().map(|pair| pair.map(number)).collect())
    };
    (panels, cut.seams.iter().map(seam).collect())
}

pub fn lattice(cut: &Cut, degrees: f64) -> Lattice {
    Lattice::from_mesh(mesh(cut).0, Grain::from_degrees(degrees)).expect("a panel")
}

/// A panel of one outline in millimetres, its warp at an angle in degrees from its height.
pub fn shape(path: &str, degrees: f64, spacing: f64) -> Lattice {
    let panel = Panel::from_path("shape", path, 1e-3).expect("an outline");
    let panel = panel.with_grain(degrees.to_radians()).expect("an angle");
    let pattern = Pattern::new(vec![panel], Vec::new()).expect("a pattern");
    let cut = Cutter::new(spacing).cut(&pattern).expect("it can be cut");
    lattice(&cut.panels[0], degrees)
}

pub fn rectangle([width, height]: [f64; 2], degrees: f64, spacing: f64) -> Lattice {
    let [w, h] = [width, height].map(|side| 1e3 * side);
    shape(&format!("M0 0 L{w} 0 L{w} -{h} L0 -{h} Z"), degrees, spacing)
}

/// A panel whose spacing grows with the distance from a slanting line.
pub fn graded(lattice: &Lattice) -> Lattice {
    let [u, v] = lattice.grain().to_material(lattice.middle());
    let distance = |[x, y]: [f64; 2]| (0.6 * (x - u) + 0.8 * (y - v)).abs();
    let graded = lattice.graded(|point| 0.006 + 0.5 * distance(point));
    graded.expect("it was not graded").lattice
}

/// All panels of the patterns in the repository at 10 mm, as they lie and with the grain rotated by
/// 45°, and those that are large enough graded, too.
pub static GARMENTS: LazyLock<Vec<(String, Lattice)>> = LazyLock::new(garments);

fn garments() -> Vec<(String, Lattice)> {
    let mut all = Vec::new();
    for file in ["pencil-skirt.toml", "shirt.json", "skirt.json", "teagan.json", "trousers.json"] {
        let path = format!("{}/../drape-pattern/patterns/{file}", env!("CARGO_MANIFEST_DIR"));
        let pattern = Pattern::read(path).expect("it is read");
        for angle in [0.0, 45.0_f64] {
            let rotated = |panel: &Panel| {
                let grain = panel.grain() + angle.to_radians();
                panel.clone().with_grain(grain).expect("an angle")
            };
            let panels = pattern.panels().iter().map(rotated).collect();
            let pattern = Pattern::new(panels, pattern.seams().to_vec()).expect("as before");
            let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
            for (panel, cut) in pattern.panels().iter().zip(&cut.panels) {
                let name = format!("{file} {} {angle}°", panel.name());
                let uniform = lattice(cut, panel.grain().to_degrees());
                let graded = graded(&uniform);
                if graded.coordinates().len() < uniform.coordinates().len() {
                    all.push((format!("{name} graded"), graded));
                }
                all.push((name, uniform));
            }
        }
    }
    all
}
