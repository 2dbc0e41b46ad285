//! Statistics of the steps of a run: work of the solver, and contact.

use drape_implicit::Report;
use serde::{Deserialize, Serialize};

use crate::record::step_hashes::StepHashes;
use crate::record::summary::{Contacts, Solver};
use crate::world::{ALL_PARTICLES, Contact, World};

/// Sums and extremes over the steps of a run.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Statistics {
    solver: Solver,
    /// Number of accepted steps.
    pub(crate) steps: usize,
    /// Iterations of all steps.
    iterations: usize,
    /// Largest number of touching pairs after a step.
    pairs_max: usize,
    /// Largest number of particles with reduced distances after a step.
    thinned_max: usize,
    /// Largest number of released particles after a step.
    pub(crate) released_max: usize,
    /// Largest number of intersections after a step, of steps that were accepted.
    pub(crate) intersections_max: usize,
    /// Largest number of exempt intersections after a step.
    exempt_max: usize,
    /// Deepest exempt intersection after a step, in m.
    exempt_penetration_max: f64,
    /// Smallest distance of two surfaces at the start and after a step, in m.
    min_distance: f64,
    /// Hashes after the steps, where they are asked for.
    pub(crate) hashes: Option<StepHashes>,
}

impl Statistics {
    /// Returns the statistics of a run that starts in the state of `world`.
    pub(crate) fn new(world: &World) -> Self {
        let surfaces = world.contact.surfaces();
        let min_distance = surfaces.map(|surfaces| surfaces.contact.pairs().summary().min_distance);
        Self {
            solver: Solver::default(),
            steps: 0,
            iterations: 0,
            pairs_max: 0,
            thinned_max: 0,
            released_max: 0,
            intersections_max: 0,
            exempt_max: 0,
            exempt_penetration_max: 0.0,
            min_distance: min_distance.unwrap_or(f64::INFINITY),
            hashes: None,
        }
    }

    /// Adds the accepted step of `report`, which led to the state of `world`.
    pub(crate) fn add_step(&mut self, report: &Report, world: &mut World) {
        let touching = match &mut world.contact {
            Contact::Surfaces(surfaces) => {
                let near = surfaces.contact.pairs().summary();
                self.min_distance = self.min_distance.min(near.min_distance);
                let pinched = surfaces.contact.state().pinched_vertices();
                self.thinned_max = self.thinned_max.max(pinched.thinned);
                self.released_max = self.released_max.max(pinched.released);

                let positions = &world.state.positions;
                let seams = surfaces.at_seams(positions);
                self.exempt_max = self.exempt_max.max(seams.exempt);
                self.exempt_penetration_max = self.exempt_penetration_max.max(seams.penetration);
                // The step has been tested for all other intersections.
                if seams.open > 0 || pinched.released > 0 {
                    let count = surfaces.intersection_count(positions, &seams);
                    self.intersections_max = self.intersections_max.max(count);
                }
                near.touching
            }
            Contact::Particles(bodies) => {
                let touching = bodies.contact.touching_particle_count(&world.state.positions);
                touching.expect(ALL_PARTICLES)
            }
        };

        self.pairs_max = self.pairs_max.max(touching);
        self.steps += 1;
        if let Some(hashes) = &mut self.hashes {
            hashes.add(&world.state.positions, &world.state.velocities);
        }
        self.add_work(report);
    }

    /// Adds the step of `report`, which was taken back because its error was too large.
    pub(crate) fn add_inexact(&mut self, report: &Report) {
        self.solver.inexact_steps += 1;
        self.add_work(report);
    }

    /// Records the estimated `error` of an accepted step, in m.
    pub(crate) fn note_error(&mut self, error: f64) {
        self.solver.error_max = Some(self.solver.error_max.unwrap_or(0.0).max(error));
    }

    fn add_work(&mut self, report: &Report) {
        let solver = &mut self.solver;
        solver.iterations_max = solver.iterations_max.max(report.iterations);
        solver.rejected_steps += report.rejected;
        solver.sub_steps += report.sub_steps;
        solver.residual_max = solver.residual_max.max(report.residual);
        solver.energy_left_max = solver.energy_left_max.max(report.energy_left);
        solver.force_evaluations += report.force_evaluations;
        solver.linear_solves_max = solver.linear_solves_max.max(report.linear_solves);
        solver.linear_iterations += report.linear_iterations;
        solver.stiffness_assemblies += report.stiffness_assemblies;
        solver.potential_evaluations += report.potential_evaluations;
        self.iterations += report.iterations;
    }

    /// Returns the work of the solver as a [`Solver`].
    pub(crate) fn solver(&self) -> Solver {
        let iterations_mean = self.iterations as f64 / self.steps.max(1) as f64;
        Solver { iterations_mean, ..self.solver }
    }

    /// Returns the contact over the run, and at the state of `world`.
    pub(crate) fn contacts(&self, world: &World) -> Contacts {
        let positions = &world.state.positions;
        let contacts = Contacts {
            pairs_max: self.pairs_max,
            thinned_max: self.thinned_max,
            released_max: self.released_max,
            intersections_max: self.intersections_max,
            exempt_max: self.exempt_max,
            exempt_penetration_max: self.exempt_penetration_max,
            start_growth_fraction: 1.0,
            growth_fraction: world.contact.growth_fraction(),
            ..Contacts::default()
        };

        match &world.contact {
            Contact::Surfaces(surfaces) => {
                let seams = surfaces.at_seams(positions);
                Contacts {
                    min_distance: Some(self.min_distance).filter(|distance| distance.is_finite()),
                    intersections: surfaces.intersection_count(positions, &seams),
                    intersections_found: surfaces.intersections_found,
                    exempt: seams.exempt,
                    start_growth_fraction: surfaces.start_growth_fraction,
                    ..contacts
                }
            }
            Contact::Particles(bodies) => {
                let near = bodies.contact.summary(positions).expect(ALL_PARTICLES);
                Contacts {
                    min_distance: Some(near.min_distance).filter(|distance| distance.is_finite()),
                    intersections: near.inside,
                    ..contacts
                }
            }
        }
    }
}
