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
    /// Checks a range; a mistake is made by a function of the key, its message and its remedy.
    pub(crate) fn new(
        ends: [f64; 2],
        scale: Option<&str>,
        mut fail: impl FnMut(&str, String, &str) -> Diagnostic,
    ) -> Result<Self, Diagnostics> {
        let [start, end] = ends;
        let is_log = match scale {
            None | Some("linear") => false,
            Some("log") => true,
            Some(other) => {
                let message = format!("there is no scale \"{other}\"");
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

    /// Returns the number at a part of the range, 0 to 1, as a value of TOML.
    pub(crate) fn at(self, part: f64) -> String {
        let Self { start, end, is_log } = self;
        if part == 0.0 || part == 1.0 {
            return number(if part == 0.0 { start } else { end });
        }
        number(match is_log {
            true => (start.ln() * (1.0 - part) + end.ln() * part).exp(),
            false => start * (1.0 - part) + end * part,
        })
    }

    /// Returns the levels of a range of so many.
    pub(crate) fn levels(self, RangeFile { count, .. }: &RangeFile) -> Vec<String> {
        let last = f64::from(count - 1);
        (0..*count).map(|index| self.at(f64::from(index) / last)).collect()
    }
}

/// Returns a number as a value of TOML, to 12 digits; a whole one serves for keys of either kind.
pub(crate) fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.11e}").parse().unwrap_or(value);
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
