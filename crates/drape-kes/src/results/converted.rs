//! Averaged values made into values of a sheet: bare numbers get their units, and values of FAST
//! and of cantilevers become those of a sheet.

use drape_input::{Quantity, Unit, figure, parse_unit};

use crate::results::average::{Averaged, rounded};
use crate::results::item::Item;
use crate::results::sheet_value::{Converted, SheetValue, Sourced, Values, why};
use crate::results::{cantilever, fast};

/// Largest bare W, in mg/cm², that a garment's fabric has; a larger number is in g/m².
const HEAVIEST: f64 = 60.0;
/// RT and RC in percent below which no fabric gives back: the number is a ratio.
const RESILIENCE_LEAST: f64 = 1.5;
/// EM in percent below which no fabric extends: the number is a ratio.
const EXTENSION_LEAST: f64 = 0.35;
/// Bending length and overhang above which a bare number is in mm and not in cm.
const CENTIMETRES_MOST: f64 = 8.0;

/// Converts the values of one fabric.
pub(crate) fn converted(all: Vec<Sourced>) -> Converted {
    let mut converted = Converted::default();
    let mut values = Values { all };
    give_units(&mut values, &mut converted);
    cantilever::rigidities(&mut values, &mut converted);
    let own = values.all.iter().filter_map(|one| match one.value.item {
        Item::Key(key) => Some(of_key(key, one)),
        _ => None,
    });
    let own: Vec<SheetValue> = own.collect();
    converted.values.splice(0..0, own);
    fast::convert(&values, &mut converted);
    converted
}

/// Returns a value of a key with its unit.
fn of_key(key: &'static str, one: &Sourced) -> SheetValue {
    let Averaged { number, deviation, unit, direction, .. } = one.value;
    SheetValue { key, direction, number, deviation, unit: unit.map(spelling), why: why(one) }
}

/// Returns the spelling of a unit; of units that are the same, that of the laboratory.
fn spelling(unit: Unit) -> &'static str {
    let own = unit.quantity.laboratory();
    if unit.factor == own.factor { own.spelling } else { unit.spelling }
}

/// Gives bare numbers the units that they can only have, and percentages that are ratios their
/// unit.
fn give_units(values: &mut Values, converted: &mut Converted) {
    let is_fast = values.is_fast();
    let unit =
        |text: &str, quantity: Quantity| -> Option<Unit> { parse_unit(text, &[quantity]).ok() };
    let is_ratio = |one: &Sourced| {
        let Averaged { item, number, unit, .. } = one.value;
        let is_percent = unit.is_none_or(|unit| unit.spelling == "%");
        let least = match item {
            Item::Key("RT" | "RC") => RESILIENCE_LEAST,
            Item::Key("EM") | Item::Extension(100) => EXTENSION_LEAST,
            _ => return false,
        };
        is_percent && number > 0.0 && number < least
    };
    let are_ratios =
        values.all.iter().any(|one| one.value.item == Item::Extension(100) && is_ratio(one));
    for one in &mut values.all {
        let of_fast =
            are_ratios && matches!(one.value.item, Item::Extension(_) | Item::BiasExtension);
        if is_ratio(one) || of_fast {
            let Sourced { value, source } = one;
            let symbol = value.item.symbol();
            converted.notes.push(format!(
                "ASSUMED: {symbol} of {}, {source}, is a ratio and no percentage: no fabric has so little",
                figure(value.number)
            ));
            value.unit = unit("%", Quantity::Ratio);
            value.number = rounded(100.0 * value.number, 10);
            value.deviation = value.deviation.map(|deviation| rounded(100.0 * deviation, 10));
            *value = value.clone().remarked("ASSUMED: a ratio, no percentage");
        }
    }
    for Sourced { value, source } in &mut values.all {
        if value.unit.is_some() {
            continue;
        }
        let (text, is_assumed) = match value.item {
            Item::Key("W") if is_fast => ("g/m2", false),
            Item::Key("W") if value.number > HEAVIEST => ("g/m2", true),
            Item::Key("B") if is_fast => ("uN.m", true),
            Item::Key("G") if is_fast => ("N/m", true),
            Item::BendingLength | Item::Overhang | Item::SteepOverhang
                if value.number < CENTIMETRES_MOST =>
            {
                ("cm", true)
            }
            Item::BendingLength | Item::Overhang | Item::SteepOverhang | Item::Thickness(_) => {
                ("mm", false)
            }
            Item::Extension(_) | Item::BiasExtension => ("%", false),
            _ => continue,
        };
        let Some(quantity) = value.item.quantity() else { continue };
        value.unit = unit(text, quantity);
        if is_assumed {
            let symbol = value.item.symbol();
            let number = figure(value.number);
            converted.notes.push(format!(
                "ASSUMED: {symbol} {number}, {source}, is in {text}: the table gives no unit"
            ));
            let remark = format!("ASSUMED: in {text}, the table gives no unit");
            *value = value.clone().remarked(&remark);
        }
    }
}
