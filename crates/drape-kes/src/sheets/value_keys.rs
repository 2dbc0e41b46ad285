//! KES values of a sheet: by direction, or one for both, in any spelling.

use crate::scatter::{self, OtherScatter, Scatter};
use crate::sheets::checks::plausible;
use crate::sheets::findings::Findings;
use crate::sheets::section::{Measured, Section};
use crate::sheets::spelling::KEYS;
use crate::symbol::Symbol;
use crate::test::Direction;
use crate::values::Values;
use drape_input::Quantity;

/// Values of a sheet that have no direction, as they were measured.
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
    /// Reads the values without direction and holds those of the compression test against each other.
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

/// Values of warp and weft, and the symbols whose one number stands for both.
#[derive(Debug, Default)]
pub(crate) struct DirectedValues {
    pub(crate) warp: Values,
    pub(crate) weft: Values,
    pub(crate) shared: Vec<&'static str>,
    pub(crate) scatter: Vec<Scatter>,
}

impl DirectedValues {
    /// Reads the values that a direction has: from its table, from a key that names it, else from the
    /// number for both.
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
            let mut source = Source {
                own: sections[index].as_ref(),
                of_root: root,
                mean: mean.as_ref(),
                direction,
                shared: &mut shared,
                scatter: &mut read.scatter,
            };
            let values = values(&mut source, w, findings);
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

/// Places where a value of one direction may stand.
struct Source<'a, 't> {
    own: Option<&'a Section<'t>>,
    of_root: &'a Section<'t>,
    mean: Option<&'a Section<'t>>,
    direction: Direction,
    shared: &'a mut Vec<&'static str>,
    scatter: &'a mut Vec<Scatter>,
}

impl<'t> Source<'_, 't> {
    /// Reads a value that the laws come from, and keeps the standard deviation stated with it.
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

    /// Returns the table in which a value stands, and the key that it has there.
    fn find(&mut self, key: &'static str) -> Option<Section<'t>> {
        if let Some(own) = self.own.filter(|own| own.has_value(key, None)) {
            return Some(own.clone().of(None));
        }
        if self.of_root.has_value(key, Some(self.direction)) {
            return Some(self.of_root.clone().of(Some(self.direction)));
        }
        // MIU, MMD and SMD are given once as a rule; the others are told.
        let mean = self.mean.filter(|mean| mean.has_value(key, None));
        let found = mean.or_else(|| self.of_root.has_value(key, None).then_some(self.of_root))?;
        self.shared.push(key);
        Some(found.clone().of(None))
    }
}

/// Reads the values of one direction and checks each of them.
fn values(
    source: &mut Source<'_, '_>,
    w: Option<&Measured>,
    findings: &mut Findings<'_>,
) -> Values {
    let laboratory = |value: Option<Measured>| value.map(|value| value.laboratory);
    let direction = source.direction;
    let b = source.read(Symbol::B, |section| {
        let b = section.measured("B", Quantity::BendingRigidity, findings)?;
        Some(b).filter(|b| plausible::bending_rigidity(b, findings))
    });
    if let Some(b) = &b {
        plausible::bending(direction, b, w, findings);
    }
    let mut at_least_zero = |symbol: Symbol, quantity| {
        let read = |s: &Section<'_>| zero_or_more(s, symbol.name(), quantity, findings);
        laboratory(source.read(symbol, read))
    };
    let two_hb = at_least_zero(Symbol::TwoHb, Quantity::MomentPerWidth);
    let two_hg = at_least_zero(Symbol::TwoHg, Quantity::ForcePerWidth);
    let two_hg5 = at_least_zero(Symbol::TwoHg5, Quantity::ForcePerWidth);
    let mut above_zero = |symbol: Symbol, quantity| {
        let read = |s: &Section<'_>| positive(s, symbol.name(), quantity, findings);
        laboratory(source.read(symbol, read))
    };
    let g = above_zero(Symbol::G, Quantity::ShearStiffness);
    let wt = above_zero(Symbol::Wt, Quantity::WorkPerArea);
    let em = above_zero(Symbol::Em, Quantity::Ratio);
    let lt = source.read(Symbol::Lt, |section| LT.measured(section, findings));
    let rt = laboratory(source.read(Symbol::Rt, |s| percentage(s, "RT", findings)));
    let smd = source.find("SMD").and_then(|s| positive(&s, "SMD", Quantity::Roughness, findings));
    let miu = source.find("MIU").and_then(|section| MIU.measured(&section, findings));
    let mmd = source.find("MMD").and_then(|section| MMD.measured(&section, findings));
    let rough = smd.as_ref().map(|smd| (smd, smd.laboratory));
    note_unused_scatter(("SMD", Some(direction)), rough, findings);
    for (symbol, ratio) in [("MIU", &miu), ("MMD", &mmd)] {
        let value = ratio.as_ref().map(|ratio| (ratio, ratio.si));
        note_unused_scatter((symbol, Some(direction)), value, findings);
    }
    Values {
        b: laboratory(b),
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
        smd: laboratory(smd),
    }
}

/// Notes that no law uses the standard deviation of a value, and keeps it: the value's symbol and direction,
/// and the value with its number in the unit of the sheet.
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
    /// Reads the ratio.
    fn measured(&self, section: &Section<'_>, findings: &mut Findings<'_>) -> Option<Measured> {
        let Self { key, limit, help } = *self;
        let mut value = positive(section, key, Quantity::Ratio, findings)?;
        // A bare number was parsed as a percentage, the laboratory's unit of every other ratio.
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

/// Reads TM, which is not above T0.
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

/// Reads RT or RC, which are at most 100 %.
fn percentage(section: &Section<'_>, key: &str, findings: &mut Findings<'_>) -> Option<Measured> {
    let value = positive(section, key, Quantity::Ratio, findings)?;
    held(
        value,
        findings,
        |si| si <= 1.0,
        |written| Answer {
            message: format!("{written} is more than 100 %, which no fabric gives back"),
            help: format!("{key} is recovered work over work spent, in percent"),
        },
    )
}

/// Reads a number greater than zero.
fn positive(
    section: &Section<'_>,
    key: &str,
    quantity: Quantity,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let value = section.measured(key, quantity, findings)?;
    held(
        value,
        findings,
        |si| si > 0.0,
        |written| Answer {
            message: format!("{written} is not greater than 0"),
            help: "write the measured value, or remove the line if it was not measured".into(),
        },
    )
}

/// Reads a loop width, zero or more.
fn zero_or_more(
    section: &Section<'_>,
    key: &str,
    quantity: Quantity,
    findings: &mut Findings<'_>,
) -> Option<Measured> {
    let value = section.measured(key, quantity, findings)?;
    held(
        value,
        findings,
        |si| si >= 0.0,
        |written| Answer {
            message: format!("{written} is negative"),
            help: "a loop width is the distance between the two branches, without sign".into(),
        },
    )
}

/// Answer to a value out of its range.
struct Answer {
    message: String,
    help: String,
}

/// Returns a value that is in its range; reports one that is not, by its number as written.
fn held(
    value: Measured,
    findings: &mut Findings<'_>,
    holds: impl Fn(f64) -> bool,
    answer: impl Fn(&str) -> Answer,
) -> Option<Measured> {
    if holds(value.si) {
        return Some(value);
    }
    let Answer { message, help } = answer(&value.written);
    findings.error(&value.key, message, help);
    None
}
