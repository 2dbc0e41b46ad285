//! Report to a customer: the head, the values with their scatter, the loops with the fit, the
//! drape, and the assumptions.

use drape_fabric::{Fabric, Provenance};
use drape_fit::{Fit, FitSettings, fabric_values};
use drape_input::figure_in_digits;
use drape_kes::{Direction, Sheet, Symbol, Test, TestRecord};
use drape_report::{
    ComparedNumber, ComparedValue, CustomerPage, LawReport, ReportedDrape, ReportedFabric,
    ReportedLoop, ReportedNote, ReportedValue,
};

use super::VERSION;
use super::compared::ComparedFabric;
use super::fabric::{TESTS, directions, law};
use super::fit::curve_law;
use super::quantity::DIRECTIONS;
use super::sheet_value::{CheckedValue, sheet_values};
use super::value_law::value_laws;
use super::{kes_value, quantity};

/// Values that no law has, in the order of the page.
const OTHERS: [&str; 12] = ["W", "T", "T0", "TM", "c", "LC", "WC", "RC", "MIU", "MMD", "SMD", "FM"];

/// A law is continued beyond its measurements if it is read at more than this multiple of the
/// largest measured deformation.
const BEYOND: f64 = 1.05;

/// Fabric of a report.
pub struct CustomerSubject<'a> {
    /// Fabric with its laws.
    pub fabric: &'a Fabric,
    /// Measurements, with the fit. `None` for a fabric without a sheet.
    pub measured: Option<(&'a Sheet, &'a Fit)>,
    /// Customer, article, laboratory, date and specimens.
    pub record: TestRecord,
    /// Fabric on a drapemeter.
    pub drape: Option<ReportedDrape>,
    /// Further notes on the fabric.
    pub notes: Vec<String>,
}

