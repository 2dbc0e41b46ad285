//! Goal of a run, and the fraction of the run that is done: a number that grows from step to step,
//! and is 1 at the end.
//!
//! A run has phases on several grids. The time that a phase takes is not known before. Each phase
//! has a weight and a fraction that is done. The weight is the number of steps that such phases
//! took on garments and drapes, times the cost of a step. The fraction is
//!
//! * for sewing and motion, the fraction of their time,
//! * for the relaxation to rest, the mean over speed and imbalance of the covered fraction of the
//!   decades from the largest value to the value that counts as rest. Falling cloth comes no nearer
//!   to rest, so the number of steps counts too.

use drape_dynamics::{PhaseName, PlannedPhase, Simulation, Step};
use drape_scene::Relaxation;

/// Number of steps that sewing takes. The shipped garments take 9 to 28. A step costs as much as
/// two other steps.
const SEWING_WORK: f64 = 40.0;

/// Number of steps to rest. The shipped garments and drapes take 20 to 150.
const REST_WORK: f64 = 40.0;

/// Cost of a step in time, over the cost of a step to rest.
const MOTION_COST: f64 = 0.3;

/// Exponent of the number of particles in the time of a step, fitted to the shipped garment on
/// three grids.
const GROWTH: f64 = 0.7;

/// Fraction of a sewing that is done at the time at which the seams are to be closed. Some sewings
/// take longer.
const SEWN: f64 = 0.9;

/// Number of steps to rest after which most of [`BY_STEPS`] is reached, without inertia and with
/// inertia.
const PATIENCE: [f64; 2] = [100.0, 1000.0];

/// Largest fraction of a relaxation that the number of steps alone can give.
const BY_STEPS: f64 = 0.5;

/// Largest fraction that is reported while a step remains.
const NEARLY: f64 = 0.999;

/// Goal of a run, which says what fraction of the run is done.
#[derive(Debug, Clone)]
pub struct Goal {
    /// Remaining phases, the current phase first.
    planned: Vec<PlannedPhase>,
    rest: Option<Relaxation>,
    /// Length of a whole step, in s.
    step: f64,
    /// Work of the phases that are over.
    over: f64,
    current: CurrentPhase,
    /// Fraction that is done so far.
    done: f64,
}

/// Phase that the run is in.
#[derive(Debug, Clone, Default)]
struct CurrentPhase {
    /// Time before the first step of the phase, in s. `None` before this step.
    start: Option<f64>,
    steps: usize,
    /// Largest speed and imbalance, over the values that count as rest.
    farthest: [f64; 2],
    /// Fraction of the relaxation so far, by speed and imbalance.
    way: f64,
}

impl Goal {
    /// Returns the goal of a `simulation`, from its current state on.
    #[must_use]
    pub fn new(simulation: &Simulation) -> Self {
        Self {
            planned: simulation.planned_phases(),
            rest: simulation.rest_criteria(),
            step: simulation.step_length(),
            over: 0.0,
            current: CurrentPhase::default(),
            done: 0.0,
        }
    }

    /// Returns the fraction of the run that is done after a `step`, 0 to 1. The fraction never
    /// falls, and reaches 1 only after the last step.
    pub fn done(&mut self, step: &Step) -> f64 {
        if step.finished {
            self.done = 1.0;
            return 1.0;
        }

        self.begin(step);
        let Some(phase) = self.planned.first().copied() else { return self.done };
        let work = self.work(&phase);
        let remaining: f64 = self.planned.iter().map(|phase| self.work(phase)).sum();
        let part = self.current.part(step, &phase, self.rest);
        let done = (self.over + part * work) / (self.over + remaining);
        self.done = self.done.max(done.min(NEARLY));
        self.done
    }

    /// Begins the phase of a `step`, if the step belongs to another phase. The phases before it are
    /// over.
    fn begin(&mut self, step: &Step) {
        let is_of = |phase: &PlannedPhase| {
            phase.name == step.phase && phase.coarser_grid == step.coarser_grid
        };
        if self.planned.first().is_none_or(is_of) {
            return;
        }

        self.current = CurrentPhase::default();
        match self.planned.iter().position(is_of) {
            Some(index) => {
                let over: Vec<PlannedPhase> = self.planned.drain(..index).collect();
                self.over += over.iter().map(|phase| self.work(phase)).sum::<f64>();
            }
            // The cloth of a grid could not be carried to the next grid, which sews once more.
            None => {
                let first =
                    self.planned.iter().position(|phase| phase.coarser_grid == step.coarser_grid);
                let phase = first.map_or(self.planned[0], |index| self.planned[index]);
                self.planned.drain(..first.unwrap_or(0));
                self.planned.insert(0, PlannedPhase { name: step.phase, ..phase });
            }
        }
    }

    /// Returns the work of a `phase`, in steps to rest of one particle.
    fn work(&self, phase: &PlannedPhase) -> f64 {
        let steps = match (phase.name, phase.seconds) {
            (PhaseName::Sew, _) => SEWING_WORK,
            (PhaseName::Simulate, Some(seconds)) => MOTION_COST * seconds / self.step,
            _ => REST_WORK,
        };
        steps * (phase.particles as f64).powf(GROWTH)
    }
}

