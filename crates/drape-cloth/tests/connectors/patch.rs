//! Uniform strains, on the panels of real garments.

use drape_cloth::{Cloth, Lattice};
use drape_fabric::Law;

use crate::bias::outline;
use crate::panels::{GARMENTS, LINEAR, fabric, rectangle};

#[test]
fn connector_areas_add_up_to_the_area_of_the_panel() {
    let mut worst = 0.0_f64;
    for (name, lattice) in GARMENTS.iter().chain(&thin()) {
        let cloth = Cloth::new(&[(lattice, &fabric(LINEAR))]).expect("a cloth");
        let areas = cloth.connector_areas();
        for area in [areas.traction, areas.bending, [areas.shear; 2]].concat() {
            let error = area / lattice.area() - 1.0;
            worst = worst.max(error.abs());
            assert!(error.abs() < 1e-12, "{name}: {areas:?}, panel {}", lattice.area());
        }
        let mass: f64 = cloth.masses().iter().sum();
        assert!((mass / (0.2 * lattice.area()) - 1.0).abs() < 1e-12, "{name}");
    }
    println!("areas of the connectors over that of the panel, less one: {worst:.1e}");
}

fn thin() -> Vec<(String, Lattice)> {
    [0.0, 20.0, 45.0]
        .map(|angle| (format!("thin {angle}°"), rectangle([0.013, 0.2], angle, 0.01)))
        .into()
}

#[test]
fn a_uniform_strain_leaves_no_force_inside_and_has_the_energy_of_the_laws() {
    let fabric = fabric(LINEAR);
    // Warp and weft stretched by 3 and 2 %, leaned by a sine of 0.08, and the whole rotated in
    // space.
    let (stretch, sine) = ([1.03, 1.02], 0.08_f64);
    let warp = [stretch[0] * sine, stretch[0] * (1.0 - sine * sine).sqrt()];
    let place = |&[u, v]: &[f64; 2]| {
        let (x, y) = (stretch[1] * u + warp[0] * v, warp[1] * v);
        [0.6 * x - 0.8 * y, 0.48 * x + 0.36 * y, 0.64 * x + 0.48 * y + 0.1]
    };
    let (mut inside, mut off) = (0.0_f64, 0.0_f64);
    for (name, lattice) in GARMENTS.iter().chain(&thin()) {
        let cloth = Cloth::new(&[(lattice, &fabric)]).expect("a cloth");
        let flat = lattice.coordinates().iter().flat_map(|&[u, v]| [u, v, 0.0]).collect();
        let state = cloth.state(flat).expect("it fits");
        let strained: Vec<f64> = lattice.coordinates().iter().flat_map(place).collect();
        let mut forces = vec![0.0; strained.len()];
        cloth.add_forces(&state, &strained, &mut forces).expect("the lists fit");
        let on_outline = on_outline(lattice);
        // Root mean square.
        let size = |outer: bool| {
            let all = forces.chunks_exact(3).zip(&on_outline);
            let some = all.filter(|(_, on)| **on == outer);
            let squares: Vec<f64> = some.map(|(f, _)| f.iter().map(|x| x * x).sum()).collect();
            (squares.iter().sum::<f64>() / squares.len().max(1) as f64).sqrt()
        };
        inside = inside.max(size(false) / size(true));
        assert!(size(false) < 1e-12 * size(true), "{name}: {:e} of {:e}", size(false), size(true));
        for strain in cloth.triangle_strains(&strained).expect("the lists fit") {
            let off = [strain.warp - 0.03, strain.weft - 0.02, strain.shear.sin() - sine];
            assert!(off.iter().all(|off| off.abs() < 1e-10), "{name}: {strain:?}");
        }
        let areas = cloth
            .triangle_strains(&strained)
            .expect("the lists fit")
            .iter()
            .map(|strain| strain.area)
            .sum::<f64>();
        assert!((areas / lattice.area() - 1.0).abs() < 1e-10, "{name}: {areas} m²");
        let work = |law: &dyn Fn() -> f64| law() * lattice.area();
        let exact = work(&|| fabric.warp.traction.work(&fabric.warp.traction.virgin(), 0.03))
            + work(&|| fabric.weft.traction.work(&fabric.weft.traction.virgin(), 0.02))
            + work(&|| fabric.shear.work(&fabric.shear.virgin(), sine));
        let found = cloth.potential(&state, &strained).expect("the lists fit")
            - cloth.potential(&state, &state.positions).expect("the lists fit");
        off = off.max((found / exact - 1.0).abs());
        assert!((found / exact - 1.0).abs() < 1e-10, "{name}: {found} against {exact}");
    }
    println!(
        "uniform strain: force inside over that at the outline {inside:.1e}, energy {off:.1e}"
    );
}

/// Whether each particle is at a side of only one triangle.
fn on_outline(lattice: &Lattice) -> Vec<bool> {
    let mut on = vec![false; lattice.coordinates().len()];
    outline(lattice).into_iter().flatten().for_each(|node| on[node as usize] = true);
    on
}
