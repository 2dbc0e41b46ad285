//! KES values of a sheet, by direction or for both directions, in any spelling.

use crate::scatter::{self, OtherScatter, Scatter};
use crate::sheets::checks::plausible;
use crate::sheets::findings::Findings;
use crate::sheets::section::{Measured, Section, laboratory_value};
use crate::sheets::spelling::KEYS;
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
    /// Reads the values of `root` that have no direction, and checks TM against T0.
    pub(crate) fn read(root: &Section<'_>, findings: &mut Findings<'_>) -> Self {
        let w = positive(root, "W", Quantity::MassPerArea, findings);
        let t = positive(root, "T", Quantity::Length, findings);
        let t0 = positive(root, "T0", Quantity::Length, findings);
        let tm = pressed_thickness(root, t0.as_ref().or(t.as_ref()), findings);
        let lc = LC.measured(root, findings);
        let wc = positive(root, "WC", Quantity::WorkPerArea, findings);
        let rc = percentage(root, "RC", findings);
        let fm = positive(root, "FM", Quantity::ForcePerWidth, findings);

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
    /// Reads the values of each direction: from the table of the direction, from a key that names
    /// the direction, else from the number for both directions. `w` is the mass per area.
    pub(crate) fn read(
        root: &Section<'_>,
        w: Option<&Measured>,
        findings: &mut Findings<'_>,
    ) -> Self {
        let sections = [Direction::Warp, Direction::Weft].map(|direction| {
            let section = root.directed(direction, findings);
            if let Some(section) = &section {
                section.allow_values(&KEYS, findings);
            }
            section
        });
        let mean = root.section("mean", findings);
        if let Some(mean) = &mean {
            mean.allow_values(&KEYS, findings);
        }

        let mut read = Self::default();
        for (index, direction) in [Direction::Warp, Direction::Weft].into_iter().enumerate() {
            let mut shared = Vec::new();
            let mut tables = ValueTables {
                directed: sections[index].as_ref(),
                root,
                mean: mean.as_ref(),
                direction,
                shared: &mut shared,
                scatter: &mut read.scatter,
            };
            let values = values(&mut tables, w, findings);
            match direction {
                Direction::Warp => read.warp = values,
                Direction::Weft => read.weft = values,
            }
            read.shared.extend(shared);
        }
        read.shared.sort_unstable();
        read.shared.dedup();
        read
    }
}

/// Tables in which a value of one direction may stand.
struct ValueTables<'a, 't> {
    /// Table of the direction.
    directed: Option<&'a Section<'t>>,
    root: &'a Section<'t>,
    /// Table of the values for both directions.
    mean: Option<&'a Section<'t>>,
    direction: Direction,
    shared: &'a mut Vec<&'static str>,
    scatter: &'a mut Vec<Scatter>,
}

