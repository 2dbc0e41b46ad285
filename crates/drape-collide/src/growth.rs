//! Surfaces that start nearer to each other than they keep, and come to keep their whole distances.

use crate::error::Error;
use crate::surface_contact::{SurfaceContact, Touching};

/// Part of the distance of the nearest pair that it may come to keep in a step: what is left keeps its force finite, and
/// lets the filter part it.
const LEFT: f64 = 0.9;

/// Part from which on all is kept: a sum of equal steps that should come to 1 may fall short of it by its rounding.
const WHOLE: f64 = 1.0 - 1e-9;

impl SurfaceContact {
    /// Part of their distances that surfaces keep since the last step, from 0 to 1: of those at which they push, and of
    /// those that they always keep.
    pub fn growth_fraction(&self) -> f64 {
        self.grown
    }

    /// Lets surfaces keep so little of their distances that no two push each other at the free vertices' positions, in m.
    ///
    /// The part is the distance of the nearest pair over the activation_distance of that pair; 1 if none is within its activation_distance.
    ///
    /// # Errors
    /// Positions that are none, or too many pairs.
    pub fn shrink_distances(&mut self, positions: &[f64]) -> Result<(), Error> {
        self.summary_at(positions)?;
        let part =
            |touching: &Touching| touching.gap.distance() / touching.pair.activation_distance;
        self.grown = self.touching().map(part).fold(self.grown, f64::min);
        self.keep(self.grown);
        Ok(())
    }

    /// Lets surfaces keep so much more of their distances in a step from the free vertices' positions, in m, that is then
    /// to be opened: as much of it as the nearest pair leaves room for, and never less than they kept in the last step.
    pub fn grow_distances(&mut self, start: &[f64], more: f64) {
        self.growth_work = 0.0;
        if self.grown >= 1.0 {
            return;
        }
        self.progress = 0.0;
        // What an attempt that was given up left is none of this one's.
        self.hold(self.grips.clone());
        self.keep(self.grown);
        self.look(start);
        let before = self.barrier();
        let wanted = self.grown + more;
        let wanted = if wanted > WHOLE { 1.0 } else { wanted };
        self.keep(wanted);
        self.look(start);
        let room = LEFT * self.summary().min_ratio;
        if room < 1.0 {
            self.keep((room * wanted).max(self.grown));
            self.look(start);
        }
        self.growth_work = self.barrier() - before;
    }

    /// Energy that the last growth put into contact, in J.
    pub fn growth_work(&self) -> f64 {
        self.growth_work
    }

    /// Keeps another part of the distances from the next detection on.
    pub(crate) fn keep(&mut self, part: f64) {
        if self.surface.grown != part {
            self.surface.grown = part;
            self.places.clear();
            self.detector.forget();
        }
    }
}
