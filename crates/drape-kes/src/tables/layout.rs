//! Layout of a curve file that a sheet declares. Everything else is detected.

use encoding_rs::Encoding;

use crate::tables::block::Lines;
use crate::tables::grid::Separator;
use crate::tables::number::Decimal;

/// Reference to a column of a table, or to a sheet of a spreadsheet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Column {
    /// By its name in the header, with or without the unit.
    Name(String),
    /// By its number, from 1.
    Number(usize),
}

/// Choice among numbered tables, cycles or specimens.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum Take {
    /// The sheet declares nothing.
    #[default]
    Undeclared,
    All,
    /// The given numbers.
    Numbers(Vec<usize>),
}

impl Take {
    /// Returns whether the choice contains `number`.
    pub(crate) fn contains(&self, number: usize) -> bool {
        match self {
            Self::Undeclared | Self::All => true,
            Self::Numbers(numbers) => numbers.contains(&number),
        }
    }
}

/// Declared layout of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    pub(crate) encoding: Option<&'static Encoding>,
    pub(crate) separator: Option<Separator>,
    pub(crate) decimal: Option<Decimal>,
    pub(crate) lines: Lines,
    /// Sheet of a spreadsheet.
    pub(crate) sheet: Option<Column>,
    /// Tables that are repeats of the test.
    pub(crate) table: Take,
    /// Specimens that are repeats of the test, by the numbers in their column.
    pub(crate) specimen: Take,
    /// Cycles that are taken, from 1.
    pub(crate) cycle: Take,
}
