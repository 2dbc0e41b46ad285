//! Bodies of a surface contact, which move vertex by vertex.

use crate::error::Error;
use crate::surface::placement::Placement;

/// Checks the number of coordinates of bodies.
pub(super) fn check_bodies(bodies: &[f64], needed: usize) -> Result<(), Error> {
    if bodies.len() == needed {
        return Ok(());
    }
    Err(Error::WrongLength { what: "coordinates of bodies", found: bodies.len(), needed })
}

/// Vertices of bodies on straight trajectories in the open step.
#[derive(Debug)]
pub(super) struct Obstacles {
    /// Positions when the last step was committed, in m.
    pub(super) start: Vec<f64>,
    /// Positions at the end of the open step, in m.
    pub(super) end: Vec<f64>,
    /// Obstacle time: fraction of the motion in the open step, 0 to 1.
    pub(super) time: f64,
    /// Whether the bodies move in the open step.
    moves: bool,
    /// Revision of the committed positions.
    revision: u64,
}

impl Obstacles {
    /// Bodies at rest at flat positions, in m.
    pub(super) fn new(positions: Vec<f64>) -> Obstacles {
        Obstacles { start: positions.clone(), end: positions, time: 1.0, moves: false, revision: 0 }
    }

    /// Opens a step to positions at its end, in m.
    pub(super) fn begin(&mut self, end: &[f64]) {
        self.end.copy_from_slice(end);
        self.time = 0.0;
        self.moves = self.start != self.end;
    }

    /// Whether the bodies move in the open step.
    pub(super) fn moves(&self) -> bool {
        self.moves
    }

    /// Places all vertices: the free ones, and the bodies' at an obstacle time.
    pub(super) fn place(&self, free: &[f64], time: f64, all: &mut Placement) {
        let bodies = self.start.iter().zip(&self.end).map(|(start, end)| {
            // Exact at both ends.
            if time == 1.0 { *end } else { start + time * (end - start) }
        });
        all.place(free, (!self.moves).then_some(self.revision), bodies);
    }

    /// Ends the open step.
    pub(super) fn commit(&mut self) {
        if self.moves {
            self.start.copy_from_slice(&self.end);
            self.revision += 1;
            self.moves = false;
        }
    }

    /// Returns to committed positions.
    pub(super) fn restore(&mut self, positions: &[f64]) {
        if self.start != positions {
            self.start.copy_from_slice(positions);
            self.revision += 1;
        }
        self.end.copy_from_slice(positions);
        self.moves = false;
        self.time = 1.0;
    }
}
