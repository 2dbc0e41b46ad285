//! Units of lengths in pattern files.

/// Unit of length, by the word that a person writes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    word: &'static str,
    metres: f64,
}

/// Units with their lengths in m. A point of PostScript is 1/72 inch, a pixel of CSS 1/96 inch.
const UNITS: [Unit; 6] = [
    Unit { word: "mm", metres: 0.001 },
    Unit { word: "cm", metres: 0.01 },
    Unit { word: "m", metres: 1.0 },
    Unit { word: "in", metres: 0.0254 },
    Unit { word: "pt", metres: 0.0254 / 72.0 },
    Unit { word: "px", metres: 0.0254 / 96.0 },
];

/// Units that a remedy offers for a DXF file, of which the first is the most usual.
pub(crate) const DXF_UNITS: &[&str] = &["mm", "cm", "in"];

/// Units that a remedy offers for an SVG drawing, of which the first is the most usual.
pub(crate) const SVG_UNITS: &[&str] = &["mm", "cm", "m", "in", "pt", "px"];

impl Unit {
    /// Remedy for a word that is no unit.
    pub(crate) const HELP: &'static str =
        "a unit is \"mm\", \"cm\", \"m\", \"in\", \"pt\" (1/72 in) or \"px\" (1/96 in)";

    /// Units in which people measure cloth.
    pub(crate) const OF_CLOTH: [Self; 4] = [UNITS[0], UNITS[1], UNITS[2], UNITS[3]];

    /// Units of drawings.
    pub(crate) const ALL: [Self; 6] = UNITS;

    /// Millimetre.
    pub(crate) const MM: Self = UNITS[0];
    /// Inch.
    pub(crate) const INCH: Self = UNITS[3];
    /// Point, 1/72 in.
    pub(crate) const POINT: Self = UNITS[4];
    /// Pixel, 1/96 in.
    pub(crate) const PIXEL: Self = UNITS[5];

    /// Returns the unit with the word `word`: mm, cm, m, in, pt or px.
    #[must_use]
    pub fn parse(word: &str) -> Option<Self> {
        UNITS.into_iter().find(|unit| unit.word == word)
    }

    /// Returns the unit with a length of `metres`, if there is one.
    pub(crate) fn from_length(metres: f64) -> Option<Self> {
        UNITS.into_iter().find(|unit| (metres / unit.metres - 1.0).abs() < 1e-3)
    }

    /// Length, in m.
    #[must_use]
    pub fn metres(&self) -> f64 {
        self.metres
    }

    /// Word of the unit.
    #[must_use]
    pub fn word(&self) -> &'static str {
        self.word
    }

    /// Returns whether people measure cloth in the unit.
    pub(crate) fn measures_cloth(&self) -> bool {
        !matches!(self.word, "pt" | "px")
    }
}
