//! Loops of simulated instruments.

use drape_kes::{Curve, Direction, Test};

use crate::instrument::{LARGEST_CURVATURE, on_the_bias, on_the_bias_in_cells};
use crate::shipped::{COTTON, CUPRO, fabric};
use crate::tester::{Comparison, bend_on_the_bias, bias_spacing, measure};
use crate::{Axis, Check, Findings, Graph, Source, ValidationError};

/// Points of a branch of a loop.
const POINTS: usize = 50;
/// Spacings, in m, with how far the loop may be off, root mean square over its range.
const SPACINGS: [(f64, f64); 3] = [(0.01, 0.02), (0.005, 0.01), (0.0025, 0.02)];
/// Points of a branch of a specimen on the bias.
const FEW: usize = 25;
/// Curvature times spacing squared, in m, where the shear of cells on the bias adds a hundredth to the moment of the
/// cupro's elastic laws; to that of the cotton's it adds less.
const BIAS_RANGE: f64 = 3e-4;
/// Points of a branch where the area of a loop is wanted: trapezoids then err by a thousandth.
const FINE: usize = 200;
/// How far a KES value may be off.
const VALUE_LIMIT: f64 = 0.02;

/// Deformation and load of a test, as laboratories plot them.
fn axes(test: Test) -> [Axis; 2] {
    match test {
        Test::Tensile => [Axis::new("strain", "%", 0.01), Axis::new("tension", "N/m", 1.0)],
        Test::Bending | Test::LoopBending => {
            [Axis::new("curvature", "1/cm", 100.0), Axis::new("moment per width", "mN", 1e-3)]
        }
        Test::Shear => {
            [Axis::new("angle", "°", 1_f64.to_radians()), Axis::new("shear force", "N/m", 1.0)]
        }
    }
}

/// The points of a curve.
fn points(curve: &Curve) -> Vec<[f64; 2]> {
    curve.deformation().iter().zip(curve.load()).map(|(&q, &load)| [q, load]).collect()
}

/// Every test of two fabrics, along both yarns; at 5 mm with the KES values read from the loops.
pub fn instruments() -> Result<Findings, ValidationError> {
    let mut findings = Findings::default();
    let Findings { checks, graphs, .. } = &mut findings;
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        for test in [Test::Tensile, Test::Bending, Test::Shear] {
            let mut graph = Graph::new(format!("{}, {}", fabric.name, test.name()), axes(test));
            for direction in [Direction::Warp, Direction::Weft] {
                let what = format!("{}, {} {}", fabric.name, test.name(), direction.name());
                for (spacing, limit) in SPACINGS {
                    let found = Comparison::of(&fabric, (test, direction), (spacing, POINTS))?;
                    let millimetres = 1e3 * spacing;
                    let distance = format!("{what}, {millimetres} mm: distance of the loops");
                    checks.push(Check::at_most(distance, found.distance(), limit));
                    if spacing == 0.005 {
                        let label = format!("specimen, {}", direction.name());
                        graph.add(Source::Simulated, label, points(&found.measured));
                        graph.add(Source::Reference, "law", points(&found.ideal));
                        checks.extend(found.values().into_iter().map(|(symbol, [a, b])| {
                            let what = format!("{what}: {} {}", symbol.name(), symbol.unit());
                            Check::within(what, a, b, VALUE_LIMIT)
                        }));
                    }
                }
            }
            graphs.push(graph);
        }
    }
    Ok(findings)
}

/// Bending specimens of two fabrics cut at 45° to their yarns.
///
/// The cells' shear counts as bending when they fold along their diagonals, see [`on_the_bias_in_cells`]; so at the
/// spacings of the other specimens the whole loop is held against the laws in such cells, and against the laws alone
/// where that adds less than a hundredth to the moment: up to a curvature that goes with the inverse of the spacing
/// squared. At a millimetre and a quarter it is a fiftieth at 2.5 cm⁻¹, and the KES values are the laws'.
pub fn bias_bending() -> Result<Findings, ValidationError> {
    let mut checks = Vec::new();
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        for spacing in [0.005, 0.0025] {
            let (millimetres, spacing) = (1e3 * spacing, bias_spacing(spacing));
            let what = format!("{}, {millimetres} mm: distance", fabric.name);
            let of = |largest, ideal| -> Result<Comparison, ValidationError> {
                let measured = bend_on_the_bias(&fabric, largest, (spacing, FEW))?;
                Ok(Comparison { measured, ideal })
            };
            let ideal = on_the_bias_in_cells(&fabric, spacing, LARGEST_CURVATURE, FEW);
            let distance = of(LARGEST_CURVATURE, ideal)?.distance();
            checks.push(Check::at_most(format!("{what} from the laws in cells"), distance, 0.01));
            let largest = BIAS_RANGE / (spacing * spacing);
            let distance = of(largest, on_the_bias(&fabric, largest, FEW))?.distance();
            let what = format!("{what} of the loops up to {:.2} cm⁻¹", 0.01 * largest);
            checks.push(Check::at_most(what, distance, 0.02));
        }
    }
    let fabric = fabric(CUPRO)?;
    let spacing = bias_spacing(0.00125);
    let measured = bend_on_the_bias(&fabric, LARGEST_CURVATURE, (spacing, FEW))?;
    let found = Comparison { measured, ideal: on_the_bias(&fabric, LARGEST_CURVATURE, FEW) };
    let what = format!("{}, 1.25 mm", fabric.name);
    checks.push(Check::at_most(format!("{what}: distance of the loops"), found.distance(), 0.01));
    checks.extend(found.values().into_iter().map(|(symbol, [a, b])| {
        Check::within(format!("{what}: {} {}", symbol.name(), symbol.unit()), a, b, VALUE_LIMIT)
    }));
    Ok(checks.into())
}

