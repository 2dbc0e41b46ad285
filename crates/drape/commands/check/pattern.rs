//! Contents of a pattern: its panels as they are cut at a spacing, in words or as a drawing.

use std::fmt::Write;
use std::path::Path;

use drape::input::{Diagnostic, Diagnostics};
use drape::pattern::{CutPattern, Cutter, Error, Pattern, Quality, figure};

use crate::input;

/// A pattern with its panels cut.
pub(crate) struct CutOut {
    pattern: Pattern,
    cut: CutPattern,
}

impl CutOut {
    /// Reads a pattern and cuts it at a spacing, in m.
    pub(crate) fn read(path: &Path, spacing: f64) -> Result<Self, Diagnostics> {
        let shown = input::shown(path);
        let mistakes = |error: Error| match error {
            Error::Input(mistakes) => mistakes,
            Error::Pattern(mistakes) => Diagnostics(
                mistakes
                    .iter()
                    .map(|mistake| Diagnostic::new(shown, mistake.to_string()).help(mistake.help()))
                    .collect(),
            ),
            other => Diagnostic::new(shown, other.to_string()).into(),
        };
        let pattern = match input::is_standard(path) {
            true => Pattern::parse(&input::document(path)?)?,
            false => Pattern::read(path).map_err(mistakes)?,
        };
        let cut = Cutter::new(spacing).cut(&pattern).map_err(mistakes)?;
        Ok(Self { pattern, cut })
    }

    /// Describes every panel with the quality of its cut, then the notes.
    pub(crate) fn describe(&self) -> String {
        let Self { pattern, cut } = self;
        let mut text = format!(
            "pattern, {} panels, {} stitches, {} particles at {} mm when sewn\n",
            pattern.panels().len(),
            pattern.seams().len(),
            cut.particles(),
            1e3 * cut.spacing
        );
        for (panel, own) in pattern.panels().iter().zip(&cut.panels) {
            let quality = Quality::new(panel, own, cut.spacing);
            let _ = writeln!(
                text,
                "  panel \"{}\": {:.4} m², {} particles, shortest edge {:.2} spacings, sharpest \
                 angle {:.0}°, error of the area {:.3} %",
                panel.name(),
                panel.area(),
                own.positions.len(),
                quality.shortest_edge,
                quality.smallest_angle.to_degrees(),
                100.0 * quality.area_error
            );
        }
        for note in pattern.notes().iter().chain(&cut.notes) {
            let _ = writeln!(text, "  note: {note}");
        }
        text
    }

    /// Draws the cut panels as SVG.
    pub(crate) fn figure(&self) -> String {
        figure(&self.pattern, &self.cut)
    }
}
