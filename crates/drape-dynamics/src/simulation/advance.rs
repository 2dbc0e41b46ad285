use drape_implicit::{Error, Report};

use super::Simulation;

impl Simulation {
    /// Makes one step as long as it may be; its ticks and what the solver says.
    pub(super) fn advance(&mut self) -> Result<(usize, Report), Error> {
        if self.world.creeps {
            self.motion.restart();
        }
        loop {
            let ticks = self.pace.next(self.ticks);
            let dt = ticks as f64 * self.clock.tick();
            if self.clock.error.is_none() {
                let report = self.integrate(dt)?;
                self.enter(&report);
                return Ok((ticks, report));
            }
            let start = (self.motion.clone(), self.world.state.clone(), self.world.ledger.clone());
            let memory = self.world.surfaces.as_ref().map(|surfaces| surfaces.contact.memory());
            let seams = self.world.bonds.seams().cloned();
            self.estimate.predict(&self.motion, self.integrator(), dt);
            let report = self.integrate(dt)?;
            let error = self.estimate.estimate(&self.motion);
            if self.pace.judge((self.ticks, ticks), error) {
                self.solver.error_max = Some(self.solver.error_max.unwrap_or(0.0).max(error));
                self.enter(&report);
                return Ok((ticks, report));
            }
            (self.motion, self.world.state, self.world.ledger) = start;
            self.world.bonds.restore(seams);
            if let (Some(surfaces), Some(memory)) = (&mut self.world.surfaces, memory) {
                surfaces.contact.restore(memory);
            }
            self.solver.inexact_steps += 1;
            self.count(&report);
        }
    }

    fn integrate(&mut self, dt: f64) -> Result<Report, Error> {
        let Self { integration, world, motion, .. } = self;
        let report = match &mut self.weld {
            Some(weld) => weld.advance((world, integration), motion, dt),
            None if world.surfaces.is_some() => integration.advance_filtered(world, motion, dt),
            None => integration.advance(world, motion, dt),
        };
        if let (Err(_), Some(ledger), Some(made)) =
            (&report, &mut self.world.ledger, self.integration.unfinished())
        {
            ledger.report(made);
        }
        report
    }

    fn enter(&mut self, report: &Report) {
        if let Some(ledger) = &mut self.world.ledger {
            ledger.report(report);
        }
        let touching = match &self.world.surfaces {
            Some(surfaces) => {
                let nearness = surfaces.contact.summary();
                self.distance_min = self.distance_min.min(nearness.min_distance);
                let pinched = surfaces.contact.pinched_vertices();
                let pinched = [pinched.thinned, pinched.released];
                self.pinched_max = [0, 1].map(|k| self.pinched_max[k].max(pinched[k]));
                nearness.touching
            }
            None => self.world.contact.summary(&self.motion.positions).touching,
        };
        self.pairs_max = self.pairs_max.max(touching);
    }

    pub(super) fn count(&mut self, report: &Report) {
        let solver = &mut self.solver;
        solver.iterations_max = solver.iterations_max.max(report.iterations);
        solver.rejected_steps += report.rejected;
        solver.sub_steps += report.sub_steps;
        solver.residual_max = solver.residual_max.max(report.residual);
        solver.energy_left_max = solver.energy_left_max.max(report.energy_left);
        solver.force_evaluations += report.force_evaluations;
        solver.linear_iterations += report.linear_iterations;
        solver.tangents += report.stiffness_assemblies;
        solver.potential_evaluations += report.potential_evaluations;
        self.iterations += report.iterations;
    }
}