/// Energy that a bent specimen loses in a cycle, and the curvature that it keeps, against the closed forms for a linear
/// rigidity beside a Dahl element of plateau `$F$` and length `$\ell$`: the steady loop between `$\pm\kappa$` loses
/// `$4F(\kappa - \ell\tanh(\kappa/\ell))$`, and its unloading branch is
/// `$M = B\kappa' - F + 2F e^{(\kappa' - \kappa)/\ell}/(1 + e^{-2\kappa/\ell})$`.
pub fn bending_hysteresis() -> Result<Findings, ValidationError> {
    let mut findings = Findings::default();
    let Findings { checks, graphs, .. } = &mut findings;
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        let law = fabric.weft.bending;
        let rigidity = law.backbone.respond(0.0).tangent;
        let element = law.friction.elements[0];
        let (plateau, length) = (element.plateau, element.length);
        let curve = measure(&fabric, Test::Bending, Direction::Weft, (0.005, FINE))?;
        let top = curve.deformation_range().high;
        let what = |what: &str| format!("{}: {what}", fabric.name);
        let lost = 4.0 * plateau * (top - length * (top / length).tanh());
        let found = steady_area(&curve);
        checks.push(Check::within(what("energy lost in a cycle, J/m²"), found, lost, 0.02));
        let turned = 2.0 * plateau / (1.0 + (-2.0 * top / length).exp());
        let moment = |k: f64| rigidity * k - plateau + turned * ((k - top) / length).exp();
        let kept = root(moment, (0.0, top));
        let found = -kept_curvature(&curve);
        checks.push(Check::within(what("curvature kept after bending, 1/m"), found, kept, 0.02));
        let mut graph = Graph::new(what("bent to both sides"), axes(Test::Bending));
        graph.add(Source::Traced, "specimen", points(&curve));
        // The unloading branch, and the reloading one that is its image.
        let branch = |sign: f64| {
            let at = |k: u32| sign * top * (1.0 - f64::from(k) / 60.0);
            (0..=120).map(|k| [at(k), sign * moment(sign * at(k))]).collect()
        };
        graph.add(Source::Reference, "closed form", branch(1.0));
        graph.add(Source::Reference, "closed form", branch(-1.0));
        graphs.push(graph);
    }
    Ok(findings)
}

/// Area of the loop between the curve's last two branches, which are steady.
fn steady_area(curve: &Curve) -> f64 {
    let branches = curve.branches();
    let steady = branches[branches.len() - 2].points.start..branches[branches.len() - 1].points.end;
    let (q, load) = (&curve.deformation()[steady.clone()], &curve.load()[steady]);
    let halves =
        q.windows(2).zip(load.windows(2)).map(|(q, f)| 0.5 * (f[0] + f[1]) * (q[1] - q[0]));
    halves.sum()
}

/// Where the last branch crosses the line of no load.
fn kept_curvature(curve: &Curve) -> f64 {
    let branches = curve.branches();
    let last = branches[branches.len() - 1].points.clone();
    let (q, load) = (&curve.deformation()[last.clone()], &curve.load()[last]);
    let crossing = load.windows(2).position(|pair| pair[0] <= 0.0 && pair[1] > 0.0);
    crossing.map_or(f64::NAN, |k| q[k] - load[k] * (q[k + 1] - q[k]) / (load[k + 1] - load[k]))
}

/// Root of a rising function, by halving.
pub(crate) fn root(function: impl Fn(f64) -> f64, (mut low, mut high): (f64, f64)) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if function(middle) < 0.0 { low = middle } else { high = middle }
    }
    low
}
