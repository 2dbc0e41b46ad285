//! Sheet of a laboratory: KES values in the laboratory's units, and curves in SI.

use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, Document};

use crate::curves::curve::Curve;
use crate::error::Error;
use crate::scatter::{OtherScatter, Scatter};
use crate::sheets::checks::plausible;
use crate::sheets::file::SheetFile;
use crate::sheets::file::forms::RecordText;
use crate::sheets::file::stated::laboratory_value;
use crate::sheets::findings::Findings;
use crate::sheets::model::Model;
use crate::sheets::value_keys::{DirectedValues, WholeValues};
use crate::sheets::{curve_file, repeats, spelling};
use crate::symbol::Symbol;
use crate::test::{Direction, Test};
use crate::test_record::{Fault, TestRecord};
use crate::values::Values;
use drape_input::Quantity;

/// Name of the sheet in a folder.
const SHEET_FILE: &str = "sheet.toml";

/// Sheet of one fabric: KES values, curves and their source.
///
/// Fields named by a symbol are in the laboratory's units. Curves are in SI.
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
    /// Law that bending and shear are to be fitted with. `None` lets the data select a law.
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
    /// FM, maximum load of the tensile test, in gf/cm. [`Sheet::maximum_tension`] replaces a
    /// missing FM.
    pub fm: Option<f64>,
    /// Values along the warp.
    pub warp: Values,
    /// Values along the weft.
    pub weft: Values,
    /// Symbols of the values whose one number stands for both directions.
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

/// Returns the record of a test in `file`.
fn read_record(file: &SheetFile, findings: &mut Findings<'_>) -> TestRecord {
    let texts = [
        ("customer", &file.customer),
        ("article", &file.article),
        ("laboratory", &file.laboratory),
        ("date", &file.date),
        ("specimens", &file.specimens),
    ];
    let mut record = TestRecord::default();
    for (key, text) in texts {
        let Some(RecordText(text)) = text else { continue };
        if let Err(Fault { message, help }) = record.set_line(key, text) {
            findings.error(key, message, help);
        }
    }
    record
}

