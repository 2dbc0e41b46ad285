//! Contents of a pattern: its panels as they are cut at a spacing, in words or as a drawing.

use std::fmt::Write;
use std::path::Path;

use drape::input::{Diagnostic, Diagnostics};
use drape::pattern::{CutPattern, Cutter, Error, Pattern, Quality, Sketch, SketchFault, figure};

use crate::input;

/// A pattern with its panels cut.
pub(crate) struct CutOut {
    pattern: Pattern,
    cut: CutPattern,
}

/// Mistakes of a pattern, with a drawing of its lines if it has some.
pub(crate) struct Refused {
    pub(crate) mistakes: Diagnostics,
    pub(crate) figure: Option<String>,
}

impl Refused {
    /// Returns the mistakes of a file with a drawing of what it holds.
    pub(crate) fn new(path: &Path, mistakes: Diagnostics) -> Self {
        let sketch = match input::is_standard(path) {
            true => input::document(path).map(|document| Sketch::parse(&document)).ok(),
            false => Some(Sketch::read(path)),
        };
        let sketch = sketch.filter(|sketch| !sketch.is_empty());
        let subject = |mistake: &Diagnostic| {
            mistake.subject.clone().map(|subject| SketchFault { subject, at: None })
        };
        let wrong: Vec<SketchFault> = mistakes.0.iter().filter_map(subject).collect();
        let figure = sketch.map(|sketch| sketch.figure(&wrong, &mistakes.0));
        Self { mistakes, figure }
    }
}

impl CutOut {
    /// Reads a pattern and cuts it at a spacing, in m.
    pub(crate) fn read(path: &Path, spacing: f64) -> Result<Self, Diagnostics> {
        Self::read_or_sketch(path, spacing).map_err(|refused| refused.mistakes)
    }

    /// Reads a pattern and cuts it at a spacing, in m; or returns its mistakes with a drawing of its
    /// lines, in which they are red.
    pub(crate) fn read_or_sketch(path: &Path, spacing: f64) -> Result<Self, Refused> {
        let shown = input::message_path(path);
        let pattern = match input::is_standard(path) {
            true => input::document(path).and_then(|document| Pattern::parse(&document)),
            false => Pattern::read(path).map_err(|error| match error {
                Error::Input(mistakes) => mistakes,
                other => Diagnostic::new(shown, other.to_string()).into(),
            }),
        };
        let pattern = pattern.map_err(|mistakes| Refused::new(path, mistakes))?;
        match Cutter::new(spacing).cut(&pattern) {
            Ok(cut) => Ok(Self { pattern, cut }),
            Err(Error::Pattern(all)) => {
                let wrong: Vec<SketchFault> =
                    all.iter().filter_map(SketchFault::from_mistake).collect();
                let mistakes = all.iter().map(|mistake| mistake.diagnostic(shown)).collect();
                let mistakes = Diagnostics(mistakes);
                let figure = Some(Sketch::from_pattern(&pattern).figure(&wrong, &mistakes.0));
                Err(Refused { mistakes, figure })
            }
            Err(other) => {
                let mistakes = Diagnostic::new(shown, other.to_string()).into();
                Err(Refused { mistakes, figure: None })
            }
        }
    }

    /// Describes every panel with the quality of its cut, then the notes.
    pub(crate) fn describe(&self) -> String {
        let Self { pattern, cut } = self;
        let mut text = format!(
            "pattern, {} panels, {} stitches, {} particles at {} mm when sewn\n",
            pattern.panels().len(),
            pattern.seams().len(),
            cut.particle_count(),
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
