//! KES values of a sheet, by direction or for both directions.

use crate::scatter::{self, OtherScatter, Scatter};
use crate::sheets::checks::plausible;
use crate::sheets::file::stated::{Measured, Stated, laboratory_value};
use crate::sheets::file::{SheetFile, ValuesFile};
use crate::sheets::findings::Findings;
use crate::symbol::Symbol;
use crate::test::Direction;
use crate::values::Values;
use drape_input::Quantity;

/// Values of a sheet that have no direction, as measured.
#[derive(Debug, Default)]
pub(crate) struct WholeValues {
    pub(crate) w: Option<Measured>,
    pub(crate) t: Option<Measured>,
    pub(crate) t0: Option<Measured>,
    pub(crate) tm: Option<Measured>,
    pub(crate) lc: Option<f64>,
    pub(crate) wc: Option<Measured>,
    pub(crate) rc: Option<Measured>,
    pub(crate) fm: Option<Measured>,
}

impl WholeValues {
    /// Returns the values of `file` that have no direction, and checks TM against T0.
    pub(crate) fn read(file: &SheetFile, findings: &mut Findings<'_>) -> Self {
        let w = positive(at(&file.w, "W"), findings);
        let t = positive(at(&file.t, "T"), findings);
        let t0 = positive(at(&file.t0, "T0"), findings);
        let tm = pressed_thickness(at(&file.tm, "TM"), t0.as_ref().or(t.as_ref()), findings);
        let lc = LC.check(at(&file.lc, "LC"), findings);
        let wc = positive(at(&file.wc, "WC"), findings);
        let rc = percentage(at(&file.rc, "RC"), "RC", findings);
        let fm = positive(at(&file.fm, "FM"), findings);

        let values =
            [("W", &w), ("T", &t), ("T0", &t0), ("TM", &tm), ("WC", &wc), ("RC", &rc), ("FM", &fm)];
        for (symbol, value) in values {
            let value = value.as_ref().map(|value| (value, value.laboratory));
            note_unused_scatter((symbol, None), value, findings);
        }
        note_unused_scatter(("LC", None), lc.as_ref().map(|lc| (lc, lc.si)), findings);
        Self { w, t, t0, tm, lc: lc.map(|lc| lc.si), wc, rc, fm }
    }
}

/// Values of warp and weft, and the symbols of the values whose one number stands for both.
#[derive(Debug, Default)]
pub(crate) struct DirectedValues {
    pub(crate) warp: Values,
    pub(crate) weft: Values,
    pub(crate) shared: Vec<&'static str>,
    pub(crate) scatter: Vec<Scatter>,
}

impl DirectedValues {
    /// Returns the values of each direction: from the table of the direction, else from the values
    /// of `file` for both directions. `w` is the mass per area.
    pub(crate) fn read(
        file: &mut SheetFile,
        w: Option<&Measured>,
        findings: &mut Findings<'_>,
    ) -> Self {
        let shared_values = file.take_shared();
        let mut read = Self::default();
        for direction in [Direction::Warp, Direction::Weft] {
            let mut tables = ValueTables {
                directed: match direction {
                    Direction::Warp => &file.warp,
                    Direction::Weft => &file.weft,
                },
                shared_values: &shared_values,
                direction,
                shared: &mut read.shared,
                scatter: &mut read.scatter,
            };
            let values = values(&mut tables, w, findings);
            match direction {
                Direction::Warp => read.warp = values,
                Direction::Weft => read.weft = values,
            }
        }
        read.shared.sort_unstable();
        read.shared.dedup();
        read
    }
}

/// Tables in which a value of one direction may stand.
struct ValueTables<'a> {
    /// Table of the direction.
    directed: &'a ValuesFile,
    /// Values for both directions.
    shared_values: &'a ValuesFile,
    direction: Direction,
    shared: &'a mut Vec<&'static str>,
    scatter: &'a mut Vec<Scatter>,
}

