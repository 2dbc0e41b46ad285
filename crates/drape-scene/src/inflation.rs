use serde::Deserialize;

use crate::file::SceneFile;
use crate::reader::Reader;

/// How long bodies grow if the scene does not say, in s.
const SECONDS: f64 = 0.5;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct InflateFile {
    /// By how much bodies start smaller, along their normals.
    depth: f64,
    /// How long they grow.
    seconds: Option<f64>,
}

/// Bodies that start smaller than they are, so that cloth which would start in them starts outside, and grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inflation {
    /// How far inside of where they belong their vertices start, along the normals, in m.
    pub depth: f64,
    /// How long they grow, in s.
    pub seconds: f64,
}

impl Inflation {
    /// Part of the depth that is left at a time since the start, in s.
    #[must_use]
    pub fn left(&self, time: f64) -> f64 {
        (1.0 - time / self.seconds).clamp(0.0, 1.0)
    }
}

impl Reader<'_> {
    pub(crate) fn inflation(
        &mut self,
        file: &SceneFile,
        unit: f64,
        (step, spacing): (f64, f64),
    ) -> Option<Inflation> {
        let inflate = file.contact.inflate.as_ref()?;
        if !file.keeps_apart() {
            let help = "it needs contact.surfaces = true";
            self.fail("contact.inflate", "nothing is kept apart here".into(), help);
        }
        let inflation =
            Inflation { depth: inflate.depth * unit, seconds: inflate.seconds.unwrap_or(SECONDS) };
        let Inflation { depth, seconds } = inflation;
        let help =
            "how far inside of where it belongs the surface of a body starts; 10 mm is usual";
        self.within("contact.inflate.depth", depth, (1e-6, 0.1), help);
        let help = "in s; cloth follows a body by a spacing in a step at most";
        let least = (depth * step / spacing).max(step);
        self.within("contact.inflate.seconds", seconds, (least, 1e3), help);
        Some(inflation)
    }
}
