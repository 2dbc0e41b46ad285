//! Ranges of numbers.

use drape_input::{Diagnostic, Diagnostics, figure};

use crate::file::RangeFile;

/// Range of numbers, on a linear or logarithmic scale.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Range {
    start: f64,
    end: f64,
    is_log: bool,
}

impl Range {
    /// Creates the range between two `ends` on a `scale`, which is linear if it is `None`.
    ///
    /// # Errors
    /// The mistake that `fail` returns for a key of the range, a message and a remedy.
    pub(crate) fn new(
        ends: [f64; 2],
        scale: Option<&str>,
        mut fail: impl FnMut(&str, String, &str) -> Diagnostic,
    ) -> Result<Self, Diagnostics> {
        let [start, end] = ends;
        let is_log = match scale {
            None | Some("linear") => false,
            Some("log") => true,
            Some(unknown) => {
                let message = format!("there is no scale \"{unknown}\"");
                return Err(fail("scale", message, "write \"linear\" or \"log\"").into());
            }
        };
        if is_log && !(start > 0.0 && end > 0.0) {
            let message = format!("{} to {} has no logarithms", figure(start), figure(end));
            return Err(fail("scale", message, "give ends above 0, or scale = \"linear\"").into());
        }
        if start == end {
            let message = format!("both ends are {}", figure(start));
            return Err(fail("end", message, "give another end").into());
        }
        Ok(Self { start, end, is_log })
    }

    /// Returns the number at `fraction` of the range, 0 to 1, as a TOML value.
    pub(crate) fn at(self, fraction: f64) -> String {
        let Self { start, end, is_log } = self;
        toml_number(if fraction == 0.0 {
            start
        } else if fraction == 1.0 {
            end
        } else if is_log {
            (start.ln() * (1.0 - fraction) + end.ln() * fraction).exp()
        } else {
            start * (1.0 - fraction) + end * fraction
        })
    }

    /// Returns `count` levels that divide the range evenly.
    pub(crate) fn levels(self, RangeFile { count, .. }: &RangeFile) -> Vec<String> {
        let last = f64::from(count - 1);
        (0..*count).map(|index| self.at(f64::from(index) / last)).collect()
    }
}

/// Returns `value` as a TOML value with 12 digits. A whole number is written without a point, so
/// that keys of whole numbers accept it too.
pub(crate) fn toml_number(value: f64) -> String {
    let rounded = drape_input::round_digits(value, 12);
    if rounded.fract() == 0.0 && rounded.abs() < 1e15 {
        return format!("{rounded:.0}");
    }
    format!("{rounded:?}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_at_equal_distances_or_ratios() {
        let levels = |ends, scale, count| {
            let range = Range::new(ends, scale, |_, message, _| Diagnostic::new("", message));
            let file = RangeFile { start: 0.0, end: 0.0, count, scale: None };
            range.expect("it is right").levels(&file)
        };
        assert_eq!(levels([0.0, 0.3], None, 4), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(levels([1.0, 3.0], Some("linear"), 3), ["1", "2", "3"]);
        assert_eq!(levels([1e-6, 1e-2], Some("log"), 3), ["1e-6", "0.0001", "0.01"]);
        assert_eq!(levels([8.0, 1.0], Some("log"), 4), ["8", "4", "2", "1"]);
        let values = levels([1e-6, 1e-2], Some("log"), 3).join(", ");
        assert!(toml::from_str::<toml::Table>(&format!("v = [{values}]")).is_ok(), "{values}");
    }
}