impl ValueTables<'_> {
    /// Returns the value of the `field` with the key `key`. A value for both directions is noted in
    /// `shared`.
    fn find<D>(
        &mut self,
        key: &'static str,
        field: fn(&ValuesFile) -> &Option<Stated<D>>,
    ) -> Option<Measured> {
        if let Some(stated) = field(self.directed) {
            return Some(stated.at(format!("{}.{key}", self.direction.name())));
        }
        let stated = field(self.shared_values).as_ref()?;
        self.shared.push(key);
        Some(stated.at(key))
    }

    /// Returns the checked `value` of `symbol`, which a law uses, and keeps the standard deviation
    /// that is stated with the value.
    fn keep(&mut self, symbol: Symbol, value: Option<Measured>) -> Option<Measured> {
        let value = value?;
        self.scatter.extend(value.deviation.map(|deviation| Scatter {
            direction: self.direction,
            symbol,
            deviation: deviation / symbol.factor(),
        }));
        Some(value)
    }

    /// Returns the loop width `symbol`, zero or more, in the laboratory's unit.
    fn loop_width<D>(
        &mut self,
        symbol: Symbol,
        field: fn(&ValuesFile) -> &Option<Stated<D>>,
        findings: &mut Findings<'_>,
    ) -> Option<f64> {
        let value = zero_or_more(self.find(symbol.name(), field), findings);
        laboratory_value(self.keep(symbol, value))
    }

    /// Returns the value `symbol`, greater than zero, in the laboratory's unit.
    fn positive<D>(
        &mut self,
        symbol: Symbol,
        field: fn(&ValuesFile) -> &Option<Stated<D>>,
        findings: &mut Findings<'_>,
    ) -> Option<f64> {
        let value = positive(self.find(symbol.name(), field), findings);
        laboratory_value(self.keep(symbol, value))
    }
}

/// Returns the value `stated`, which stands at the key path `key`.
fn at<D>(stated: &Option<Stated<D>>, key: &str) -> Option<Measured> {
    stated.as_ref().map(|stated| stated.at(key))
}

/// Returns the values of the direction of `tables` and checks each value. `w` is the mass per area.
fn values(
    tables: &mut ValueTables<'_>,
    w: Option<&Measured>,
    findings: &mut Findings<'_>,
) -> Values {
    let direction = tables.direction;
    let b = tables.find("B", |values| &values.b);
    let b = b.filter(|b| plausible::bending_rigidity(b, findings));
    let b = tables.keep(Symbol::B, b);
    if let Some(b) = &b {
        plausible::bending(direction, b, w, findings);
    }

    let two_hb = tables.loop_width(Symbol::TwoHb, |values| &values.two_hb, findings);
    let two_hg = tables.loop_width(Symbol::TwoHg, |values| &values.two_hg, findings);
    let two_hg5 = tables.loop_width(Symbol::TwoHg5, |values| &values.two_hg5, findings);
    let g = tables.positive(Symbol::G, |values| &values.g, findings);
    let wt = tables.positive(Symbol::Wt, |values| &values.wt, findings);
    let em = tables.positive(Symbol::Em, |values| &values.em, findings);
    let lt = LT.check(tables.find("LT", |values| &values.lt), findings);
    let lt = tables.keep(Symbol::Lt, lt);
    let rt = percentage(tables.find("RT", |values| &values.rt), "RT", findings);
    let rt = laboratory_value(tables.keep(Symbol::Rt, rt));

    // No law uses the values of the surface test, so their standard deviations are only listed.
    let smd = positive(tables.find("SMD", |values| &values.smd), findings);
    let miu = MIU.check(tables.find("MIU", |values| &values.miu), findings);
    let mmd = MMD.check(tables.find("MMD", |values| &values.mmd), findings);
    let roughness = smd.as_ref().map(|smd| (smd, smd.laboratory));
    note_unused_scatter(("SMD", Some(direction)), roughness, findings);
    for (symbol, ratio) in [("MIU", &miu), ("MMD", &mmd)] {
        let value = ratio.as_ref().map(|ratio| (ratio, ratio.si));
        note_unused_scatter((symbol, Some(direction)), value, findings);
    }

    Values {
        b: laboratory_value(b),
        two_hb,
        g,
        two_hg,
        two_hg5,
        lt: lt.map(|lt| lt.si),
        wt,
        rt,
        em,
        miu: miu.map(|miu| miu.si),
        mmd: mmd.map(|mmd| mmd.si),
        smd: laboratory_value(smd),
    }
}

