use crate::file::SceneFile;
use crate::reader::Reader;

/// Surfaces that start nearer than they keep, and keep more of their distances from step to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// How long they take to keep all of it, in s, if nothing holds them together.
    pub seconds: f64,
}

impl Growth {
    /// Smallest distance of two surfaces from which it starts, in m: a thousand times the least gap that the filter of
    /// steps tells from none.
    pub const NEAREST: f64 = 1e-6;
}

impl Reader<'_> {
    pub(crate) fn growth(&mut self, file: &SceneFile, (step, end): (f64, f64)) -> Option<Growth> {
        let seconds = file.contact.grow?;
        if !file.keeps_apart() {
            let help = "it needs contact.surfaces = true";
            self.fail("contact.grow", "nothing is kept apart here".into(), help);
        }
        let help = "in s, from a step to the whole run; 0.2 is usual";
        self.within("contact.grow", seconds, (step, end), help);
        Some(Growth { seconds })
    }
}
