//! Converts averaged values to values of a sheet. Numbers without unit get their units, and values
//! of FAST and of cantilevers are converted to values that a sheet has keys for.

use drape_input::{Quantity, Unit, figure, parse_unit, round_digits};

use crate::results::average::AveragedValue;
use crate::results::item::Item;
use crate::results::sheet_value::{
    ConvertedValues, DraftValue, FabricValues, SourcedValue, source_of,
};
use crate::results::{cantilever, fast};

/// Converts the `values` of one fabric.
pub(crate) fn convert(values: Vec<SourcedValue>) -> ConvertedValues {
    let mut converted = ConvertedValues::default();
    let mut values = FabricValues { values };
    let are_fast = values.are_fast();
    mark_ratios(&mut values, &mut converted);
    add_units(&mut values, are_fast, &mut converted);

    cantilever::convert_lengths(&mut values, &mut converted);
    let mut with_keys = Vec::new();
    for sourced in &values.values {
        let AveragedValue { item, number, deviation, unit, direction, .. } = sourced.value;
        if let Item::Key(key) = item {
            let (unit, why) = (unit.map(spelling), source_of(sourced));
            with_keys.push(DraftValue { key, direction, number, deviation, unit, why });
        }
    }
    converted.values.splice(0..0, with_keys);
    fast::convert(&values, &mut converted);
    converted
}

/// Returns the spelling of `unit`. The laboratory's spelling is preferred among equal units.
fn spelling(unit: Unit) -> &'static str {
    let laboratory = unit.quantity.laboratory();
    if unit.factor == laboratory.factor { laboratory.spelling } else { unit.spelling }
}

/// Gives the unit percent to numbers that must be ratios, because no fabric has so small a
/// percentage.
fn mark_ratios(values: &mut FabricValues, converted: &mut ConvertedValues) {
    // All extensions of a table are in one unit.
    let has_extension_ratio = values
        .values
        .iter()
        .any(|sourced| sourced.value.item == Item::Extension(100) && must_be_ratio(&sourced.value));
    for SourcedValue { value, source } in &mut values.values {
        let is_extension = matches!(value.item, Item::Extension(_) | Item::BiasExtension);
        if !(must_be_ratio(value) || has_extension_ratio && is_extension) {
            continue;
        }
        let symbol = value.item.symbol();
        converted.notes.push(format!(
"ASSUMED: {symbol} of {}, {source}, is a ratio and no percentage: no fabric has so little",
figure(value.number)
));
        value.unit = parse_unit("%", &[Quantity::Ratio]).ok();
        value.number = round_digits(100.0 * value.number, 10);
        value.deviation = value.deviation.map(|deviation| round_digits(100.0 * deviation, 10));
        *value = value.clone().with_remark("ASSUMED: a ratio, no percentage");
    }
}

/// Returns whether `value` must be a ratio, because it is too small for a percentage.
fn must_be_ratio(value: &AveragedValue) -> bool {
    /// RT and RC in percent below which no fabric recovers.
    const RESILIENCE_LEAST: f64 = 1.5;
    /// EM in percent below which no fabric extends.
    const EXTENSION_LEAST: f64 = 0.35;

    let least = match value.item {
        Item::Key("RT" | "RC") => RESILIENCE_LEAST,
        Item::Key("EM") | Item::Extension(100) => EXTENSION_LEAST,
        _ => return false,
    };
    let may_be_percent = value.unit.is_none_or(|unit| unit.spelling == "%");
    may_be_percent && value.number > 0.0 && value.number < least
}

/// Gives numbers without unit the only unit that they can have. The values `are_fast` if they come
/// from FAST or a cantilever.
fn add_units(values: &mut FabricValues, are_fast: bool, converted: &mut ConvertedValues) {
    /// Largest W without unit, in mg/cm², of a garment's fabric. A larger number is in g/m².
    const HEAVIEST: f64 = 60.0;
    /// Bending length and overhang without unit above which the number is in mm, and else in cm.
    const CENTIMETRES_MOST: f64 = 8.0;

    for SourcedValue { value, source } in &mut values.values {
        if value.unit.is_some() {
            continue;
        }
        let (text, is_assumed) = match value.item {
            Item::Key("W") if are_fast => ("g/m2", false),
            Item::Key("W") if value.number > HEAVIEST => ("g/m2", true),
            Item::Key("B") if are_fast => ("uN.m", true),
            Item::Key("G") if are_fast => ("N/m", true),
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
        value.unit = parse_unit(text, &[quantity]).ok();
        if is_assumed {
            let symbol = value.item.symbol();
            let number = figure(value.number);
            converted.notes.push(format!(
                "ASSUMED: {symbol} {number}, {source}, is in {text}: the table gives no unit"
            ));
            let remark = format!("ASSUMED: in {text}, the table gives no unit");
            *value = value.clone().with_remark(&remark);
        }
    }
}
