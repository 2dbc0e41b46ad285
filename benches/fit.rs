//! Identification of whole fabrics. Times are processor times over all threads, which is the cost
//! of a batch.

use std::hint::black_box;
use std::time::Duration;

use criterion::measurement::{Measurement, ValueFormatter, WallTime};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use drape::fabric::{
    BendingBackbone, BendingLaw, BlimanSorine, Buckling, Law, Primed, ShearBackbone, ShearLaw,
    TractionBackbone, TractionLaw, drive,
};
use drape::fit::{
    FitSettings, FrictionOrder, LoopModel, Plateau, Toe, TractionModel, identify_with,
};
use drape::kes::{Curve, Direction, Sheet, Test};
use rustix::time::{ClockId, clock_gettime};

/// Points of each curve.
const POINTS: usize = 200;
/// Standard deviation of the noise over the range of the load.
const NOISE: f64 = 0.01;

/// Processor time of the whole process.
struct Processor(WallTime);

fn now() -> Duration {
    let time = clock_gettime(ClockId::ProcessCPUTime);
    Duration::new(time.tv_sec.unsigned_abs(), u32::try_from(time.tv_nsec).unwrap_or(0))
}

impl Measurement for Processor {
    type Intermediate = Duration;
    type Value = Duration;

    fn start(&self) -> Duration {
        now()
    }
    fn end(&self, start: Duration) -> Duration {
        now() - start
    }
    fn add(&self, a: &Duration, b: &Duration) -> Duration {
        *a + *b
    }
    fn zero(&self) -> Duration {
        Duration::ZERO
    }
    fn to_f64(&self, value: &Duration) -> f64 {
        self.0.to_f64(value)
    }
    fn formatter(&self) -> &dyn ValueFormatter {
        self.0.formatter()
    }
}

/// Random numbers, the same on every machine (SplitMix64).
struct Random(u64);

impl Random {
    /// Returns a uniform deviate from 0 to 1.
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a normal deviate, by Box and Muller's method.
    fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }
}

/// A test of a specimen.
struct Protocol<'a> {
    test: Test,
    direction: Direction,
    /// Deformations at which the test begins, reverses and ends.
    reversals: &'a [f64],
}

/// Returns the noisy curve of a law in a test, with [`POINTS`] points in even steps.
fn curve(protocol: &Protocol<'_>, law: &impl Law, random: &mut Random) -> Curve {
    let &Protocol { test, direction, reversals } = protocol;
    let length: f64 = reversals.windows(2).map(|ends| (ends[1] - ends[0]).abs()).sum();
    let mut q = vec![reversals[0]];
    for ends in reversals.windows(2) {
        let part = (ends[1] - ends[0]).abs() / length;
        let steps = (part * (POINTS - 1) as f64).round();
        q.extend((1..=steps as usize).map(|i| ends[0] + (ends[1] - ends[0]) * i as f64 / steps));
    }
    let sines: Vec<f64> = q.iter().map(|angle| angle.sin()).collect();
    let mut load = drive(law, law.virgin(), if test == Test::Shear { &sines } else { &q });
    let range = |(low, high): (f64, f64), f: &f64| (low.min(*f), high.max(*f));
    let (low, high) = load.iter().fold((f64::INFINITY, f64::NEG_INFINITY), range);
    load.iter_mut().for_each(|f| *f += NOISE * (high - low) * random.normal());
    Curve::new(test, direction, q, load).expect("a curve of a law")
}

/// Returns tensile, shear and bending curves of a shirting, warp and weft.
fn sheet(seed: u64) -> Sheet {
    let mut random = Random(seed);
    let mut sheet = Sheet::default();
    sheet.name = "shirting".into();
    (sheet.w, sheet.t) = (Some(12.0), Some(0.3));
    for (direction, factor) in [(Direction::Warp, 1.0), (Direction::Weft, 0.6)] {
        let traction = TractionLaw {
            backbone: TractionBackbone::Primed(Primed {
                stiffness: 1.4e4 * factor,
                toe_ratio: 0.62,
                toe_strain: 0.016,
                toe_strain_after: 0.021,
            }),
            friction: BlimanSorine::first_order(18.0, 0.0012).expect("a friction").into(),
            buckling: Buckling::default(),
        };
        let shear = ShearLaw {
            backbone: ShearBackbone::Linear { stiffness: 40.0 },
            friction: BlimanSorine::first_order(0.5, 0.005).expect("a friction"),
            growth: 5.0,
            locking: None,
        };
        let bending = BendingLaw {
            backbone: BendingBackbone::Linear { rigidity: 8e-6 * factor },
            rest_curvature: 0.0,
            friction: BlimanSorine::first_order(3e-4, 9.0).expect("a friction"),
        };
        let reversals = &[0.0, 0.05, 0.0];
        let tensile = Protocol { test: Test::Tensile, direction, reversals };
        sheet.curves.push(curve(&tensile, &traction, &mut random));
        let reversals = &[0.0, 8.0, -8.0, 0.0].map(f64::to_radians);
        let shearing = Protocol { test: Test::Shear, direction, reversals };
        sheet.curves.push(curve(&shearing, &shear, &mut random));
        let reversals = &[0.0, 250.0, -250.0, 0.0];
        let bends = Protocol { test: Test::Bending, direction, reversals };
        sheet.curves.push(curve(&bends, &bending, &mut random));
    }
    sheet
}

/// Returns settings with one law for each test, so that none is chosen.
fn given() -> FitSettings {
    FitSettings {
        traction: Some(TractionModel::Primed),
        toe: Some(Toe::Moving),
        bending: Some(LoopModel::Linear(FrictionOrder::First)),
        shear: Some(LoopModel::Linear(FrictionOrder::First)),
        plateau: Some(Plateau::Growing),
        ..FitSettings::default()
    }
}

fn fits(criterion: &mut Criterion<Processor>) {
    let sheets: Vec<Sheet> = (0..16).map(|i| sheet(i << 32)).collect();
    let mut group = criterion.benchmark_group("fabric of six curves");
    group.sample_size(20).measurement_time(Duration::from_secs(3));
    group.throughput(Throughput::Elements(1));
    for (name, settings) in [("laws chosen", FitSettings::default()), ("laws given", given())] {
        let mut cycle = sheets.iter().cycle();
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let sheet = cycle.next().expect("a cycle has no end");
                identify_with(black_box(sheet), &settings).expect("identified")
            });
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().with_measurement(Processor(WallTime));
    targets = fits
}
criterion_main!(benches);
