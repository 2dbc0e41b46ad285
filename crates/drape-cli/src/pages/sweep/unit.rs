//! Units of measures. The unit is the end of a measure's name, or the unit of a value of a summary,
//! which is in SI.

use drape::input::is_unit;
use drape::sweep::Column;

/// Units of the values of summaries. Each row has the end of a name, the unit in which the value is
/// shown, and that unit in SI.
const UNITS: [(&str, &str, f64); 29] = [
    ("height_max", "mm", 1e-3),
    ("height_mean", "mm", 1e-3),
    ("height_min", "mm", 1e-3),
    ("length", "mm", 1e-3),
    ("ease", "mm", 1e-3),
    ("body", "mm", 1e-3),
    ("relaxed", "mm", 1e-3),
    ("lowest", "mm", 1e-3),
    ("min_distance", "mm", 1e-3),
    ("seam_gap_max", "mm", 1e-3),
    ("simulated_seconds", "s", 1.0),
    ("speed_max", "mm/s", 1e-3),
    ("traction_max", "%", 0.01),
    ("traction_p99", "%", 0.01),
    ("warp.max", "%", 0.01),
    ("warp.median", "%", 0.01),
    ("warp.min", "%", 0.01),
    ("warp.p01", "%", 0.01),
    ("warp.p99", "%", 0.01),
    ("weft.max", "%", 0.01),
    ("weft.median", "%", 0.01),
    ("weft.min", "%", 0.01),
    ("weft.p01", "%", 0.01),
    ("weft.p99", "%", 0.01),
    ("curvature_p99", "1/m", 1.0),
    ("pressure.area", "m²", 1.0),
    ("pressure.max", "Pa", 1.0),
    ("pressure.mean", "Pa", 1.0),
    ("pressure.p99", "Pa", 1.0),
];

/// Measure in the unit in which it is shown.
pub(super) struct ShownMeasure {
    pub(super) label: String,
    pub(super) unit: String,
    /// Values of the measure, in `unit`.
    pub(super) column: Column,
}

impl ShownMeasure {
    /// Converts `column` to the unit in which it is shown.
    pub(super) fn new(column: &Column) -> Self {
        let (label, unit) = split_unit(&column.name);
        if !unit.is_empty() {
            return Self { label: label.into(), unit: unit.into(), column: column.clone() };
        }
        let known = UNITS.iter().find(|(end, ..)| {
            let before = column.name.strip_suffix(end);
            before.is_some_and(|before| before.is_empty() || before.ends_with('.'))
        });
        let (unit, factor) = match known {
            Some((_, unit, factor)) => (*unit, *factor),
            None if column.name.starts_with("energy.") => ("J", 1.0),
            None => ("", 1.0),
        };

        let numbers = column.numbers();
        let cells = numbers
            .iter()
            .map(|number| number.map_or(String::new(), |number| (number / factor).to_string()))
            .collect();
        let column = Column { name: column.name.clone(), cells };
        Self { label: label.into(), unit: unit.into(), column }
    }

    /// Returns the label with its `unit`.
    pub(super) fn title(&self) -> String {
        match self.unit.as_str() {
            "" => self.label.clone(),
            unit => format!("{}, {unit}", self.label),
        }
    }
}

/// Splits a name such as `length in mm` into label and unit. The unit is empty if `name` ends with
/// none.
pub(super) fn split_unit(name: &str) -> (&str, &str) {
    let parts = name.rsplit_once(" in ").filter(|(_, unit)| is_unit(unit));
    parts.unwrap_or((name, ""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_summaries_have_units() {
        let shown = |name: &str, cell: &str| {
            let column = Column { name: name.into(), cells: vec![cell.into(), String::new()] };
            let shown = ShownMeasure::new(&column);
            (shown.title(), shown.column.cells)
        };
        let cells = |cell: &str| vec![cell.to_owned(), String::new()];
        assert_eq!(shown("ease in mm", "12"), ("ease, mm".into(), cells("12")));
        assert_eq!(
            shown("measures.openings.0.ease", "0.5"),
            ("measures.openings.0.ease, mm".into(), cells("500"))
        );
        assert_eq!(shown("disease", "0.5"), ("disease".into(), cells("0.5")));
        assert_eq!(shown("energy.elastic", "2"), ("energy.elastic, J".into(), cells("2")));
        assert_eq!(split_unit("dressed in red"), ("dressed in red", ""));
    }
}
