//! Sizes of panels that no garment has. They come from lengths that were read in a wrong unit.

use drape_input::{Diagnostic, Document, Remedy, Subject, toml_string};

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

/// Size of the largest of several panels below which a garment is questioned, in m. Garments of a
/// child are larger, garments of a doll may be meant.
const SMALL: f64 = 0.15;

/// Size below which a single panel is questioned, in m: it may be a pocket.
const SMALL_ALONE: f64 = 0.08;

/// Size below which the unit is wrong whatever the right unit is, in m.
const TINY: f64 = 0.02;

/// Width of a panel above which it is questioned if another unit would make it usual, in m.
const WIDE: f64 = 2.5;

/// Usual sizes of the largest panel of a garment, in m.
const USUAL: std::ops::RangeInclusive<f64> = 0.25..=2.0;

/// Size in the middle of [`USUAL`], in m.
const MIDDLE: f64 = 0.7;

/// Logarithm of the ratio of sizes by which a metric unit may be farther from the middle than the
/// inch. A metric unit is more often mistaken for another one than the inch is.
const RARE: f64 = 1.0;

/// Doubt about the size of a pattern.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Doubt {
    /// Its largest panel.
    panel: String,
    /// Width and height, in m.
    size: [f64; 2],
    /// Unit in which the size would be usual.
    likely: Unit,
    /// Width and height in that unit, in m.
    meant: [f64; 2],
}

/// Returns the mistake of `panel` if no cloth is wide or long enough for it, or if it is too small
/// to be sewn.
pub(crate) fn wrong_size(panel: &Panel) -> Option<Mistake> {
    let size = panel.extents();
    let (short, long) = (size[0].min(size[1]), longer_side(size));
    let is_right = short <= WIDEST && (SHORTEST..=LONGEST).contains(&long);
    (!is_right).then(|| Mistake::Size { panel: panel.name().into(), size })
}

/// Returns the longer side of a rectangle of `size`.
fn longer_side(size: [f64; 2]) -> f64 {
    size[0].max(size[1])
}

impl Doubt {
    /// Returns the doubt about `panels` of a file that states its unit of `metres`, if their size
    /// is unusual and would be usual in another unit.
    pub(crate) fn for_file(panels: &[Panel], metres: f64) -> Option<Self> {
        Self::new(panels, metres, SMALL_ALONE, &Unit::OF_CLOTH)
    }

    /// Returns the doubt about `panels` of a drawing with a unit of `metres`, as for a file.
    /// Programs write units that are not meant. A drawing is therefore questioned at a larger size.
    pub(crate) fn for_drawing(panels: &[Panel], metres: f64) -> Option<Self> {
        let small = if panels.len() > 1 { SMALL } else { SMALL_ALONE };
        Self::new(panels, metres, small, &Unit::ALL)
    }

    /// Returns the doubt about `panels` whose largest is below `small`, in m, or that are too wide,
    /// if they would be usual in one of `units` in place of a unit of `metres`.
    fn new(panels: &[Panel], metres: f64, small: f64, units: &[Unit]) -> Option<Self> {
        let extents = panels.iter().map(|panel| (panel.name(), panel.extents()));
        let largest = extents.max_by(|a, b| longer_side(a.1).total_cmp(&longer_side(b.1)))?;
        let (panel, size) = (largest.0.to_owned(), largest.1);
        let is_wide = panels.iter().map(Panel::extents).any(|size| size[0].min(size[1]) > WIDE);
        if longer_side(size) >= small && !is_wide {
            return None;
        }

        // The most likely unit makes the size most usual.
        let usual = units.iter().filter_map(|unit| {
            let meant = size.map(|side| side * unit.metres() / metres);
            let long = longer_side(meant);
            let is_right = USUAL.contains(&long) || longer_side(size) < TINY;
            let rarity = if *unit == Unit::INCH { RARE } else { 0.0 };
            is_right.then_some((*unit, meant, (long / MIDDLE).ln().abs() + rarity))
        });
        let (likely, meant, _) = usual.min_by(|a, b| a.2.total_cmp(&b.2))?;
        Some(Self { panel, size, likely, meant })
    }

    /// Word of the unit in which the size would be usual.
    pub(crate) fn likely_unit(&self) -> &'static str {
        self.likely.word()
    }

    /// Returns the doubt as a note.
    pub(crate) fn note(&self) -> PatternNote {
        let Self { panel, size, likely, meant } = self.clone();
        PatternNote::Size { panel, size, likely: likely.word(), meant }
    }

    /// Returns the doubt as a question to the user of `document`. Its unit was taken from its
    /// content: `taken` is the word of that unit.
    pub(crate) fn question(
        &self,
        document: &Document,
        request: &Request,
        taken: &'static str,
    ) -> Diagnostic {
        let word = self.likely.word();
        let remedy = Remedy::ConfirmUnit { file: document.path().to_owned(), likely: word, taken };
        let mistake = Diagnostic::new(document.path(), self.note().to_string()).help(remedy);
        let mistake = mistake.about(Subject::Panel(self.panel.clone()));
        mistake.with_edits(request.edit("unit", &toml_string(word)))
    }
}
