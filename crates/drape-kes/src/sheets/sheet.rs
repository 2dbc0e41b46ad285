//! Sheet of a laboratory: KES values in its own units, and curves in SI.

use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, Document};
use toml::de::DeTable;

use crate::curves::curve::Curve;
use crate::error::Error;
use crate::sheets::findings::Findings;
use crate::sheets::model::Model;
use crate::sheets::section::{Choice, Measured, Section};
use crate::sheets::{curve_file, plausible};
use crate::symbol::Symbol;
use crate::test::{Direction, Test};
use drape_input::Quantity;
use crate::values::Values;

/// Name of the sheet in a folder.
const SHEET_FILE: &str = "sheet.toml";

const SHEET_KEYS: [&str; 11] =
    ["name", "source", "model", "W", "T", "TM", "MIU", "FM", "warp", "weft", "curve"];
const VALUE_KEYS: [&str; 9] = ["B", "2HB", "G", "2HG", "2HG5", "LT", "WT", "RT", "EM"];
const MODEL: Choice<'_, Model> = Choice { key: "model", values: &Model::ALL, name: Model::name };

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
    /// Law that bending and shear are to be fitted with; selected by the data unless set.
    pub model: Option<Model>,
    /// W, mass per area, in mg/cm².
    pub w: Option<f64>,
    /// T, thickness, in mm.
    pub t: Option<f64>,
    /// TM, thickness under 50 gf/cm² in the compression test, in mm.
    pub tm: Option<f64>,
    /// MIU, coefficient of friction of the surface test, a ratio.
    pub miu: Option<f64>,
    /// FM, maximum load of the tensile test, in gf/cm; 500 in the standard test when not given.
    pub fm: Option<f64>,
    /// Values along the warp.
    pub warp: Values,
    /// Values along the weft.
    pub weft: Values,
    /// Measured curves, in SI.
    pub curves: Vec<Curve>,
    warnings: Vec<Diagnostic>,
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
        // Decoding into a plain table reports mistakes of grammar as for every other file.
        document.decode::<toml::Table>()?;
        let table = DeTable::parse(document.text()).expect("the text has just been decoded");
        let mut findings = Findings::new(&document);
        let sheet = Self::check(&Section::root(table.get_ref()), &mut findings);
        Diagnostics::check(findings.errors)?;
        Ok(Self { warnings: findings.warnings, ..sheet })
    }

    fn check(root: &Section<'_>, findings: &mut Findings<'_>) -> Self {
        root.allow(&SHEET_KEYS, findings);
        let name = root.required_text("name", "\"cotton poplin\"", findings);
        let source = root.text("source", findings);
        let model = root.choice(&MODEL, findings);
        let w = positive(root, "W", Quantity::MassPerArea, findings);
        let t = positive(root, "T", Quantity::Length, findings);
        let tm = pressed_thickness(root, t.as_ref(), findings);
        let miu = MIU.read(root, findings);
        let fm = positive(root, "FM", Quantity::ForcePerWidth, findings);
        if let Some(w) = &w {
            plausible::density(w, findings);
        }
        let warp = values(root, Direction::Warp, w.as_ref(), findings);
        let weft = values(root, Direction::Weft, w.as_ref(), findings);
        let curves = root
            .sections("curve", findings)
            .iter()
            .filter_map(|section| curve_file::read(section, findings))
            .collect();
        let laboratory = |value: Option<Measured>| value.map(|value| value.laboratory);
        Self {
            name: name.unwrap_or_default(),
            source: source.unwrap_or_default(),
            model,
            w: laboratory(w),
            t: laboratory(t),
            tm: laboratory(tm),
            miu,
            fm: laboratory(fm),
            warp,
            weft,
            curves,
            warnings: Vec::new(),
        }
    }

    /// Returns W: mass per area, in kg/m².
    #[must_use]
    pub fn density(&self) -> Option<f64> {
        self.w.map(|w| w * Quantity::MassPerArea.laboratory().factor)
    }

    /// Returns T: thickness, in metres.
    #[must_use]
    pub fn thickness(&self) -> Option<f64> {
        self.t.map(|t| t * Quantity::Length.laboratory().factor)
    }

    /// Returns TM: thickness under 50 gf/cm², which is 4.9 kPa, in metres.
    #[must_use]
    pub fn pressed_thickness(&self) -> Option<f64> {
        self.tm.map(|tm| tm * Quantity::Length.laboratory().factor)
    }

    /// Returns FM: the maximum load of the tensile test, given or standard, in N/m.
    #[must_use]
    pub fn maximum_tension(&self) -> f64 {
        self.fm.unwrap_or(STANDARD_MAXIMUM_TENSION) * Quantity::ForcePerWidth.laboratory().factor
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
        for (index, value) in [self.pressed_thickness(), self.miu].into_iter().enumerate() {
            value
                .into_iter()
                .for_each(|value| [index as f64, value].into_iter().for_each(&mut number));
        }
        hasher.finalize().to_hex().to_string()
    }

    /// Returns warnings about values that are admissible but that few fabrics have, and about
    /// repairs.
    #[must_use]
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }
}

