//! Bodies of a surface contact, which move vertex by vertex.

/// Vertices of bodies on straight trajectories in the open step.
#[derive(Debug)]
pub(super) struct Obstacles {
    /// Positions when the last step was committed, in m.
    pub(super) start: Vec<f64>,
    /// Positions at the end of the open step, in m.
    pub(super) end: Vec<f64>,
    /// Obstacle time: fraction of the motion in the open step, 0 to 1.
    pub(super) time: f64,
}

impl Obstacles {
    /// Bodies at rest at flat positions, in m.
    pub(super) fn new(positions: Vec<f64>) -> Obstacles {
        Obstacles { start: positions.clone(), end: positions, time: 1.0 }
    }

    /// Writes the positions of all vertices: the free ones', and the bodies' at an obstacle time.
    pub(super) fn write_positions(&self, free: &[f64], time: f64, all: &mut Vec<f64>) {
        let bodies = self.start.iter().zip(&self.end).map(|(start, end)| {
            // Exact at both ends.
            if time == 1.0 { *end } else { start + time * (end - start) }
        });
        all.clear();
        all.extend(free.iter().copied().chain(bodies));
    }

    /// Ends the open step.
    pub(super) fn commit(&mut self) {
        self.start.copy_from_slice(&self.end);
    }

    /// Returns to committed positions.
    pub(super) fn restore(&mut self, positions: &[f64]) {
        self.start.copy_from_slice(positions);
        self.end.copy_from_slice(positions);
        self.time = 1.0;
    }
}
