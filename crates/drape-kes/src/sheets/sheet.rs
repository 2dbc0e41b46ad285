//! Sheet of a laboratory: KES values in its own units, and curves in SI.

use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, Document};
use toml::de::DeTable;

use crate::curves::curve::Curve;
use crate::error::Error;
use crate::scatter::{OtherScatter, Scatter};
use crate::sheets::checks::plausible;
use crate::sheets::findings::Findings;
use crate::sheets::model::Model;
use crate::sheets::section::{Choice, Measured, Section};
use crate::sheets::value_keys::{DirectedValues, WholeValues};
use crate::sheets::{curve_file, repeats};
use crate::symbol::Symbol;
use crate::test::{Direction, Test};
use crate::test_record::{Fault, RECORD_KEYS, TestRecord};
use crate::values::Values;
use drape_input::Quantity;

/// Name of the sheet in a folder.
const SHEET_FILE: &str = "sheet.toml";

pub(crate) const SHEET_KEYS: [&str; 31] = [
    "name",
    "source",
    "customer",
    "article",
    "laboratory",
    "date",
    "specimens",
    "model",
    "W",
    "T",
    "T0",
    "TM",
    "LC",
    "WC",
    "RC",
    "MIU",
    "MMD",
    "SMD",
    "FM",
    "B",
    "2HB",
    "G",
    "2HG",
    "2HG5",
    "LT",
    "WT",
    "RT",
    "EM",
    "warp",
    "weft",
    "curve",
];
pub(crate) const MODEL: Choice<'_, Model> =
    Choice { key: "model", values: &Model::ALL, name: Model::name };

/// FM of the standard tensile test, in gf/cm; the "high sensitivity" test stops at 50.
const STANDARD_MAXIMUM_TENSION: f64 = 500.0;

/// Sheet of one fabric: KES values, curves, and their source.
///
/// Fields named by a symbol are in the laboratory's units; curves are in SI.
///
/// ```
/// use drape_kes::Sheet;
///
/// # let folder = std::env::temp_dir().join(format!("drape-kes-sheet-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder).expect("a folder");
/// let text = "name = \"poplin\"\nW = 12.38\n[warp]\nB = 0.118\n2HB = \"1.2e-3 N\"\n";
/// std::fs::write(folder.join("sheet.toml"), text).expect("it can be written");
/// let sheet = Sheet::read(&folder)?;
/// # std::fs::remove_dir_all(&folder).expect("it was just made");
/// assert_eq!(sheet.w, Some(12.38));
/// assert!(sheet.density().is_some_and(|density| (density - 0.1238).abs() < 1e-15));
/// assert!(sheet.warp.bending_loop_width().is_some_and(|width| (width - 1.2e-3).abs() < 1e-15));
/// # Ok::<(), drape_kes::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sheet {
    /// Name of the fabric.
    pub name: String,
    /// Source: who measured it, when, and under which licence.
    pub source: String,
    /// Customer, article, laboratory, date and specimens, for the head of a report.
    pub record: TestRecord,
    /// Law that bending and shear are to be fitted with; selected by the data unless set.
    pub model: Option<Model>,
    /// W, mass per area, in mg/cm².
    pub w: Option<f64>,
    /// T, thickness, in mm.
    pub t: Option<f64>,
    /// T0, thickness under 0.5 gf/cm² in the compression test, in mm.
    pub t0: Option<f64>,
    /// TM, thickness under 50 gf/cm² in the compression test, in mm.
    pub tm: Option<f64>,
    /// LC, linearity of the compression curve, a ratio.
    pub lc: Option<f64>,
    /// WC, compression work per area, in gf·cm/cm².
    pub wc: Option<f64>,
    /// RC, compression resilience, in percent; the model does not use it.
    pub rc: Option<f64>,
    /// MIU, coefficient of friction of the surface test, a ratio: the mean of both directions.
    pub miu: Option<f64>,
    /// FM, maximum load of the tensile test, in gf/cm; see [`Sheet::maximum_tension`] where it is
    /// not given.
    pub fm: Option<f64>,
    /// Values along the warp.
    pub warp: Values,
    /// Values along the weft.
    pub weft: Values,
    /// Symbols of the values that stand for both directions with one number.
    pub shared: Vec<&'static str>,
    /// Standard deviations of the values, where the sheet states them.
    pub scatter: Vec<Scatter>,
    /// Standard deviations of the values that no law uses, where the sheet states them.
    pub other_scatter: Vec<OtherScatter>,
    /// Measured curves, in SI.
    pub curves: Vec<Curve>,
    warnings: Vec<Diagnostic>,
    readings: Vec<String>,
}