impl<'t> ValueTables<'_, 't> {
    /// Reads the value `symbol` that a law uses with `read`, and keeps the standard deviation that
    /// is stated with the value.
    fn read(
        &mut self,
        symbol: Symbol,
        read: impl FnOnce(&Section<'t>) -> Option<Measured>,
    ) -> Option<Measured> {
        let value = read(&self.find(symbol.name())?)?;
        self.scatter.extend(value.deviation.map(|deviation| Scatter {
            direction: self.direction,
            symbol,
            deviation: deviation / symbol.factor(),
        }));
        Some(value)
    }

    /// Returns the section that reads the value `key`. A value for both directions is noted in
    /// `shared`.
    fn find(&mut self, key: &'static str) -> Option<Section<'t>> {
        if let Some(directed) = self.directed.filter(|directed| directed.has_value(key, None)) {
            return Some(directed.clone().with_direction(None));
        }
        if self.root.has_value(key, Some(self.direction)) {
            return Some(self.root.clone().with_direction(Some(self.direction)));
        }
        // A number at the top of the sheet or in `mean` stands for both directions.
        let mean = self.mean.filter(|mean| mean.has_value(key, None));
        let found = mean.or_else(|| self.root.has_value(key, None).then_some(self.root))?;
        self.shared.push(key);
        Some(found.clone().with_direction(None))
    }

    /// Reads the loop width `symbol`, zero or more, in the laboratory's unit.
    fn loop_width(
        &mut self,
        symbol: Symbol,
        quantity: Quantity,
        findings: &mut Findings<'_>,
    ) -> Option<f64> {
        laboratory_value(
            self.read(symbol, |section| zero_or_more(section, symbol.name(), quantity, findings)),
        )
    }

    /// Reads the value `symbol`, greater than zero, in the laboratory's unit.
    fn positive(
        &mut self,
        symbol: Symbol,
        quantity: Quantity,
        findings: &mut Findings<'_>,
    ) -> Option<f64> {
        laboratory_value(
            self.read(symbol, |section| positive(section, symbol.name(), quantity, findings)),
        )
    }
}

/// Reads the values of the direction of `tables` and checks each value. `w` is the mass per area.
fn values(
    tables: &mut ValueTables<'_, '_>,
    w: Option<&Measured>,
    findings: &mut Findings<'_>,
) -> Values {
    let direction = tables.direction;
    let b = tables.read(Symbol::B, |section| {
        let b = section.measured("B", Quantity::BendingRigidity, findings)?;
        Some(b).filter(|b| plausible::bending_rigidity(b, findings))
    });
    if let Some(b) = &b {
        plausible::bending(direction, b, w, findings);
    }

    let two_hb = tables.loop_width(Symbol::TwoHb, Quantity::MomentPerWidth, findings);
    let two_hg = tables.loop_width(Symbol::TwoHg, Quantity::ForcePerWidth, findings);
    let two_hg5 = tables.loop_width(Symbol::TwoHg5, Quantity::ForcePerWidth, findings);
    let g = tables.positive(Symbol::G, Quantity::ShearStiffness, findings);
    let wt = tables.positive(Symbol::Wt, Quantity::WorkPerArea, findings);
    let em = tables.positive(Symbol::Em, Quantity::Ratio, findings);
    let lt = tables.read(Symbol::Lt, |section| LT.measured(section, findings));
    let rt = laboratory_value(tables.read(Symbol::Rt, |s| percentage(s, "RT", findings)));

    // No law uses the values of the surface test, so their standard deviations are only listed.
    let smd = tables.find("SMD").and_then(|s| positive(&s, "SMD", Quantity::Roughness, findings));
    let miu = tables.find("MIU").and_then(|section| MIU.measured(&section, findings));
    let mmd = tables.find("MMD").and_then(|section| MMD.measured(&section, findings));
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
/// LC, bounded as LT is.
const LC: Ratio = Ratio {
    key: "LC",
    limit: 2.0,
    help: "LC is a ratio, about 0.2 to 0.5; is this another value, or a percentage?",
};
const MIU: Ratio = Ratio {
    key: "MIU",
    limit: 2.0,
    help: "MIU is a ratio, about 0.1 to 0.3; is this a percentage?",
};
/// MMD, which some print a hundredfold.
const MMD: Ratio = Ratio {
    key: "MMD",
    limit: 10.0,
    help: "MMD is a ratio, about 0.005 to 0.05; is this another value?",
};

impl Ratio {
    /// Reads the ratio from `section`.
    fn measured(&self, section: &Section<'_>, findings: &mut Findings<'_>) -> Option<Measured> {
        let Self { key, limit, help } = *self;
        let mut value = positive(section, key, Quantity::Ratio, findings)?;
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

/// Reads TM from `root`. TM must not exceed the thickness `t0`.
fn pressed_thickness(
    root: &Section<'_>,
    t0: Option<&Measured>,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let tm = positive(root, "TM", Quantity::Length, findings)?;
    let Some(t0) = t0.filter(|t0| tm.si > t0.si) else { return Some(tm) };
    findings.error(
        &tm.key,
        format!("{} is more than {}, {}", tm.written, t0.key, t0.written),
        "TM is the thickness under 50 gf/cm², T0 or T that under 0.5 gf/cm²",
    );
    None
}

/// Reads RT or RC from the `key` of `section`: at most 100 %.
fn percentage(section: &Section<'_>, key: &str, findings: &mut Findings<'_>) -> Option<Measured> {
    let value = positive(section, key, Quantity::Ratio, findings)?;
    check_range(
        value,
        findings,
        |si| si <= 1.0,
        |written| RangeMistake {
            message: format!("{written} is more than 100 %, which no fabric gives back"),
            help: format!("{key} is recovered work over work spent, in percent"),
        },
    )
}

/// Reads a number greater than zero from the `key` of `section`.
fn positive(
    section: &Section<'_>,
    key: &str,
    quantity: Quantity,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let value = section.measured(key, quantity, findings)?;
    check_range(
        value,
        findings,
        |si| si > 0.0,
        |written| RangeMistake {
            message: format!("{written} is not greater than 0"),
            help: "write the measured value, or remove the line if it was not measured".into(),
        },
    )
}

/// Reads a loop width, zero or more, from the `key` of `section`.
fn zero_or_more(
    section: &Section<'_>,
    key: &str,
    quantity: Quantity,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let value = section.measured(key, quantity, findings)?;
    check_range(
        value,
        findings,
        |si| si >= 0.0,
        |written| RangeMistake {
            message: format!("{written} is negative"),
            help: "a loop width is the distance between the two branches, without sign".into(),
        },
    )
}

/// Mistake of a value outside its range.
struct RangeMistake {
    message: String,
    help: String,
}

/// Returns `value` if its number in SI `is_in_range`. Reports the `mistake` of its text otherwise.
fn check_range(
    value: Measured,
    findings: &mut Findings<'_>,
    is_in_range: impl Fn(f64) -> bool,
    mistake: impl Fn(&str) -> RangeMistake,
) -> Option<Measured> {
    if is_in_range(value.si) {
        return Some(value);
    }
    let RangeMistake { message, help } = mistake(&value.written);
    findings.error(&value.key, message, help);
    None
}
