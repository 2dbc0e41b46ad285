//! The KES values of a sheet, of its curves and of a fabric, side by side.

use drape::fabric::Fabric;
use drape::kes::{Curve, Direction, Sheet, Test};
use drape::report::{KesValue, Units};

use crate::{kes_test, quantity};

/// The values of one direction from curves, in SI, in the order of [`rows`].
type Recomputed = [Option<f64>; 9];

/// Symbol, words and units of each value.
fn rows() -> [(&'static str, &'static str, Units); 9] {
    [
        ("B", "bending rigidity", quantity::rigidity()),
        ("2HB", "bending loop width", quantity::moment()),
        ("G", "shear stiffness", quantity::shear_stiffness()),
        ("2HG", "shear loop width at 0.5°", quantity::tension()),
        ("2HG5", "shear loop width at 5°", quantity::tension()),
        ("EM", "extension at the largest load", quantity::percent()),
        ("WT", "tensile work", quantity::work()),
        ("LT", "tensile linearity", quantity::ratio()),
        ("RT", "tensile resilience", quantity::percent()),
    ]
}

/// The values that a sheet or its curves give for a direction, with those of the fitted fabric.
pub(crate) fn of_sheet(sheet: &Sheet, fabric: &Fabric, direction: Direction) -> Vec<KesValue> {
    let given = sheet.values(direction);
    let given = [
        given.bending_rigidity(),
        given.bending_loop_width(),
        given.shear_stiffness(),
        given.shear_loop_width(),
        given.shear_loop_width_at_five_degrees(),
        given.tensile_extension(),
        given.tensile_work(),
        given.tensile_linearity(),
        given.tensile_resilience(),
    ];
    let curves = recomputed(|test| sheet.curves_of(test, direction).next().cloned());
    let law = recomputed(|test| Some(kes_test::curve(fabric, test, direction)));
    let known = |value: &KesValue| value.sheet.is_some() || value.curve.is_some();
    table(direction, [given, curves, law]).into_iter().filter(known).collect()
}

/// The values of a fabric in a direction.
pub(crate) fn of_fabric(fabric: &Fabric, direction: Direction) -> Vec<KesValue> {
    let law = recomputed(|test| Some(kes_test::curve(fabric, test, direction)));
    table(direction, [[None; 9], [None; 9], law])
}

fn table(direction: Direction, [sheet, curve, law]: [Recomputed; 3]) -> Vec<KesValue> {
    let row = |(index, (symbol, name, units)): (usize, (&str, &str, Units))| KesValue {
        symbol: symbol.into(),
        name: name.into(),
        direction: direction.name().into(),
        units,
        sheet: sheet[index],
        curve: curve[index],
        law: law[index],
    };
    rows().into_iter().enumerate().map(row).collect()
}

/// The values that some curves have; of a slack strip, whose zeros are not known, none.
fn recomputed(curve: impl Fn(Test) -> Option<Curve>) -> Recomputed {
    let bending = curve(Test::Bending).and_then(|c| c.bending_values(&Default::default()).ok());
    let shear = curve(Test::Shear).and_then(|c| c.shear_values(&Default::default()).ok());
    let tensile = curve(Test::Tensile).filter(|c| !c.slack).and_then(|c| c.tensile_values().ok());
    [
        bending.map(|v| v.rigidity),
        bending.map(|v| v.loop_width),
        shear.map(|v| v.stiffness),
        shear.map(|v| v.loop_width),
        shear.map(|v| v.wide_loop_width),
        tensile.map(|v| v.extension),
        tensile.map(|v| v.work),
        tensile.map(|v| v.linearity),
        tensile.and_then(|v| v.resilience),
    ]
}
