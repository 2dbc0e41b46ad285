//! Items of tables of results: values of KES, FAST and cantilever tests, with their symbols.

use drape_input::Quantity;

use crate::sheets::spelling;
use crate::symbol::Symbol;

/// Item of a table of results.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Item {
    /// Value that has a key in a sheet.
    Key(&'static str),
    /// Bending length of a cantilever, half of its overhang at 41.5°.
    BendingLength,
    /// Overhang of a cantilever at 41.5°.
    Overhang,
    /// Overhang of a cantilever at 45°, according to JIS L 1096.
    SteepOverhang,
    /// Extension of FAST at a load in gf/cm: 5, 20 or 100.
    Extension(u32),
    /// Extension of FAST on the bias at 5 gf/cm.
    BiasExtension,
    /// Thickness of FAST at a pressure in gf/cm²: 2 or 100.
    Thickness(u32),
    /// Known value without a key in a sheet.
    Unused(&'static str),
}

/// Symbols of items that are not keys of a sheet, in small letters without signs between.
const SYMBOLS: [(&str, Item); 26] = [
    ("emt", Item::Key("EM")),
    ("fm", Item::Key("FM")),
    ("c", Item::BendingLength),
    ("bl", Item::BendingLength),
    ("oh", Item::Overhang),
    ("e5", Item::Extension(5)),
    ("e20", Item::Extension(20)),
    ("e100", Item::Extension(100)),
    ("eb5", Item::BiasExtension),
    ("e5bias", Item::BiasExtension),
    ("t2", Item::Thickness(2)),
    ("st2", Item::Thickness(2)),
    ("t100", Item::Thickness(100)),
    ("st100", Item::Thickness(100)),
    ("st", Item::Unused("surface thickness")),
    ("str", Item::Unused("released surface thickness")),
    ("st2r", Item::Unused("released thickness")),
    ("st100r", Item::Unused("released thickness")),
    ("t2r", Item::Unused("released thickness")),
    ("t100r", Item::Unused("released thickness")),
    ("rs", Item::Unused("relaxation shrinkage")),
    ("he", Item::Unused("hygral expansion")),
    ("thv", Item::Unused("total hand value")),
    ("koshi", Item::Unused("hand value")),
    ("numeri", Item::Unused("hand value")),
    ("fukurami", Item::Unused("hand value")),
];

/// Symbol as written: its item, and the signs behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct WrittenSymbol {
    pub(crate) item: Item,
    /// Digit behind the symbol: 1 for warp and 2 for weft, or the number of a specimen.
    pub(crate) suffix: Option<u32>,
    /// Sign behind the symbol: `+` for bending or shearing forward, `-` for backward.
    pub(crate) sign: Option<char>,
}

impl Item {
    /// Parses the symbol `text`; `None` for a text that is no symbol.
    ///
    /// ```text
    /// B   2HG5   T_0   C-1   E20-2   B+
    /// ```
    pub(crate) fn parse_symbol(text: &str) -> Option<WrittenSymbol> {
        let plain: String =
            text.to_lowercase().chars().filter(|letter| !"_- .·'\"°".contains(*letter)).collect();
        if let Some(item) = item_of(&plain) {
            let sign = text.trim_end().chars().next_back().filter(|sign| "-−".contains(*sign));
            return Some(WrittenSymbol { item, suffix: None, sign: sign.and(Some('-')) });
        }
        for (end, sign) in [('+', '+'), ('−', '-')] {
            if let Some(symbol) = plain.strip_suffix(end) {
                let item = item_of(symbol)?;
                return Some(WrittenSymbol { item, suffix: None, sign: Some(sign) });
            }
        }
        let last = plain.chars().next_back()?.to_digit(10).filter(|digit| *digit > 0)?;
        let item = item_of(&plain[..plain.len() - 1]).filter(|item| item.is_directed())?;
        Some(WrittenSymbol { item, suffix: Some(last), sign: None })
    }

