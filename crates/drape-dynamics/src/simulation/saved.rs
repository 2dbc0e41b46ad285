//! Saved state of a simulation between two steps, from which a run resumes.
//!
//! A simulation is built from its scene again, and then its saved state is restored. From there on
//! every number is identical, to the last bit, with the uninterrupted run. Therefore the pairs of
//! contact and the copies of the integrator are saved too, although they could be computed again.
//!
//! A saved state needs no file: [`Simulation::resume`] also resets the simulation that was saved.
//! Everything that a program prescribes between steps is part of the state: led pins and bodies,
//! held and released particles, gravity, the velocity of the air, and forces.

use drape_checkpoint::Checkpoint;
use drape_scene::{Clock, Relaxation};
use serde::{Deserialize, Serialize};

use super::{LastStep, Outcome, Phases, Simulation};
use crate::error::Error;
use crate::measure::garment_parts::VerticalExtent;
use crate::record::stopwatch::{PastTime, Stopwatch};
use crate::record::summary::GridRecord;
use crate::stepping::RestDetector;
use crate::stepping::saved::SavedStepping;
use crate::stepping::statistics::Statistics;
use crate::world::saved::SavedWorld;

/// Names of the sections of a checkpoint.
const SECTIONS: [&str; 4] = ["world", "stepping", "run", "grid"];

/// State of a run between two steps, from which it resumes.
///
/// The state holds everything on which the next steps depend, and what a program has prescribed
/// between the steps. A program resets a simulation in memory, without a file:
///
/// ```
/// # use drape_dynamics::Simulation;
/// # fn reset(simulation: &mut Simulation) -> Result<(), Box<dyn std::error::Error>> {
/// let start = simulation.saved();
/// simulation.set_gravity([0.0, -1.62, 0.0])?;
/// simulation.step()?;
/// let hash = simulation.state_hash();
///
/// // Gravity is what it was, and the run repeats to the last bit.
/// simulation.resume(start.clone())?;
/// simulation.set_gravity([0.0, -1.62, 0.0])?;
/// simulation.step()?;
/// assert_eq!(simulation.state_hash(), hash);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct SavedSimulation {
    world: SavedWorld,
    stepping: SavedStepping,
    run: SavedRun,
    /// Coarser grid of `world` and `stepping`. `None` on the finest grid.
    grid: Option<SavedGrid>,
}

/// Coarser grid that a run is on.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct SavedGrid {
    /// Number of coarser grids from this one on.
    remaining: usize,
    /// State of the grid's run apart from world and stepping.
    run: SavedRun,
}

/// State of a run apart from world and stepping: rest, phases, garments, statistics.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct SavedRun {
    criteria: Option<Relaxation>,
    quiet_ticks: usize,
    phases: Phases,
    garments: Vec<SavedGarment>,
    statistics: Statistics,
    last: LastStep,
    events: Vec<String>,
    frame_times: Vec<f64>,
    time: PastTime,
    grids: Vec<GridRecord>,
    steps_to_forget: usize,
}

/// State of a garment: its vertical extent when it began to hang, and the time at which it slid, in
/// s.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct SavedGarment {
    hung: VerticalExtent,
    slid: Option<f64>,
}

impl SavedSimulation {
    /// Returns the number of frames until now. The
    /// [`SavedWriter`](drape_frames::SavedWriter) of a run has the same number.
    #[must_use]
    pub fn frame_count(&self) -> usize {
        self.run.frame_times.len()
    }

    /// Writes the state to the checkpoint `to`.
    ///
    /// # Errors
    /// Returns no known error: every value can be written.
    pub fn write(&self, to: &mut Checkpoint) -> Result<(), Error> {
        let [world, stepping, run, grid] = SECTIONS;
        to.put(world, &self.world)?;
        to.put(stepping, &self.stepping)?;
        to.put(run, &self.run)?;
        Ok(to.put(grid, &self.grid)?)
    }

    /// Reads the state from the checkpoint `from`.
    ///
    /// # Errors
    /// Returns an error if sections are missing or have other values.
    pub fn read(from: &Checkpoint) -> Result<Self, Error> {
        let [world, stepping, run, grid] = SECTIONS;
        Ok(Self {
            world: from.get(world)?,
            stepping: from.get(stepping)?,
            run: from.get(run)?,
            grid: from.get(grid)?,
        })
    }
}

impl Simulation {
    /// Returns the state from which the run resumes, as a [`SavedSimulation`].
    #[must_use]
    pub fn saved(&self) -> SavedSimulation {
        if let Some(grid) = self.coarser.front() {
            let SavedSimulation { world, stepping, run, .. } = grid.saved();
            let grid = Some(SavedGrid { remaining: self.coarser.len(), run });
            return SavedSimulation { world, stepping, run: self.saved_run(), grid };
        }
        SavedSimulation {
            world: self.world.saved(),
            stepping: self.stepping.saved(),
            run: self.saved_run(),
            grid: None,
        }
    }

