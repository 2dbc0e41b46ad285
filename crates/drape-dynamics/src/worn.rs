use std::ops::Range;

use drape_collide::{Body, Shape};

use crate::Simulation;

/// Part of its height by which a garment may sink until it rests: more is no settling on the body.
const SUNK: f64 = 0.25;

/// A garment in the course of a run.
#[derive(Debug, Clone)]
pub(crate) struct Worn {
    name: String,
    particles: Range<usize>,
    /// Its lowest and its highest point when it began to hang, in m.
    hung: [f64; 2],
}

impl Worn {
    /// A garment of so many particles, at the start.
    pub(crate) fn new((name, particles): (String, Range<usize>), positions: &[f64]) -> Self {
        let mut worn = Self { name, particles, hung: [0.0; 2] };
        worn.hang(positions);
        worn
    }

    /// It begins to hang.
    pub(crate) fn hang(&mut self, positions: &[f64]) {
        self.hung = self.heights(positions);
    }

    /// Its lowest and its highest point, in m.
    fn heights(&self, positions: &[f64]) -> [f64; 2] {
        let heights = positions.iter().skip(1).step_by(3);
        let heights = heights.skip(self.particles.start).take(self.particles.len());
        heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &height| {
            [low.min(height), high.max(height)]
        })
    }
}

/// The lowest point of the bodies, in m, where nothing below them could catch a garment.
pub(crate) fn lowest<'a>(bodies: impl Iterator<Item = &'a Body> + Clone) -> Option<f64> {
    if bodies.clone().any(|body| matches!(body.shape, Shape::Plane)) {
        return None;
    }
    let outlines = bodies.filter_map(|body| body.triangulate().ok());
    let heights = outlines.flat_map(|outline| outline.vertices).map(|[_, height, _]| height);
    heights.reduce(f64::min)
}

impl Simulation {
    /// Why the run is of no use any more: a garment is below all bodies, and nothing can hold it.
    pub(crate) fn fallen(&self) -> Option<String> {
        let (ground, positions) = (self.ground?, &self.world.state.positions);
        let below = |worn: &&Worn| worn.heights(positions)[1] < ground;
        let Worn { name, hung: [_, top], .. } = self.worn.iter().find(below)?;
        Some(format!(
            "the garment \"{name}\" fell off: it was up at {top:.2} m, and is below {ground:.2} m, where the bodies end"
        ))
    }

    /// What the user should know about garments that rest, but not where they were put.
    pub(crate) fn sunk(&self) -> Vec<String> {
        let sunk = self.worn.iter().filter_map(|worn| {
            let [[low, top], [_, now]] = [worn.hung, worn.heights(&self.world.state.positions)];
            (top - now > SUNK * (top - low)).then(|| {
                format!(
                    "the garment \"{}\" slid from {top:.2} m to {now:.2} m: nothing holds it there; pin it, take it in, or \
                     raise friction",
                    worn.name
                )
            })
        });
        sunk.collect()
    }
}
