//! Drape coefficients against measured ones.

use drape_fabric::Fabric;

use crate::drapemeter::{Drapemeter, Protocol, Study, spacing_bound};
use crate::prior::Prediction;
use crate::sensitivity::{FACTORS, Factor};
use crate::shipped::{COTTON, WOOL, fabric};
use crate::{Axis, Check, Findings, Graph, Layout, Source, Told, ValidationError};

/// Starts of an evaluation, and of each row of the table of what matters.
const STARTS: u64 = 10;
const TABLE_STARTS: u64 = 4;
/// How far a prediction may reach to either side, standard deviation over starts, and difference of spacings and of
/// turns; points.
const HALF_WIDTH: f64 = 8.0;
const DEVIATION: f64 = 3.0;
const CONVERGENCE: f64 = 2.0;
/// The finer spacing, over the one that the fabric asks for; and that of the table of what matters, which is of changes
/// and takes a hundred specimens, at most 5 mm too.
const FINER: f64 = 0.7;
const COARSER: f64 = 1.0 / FINER;

/// A fabric, with its drape coefficient on the FRL meter in % and its nodes, as measured.
type Measured = (&'static str, f64, f64);
const MEASURED: [Measured; 2] = [(COTTON, 82.9, 2.0), (WOOL, 49.8, 5.0)];

fn spacing(fabric: &Fabric, part: f64) -> f64 {
    (part * spacing_bound(fabric)).min(0.005)
}

/// The cotton on the FRL meter, over what its sheet leaves open.
pub fn cotton(told: &Told<'_>) -> Result<Findings, ValidationError> {
    drapemeter(MEASURED[0], told)
}

/// The wool on the FRL meter, over what its sheet leaves open.
pub fn wool(told: &Told<'_>) -> Result<Findings, ValidationError> {
    drapemeter(MEASURED[1], told)
}

fn drapemeter(
    (text, measured, nodes): Measured,
    told: &Told<'_>,
) -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    let mut graphs = Vec::new();
    let meter = Drapemeter::frl();
    let fabric = fabric(text)?;
    let what = |what: &str| format!("{}: {what}", fabric.name);
    let resolution = (spacing(&fabric, 1.0), STARTS);
    let count = STARTS * (1 + Prediction::studies(&fabric));
    let told = || told(count);
    let found = Prediction::of(&meter, &fabric, resolution, &told)?;
    let [low, high] = found.interval().map(|part| 100.0 * part);
    checks.extend([
        Check::told(what("measured drape coefficient, %"), measured),
        Check::told(what("with the shear assumed in the fit, %"), points(&found.fitted)),
        Check::at_most(what("lower end of the prediction, %"), low, measured),
        Check::at_least(what("upper end of the prediction, %"), high, measured),
        Check::at_most(what("half of its width, points"), 0.5 * (high - low), HALF_WIDTH),
    ]);
    graphs.push(shadows(&fabric.name, &meter, &found));
    let elastic = meter.study(&fabric.without_friction(), resolution, &told)?;
    checks.push(Check::told(what("without friction, %"), points(&elastic)));
    checks.push(Check::told(what("nodes as measured"), nodes));
    for (count, times) in found.fitted.nodes() {
        let what = what(&format!("starts of {STARTS} with {count} nodes"));
        checks.push(Check::told(what, times as f64));
    }
    let deviation = what("standard deviation over the starts, points");
    checks.push(Check::at_most(deviation, 100.0 * found.fitted.deviation(), DEVIATION));
    for (parameter, [low, high]) in &found.ends {
        let what = |what: &str| format!("{}, {}: {what}", fabric.name, parameter.name());
        checks.push(Check::told(what("drape coefficient at the limp end, %"), points(low)));
        checks.push(Check::told(what("at the stiff end, %"), points(high)));
    }
    Ok(Findings { checks, graphs, ..Findings::default() })
}

/// The cotton on a finer grid, and on a turned one.
pub fn grid_of_cotton(told: &Told<'_>) -> Result<Findings, ValidationError> {
    grid(COTTON, told)
}