impl CurrentPhase {
    /// Takes a `step` of the `phase` into account. Returns the fraction of the phase that is done,
    /// 0 to 1.
    fn part(&mut self, step: &Step, phase: &PlannedPhase, rest: Option<Relaxation>) -> f64 {
        self.steps += 1;
        let start = *self.start.get_or_insert(step.time - step.dt);
        match (phase.name, phase.seconds, rest) {
            (PhaseName::Relax, _, Some(rest)) => self.part_to_rest(step, &rest),
            (PhaseName::Sew, Some(seconds), _) => part_of_sewing(step.time / seconds),
            (_, Some(seconds), _) => ((step.time - start) / seconds).clamp(0.0, 1.0),
            _ => 0.0,
        }
    }

    /// Returns the fraction of the relaxation that is done after a `step`: of the decades of speed
    /// and imbalance, and by the number of steps.
    fn part_to_rest(&mut self, step: &Step, rest: &Relaxation) -> f64 {
        let distances = [step.speed_max / rest.speed, step.imbalance / rest.residual];
        let mut way = 0.0;
        for (distance, farthest) in distances.into_iter().zip(&mut self.farthest) {
            let distance = if distance.is_finite() { distance.max(1.0) } else { 1.0 };
            *farthest = farthest.max(distance);
            let decades = farthest.ln();
            way += if decades > 0.0 { 0.5 * (1.0 - distance.ln() / decades) } else { 0.5 };
        }
        self.way = self.way.max(way);

        let [quick, slow] = PATIENCE;
        let patience = if rest.inertia { slow } else { quick };
        let by_steps = BY_STEPS * (1.0 - (-(self.steps as f64) / patience).exp());
        by_steps + (1.0 - by_steps) * self.way
    }
}

/// Returns the fraction of a sewing that is done at a `time`. The time is a multiple of the time at
/// which the seams are to be closed.
fn part_of_sewing(time: f64) -> f64 {
    if time < 1.0 { SEWN * time } else { 1.0 - (1.0 - SEWN) * (1.0 - time).exp() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn goal(planned: Vec<PlannedPhase>) -> Goal {
        let rest = Relaxation { speed: 1e-3, residual: 1e-4, stride: 1.0, inertia: false };
        Goal {
            planned,
            rest: Some(rest),
            step: 0.005,
            over: 0.0,
            current: CurrentPhase::default(),
            done: 0.0,
        }
    }

    fn phase(name: PhaseName, spacing: f64, particles: usize) -> PlannedPhase {
        let coarser_grid = Some(spacing).filter(|spacing| *spacing > 0.0);
        let seconds = (name != PhaseName::Relax).then_some(1.0);
        PlannedPhase { name, coarser_grid, particles, seconds }
    }

    fn step(phase: PlannedPhase, time: f64, distance: f64) -> Step {
        Step {
            time,
            dt: 0.1,
            speed_max: 1e-3 * distance,
            imbalance: 1e-4 * distance,
            report: drape_implicit::Report::default(),
            events: Vec::new(),
            phase: phase.name,
            coarser_grid: phase.coarser_grid,
            finished: false,
        }
    }

    #[test]
    fn what_is_done_never_falls_and_is_one_at_the_end_alone() {
        let sewing = phase(PhaseName::Sew, 0.02, 1600);
        let coarse = phase(PhaseName::Relax, 0.02, 1600);
        let fine = phase(PhaseName::Relax, 0.0, 25_600);
        let mut goal = goal(vec![sewing, coarse, fine]);
        let mut steps: Vec<Step> =
            (1..=14).map(|k| step(sewing, 0.1 * f64::from(k), 500.0)).collect();
        // Cloth that falls first, swings, and comes to rest; then again, finer.
        for grid in [coarse, fine] {
            let distances = [900.0, 900.0, 1000.0, 300.0, 500.0, 100.0, 130.0, 20.0, 3.0, 0.5];
            steps.extend(
                distances.iter().enumerate().map(|(k, own)| step(grid, 2.0 + 0.1 * k as f64, *own)),
            );
        }
        let done: Vec<f64> = steps.iter().map(|step| goal.done(step)).collect();
        assert!(done.windows(2).all(|pair| pair[0] <= pair[1]), "{done:?}");
        assert!(done.windows(2).filter(|pair| pair[0] < pair[1]).count() > 25, "{done:?}");
        // The coarse grid has an eighth of the work of the fine one, twice.
        assert!(done[13] > 0.08 && done[13] < 0.12, "{done:?}");
        assert!(done[23] > 0.19 && done[23] < 0.24, "{done:?}");
        assert!(done[33] > 0.95 && done[33] < 1.0, "{done:?}");
        let last = Step { finished: true, ..step(fine, 4.0, 0.1) };
        assert_eq!(goal.done(&last), 1.0);
    }

    #[test]
    fn a_grid_that_sews_once_more_does_not_take_back_what_was_done() {
        let coarse = phase(PhaseName::Relax, 0.02, 1600);
        let fine = phase(PhaseName::Relax, 0.0, 6400);
        let mut goal = goal(vec![coarse, fine]);
        let before = goal.done(&step(coarse, 0.1, 2.0));
        let sewing = phase(PhaseName::Sew, 0.0, 6400);
        let during = goal.done(&step(sewing, 0.5, 100.0));
        assert!(during >= before && during < 0.6, "{before} {during}");
        assert!(goal.done(&step(fine, 1.1, 1.0)) > during);
    }

    #[test]
    fn cloth_that_only_falls_makes_progress_by_its_steps() {
        let rest = phase(PhaseName::Relax, 0.0, 100);
        let mut goal = goal(vec![rest]);
        let done: Vec<f64> =
            (0..300).map(|k| goal.done(&step(rest, 0.1 * f64::from(k), 800.0))).collect();
        assert!(done.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(done[80] > 0.2 && done[299] < 0.5, "{} {}", done[80], done[299]);
    }
}
