//! End of the sewing: closed seams are merged. Open seams are pulled harder, or end the run.

use drape_collide::SewnPlacement;

use super::Simulation;
use super::coarser_grid::GROWTH_STEPS;
use crate::measure::open_seam::{OpenSeam, STRETCHED_MAX};
use crate::record::summary::{PhaseName, Status};
use crate::sewing::node_map::merge;
use crate::sewing::untangling::Untangling;
use crate::world::closing_springs::{SeamState, WidestGap};

/// Widest gap of an open seam whose sides are merged at their mean if nothing intersects there, in
/// m: about the thickness of cloth. A T-shirt of 25 506 particles was sewn with 0.33 mm left.
const NEARLY_CLOSED: f64 = 5e-4;

impl Simulation {
    /// Ends the sewing when the seams are closed, or when they do not close. If a seam has a narrow
    /// gap because other cloth is between its sides, the cloth is untangled. Any other open seam is
    /// pulled harder first, so that merging its sides moves no cloth into a body.
    pub(super) fn check_seams(&mut self) -> Result<(), drape_implicit::Error> {
        let Some(springs) = self.world.closing_springs() else { return Ok(()) };
        let narrow = NEARLY_CLOSED.max(STRETCHED_MAX * self.spacing);
        let positions = &self.world.state.positions;
        match springs.state(positions, self.stepping.time(), self.last.imbalance, narrow) {
            SeamState::Open => Ok(()),
            SeamState::Closed { gap, is_late } => self.merge_closed(gap, is_late),
            SeamState::NearlyClosed(gap) => self.merge_nearly_closed(gap),
            SeamState::Failed(gap) => self.sew_stretched(gap),
        }
    }

    /// Merges the two sides of every seam. The gap `gap` is the widest, and closed. Merging moves
    /// the sides by as little, which can bring cloth nearer to a body than the two keep: the
    /// distances are then shortened, and grow again. If something would intersect, the seams are
    /// untangled, or pulled harder if `is_late` is set.
    fn merge_closed(&mut self, gap: WidestGap, is_late: bool) -> Result<(), drape_implicit::Error> {
        let merged = self.merged();
        match self.world.sewn_placement(&merged) {
            Ok(SewnPlacement::Free(ratio)) if ratio >= 1.0 => self.finish_sewing(&merged),
            Ok(SewnPlacement::Free(_)) => self.place_sewn(&merged),
            _ if is_late => self.sew_stretched(gap),
            _ => self.merge_nearly_closed(gap),
        }
    }

    /// Pulls a seam with the narrow gap `gap` harder, once. Then its sides are merged if nothing
    /// intersects, or the run ends.
    fn sew_stretched(&mut self, gap: WidestGap) -> Result<(), drape_implicit::Error> {
        let Some(springs) = self.world.closing_springs() else { return Ok(()) };
        let positions = &self.world.state.positions;
        let seam = OpenSeam::new(&self.parts, gap, positions);
        let (place, mut reason) = (seam.place, seam.describe());
        if gap.width <= STRETCHED_MAX * self.spacing {
            let warning = seam.warn(self.spacing, springs.largest_force(positions));
            let merged = self.merged();
            let placement = self.world.sewn_placement(&merged);

            if self.world.stiffen_springs(self.stepping.time(), gap.width) {
                let is_blocked = match &placement {
                    Ok(SewnPlacement::Intersecting(intersections)) => {
                        self.is_only_cloth(intersections)
                    }
                    _ => false,
                };
                self.outcome.events.extend((!is_blocked).then_some(warning));
                return Ok(());
            }

            // The springs were stiffened before, so the seam is merged as it is.
            if matches!(placement, Ok(SewnPlacement::Free(_))) {
                return self.place_sewn(&merged);
            }
            reason += ", with other cloth or a body between its sides";
        }
        self.outcome.place = Some(place);
        self.end_early(Status::SeamsOpen, reason);
        Ok(())
    }

    /// Starts the phase after the sewing, with the seams merged at `positions`, in m.
    fn finish_sewing(&mut self, positions: &[f64]) -> Result<(), drape_implicit::Error> {
        self.parts.garments.iter_mut().for_each(|garment| garment.hang(positions));
        self.world.finish_sewing(self.stepping.time(), positions);
        let relaxation = self.rest.criteria;
        self.world.set_relaxing(relaxation.is_some_and(|relaxation| !relaxation.inertia));
        self.stepping.reduce(&self.world, &self.parts.seams)?;
        self.begin_phase(match relaxation {
            Some(_) => PhaseName::Relax,
            None => PhaseName::Simulate,
        });
        self.restart(relaxation)
    }

    /// Merges the two sides of every seam if the gap `gap`, the widest, is narrow and nothing
    /// intersects then. Cloth between the sides is untangled first.
    fn merge_nearly_closed(&mut self, gap: WidestGap) -> Result<(), drape_implicit::Error> {
        let mut positions = self.merged();
        let mut warning = None;

        match self.world.sewn_placement(&positions) {
            Ok(SewnPlacement::Free(_)) if gap.width > NEARLY_CLOSED => return Ok(()),
            Ok(SewnPlacement::Free(_)) => {}
            // The cloth may be too short to go round a body, so the seam is pulled harder first.
            Ok(SewnPlacement::Intersecting(intersections))
                if !self.is_only_cloth(&intersections) && !self.world.springs_are_stiffened() =>
            {
                return Ok(());
            }
            Ok(SewnPlacement::Intersecting(_)) => {
                let seam = OpenSeam::new(&self.parts, gap, &self.world.state.positions);
                let ticks = self.stepping.ticks();
                let displacement = self
                    .untangling()
                    .untangle(&mut positions, ticks, |trial| self.world.sewn_placement(trial));
                let Some(displacement) = displacement else { return Ok(()) };
                warning = Some(seam.warn_untangled(displacement));
            }
            Err(_) => return Ok(()),
        }

        self.outcome.events.extend(warning);
        self.place_sewn(&positions)
    }

    /// Returns whether all vertices of `intersections` are particles of the cloth.
    fn is_only_cloth(&self, intersections: &[[u32; 5]]) -> bool {
        let particles = self.world.cloth.particle_count();
        intersections.iter().flatten().all(|&vertex| (vertex as usize) < particles)
    }

    /// Places a garment at `positions`, in m, where its seams are merged and nothing intersects.
    /// Shortened distances grow again.
    fn place_sewn(&mut self, positions: &[f64]) -> Result<(), drape_implicit::Error> {
        let growth_seconds = GROWTH_STEPS * self.stepping.clock().step;
        let placed = self.world.place_sewn(self.stepping.time(), positions, growth_seconds);
        placed.map_or(Ok(()), |()| self.finish_sewing(positions))
    }

    /// Returns the untangling of the sewn cloth.
    pub(super) fn untangling(&self) -> Untangling {
        let world = &self.world;
        let (masses, held) = (world.cloth.masses().to_vec(), world.held().to_vec());
        Untangling::new(self.parts.seams.clone(), masses, held, self.spacing)
    }

    /// Returns the positions of the particles with the two sides of every seam merged, in m.
    fn merged(&self) -> Vec<f64> {
        let mut positions = self.world.state.positions.clone();
        merge(&self.parts.seams, self.world.cloth.masses(), &mut positions);
        positions
    }

    /// Describes the seam with the widest gap while a garment is sewn, and what to try, for the end
    /// of a message.
    pub(super) fn describe_open_seam(&mut self) -> String {
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
