//! Cylinders.

use drape_cloth::{Cloth, Lattice};

use crate::consistency::panels;
use crate::panels::{GARMENTS, LINEAR, fabric, rectangle};

/// Positions on a cylinder whose axis is at an angle to the weft.
fn rolled(lattice: &Lattice, radius: f64, angle: f64) -> Vec<f64> {
    let (sin, cos) = angle.sin_cos();
    let place = |&[u, v]: &[f64; 2]| {
        let (along, across) = (cos * u + sin * v, cos * v - sin * u);
        let angle = across / radius;
        [along, radius * angle.sin(), radius * (1.0 - angle.cos())]
    };
    lattice.coordinates().iter().flat_map(place).collect()
}

/// Bending energies of a panel rolled about axes at angles in degrees, over those of the laws.
fn energies(lattice: &Lattice, radius: f64, angles: &[f64]) -> Vec<f64> {
    // The difference to twice the rigidity: chords shorter than arcs are compressed in both.
    let stiff = LINEAR.replace("1.2e-5", "2.4e-5").replace("0.7e-5", "1.4e-5");
    let fabrics = [LINEAR, &stiff].map(fabric);
    let cloths =
        fabrics.each_ref().map(|fabric| Cloth::new(&[(lattice, fabric)]).expect("a cloth"));
    let part = |degrees: &f64| {
        let angle = degrees.to_radians();
        let [soft, stiff] = cloths.each_ref().map(|cloth| {
            cloth
                .stored(&cloth.state(rolled(lattice, radius, angle)).expect("it fits"))
                .expect("the lists fit")
        });
        let (sin, cos) = angle.sin_cos();
        let [warp, weft] = [cos * cos / radius, sin * sin / radius];
        let exact = 0.5 * lattice.area() * (1.2e-5 * warp * warp + 0.7e-5 * weft * weft);
        (stiff - soft) / exact
    };
    angles.iter().map(part).collect()
}

#[test]
fn a_cylinder_has_the_energy_of_the_laws_about_any_axis() {
    let mut worst = 0.0_f64;
    let mut check = |name: &str, lattice: &Lattice, angles: &[f64]| {
        for (part, angle) in energies(lattice, 0.1, angles).into_iter().zip(angles) {
            worst = worst.max((part - 1.0).abs());
            assert!((part - 1.0).abs() < 0.01, "{name}, axis {angle}°: {part}");
        }
    };
    for grain in [0.0, 17.0, 45.0] {
        let lattice = rectangle([0.1, 0.14], grain, 0.01);
        let angles = [0.0, 15.0, 30.0, 45.0, 60.0, 90.0, 130.0];
        check(&format!("grain {grain}°"), &lattice, &angles);
    }
    for (name, lattice) in GARMENTS.iter() {
        check(name, lattice, &[0.0, 30.0, 45.0, 90.0]);
    }
    println!("energy of cylinders: off by {worst:.5} at most");
}

#[test]
fn normals_are_exact_on_planes_and_of_second_order_on_cylinders() {
    let fabric = fabric(LINEAR);
    let (sin, cos) = 0.7_f64.sin_cos();
    let error = |lattice: &Lattice, radius: f64| {
        let cloth = Cloth::new(&[(lattice, &fabric)]).expect("a cloth");
        let state = cloth.state(rolled(lattice, radius, 0.7)).expect("it fits");
        let normals = state.normals().chunks_exact(3).zip(lattice.coordinates());
        let off = normals.map(|(normal, [u, v])| {
            let angle = (cos * v - sin * u) / radius;
            let exact = [0.0, -angle.sin(), angle.cos()];
            (0..3).map(|k| (normal[k] - exact[k]).powi(2)).sum::<f64>().sqrt()
        });
        off.fold(0.0, f64::max)
    };
    for (name, lattice) in panels() {
        let plane = error(&lattice, 1e12);
        assert!(plane < 1e-12, "{name}: {plane:e}");
    }
    let [coarse, fine] = [0.02, 0.01].map(|h| error(&rectangle([0.2, 0.3], 33.0, h), 0.1));
    println!("normals on a cylinder: off by {coarse:.2e} and {fine:.2e}");
    assert!((coarse / fine).log2() > 1.6, "{coarse:e} {fine:e}");
}
