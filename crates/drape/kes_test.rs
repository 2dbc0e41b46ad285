//! The KES tests done on the laws of a fabric.

use drape::fabric::{Fabric, Law, TractionLaw, drive};
use drape::kes::{Curve, Direction, Test};

/// Points of a branch of a loop; enough for the trapezoids of WT to be right to a hundred-thousandth.
const POINTS: usize = 400;
/// Load of the standard tensile test: 500 gf/cm in N/m.
const LARGEST_TENSION: f64 = 490.3325;
/// Largest angle of the shear test, in degrees.
const LARGEST_ANGLE: f64 = 8.0;
/// Largest curvature of the bending test, 2.5 1/cm in 1/m.
const LARGEST_CURVATURE: f64 = 250.0;
/// Strain at which a tensile test is given up.
const LARGEST_STRAIN: f64 = 0.5;

/// The curve that an instrument would draw of a fabric.
pub(crate) fn curve(fabric: &Fabric, test: Test, direction: Direction) -> Curve {
    let laws = match direction {
        Direction::Warp => &fabric.warp,
        Direction::Weft => &fabric.weft,
    };
    let (deformation, load) = match test {
        Test::Tensile => {
            let top = extension(&laws.traction);
            let path = path(&[0.0, top, 0.0]);
            let load = drive(&laws.traction, laws.traction.virgin(), &path);
            let slack = load.iter().skip(POINTS).position(|load| *load <= 0.0);
            let end = slack.map_or(path.len(), |slack| POINTS + slack + 1);
            (path[..end].to_vec(), load[..end].to_vec())
        }
        Test::Bending | Test::LoopBending => {
            let k = LARGEST_CURVATURE;
            let path = path(&[0.0, k, -k, k]);
            let load = drive(&laws.bending, laws.bending.virgin(), &path);
            (path, load)
        }
        Test::Shear => {
            let angle = LARGEST_ANGLE.to_radians();
            let path = path(&[0.0, angle, -angle, angle]);
            let sines: Vec<f64> = path.iter().map(|angle| angle.sin()).collect();
            let load = drive(&fabric.shear, fabric.shear.virgin(), &sines);
            (path, load)
        }
    };
    Curve::new(test, direction, deformation, load).expect("a checked fabric has finite loads")
}

/// The strain at which a first pull reaches the largest tension.
fn extension(law: &TractionLaw) -> f64 {
    let virgin = law.virgin();
    let (mut low, mut high) = (0.0, LARGEST_STRAIN);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if law.respond(&virgin, middle).load < LARGEST_TENSION {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// A history that goes from one turn to the next in even steps.
fn path(turns: &[f64]) -> Vec<f64> {
    let branch = |ends: &[f64]| {
        let [from, to] = [ends[0], ends[1]];
        (1..=POINTS).map(move |i| from + (to - from) * i as f64 / POINTS as f64).collect::<Vec<_>>()
    };
    std::iter::once(turns[0]).chain(turns.windows(2).flat_map(branch)).collect()
}
