//! The cloth on its grid against its connectors one by one.

use drape_cloth::{Cloth, Grain, Lattice, Reference};
use drape_fabric::Fabric;
use drape_input::Document;

/// Rounding of a few hundred operations on numbers of the size that is compared with.
const TOLERANCE: f64 = 1e-12;

/// Every feature on: toes with memory, two friction elements, growth, locking, a crease.
const RICH: &str = r#"
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

/// One element each, as most fitted fabrics have, and no friction in bending.
const PLAIN: &str = r#"
name = "plain"
density = 0.12
thickness = 0.0003
shear = { piecewise = { slope = 30.0, intercept = 0.6, knot = 0.02 } }
[warp]
traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
bending.rigidity = 1.2e-5
[weft]
traction.primed = { stiffness = 4000, toe_ratio = 1.0, toe_strain = 0.02, toe_strain_after = 0.02 }
bending = { rigidity = 0.8e-5, friction = [{ plateau = 4e-4, length = 4 }] }
"#;

fn fabric(text: &str) -> Fabric {
    Fabric::from_document(&Document::new("fabric.toml", text)).expect("the fabric is right")
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn distance(found: &[f64], exact: &[f64]) -> f64 {
    let gap: Vec<f64> = found.iter().zip(exact).map(|(a, b)| a - b).collect();
    norm(&gap) / norm(exact)
}

#[test]
fn the_grid_gives_the_numbers_of_the_connectors_one_by_one() {
    let (rich, plain) = (fabric(RICH), fabric(PLAIN));
    let wide = Lattice::rectangle(0.6, 0.5, 0.012).expect("a rectangle");
    let narrow = Lattice::rectangle(0.024, 0.3, 0.012).expect("three columns");
    let disc = Lattice::disc(0.1, 0.011).expect("a disc");
    let bias = Lattice::rectangle_at(Grain::from_degrees(33.0), [0.0; 2], [0.2, 0.1], 0.012);
    let bias = bias.expect("a rectangle");
    let cloths: [&[(&Lattice, &Fabric)]; 5] = [
        &[(&wide, &rich)],
        &[(&bias, &rich)],
        &[(&disc, &plain)],
        &[(&narrow, &rich)],
        &[(&disc, &rich), (&narrow, &plain), (&wide, &plain)],
    ];
    for (which, panels) in cloths.into_iter().enumerate() {
        let cloth = Cloth::new(panels);
        let mut random = Random(3);
        // Waves that come and go, and a shake of a few hundredths of the spacing.
        let mut place = |shake: f64, time: f64| -> Vec<f64> {
            let wave = |&[u, v]: &[f64; 2]| {
                let height = 0.02 * (1.0 + 0.5 * time) * (20.0 * u + 13.0 * v + time).sin();
                [u * (1.0 + 0.01 * time), v + 0.05 * time * u, height]
            };
            let flat = cloth.coordinates().iter().flat_map(wave);
            flat.map(|x| x + shake * random.next()).collect()
        };
        let mut state = cloth.state(place(0.0, 0.0)).expect("it fits");
        let start = (state.positions.as_slice(), state.normals());
        let mut reference = Reference::new(panels, cloth.pattern(), start);
        let rest = vec![0.0; 3 * cloth.particles()];
        for step in 0..6 {
            let time = f64::from(step % 4) * 0.3;
            let positions = place(4e-4, time);
            let before = reference.potential(&state.positions);
            let work =
                cloth.potential(&state, &positions) - cloth.potential(&state, &state.positions);
            let exact = reference.potential(&positions) - before;
            assert!(
                (work - exact).abs() < TOLERANCE * exact.abs(),
                "cloth {which}, step {step}: work {work}, one by one {exact}"
            );
            let lost = cloth.commit(&mut state, &positions, &rest).dissipated;
            let exact = reference.commit(&positions, state.normals());
            assert!(
                (lost - exact).abs() < TOLERANCE * exact.abs(),
                "cloth {which}, step {step}: lost {lost}, one by one {exact}"
            );
            let trial = place(4e-4, time + 0.1);
            let (mut found, mut exact) = (rest.clone(), rest.clone());
            cloth.add_forces(&state, &trial, &mut found);
            reference.add_forces(&trial, &mut exact);
            let error = distance(&found, &exact);
            assert!(error < TOLERANCE, "cloth {which}, step {step}: forces {error:e}");
            for definite in [false, true] {
                let (mut found, mut exact) = (
                    vec![0.0; 9 * cloth.pattern().blocks()],
                    vec![0.0; 9 * cloth.pattern().blocks()],
                );
                cloth.add_stiffness(&state, &trial, definite, &mut found);
                reference.add_stiffness(&trial, definite, &mut exact);
                let error = distance(&found, &exact);
                assert!(
                    error < TOLERANCE,
                    "cloth {which}, step {step}, definite {definite}: stiffness {error:e}"
                );
            }
        }
    }
}