impl Sheet {
    /// Reads the sheet at `path` and the curves that it names. A folder means the `sheet.toml` in
    /// the folder.
    ///
    /// # Errors
    /// The file cannot be read, or the sheet or one of its curve files has mistakes. The error has
    /// all mistakes, each with file, line, value and remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let document = if path.is_dir() {
            Document::read(path.join(SHEET_FILE))?
        } else {
            Document::read(path)?
        };
        Self::from_document(&document)
    }

    /// Reads a sheet from `document`. The curves that the sheet names are in the folder of the
    /// document's path.
    ///
    /// # Errors
    /// As for [`Sheet::read`].
    pub fn from_document(document: &Document) -> Result<Self, Error> {
        let (document, twice) = spelling::with_known_keys(document.clone());
        let (file, faults) = document.decode_with_faults::<SheetFile>()?;
        let mut findings = Findings::new(&document, faults);
        let sheet = Self::check(file, &mut findings);
        let Findings { errors, faults, warnings, readings, .. } = findings;
        Diagnostics::check([twice, faults.into_mistakes(), errors].concat())?;
        Ok(Self { warnings, readings, ..sheet })
    }

    /// Returns the sheet of `file`, and collects the mistakes in its values, curves and record.
    fn check(mut file: SheetFile, findings: &mut Findings<'_>) -> Self {
        let record = read_record(&file, findings);
        if file.model.is_some() {
            warn_former_name(findings);
        }
        let whole = WholeValues::read(&file, findings);
        if let Some(w) = &whole.w {
            plausible::density(w, findings);
        }
        let DirectedValues { warp, weft, shared, scatter } =
            DirectedValues::read(&mut file, whole.w.as_ref(), findings);

        // Repeats of one test are replaced by their mean.
        let mut curves = Vec::new();
        for (index, curve) in file.curve.iter().enumerate() {
            curves.extend(curve_file::read(index, curve, findings));
        }
        let curves = repeats::with_means(curves, findings);

        // The friction of the fabric is the mean of both directions.
        let known: Vec<f64> = [warp.miu, weft.miu].into_iter().flatten().collect();
        let miu = match known.as_slice() {
            [] => None,
            [first, .., last] if first == last => Some(*first),
            values => Some(values.iter().sum::<f64>() / values.len() as f64),
        };

        let sheet = Self {
            name: file.name,
            source: file.source,
            record,
            model: file.model,
            w: laboratory_value(whole.w),
            t: laboratory_value(whole.t),
            t0: laboratory_value(whole.t0),
            tm: laboratory_value(whole.tm),
            lc: whole.lc,
            wc: laboratory_value(whole.wc),
            rc: laboratory_value(whole.rc),
            miu,
            fm: laboratory_value(whole.fm),
            warp,
            weft,
            shared,
            scatter,
            other_scatter: std::mem::take(&mut findings.other_scatter),
            curves,
            warnings: Vec::new(),
            readings: Vec::new(),
        };

        sheet.compare_compression(findings);
        sheet.compare_loads(findings);
        findings.warn_unused_scatter();
        sheet
    }

    /// Adds `readings`, what values of a draft were taken for, and `notes`, what was assumed or
    /// left out.
    pub(crate) fn add_readings(&mut self, readings: &[String], notes: &[String]) {
        self.readings.splice(0..0, readings.iter().cloned());
        self.readings.extend(notes.iter().map(|note| format!("note: {note}")));
    }

    /// Returns `W`: mass per area, in kg/m².
    #[must_use]
    pub fn density(&self) -> Option<f64> {
        self.w.map(|w| w * Quantity::MassPerArea.laboratory().factor)
    }

    /// Returns `T0`, else `T`: thickness, in metres.
    #[must_use]
    pub fn thickness(&self) -> Option<f64> {
        self.t0.or(self.t).map(|t| t * Quantity::Length.laboratory().factor)
    }

    /// Returns `FM`: the maximum load of the tensile test, in N/m.
    ///
    /// A missing `fm` is replaced by the largest load of the tensile curves. If the sheet has
    /// values of the tensile test, or no tensile curve, the load of the standard test replaces
    /// `fm`.
    #[must_use]
    pub fn maximum_tension(&self) -> f64 {
        /// FM of the standard tensile test, in gf/cm. The "high sensitivity" test stops at 50.
        const STANDARD_MAXIMUM_TENSION: f64 = 500.0;

        let unit = Quantity::ForcePerWidth.laboratory().factor;
        let given = self.fm.map(|fm| fm * unit);
        given
            .or_else(|| self.load_of_curves().filter(|_| !self.has_tensile_values()))
            .unwrap_or(STANDARD_MAXIMUM_TENSION * unit)
    }

    /// Returns the KES values of `direction`.
    #[must_use]
    pub fn values(&self, direction: Direction) -> &Values {
        match direction {
            Direction::Warp => &self.warp,
            Direction::Weft => &self.weft,
        }
    }

    /// Returns the curves of `test` and `direction`, in the order of the sheet.
    pub fn curves_of(&self, test: Test, direction: Direction) -> impl Iterator<Item = &Curve> {
        self.curves.iter().filter(move |curve| curve.test == test && curve.direction == direction)
    }

    /// Returns a digest of the measured numbers, which does not depend on the layout of the files.
    ///
    /// The digest is the BLAKE3 hash, in hexadecimal, of all values and of all points of all
    /// curves, in SI to the last bit. Names and remarks are not part of the digest.
    #[must_use]
    pub fn digest(&self) -> String {
        let mut hasher = blake3::Hasher::new();

        // A missing value counts as a NaN, because no given value is a NaN.
        let given = [self.density(), self.thickness(), self.fm];
        let directed = [&self.warp, &self.weft]
            .into_iter()
            .flat_map(|values| Symbol::ALL.map(|symbol| values.get(symbol)));
        for value in given.into_iter().chain(directed) {
            hash(&mut hasher, [value.unwrap_or(f64::NAN)]);
        }
        for curve in &self.curves {
            let kind = [curve.test as u8, curve.direction as u8, u8::from(curve.slack)];
            hash(&mut hasher, kind.map(f64::from));
            hash(&mut hasher, [curve.gauge.unwrap_or(f64::NAN), curve.load().len() as f64]);
            hash(&mut hasher, curve.deformation().iter().chain(curve.load()).copied());
        }

        // Newer keys count only where they are given, so that older sheets keep their digests.
        let millimetre = Quantity::Length.laboratory().factor;
        let pressed = self.tm.map(|tm| tm * millimetre);
        let compression = [pressed, self.miu, self.t0, self.lc, self.wc, self.rc].into_iter();
        let surface =
            [&self.warp, &self.weft].into_iter().flat_map(|values| [values.mmd, values.smd]);
        for (index, value) in compression.chain(surface).enumerate() {
            if let Some(value) = value {
                hash(&mut hasher, [index as f64, value]);
            }
        }
        for stated in &self.scatter {
            let kinds = [stated.direction as u8, stated.symbol as u8].map(f64::from);
            hash(&mut hasher, kinds.into_iter().chain([stated.deviation]));
        }
        for repeat in self.curves.iter().flat_map(Curve::repeats) {
            hash(&mut hasher, repeat.deformation().iter().chain(repeat.load()).copied());
        }
        hasher.finalize().to_hex().to_string()
    }

    /// Returns what each curve file was taken for, one line per file: encoding, separators, header,
    /// columns, units and repeats, as far as the sheet does not declare them.
    #[must_use]
    pub fn readings(&self) -> &[String] {
        &self.readings
    }

    /// Returns warnings about repairs, and about admissible values that few fabrics have.
    #[must_use]
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }
}

/// Warns about a former name of the law that a sheet asks for. The edit of the warning writes the
/// name of today.
fn warn_former_name(findings: &mut Findings<'_>) {
    const KEY: &str = "model";

    let document = findings.document;
    let written = document.text_at(KEY).unwrap_or_default();
    let (Some(note), Some(law)) = (Model::note_on(&written), Model::named(&written)) else {
        return;
    };
    let name = format!("\"{}\"", law.name());
    let warning = document.at(KEY, note).help(format!("write model = {name}"));
    findings.warnings.push(warning.with_edits(document.edit(KEY, Some(&name))));
}

/// Adds `numbers` to the digest of `hasher`.
fn hash(hasher: &mut blake3::Hasher, numbers: impl IntoIterator<Item = f64>) {
    for number in numbers {
        hasher.update(&number.to_le_bytes());
    }
}
