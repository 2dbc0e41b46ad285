//! Fabric on a drapemeter, as a report shows it.

use drape_render::Picture;
use serde::Serialize;

use crate::check;
use crate::error::Error;
use crate::plot::ShadowPlot;

/// Specimens of a fabric on a simulated drapemeter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ReportedDrape {
    /// Instrument in words, as in "FRL drapemeter, 254 mm on 127 mm".
    pub meter: String,
    /// Method of computation, in a sentence.
    pub computed: String,
    /// Mean drape coefficient, a ratio.
    pub coefficient: f64,
    /// Standard deviation of the specimens, a ratio.
    pub deviation: f64,
    /// Interval of the coefficient, a ratio.
    pub interval: [f64; 2],
    /// What lies in the interval, in words.
    pub meaning: String,
    /// Numbers of nodes, each with the number of specimens that have them.
    pub nodes: Vec<(usize, usize)>,
    /// Shadow of one specimen.
    pub shadow: ShadowPlot,
    /// Picture of the specimen whose shadow is shown.
    #[serde(skip)]
    pub picture: Option<Picture>,
}

impl ReportedDrape {
    /// Refuses texts that cannot be shown and coefficients that are not finite, as [`Error`].
    pub(super) fn check(&self) -> Result<(), Error> {
        for text in [&self.meter, &self.computed, &self.meaning] {
            check::text("a text of a drape", text)?;
        }
        let numbers = [self.coefficient, self.deviation].into_iter().chain(self.interval);
        for number in numbers {
            check::number(|| "a drape coefficient".to_owned(), number)?;
        }
        self.shadow.check()
    }

    /// Returns the numbers of `nodes` in words: "5 (×2), 6 (×8)".
    pub(super) fn nodes_in_words(&self) -> String {
        let words = self.nodes.iter().map(|(nodes, times)| format!("{nodes} (×{times})"));
        words.collect::<Vec<_>>().join(", ")
    }
}
