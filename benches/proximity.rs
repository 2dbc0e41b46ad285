//! Distance and time of impact of two wavy grids, and the barrier energy of a sheet on a floor.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use drape::collide::{
    ContactDistances, Detector, Gap, Pair, PlainMesh, ProximityMesh, Surface, SurfaceParts,
    earliest_impact, mesh_distance,
};
use rayon::ThreadPoolBuilder;

/// Vertices along a side of a square grid of 1 m.
const SIDES: [u32; 3] = [30, 100, 300];

/// Tolerance of the times of impact.
const TOLERANCE: f64 = 1e-6;

/// Distance beyond the activation distance within which pairs are detected, in m.
const MARGIN: f64 = 1e-5;

/// Grid of a mesh.
struct Grid {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Grid {
    /// Returns a grid of `side`² vertices with waves of the `phase`, at `height`.
    fn new(side: u32, phase: f64, height: f64) -> Grid {
        let place = |k: u32| f64::from(k) / f64::from(side - 1);
        let positions = (0..side * side).map(|k| {
            let (x, z) = (place(k % side), place(k / side));
            [x, height + 0.05 * ((9.0 * x + phase).sin() + (7.0 * z - phase).cos()), z]
        });
        let cells = (0..(side - 1) * (side - 1)).map(|k| k / (side - 1) * side + k % (side - 1));
        Grid {
            positions: positions.collect(),
            triangles: cells
                .flat_map(|a| [[a, a + 1, a + side], [a + 1, a + side + 1, a + side]])
                .collect(),
        }
    }

    /// Returns the mesh of this grid.
    fn mesh(&self) -> ProximityMesh {
        ProximityMesh::new(&self.positions, &self.triangles).expect("a mesh")
    }

    /// Returns this grid for contact.
    fn plain(&self) -> PlainMesh<'_> {
        PlainMesh { positions: &self.positions, triangles: &self.triangles }
    }
}

fn meshes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("meshes");
    group
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1000));
    for side in SIDES {
        let (low, high) = (Grid::new(side, 0.0, 0.0), Grid::new(side, 2.0, 0.3));
        let ends: Vec<_> = high.positions.iter().map(|[x, y, z]| [*x, y - 0.4, *z]).collect();
        let (first, second) = (low.mesh(), high.mesh());
        group.bench_function(BenchmarkId::new("tree", side * side), |bencher| {
            bencher.iter(|| black_box(low.mesh()));
        });
        group.bench_function(BenchmarkId::new("distance", side * side), |bencher| {
            bencher.iter(|| black_box(mesh_distance(&first, &second)));
        });
        group.bench_function(BenchmarkId::new("time of impact", side * side), |bencher| {
            bencher.iter(|| {
                let falls = second.moving_to(&ends).expect("a motion");
                black_box(earliest_impact(&first.at_rest(), &falls, TOLERANCE).expect("an answer"))
            });
        });
    }
    group.finish();
}

fn barrier(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("barrier");
    group.sample_size(20).measurement_time(Duration::from_millis(1000));
    // Half of a millimetre between two equal waves: all vertices are near the other grid.
    let (low, high) = (Grid::new(60, 0.0, 0.0), Grid::new(60, 0.0, 5e-4));
    let half = ContactDistances { activation_distance: 5e-4, min_separation: 1e-5 };
    let parts = SurfaceParts::from_meshes(&[low.plain(), high.plain()], &[], half);
    let surface = Surface::new(parts.expect("parts")).expect("a surface");
    let positions = [low.positions.as_flattened(), high.positions.as_flattened()].concat();
    let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let mut detector = Detector::default();
    group.bench_function("detection", |bencher| {
        let mut detect = || {
            let pairs = detector.detect(&surface, &positions, MARGIN).expect("near pairs");
            black_box(pairs.as_slice().len())
        };
        pool.install(|| bencher.iter(&mut detect));
    });
    let pairs = detector.detect(&surface, &positions, MARGIN).expect("near pairs").as_slice();
    let gap = |pair| Gap::new(pair, &positions).expect("positions");
    group.bench_function("distance", |bencher| {
        let distance = |pair: &Pair| pair.distance_at(&positions).expect("positions");
        bencher.iter(|| pairs.iter().map(distance).sum::<f64>());
    });
    group.bench_function("energy", |bencher| {
        bencher.iter(|| pairs.iter().map(|pair| gap(pair).energy(1e8)).sum::<f64>());
    });
    group.bench_function("gradient", |bencher| {
        bencher.iter(|| pairs.iter().map(|pair| gap(pair).gradient(1e8)[0]).sum::<f64>());
    });
    group.finish();
}

criterion_group!(benches, meshes, barrier);
criterion_main!(benches);
