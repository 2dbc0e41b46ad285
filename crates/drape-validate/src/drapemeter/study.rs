//! Study: the drapes of one fabric from several starts, and their mean and deviation.
//!
//! A start is a seed. It determines the unevenness of the specimen and the offset of its grid.

use std::collections::BTreeMap;

/// Harmonics of the edge that count as its shape.
pub(super) const HARMONICS: usize = 20;

/// Drape of a specimen, read from its shadow.
#[derive(Debug, Clone, PartialEq)]
pub struct Drape {
    /// Drape coefficient: area of the shadow beyond the disc over the area of the flat specimen
    /// beyond the disc.
    pub coefficient: f64,
    /// Number of nodes: maxima of the shadow's edge.
    pub nodes: usize,
    /// Amplitudes of the edge's harmonics 1, 2, … around the disc, in m.
    pub amplitudes: Vec<f64>,
    /// Radius of the shadow's edge at even angles, in m.
    pub edge: Vec<f64>,
    /// Speed of the fastest particle, in m/s.
    pub speed: f64,
}

/// Sampling of a study: the grid and the number of starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// Distance of the particles, in m.
    pub spacing: f64,
    /// Number of starts.
    pub starts: u64,
}

/// Drapes from several starts.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// One drape for each start.
    pub drapes: Vec<Drape>,
}

impl Study {
    /// Returns the mean of the drape coefficients.
    #[must_use]
    pub fn mean(&self) -> f64 {
        let sum: f64 = self.drapes.iter().map(|drape| drape.coefficient).sum();
        sum / self.drapes.len() as f64
    }

    /// Returns the standard deviation of the drape coefficients over the starts.
    #[must_use]
    pub fn deviation(&self) -> f64 {
        let mean = self.mean();
        let squares = self.drapes.iter().map(|drape| (drape.coefficient - mean).powi(2));
        (squares.sum::<f64>() / (self.drapes.len() as f64 - 1.0)).sqrt()
    }

    /// Returns the index in `drapes` of the drape whose coefficient is nearest to the mean.
    #[must_use]
    pub fn typical(&self) -> usize {
        let mean = self.mean();
        let deviations = self.drapes.iter().map(|drape| (drape.coefficient - mean).abs());
        let nearest = deviations.enumerate().min_by(|(_, a), (_, b)| a.total_cmp(b));
        nearest.map_or(0, |(index, _)| index)
    }

    /// Returns the number of starts by number of nodes.
    #[must_use]
    pub fn nodes(&self) -> BTreeMap<usize, usize> {
        let mut counts = BTreeMap::new();
        self.drapes.iter().for_each(|drape| *counts.entry(drape.nodes).or_default() += 1);
        counts
    }

    /// Returns the mean amplitudes of the edge's harmonics 1, 2, …, in m.
    #[must_use]
    pub fn amplitudes(&self) -> Vec<f64> {
        (0..HARMONICS)
            .map(|harmonic| {
                let sum: f64 = self.drapes.iter().map(|drape| drape.amplitudes[harmonic]).sum();
                sum / self.drapes.len() as f64
            })
            .collect()
    }
}
