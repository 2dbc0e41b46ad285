//! Step filter: continuous collision detection as a protocol on top of [`System`] \[Li20\].
//!
//! The solver asks the filter for a limit before every straight step of the particles, and asks
//! whether a solution is free of intersections. The answers decide how far an iteration moves,
//! never in which direction.

use crate::system::System;

/// Straight step of all particles and obstacles that the solver is about to take.
#[derive(Debug)]
pub struct TrialStep<'a> {
    /// Positions at the start of the step, in m, free of intersections.
    pub start: &'a [f64],
    /// Displacements of the particles, in m. The filter shortens them in place.
    pub displacements: &'a mut [f64],
    /// Obstacle time at the start: fraction of the (sub)step's prescribed motions already
    /// completed, 0 to 1.
    pub obstacle_time: f64,
    /// Increase of the obstacle time over the step.
    pub obstacle_advance: f64,
}

/// Length of a step that a [`StepFilter`] allows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub enum AllowedStep {
    /// The whole step is allowed. The displacements are unchanged.
    Whole,
    /// A part of the step is allowed. The displacements are shortened.
    Shortened {
        /// Allowed increase of the obstacle time.
        obstacle_advance: f64,
    },
}

impl AllowedStep {
    /// Whether the whole step is allowed.
    #[must_use]
    pub fn is_whole(self) -> bool {
        self == Self::Whole
    }
}

/// System that limits steps so that nothing intersects along them, and tests solutions.
///
/// [`Stepper::advance_filtered`](crate::Stepper::advance_filtered) moves the particles from the
/// start positions of each (sub)step only as far as [`limit_step`](Self::limit_step) allows, and
/// moves held particles and obstacles together with the free particles.
///
/// A filter for a particle above a floor at a height of 0:
///
/// ```
/// use drape_implicit::{StepFilter, AllowedStep, System, TrialStep};
/// # use drape_implicit::{BlockMatrix, Sparsity, Stiffness};
/// # struct Ball;
/// # impl System for Ball {
/// #     fn particle_count(&self) -> usize { 1 }
/// #     fn masses(&self) -> &[f64] { &[1.0] }
/// #     fn held(&self) -> &[bool] { &[false] }
/// #     fn begin(&mut self, _: f64, _: f64, _: &[f64], _: &mut [f64]) {}
/// #     fn forces(&mut self, _: &[f64], forces: &mut [f64]) { forces.fill(0.0) }
/// #     fn potential(&mut self, _: &[f64]) -> f64 { 0.0 }
/// #     fn stiffness(&mut self, _: &[f64], _: Stiffness, _: &mut BlockMatrix) {}
/// #     fn sparsity(&self) -> Sparsity { Sparsity::from_pairs(1, []).unwrap() }
/// #     fn accept(&mut self, _: &[f64], _: &[f64], _: f64) {}
/// # }
///
/// impl StepFilter for Ball {
///     fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep {
///         // A tenth of the height is kept.
///         let (fall, room) = (-step.displacements[1], 0.9 * step.start[1]);
///         if fall <= room {
///             return AllowedStep::Whole;
///         }
///         let fraction = room / fall;
///         step.displacements.iter_mut().for_each(|d| *d *= fraction);
///         AllowedStep::Shortened { obstacle_advance: fraction * step.obstacle_advance }
///     }
///
///     fn set_obstacle_time(&mut self, _time: f64) {}
///
///     fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
///         positions[1] > 0.0
///     }
/// }
///
/// let mut displacements = [0.0, -4.0, 0.0];
/// let step = TrialStep {
///     start: &[0.0, 1.0, 0.0],
///     displacements: &mut displacements,
///     obstacle_time: 0.0,
///     obstacle_advance: 1.0,
/// };
/// let limit = Ball.limit_step(step);
/// assert_eq!(limit, AllowedStep::Shortened { obstacle_advance: 0.225 });
/// assert_eq!(displacements, [0.0, -0.9, 0.0]);
/// ```
pub trait StepFilter: System {
    /// Returns whether a (sub)step from the time `_start` to `_end`, in s, resolves all prescribed
    /// motions: each is short and nearly straight. Otherwise the solver halves the (sub)step before
    /// the first attempt.
    fn resolves_motion(&self, _start: f64, _end: f64) -> bool {
        true
    }

    /// Limits a straight step to a part on which nothing intersects.
    ///
    /// Each free particle may keep a fraction of its displacement. Held particles and obstacles all
    /// keep one common fraction, which the answer returns as the allowed advance of the obstacle
    /// time. Any shorter step along the shortened displacements must be free of intersections too.
    fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep;

    /// Moves obstacles to the fraction `time` of their motion in this (sub)step: 0 at the start, 1
    /// at the end.
    ///
    /// Forces, potential and stiffness then refer to the moved obstacles. In a filtered step the
    /// solver calls this method before it evaluates at another obstacle time, so that
    /// [`begin`](System::begin) may leave any time.
    /// [`Stepper::advance`](crate::Stepper::advance) never calls this method: a system with moving
    /// obstacles that is also stepped without a filter sets the time 1 in its `begin`.
    fn set_obstacle_time(&mut self, time: f64);

    /// Returns the work of the obstacles over their whole motion in this (sub)step, in J, with the
    /// forces at `_positions` and at the current obstacle time. This work is the increase of the
    /// potential by the motion of the obstacles alone. Only the energy balance calls this method.
    fn obstacle_work(&mut self, _positions: &[f64]) -> f64 {
        0.0
    }

    /// Returns whether `positions`, in m, are free of intersections. The solver rejects a solution
    /// with intersections and halves the (sub)step.
    fn is_intersection_free(&mut self, positions: &[f64]) -> bool;
}

/// Reference to a system with or without a step filter, for the solver.
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

    pub(crate) fn resolves_motion(&self, start: f64, end: f64) -> bool {
        match self {
            Self::Free(_) => true,
            Self::Filtered(filter) => filter.resolves_motion(start, end),
        }
    }

    pub(crate) fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep {
        match self {
            Self::Free(_) => AllowedStep::Whole,
            Self::Filtered(filter) => filter.limit_step(step),
        }
    }

    pub(crate) fn set_obstacle_time(&mut self, time: f64) {
        if let Self::Filtered(filter) = self {
            filter.set_obstacle_time(time);
        }
    }

    pub(crate) fn obstacle_work(&mut self, positions: &[f64]) -> f64 {
        match self {
            Self::Free(_) => 0.0,
            Self::Filtered(filter) => filter.obstacle_work(positions),
        }
    }

    pub(crate) fn is_intersection_free(&mut self, positions: &[f64]) -> bool {
        match self {
            Self::Free(_) => true,
            Self::Filtered(filter) => filter.is_intersection_free(positions),
        }
    }
}
