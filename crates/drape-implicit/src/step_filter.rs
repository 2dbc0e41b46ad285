//! The step filter: continuous collision detection as a protocol on top of [`System`].
//!
//! The solver asks a filter before every straight move of the particles, and for a certificate of every
//! solution; what a filter answers decides how far an iteration goes, never where its direction points.

use crate::System;

/// Straight step that the solver is about to take, of all particles and obstacles.
#[derive(Debug)]
pub struct TrialStep<'a> {
    /// Positions at the start of the step, in m. The solver may be there already.
    pub start: &'a [f64],
    /// Displacements of the particles, in m. The filter shortens them in place.
    pub displacements: &'a mut [f64],
    /// Fraction of the prescribed motions of this sub-step that is done, 0 to 1.
    pub obstacle_time: f64,
    /// Increase of `obstacle_time` over the step.
    pub obstacle_advance: f64,
}

/// Length of a step that a [`StepFilter`] allows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub enum StepLimit {
    /// The whole step is allowed; its displacements are unchanged.
    Whole,
    /// A part of it is: its displacements are shortened.
    Shortened {
        /// Increase of the obstacle time that is allowed with them.
        obstacle_advance: f64,
    },
}

impl StepLimit {
    /// Whether the whole step is allowed.
    #[must_use]
    pub fn is_whole(self) -> bool {
        self == Self::Whole
    }
}

/// System whose trial steps are limited so that no intersection arises on them.
///
/// [`Stepper::advance_filtered`](crate::Stepper::advance_filtered) starts from the positions at the start of the
/// (sub)step, moves the particles only as far as [`limit_step`](Self::limit_step) allows, and moves held particles and
/// obstacles along with them.
pub trait StepFilter: System {
    /// Whether everything that moves by prescription moves nearly straight from one time to another, in s. A (sub)step
    /// in which it does not is halved before it is tried.
    fn is_nearly_straight(&self, _start: f64, _end: f64) -> bool {
        true
    }

    /// Limits a straight step to a part on which nothing intersects.
    ///
    /// Each particle may keep any fraction of its displacement; held particles, and whatever else moves by
    /// prescription, all keep the same fraction, which the answer tells as the obstacle time that they advance by. Any
    /// shorter step along the displacements that are left is allowed too.
    fn limit_step(&mut self, step: TrialStep<'_>) -> StepLimit;

    /// Puts obstacles to a fraction of their motion in this (sub)step: 0 is where it starts, 1 where it ends. Forces,
    /// potential and stiffness are then those of that place. After [`begin`](System::begin) it is 1.
    fn set_obstacle_time(&mut self, time: f64);

    /// Whether positions, in m, are free of intersections. A solution that is not is rejected, and its (sub)step tried
    /// again in halves.
    fn is_intersection_free(&mut self, positions: &[f64]) -> bool;
}

/// Either kind of system, as the solver sees it.
pub(crate) enum SystemRef<'a> {
    Free(&'a mut dyn System),
    Filtered(&'a mut dyn StepFilter),
}

impl SystemRef<'_> {
    pub(crate) fn system(&mut self) -> &mut dyn System {
        match self {
            Self::Free(system) => &mut **system,
            Self::Filtered(filter) => &mut **filter,
        }
    }

    pub(crate) fn is_filtered(&self) -> bool {
        matches!(self, Self::Filtered(_))
    }

    pub(crate) fn is_nearly_straight(&self, start: f64, end: f64) -> bool {
        match self {
            Self::Free(_) => true,
            Self::Filtered(filter) => filter.is_nearly_straight(start, end),
        }
    }

    pub(crate) fn limit_step(&mut self, step: TrialStep<'_>) -> StepLimit {
        match self {
            Self::Free(_) => StepLimit::Whole,
            Self::Filtered(filter) => filter.limit_step(step),
        }
    }

    pub(crate) fn set_obstacle_time(&mut self, time: f64) {
        if let Self::Filtered(filter) = self {
            filter.set_obstacle_time(time);
        }
    }

    pub(crate) fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        match self {
            Self::Free(_) => true,
            Self::Filtered(filter) => filter.is_intersection_free(positions),
        }
    }
}
