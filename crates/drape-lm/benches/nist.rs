//! NIST reference problems from both starts: the minimiser alone, standard errors, profiles.

use criterion::{Criterion, criterion_group, criterion_main};
use drape_lm::{Covariance, Loss, MinimiserSettings, ProfileSettings, minimise, profile};

#[path = "../tests/nist/model.rs"]
mod model;
#[path = "../tests/nist/number.rs"]
mod number;
// The certified values are used by the test only.
#[allow(dead_code)]
#[path = "../tests/nist/problem.rs"]
mod problem;

use problem::Nist;

/// Returns the least sum of squares of `problem` from one of its two starts.
fn solve(problem: &Nist, start: usize) -> f64 {
    let parameters = problem.parameters(start);
    minimise(problem, &parameters, &MinimiserSettings::default()).sum
}

fn all_starts(c: &mut Criterion) {
    let mut problems = Nist::all();
    let mut group = c.benchmark_group("nist, 54 starts");
    for (name, exact) in [("differences", false), ("exact derivatives", true)] {
        problems.iter_mut().for_each(|p| p.exact = exact);
        group.bench_function(name, |b| {
            b.iter(|| problems.iter().map(|p| solve(p, 0) + solve(p, 1)).sum::<f64>());
        });
    }
    group.finish();
}

fn uncertainty(c: &mut Criterion) {
    let problem = Nist::all().into_iter().find(|p| p.name == "Hahn1");
    let problem = problem.expect("Hahn1 is one of them");
    let parameters = problem.parameters(1);
    let settings = MinimiserSettings::default();
    let report = minimise(&problem, &parameters, &settings);
    let mut group = c.benchmark_group("Hahn1, 7 parameters, 236 residuals");
    group.bench_function("fit", |b| {
        b.iter(|| minimise(&problem, &parameters, &settings).sum);
    });
    group.bench_function("covariance", |b| {
        b.iter(|| {
            Covariance::new(&problem, &parameters, &report, Loss::Squares).residual_deviation
        });
    });
    group.bench_function("profile", |b| {
        b.iter(|| {
            profile(
                &problem,
                &parameters,
                &report,
                &ProfileSettings { minimiser: settings, ..Default::default() },
            )
            .len()
        });
    });
    group.finish();
}

criterion_group!(benches, all_starts, uncertainty);
criterion_main!(benches);
