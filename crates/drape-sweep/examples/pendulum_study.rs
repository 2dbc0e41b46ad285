//! A study of a pendulum: the points are run by this program, and collected in a table.
//!
//! `cargo run --example pendulum_study -p drape-sweep`
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::f64::consts::{PI, TAU};

use drape_input::Document;
use drape_sweep::{Keep, Outcome, PointStorage, Record, Study, Table, main_effect};

/// Standard gravity, in m/s².
const GRAVITY: f64 = 9.806_65;

/// Scene of the pendulum, which only this program understands.
const PENDULUM: &str = "length = 1.0\nangle = 10\n";

const STUDY: &str = r#"
scene = "pendulum.toml"
[[axis]]
key = "length"
range = { start = 0.25, end = 4.0, count = 3, scale = "log" }
[[axis]]
key = "angle"
values = [10, 90, 170]
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    std::fs::write(folder.path().join("pendulum.toml"), PENDULUM)?;
    let study = Study::from_document(&Document::new(folder.path().join("study.toml"), STUDY))?
        .with_output(folder.path().join("out"));
    let points = study.points("pendulum 1.0", None)?;
    assert_eq!(points.len(), 9);

    // A point that has a record is done: a study that was interrupted goes on where it was.
    for point in &points {
        let storage = PointStorage::new(&study, point);
        let Some(lock) = storage.lock()? else { continue };
        if storage.record().is_none() {
            let [length, angle] = [0, 1].map(|axis| point.levels[axis].parse::<f64>());
            let period = period(length?, angle?.to_radians());
            std::fs::create_dir_all(storage.folder())?;
            storage.write_summary(format!("{{ \"period\": {period} }}").as_bytes())?;
            let record = Record {
                key: point.key.clone(),
                outcome: Outcome::Done,
                exit_code: Some(0),
                retries: 0,
                seconds: 0.0,
                message: String::new(),
                summary: None,
            };
            storage.finish(&record, Keep::Measures)?;
        }
        lock.remove();
    }

    let table = Table::collect(&study, &points);
    println!("{}", String::from_utf8(table.to_csv()?)?);

    // Over all angles, a pendulum of 16 times the length takes 4 times as long.
    let column = |name: &str| table.columns().find(|column| column.name == name);
    let (length, period) = column("length").zip(column("measures.period")).ok_or("no column")?;
    let effect = main_effect(length, period);
    let means: Vec<f64> = effect.means.iter().flatten().map(|mean| mean.value).collect();
    assert_eq!(effect.levels, ["0.25", "1", "4"]);
    assert!((means[2] / means[0] - 4.0).abs() < 1e-12, "{means:?}");
    println!("mean periods of {:?} m: {means:.3?} s", effect.levels);
    Ok(())
}

/// Returns the period, in s, of a pendulum of a `length`, in m, that swings up to `angle`, in rad:
/// the period of small angles over the arithmetic-geometric mean of 1 and the cosine of half the
/// angle (Gauss).
fn period(length: f64, angle: f64) -> f64 {
    assert!(angle < PI, "the pendulum would stand on its head");
    let (mut arithmetic, mut geometric) = (1.0, (0.5 * angle).cos());
    while arithmetic - geometric > 1e-15 {
        (arithmetic, geometric) = (0.5 * (arithmetic + geometric), (arithmetic * geometric).sqrt());
    }
    TAU * (length / GRAVITY).sqrt() / arithmetic
}
