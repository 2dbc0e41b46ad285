//! Values of a sheet, one a line: as the laboratory wrote it, in SI, and whether it is usual.

use std::fmt::Write;

use drape::input::figure_in_digits;
use drape::kes::Sheet;
use drape::run::reports::{CheckedValue, sheet_values};

/// Number of digits of a value.
const DIGITS: usize = 4;

/// Describes the values of `sheet`, one a line.
pub(crate) fn describe(sheet: &Sheet) -> String {
    let values = sheet_values(sheet);
    let mut text = values.iter().map(line).collect::<String>();
    if values.iter().any(|value| value.usual.is_none()) {
        text += "  where no usual range stands, none was measured on many fabrics\n";
    }
    text
}

fn line(value: &CheckedValue) -> String {
    let shown = |number: f64| figure_in_digits(number, DIGITS);
    let deviation = value.deviation.map_or(String::new(), |number| format!(" ± {}", shown(number)));
    let written = with_unit(shown(value.value) + &deviation, &value.unit);
    let mut line = format!("  {}, {}: {written}", value.label(), value.name);

    if value.unit != value.si_unit {
        let _ = write!(line, " = {}", with_unit(shown(value.si), &value.si_unit));
    }

    if let (Some([low, high]), Some(is_usual)) = (value.usual, value.is_usual) {
        let verdict = if is_usual { "usual" } else { "UNUSUAL" };
        let range = with_unit(format!("{} to {}", shown(low), shown(high)), &value.si_unit);
        let _ = write!(line, ", {verdict}: nine fabrics in ten have {range}");
    }

    if value.used_for.is_none() && value.symbol != "c" {
        line += "; not used by the model";
    }
    line + "\n"
}

fn with_unit(text: String, unit: &str) -> String {
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}