/// Reads the record of a test.
fn record(root: &Section<'_>, findings: &mut Findings<'_>) -> TestRecord {
    let mut record = TestRecord::default();
    for key in RECORD_KEYS {
        let Some(text) = root.text_or_number(key, findings) else { continue };
        if let Err(Fault { message, help }) = record.put(key, &text) {
            findings.error(key, message, help);
        }
    }
    record
}

impl Sheet {
    /// Reads a sheet and the curves that it names; a folder means the `sheet.toml` in it.
    ///
    /// # Errors
    /// The file cannot be read, or it or one of its curve files has mistakes: all that were found
    /// are in the error, each with file, line, value and remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let document = if path.is_dir() {
            Document::read(path.join(SHEET_FILE))?
        } else {
            Document::read(path)?
        };
        Self::from_document(&document)
    }

    /// Reads a sheet from a document; the curves that it names are in the folder of its path.
    ///
    /// # Errors
    /// As for [`Sheet::read`].
    pub fn from_document(document: &Document) -> Result<Self, Error> {
        // Decoding into a plain table reports mistakes of grammar as for every other file.
        let values: toml::Table = document.decode()?;
        let text = match document.settings() {
            [] => document.text().to_owned(),
            _ => values.to_string(),
        };
        let table = DeTable::parse(&text).expect("the text has just been decoded");
        let mut findings = Findings::new(document);
        let sheet = Self::check(&Section::root(table.get_ref()), &mut findings);
        Diagnostics::check(findings.errors)?;
        Ok(Self { warnings: findings.warnings, readings: findings.readings, ..sheet })
    }

    fn check(root: &Section<'_>, findings: &mut Findings<'_>) -> Self {
        root.allow_values(&SHEET_KEYS, findings);
        let name = root.required_text("name", "\"cotton poplin\"", findings);
        let source = root.text("source", findings);
        let record = record(root, findings);
        let model = root.choice(&MODEL, findings);
        let whole = WholeValues::read(root, findings);
        if let Some(w) = &whole.w {
            plausible::density(w, findings);
        }
        let DirectedValues { warp, weft, shared, scatter } =
            DirectedValues::read(root, whole.w.as_ref(), findings);
        let curves = root
            .sections("curve", findings)
            .iter()
            .flat_map(|section| curve_file::read(section, findings))
            .collect();
        let curves = repeats::joined(curves, findings);
        let laboratory = |value: Option<Measured>| value.map(|value| value.laboratory);
        let known: Vec<f64> = [warp.miu, weft.miu].into_iter().flatten().collect();
        let miu = match known.as_slice() {
            [] => None,
            [first, .., last] if first == last => Some(*first),
            all => Some(all.iter().sum::<f64>() / all.len() as f64),
        };
        let sheet = Self {
            name: name.unwrap_or_default(),
            source: source.unwrap_or_default(),
            record,
            model,
            w: laboratory(whole.w),
            t: laboratory(whole.t),
            t0: laboratory(whole.t0),
            tm: laboratory(whole.tm),
            lc: whole.lc,
            wc: laboratory(whole.wc),
            rc: laboratory(whole.rc),
            miu,
            fm: laboratory(whole.fm),
            warp,
            weft,
            shared,
            scatter,
            other_scatter: std::mem::take(&mut findings.other_scatter),
            curves,
            warnings: Vec::new(),
            readings: Vec::new(),
        };
        sheet.compare_compression(root, findings);
        sheet.compare_loads(findings);
        findings.tell_unused_scatter();
        sheet
    }

    /// Adds what values were taken for, and what was assumed or left out.
    pub(crate) fn add_readings(&mut self, readings: &[String], notes: &[String]) {
        self.readings.splice(0..0, readings.iter().cloned());
        self.readings.extend(notes.iter().map(|note| format!("note: {note}")));
    }

    /// Returns W: mass per area, in kg/m².
    #[must_use]
    pub fn density(&self) -> Option<f64> {
        self.w.map(|w| w * Quantity::MassPerArea.laboratory().factor)
    }

    /// Returns T0, else T: thickness, in metres.
    #[must_use]
    pub fn thickness(&self) -> Option<f64> {
        self.t0.or(self.t).map(|t| t * Quantity::Length.laboratory().factor)
    }

    /// Returns FM: the maximum load of the tensile test, in N/m.
    ///
    /// It is the given one; without, and without values of the tensile test, the largest load of the
    /// tensile curves; else the standard one.
    #[must_use]
    pub fn maximum_tension(&self) -> f64 {
        let given = self.fm.map(|fm| fm * Quantity::ForcePerWidth.laboratory().factor);
        let of_curves = || self.load_of_curves().filter(|_| !self.has_tensile_values());
        let standard = STANDARD_MAXIMUM_TENSION * Quantity::ForcePerWidth.laboratory().factor;
        given.or_else(of_curves).unwrap_or(standard)
    }

    /// Returns the KES values of one direction.
    #[must_use]
    pub fn values(&self, direction: Direction) -> &Values {
        match direction {
            Direction::Warp => &self.warp,
            Direction::Weft => &self.weft,
        }
    }

    /// Returns the curves of one test and direction, in the order of the sheet.
    pub fn curves_of(&self, test: Test, direction: Direction) -> impl Iterator<Item = &Curve> {
        self.curves.iter().filter(move |curve| curve.test == test && curve.direction == direction)
    }

    /// Returns a digest of the measured numbers, whatever the layout of the files.
    ///
    /// It is the BLAKE3 hash, in hexadecimal, of all values and of all points of all curves, in SI
    /// to the last bit. Names and remarks do not count.
    #[must_use]
    pub fn digest(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        let mut number = |value: f64| {
            hasher.update(&value.to_le_bytes());
        };
        // A missing value counts too, as a NaN: no given value is one.
        let given = [self.density(), self.thickness(), self.fm];
        let values = [&self.warp, &self.weft];
        let values = values.into_iter().flat_map(|v| Symbol::ALL.map(|symbol| v.get(symbol)));
        given.into_iter().chain(values).for_each(|value| number(value.unwrap_or(f64::NAN)));
        for curve in &self.curves {
            let kind = [curve.test as u8, curve.direction as u8, u8::from(curve.slack)];
            kind.into_iter().for_each(|kind| number(f64::from(kind)));
            number(curve.gauge.unwrap_or(f64::NAN));
            number(curve.load().len() as f64);
            curve.deformation().iter().chain(curve.load()).for_each(|&value| number(value));
        }
        // Only where they are given, so that sheets older than these keys keep their digests.
        let millimetre = Quantity::Length.laboratory().factor;
        let pressed = self.tm.map(|tm| tm * millimetre);
        let surface = |values: &Values| [values.mmd, values.smd];
        let newer = [pressed, self.miu, self.t0, self.lc, self.wc, self.rc].into_iter();
        let newer = newer.chain(surface(&self.warp)).chain(surface(&self.weft));
        for (index, value) in newer.enumerate() {
            value
                .into_iter()
                .for_each(|value| [index as f64, value].into_iter().for_each(&mut number));
        }
        for stated in &self.scatter {
            let kinds = [stated.direction as u8, stated.symbol as u8].map(f64::from);
            kinds.into_iter().chain([stated.deviation]).for_each(&mut number);
        }
        for repeat in self.curves.iter().flat_map(Curve::repeats) {
            let points = repeat.deformation().iter().chain(repeat.load());
            points.for_each(|&value| number(value));
        }
        hasher.finalize().to_hex().to_string()
    }

    /// Returns what each curve file was taken for, a line each: its encoding, separators, header,
    /// columns, units and repeats, as far as they were not declared.
    #[must_use]
    pub fn readings(&self) -> &[String] {
        &self.readings
    }

    /// Returns warnings about values that are admissible but that few fabrics have, and about
    /// repairs.
    #[must_use]
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }
}
