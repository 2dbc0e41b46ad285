//! Contact of surfaces: detection of near pairs, their energies, the step filter and the exact
//! intersection test, for a flat sheet and for one that hangs in folds over a ball.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use drape::collide::{
    Body, CcdFilter, ContactDistances, Detector, Gap, Pose, Shape, Surface, SurfaceParts,
    intersections,
};
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Particles along a side of the square sheet.
const SIDES: [usize; 3] = [50, 100, 200];

const SPACING: f64 = 5e-3;

/// Half the thickness of a cloth of 0.6 mm, and half of its thickness under load.
const DISTANCES: ContactDistances =
    ContactDistances { activation_distance: 3e-4, min_separation: 1e-4 };

/// Distance beyond the activation distance within which pairs are detected, in m.
const MARGIN: f64 = 6e-4;

struct Sheet {
    surface: Surface,
    positions: Vec<f64>,
}

impl Sheet {
    /// Returns a sheet, with a ball of 0.4 of its width under it if it is draped.
    fn new(side: usize, draped: bool) -> Sheet {
        let half = 0.5 * SPACING * (side - 1) as f64;
        let vertices = side * side;
        let place = |v: usize| [v % side, v / side].map(|k| SPACING * k as f64 - half);
        let mut parts = SurfaceParts {
            rest_positions: (0..vertices).flat_map(|v| [place(v)[0], 0.0, place(v)[1]]).collect(),
            triangles: grid(side),
            areas: vec![SPACING * SPACING; vertices],
            groups: vec![0; vertices],
            distances: vec![DISTANCES; 2],
            free_vertices: vertices,
            seam_pairs: Vec::new(),
            ties: Vec::new(),
        };
        let mut positions = parts.rest_positions.clone();
        if draped {
            let radius = 0.4 * half;
            // The facets of a ball lie inside it, so the cloth is just out of contact.
            let over = radius + 3e-4;
            positions = (0..vertices).flat_map(|v| drape(place(v), over)).collect();
            let ball = Body::new("ball", Shape::Sphere { radius }, Pose::default());
            let ball = ball.triangulate().expect("a ball");
            parts.areas.extend(vec![0.0; ball.vertices.len()]);
            parts.groups.extend(vec![1; ball.vertices.len()]);
            parts.rest_positions.extend(ball.vertices.as_flattened());
            positions.extend(ball.vertices.as_flattened());
            let first = vertices as u32;
            parts.triangles.extend(ball.triangles.iter().map(|t| t.map(|v| first + v)));
        }
        Sheet { surface: Surface::new(parts).expect("a surface"), positions }
    }

    /// Returns displacements of some tenths of a millimetre of each cloth vertex, up and down.
    fn displacements(&self) -> Vec<f64> {
        let free = 3 * self.surface.free_count();
        let ripple = |(k, x): (usize, &f64)| if k < free { 3e-4 * (900.0 * x).sin() } else { 0.0 };
        self.positions.iter().enumerate().map(ripple).collect()
    }
}

/// Returns two triangles per cell, with alternating diagonals.
fn grid(side: usize) -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for cell in 0..side * (side - 1) {
        if cell % side == side - 1 {
            continue;
        }
        let [a, b, c, d] = [0, 1, side + 1, side].map(|k| (cell + k) as u32);
        let even = (cell % side + cell / side).is_multiple_of(2);
        triangles.extend(if even { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
    }
    triangles
}

/// Drapes a point over a ball to its equator, and from there down in folds whose depth grows.
fn drape([u, v]: [f64; 2], radius: f64) -> [f64; 3] {
    let (length, azimuth) = ((u * u + v * v).sqrt(), v.atan2(u));
    let polar = (length / radius).min(std::f64::consts::FRAC_PI_2);
    let below = length - radius * polar;
    let out = radius * polar.sin() + 0.25 * below * (1.0 + (10.0 * azimuth).cos());
    [out * azimuth.cos(), radius * polar.cos() - below, out * azimuth.sin()]
}

/// Returns a pool of one thread and one of all.
fn pools() -> [(&'static str, ThreadPool); 2] {
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    [("one thread", pool(1)), ("all threads", pool(0))]
}

fn contact(criterion: &mut Criterion) {
    for (shape, draped) in [("flat", false), ("draped", true)] {
        let sheets = SIDES.map(|side| (side * side, Sheet::new(side, draped)));
        let mut group = criterion.benchmark_group(shape);
        group
            .sample_size(20)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_millis(1000));
        for (particles, Sheet { surface, positions }) in &sheets {
            group.throughput(Throughput::Elements(*particles as u64));
            for (threads, pool) in pools() {
                let id = |what: &str| BenchmarkId::new(format!("{what} ({threads})"), particles);
                let mut detector = Detector::default();
                group.bench_function(id("detect"), |bencher| {
                    let detect = || {
                        let pairs = detector.detect(surface, positions, MARGIN);
                        black_box(pairs.expect("near pairs").as_slice().len());
                    };
                    pool.install(|| bencher.iter(detect));
                });
                group.bench_function(id("intersections"), |bencher| {
                    let test =
                        || black_box(intersections(surface, positions).expect("a test").len());
                    pool.install(|| bencher.iter(test));
                });
            }
        }
        group.finish();
    }
}

fn pairs(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("per pair");
    group
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1000));
    let sheet = Sheet::new(200, true);
    let (positions, displacements) = (&sheet.positions, sheet.displacements());
    let mut detector = Detector::default();
    let pairs = detector.detect(&sheet.surface, positions, MARGIN).expect("near pairs");
    let list = pairs.as_slice();
    group.throughput(Throughput::Elements(list.len() as u64));
    // The baseline of all others: every other computation of a pair needs its distance.
    group.bench_function("distance", |bencher| {
        bencher.iter(|| {
            list.iter().map(|pair| pair.distance_at(positions).expect("positions")).sum::<f64>()
        });
    });
    group.bench_function("gradient", |bencher| {
        let gradient = |pair| Gap::new(pair, positions).expect("positions").gradient(1e8)[0];
        bencher.iter(|| list.iter().map(gradient).sum::<f64>());
    });
    group.bench_function("hessian", |bencher| {
        let hessian = |pair| Gap::new(pair, positions).expect("positions").hessian(1e8)[0][0];
        bencher.iter(|| list.iter().map(hessian).sum::<f64>());
    });
    let mut filter = CcdFilter::default();
    let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    group.bench_function("common fraction", |bencher| {
        let mut fraction = || {
            let fraction = filter.common_fraction(pairs, positions, &displacements);
            fraction.expect("a fraction").value
        };
        pool.install(|| bencher.iter(&mut fraction));
    });
    group.bench_function("truncation", |bencher| {
        let mut truncate = || {
            let mut shortened = displacements.clone();
            filter.truncate(pairs, positions, &mut shortened).expect("a truncation").shortened
        };
        pool.install(|| bencher.iter(&mut truncate));
    });
    group.finish();
}

criterion_group!(benches, contact, pairs);
criterion_main!(benches);