impl CustomerSubject<'_> {
    /// Returns the measurements of [`CustomerSubject::measured`].
    fn sheet(&self) -> Option<&Sheet> {
        self.measured.map(|(sheet, _)| sheet)
    }

    /// Returns the sheet by which ranges are chosen. A fabric without a sheet gets one that has
    /// only its mass per area.
    fn sheet_for_ranges(&self) -> Sheet {
        let mass = quantity::mass().kes.map_or(1.0, |unit| unit.in_si);
        self.sheet().cloned().unwrap_or_else(|| {
            let mut sheet = Sheet::default();
            sheet.w = Some(self.fabric.density / mass);
            sheet
        })
    }

    /// Returns the numbers of the KES value `symbol` in a `direction`.
    fn number(&self, direction: Direction, symbol: Symbol) -> ComparedNumber {
        let compared = ComparedFabric { fabric: self.fabric, sheet: self.sheet() };
        let number = compared.number(direction, symbol);
        let provenance = self.fabric.provenance.as_ref().filter(|_| self.measured.is_none());
        let is_assumed =
            provenance.is_some_and(|provenance| was_assumed(provenance, direction, symbol));
        let is_extrapolated = number.measured.is_none() && self.is_beyond(direction, symbol);
        ComparedNumber { is_assumed: number.is_assumed || is_assumed || is_extrapolated, ..number }
    }

    /// Returns whether the law is read beyond all its measurements for the value `symbol` in a
    /// `direction`.
    fn is_beyond(&self, direction: Direction, symbol: Symbol) -> bool {
        let points =
            FitSettings::default().evaluation_points(self.sheet().unwrap_or(&Sheet::default()));
        let (key, deformation) = match symbol {
            Symbol::Lt | Symbol::Wt | Symbol::Rt | Symbol::Em => {
                let values = fabric_values(self.fabric, direction, &points);
                ("traction", values.tensile_extension())
            }
            Symbol::B => ("bending", Some(points.bending.slope[1])),
            Symbol::TwoHb => ("bending", Some(points.bending.width)),
            Symbol::G => ("shear", Some(points.shear.slope[1].sin())),
            Symbol::TwoHg => ("shear", Some(points.shear.width.sin())),
            Symbol::TwoHg5 => ("shear", Some(points.shear.wide.sin())),
        };

        let key = match key {
            "shear" => key.to_owned(),
            key => format!("{}.{key}", direction.name()),
        };
        let measured = self
            .fabric
            .provenance
            .as_ref()
            .and_then(|provenance| provenance.measured_range.get(&key));
        measured.zip(deformation).is_some_and(|(measured, read)| read > BEYOND * measured)
    }

    /// Returns a note for each direction in which values are read beyond the measurements.
    fn extrapolated(&self) -> Vec<String> {
        let mut notes = Vec::new();
        for direction in DIRECTIONS {
            let is_read = |symbol: &Symbol| {
                let compared = ComparedFabric { fabric: self.fabric, sheet: self.sheet() };
                compared.number(direction, *symbol).measured.is_none()
                    && self.is_beyond(direction, *symbol)
            };
            let beyond: Vec<&str> = Symbol::ALL
                .iter()
                .filter(|symbol| is_read(symbol))
                .map(|symbol| symbol.name())
                .collect();
            if !beyond.is_empty() {
                notes.push(format!(
                    "{} {}: no curve reaches so far, the law is continued beyond what was measured",
                    beyond.join(", "),
                    direction.name()
                ));
            }
        }
        notes
    }

    /// Returns the values that no law has. A fabric without a sheet has only the values in its
    /// file.
    fn others(&self) -> Vec<OtherValue> {
        let Some(sheet) = self.sheet() else { return self.others_of_fabric() };
        let of_law =
            |value: &CheckedValue| Symbol::ALL.iter().any(|symbol| symbol.name() == value.symbol);
        let listed = sheet_values(sheet).into_iter().filter(|value| !of_law(value));
        let other = |value: CheckedValue| {
            // Deviation and value have the same unit, so SI is by the ratio of the value.
            let deviation = value.deviation.map(|deviation| deviation * value.si / value.value);
            OtherValue {
                symbol: value.symbol.into(),
                name: value.name.into(),
                direction: value.direction.unwrap_or_default().into(),
                number: ComparedNumber {
                    measured: Some(value.si),
                    deviation: deviation.filter(|deviation| deviation.is_finite()),
                    ..ComparedNumber::default()
                },
                range: value.usual,
            }
        };
        listed.map(other).collect()
    }

    /// Returns the values of the fabric without a sheet that no law has.
    fn others_of_fabric(&self) -> Vec<OtherValue> {
        let fabric = self.fabric;
        let ranges = self.sheet_for_ranges();
        let of_law = [
            ("W", "mass per area", fabric.density),
            ("T", "thickness", fabric.thickness),
            ("MIU", "surface friction", fabric.surface_friction),
        ];
        let other = |(symbol, name, law): (&str, &str, f64)| {
            let key = match symbol {
                "W" => "density",
                "T" => "thickness",
                _ => "surface_friction",
            };
            let assumed = fabric.provenance.iter().flat_map(|provenance| &provenance.assumed);
            let is_assumed = assumed.into_iter().any(|note| note.starts_with(key));
            OtherValue {
                symbol: symbol.into(),
                name: name.into(),
                direction: String::new(),
                number: ComparedNumber { law: Some(law), is_assumed, ..ComparedNumber::default() },
                range: ranges.usual_range(symbol, None).map(|range| [*range.start(), *range.end()]),
            }
        };
        of_law.into_iter().map(other).collect()
    }

    /// Returns the loops, in the units of the laboratory, each as [`ReportedLoop`].
    fn loops(&self) -> Vec<ReportedLoop> {
        let Some((sheet, fit)) = self.measured else {
            let laws = TESTS
                .into_iter()
                .flat_map(|test| directions(test).iter().map(move |&direction| (test, direction)));
            let loop_of_law = |(test, direction)| {
                let mut law = law(self.fabric, test, direction);
                law.model = "the law alone, nothing measured is at hand".into();
                law.plots.iter_mut().for_each(|plot| plot.law = "law".into());
                reported(test, direction, law)
            };
            return laws.map(loop_of_law).collect();
        };
        let curves = sheet.curves.iter().zip(&fit.curves);
        let of_curves =
            curves.map(|(curve, fit)| reported(curve.test, curve.direction, curve_law(curve, fit)));
        let of_values = value_laws(sheet, fit, &FitSettings::default()).into_iter();
        // An assumed law follows nothing that was measured, and is named below the loops.
        let known = of_values.filter(|value_law| !value_law.is_assumed);
        of_curves
            .chain(
                known.map(|value_law| reported(value_law.test, value_law.direction, value_law.law)),
            )
            .collect()
    }

    /// Returns the data that the report of the fabric is based on, in words.
    fn basis(&self) -> String {
        let Some(sheet) = self.sheet() else {
            return "a file of laws: no measured loops and no measured values are at hand".into();
        };
        let values = sheet.listed().len();
        let count = |count: usize, one: &str, several: &str| match count {
            0 => None,
            1 => Some(format!("1 {one}")),
            count => Some(format!("{count} {several}")),
        };
        let parts = [
            count(sheet.curves.len(), "measured curve", "measured curves"),
            count(values, "measured value", "measured values"),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        if parts.is_empty() { "a sheet without measurements".into() } else { parts.join(", ") }
    }

    /// Returns the assumptions in place of measurements, without underscores.
    fn assumed(&self) -> Vec<String> {
        let assumed = match self.measured {
            Some((_, fit)) => &fit.assumed[..],
            None => {
                self.fabric.provenance.as_ref().map_or(&[][..], |provenance| &provenance.assumed)
            }
        };
        let assumed = assumed.iter().map(|note| note.replace('_', " "));
        assumed.chain(self.extrapolated()).collect()
    }

    /// Returns the warnings of the sheet and the further `notes`.
    fn notes(&self) -> Vec<String> {
        let warnings = self.sheet().map_or(&[][..], Sheet::warnings).iter();
        // The page shows standard deviations that no law uses.
        let of_sheet = warnings.map(|warning| warning.message.clone());
        let of_sheet =
            of_sheet.filter(|message| !message.contains("standard deviation is not used"));
        of_sheet.chain(self.tensile_load()).chain(self.notes.iter().cloned()).collect()
    }
}

