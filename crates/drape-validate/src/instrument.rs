//! The cycles of the KES instruments, and what the laws of a fabric answer to them.

use drape_fabric::{Direction as Laws, Fabric, Law, TractionLaw, drive};
use drape_kes::{Curve, Direction, Test};

/// Load of the standard tensile test: 500 gf/cm in N/m.
pub const LARGEST_TENSION: f64 = 490.3325;
/// Tension of a specimen in the shear test: 10 gf/cm in N/m.
pub const SHEAR_TENSION: f64 = 9.80665;
/// Largest angle of the shear test, in degrees.
const LARGEST_ANGLE: f64 = 8.0;
/// Largest curvature of the bending test, 2.5 1/cm in 1/m.
const LARGEST_CURVATURE: f64 = 250.0;
/// Strain at which a tensile test is given up.
const LARGEST_STRAIN: f64 = 0.5;

/// The deformations that an instrument goes through, in steps of one branch's given part; in the units of a [`Curve`].
pub fn cycle(fabric: &Fabric, test: Test, direction: Direction, points: usize) -> Vec<f64> {
    let turns: &[f64] = match test {
        Test::Tensile => &[0.0, extension(&laws(fabric, direction).traction, LARGEST_TENSION), 0.0],
        Test::Bending | Test::LoopBending => &[0.0, 1.0, -1.0, 1.0].map(|k| k * LARGEST_CURVATURE),
        Test::Shear => &[0.0, 1.0, -1.0, 1.0].map(|k| k * LARGEST_ANGLE.to_radians()),
    };
    let branch = |ends: &[f64]| {
        let [from, to] = [ends[0], ends[1]];
        (1..=points).map(move |i| from + (to - from) * i as f64 / points as f64).collect::<Vec<_>>()
    };
    std::iter::once(turns[0]).chain(turns.windows(2).flat_map(branch)).collect()
}

/// The curve of an instrument that deforms the fabric evenly: the laws alone.
///
/// # Panics
/// If the loads are not finite, which those of a checked fabric are.
pub fn ideal(fabric: &Fabric, test: Test, direction: Direction, points: usize) -> Curve {
    let path = cycle(fabric, test, direction, points);
    let laws = laws(fabric, direction);
    let load = match test {
        Test::Tensile => drive(&laws.traction, laws.traction.virgin(), &path),
        Test::Bending | Test::LoopBending => drive(&laws.bending, laws.bending.virgin(), &path),
        Test::Shear => {
            let sines: Vec<f64> = path.iter().map(|angle| angle.sin()).collect();
            drive(&fabric.shear, fabric.shear.virgin(), &sines)
        }
    };
    curve(test, direction, path, load).expect("a checked fabric has finite loads")
}

/// A curve, of a tensile test up to where the fabric is slack on the way back.
pub(crate) fn curve(
    test: Test,
    direction: Direction,
    mut path: Vec<f64>,
    mut load: Vec<f64>,
) -> Result<Curve, drape_kes::Error> {
    if test == Test::Tensile {
        let points = path.len() / 2;
        let slack = load.iter().skip(points).position(|load| *load <= 0.0);
        let end = slack.map_or(path.len(), |slack| points + slack + 1);
        path.truncate(end);
        load.truncate(end);
    }
    Curve::new(test, direction, path, load)
}

/// The laws of a direction.
pub(crate) fn laws(fabric: &Fabric, direction: Direction) -> &Laws {
    match direction {
        Direction::Warp => &fabric.warp,
        Direction::Weft => &fabric.weft,
    }
}

/// The strain at which a first pull reaches a tension, in N/m.
pub(crate) fn extension(law: &TractionLaw, tension: f64) -> f64 {
    let virgin = law.virgin();
    let (mut low, mut high) = (0.0, LARGEST_STRAIN);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if law.respond(&virgin, middle).load < tension {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
