//! The shear law from KES values alone, such that the law has those values.

use drape_fabric::{BlimanSorine, Law, Locking, ShearBackbone, ShearLaw, drive};
use drape_kes::{Curve, Direction, ShearPoints, Test};

use crate::assumed::SHEAR_SLIP;
use crate::fabric_values::shear_angles;
use crate::strokes::{Element, Strokes};

/// Longest pre-sliding length of shear friction, a sine: that of the whole test. A longer one is a stiffness.
const LONGEST_SHEAR_SLIP: f64 = 0.139;
/// Largest growth of a plateau that a fabric may have.
const LARGEST_GROWTH: f64 = 1e3;

/// Halvings when looking for a length: as many as a double has bits to give.
const HALVINGS: usize = 60;

/// The shear law that has the values G (in N/(m·rad)), 2HG and 2HG5 (in N/m), read at the given points.
///
/// For a given pre-sliding length the values are linear in the stiffness `$k_s$`, the plateau `$F_c$` and its
/// growth `$F_c\gamma$`: three values, three equations. The length itself is assumed, except for a loop that
/// narrows (2HG5 < 2HG): a plateau cannot shrink, and the length at which friction has not yet slipped out of
/// the reversal at 8° gives such a loop.
///
/// Returned with the law is the largest deviation of its values from those asked for, relative: nothing but
/// rounding, except for loops that widen more than tenfold or narrow to less than 0.63, where the mean of both
/// widths is taken.
pub fn shear_from_values(
    stiffness: f64,
    widths: [f64; 2],
    points: &ShearPoints,
) -> (ShearLaw, f64) {
    let unit = ShearUnits::new(points);
    let with = |length: f64| unit.solve((stiffness, widths), length);
    let [narrow, wide] = widths;
    if let Some(law) = with(SHEAR_SLIP).filter(|law| law.growth >= 0.0) {
        return (law, unit.deviation(&law, (stiffness, widths)));
    }
    // The loop narrows the more the longer the length.
    let (mut short, mut long) = (SHEAR_SLIP, LONGEST_SHEAR_SLIP);
    let ratio = |length: f64| {
        let [_, [narrow, wide], _] = unit.of(length).map(|[_, narrow, wide]| [narrow, wide]);
        wide / narrow
    };
    let wanted = wide / narrow;
    if wanted < ratio(short) && wanted > ratio(long) {
        for _ in 0..HALVINGS {
            let middle = (short * long).sqrt();
            if ratio(middle) > wanted {
                short = middle;
            } else {
                long = middle;
            }
        }
        if let Some(law) = unit.constant((stiffness, widths), long) {
            return (law, unit.deviation(&law, (stiffness, widths)));
        }
    }
    let mean = 0.5 * (narrow + wide);
    let law = unit.constant((stiffness, [mean; 2]), SHEAR_SLIP);
    let law = law.unwrap_or_else(|| shear_law(stiffness, 0.0, (0.5 * mean, SHEAR_SLIP)));
    (law, unit.deviation(&law, (stiffness, widths)))
}

fn shear_law(stiffness: f64, growth: f64, (plateau, length): (f64, f64)) -> ShearLaw {
    ShearLaw {
        backbone: ShearBackbone::Linear { stiffness },
        friction: BlimanSorine::first_order(plateau, length),
        growth,
        locking: Some(Locking::default()),
    }
}

/// The values G, 2HG and 2HG5 of the parts of a shear law.
struct ShearUnits<'a> {
    points: &'a ShearPoints,
    angles: Vec<f64>,
    strokes: Strokes,
    sines: Vec<f64>,
}

impl<'a> ShearUnits<'a> {
    fn new(points: &'a ShearPoints) -> Self {
        let angles = shear_angles(points);
        let sines: Vec<f64> = angles.iter().map(|angle| angle.sin()).collect();
        Self { points, strokes: Strokes::new(&sines), angles, sines }
    }

    fn read(&self, load: Vec<f64>) -> [f64; 3] {
        let curve = Curve::new(Test::Shear, Direction::Warp, self.angles.clone(), load);
        let values = curve.and_then(|curve| curve.shear_values(self.points));
        values.map_or([f64::NAN; 3], |v| [v.stiffness, v.loop_width, v.wide_loop_width])
    }

    /// Those of a stiffness of one, a plateau of one, and a plateau of the size of the sine.
    fn of(&self, length: f64) -> [[f64; 3]; 3] {
        let Element { constant, grown, .. } = self.strokes.element(length);
        [self.sines.clone(), constant, grown].map(|load| self.read(load))
    }