impl CustomerSubject<'_> {
    /// Returns a note with the load of the values of the tensile test. Returns `None` for the load
    /// of the standard test.
    fn tensile_load(&self) -> Option<String> {
        let sheet = self.sheet()?;
        let unit = quantity::tension().kes?;
        let [load, standard] = [sheet.maximum_tension(), Sheet::default().maximum_tension()];
        let is_other = (load / standard - 1.0).abs() > 0.01;
        let load = figure_in_digits(load / unit.in_si, 4);
        is_other.then(|| {
            format!("LT, WT, RT and EM are values at a load of {load} {}, not of 500", unit.name)
        })
    }
}

/// Value that no law has.
struct OtherValue {
    symbol: String,
    name: String,
    direction: String,
    number: ComparedNumber,
    range: Option<[f64; 2]>,
}

/// Returns whether the `provenance` of a fabric without a sheet says that the value `symbol` in a
/// `direction` was assumed.
fn was_assumed(provenance: &Provenance, direction: Direction, symbol: Symbol) -> bool {
    let name = direction.name();
    let begins: Vec<String> = match symbol {
        Symbol::G => vec!["shear stiffness".into()],
        Symbol::TwoHg | Symbol::TwoHg5 => vec!["shear loop".into()],
        Symbol::B => vec![
            format!("{name} B:"),
            format!("{name} bending: not measured"),
            "bending: not measured".into(),
        ],
        Symbol::TwoHb => vec![
            format!("{name} 2HB:"),
            format!("{name} bending: not measured"),
            "bending: not measured".into(),
        ],
        _ => {
            vec![format!("{name} traction: not measured"), "traction: not measured".into()]
        }
    };

    let is_named = |note: &String| begins.iter().any(|begin| note.starts_with(begin.as_str()));
    provenance.assumed.iter().any(is_named)
}

/// Returns the loops of a `law` of a `test` in the units of the laboratory.
fn reported(test: Test, direction: Direction, mut law: LawReport) -> ReportedLoop {
    for plot in &mut law.plots {
        let [deformation, load] = quantity::laboratory_axes(test);
        (plot.deformation, plot.load) = (deformation, load);
    }
    ReportedLoop { test: test.name().into(), direction: direction.name().into(), law }
}