/// Notes that no law uses the standard deviation of a value, and keeps the deviation. `value` is
/// the measured value and its number in the unit of the sheet.
fn note_unused_scatter(
    (symbol, direction): (&'static str, Option<Direction>),
    value: Option<(&Measured, f64)>,
    findings: &mut Findings<'_>,
) {
    let Some((value, number)) = value else { return };
    let Some(deviation) = value.deviation else { return };
    if !findings.unused_scatter.contains(&value.key) {
        findings.unused_scatter.push(value.key.clone());
    }
    findings.other_scatter.push(OtherScatter {
        symbol,
        direction,
        deviation: deviation * number / value.si,
    });
}

/// Value that is a ratio and not a percentage: a number without unit is a ratio.
struct Ratio {
    /// Upper limit.
    limit: f64,
    help: &'static str,
}

/// LT, at most 2: the work under a curve of constant sign cannot exceed the box around it, which is
/// twice the triangle.
const LT: Ratio = Ratio {
    limit: 2.0,
    help: "LT is a ratio, about 0.5 to 1; is this another value, or a percentage?",
};
/// LC, bounded as LT is.
const LC: Ratio = Ratio {
    limit: 2.0,
    help: "LC is a ratio, about 0.2 to 0.5; is this another value, or a percentage?",
};
const MIU: Ratio =
    Ratio { limit: 2.0, help: "MIU is a ratio, about 0.1 to 0.3; is this a percentage?" };
/// MMD, which some print a hundredfold.
const MMD: Ratio =
    Ratio { limit: 10.0, help: "MMD is a ratio, about 0.005 to 0.05; is this another value?" };

impl Ratio {
    /// Returns the ratio `value`, above zero and below the limit. Returns `None` after reporting a
    /// mistake.
    fn check(&self, value: Option<Measured>, findings: &mut Findings<'_>) -> Option<Measured> {
        let Self { limit, help } = *self;
        let mut value = positive(value, findings)?;
        // A number without unit was parsed as a percentage, the laboratory's unit of other ratios.
        if scatter::is_bare(&value.written) {
            let percent = Quantity::Ratio.laboratory().factor;
            value.si = value.number;
            value.deviation = value.deviation.map(|deviation| deviation / percent);
        }
        if value.si < limit {
            return Some(value);
        }
        findings.error(&value.key, format!("{} is not between 0 and {limit}", value.written), help);
        None
    }
}

/// Returns the value `tm`, above zero and at most the thickness `t0`.
fn pressed_thickness(
    tm: Option<Measured>,
    t0: Option<&Measured>,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let tm = positive(tm, findings)?;
    let Some(t0) = t0.filter(|t0| tm.si > t0.si) else { return Some(tm) };
    let t0_key = findings.document.key_as_written(&t0.key);
    findings.error(
        &tm.key,
        format!("{} is more than {t0_key}, {}", tm.written, t0.written),
        "TM is the thickness under 50 gf/cm², T0 or T that under 0.5 gf/cm²",
    );
    None
}

/// Returns the `value` of RT or RC, whose symbol is `symbol`: above zero and at most 100 %.
fn percentage(
    value: Option<Measured>,
    symbol: &str,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let value = positive(value, findings)?;
    if value.si <= 1.0 {
        return Some(value);
    }
    let message = format!("{} is more than 100 %, which no fabric gives back", value.written);
    let help = format!("{symbol} is recovered work over work spent, in percent");
    findings.error(&value.key, message, help);
    None
}

/// Returns `value` if it is greater than zero. Returns `None` after reporting a mistake.
fn positive(value: Option<Measured>, findings: &mut Findings<'_>) -> Option<Measured> {
    let value = value?;
    if value.si > 0.0 {
        return Some(value);
    }
    let help = "write the measured value, or remove the line if it was not measured";
    findings.error(&value.key, format!("{} is not greater than 0", value.written), help);
    None
}

/// Returns the loop width `value` if it is zero or more. Returns `None` after reporting a mistake.
fn zero_or_more(value: Option<Measured>, findings: &mut Findings<'_>) -> Option<Measured> {
    let value = value?;
    if value.si >= 0.0 {
        return Some(value);
    }
    let help = "a loop width is the distance between the two branches, without sign";
    findings.error(&value.key, format!("{} is negative", value.written), help);
    None
}
