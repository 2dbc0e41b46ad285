//! Kernels of the cloth, each against the connectors one by one through the scalar laws in the same
//! run. Times are per call; the element of the throughput is a particle.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use drape::cloth::{Cloth, Lattice, ReferenceCloth, State, Trial, Workspace};
use drape::fabric::{
    BendingBackbone, BendingLaw, BlimanSorine, Buckling, ExponentialToe, Fabric, Locking, Primed,
    ProportionalFriction, SURFACE_FRICTION, ShearBackbone, ShearLaw, TractionBackbone,
    TractionFriction, TractionLaw, YarnLaws,
};
use rayon::ThreadPoolBuilder;

/// Particles along a side of the square sheet.
const SIDES: [usize; 6] = [20, 50, 70, 100, 141, 200];

/// Returns a law of traction with a priming zone and a plateau of friction.
fn primed() -> TractionLaw {
    TractionLaw {
        backbone: TractionBackbone::Primed(Primed {
            stiffness: 5000.0,
            toe_ratio: 0.6,
            toe_strain: 0.015,
            toe_strain_after: 0.02,
        }),
        friction: BlimanSorine::first_order(3.0, 0.001).expect("a friction").into(),
        buckling: Buckling::default(),
    }
}

/// Returns a law of traction with an exponential toe and friction in proportion to the tension.
fn exponential() -> TractionLaw {
    let toe = ExponentialToe {
        base_stiffness: 200.0,
        stiffness: 5000.0,
        steepness: 2.0,
        toe_strain: 0.015,
        toe_strain_after: 0.02,
    };
    let friction = ProportionalFriction { ratio: 0.3, plateau: 0.5, length: 0.001 };
    TractionLaw {
        buckling: Buckling { strain: friction.buckling_strain(&toe), ..Buckling::default() },
        backbone: TractionBackbone::Exponential(toe),
        friction: TractionFriction::Proportional(friction),
    }
}

/// Returns a fabric of 200 g/m² with friction in every law.
fn fabric(traction: TractionLaw) -> Fabric {
    let direction = |rigidity: f64| YarnLaws {
        traction,
        bending: BendingLaw {
            backbone: BendingBackbone::Linear { rigidity },
            rest_curvature: 0.0,
            friction: BlimanSorine::first_order(4e-4, 10.0).expect("a friction"),
        },
    };
    Fabric {
        name: "hung".into(),
        source: String::new(),
        density: 0.2,
        thickness: 3e-4,
        pressed_thickness: None,
        compression_linearity: None,
        surface_friction: SURFACE_FRICTION,
        warp: direction(1.0e-5),
        weft: direction(1.2e-5),
        shear: ShearLaw {
            backbone: ShearBackbone::Linear { stiffness: 56.0 },
            friction: BlimanSorine::first_order(0.4, 0.006).expect("a friction"),
            growth: 6.0,
            locking: Some(Locking::default()),
        },
        provenance: None,
    }
}

/// A square metre that hangs in folds, after two steps, with the shape of the next step as trial.
struct Sheet {
    cloth: Cloth,
    state: State,
    reference: ReferenceCloth,
    trial: Vec<f64>,
}

impl Sheet {
    fn new(side: usize, traction: TractionLaw) -> Self {
        let fabric = fabric(traction);
        let spacing = 1.0 / (side - 1) as f64;
        let lattice = Lattice::rectangle(1.0, 1.0, spacing).expect("a square");
        let panels = [(&lattice, &fabric)];
        let cloth = Cloth::new(&panels).expect("a cloth");
        // Strains of some tenths of a per cent of either sign and a shear of some degrees.
        let shape = |time: f64| -> Vec<f64> {
            let fold = |&[u, v]: &[f64; 2]| {
                let ripple = 0.004 * (9.0 * u - 14.0 * v + time).sin();
                let depth = 0.02 * (1.0 + 0.02 * time) * (12.0 * u + 3.0 * v).sin();
                [0.985 * u + 0.05 * u * v, v + 0.2 * ripple * u, depth + ripple]
            };
            lattice.coordinates().iter().flat_map(fold).collect()
        };
        let mut state = cloth.state(shape(0.0)).expect("it fits");
        let mut reference = ReferenceCloth::new(&panels, &cloth, &state).expect("a cloth");
        let rest = vec![0.0; 3 * cloth.particle_count()];
        for time in [0.1, 0.2] {
            cloth.commit(&mut state, &shape(time), &rest).expect("the lists fit");
            reference.commit(&shape(time), state.normals()).expect("the lists fit");
        }
        Self { trial: shape(0.3), cloth, state, reference }
    }

    fn particle_count(&self) -> usize {
        self.cloth.particle_count()
    }

    fn trial(&self) -> Trial<'_> {
        self.cloth.trial(&self.state, &self.trial).expect("the lists fit")
    }

    /// Returns a workspace for a number of threads.
    fn workspace(&self, threads: usize) -> Workspace {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads start").install(|| self.cloth.workspace())
    }
}

