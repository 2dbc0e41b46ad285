//! Bodies of a surface contact, which move vertex by vertex.

use crate::error::Error;
use crate::surface::placement::Placement;

/// Checks that `bodies` has the number of coordinates that is `needed`.
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
    /// Returns bodies at rest at the flat `positions`, in m.
    pub(super) fn new(positions: Vec<f64>) -> Obstacles {
        Obstacles { start: positions.clone(), end: positions, time: 1.0, moves: false, revision: 0 }
    }

    /// Opens a step in which the bodies move to the positions `end`, in m.
    pub(super) fn begin(&mut self, end: &[f64]) {
        self.end.copy_from_slice(end);
        self.time = 0.0;
        self.moves = self.start != self.end;
    }

    /// Returns whether the bodies move in the open step, that is `start` and `end` differ.
    pub(super) fn moves(&self) -> bool {
        self.moves
    }

    /// Writes the positions of all vertices to `all`: the `free` ones, then the bodies at the
    /// obstacle time `time`.
    pub(super) fn place(&self, free: &[f64], time: f64, all: &mut Placement) {
        let bodies = self.start.iter().zip(&self.end).map(|(start, end)| {
            // The position is exact at both ends.
            if time == 1.0 { *end } else { start + time * (end - start) }
        });
        all.place(free, (!self.moves).then_some(self.revision), bodies);
    }

    /// Commits the open step.
    pub(super) fn commit(&mut self) {
        if self.moves {
            self.start.copy_from_slice(&self.end);
            self.revision += 1;
            self.moves = false;
        }
    }

    /// Rejects the open step.
    pub(super) fn reject(&mut self) {
        self.end.copy_from_slice(&self.start);
        self.moves = false;
        self.time = 1.0;
    }

    /// Restores the committed `positions`, in m.
    pub(super) fn restore(&mut self, positions: &[f64]) {
        if self.start != positions {
            self.start.copy_from_slice(positions);
            self.revision += 1;
        }
        self.reject();
    }
}
