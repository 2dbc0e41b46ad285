//! What a sheet declares about a file of a curve; everything else is detected.

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

/// Choice among several of a kind: tables, cycles, specimens.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) enum Take {
    /// Nothing declared.
    #[default]
    Undeclared,
    All,
    /// Those numbers.
    These(Vec<usize>),
}

impl Take {
    /// Returns whether a number is taken.
    pub(crate) fn takes(&self, number: usize) -> bool {
        match self {
            Self::Undeclared | Self::All => true,
            Self::These(numbers) => numbers.contains(&number),
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
