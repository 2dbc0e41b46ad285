//! Many sheets at once: the result of each as if alone, a bad sheet does not stop the others,
//! memory does not grow.

#![allow(clippy::print_stdout)]

mod random;

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Law, drive};
use drape_fit::{Error, FitSettings, identify, identify_all};
use drape_kes::{Curve, Direction, Sheet, Test, Values};
use random::Random;

/// Sheet with tensile values and two noisy bending loops of 200 points; a bad one has an impossible
/// resilience.
fn sheet(seed: u64, good: bool) -> Sheet {
    let mut random = Random(seed << 32);
    let mut sheet = Sheet::default();
    sheet.name = format!("fabric {seed}");
    sheet.w = Some(10.0 + 20.0 * random.unit());
    let rt = if good { 60.0 } else { 130.0 };
    sheet.warp = Values { em: Some(4.0), lt: Some(0.7), rt: Some(rt), ..Values::default() };
    for direction in [Direction::Warp, Direction::Weft] {
        let law = BendingLaw {
            backbone: BendingBackbone::Linear { rigidity: 1e-5 * (0.5 + random.unit()) },
            rest_curvature: 0.0,
            friction: BlimanSorine::first_order(3e-4, 5.0 + 20.0 * random.unit())
                .expect("a friction"),
        };
        let steps = |from: f64, to: f64, n: u32| {
            (1..=n).map(move |i| from + (to - from) * f64::from(i) / f64::from(n))
        };
        let out = steps(0.0, 250.0, 50).chain(steps(250.0, -250.0, 100));
        let q: Vec<f64> = out.chain(steps(-250.0, 0.0, 50)).collect();
        let mut load = drive(&law, law.virgin(), &q);
        load.iter_mut().for_each(|m| *m += 1e-4 * (random.unit() - 0.5));
        let curve = Curve::new(Test::Bending, direction, q, load).expect("a curve of a law");
        sheet.curves.push(curve);
    }
    sheet
}

#[test]
fn each_fabric_of_a_batch_is_as_if_alone_and_a_bad_one_stops_nothing() {
    let seeds: Vec<u64> = (0..40).collect();
    let good = |seed: u64| seed % 7 != 3;
    let summaries = identify_all(
        &seeds,
        &FitSettings::default(),
        |&seed| Ok::<_, Error>(sheet(seed, good(seed))),
        |&seed, result| (seed, result.map(|fitted| fitted.fit.clone()).map_err(|e| e.to_string())),
    );
    assert_eq!(summaries.len(), seeds.len());
    for (place, (seed, summary)) in summaries.into_iter().enumerate() {
        assert_eq!(seed, place as u64);
        match summary {
            Ok(fit) => assert_eq!(fit, identify(&sheet(seed, true)).expect("identified")),
            Err(message) => assert!(!good(seed) && message.contains("RT is 130.0 %"), "{message}"),
        }
    }
}

/// Returns the peak memory of the process, in kB.
fn peak_memory() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").expect("Linux");
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).expect("a peak");
    line.split_whitespace().nth(1).and_then(|kb| kb.parse().ok()).expect("a number of kB")
}

#[test]
#[ignore = "ten thousand sheets take a minute, and it reads the memory of the process from Linux"]
fn ten_thousand_sheets_take_the_memory_of_a_few() {
    let mut peaks = Vec::new();
    for count in [100, 1000, 10_000] {
        let seeds: Vec<u64> = (0..count).collect();
        let misfits = identify_all(
            &seeds,
            &FitSettings::default(),
            |&seed| Ok::<_, Error>(sheet(seed, true)),
            |_, result| result.map_or(f64::NAN, |fitted| fitted.fit.curves[0].misfit),
        );
        assert!(misfits.iter().all(|misfit| *misfit < 0.03), "{misfits:?}");
        peaks.push(peak_memory());
        println!("{count} sheets: peak {} kB", peaks[peaks.len() - 1]);
    }
    // The list of seeds and summaries is 160 kB; the allocator's pools take some more.
    assert!(peaks[2] < peaks[0] + 4096, "{peaks:?} kB");
}
