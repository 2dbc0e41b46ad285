//! Contents of a pattern: the panels as they are cut at a spacing, in words or as a drawing.

use std::fmt::Write;
use std::path::Path;

use drape::input::{Diagnostic, Diagnostics, counted};
use drape::pattern::{
    CutPattern, Cutter, Error, Pattern, Quality, Request, Sketch, SketchFault, figure,
};

use crate::input;

/// Pattern whose panels have been cut.
pub(crate) struct CheckedPattern {
    pattern: Pattern,
    cut: CutPattern,
}

/// Mistakes of a pattern, with a drawing of the lines that could be read.
pub(crate) struct RefusedPattern {
    pub(crate) mistakes: Diagnostics,
    pub(crate) figure: Option<String>,
}

impl RefusedPattern {
    /// Returns `mistakes` with a drawing of the lines in the file at `path`, in which faults are
    /// red.
    pub(crate) fn new(path: &Path, mistakes: Diagnostics) -> Self {
        let sketch = if input::is_standard(path) {
            input::document(path).map(|document| Sketch::parse(&document)).ok()
        } else {
            let access = input::access().clone();
            Some(Sketch::read(&Request { access, ..Request::new(path) }))
        };
        let subjects = mistakes.0.iter().filter_map(|mistake| mistake.subject.clone());
        let faults: Vec<SketchFault> =
            subjects.map(|subject| SketchFault { subject, at: None }).collect();
        let figure = sketch
            .filter(|sketch| !sketch.is_empty())
            .map(|sketch| sketch.figure(&faults, &mistakes.0));
        Self { mistakes, figure }
    }
}

impl CheckedPattern {
    /// Reads the pattern at `path` and cuts it at `spacing`, in m.
    pub(crate) fn read(path: &Path, spacing: f64) -> Result<Self, Diagnostics> {
        Self::read_or_sketch(path, spacing).map_err(|refused| refused.mistakes)
    }

    /// Reads the pattern at `path` and cuts it at `spacing`, in m. A pattern with mistakes is
    /// returned as a drawing of its lines, in which faults are red.
    pub(crate) fn read_or_sketch(path: &Path, spacing: f64) -> Result<Self, RefusedPattern> {
        let name = input::message_path(path);
        let pattern = if input::is_standard(path) {
            input::document(path).and_then(|document| Pattern::parse(&document))
        } else {
            let access = input::access().clone();
            let request = Request { access, ..Request::new(path) };
            Pattern::read_as(&request).map_err(|error| match error {
                Error::Input(mistakes) => mistakes,
                error => Diagnostic::new(name, error.to_string()).into(),
            })
        };
        let pattern = pattern.map_err(|mistakes| RefusedPattern::new(path, mistakes))?;

        match Cutter::new(spacing).cut(&pattern) {
            Ok(cut) => Ok(Self { pattern, cut }),
            Err(Error::Pattern(cut_mistakes)) => {
                let faults: Vec<SketchFault> =
                    cut_mistakes.iter().filter_map(SketchFault::from_mistake).collect();
                let diagnostics = cut_mistakes.iter().map(|mistake| mistake.diagnostic(name));
                let mistakes = Diagnostics(diagnostics.collect());
                let figure = Some(Sketch::from_pattern(&pattern).figure(&faults, &mistakes.0));
                Err(RefusedPattern { mistakes, figure })
            }
            Err(error) => {
                let mistakes = Diagnostic::new(name, error.to_string()).into();
                Err(RefusedPattern { mistakes, figure: None })
            }
        }
    }

    /// Describes every panel with the [`Quality`] of its cut, followed by the notes.
    pub(crate) fn describe(&self) -> String {
        let Self { pattern, cut } = self;
        let mut text = format!(
            "pattern, {}, {}, {} particles at {} mm when sewn\n",
            counted(pattern.panels().len(), "panel", "panels"),
            counted(pattern.seams().len(), "stitch", "stitches"),
            cut.particle_count(),
            1e3 * cut.spacing
        );

        for (panel, cut_panel) in pattern.panels().iter().zip(&cut.panels) {
            let quality = Quality::new(panel, cut_panel, cut.spacing);
            let _ = writeln!(
                text,
                "  panel \"{}\": {:.4} m², {} particles, shortest edge {:.2} spacings, sharpest \
                 angle {:.0}°, error of the area {:.3} %",
                panel.name(),
                panel.area(),
                cut_panel.positions.len(),
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

    /// Draws the cut panels as the text of an SVG file.
    pub(crate) fn figure(&self) -> String {
        figure(&self.pattern, &self.cut)
    }
}