/// Returns the report of the fabrics `subjects`, side by side.
#[must_use]
pub fn customer_page(subjects: &[CustomerSubject<'_>]) -> CustomerPage {
    let fabric = |subject: &CustomerSubject<'_>| ReportedFabric {
        name: subject.fabric.name.clone(),
        source: subject.fabric.source.clone(),
        record: subject
            .record
            .lines()
            .map(|(title, text)| [title.to_owned(), text.unwrap_or_default().to_owned()])
            .into(),
        basis: subject.basis(),
        loops: subject.loops(),
        drape: subject.drape.clone(),
    };

    CustomerPage {
        version: VERSION.into(),
        fabrics: subjects.iter().map(fabric).collect(),
        values: values(subjects),
        others: others(subjects),
        assumed: shared(&subjects.iter().map(CustomerSubject::assumed).collect::<Vec<_>>()),
        notes: shared(&subjects.iter().map(CustomerSubject::notes).collect::<Vec<_>>()),
        ..CustomerPage::default()
    }
}

/// Returns the `notes` on each fabric. Each text appears once.
fn shared(notes: &[Vec<String>]) -> Vec<ReportedNote> {
    let texts = notes
        .iter()
        .enumerate()
        .flat_map(|(index, texts)| texts.iter().map(move |note| (index, note.as_str())));
    ReportedNote::shared(texts)
}

/// Returns the values that laws have, if one of `subjects` has them measured or its law was not
/// assumed.
fn values(subjects: &[CustomerSubject<'_>]) -> Vec<ReportedValue> {
    let ranges: Vec<Sheet> = subjects.iter().map(CustomerSubject::sheet_for_ranges).collect();
    let keys =
        Symbol::ALL.into_iter().flat_map(|symbol| DIRECTIONS.map(|direction| (symbol, direction)));

    let value = |(symbol, direction): (Symbol, Direction)| {
        let numbers: Vec<ComparedNumber> =
            subjects.iter().map(|subject| subject.number(direction, symbol)).collect();
        let is_known = |number: &ComparedNumber| {
            number.measured.is_some() || number.law.is_some() && !number.is_assumed
        };
        numbers.iter().any(is_known).then(|| {
            let usual = |sheet: &Sheet| {
                let range = sheet.usual_range(symbol.name(), Some(direction))?;
                Some([*range.start(), *range.end()])
            };
            ReportedValue {
                value: ComparedValue {
                    symbol: symbol.name().into(),
                    name: kes_value::words(symbol).into(),
                    direction: direction.name().into(),
                    units: kes_value::units(symbol.name()),
                    numbers,
                    is_comparable: true,
                },
                ranges: ranges.iter().map(usual).collect(),
                source: Sheet::usual_source(symbol.name()).unwrap_or_default().into(),
            }
        })
    };
    keys.filter_map(value).collect()
}

/// Returns the values that no law has, if one of `subjects` has them.
fn others(subjects: &[CustomerSubject<'_>]) -> Vec<ReportedValue> {
    let all: Vec<Vec<OtherValue>> = subjects.iter().map(CustomerSubject::others).collect();
    let mut values: Vec<ReportedValue> = Vec::new();
    for symbol in OTHERS {
        for direction in ["", "warp", "weft"] {
            let is_sought =
                |other: &&OtherValue| other.symbol == symbol && other.direction == direction;
            let found: Vec<Option<&OtherValue>> =
                all.iter().map(|values| values.iter().find(is_sought)).collect();
            let Some(first) = found.iter().flatten().next() else { continue };

            let length = || drape_report::Units::si("m").with_kes("cm", 1e-2);
            values.push(ReportedValue {
                value: ComparedValue {
                    symbol: symbol.into(),
                    name: first.name.clone(),
                    direction: direction.into(),
                    units: if symbol == "c" { length() } else { kes_value::units(symbol) },
                    numbers: found
                        .iter()
                        .map(|value| value.map(|value| value.number).unwrap_or_default())
                        .collect(),
                    is_comparable: true,
                },
                ranges: found.iter().map(|value| value.and_then(|value| value.range)).collect(),
                source: Sheet::usual_source(symbol).unwrap_or_default().into(),
            });
        }
    }
    values
}
