//! Errors of fits as mistakes of the sheet, with the test, the direction and the file of the curve.

use drape_fit::Error;
use drape_input::{Diagnostic, Document};
use toml::{Table, Value};

/// Curve that a sheet names.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedCurve {
    /// Index of the curve in `[[curve]]`, from 0.
    pub index: usize,
    /// Name in reports. If the file has several curves, their names begin with this name.
    pub name: String,
    /// Test, as the sheet calls it.
    pub test: String,
    /// Direction, as the sheet calls it.
    pub direction: String,
    /// Files. A curve with repeats has several.
    pub files: Vec<String>,
}

impl NamedCurve {
    /// Returns the curves that a `sheet` names.
    #[must_use]
    pub fn of(sheet: &Document) -> Vec<Self> {
        let table: Table = sheet.decode().unwrap_or_default();
        let entries = table.get("curve").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
        entries
            .iter()
            .enumerate()
            .filter_map(|(index, entry)| Self::of_entry(index, entry))
            .collect()
    }

    /// Returns the curve that an `entry` of `[[curve]]` names.
    fn of_entry(index: usize, entry: &Value) -> Option<Self> {
        let text = |key: &str| entry.get(key).and_then(Value::as_str).map(str::to_owned);
        let (test, direction) = (text("test")?, text("direction")?);
        let files = match entry.get("file")? {
            Value::Array(files) => {
                files.iter().filter_map(Value::as_str).map(str::to_owned).collect()
            }
            file => vec![file.as_str()?.to_owned()],
        };
        let name = text("name").unwrap_or_else(|| format!("{test} {direction}"));
        Some(Self { index, name, test, direction, files })
    }

    /// Returns whether a curve with the `name` in a fit belongs to this entry.
    #[must_use]
    pub fn is_called(&self, name: &str) -> bool {
        name.strip_prefix(&self.name).is_some_and(|rest| rest.is_empty() || rest.starts_with(", "))
    }
}

/// Returns the `error` of a fit as a mistake of its `sheet`. A mistake of a curve has the line of
/// the curve, its test, its direction and its file. A mistake of values has their test and
/// direction.
#[must_use]
pub fn fit_mistake(sheet: &Document, error: &Error) -> Diagnostic {
    let message = error.to_string();
    let Some((name, rest)) = message.split_once(": ") else {
        return Diagnostic::new(sheet.path(), message);
    };

    // A curve is named before its fault.
    let curves = NamedCurve::of(sheet);
    if let Some(curve) = curves.iter().find(|curve| curve.is_called(name)) {
        let NamedCurve { index, test, direction, files, .. } = curve;
        let file = files.join(", ");
        let message = format!("{test} curve, {direction}, \"{name}\" in {file}: {rest}");
        return sheet.at(&format!("curve[{index}].file"), message);
    }

    let are_values = matches!(
        error,
        Error::IncompatibleValues { .. }
            | Error::InvalidResilience { .. }
            | Error::InvalidLinearity { .. }
    );
    if are_values && matches!(name, "warp" | "weft") {
        return sheet.at(name, format!("tensile values, {name}: {rest}"));
    }
    Diagnostic::new(sheet.path(), message)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHEET: &str = "name = \"poplin\"\n[warp]\nRT = 50\n[[curve]]\ntest = \"bending\"\ndirection = \"weft\"\n\
                         file = \"b.csv\"\n[[curve]]\nname = \"pull\"\ntest = \"tensile\"\ndirection = \"warp\"\n\
                         file = [\"a.csv\", \"c.csv\"]\n";

    #[test]
    fn a_curve_is_named_with_its_line_test_direction_and_file() {
        let sheet = Document::new("sheet.toml", SHEET);
        let of = |name: &str| fit_mistake(&sheet, &Error::FallingLoad { name: name.into() });
        let mistake = of("bending weft");
        assert_eq!(mistake.line, Some(7));
        assert!(
            mistake.message.contains("bending curve, weft, \"bending weft\" in b.csv: the load"),
            "{mistake}"
        );
        let second = of("pull, 2");
        assert_eq!(second.line, Some(12));
        assert!(
            second.message.contains("tensile curve, warp, \"pull, 2\" in a.csv, c.csv: "),
            "{second}"
        );
        assert_eq!(of("pulled").line, None);
    }

    #[test]
    fn values_are_named_with_their_test_and_direction() {
        let sheet = Document::new("sheet.toml", SHEET);
        let error = Error::InvalidResilience { name: "warp".into(), percent: 0.0 };
        let mistake = fit_mistake(&sheet, &error);
        assert!(mistake.message.contains("tensile values, warp: RT is 0.0 %"), "{mistake}");
    }
}
