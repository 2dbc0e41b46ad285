//! Sizes of panels that no garment has: they come from lengths that were taken in a wrong unit.

use drape_input::{Diagnostic, Document, Subject, toml_string};

use super::request::Request;
use super::unit::Unit;
use crate::mistake::Mistake;
use crate::note::PatternNote;
use crate::panel::Panel;

/// Longest panel, in m: a sari has 9 m, the strip of a ruffle more.
const LONGEST: f64 = 50.0;

/// Widest panel, in m: the larger of its two sides may be longer. Looms are up to 5 m wide.
const WIDEST: f64 = 5.0;

/// Shortest panel, in m.
const SHORTEST: f64 = 1e-3;

/// Size of the largest of several panels below which a garment is questioned, in m. Those of a child
/// are larger, those of a doll may be meant.
const SMALL: f64 = 0.15;

/// Size below which a single panel is questioned, in m: it may be a pocket.
const SMALL_ALONE: f64 = 0.08;

/// Size below which the unit is wrong whichever is right, in m.
const TINY: f64 = 0.02;

/// Width of a panel above which it is questioned where another unit would make it a usual one, in m.
const WIDE: f64 = 2.5;

/// Sizes of the largest panel of a garment that are usual, in m, and the one in their middle.
const USUAL: std::ops::RangeInclusive<f64> = 0.25..=2.0;
const MIDDLE: f64 = 0.7;

/// Logarithm of the ratio of sizes by which a metric unit may be farther from the middle than the
/// inch: a metric unit is mistaken for another one more often.
const RARE: f64 = 1.0;

/// Doubt about the size of a pattern.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Doubt {
    /// Its largest panel.
    panel: String,
    /// Width and height, in m.
    size: [f64; 2],
    /// Unit by which the size would be usual.
    likely: Unit,
    /// Width and height in that unit, in m.
    meant: [f64; 2],
}

/// Returns the mistake of a panel that no cloth is wide or long enough for, or that is too small to
/// be sewn.
pub(crate) fn wrong_size(panel: &Panel) -> Option<Mistake> {
    let size = panel.extents();
    let (short, long) = (size[0].min(size[1]), size[0].max(size[1]));
    let right = short <= WIDEST && (SHORTEST..=LONGEST).contains(&long);
    (!right).then(|| Mistake::Size { panel: panel.name().into(), size })
}

impl Doubt {
    /// Returns the doubt about panels of a file that states the unit of its lengths, in m, if they
    /// are of no usual size and would be in another unit.
    pub(crate) fn of_file(panels: &[Panel], metres: f64) -> Option<Self> {
        Self::new(panels, metres, SMALL_ALONE, &Unit::OF_FILES)
    }

    /// Returns the doubt about panels of a drawing, as for a file. Programs write units that are not
    /// meant, so that more is asked.
    pub(crate) fn of_drawing(panels: &[Panel], metres: f64) -> Option<Self> {
        let small = if panels.len() > 1 { SMALL } else { SMALL_ALONE };
        Self::new(panels, metres, small, &Unit::ALL)
    }

    /// Returns the doubt about panels whose largest is under a size, in m, or that are too wide, and
    /// would be usual in one of some other units.
    fn new(panels: &[Panel], metres: f64, small: f64, others: &[Unit]) -> Option<Self> {
        let long = |size: [f64; 2]| size[0].max(size[1]);
        let extents = panels.iter().map(|panel| (panel.name(), panel.extents()));
        let largest = extents.max_by(|a, b| long(a.1).total_cmp(&long(b.1)))?;
        let (panel, size) = (largest.0.to_owned(), largest.1);
        let is_wide = panels.iter().map(Panel::extents).any(|size| size[0].min(size[1]) > WIDE);
        if long(size) >= small && !is_wide {
            return None;
        }
        let usual = others.iter().filter_map(|unit| {
            let meant = size.map(|side| side * unit.metres() / metres);
            let right = USUAL.contains(&long(meant)) || long(size) < TINY;
            right.then_some((*unit, meant))
        });
        let off = |(unit, meant): &(Unit, [f64; 2])| {
            let rare = if *unit == Unit::INCH { RARE } else { 0.0 };
            (long(*meant) / MIDDLE).ln().abs() + rare
        };
        let (likely, meant) = usual.min_by(|a, b| off(a).total_cmp(&off(b)))?;
        Some(Self { panel, size, likely, meant })
    }

    /// Word of the unit by which the size would be usual.
    pub(crate) fn likely_unit(&self) -> &'static str {
        self.likely.word()
    }

    /// Returns the doubt as a note.
    pub(crate) fn note(&self) -> PatternNote {
        let Self { panel, size, likely, meant } = self.clone();
        PatternNote::Size { panel, size, likely: likely.word(), meant }
    }

    /// Returns the doubt as a question to the user of a file whose unit was taken from what it says:
    /// `taken` is the word of that unit.
    pub(crate) fn question(
        &self,
        document: &Document,
        request: &Request,
        taken: &str,
    ) -> Diagnostic {
        let word = self.likely.word();
        let path = document.path().display();
        let help = format!(
            "say the unit: drape convert {path} --unit {word}, or --unit {taken} if the size is meant; or unit = \
             \"{word}\" in the [from] of a pattern"
        );
        let mistake = Diagnostic::new(document.path(), self.note().to_string()).help(help);
        let mistake = mistake.about(Subject::Panel(self.panel.clone()));
        mistake.with_edits(request.edit("unit", &toml_string(word)))
    }
}
