//! End of the sewing: seams that are closed are merged, seams that stay open are pulled harder or end the
//! run.

use super::Simulation;
use super::coarser_grid::GROWTH_STEPS;
use crate::measure::open_seam::{OpenSeam, STRETCHED_MAX};
use crate::record::summary::{PhaseName, Status};
use crate::sewing::closing_springs::SeamState;
use crate::sewing::node_map::merge;

impl Simulation {
    /// Ends the sewing when the seams are closed, or when they do not close. A seam with a narrow gap is
    /// merged if nothing intersects then; a seam with a wider one is pulled harder first, so that merging
    /// its sides moves no cloth into a body.
    pub(super) fn check_seams(&mut self) -> Result<(), drape_implicit::Error> {
        let Some(springs) = self.world.closing_springs() else { return Ok(()) };
        let positions = &self.world.state.positions;
        match springs.state(positions, self.stepping.time(), self.last.imbalance) {
            SeamState::Open => {}
            SeamState::Closed => self.finish_sewing()?,
            SeamState::NearlyClosed => self.merge_nearly_closed()?,
            SeamState::Failed(gap) => {
                let seam = OpenSeam::new(&self.parts, gap, positions);
                if gap.width <= STRETCHED_MAX * self.spacing {
                    let warning = seam.warn(self.spacing, springs.largest_force(positions));
                    if self.world.stiffen_springs(self.stepping.time(), gap.width) {
                        self.outcome.events.push(warning);
                        return Ok(());
                    }
                    return self.finish_sewing();
                }
                self.outcome.place = Some(seam.place);
                let reason = seam.describe();
                self.end_early(Status::SeamsOpen, reason);
            }
        }
        Ok(())
    }

    /// Merges the two sides of every seam; the garment begins to hang.
    fn finish_sewing(&mut self) -> Result<(), drape_implicit::Error> {
        let positions = self.merged();
        self.parts.garments.iter_mut().for_each(|garment| garment.hang(&positions));
        self.world.finish_sewing(self.stepping.time(), &positions);
        let relaxation = self.rest.criteria;
        self.world.set_relaxing(relaxation.is_some_and(|own| !own.inertia));
        self.stepping.reduce(&self.world, &self.parts.seams)?;
        self.begin_phase(match relaxation {
            Some(_) => PhaseName::Relax,
            None => PhaseName::Simulate,
        });
        self.restart(relaxation)
    }

    /// Merges the two sides of every seam where that lets nothing intersect; distances that become too
    /// short grow again.
    fn merge_nearly_closed(&mut self) -> Result<(), drape_implicit::Error> {
        let positions = self.merged();
        let growth_seconds = GROWTH_STEPS * self.stepping.clock().step;
        if self.world.place_sewn(self.stepping.time(), &positions, growth_seconds) {
            self.finish_sewing()?;
        }
        Ok(())
    }

    /// Returns the positions of the particles with the two sides of every seam merged, in m.
    fn merged(&self) -> Vec<f64> {
        let mut positions = self.world.state.positions.clone();
        merge(&self.parts.seams, self.world.cloth.masses(), &mut positions);
        positions
    }

    /// Seam that is open the widest while a garment is sewn, and what to try, for the end of a
    /// message.
    pub(super) fn open_seam(&mut self) -> String {
        let positions = &self.world.state.positions;
        let Some(springs) = self.world.closing_springs() else { return String::new() };
        let seam = OpenSeam::new(&self.parts, springs.widest_gap(positions), positions);
        self.outcome.place = Some(seam.place);
        format!(
            "; {}; start its panels nearer to where they are worn, sew more slowly (sew.seconds), or choose another spacing",
            seam.describe()
        )
    }
}
