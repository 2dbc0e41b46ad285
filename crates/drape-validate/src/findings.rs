//! Findings: what a case returns, as plain data.
//!
//! A case compares figures of a simulation with a reference ([`Check`]), and adds plots ([`Graph`])
//! and pictures ([`Still`]) for people. A program prints the checks and draws plots and pictures.
//! This crate draws nothing.

mod check;
mod graph;

use drape_dynamics::Snapshot;

pub use check::{Check, Kind};
pub use graph::{Axis, Graph, Layout, Series, Source};

/// Findings of a case: checks, plots and pictures.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Findings {
    /// Figures with their references.
    pub checks: Vec<Check>,
    /// Plots.
    pub graphs: Vec<Graph>,
    /// Pictures.
    pub stills: Vec<Still>,
}

/// Still: pictures of cloths side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct Still {
    /// Title, in the order of the pictures.
    pub title: String,
    /// The cloths, row by row.
    pub snapshots: Vec<Snapshot>,
    /// Number of cloths in a row.
    pub columns: usize,
    /// Direction of view: azimuth and elevation, in degrees.
    pub view: [f64; 2],
}

impl From<Vec<Check>> for Findings {
    fn from(checks: Vec<Check>) -> Self {
        Self { checks, ..Self::default() }
    }
}