/// The wool on a finer grid, and on a turned one.
pub fn grid_of_wool(told: &Told<'_>) -> Result<Findings, ValidationError> {
    grid(WOOL, told)
}

fn grid(text: &str, told: &Told<'_>) -> Result<Findings, ValidationError> {
    let fabric = fabric(text)?;
    let meter = Drapemeter::frl();
    let turned = Drapemeter { protocol: Protocol { turn: 45.0, ..meter.protocol }, ..meter };
    let spacing = spacing(&fabric, 1.0);
    let told = || told(3 * STARTS);
    let study = |meter: &Drapemeter, spacing: f64| meter.study(&fabric, (spacing, STARTS), &told);
    let asked = study(&meter, spacing)?;
    let what = |what: &str| format!("{}: {what}", fabric.name);
    let mut checks = vec![
        Check::told(what("spacing, mm"), 1e3 * spacing),
        Check::told(what("drape coefficient, %"), points(&asked)),
    ];
    for (other, at) in [
        (study(&meter, FINER * spacing)?, "change at 0.7 of the spacing, points"),
        (study(&turned, spacing)?, "change with the grid turned by 45°, points"),
    ] {
        let change = (points(&other) - points(&asked)).abs();
        checks.push(Check::at_most(what(at), change, CONVERGENCE));
    }
    Ok(checks.into())
}

fn points(study: &Study) -> f64 {
    100.0 * study.mean()
}

/// How far the cotton's drape coefficient changes as one thing changes.
pub fn sensitivity_of_cotton(told: &Told<'_>) -> Result<Findings, ValidationError> {
    sensitivity(COTTON, told)
}

/// How far the wool's drape coefficient changes as one thing changes.
pub fn sensitivity_of_wool(told: &Told<'_>) -> Result<Findings, ValidationError> {
    sensitivity(WOOL, told)
}

fn sensitivity(text: &str, told: &Told<'_>) -> Result<Findings, ValidationError> {
    let fabric = fabric(text)?;
    let resolution = (spacing(&fabric, COARSER), TABLE_STARTS);
    let told = || told(2 * TABLE_STARTS * FACTORS.len() as u64);
    let row = |factor: &Factor| {
        let [low, high] = factor.vary(&Drapemeter::frl(), &fabric, resolution, &told)?;
        let what = format!("{}, {}: change, points", fabric.name, factor.name);
        Ok(Check::told(what, points(&high) - points(&low)))
    };
    Ok(FACTORS.iter().map(row).collect::<Result<Vec<_>, ValidationError>>()?.into())
}

/// The shadows of a start, as fitted and with each open parameter at its ends.
fn shadows(name: &str, meter: &Drapemeter, found: &Prediction) -> Graph {
    let axes = [Axis::new("across", "mm", 1e-3), Axis::new("along", "mm", 1e-3)];
    let mut graph =
        Graph::new(format!("{name}: shadows of a start"), axes).laid_out(Layout::ToScale);
    let mut add = |label: String, study: &Study| {
        let edge = &study.drapes[0].edge;
        let places = (0..=edge.len()).map(|k| on_circle(k, edge.len(), edge[k % edge.len()]));
        graph.add(Source::Traced, label, places.collect());
    };
    add("as fitted".into(), &found.fitted);
    for (parameter, [low, high]) in &found.ends {
        add(format!("{}, limp", parameter.name()), low);
        add(format!("{}, stiff", parameter.name()), high);
    }
    for (label, radius) in [("disc", meter.disc), ("specimen", meter.specimen)] {
        let circle = (0..=180).map(|k| on_circle(k, 180, radius)).collect();
        graph.add(Source::Reference, label, circle);
    }
    graph
}

/// The place at one of so many even angles and a radius.
fn on_circle(number: usize, count: usize, radius: f64) -> [f64; 2] {
    let (sin, cos) = (std::f64::consts::TAU * number as f64 / count as f64).sin_cos();
    [radius * cos, radius * sin]
}
