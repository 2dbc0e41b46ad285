//! Invariants of an evaluation: the bits for any number of threads, and the heap.

use drape_cloth::{Cloth, Lattice, State, Workspace};
use drape_fabric::Fabric;
use drape_input::Document;

const LINEN: &str = r#"
name = "linen"
density = 0.18
thickness = 0.0004
[shear]
stiffness = 40.0
growth = 6.0
friction = [{ plateau = 0.6, length = 0.006 }]
locking = { onset = 0.139, limit = 0.867 }
[warp]
bending = { rigidity = 2.5e-5, friction = [{ plateau = 9e-4, length = 3.0 }] }
[warp.traction]
friction = [{ plateau = 4.0, length = 0.001 }]
primed = { stiffness = 9000.0, toe_ratio = 0.6, toe_strain = 0.02, toe_strain_after = 0.03 }
[weft]
traction.polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
bending.piecewise = { slope = 2e-5, intercept = 4e-4, knot = 40.0 }
"#;

/// A sheet of seven strips and a disc of two or three.
fn cloth() -> Cloth {
    let fabric = Fabric::from_document(&Document::new("linen.toml", LINEN)).expect("it is right");
    let sheet = Lattice::rectangle(1.0, 0.8, 0.01).expect("a rectangle");
    let disc = Lattice::disc(0.2, 0.008).expect("a disc");
    Cloth::new(&[(&sheet, &fabric), (&disc, &fabric)]).expect("a cloth")
}

/// A shape that ripples with time.
fn ripple(cloth: &Cloth, time: f64) -> Vec<f64> {
    let wave = |&[u, v]: &[f64; 2]| {
        let height = 0.01 * (40.0 * u + 23.0 * v + 3.0 * time).sin();
        [u * (1.0 + 0.02 * time.sin()), v + 0.05 * time * u * u, height]
    };
    cloth.coordinates().iter().flat_map(wave).collect()
}

/// Results of an evaluation: state, sum of energies, forces, stiffness.
type Numbers = (State, f64, Vec<f64>, Vec<f64>);

/// Five steps with some trials each.
fn evaluate(cloth: &Cloth, workspace: &mut Workspace, numbers: &mut Numbers, shapes: &[Vec<f64>]) {
    let (state, sum, forces, values) = numbers;
    for pair in shapes.windows(2) {
        for trial in pair {
            workspace
                .add_forces(cloth.trial(state, trial).expect("the lists fit"), forces)
                .expect("the lists fit");
            *sum += workspace
                .potential(cloth.trial(state, trial).expect("the lists fit"))
                .expect("the lists fit");
            workspace
                .add_stiffness(cloth.trial(state, trial).expect("the lists fit"), false, values)
                .expect("the lists fit");
        }
        let rest = &pair[0];
        *sum += workspace.commit(cloth, state, &pair[1], rest).expect("the lists fit");
    }
}

fn numbers(cloth: &Cloth, shapes: &[Vec<f64>]) -> Numbers {
    let state = cloth.state(shapes[0].clone()).expect("it fits");
    let forces = vec![0.0; 3 * cloth.particle_count()];
    (state, 0.0, forces, vec![0.0; 9 * cloth.sparsity().block_count()])
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let cloth = cloth();
    let shapes: Vec<_> = (0..6).map(|k| ripple(&cloth, 0.3 * f64::from(k))).collect();
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads start").install(|| {
            let mut all = numbers(&cloth, &shapes);
            evaluate(&cloth, &mut cloth.workspace(), &mut all, &shapes);
            all
        })
    };
    let alone = run(1);
    assert!(alone.2.iter().all(|force| force.is_finite()));
    for threads in [2, 3, 4] {
        assert!(run(threads) == alone, "with {threads} threads");
    }
}

#[test]
fn a_workspace_allocates_nothing() {
    let cloth = cloth();
    let shapes: Vec<_> = (0..6).map(|k| ripple(&cloth, 0.3 * f64::from(k))).collect();
    let mut all = numbers(&cloth, &shapes);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let mut workspace = pool.expect("a thread starts").install(|| cloth.workspace());
    let used = allocation_counter::measure(|| evaluate(&cloth, &mut workspace, &mut all, &shapes));
    assert_eq!(used.count_total, 0, "{used:?}");
}