    /// Returns the quantity of the item; `None` for an [`Item::Unused`].
    pub(crate) fn quantity(self) -> Option<Quantity> {
        Some(match self {
            Self::Key(key) => match key {
                "B" => Quantity::BendingRigidity,
                "2HB" => Quantity::MomentPerWidth,
                "G" => Quantity::ShearStiffness,
                "2HG" | "2HG5" | "FM" => Quantity::ForcePerWidth,
                "WT" | "WC" => Quantity::WorkPerArea,
                "SMD" => Quantity::Roughness,
                "T" | "T0" | "TM" => Quantity::Length,
                "W" => Quantity::MassPerArea,
                _ => Quantity::Ratio,
            },
            Self::BendingLength | Self::Overhang | Self::SteepOverhang | Self::Thickness(_) => {
                Quantity::Length
            }
            Self::Extension(_) | Self::BiasExtension => Quantity::Ratio,
            Self::Unused(_) => return None,
        })
    }

    /// Returns whether a number of the item without unit is a ratio. Other ratios are percentages.
    pub(crate) fn is_ratio(self) -> bool {
        matches!(self, Self::Key("LT" | "LC" | "MIU" | "MMD"))
    }

    /// Returns whether the item has one value for the warp and another for the weft.
    pub(crate) fn is_directed(self) -> bool {
        match self {
            Self::Key(key) => spelling::KEYS.contains(&key),
            Self::BendingLength | Self::Overhang | Self::SteepOverhang | Self::Extension(_) => true,
            Self::BiasExtension | Self::Thickness(_) | Self::Unused(_) => false,
        }
    }

    /// Returns whether the item is a value of a KES test that FAST does not measure.
    pub(crate) fn is_only_of_kes(self) -> bool {
        let Self::Key(key) = self else { return false };
        !["B", "G"].contains(&key) && Symbol::ALL.iter().any(|symbol| symbol.name() == key)
    }

    /// Returns whether the item is a value of FAST or of a cantilever.
    pub(crate) fn is_fast(self) -> bool {
        !matches!(self, Self::Key(_) | Self::Unused(_))
    }

    /// Returns the symbol of the item in messages.
    pub(crate) fn symbol(self) -> String {
        match self {
            Self::Key(key) => key.to_owned(),
            Self::BendingLength => "bending length".to_owned(),
            Self::Overhang | Self::SteepOverhang => "overhang".to_owned(),
            Self::Extension(load) => format!("E{load}"),
            Self::BiasExtension => "EB5".to_owned(),
            Self::Thickness(pressure) => format!("thickness at {pressure} gf/cm2"),
            Self::Unused(name) => name.to_owned(),
        }
    }
}

/// Returns the item of the symbol `plain`, in small letters without signs between.
fn item_of(plain: &str) -> Option<Item> {
    let item = SYMBOLS.iter().find(|(symbol, _)| *symbol == plain).map(|(_, item)| *item);
    item.or_else(|| spelling::key(plain).map(Item::Key))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_of_kes_and_fast_are_told_from_their_suffixes() {
        let cases = [
            ("B", Item::Key("B"), None),
            ("B-1", Item::Key("B"), Some(1)),
            ("2HG5", Item::Key("2HG5"), None),
            ("2HG5-2", Item::Key("2HG5"), Some(2)),
            ("2HG 0.5", Item::Key("2HG"), None),
            ("T_0", Item::Key("T0"), None),
            ("T2", Item::Thickness(2), None),
            ("ST100", Item::Thickness(100), None),
            ("E5", Item::Extension(5), None),
            ("E5-1", Item::Extension(5), Some(1)),
            ("E20-2", Item::Extension(20), Some(2)),
            ("E100-1", Item::Extension(100), Some(1)),
            ("EB5", Item::BiasExtension, None),
            ("C-2", Item::BendingLength, Some(2)),
            ("EMT", Item::Key("EM"), None),
        ];
        for (text, item, suffix) in cases {
            let found = Item::parse_symbol(text).expect(text);
            assert_eq!((found.item, found.suffix, found.sign), (item, suffix, None), "{text}");
        }
        assert_eq!(Item::parse_symbol("2HB+").and_then(|found| found.sign), Some('+'));
        assert_eq!(Item::parse_symbol("B−").and_then(|found| found.sign), Some('-'));
        // The mass and the thickness have no directions: these are names of fabrics or specimens.
        for text in ["W1", "RC-1", "A", "Warp", "10"] {
            assert_eq!(Item::parse_symbol(text), None, "{text}");
        }
    }
}