type Group<'a> = BenchmarkGroup<'a, WallTime>;

/// Benches one kernel at every size: on the grid with one thread and with all, and connector by
/// connector.
fn compare(
    criterion: &mut Criterion,
    name: &str,
    grid: impl Fn(&mut Group<'_>, BenchmarkId, &Sheet, Workspace),
    reference: impl Fn(&mut Group<'_>, BenchmarkId, &Sheet),
) {
    let mut group = criterion.benchmark_group(name);
    group
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1000));
    for side in SIDES {
        let sheet = Sheet::new(side, primed());
        group.throughput(Throughput::Elements(sheet.particle_count() as u64));
        let id = |name: &str| BenchmarkId::new(name, side);
        grid(&mut group, id("grid"), &sheet, sheet.workspace(1));
        let all = rayon::current_num_threads();
        let name = format!("grid, {all} threads");
        grid(&mut group, id(&name), &sheet, sheet.workspace(all));
        reference(&mut group, id("one by one"), &sheet);
    }
    group.finish();
}

fn forces(criterion: &mut Criterion) {
    compare(
        criterion,
        "forces",
        |group, id, sheet, mut workspace| {
            let mut forces = vec![0.0; 3 * sheet.particle_count()];
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    workspace.add_forces(sheet.trial(), &mut forces).expect("the lists fit");
                });
            });
        },
        |group, id, sheet| {
            let mut forces = vec![0.0; 3 * sheet.particle_count()];
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    sheet.reference.add_forces(&sheet.trial, &mut forces).expect("the lists fit")
                });
            });
        },
    );
}

fn potential(criterion: &mut Criterion) {
    compare(
        criterion,
        "potential",
        |group, id, sheet, mut workspace| {
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    let potential = workspace.potential(sheet.trial()).expect("the lists fit");
                    black_box(potential)
                });
            });
        },
        |group, id, sheet| {
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    black_box(sheet.reference.potential(&sheet.trial).expect("the lists fit"))
                });
            });
        },
    );
}

fn stiffness(criterion: &mut Criterion) {
    compare(
        criterion,
        "stiffness",
        |group, id, sheet, mut workspace| {
            let mut values = vec![0.0; 9 * sheet.cloth.sparsity().block_count()];
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    workspace
                        .add_stiffness(sheet.trial(), false, &mut values)
                        .expect("the lists fit");
                });
            });
        },
        |group, id, sheet| {
            let mut values = vec![0.0; 9 * sheet.cloth.sparsity().block_count()];
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    sheet
                        .reference
                        .add_stiffness(&sheet.trial, false, &mut values)
                        .expect("the lists fit")
                });
            });
        },
    );
}

/// Benches commits there and back: two steps per call.
fn commit(criterion: &mut Criterion) {
    compare(
        criterion,
        "commit there and back",
        |group, id, sheet, mut workspace| {
            let (mut state, start) = (sheet.state.clone(), sheet.state.positions.clone());
            let rest = vec![0.0; 3 * sheet.particle_count()];
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    for shape in [&sheet.trial, &start] {
                        workspace
                            .commit(&sheet.cloth, &mut state, shape, &rest)
                            .expect("the lists fit");
                    }
                });
            });
        },
        |group, id, sheet| {
            let (mut reference, normals) = (sheet.reference.clone(), sheet.state.normals());
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    for shape in [&sheet.trial, &sheet.state.positions] {
                        black_box(reference.commit(shape, normals).expect("the lists fit"));
                    }
                });
            });
        },
    );
}

/// Benches forces and tangents of a sheet with each law of traction, one thread.
fn laws(criterion: &mut Criterion) {
    const SIDE: usize = 100;
    let mut group = criterion.benchmark_group("laws of traction");
    group.sample_size(50).measurement_time(Duration::from_secs(3));
    for (name, traction) in [("priming zone", primed()), ("exponential toe", exponential())] {
        let sheet = Sheet::new(SIDE, traction);
        let mut workspace = sheet.workspace(1);
        let mut forces = vec![0.0; 3 * sheet.particle_count()];
        group.bench_function(BenchmarkId::new("forces", name), |bencher| {
            bencher.iter(|| {
                workspace.add_forces(sheet.trial(), &mut forces).expect("the lists fit");
            });
        });
        let mut values = vec![0.0; 9 * sheet.cloth.sparsity().block_count()];
        group.bench_function(BenchmarkId::new("stiffness", name), |bencher| {
            bencher.iter(|| {
                workspace.add_stiffness(sheet.trial(), false, &mut values).expect("the lists fit");
            });
        });
    }
    group.finish();
}

criterion_group!(kernels, laws, forces, potential, stiffness, commit);
criterion_main!(kernels);