    /// The law with these values and a plateau that grows; nothing where there is none.
    fn solve(&self, (stiffness, [narrow, wide]): (f64, [f64; 2]), length: f64) -> Option<ShearLaw> {
        let [line, constant, grown] = self.of(length);
        let determinant = constant[1] * grown[2] - constant[2] * grown[1];
        let plateau = (narrow * grown[2] - wide * grown[1]) / determinant;
        let rise = (constant[1] * wide - constant[2] * narrow) / determinant;
        let linear = (stiffness - plateau * constant[0] - rise * grown[0]) / line[0];
        if narrow == 0.0 && wide == 0.0 {
            return (linear > 0.0).then(|| shear_law(linear, 0.0, (0.0, length)));
        }
        let growth = rise / plateau;
        let possible = plateau > 0.0 && growth <= LARGEST_GROWTH && linear > 0.0;
        // A loop of even width has a growth of some rounding.
        let growth = if growth.abs() < f64::EPSILON.sqrt() { 0.0 } else { growth };
        possible.then(|| shear_law(linear, growth, (plateau, length)))
    }

    /// The law with a stiffness and the narrow width, and a plateau that does not grow.
    fn constant(&self, (stiffness, widths): (f64, [f64; 2]), length: f64) -> Option<ShearLaw> {
        let [line, constant, _] = self.of(length);
        let plateau = widths[0] / constant[1];
        let linear = (stiffness - plateau * constant[0]) / line[0];
        (linear > 0.0).then(|| shear_law(linear, 0.0, (plateau, length)))
    }

    /// Largest deviation of a law's values from others, relative.
    fn deviation(&self, law: &ShearLaw, (stiffness, [narrow, wide]): (f64, [f64; 2])) -> f64 {
        let found = self.read(drive(law, law.virgin(), &self.sines));
        let pairs = found.into_iter().zip([stiffness, narrow, wide]);
        let off = |(found, wanted): (f64, f64)| {
            if found == wanted { 0.0 } else { (found / wanted - 1.0).abs() }
        };
        pairs.map(off).fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values of a law along a finely drawn cycle, which shares nothing with the search.
    fn values(law: &ShearLaw) -> [f64; 3] {
        const STEPS: usize = 4000;
        let turns = [0.0, 8.0, -8.0, 8.0].map(f64::to_radians);
        let mut angles = vec![0.0];
        for ends in turns.windows(2) {
            let at = |i: usize| ends[0] + (ends[1] - ends[0]) * i as f64 / STEPS as f64;
            angles.extend((1..=STEPS).map(at));
        }
        let sines: Vec<f64> = angles.iter().map(|angle| angle.sin()).collect();
        let load = drive(law, law.virgin(), &sines);
        let curve = Curve::new(Test::Shear, Direction::Warp, angles, load).unwrap();
        let v = curve.shear_values(&ShearPoints::default()).unwrap();
        [v.stiffness, v.loop_width, v.wide_loop_width]
    }

    #[test]
    fn the_shear_law_gives_its_values_back() {
        let points = ShearPoints::default();
        for widths in [[0.5, 1.4], [0.98, 1.0], [1.0, 1.0], [0.5, 2.5], [1.0, 0.8], [0.3, 0.2]] {
            let (law, deviation) = shear_from_values(33.7, widths, &points);
            assert!(deviation < 1e-9, "{widths:?}: {deviation}");
            for (found, exact) in values(&law).into_iter().zip([33.7, widths[0], widths[1]]) {
                // Interpolation on 0.004° of a bend with radius x_f: (h/x_f)²/8 = 5e-5 of its share.
                let error = (found / exact - 1.0).abs();
                assert!(error < 1e-5, "{widths:?}: {found} where {exact} was asked for");
            }
        }
    }

    #[test]
    fn a_loop_that_no_friction_has_gets_the_mean_width_and_says_so() {
        let points = ShearPoints::default();
        for widths in [[1.0, 0.4], [0.1, 2.0]] {
            let (law, deviation) = shear_from_values(33.7, widths, &points);
            assert_eq!(law.growth, 0.0);
            let mean = 0.5 * (widths[0] + widths[1]);
            let exact = (mean / widths[0] - 1.0).abs().max((mean / widths[1] - 1.0).abs());
            assert!((deviation / exact - 1.0).abs() < 1e-3, "{widths:?}: {deviation} not {exact}");
            assert!((2.0 * law.friction.plateau() / mean - 1.0).abs() < 1e-3, "{law:?}");
        }
    }
}
