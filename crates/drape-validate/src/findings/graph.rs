//! Graph: plot of a case, simulation and reference together, as numbers in SI.
//!
//! The pages choose colours and draw the graph.

/// Plot of a case, in SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    /// Title.
    pub title: String,
    /// Axes across and up.
    pub axes: [Axis; 2],
    /// Layout of the axes.
    pub layout: Layout,
    /// Series, in the order of drawing.
    pub series: Vec<Series>,
}

/// Axis: its quantity and its unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Quantity.
    pub label: &'static str,
    /// Unit; empty for a ratio.
    pub unit: &'static str,
    /// Size of the unit, in SI.
    pub in_si: f64,
}

/// Layout of the axes of a graph.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Layout {
    /// Each axis spans its numbers.
    Free,
    /// Units of both axes have equal length, for shapes.
    ToScale,
    /// Both axes are logarithmic.
    Logarithmic,
}

/// Series of points of a graph.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name in the legend. References with equal names have one entry in the legend.
    pub label: String,
    /// Source of the points.
    pub source: Source,
    /// Points in order.
    pub points: Vec<[f64; 2]>,
}

/// Source of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// Simulation, drawn as single points.
    Simulated,
    /// Simulation, drawn as a line.
    Traced,
    /// Reference.
    Reference,
}

impl Axis {
    /// Returns the axis `label` of a ratio.
    #[must_use]
    pub const fn ratio(label: &'static str) -> Self {
        Self { label, unit: "", in_si: 1.0 }
    }

    /// Returns the axis `label` with `unit`, which is `in_si` in SI.
    #[must_use]
    pub const fn new(label: &'static str, unit: &'static str, in_si: f64) -> Self {
        Self { label, unit, in_si }
    }
}

impl Graph {
    /// Returns a graph with `title` and `axes` and without series.
    #[must_use]
    pub fn new(title: impl Into<String>, axes: [Axis; 2]) -> Self {
        Self { title: title.into(), axes, layout: Layout::Free, series: Vec::new() }
    }

    /// Returns the graph with `layout`.
    #[must_use]
    pub fn laid_out(self, layout: Layout) -> Self {
        Self { layout, ..self }
    }

    /// Adds a series of `points`, in SI.
    pub fn add(&mut self, source: Source, label: impl Into<String>, points: Vec<[f64; 2]>) {
        self.series.push(Series { label: label.into(), source, points });
    }
}
