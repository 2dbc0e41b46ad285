//! Graph: plot of a case, simulation and reference together, as numbers in SI.
//!
//! The pages choose colours and draw it.

/// A plot of a case: where looking beats reading. All numbers are in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    /// What is shown.
    pub title: String,
    /// Across and up.
    pub axes: [Axis; 2],
    /// How the axes are laid out.
    pub layout: Layout,
    /// What is drawn.
    pub series: Vec<Series>,
}

/// What an axis shows, and in which unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// The quantity.
    pub label: &'static str,
    /// The unit, empty for a ratio.
    pub unit: &'static str,
    /// One unit in SI.
    pub in_si: f64,
}

/// How the axes of a graph are laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Each as its numbers need.
    Free,
    /// A unit is as long up as across: for shapes.
    ToScale,
    /// Both logarithmic.
    Logarithmic,
}

/// One series of a graph.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name; references of one name share it.
    pub label: String,
    /// Where its points come from.
    pub source: Source,
    /// Its points in order.
    pub points: Vec<[f64; 2]>,
}

/// Where a series comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// A simulation, in places that are shown one by one.
    Simulated,
    /// A simulation, in so many places that they are a line.
    Traced,
    /// What the simulation is held against.
    Reference,
}

impl Axis {
    /// An axis of a ratio.
    pub const fn ratio(label: &'static str) -> Self {
        Self { label, unit: "", in_si: 1.0 }
    }

    /// An axis with a unit.
    pub const fn new(label: &'static str, unit: &'static str, in_si: f64) -> Self {
        Self { label, unit, in_si }
    }
}

impl Graph {
    /// A graph without series yet.
    pub fn new(title: impl Into<String>, axes: [Axis; 2]) -> Self {
        Self { title: title.into(), axes, layout: Layout::Free, series: Vec::new() }
    }

    /// The same laid out otherwise.
    #[must_use]
    pub fn laid_out(self, layout: Layout) -> Self {
        Self { layout, ..self }
    }

    /// Adds a series.
    pub fn add(&mut self, source: Source, label: impl Into<String>, points: Vec<[f64; 2]>) {
        self.series.push(Series { label: label.into(), source, points });
    }
}
