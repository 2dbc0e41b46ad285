//! KES values as pages show them: in SI, with the unit of the laboratory beside it.

use drape_fabric::Fabric;
use drape_fit::{FitSettings, ValueComparison, ValueEstimate, compare_values, fabric_values};
use drape_kes::{Direction, Sheet, SheetValue, Symbol};
use drape_report::{ComparedNumber, ComparedValue, KesValue, LawValue, Quantity, Units};

use super::interval::interval;
use super::quantity;

/// Name of a KES value in words, and its units.
struct Named {
    words: &'static str,
    units: Units,
}

/// Returns the name and the units of a `symbol`.
fn named(symbol: Symbol) -> Named {
    let (words, units) = match symbol {
        Symbol::B => ("bending rigidity", quantity::rigidity()),
        Symbol::TwoHb => ("bending loop width", quantity::moment()),
        Symbol::G => ("shear stiffness", quantity::shear_stiffness()),
        Symbol::TwoHg => ("shear loop width at 0.5°", quantity::tension()),
        Symbol::TwoHg5 => ("shear loop width at 5°", quantity::tension()),
        Symbol::Lt => ("tensile linearity", quantity::ratio()),
        Symbol::Wt => ("tensile work", quantity::work()),
        Symbol::Rt => ("tensile resilience", quantity::percent()),
        Symbol::Em => ("extension at the largest load", quantity::percent()),
    };
    Named { words, units }
}

/// KES values of a sheet and of the fabric that was fitted to it.
pub struct SheetValues {
    /// Values that the sheet or its curves have.
    pub values: Vec<KesValue>,
    /// Values that disagree with each other, in words.
    pub warnings: Vec<String>,
}

/// Returns the values that a `sheet` or its curves have, each with the value of the fitted
/// `fabric`.
pub fn of_sheet(sheet: &Sheet, fabric: &Fabric, settings: &FitSettings) -> SheetValues {
    let rows = compare_values(sheet, fabric, settings);
    let warnings = rows.iter().filter_map(ValueComparison::warning).collect();
    let known = rows.into_iter().filter(|row| row.sheet.is_some() || row.curve.is_ok());
    let value = |row: ValueComparison| {
        shown(row.direction, row.symbol, [row.sheet, row.curve.ok(), row.law])
    };
    SheetValues { values: known.map(value).collect(), warnings }
}

/// Returns the value of a fitted law, by its `estimate`, with its interval.
pub fn of_law(estimate: &ValueEstimate) -> LawValue {
    let Named { words, units } = named(estimate.symbol);
    let unit = units.kes.as_ref().map_or(1.0, |unit| unit.in_si);
    LawValue {
        symbol: estimate.symbol.name().into(),
        name: words.into(),
        law: estimate.value * unit,
        curve: estimate.curve.as_ref().ok().map(|value| value * unit),
        interval: interval(&estimate.interval, unit),
        units,
    }
}

/// Returns a `value` of a sheet as a page shows it: with its symbol, and its use in the model.
pub fn listed(value: &SheetValue) -> Quantity {
    let SheetValue { symbol, name, direction, value, used_for, .. } = *value;
    let direction = direction.map_or(String::new(), |direction| format!(" {}", direction.name()));
    let units = units(symbol);
    let factor = units.kes.as_ref().map_or(1.0, |unit| unit.in_si);
    let origin = match used_for {
        Some(part) => format!("sheet: {part}"),
        None => "sheet: not used by the model".into(),
    };
    Quantity { name: format!("{symbol}{direction}, {name}"), value: value * factor, units, origin }
}

/// Returns the `value` of a `symbol` that a fabric keeps although its model does not use it.
pub fn unused(symbol: &str, value: f64) -> Quantity {
    let units = units(symbol.rsplit('.').next().unwrap_or(symbol));
    let factor = units.kes.as_ref().map_or(1.0, |unit| unit.in_si);
    let origin = "not used by the model".into();
    Quantity { name: symbol.replace('.', " "), value: value * factor, units, origin }
}

/// Returns the name of a `symbol` in words.
pub fn words(symbol: Symbol) -> &'static str {
    named(symbol).words
}

/// Returns the units of a `symbol` of a sheet.
pub fn units(symbol: &str) -> Units {
    if let Some(symbol) = Symbol::ALL.into_iter().find(|known| known.name() == symbol) {
        return named(symbol).units;
    }
    match symbol {
        "W" => quantity::mass(),
        "T" | "T0" | "TM" => quantity::thickness(),
        "WC" => quantity::work(),
        "RC" => quantity::percent(),
        "SMD" => Units::si("m").with_kes("µm", 1e-6),
        "FM" => quantity::tension(),
        _ => quantity::ratio(),
    }
}

/// Returns the values of a `fabric` in a `direction`.
pub fn of_fabric(fabric: &Fabric, direction: Direction) -> Vec<KesValue> {
    let points = FitSettings::default().evaluation_points(&Sheet::default());
    let values = fabric_values(fabric, direction, &points);
    Symbol::ALL.map(|symbol| shown(direction, symbol, [None, None, values.get(symbol)])).into()
}

/// Returns the value `symbol` of simulated specimens and of the laws. `numbers` has both in the
/// unit of the laboratory.
pub fn simulated(direction: Direction, symbol: Symbol, numbers: [f64; 2]) -> ComparedValue {
    let Named { words, units } = named(symbol);
    let unit = units.kes.as_ref().map_or(1.0, |unit| unit.in_si);
    let law = |law: f64| ComparedNumber { law: Some(law * unit), ..ComparedNumber::default() };
    ComparedValue {
        symbol: symbol.name().into(),
        name: words.into(),
        direction: direction.name().into(),
        units,
        numbers: numbers.map(law).into(),
        is_comparable: true,
    }
}

/// Returns the value `symbol` as a page shows it. `numbers` of the sheet, the curve and the law are
/// in the unit of the laboratory.
fn shown(direction: Direction, symbol: Symbol, numbers: [Option<f64>; 3]) -> KesValue {
    let Named { words, units } = named(symbol);
    let unit = units.kes.as_ref().map_or(1.0, |unit| unit.in_si);
    let [sheet, curve, law] = numbers.map(|number| number.map(|number| number * unit));
    KesValue {
        symbol: symbol.name().into(),
        name: words.into(),
        direction: direction.name().into(),
        units,
        sheet,
        curve,
        law,
    }
}
