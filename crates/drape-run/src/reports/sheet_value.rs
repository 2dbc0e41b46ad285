//! Values of a sheet one by one: in the unit of the laboratory, in SI, and with the range of most
//! fabrics.

use serde::Serialize;

use drape_input::figure_in_digits;
use drape_kes::{Direction, Sheet, SheetValue};
use drape_report::Units;

use super::{kes_value, quantity};

/// Number of digits of a value in a message.
const DIGITS: usize = 4;

/// Value of a sheet, with the range that fabrics usually have.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckedValue {
    /// Symbol of the laboratory. `c` is the bending length, which follows from B and W.
    pub symbol: &'static str,
    /// Name in words.
    pub name: &'static str,
    /// Direction, where the value has one.
    pub direction: Option<&'static str>,
    /// Value, in the unit of the laboratory.
    pub value: f64,
    /// Standard deviation that the sheet states, in the unit of the laboratory.
    pub deviation: Option<f64>,
    /// Unit of the laboratory. Empty for a ratio.
    pub unit: String,
    /// Value in SI.
    pub si: f64,
    /// Unit of SI.
    pub si_unit: String,
    /// Range in SI that nine fabrics in ten have. `None` where the value was not measured on many
    /// fabrics.
    pub usual: Option<[f64; 2]>,
    /// Whether the value is in the range `usual`. `None` where the range is not known.
    pub is_usual: Option<bool>,
    /// Part of the model that the value determines. `None` where the model does not use the value.
    pub used_for: Option<&'static str>,
}

impl CheckedValue {
    /// Returns a warning about a value outside the range `usual`.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        let [least, most] = self.usual.filter(|_| self.is_usual == Some(false))?;
        let Self { name, si, si_unit, .. } = self;
        Some(format!(
            "{}: a {name} of {} {si_unit} is unusual; nine fabrics in ten have {} to {}; check the value and \
             its unit",
            self.label(),
            figure_in_digits(*si, DIGITS),
            figure_in_digits(least, DIGITS),
            figure_in_digits(most, DIGITS)
        ))
    }

    /// Returns `symbol` and `direction`: `B warp`.
    #[must_use]
    pub fn label(&self) -> String {
        match self.direction {
            Some(direction) => format!("{} {direction}", self.symbol),
            None => self.symbol.into(),
        }
    }
}

/// Returns every value of a `sheet`, and the bending lengths, with the ranges that fabrics usually
/// have.
#[must_use]
pub fn sheet_values(sheet: &Sheet) -> Vec<CheckedValue> {
    let lengths = quantity::DIRECTIONS.into_iter().filter_map(|direction| {
        let listed = SheetValue {
            symbol: "c",
            name: "bending length, from B and W",
            direction: Some(direction),
            value: 1e2 * sheet.bending_length(direction)?,
            unit: "cm",
            used_for: None,
        };
        Some(checked(sheet, &listed, &Units::si("m").with_kes("cm", 1e-2)))
    });
    let listed = sheet.listed();
    let values = listed.iter().map(|value| checked(sheet, value, &kes_value::units(value.symbol)));
    values.chain(lengths).collect()
}

/// Returns the value `listed` of a `sheet` with its range.
fn checked(sheet: &Sheet, listed: &SheetValue, units: &Units) -> CheckedValue {
    let SheetValue { symbol, name, direction, value, unit, used_for } = *listed;
    let usual = sheet.usual_range(symbol, direction);
    let si = value * units.kes.as_ref().map_or(1.0, |unit| unit.in_si);
    CheckedValue {
        symbol,
        name,
        direction: direction.map(Direction::name),
        value,
        deviation: direction
            .and_then(|direction| deviation(sheet, symbol, direction))
            .or_else(|| other_deviation(sheet, symbol, direction)),
        unit: unit.into(),
        si,
        si_unit: units.si.clone(),
        is_usual: usual.as_ref().map(|range| range.contains(&si)),
        usual: usual.map(|range| [*range.start(), *range.end()]),
        used_for,
    }
}

/// Returns the standard deviation that a `sheet` states for the value `symbol` of a law, in the
/// unit of the laboratory.
pub(crate) fn deviation(sheet: &Sheet, symbol: &str, direction: Direction) -> Option<f64> {
    let is_of_value = |scatter: &&drape_kes::Scatter| {
        scatter.symbol.name() == symbol && scatter.direction == direction
    };
    sheet.scatter.iter().find(is_of_value).map(|scatter| scatter.deviation)
}

/// Returns the standard deviation that a `sheet` states for the value `symbol` that no law uses, in
/// the unit of the laboratory.
fn other_deviation(sheet: &Sheet, symbol: &str, direction: Option<Direction>) -> Option<f64> {
    let mut stated = sheet.other_scatter.iter();
    let scatter = stated.find(|scatter| scatter.symbol == symbol && scatter.direction == direction);
    scatter.map(|scatter| scatter.deviation)
}
