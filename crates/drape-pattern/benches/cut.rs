//! Cutting of a shirt: outlines, lattice and rim of eight panels with eighteen seams.

use criterion::{Criterion, criterion_group, criterion_main};
use drape_pattern::{Cutter, Pattern};

fn shirt(c: &mut Criterion) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns/shirt.json");
    let pattern = Pattern::read(path).expect("the pattern is sound");
    let mut group = c.benchmark_group("shirt");
    group.sample_size(20);
    for spacing in [0.015, 0.01, 0.005] {
        group.bench_function(format!("{} mm", 1000.0 * spacing), |b| {
            b.iter(|| Cutter::new(spacing).cut(&pattern).expect("it can be cut"));
        });
    }
    group.finish();
}

criterion_group!(benches, shirt);
criterion_main!(benches);
