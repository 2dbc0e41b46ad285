//! scratch
use drape_fabric::Fabric;
use drape_validate::drapemeter::*;
use std::path::Path;
#[test]
#[ignore]
fn scratch() {
    let path = std::env::var("FABRIC").unwrap();
    let h: f64 = std::env::var("H").map_or(0.005, |s| s.parse().unwrap());
    let n: u64 = std::env::var("N").map_or(3, |s| s.parse().unwrap());
    let mut fabric = Fabric::read(Path::new(&path)).unwrap();
    if std::env::var("ELASTIC").is_ok() {
        fabric = elastic(&fabric);
    }
    println!("{path} bound {:.2} mm h {h}", 1e3 * spacing_bound(&fabric));
    let mut all = Vec::new();
    for seed in 1..=n {
        let start = std::time::Instant::now();
        match Drapemeter::FRL.drape(&fabric, (h, seed)) {
            Ok(d) => {
                println!(
                    "  seed {seed}: DC {:.2} nodes {} steps {} in {:.1} s amps {:?}",
                    100.0 * d.coefficient,
                    d.nodes,
                    d.steps,
                    start.elapsed().as_secs_f64(),
                    d.amplitudes[..10].iter().map(|a| (1e4 * a).round() / 10.0).collect::<Vec<_>>()
                );
                all.push(100.0 * d.coefficient);
            }
            Err(e) => println!("  seed {seed}: {e} in {:.1}", start.elapsed().as_secs_f64()),
        }
    }
    let m = all.iter().sum::<f64>() / all.len() as f64;
    println!(
        "  mean {m:.2} sd {:.2}",
        (all.iter().map(|x| (x - m).powi(2)).sum::<f64>() / (all.len() as f64 - 1.0)).sqrt()
    );
}