/// Reads the values of one direction and checks each of them.
fn values(
    root: &Section<'_>,
    direction: Direction,
    w: Option<&Measured>,
    findings: &mut Findings<'_>,
) -> Values {
    let Some(section) = root.section(direction.name(), findings) else {
        return Values::default();
    };
    section.allow(&VALUE_KEYS, findings);
    let laboratory = |value: Option<Measured>| value.map(|value| value.laboratory);
    let b = section.measured("B", Quantity::BendingRigidity, findings);
    let b = b.filter(|b| plausible::bending_rigidity(b, findings));
    if let Some(b) = &b {
        plausible::bending(direction, b, w, findings);
    }
    let mut at_least_zero =
        |key, quantity| laboratory(zero_or_more(&section, key, quantity, findings));
    let two_hb = at_least_zero("2HB", Quantity::MomentPerWidth);
    let two_hg = at_least_zero("2HG", Quantity::ForcePerWidth);
    let two_hg5 = at_least_zero("2HG5", Quantity::ForcePerWidth);
    let mut above_zero = |key, quantity| laboratory(positive(&section, key, quantity, findings));
    let g = above_zero("G", Quantity::ShearStiffness);
    let wt = above_zero("WT", Quantity::WorkPerArea);
    let em = above_zero("EM", Quantity::Ratio);
    let lt = LT.read(&section, findings);
    let rt = resilience(&section, findings);
    Values { b: laboratory(b), two_hb, g, two_hg, two_hg5, lt, wt, rt, em }
}

/// Value that is a ratio and not a percentage: a bare number is a ratio.
struct Ratio {
    key: &'static str,
    /// Upper limit.
    limit: f64,
    help: &'static str,
}

/// LT, at most 2: the work under a curve of constant sign cannot exceed the box around it, which is
/// twice the triangle.
const LT: Ratio = Ratio {
    key: "LT",
    limit: 2.0,
    help: "LT is a ratio, about 0.5 to 1; is this another value, or a percentage?",
};
const MIU: Ratio = Ratio {
    key: "MIU",
    limit: 2.0,
    help: "MIU is a ratio, about 0.1 to 0.3; is this a percentage?",
};

impl Ratio {
    fn read(&self, section: &Section<'_>, findings: &mut Findings<'_>) -> Option<f64> {
        let Self { key, limit, help } = *self;
        let value = positive(section, key, Quantity::Ratio, findings)?;
        // A bare number was parsed as a percentage, the laboratory's unit of every other ratio.
        let ratio = if value.written.parse::<f64>().is_ok() { value.number } else { value.si };
        if ratio < limit {
            return Some(ratio);
        }
        findings.error(&value.key, format!("{} is not between 0 and {limit}", value.written), help);
        None
    }
}

/// Reads TM, which is not above T.
fn pressed_thickness(
    root: &Section<'_>,
    t: Option<&Measured>,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let tm = positive(root, "TM", Quantity::Length, findings)?;
    let Some(t) = t.filter(|t| tm.si > t.si) else { return Some(tm) };
    findings.error(
        &tm.key,
        format!("{} is more than T, {}", tm.written, t.written),
        "TM is the thickness under 50 gf/cm², T that under 0.5 gf/cm²",
    );
    None
}

/// Reads RT, which is at most 100 %.
fn resilience(section: &Section<'_>, findings: &mut Findings<'_>) -> Option<f64> {
    let rt = positive(section, "RT", Quantity::Ratio, findings)?;
    if rt.si <= 1.0 {
        return Some(rt.laboratory);
    }
    findings.error(
        &rt.key,
        format!("{} is more than 100 %, which no fabric gives back", rt.written),
        "RT is recovered work over work spent, in percent",
    );
    None
}

/// Reads a number greater than zero.
fn positive(
    section: &Section<'_>,
    key: &str,
    quantity: Quantity,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let value = section.measured(key, quantity, findings)?;
    if value.si > 0.0 {
        return Some(value);
    }
    findings.error(
        &value.key,
        format!("{} is not greater than 0", value.written),
        "write the measured value, or remove the line if it was not measured",
    );
    None
}

/// Reads a loop width, zero or more.
fn zero_or_more(
    section: &Section<'_>,
    key: &str,
    quantity: Quantity,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let value = section.measured(key, quantity, findings)?;
    if value.si >= 0.0 {
        return Some(value);
    }
    findings.error(
        &value.key,
        format!("{} is negative", value.written),
        "a loop width is the distance between the two branches, without sign",
    );
    None
}
