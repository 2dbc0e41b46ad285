//! Steps of a square metre that swings, hung from two corners, by the solver of the scenes and by
//! named baselines. A figure is the mean of a few steps in the middle of the first swing, on one
//! thread.

use std::fs::write;
use std::time::{Duration, Instant};

use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use drape::dynamics::{Scheme, Simulation};
use drape::implicit::{InitialMatrix, LinearSolver, Method, Settings};
use drape::scene::Scene;

/// Particles along a side of the square sheet.
const SIDES: [usize; 6] = [20, 50, 70, 100, 141, 200];

/// Side of the largest sheet that is solved by factorisation too: a larger one takes minutes.
const LARGEST_FACTORISED: usize = 100;

/// Time at which the measured steps begin, in s: the sheet has begun to fold.
const START: f64 = 0.15;

/// Number of measured steps.
const STEPS: u32 = 4;

/// Length of a step, in s.
const STEP: f64 = 0.005;

/// Length of a step with which textbook Broyden converges, in s.
const SHORT_STEP: f64 = 0.001;

/// Side of the sheet for which it does.
const SMALL_SIDE: usize = 20;

/// Returns the default method and its baselines.
fn methods() -> [(&'static str, Settings); 3] {
    let newton = Settings { method: Method::Newton, ..Settings::default() };
    let factorised = Settings { linear_solver: LinearSolver::Cholesky, ..newton.clone() };
    [("broyden", Settings::default()), ("newton", newton), ("newton-cholesky", factorised)]
}

fn textbook(initial: InitialMatrix) -> Settings {
    let max_iterations = 2000;
    Settings { method: Method::Textbook { initial }, max_iterations, ..Settings::default() }
}

/// Returns the sheet at the beginning of the measured steps.
fn sheet(side: usize, step: f64, settings: &Settings) -> Simulation {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let fabric = r#"
        name = "hung"
        density = 0.2
        thickness = 0.0003
        shear = { stiffness = 56.0, growth = 6.0, friction = [{ plateau = 0.4, length = 0.006 }], locking = { onset = 0.139, limit = 0.867 } }
        [warp.traction]
        friction = [{ plateau = 3.0, length = 0.001 }]
        primed = { stiffness = 5000.0, toe_ratio = 0.6, toe_strain = 0.015, toe_strain_after = 0.02 }
        [warp.bending]
        rigidity = 1.0e-5
        friction = [{ plateau = 4e-4, length = 10.0 }]
        [weft.traction]
        friction = [{ plateau = 3.0, length = 0.001 }]
        primed = { stiffness = 5000.0, toe_ratio = 0.6, toe_strain = 0.015, toe_strain_after = 0.02 }
        [weft.bending]
        rigidity = 1.2e-5
        friction = [{ plateau = 4e-4, length = 10.0 }]
    "#;
    let scene = format!(
        r#"
        name = "swing"
        spacing = {}
        fabric.main.file = "fabric.toml"
        time = {{ step = {step}, end = 1.0 }}
        output.every = 0.5
        contact.surfaces = false
        [[panel]]
        name = "cloth"
        fabric = "main"
        rectangle = [1.0, 1.0]
        turn = [-90, 0, 0]
        noise = {{ amplitude = 1e-4, seed = 1 }}
        [[pin]]
        panel = "cloth"
        points = [[0, 1], [1, 1]]
        "#,
        1.0 / (side - 1) as f64
    );
    let file = folder.path().join("scene.toml");
    write(folder.path().join("fabric.toml"), fabric).expect("a file");
    write(&file, scene).expect("a file");
    let scene = Scene::read(&file).expect("a right scene");
    let scheme = Scheme::Implicit(settings.clone());
    let mut sheet = Simulation::with_scheme(scene, scheme).expect("a solver");
    while sheet.time() < START {
        sheet.step().expect("it converges");
    }
    sheet
}

/// Returns the time of one step, times a number.
fn time(count: u64, mut sheet: Simulation) -> Duration {
    let start = Instant::now();
    for _ in 0..STEPS {
        sheet.step().expect("it converges");
    }
    start.elapsed().mul_f64(count as f64 / f64::from(STEPS))
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step of 5 ms");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.warm_up_time(Duration::from_millis(1)).measurement_time(Duration::from_millis(1));
    for side in SIDES {
        group.throughput(Throughput::Elements((side * side) as u64));
        for (name, settings) in methods() {
            if settings.linear_solver == LinearSolver::Cholesky && side > LARGEST_FACTORISED {
                continue;
            }
            group.bench_function(BenchmarkId::new(name, side), |bencher| {
                bencher.iter_custom(|count| time(count, sheet(side, STEP, &settings)));
            });
        }
    }
    group.finish();
    let mut group = criterion.benchmark_group("step of 1 ms");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.warm_up_time(Duration::from_millis(1)).measurement_time(Duration::from_millis(1));
    group.throughput(Throughput::Elements((SMALL_SIDE * SMALL_SIDE) as u64));
    let methods = [
        ("broyden", Settings::default()),
        ("textbook-diagonal", textbook(InitialMatrix::Diagonal)),
        ("textbook-mass", textbook(InitialMatrix::Mass)),
    ];
    for (name, settings) in methods {
        group.bench_function(BenchmarkId::new(name, SMALL_SIDE), |bencher| {
            bencher.iter_custom(|count| time(count, sheet(SMALL_SIDE, SHORT_STEP, &settings)));
        });
    }
    group.finish();
}

fn one_thread(criterion: &mut Criterion) {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the first pool");
    steps(criterion);
}

criterion_group!(benches, one_thread);
criterion_main!(benches);
