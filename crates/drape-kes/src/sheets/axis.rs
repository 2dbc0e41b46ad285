//! Axes of a `[[curve]]`: what the sheet says of its deformation and its load.

use crate::sheets::findings::Findings;
use crate::sheets::section::{Choice, ColumnOrLength, Section};
use crate::tables::columns::AxisQuery;
use crate::tables::heading::Kind;
use crate::tables::layout::Column;
use crate::test::Test;
use drape_input::{Quantity, Unit, parse_unit};

const DEFORMATION_KEYS: [&str; 5] = ["column", "unit", "gauge", "zero", "reversed"];
const LOAD_KEYS: [&str; 4] = ["column", "unit", "width", "reversed"];

/// Zero of a length that gives a deformation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Zero {
    /// Lengthening: zero at the gauge.
    Extension,
    /// Distance of the clamps: the gauge at the start.
    Distance,
    /// Place of a clamp: arbitrary at the start.
    Position,
}

impl Zero {
    /// Returns the name used in sheets and messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Extension => "extension",
            Self::Distance => "distance",
            Self::Position => "position",
        }
    }
}

const ZERO: Choice<'_, Zero> = Choice {
    key: "zero",
    values: &[Zero::Extension, Zero::Distance, Zero::Position],
    name: Zero::name,
};

/// Keys and quantities of an axis.
struct Form {
    key: &'static str,
    /// Keys of its table; the third is that of its gauge or width.
    keys: &'static [&'static str],
    accepted: &'static [Quantity],
}

/// Axis, as the sheet describes it, with its key paths for messages; nothing is declared in the default.
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
    /// Reads the deformation; `None` after reporting what is wrong with it.
    pub(crate) fn deformation(
        section: &Section<'_>,
        test: Test,
        findings: &mut Findings<'_>,
    ) -> Option<Self> {
        let form =
            Form { key: "deformation", keys: &DEFORMATION_KEYS, accepted: deformations(test) };
        Self::read(section, &form, findings)
    }

    /// Reads the load.
    pub(crate) fn load(
        section: &Section<'_>,
        test: Test,
        findings: &mut Findings<'_>,
    ) -> Option<Self> {
        let form = Form { key: "load", keys: &LOAD_KEYS, accepted: loads(test) };
        Self::read(section, &form, findings)
    }

    /// Reports the keys of both axes that are wrong whatever the test is.
    pub(crate) fn check(section: &Section<'_>, findings: &mut Findings<'_>) {
        for (key, keys) in [("deformation", &DEFORMATION_KEYS[..]), ("load", &LOAD_KEYS)] {
            if let Some(axis) = section.section(key, findings) {
                axis.allow(keys, findings);
            }
        }
    }

    fn read(section: &Section<'_>, form: &Form, findings: &mut Findings<'_>) -> Option<Self> {
        let Form { key, keys, accepted } = *form;
        let size_key = keys[2];
        let path = section.key(key);
        let mut read = Self {
            unit_key: format!("{path}.unit"),
            size_key: format!("{path}.{size_key}"),
            key: path,
            ..Self::default()
        };
        if !section.declares(key) {
            return Some(read);
        }
        let errors = findings.errors.len();
        let axis = section.section(key, findings)?;
        axis.allow(keys, findings);
        read.columns = axis.columns("column", findings);
        read.size = axis.column_or_length(size_key, findings);
        if size_key == "gauge" {
            read.zero = axis.choice(&ZERO, findings);
        }
        read.reversed = axis.declares("reversed").then(|| axis.flag("reversed", findings));
        if let Some(text) = axis.text("unit", findings) {
            match parse_unit(&text, accepted) {
                Ok(unit) => read.unit = Some(unit),
                Err(error) => findings.error(&read.unit_key, error.message, error.help),
            }
        }
        (findings.errors.len() == errors).then_some(read)
    }

    /// Returns what is looked for in the tables.
    pub(crate) fn query(&self, name: &'static str, test: Test) -> AxisQuery<'_> {
        let is_load = name == "load";
        AxisQuery {
            name,
            columns: &self.columns,
            unit: self.unit,
            accepted: if is_load { loads(test) } else { deformations(test) },
            kinds: if is_load { load_kinds(test) } else { deformation_kinds(test) },
            by_length: !is_load
                && (self.size.is_some() || self.zero.is_some() || test == Test::LoopBending),
        }
    }
}

/// Returns the quantities that a deformation may be given in.
pub(crate) fn deformations(test: Test) -> &'static [Quantity] {
    match test {
        Test::Tensile => &[Quantity::Ratio, Quantity::Length],
        Test::Shear => &[Quantity::Angle, Quantity::Length],
        Test::Bending => &[Quantity::Curvature],
        Test::LoopBending => &[Quantity::Length],
    }
}

/// Returns the quantities that a load may be given in: per width, and whole.
pub(crate) fn loads(test: Test) -> &'static [Quantity] {
    match test {
        Test::Bending => &[Quantity::MomentPerWidth, Quantity::Moment],
        _ => &[Quantity::ForcePerWidth, Quantity::Force],
    }
}

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

fn load_kinds(test: Test) -> &'static [&'static [Kind]] {
    match test {
        Test::Bending => &[&[Kind::Moment]],
        _ => &[&[Kind::Force]],
    }
}
