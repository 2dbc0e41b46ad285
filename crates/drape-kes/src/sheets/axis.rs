//! Axes of a `[[curve]]`: the keys of its deformation and its load.

use crate::sheets::findings::Findings;
use crate::sheets::section::{Choice, ColumnOrLength, Section};
use crate::tables::columns::AxisQuery;
use crate::tables::heading::Kind;
use crate::tables::layout::Column;
use crate::test::Test;
use drape_input::{Quantity, Unit, parse_unit};

pub(crate) const DEFORMATION_KEYS: [&str; 5] = ["column", "unit", "gauge", "zero", "reversed"];
pub(crate) const LOAD_KEYS: [&str; 4] = ["column", "unit", "width", "reversed"];

/// Meaning of a length from which a deformation is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Zero {
    /// Extension of the specimen: zero at the gauge length.
    Extension,
    /// Distance of the clamps: the gauge length at the start.
    Distance,
    /// Position of a clamp: arbitrary at the start.
    Position,
}

impl Zero {
    /// Returns the name in sheets and messages: `"extension"` for [`Zero::Extension`].
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Extension => "extension",
            Self::Distance => "distance",
            Self::Position => "position",
        }
    }
}

pub(crate) const ZERO: Choice<'_, Zero> = Choice {
    key: "zero",
    values: &[Zero::Extension, Zero::Distance, Zero::Position],
    name: Zero::name,
};

/// Keys and quantities of an axis.
struct AxisForm {
    key: &'static str,
    /// Keys of the axis's table. The third key is its gauge or width.
    keys: &'static [&'static str],
    accepted: &'static [Quantity],
}

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
    /// Reads the keys of the deformation of `test`. Returns `None` after reporting a mistake in
    /// `section`.
    pub(crate) fn deformation(
        section: &Section<'_>,
        test: Test,
        findings: &mut Findings<'_>,
    ) -> Option<Self> {
        let axis_form = AxisForm {
            key: "deformation",
            keys: &DEFORMATION_KEYS,
            accepted: deformation_quantities(test),
        };
        Self::read(section, &axis_form, findings)
    }

    /// Reads the keys of the load of `test`. Returns `None` after reporting a mistake in `section`.
    pub(crate) fn load(
        section: &Section<'_>,
        test: Test,
        findings: &mut Findings<'_>,
    ) -> Option<Self> {
        let axis_form = AxisForm { key: "load", keys: &LOAD_KEYS, accepted: load_quantities(test) };
        Self::read(section, &axis_form, findings)
    }

    /// Reports the unknown keys of both axes in `section`, where the test is unknown.
    pub(crate) fn check_keys(section: &Section<'_>, findings: &mut Findings<'_>) {
        for (key, keys) in [("deformation", &DEFORMATION_KEYS[..]), ("load", &LOAD_KEYS)] {
            if let Some(table) = section.section(key, findings) {
                table.allow(keys, findings);
            }
        }
    }

    /// Reads the keys of one axis. Returns `None` after reporting a mistake in `section`.
    fn read(
        section: &Section<'_>,
        axis_form: &AxisForm,
        findings: &mut Findings<'_>,
    ) -> Option<Self> {
        let AxisForm { key, keys, accepted } = *axis_form;
        let size_key = keys[2];
        let path = section.key(key);
        let mut axis_keys = Self {
            unit_key: format!("{path}.unit"),
            size_key: format!("{path}.{size_key}"),
            key: path,
            ..Self::default()
        };
        if !section.declares(key) {
            return Some(axis_keys);
        }

        let errors_before = findings.errors.len();
        let table = section.section(key, findings)?;
        table.allow(keys, findings);
        axis_keys.columns = table.columns("column", findings);
        axis_keys.size = table.column_or_length(size_key, findings);
        if size_key == "gauge" {
            axis_keys.zero = table.choice(&ZERO, findings);
        }
        axis_keys.reversed = table.declares("reversed").then(|| table.flag("reversed", findings));

        if let Some(text) = table.text("unit", findings) {
            match parse_unit(&text, accepted) {
                Ok(unit) => axis_keys.unit = Some(unit),
                Err(error) => findings.error(&axis_keys.unit_key, error.message, error.help),
            }
        }
        (findings.errors.len() == errors_before).then_some(axis_keys)
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
