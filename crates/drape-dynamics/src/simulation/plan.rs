//! Plan: the end of a run, its steps, and its remaining phases on coarser grids and on the grid of
//! the scene.

use super::Simulation;
use crate::record::summary::PhaseName;

/// Phase that remains to be run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannedPhase {
    /// Name of the phase.
    pub name: PhaseName,
    /// Spacing of the coarser grid, in m; `None` on the grid of the scene.
    pub coarser_grid: Option<f64>,
    /// Number of particles.
    pub particles: usize,
    /// Duration, in s: of sewing, until the seams are to be closed, and of motion, until its end.
    /// `None` for the way to rest, whose duration is not known.
    pub seconds: Option<f64>,
}

impl Simulation {
    /// Returns the latest end of the run, in ticks of the clock: the largest number that
    /// [`Progress::step`](crate::Progress::step) can report on the grid of the scene. A run that
    /// comes to rest ends earlier.
    #[must_use]
    pub fn end_ticks(&self) -> usize {
        self.stepping.clock().end_ticks()
    }

    /// Returns the length of a whole step, in s.
    #[must_use]
    pub fn step_length(&self) -> f64 {
        self.stepping.clock().step
    }

    /// Returns the remaining phases as [`PlannedPhase`]s, the current one first. A garment is sewn
    /// only on the first grid if its cloth can be carried to the next grid.
    #[must_use]
    pub fn planned_phases(&self) -> Vec<PlannedPhase> {
        let mut planned = Vec::new();
        for grid in &self.coarser {
            let simulation = &grid.simulation;
            planned.extend(simulation.phases_of_grid(Some(simulation.spacing), planned.is_empty()));
        }
        planned.extend(self.phases_of_grid(None, planned.is_empty()));
        planned
    }

    /// Returns the phases of this grid only. `coarser_grid` is its spacing, in m, or `None` for the
    /// grid of the scene. The sewing is left out unless `is_first`.
    fn phases_of_grid(&self, coarser_grid: Option<f64>, is_first: bool) -> Vec<PlannedPhase> {
        let springs = self.world.closing_springs().filter(|_| is_first);
        let sewing = springs.map(|springs| (PhaseName::Sew, Some(springs.seconds())));
        let rest = self.settles().then_some((PhaseName::Relax, None));

        // Without rest the motion takes the remaining time of the clock.
        let remaining = self.stepping.clock().end - self.stepping.time();
        let seconds = if self.settles() { self.phases.motion_seconds } else { Some(remaining) };
        let motion = seconds.map(|seconds| (PhaseName::Simulate, Some(seconds)));

        let particles = self.world.cloth.particle_count();
        let phases = [sewing, rest, motion].into_iter().flatten();
        phases
            .map(|(name, seconds)| PlannedPhase { name, coarser_grid, particles, seconds })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use drape_input::Document;
    use drape_scene::Scene;

    use super::*;
    use crate::world::world_tests::FABRIC;

    fn simulation(more: &str) -> Simulation {
        let text = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n[[panel]]\nname = \"sheet\"\n\
                    fabric = \"plain\"\nrectangle = [0.1, 0.1]\n[[pin]]\npanel = \"sheet\"\nedge = \"top\"\n\
                    [time]\nstep = 0.005\nend = 9\n";
        let fabric = Document::new("plain.toml", FABRIC);
        let scene = Document::new("scene.toml", text.to_owned() + more);
        Simulation::new(Scene::from_documents(&scene, &[fabric]).expect("a scene"))
            .expect("a solver")
    }

    #[test]
    fn a_run_in_time_has_one_phase_of_what_is_left() {
        let mut moving = simulation("");
        let seconds = |moving: &Simulation| {
            let [phase] = moving.planned_phases()[..] else { panic!("one phase") };
            assert_eq!(
                (phase.name, phase.particles, phase.coarser_grid),
                (PhaseName::Simulate, 36, None)
            );
            phase.seconds.expect("a time")
        };
        assert!((seconds(&moving) - 9.0).abs() < 1e-9);
        moving.step().expect("a step");
        assert!((seconds(&moving) - 8.995).abs() < 1e-9);
    }

    #[test]
    fn coarser_grids_come_first_and_motion_last() {
        let rests = simulation("[settle]\n[refine]\nspacings = [0.05]\n[motion]\nseconds = 2\n");
        let planned = rests.planned_phases();
        let names: Vec<_> =
            planned.iter().map(|phase| (phase.name, phase.coarser_grid.is_some())).collect();
        assert_eq!(
            names,
            [(PhaseName::Relax, true), (PhaseName::Relax, false), (PhaseName::Simulate, false)]
        );
        assert_eq!(planned[2].seconds, Some(2.0));
        assert!(planned[0].particles < planned[1].particles);
    }
}
