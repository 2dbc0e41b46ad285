//! Record of a test for the head of a report: customer, article, laboratory, date and specimens.

use drape_input::{Diagnostic, Diagnostics};

/// Remedy for an empty text.
const EMPTY_HELP: &str = "write it, or remove the line: what is not known stays blank";

/// Remedy for a date in another format.
const DATE_HELP: &str =
    "write year, month and day as 2026-03-14, or as much of it as is known: 2026-03 or 2026";

/// Record of a test: what a laboratory writes above its results. The record does not change any
/// number.
///
/// ```
/// use drape_input::Document;
/// use drape_kes::Sheet;
///
/// let text = "name = \"poplin\"\ncustomer = \"Mill & Co\"\ndate = 2026-03-14\nspecimens = 5\n";
/// let record = Sheet::from_document(&Document::new("sheet.toml", text))?.record;
/// assert_eq!(record.customer.as_deref(), Some("Mill & Co"));
/// assert_eq!(record.date.as_deref(), Some("2026-03-14"));
/// assert_eq!(record.specimens.as_deref(), Some("5"));
/// assert_eq!(record.article, None);
/// # Ok::<(), drape_kes::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TestRecord {
    /// Customer for whom the fabric was tested.
    pub customer: Option<String>,
    /// Article: the customer's number or name of the fabric.
    pub article: Option<String>,
    /// Laboratory that tested the fabric.
    pub laboratory: Option<String>,
    /// Date of the tests: `2026-03-14`, `2026-03` or `2026`.
    pub date: Option<String>,
    /// Specimens: the number of specimens, or a text such as `3 of 20 cm × 20 cm`.
    pub specimens: Option<String>,
}

impl TestRecord {
    /// Sets the line that has `key` in a sheet to `text`, and replaces the line of the sheet.
    ///
    /// # Errors
    /// `key` is unknown, `text` is empty or has several lines, a date is not a date, or the number
    /// of specimens is less than one.
    pub fn set(&mut self, key: &str, text: &str) -> Result<(), Diagnostics> {
        self.set_line(key, text).map_err(|Fault { message, help }| {
            Diagnostic::new("", format!("{key}: {text}: {message}")).help(help).into()
        })
    }

    /// Sets the line that has `key` to `text`. An unknown `key` is a fault, too.
    pub(crate) fn set_line(&mut self, key: &str, text: &str) -> Result<(), Fault> {
        let text = checked(key, text)?;
        let line = match key {
            "customer" => &mut self.customer,
            "article" => &mut self.article,
            "laboratory" => &mut self.laboratory,
            "date" => &mut self.date,
            "specimens" => &mut self.specimens,
            _ => {
                let help = "known here: customer, article, laboratory, date, specimens";
                return Err(Fault { message: "there is no such key", help });
            }
        };
        *line = Some(text);
        Ok(())
    }

    /// Returns the lines with their titles, in the order of a report. An unknown line is `None`.
    #[must_use]
    pub fn lines(&self) -> [(&'static str, Option<&str>); 5] {
        [
            ("Customer", self.customer.as_deref()),
            ("Article", self.article.as_deref()),
            ("Specimens", self.specimens.as_deref()),
            ("Date of the tests", self.date.as_deref()),
            ("Laboratory", self.laboratory.as_deref()),
        ]
    }
}

/// Reason why a line of a record is refused.
pub(crate) struct Fault {
    pub(crate) message: &'static str,
    pub(crate) help: &'static str,
}

/// Checks the `text` of the line `key`, and returns the text without blanks at its ends.
fn checked(key: &str, text: &str) -> Result<String, Fault> {
    let text = text.trim();
    if text.is_empty() {
        return Err(Fault { message: "is empty", help: EMPTY_HELP });
    }
    if text.contains(char::is_control) {
        return Err(Fault { message: "is not one line of text", help: "write it in one line" });
    }
    match key {
        "date" if !is_date(text) => Err(Fault { message: "is not a date", help: DATE_HELP }),
        "specimens" if text.parse::<f64>().is_ok_and(|count| !is_count(count)) => Err(Fault {
            message: "is not a number of specimens",
            help: "write how many were tested, such as 5, or a text such as \"3 of 20 cm × 20 cm\"",
        }),
        _ => Ok(text.to_owned()),
    }
}

/// Returns whether `count` is a whole number of at least one specimen.
fn is_count(count: f64) -> bool {
    count >= 1.0 && count.fract() == 0.0
}

/// Returns whether `text` is a year, a month of a year or a day of the calendar, in the form of ISO
/// 8601.
fn is_date(text: &str) -> bool {
    /// Days of the months of a leap year.
    const DAYS: [u32; 12] = [31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    /// Number of digits of year, month and day.
    const LENGTHS: [usize; 3] = [4, 2, 2];

    // Signs and blanks, which `parse` may accept, are refused here.
    let parts: Vec<&str> = text.split('-').collect();
    let have_digits = parts.iter().zip(LENGTHS).all(|(part, length)| {
        part.len() == length && part.bytes().all(|byte| byte.is_ascii_digit())
    });
    if parts.len() > LENGTHS.len() || !have_digits {
        return false;
    }

    // A missing month or day counts as the first.
    let [year, month, day] =
        [0, 1, 2].map(|index| parts.get(index).map_or(1, |part| part.parse().unwrap_or(0)));
    let is_leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let days = (month as usize).checked_sub(1).and_then(|index| DAYS.get(index));
    days.is_some_and(|&days| {
        let last = if month == 2 && !is_leap { days - 1 } else { days };
        (1..=last).contains(&day)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for date in ["2026", "2026-03", "2026-03-14", "2024-02-29", "2000-02-29"] {
            assert!(is_date(date), "{date}");
        }
        let none = [
            "14.03.2026",
            "2026-3-1",
            "2026-13",
            "2025-02-29",
            "1900-02-29",
            "26",
            "2026-00-01",
            "",
        ];
        for date in none {
            assert!(!is_date(date), "{date}");
        }
    }

    #[test]
    fn a_line_that_says_nothing_is_refused_and_a_set_line_wins() {
        let mut record = TestRecord { customer: Some("a".into()), ..TestRecord::default() };
        record.set("customer", " Mill & Co ").expect("it is a name");
        assert_eq!(record.customer.as_deref(), Some("Mill & Co"));
        let refused = [
            ("customer", "  ", "is empty"),
            ("article", "a\nb", "is not one line of text"),
            ("date", "14.03.2026", "is not a date"),
            ("specimens", "0", "is not a number of specimens"),
            ("specimens", "2.5", "is not a number of specimens"),
            ("weaver", "a", "there is no such key"),
        ];
        for (key, text, message) in refused {
            let mistake = record.set(key, text).expect_err(text).to_string();
            assert!(mistake.contains(message), "{mistake}");
        }
        record.set("specimens", "3 of 20 cm × 20 cm").expect("it is a text");
    }
}
