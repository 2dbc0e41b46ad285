//! KES values of a fabric's laws, beside those of the sheet and of its curves.

use drape_fabric::{Fabric, Law, TractionLaw, drive};
use drape_kes::{Curve, Direction, Reading, ShearPoints, Sheet, Symbol, Test, Values};

use crate::Settings;

/// Points of each branch of a simulated pull, whose areas are trapezoids: they err by 1e-6 of the work.
const PULL_POINTS: usize = 1000;
/// Reach of the bending test, in 1/m, and of the shear test, in rad.
pub(crate) const BENDING_REACH: f64 = 250.0;
pub(crate) const SHEAR_REACH: f64 = 8.0 * std::f64::consts::PI / 180.0;
/// Strain up to which a law may reach the largest load of the tensile test, a ratio.
const LARGEST_EXTENSION: f64 = 10.0;
/// Halvings when looking for the strain at a load: as many as a double has bits to give.
const HALVINGS: usize = 60;
/// Disagreement of two values, relative, that is worth a word.
///
/// Specimens of one fabric differ by as much; more is another specimen, another evaluation, or a unit.
const DISAGREEMENT: f64 = 0.05;

/// The KES values of one direction of a fabric, in the laboratory's units.
///
/// Each test is simulated with the fabric's laws from rest, bending and shear to one side, the other, and the
/// first again, and read as [`Curve::values`] reads measured curves. A value that the law does not have is
/// left out: those of a fabric that never reaches the load of the tensile test.
#[must_use]
pub fn fabric_values(fabric: &Fabric, direction: Direction, reading: &Reading) -> Values {
    let laws = match direction {
        Direction::Warp => &fabric.warp,
        Direction::Weft => &fabric.weft,
    };
    let pull = pull(&laws.traction, reading.maximum_tension);
    let [low, high] = reading.bending.slope;
    let bend = cycle(&[low, high, reading.bending.width], BENDING_REACH);
    let bend = curve(Test::Bending, &laws.bending, bend);
    let shear = curve(Test::Shear, &fabric.shear, shear_angles(&reading.shear));
    let mut values = Values::default();
    for curve in [pull, bend, shear].into_iter().flatten() {
        for (symbol, value) in curve.values(reading) {
            *values.get_mut(symbol) = value.ok();
        }
    }
    values
}

/// The angles of a shear test that passes the points where values are read.
pub(crate) fn shear_angles(points: &ShearPoints) -> Vec<f64> {
    let [low, high] = points.slope;
    cycle(&[low, high, points.width, points.wide], SHEAR_REACH)
}

/// From rest to one side, the other, and back, with a point wherever a value is read.
///
/// Laws are exact over any distance, so nothing is needed between these points.
fn cycle(read: &[f64], reach: f64) -> Vec<f64> {
    let mut points: Vec<f64> = read.iter().map(|q| q.abs()).collect();
    points.push(read.iter().fold(reach, |reach, q| reach.max(q.abs())));
    points.sort_by(f64::total_cmp);
    points.dedup();
    let (up, down) = (points.clone(), points.iter().rev().copied());
    let below = up.iter().map(|q| -q).rev();
    let mut path = vec![0.0];
    path.extend(&up);
    path.extend(down.clone().skip(1).chain(up.iter().map(|q| -q)));
    path.extend(below.skip(1).chain(up.iter().copied()));
    path
}

/// One pull to a load and back, if the law reaches it.
fn pull(law: &TractionLaw, maximum: f64) -> Option<Curve> {
    let virgin = law.virgin();
    let short = |strain: f64| law.respond(&virgin, strain).load < maximum;
    let (mut low, mut high) = (0.0, LARGEST_EXTENSION);
    if short(high) {
        return None;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if short(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    let at = |i: usize| high * i as f64 / PULL_POINTS as f64;
    let strain = (0..=PULL_POINTS).map(at).chain((0..PULL_POINTS).rev().map(at));
    curve(Test::Tensile, law, strain.collect())
}

/// The curve that an instrument would draw of a law.
fn curve(test: Test, law: &impl Law, deformation: Vec<f64>) -> Option<Curve> {
    let load = match test {
        Test::Shear => {
            let sines: Vec<f64> = deformation.iter().map(|angle| angle.sin()).collect();
            drive(law, law.virgin(), &sines)
        }
        _ => drive(law, law.virgin(), &deformation),
    };
    Curve::new(test, Direction::Warp, deformation, load).ok()
}

/// One KES value from three sides, in the laboratory's unit.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueRow {
    /// The direction.
    pub direction: Direction,
    /// The value.
    pub symbol: Symbol,
    /// As the sheet prints it.
    pub sheet: Option<f64>,
    /// As the first curve of its test and direction has it, or why it cannot be had from a curve.
    pub curve: Result<f64, String>,
    /// As the identified law has it.
    pub law: Option<f64>,
}

impl ValueRow {
    /// A warning where the sheet and the curve disagree by more than 5 %, in words.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        let (sheet, curve) = (self.sheet?, *self.curve.as_ref().ok()?);
        let apart = (curve / sheet - 1.0).abs();
        let (direction, symbol) = (self.direction.name(), self.symbol.name());
        (apart > DISAGREEMENT || !apart.is_finite()).then(|| {
            format!(
                "{direction} {symbol}: the sheet says {sheet:.4} {unit}, its curve {curve:.4}; the law \
                 follows the curve",
                unit = self.symbol.unit()
            )
        })
    }
}

/// All KES values of a fabric beside those of its sheet and of the sheet's curves.
#[must_use]
pub fn compare_values(sheet: &Sheet, fabric: &Fabric, settings: &Settings) -> Vec<ValueRow> {
    let reading = settings.reading(sheet);
    let rows = |direction: Direction| {
        let law = fabric_values(fabric, direction, &reading);
        let measured = |symbol: Symbol| {
            let test = symbol.test();
            let curve = sheet.curves_of(test, direction).next();
            let curve = curve.ok_or_else(|| format!("no {} curve was measured", test.name()))?;
            let found = curve.values(&reading).into_iter().find(|(other, _)| *other == symbol);
            let (_, value) = found.expect("a curve has the values of its test");
            value.map_err(|error| error.to_string())
        };
        let row = move |symbol: Symbol| ValueRow {
            direction,
            symbol,
            sheet: sheet.values(direction).get(symbol),
            curve: measured(symbol),
            law: law.get(symbol),
        };
        Symbol::ALL.into_iter().map(row).collect::<Vec<_>>()
    };
    [Direction::Warp, Direction::Weft].into_iter().flat_map(rows).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_passes_every_point_both_ways_on_both_sides() {
        let path = cycle(&[0.5, 2.5, 0.5, 5.0], 8.0);
        assert_eq!(
            path,
            [
                0.0, 0.5, 2.5, 5.0, 8.0, 5.0, 2.5, 0.5, -0.5, -2.5, -5.0, -8.0, -5.0, -2.5, -0.5,
                0.5, 2.5, 5.0, 8.0
            ]
        );
    }

    #[test]
    fn a_disagreement_of_more_than_one_in_twenty_is_named() {
        let row = |sheet: f64, curve: f64| ValueRow {
            direction: Direction::Warp,
            symbol: Symbol::TwoHb,
            sheet: Some(sheet),
            curve: Ok(curve),
            law: None,
        };
        assert_eq!(row(0.05, 0.052).warning(), None);
        let warning = row(0.05, 0.06).warning().unwrap();
        assert!(warning.starts_with("warp 2HB: the sheet says 0.0500 gf·cm/cm"), "{warning}");
        assert!(row(0.0, 0.06).warning().is_some());
    }
}
