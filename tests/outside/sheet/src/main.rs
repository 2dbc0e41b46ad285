//! Forces on a sheet of triangles of one's own: a strip in tension against its law, and a crumpled
//! strip against differences of its energy.

use std::time::Instant;

use drape_cloth::{Cloth, Grain, Lattice, Mesh};
use drape_fabric::{Fabric, Law, drive};
use drape_input::Document;

/// Width and height of the strip in m, and number of cells along both.
const SIZE: [f64; 2] = [0.1, 0.3];
const CELLS: [u32; 2] = [10, 30];

/// Fabric of the strip.
const FABRIC: &str = r#"
    name = "my weave"
    density = 0.12
    thickness = 0.0003
    shear = { stiffness = 35, friction = [{ plateau = 0.5, length = 0.004 }] }
    [warp]
    traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
    bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4 }] }
    [weft]
    traction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 }
    bending = { rigidity = 0.8e-5, friction = [{ plateau = 4e-4, length = 4 }] }
"#;

/// Returns the triangles of the strip, whose inner nodes lie a little beside their cells' corners.
fn strip() -> Mesh {
    let [columns, rows] = CELLS;
    let node = |column: u32, row: u32| row * (columns + 1) + column;
    let mut mesh = Mesh { spacing: [SIZE[0] / f64::from(columns); 2], ..Mesh::default() };
    for row in 0..=rows {
        for column in 0..=columns {
            let is_inner = column % columns != 0 && row % rows != 0;
            let number = f64::from(node(column, row));
            let beside = |turn: f64| {
                if is_inner { 0.25 * ((turn * number).fract() - 0.5) } else { 0.0 }
            };
            mesh.coordinates.push([
                mesh.spacing[0] * (f64::from(column) + beside(0.618_034)),
                mesh.spacing[1] * (f64::from(row) + beside(0.754_878)),
            ]);
        }
    }
    for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
        let [a, b] = [node(column, row), node(column + 1, row)];
        let [c, d] = [node(column + 1, row + 1), node(column, row + 1)];
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fabric = Fabric::from_document(&Document::new("weave.toml", FABRIC))?;
    let begin = Instant::now();
    let lattice = Lattice::from_mesh(strip(), Grain::default())?;
    let cloth = Cloth::new(&[(&lattice, &fabric)]).expect("a cloth");
    let place = |to: fn([f64; 2]) -> [f64; 3]| -> Vec<f64> {
        cloth.coordinates().iter().flat_map(|point| to(*point)).collect()
    };
    let state = cloth.state(place(|[u, v]| [u, v, 0.0]))?;

    // Stretched by 2 % along the warp, the upper half is drawn down by the tension of the law.
    let mut forces = vec![0.0; 3 * cloth.particle_count()];
    cloth
        .add_forces(&state, &place(|[u, v]| [u, 1.02 * v, 0.0]), &mut forces)
        .expect("the lists fit");
    let is_upper = |point: &[f64; 2]| point[1] > 0.5 * SIZE[1];
    let particles = cloth.coordinates().iter().zip(forces.chunks_exact(3));
    let upper = particles.filter(|(point, _)| is_upper(point));
    let pull: f64 = upper.map(|(_, force)| -force[1]).sum();
    let law = &fabric.warp.traction;
    let tension = drive(law, law.virgin(), &[0.02])[0];
    let error = (pull / (tension * SIZE[0]) - 1.0).abs();
    assert!(error < 1e-10, "{pull} N over {} m, the law has {tension} N/m", SIZE[0]);

    // Crumpled, every force is the slope of the energy.
    let crumpled = place(|[u, v]| {
        [
            1.01 * u + 0.01 * (20.0 * v).sin(),
            1.015 * v + 0.05 * u,
            0.02 * (40.0 * u).sin() * (15.0 * v).cos(),
        ]
    });
    forces.fill(0.0);
    cloth.add_forces(&state, &crumpled, &mut forces).expect("the lists fit");
    let largest = forces.iter().fold(0.0, |largest: f64, force| largest.max(force.abs()));
    let mut worst: f64 = 0.0;
    for k in (0..forces.len()).step_by(7) {
        let mut moved = crumpled.clone();
        let mut energy_at = |offset: f64| {
            moved[k] = crumpled[k] + offset;
            cloth.potential(&state, &moved).expect("the lists fit")
        };
        let slope = (energy_at(1e-7) - energy_at(-1e-7)) / 2e-7;
        worst = worst.max((forces[k] + slope).abs() / largest);
    }
    let milliseconds = 1e3 * begin.elapsed().as_secs_f64();
    assert!(worst < 1e-6, "a force is off by {worst:e} of the largest");
    println!(
        "{} triangles, tension right to {error:.0e}, forces to {worst:.0e}: {milliseconds:.0} ms",
        cloth.triangles().len()
    );
    Ok(())
}
