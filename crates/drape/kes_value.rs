//! KES values as pages show them.

use drape::fabric::Fabric;
use drape::fit::{Settings, ValueRow, compare_values, fabric_values};
use drape::kes::{Direction, Sheet, Symbol};
use drape::report::{ComparedValue, KesValue, Units};

use crate::quantity;

/// What a value is called in words, and its units.
fn named(symbol: Symbol) -> (&'static str, Units) {
    match symbol {
        Symbol::B => ("bending rigidity", quantity::rigidity()),
        Symbol::TwoHb => ("bending loop width", quantity::moment()),
        Symbol::G => ("shear stiffness", quantity::shear_stiffness()),
        Symbol::TwoHg => ("shear loop width at 0.5°", quantity::tension()),
        Symbol::TwoHg5 => ("shear loop width at 5°", quantity::tension()),
        Symbol::Lt => ("tensile linearity", quantity::ratio()),
        Symbol::Wt => ("tensile work", quantity::work()),
        Symbol::Rt => ("tensile resilience", quantity::percent()),
        Symbol::Em => ("extension at the largest load", quantity::percent()),
    }
}

/// The values that a sheet or its curves have, with those of the fitted fabric and what is odd about them.
pub(crate) fn of_sheet(
    sheet: &Sheet,
    fabric: &Fabric,
    settings: &Settings,
) -> (Vec<KesValue>, Vec<String>) {
    let rows = compare_values(sheet, fabric, settings);
    let warnings = rows.iter().filter_map(ValueRow::warning).collect();
    let known = rows.into_iter().filter(|row| row.sheet.is_some() || row.curve.is_ok());
    let value =
        |row: ValueRow| shown(row.direction, row.symbol, [row.sheet, row.curve.ok(), row.law]);
    (known.map(value).collect(), warnings)
}

/// The values of a fabric in a direction.
pub(crate) fn of_fabric(fabric: &Fabric, direction: Direction) -> Vec<KesValue> {
    let reading = Settings::default().reading(&Sheet::default());
    let values = fabric_values(fabric, direction, &reading);
    Symbol::ALL.map(|symbol| shown(direction, symbol, [None, None, values.get(symbol)])).into()
}

/// A value of two fabrics that is given in the laboratory's unit.
pub(crate) fn compared(direction: Direction, symbol: Symbol, numbers: [f64; 2]) -> ComparedValue {
    let [first, second] = numbers;
    let KesValue { symbol, name, direction, units, sheet, curve, .. } =
        shown(direction, symbol, [Some(first), Some(second), None]);
    ComparedValue { symbol, name, direction, units, values: [sheet, curve] }
}

/// A value that is given in the laboratory's unit.
fn shown(direction: Direction, symbol: Symbol, numbers: [Option<f64>; 3]) -> KesValue {
    let (name, units) = named(symbol);
    let unit = units.kes.as_ref().map_or(1.0, |unit| unit.in_si);
    let [sheet, curve, law] = numbers.map(|number| number.map(|number| number * unit));
    KesValue {
        symbol: symbol.name().into(),
        name: name.into(),
        direction: direction.name().into(),
        units,
        sheet,
        curve,
        law,
    }
}
