//! The cloth on its grid against its connectors one by one.

use drape_cloth::{Cloth, Grain, Lattice, ReferenceCloth};
use drape_fabric::Fabric;

use crate::panels::{RICH, fabric};
use crate::shaken::{Random, distance};

/// Rounding of a few hundred operations on numbers of the size that is compared with.
const TOLERANCE: f64 = 1e-12;

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
        let cloth = Cloth::new(panels).expect("a cloth");
        let mut random = Random(3);
        // Waves that change with time, and noise of a few hundredths of the spacing.
        let mut place = |shake: f64, time: f64| -> Vec<f64> {
            let wave = |&[u, v]: &[f64; 2]| {
                let height = 0.02 * (1.0 + 0.5 * time) * (20.0 * u + 13.0 * v + time).sin();
                [u * (1.0 + 0.01 * time), v + 0.05 * time * u, height]
            };
            let flat = cloth.coordinates().iter().flat_map(wave);
            flat.map(|x| x + shake * random.next()).collect()
        };
        let mut state = cloth.state(place(0.0, 0.0)).expect("it fits");
        let mut reference = ReferenceCloth::new(panels, &cloth, &state).expect("a cloth");
        let rest = vec![0.0; 3 * cloth.particle_count()];
        for step in 0..6 {
            let time = f64::from(step % 4) * 0.3;
            let positions = place(4e-4, time);
            let before = reference.potential(&state.positions).expect("the lists fit");
            let work = cloth.potential(&state, &positions).expect("the lists fit")
                - cloth.potential(&state, &state.positions).expect("the lists fit");
            let exact = reference.potential(&positions).expect("the lists fit") - before;
            assert!(
                (work - exact).abs() < TOLERANCE * exact.abs(),
                "cloth {which}, step {step}: work {work}, one by one {exact}"
            );
            let lost = cloth.commit(&mut state, &positions, &rest).expect("the lists fit");
            let exact = reference.commit(&positions, state.normals()).expect("the lists fit");
            assert!(
                (lost - exact).abs() < TOLERANCE * exact.abs(),
                "cloth {which}, step {step}: lost {lost}, one by one {exact}"
            );
            let trial = place(4e-4, time + 0.1);
            let (mut found, mut exact) = (rest.clone(), rest.clone());
            cloth.add_forces(&state, &trial, &mut found).expect("the lists fit");
            reference.add_forces(&trial, &mut exact).expect("the lists fit");
            let error = distance(&found, &exact);
            assert!(error < TOLERANCE, "cloth {which}, step {step}: forces {error:e}");
            for definite in [false, true] {
                let (mut found, mut exact) = (
                    vec![0.0; 9 * cloth.sparsity().block_count()],
                    vec![0.0; 9 * cloth.sparsity().block_count()],
                );
                cloth.add_stiffness(&state, &trial, definite, &mut found).expect("the lists fit");
                reference.add_stiffness(&trial, definite, &mut exact).expect("the lists fit");
                let error = distance(&found, &exact);
                assert!(
                    error < TOLERANCE,
                    "cloth {which}, step {step}, definite {definite}: stiffness {error:e}"
                );
            }
        }
    }
}
