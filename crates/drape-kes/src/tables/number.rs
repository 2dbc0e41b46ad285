//! Numbers as they are written: decimal point or comma, digits in groups, exponents; with their
//! scatter.

pub(crate) mod scattered;

/// Sign between the whole part of a number and its fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Decimal {
    Point,
    Comma,
}

impl Decimal {
    /// Decimal signs by their names in a sheet.
    pub(crate) const ALL: [Self; 2] = [Self::Point, Self::Comma];

    /// Returns the name used in sheets.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Point => ".",
            Self::Comma => ",",
        }
    }

    fn sign(self) -> char {
        match self {
            Self::Point => '.',
            Self::Comma => ',',
        }
    }

    fn other(self) -> char {
        match self {
            Self::Point => ',',
            Self::Comma => '.',
        }
    }
}

/// Decimal sign that a written number speaks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Evidence {
    /// Number of that decimal sign, and of no other.
    Of(Decimal),
    /// Number by either: `1,234`.
    Either,
    /// Number without a sign.
    Whole,
}

/// Parses a number with a decimal sign; digits before it may stand in groups of three.
///
/// ```text
/// 1234.5   1,234.5   1 234,5   1'234.5   1.2E-03   −0,5   ５
/// ```
pub(crate) fn parse(text: &str, decimal: Decimal) -> Option<f64> {
    let text = plain(text);
    if let Ok(number) = text.parse::<f64>()
        && (decimal == Decimal::Point || !text.contains('.'))
    {
        return Some(number);
    }
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(place) if place > 0 => text.split_at(place),
        _ => (text.as_str(), ""),
    };
    let (sign, digits) = match mantissa.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => ("", mantissa.strip_prefix('+').unwrap_or(mantissa)),
    };
    let (whole, fraction) = match digits.split_once(decimal.sign()) {
        Some((whole, fraction)) => (whole, fraction),
        None => (digits, ""),
    };
    let figures = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    if !figures(fraction) || (whole.is_empty() && fraction.is_empty()) {
        return None;
    }
    let whole = ungrouped(whole, decimal.other())?;
    format!("{sign}{whole}.{fraction}{exponent}").parse().ok()
}

/// Returns the decimal sign that a text speaks for; `None` where it is not a number by either.
pub(crate) fn evidence(text: &str) -> Option<Evidence> {
    let [point, comma] = Decimal::ALL.map(|decimal| parse(text, decimal));
    match (point, comma) {
        (None, None) => None,
        (Some(_), None) => Some(Evidence::Of(Decimal::Point)),
        (None, Some(_)) => Some(Evidence::Of(Decimal::Comma)),
        (Some(a), Some(b)) if a == b || (a.is_nan() && b.is_nan()) => Some(Evidence::Whole),
        (Some(_), Some(_)) => Some(Evidence::Either),
    }
}

/// Returns the text of a number in plain characters: without blanks around, with ASCII digits.
fn plain(text: &str) -> String {
    let plain = |letter: char| match letter {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(letter as u32 - 0xfee0).unwrap_or(letter),
        '−' | '‐' | '–' => '-',
        '\u{a0}' | '\u{202f}' | '\u{2009}' | '\u{3000}' => ' ',
        '’' | '`' => '\'',
        other => other,
    };
    text.trim().chars().map(plain).collect::<String>().trim().to_owned()
}

/// Joins digits that stand in groups of three; `None` where they are not digits in groups.
fn ungrouped(whole: &str, group: char) -> Option<String> {
    let signs = [group, ' ', '\''];
    let figures = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let Some(sign) = signs.into_iter().find(|&sign| whole.contains(sign)) else {
        return figures(whole).then(|| whole.to_owned());
    };
    let mut groups = whole.split(sign);
    let first = groups.next()?;
    let rest: Vec<&str> = groups.collect();
    let good = (1..=3).contains(&first.len())
        && !first.starts_with('0')
        && figures(first)
        && rest.iter().all(|group| group.len() == 3 && figures(group));
    good.then(|| format!("{first}{}", rest.concat()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_may_be_written_in_many_ways() {
        let cases = [
            ("1234.5", Decimal::Point, 1234.5),
            ("1,234.5", Decimal::Point, 1234.5),
            ("1 234,5", Decimal::Comma, 1234.5),
            ("1.234.567,25", Decimal::Comma, 1_234_567.25),
            ("1'234.5", Decimal::Point, 1234.5),
            ("-1,2E-03", Decimal::Comma, -1.2e-3),
            ("−0.5", Decimal::Point, -0.5),
            ("+.5", Decimal::Point, 0.5),
            ("５．２", Decimal::Point, 5.2),
            ("12", Decimal::Comma, 12.0),
            ("1e5", Decimal::Comma, 1e5),
        ];
        for (text, decimal, number) in cases {
            assert_eq!(parse(text, decimal), Some(number), "{text}");
        }
        for text in ["", "-", "a", "1,2,3", "12.03.2021", "1 2", "0,5.1", "e5", "10:30"] {
            assert_eq!(parse(text, Decimal::Point), None, "{text}");
        }
    }

    #[test]
    fn the_decimal_sign_is_known_from_the_number_or_not_at_all() {
        let cases = [
            ("0,125", Evidence::Of(Decimal::Comma)),
            ("1,25", Evidence::Of(Decimal::Comma)),
            ("0.125", Evidence::Of(Decimal::Point)),
            ("1,234.5", Evidence::Of(Decimal::Point)),
            ("1,234", Evidence::Either),
            ("1.234", Evidence::Either),
            ("12", Evidence::Whole),
        ];
        for (text, found) in cases {
            assert_eq!(evidence(text), Some(found), "{text}");
        }
        assert_eq!(evidence("12.03.2021"), None);
    }
}
