//! Axes of a `[[curve]]`: the keys of its deformation and its load.

use crate::sheets::file::forms::{ColumnOrLength, Columns, Zero};
use crate::sheets::file::{DeformationFile, LoadFile};
use crate::sheets::findings::Findings;
use crate::tables::columns::AxisQuery;
use crate::tables::heading::Kind;
use crate::tables::layout::Column;
use crate::test::Test;
use drape_input::{Quantity, Unit, parse_unit};

/// Axis as the sheet describes it, with its key paths for messages. The default declares nothing.
#[derive(Default)]
pub(crate) struct AxisKeys {
    pub(crate) columns: Vec<Column>,
    pub(crate) unit: Option<Unit>,
    /// Gauge of a deformation, or width of a load.
    pub(crate) size: Option<ColumnOrLength>,
    pub(crate) zero: Option<Zero>,
    /// Whether the sign is the opposite one, if the sheet says so.
    pub(crate) reversed: Option<bool>,
    pub(crate) key: String,
    pub(crate) unit_key: String,
    pub(crate) size_key: String,
}

impl AxisKeys {
    /// Returns the axis of the deformation of `test`, which `file` describes at the key path
    /// `curve`.
    /// Returns `None` after reporting a mistake.
    pub(crate) fn deformation(
        curve: &str,
        file: &DeformationFile,
        test: Test,
        findings: &mut Findings<'_>,
    ) -> Option<Self> {
        let DeformationFile { column: Columns(columns), unit, gauge, zero, reversed } = file;
        let mut axis_keys = Self {
            columns: columns.clone(),
            size: gauge.clone(),
            zero: *zero,
            reversed: *reversed,
            ..Self::at(format!("{curve}.deformation"), "gauge")
        };
        axis_keys.read_unit(unit.as_deref(), deformation_quantities(test), findings)?;
        Some(axis_keys)
    }

    /// Returns the axis of the load of `test`, which `file` describes at the key path `curve`.
    /// Returns `None` after reporting a mistake.
    pub(crate) fn load(
        curve: &str,
        file: &LoadFile,
        test: Test,
        findings: &mut Findings<'_>,
    ) -> Option<Self> {
        let LoadFile { column: Columns(columns), unit, width, reversed } = file;
        let mut axis_keys = Self {
            columns: columns.clone(),
            size: width.clone(),
            reversed: *reversed,
            ..Self::at(format!("{curve}.load"), "width")
        };
        axis_keys.read_unit(unit.as_deref(), load_quantities(test), findings)?;
        Some(axis_keys)
    }

    /// Returns an axis at the key path `key` that declares nothing. Its size has the key
    /// `size_key`.
    fn at(key: String, size_key: &str) -> Self {
        Self {
            unit_key: format!("{key}.unit"),
            size_key: format!("{key}.{size_key}"),
            key,
            ..Self::default()
        }
    }

    /// Sets the unit to `text`, a unit of one of the `accepted` quantities. Returns `None` after
    /// reporting a mistake.
    fn read_unit(
        &mut self,
        text: Option<&str>,
        accepted: &[Quantity],
        findings: &mut Findings<'_>,
    ) -> Option<()> {
        let unit = text.map(|text| parse_unit(text, accepted)).transpose();
        self.unit = unit.map_err(|error| findings.refuse(&self.unit_key, error)).ok()?;
        Some(())
    }

    /// Returns the columns and quantities to look for in a table, for the axis `name` of `test`.
    pub(crate) fn query(&self, name: &'static str, test: Test) -> AxisQuery<'_> {
        let is_load = name == "load";
        AxisQuery {
            name,
            columns: &self.columns,
            unit: self.unit,
            accepted: if is_load { load_quantities(test) } else { deformation_quantities(test) },
            kinds: if is_load { load_kinds(test) } else { deformation_kinds(test) },
            by_length: !is_load
                && (self.size.is_some() || self.zero.is_some() || test == Test::LoopBending),
        }
    }
}

/// Returns the quantities in which the deformation of `test` may be given.
pub(crate) fn deformation_quantities(test: Test) -> &'static [Quantity] {
    match test {
        Test::Tensile => &[Quantity::Ratio, Quantity::Length],
        Test::Shear => &[Quantity::Angle, Quantity::Length],
        Test::Bending => &[Quantity::Curvature],
        Test::LoopBending => &[Quantity::Length],
    }
}

/// Returns the quantities in which the load of `test` may be given: per width, and whole.
pub(crate) fn load_quantities(test: Test) -> &'static [Quantity] {
    match test {
        Test::Bending => &[Quantity::MomentPerWidth, Quantity::Moment],
        _ => &[Quantity::ForcePerWidth, Quantity::Force],
    }
}

/// Returns the kinds of columns that may hold the deformation of `test`, preferred kinds first.
fn deformation_kinds(test: Test) -> &'static [&'static [Kind]] {
    const LENGTHS: &[&[Kind]] =
        &[&[Kind::Strain, Kind::Extension], &[Kind::Distance], &[Kind::Position]];
    match test {
        Test::Tensile | Test::LoopBending => LENGTHS,
        Test::Shear => &[
            &[Kind::Angle, Kind::Strain],
            &[Kind::Extension],
            &[Kind::Distance],
            &[Kind::Position],
        ],
        Test::Bending => &[&[Kind::Curvature]],
    }
}

/// Returns the kinds of columns that may hold the load of `test`.
fn load_kinds(test: Test) -> &'static [&'static [Kind]] {
    match test {
        Test::Bending => &[&[Kind::Moment]],
        _ => &[&[Kind::Force]],
    }
}