    fn saved_run(&self) -> SavedRun {
        let garments = self.parts.garments.iter();
        SavedRun {
            criteria: self.rest.criteria,
            quiet_ticks: self.rest.quiet_ticks(),
            phases: self.phases.clone(),
            garments: garments
                .map(|garment| SavedGarment { hung: garment.hung, slid: garment.slid })
                .collect(),
            statistics: self.statistics.clone(),
            last: self.last,
            events: self.outcome.events.clone(),
            frame_times: self.frame_times.clone(),
            time: self.stopwatch.time(),
            grids: self.grids.clone(),
            steps_to_forget: self.steps_to_forget,
        }
    }

    /// Restores the state `saved`. This simulation was just built from the same scene, or is the
    /// simulation that was saved, at any later time, and also after a step that failed.
    ///
    /// A simulation whose seams were closed after `saved`, or that has left a coarser grid since,
    /// cannot go back. Build a simulation from the scene in this case.
    ///
    /// # Errors
    /// Returns [`Error::Unfit`] if `saved` does not fit the scene, and errors of the solver. The
    /// simulation cannot be used then.
    pub fn resume(&mut self, saved: SavedSimulation) -> Result<(), Error> {
        let SavedSimulation { world, stepping, run, grid } = saved;
        if run.garments.len() != self.parts.garments.len() {
            return Err(unfit("the garments are others".into()));
        }
        if run.phases.begun.is_empty() {
            return Err(unfit("it has no phase".into()));
        }

        // World and stepping belong to the current grid.
        match grid {
            Some(SavedGrid { remaining, run }) => {
                if !(1..=self.coarser.len()).contains(&remaining) {
                    return Err(unfit("the coarser grids are others".into()));
                }
                self.coarser.drain(..self.coarser.len() - remaining);
                self.coarser[0].resume(SavedSimulation { world, stepping, run, grid: None })?;
                // Gravity is the only prescription on coarser grids, and all grids share it.
                let gravity = self.coarser[0].gravity();
                self.set_gravity_of_grids(gravity);
            }
            None => {
                self.coarser.clear();
                self.resume_world(world, stepping)?;
            }
        }

        for (garment, SavedGarment { hung, slid }) in
            self.parts.garments.iter_mut().zip(run.garments)
        {
            (garment.hung, garment.slid) = (hung, slid);
        }
        self.rest = RestDetector::resumed(run.criteria, run.quiet_ticks);
        (self.phases, self.statistics, self.last) = (run.phases, run.statistics, run.last);
        self.outcome = Outcome::new(run.events);
        self.frame_times = run.frame_times;
        (self.grids, self.steps_to_forget) = (run.grids, run.steps_to_forget);
        self.stopwatch = Stopwatch::resumed(run.time);
        Ok(())
    }

    /// Restores `world` and `stepping`.
    fn resume_world(&mut self, world: SavedWorld, stepping: SavedStepping) -> Result<(), Error> {
        let is_sewn = !world.is_sewing() && !self.parts.seams.is_empty();
        let time = stepping.ticks() as f64 * self.stepping.clock().tick();
        self.world.resume(world, time).map_err(unfit)?;
        if is_sewn {
            self.stepping.reduce(&self.world, &self.parts.seams)?;
        }
        self.stepping.resume(&mut self.world, stepping).map_err(unfit)
    }

    /// Extends the run by `seconds` beyond its end. Returns `false`, and changes nothing, if the
    /// cloth is at rest, so that the run is over.
    ///
    /// # Errors
    /// [`Error::Unsuited`] if `seconds` is not positive, or if the run would end later than
    /// [`Clock::END_MAX`] seconds after its start.
    pub fn extend(&mut self, seconds: f64) -> Result<bool, Error> {
        let end = self.stepping.clock().end;
        if !(seconds > 0.0 && end + seconds <= Clock::END_MAX) {
            let reason = format!(
                "a run that ends at {end} s cannot go on for {seconds} s: give a positive number of seconds up to \
                 an end at {} s",
                Clock::END_MAX
            );
            return Err(Error::Unsuited { reason });
        }
        let goes_on = !self.is_at_rest();
        if goes_on {
            self.stepping.extend(seconds);
        }
        Ok(goes_on)
    }
}

/// Returns an [`Error::Unfit`] with `reason`.
fn unfit(reason: String) -> Error {
    Error::Unfit { reason }
}

#[cfg(test)]
mod tests {
    use drape_fabric::samples;
    use drape_input::Document;
    use drape_scene::Scene;

    use super::*;

    fn hanging() -> Simulation {
        let fabric = Document::new("plain.toml", samples::plain_weave().to_toml());
        let text = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
            panel = [{ name = \"towel\", fabric = \"plain\", rectangle = [0.06, 0.06] }]\n\
            pin = [{ panel = \"towel\", edge = \"top\" }]\n\
            time = { step = 0.004, end = 0.02 }\n";
        let scene = Scene::from_documents(&Document::new("towel.toml", text), &[fabric]);
        Simulation::new(scene.expect("right")).expect("it can be set up")
    }

    #[test]
    fn a_state_whose_end_is_no_time_is_refused() {
        for end in [f64::INFINITY, f64::NAN, -1.0] {
            let mut saved = hanging().saved();
            saved.stepping.end = end;
            let refused = hanging().resume(saved).expect_err("no end");
            assert!(refused.to_string().contains("its clock is wrong"), "{refused}");
        }
    }
}
