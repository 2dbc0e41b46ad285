//! Numbers as written: decimal point or comma, digits in groups, exponents; `scattered`: with their
//! scatter.

pub(crate) mod scattered;

/// Sign between the whole part of a number and its fraction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
pub(crate) enum Decimal {
    #[serde(rename = ".")]
    Point,
    #[serde(rename = ",")]
    Comma,
}

impl Decimal {
    /// Decimal signs that a sheet may name.
    pub(crate) const ALL: [Self; 2] = [Self::Point, Self::Comma];

    /// Returns the name in sheets.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Point => ".",
            Self::Comma => ",",
        }
    }

    /// Returns the decimal sign as a character.
    fn sign(self) -> char {
        match self {
            Self::Point => '.',
            Self::Comma => ',',
        }
    }

    /// Returns the sign that may stand between groups of three digits.
    fn group_sign(self) -> char {
        match self {
            Self::Point => ',',
            Self::Comma => '.',
        }
    }
}

/// Decimal sign that follows from a written number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Evidence {
    /// The text is a number only with this decimal sign.
    Only(Decimal),
    /// The text is a number with either sign: `1,234`.
    Either,
    /// The text is a number without a sign.
    Whole,
}

/// Parses `text` as a number with the sign `decimal`. Digits before the sign may stand in groups of
/// three.
///
/// ```text
/// 1234.5   1,234.5   1 234,5   1'234.5   1.2E-03   −0,5   ５
/// ```
pub(crate) fn parse(text: &str, decimal: Decimal) -> Option<f64> {
    let text = plain_letters(text);
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
    if !are_digits(fraction) || (whole.is_empty() && fraction.is_empty()) {
        return None;
    }
    let whole = join_groups(whole, decimal.group_sign())?;
    format!("{sign}{whole}.{fraction}{exponent}").parse().ok()
}

/// Returns the decimal sign that follows from `text`; `None` if `text` is no number with either
/// sign.
pub(crate) fn evidence(text: &str) -> Option<Evidence> {
    let [point, comma] = Decimal::ALL.map(|decimal| parse(text, decimal));
    match (point, comma) {
        (None, None) => None,
        (Some(_), None) => Some(Evidence::Only(Decimal::Point)),
        (None, Some(_)) => Some(Evidence::Only(Decimal::Comma)),
        (Some(a), Some(b)) if a == b || (a.is_nan() && b.is_nan()) => Some(Evidence::Whole),
        (Some(_), Some(_)) => Some(Evidence::Either),
    }
}

/// Returns `text` without blanks around it, and with ASCII digits and signs.
fn plain_letters(text: &str) -> String {
    let mut letters = String::with_capacity(text.len());
    for letter in text.trim().chars() {
        letters.push(match letter {
            '\u{ff01}'..='\u{ff5e}' => char::from_u32(letter as u32 - 0xfee0).unwrap_or(letter),
            '−' | '‐' | '–' => '-',
            '\u{a0}' | '\u{202f}' | '\u{2009}' | '\u{3000}' => ' ',
            '’' | '`' => '\'',
            letter => letter,
        });
    }
    letters.trim().to_owned()
}

/// Returns whether `text` has only ASCII digits.
fn are_digits(text: &str) -> bool {
    text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Joins the digits of `whole` that stand in groups of three, between blanks, apostrophes or the
/// sign `group`. Returns `None` if `whole` has any other letter, or a later group of more or fewer
/// than three digits.
fn join_groups(whole: &str, group: char) -> Option<String> {
    let signs = [group, ' ', '\''];
    let Some(sign) = signs.into_iter().find(|&sign| whole.contains(sign)) else {
        return are_digits(whole).then(|| whole.to_owned());
    };

    let mut groups = whole.split(sign);
    let first = groups.next()?;
    let rest: Vec<&str> = groups.collect();
    let are_groups = (1..=3).contains(&first.len())
        && !first.starts_with('0')
        && are_digits(first)
        && rest.iter().all(|group| group.len() == 3 && are_digits(group));
    are_groups.then(|| format!("{first}{}", rest.concat()))
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
            ("0,125", Evidence::Only(Decimal::Comma)),
            ("1,25", Evidence::Only(Decimal::Comma)),
            ("0.125", Evidence::Only(Decimal::Point)),
            ("1,234.5", Evidence::Only(Decimal::Point)),
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
