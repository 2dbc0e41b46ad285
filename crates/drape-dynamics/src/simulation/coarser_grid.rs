//! Coarser grids: the cloth is sewn and relaxed on each coarser grid first, and is carried to the
//! next finer grid.
//!
//! Each coarser grid has its simulation. At rest the positions are interpolated to the particles of
//! the next grid, which begins there at rest, with merged seams. If the interpolated cloth
//! intersects something, the next grid begins from the start of its scene, as if there were no
//! coarser grid.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use drape_cloth::Interpolation;
use drape_collide::SewnPlacement;
use drape_input::counted;
use drape_scene::{Panel, Scene};

use super::saved::SavedSimulation;
use super::{CoarserGrid, Outcome, Simulation, Step};
use crate::error::Error;
use crate::record::summary::{GridRecord, Phase, PhaseName, Status};
use crate::sewing::node_map::merge;
use crate::stepping::Scheme;
use crate::world::{ALL_PARTICLES, PlacedSurfaces};

/// Number of first steps over which distances grow again that were shortened to place cloth.
pub(super) const GROWTH_STEPS: f64 = 20.0;

/// Number of first steps in which the interpolated cloth becomes smooth. Its bends are concentrated
/// at the lines of the coarser grid, so the memories of friction are reset after each of these
/// steps.
const SMOOTHING_STEPS: usize = 3;

/// Cloth at rest on a coarser grid, interpolated to the particles of the next grid.
struct CarriedCloth {
    ticks: usize,
    positions: Vec<f64>,
    bodies: Option<Vec<f64>>,
}

/// How a grid begins after the next coarser grid.
#[derive(Debug)]
enum GridStart {
    /// The cloth of the coarser grid was carried.
    Carried,
    /// The cloth was carried, with particles displaced by up to this distance, in m, so that
    /// nothing intersects.
    Untangled(f64),
    /// The cloth could not be carried, for this reason.
    NotCarried(String),
}

impl CoarserGrid {
    /// Takes the coarser grids out of `scene`, each with its interpolation to the next grid.
    pub(super) fn take_from(scene: &mut Scene, scheme: &Scheme) -> Result<VecDeque<Self>, Error> {
        let coarser = std::mem::take(&mut scene.coarser);
        let mut panels: Vec<Vec<Panel>> = coarser.iter().map(|grid| grid.panels.clone()).collect();
        panels.push(scene.panels.clone());
        let end = scene.schedule.clock.end;
        let grids = coarser.into_iter().zip(panels.windows(2)).map(|(mut scene, pair)| {
            scene.schedule.clock.end = end;

            let panels = pair[0].iter().zip(&pair[1]).map(|(from, to)| {
                let numbers = 3 * from.first..3 * from.particles().end;
                (numbers, Interpolation::new(&from.lattice, &to.lattice))
            });
            let panels = panels.collect();
            let mut simulation = Box::new(Simulation::with_scheme(scene, scheme.clone())?);
            // Motions that wait for rest start on the last grid only.
            simulation.phases.motion_seconds = None;
            Ok(Self { simulation, panels })
        });
        grids.collect()
    }

    pub(super) fn give_up_when(&mut self, flag: &Arc<AtomicBool>) {
        self.simulation.give_up_when(flag.clone());
    }

    /// Returns the acceleration of gravity, in m/s².
    pub(super) fn gravity(&self) -> [f64; 3] {
        self.simulation.world.gravity()
    }

    /// Sets the acceleration of gravity to `acceleration`, in m/s².
    pub(super) fn set_gravity(&mut self, acceleration: [f64; 3]) {
        self.simulation.set_gravity_of_grids(acceleration);
    }

    pub(super) fn time(&self) -> f64 {
        self.simulation.time()
    }

    pub(super) fn ticks(&self) -> usize {
        self.simulation.ticks()
    }

    pub(super) fn saved(&self) -> SavedSimulation {
        self.simulation.saved()
    }

    pub(super) fn resume(&mut self, saved: SavedSimulation) -> Result<(), Error> {
        self.simulation.resume(saved)
    }

    /// Returns the cloth, interpolated to the particles of the next grid.
    fn carried(&self) -> CarriedCloth {
        let positions = &self.simulation.world.state.positions;
        let surfaces = self.simulation.world.contact.surfaces();
        let panels = self.panels.iter();
        CarriedCloth {
            ticks: self.ticks(),
            positions: panels
                .flat_map(|(numbers, interpolation)| {
                    interpolation.apply(&positions[numbers.clone()]).expect(ALL_PARTICLES)
                })
                .collect(),
            bodies: surfaces.map(|surfaces| surfaces.contact.state().body_positions().to_vec()),
        }
    }

    /// Returns the [`GridRecord`] of this grid.
    fn record(&self) -> GridRecord {
        let simulation = &self.simulation;
        GridRecord {
            spacing: simulation.spacing,
            particles: simulation.world.cloth.particle_count(),
            steps: simulation.statistics.steps,
            linear_iterations: simulation.statistics.solver().linear_iterations,
            end: self.time(),
            carried: false,
        }
    }
}

impl Simulation {
    /// Advances by one [`Step`] on a coarser grid. At the end of this grid the next grid begins.
    pub(super) fn step_on_coarser_grid(&mut self) -> Result<Step, drape_implicit::Error> {
        let earlier_events = self.outcome.events.len();
        let grid = &mut self.coarser[0];
        let spacing = Some(grid.simulation.spacing);
        let step = match grid.simulation.step() {
            Ok(step) => {
                let goes_on = !step.finished;
                let step = Step { coarser_grid: spacing, finished: self.is_over(), ..step };
                if goes_on || step.finished {
                    return Ok(step);
                }
                Some(step)
            }
            Err(error @ drape_implicit::Error::Cancelled) => return Err(error),
            Err(error) => {
                grid.simulation.fail(&error);
                None
            }
        };

        self.leave_coarser_grid()?;
        let mut events = self.outcome.events[earlier_events..].to_vec();
        // Where a step failed, the first step of the next grid is made at once.
        let mut step = step.map_or_else(|| self.step(), Ok)?;
        events.append(&mut step.events);
        Ok(Step { events, finished: self.is_over(), ..step })
    }

    /// Goes on to the next grid, with the cloth of this grid if it is at rest. Records a
    /// [`GridRecord`] and a warning.
    fn leave_coarser_grid(&mut self) -> Result<(), drape_implicit::Error> {
        let Some(grid) = self.coarser.pop_front() else { return Ok(()) };
        let Outcome { status, reason, .. } = &grid.simulation.outcome;
        let start = if *status != Status::Ok || !grid.simulation.is_at_rest() {
            let reason = reason.clone();
            GridStart::NotCarried(reason.unwrap_or_else(|| "it did not come to rest".into()))
        } else if let Some(next) = self.coarser.front_mut() {
            next.simulation.begin_with(grid.carried())?
        } else {
            self.begin_with(grid.carried())?
        };

        let is_carried = !matches!(start, GridStart::NotCarried(_));
        let record = GridRecord { carried: is_carried, ..grid.record() };
        let spacing = 1e3 * record.spacing;
        let event = match start {
            GridStart::Carried => None,
            GridStart::Untangled(displacement) => Some(format!(
                "the cloth of the grid of {spacing:.1} mm intersects on the next; particles there are displaced by up to \
                 {:.2} mm, to where nothing does",
                1e3 * displacement
            )),
            GridStart::NotCarried(reason) => Some(format!(
                "the grid of {spacing:.1} mm is of no use: {reason}; the next one begins from its own start"
            )),
        };
        self.outcome.events.extend(event);
        self.grids.push(record);
        Ok(())
    }

    /// Begins at rest with the cloth `carried` from a coarser grid. Changes nothing if the cloth
    /// cannot be carried.
    fn begin_with(&mut self, carried: CarriedCloth) -> Result<GridStart, drape_implicit::Error> {
        let CarriedCloth { ticks, mut positions, bodies } = carried;
        let is_sewn = !self.parts.seams.is_empty();
        if is_sewn {
            merge(&self.parts.seams, self.world.cloth.masses(), &mut positions);
        }

        let bodies = bodies.unwrap_or_default();
        let untangling = self.untangling();
        let mut start = GridStart::Carried;
        if let Some(surfaces) = self.world.contact.surfaces_mut() {
            let contact = &mut surfaces.contact;
            let placement =
                contact.setup().and_then(|mut setup| setup.sewn_placement(&positions, &bodies));
            match placement {
                Ok(SewnPlacement::Free(_)) => {}
                Ok(SewnPlacement::Intersecting(intersections)) => {
                    let displacement = untangling.untangle(&mut positions, ticks, |trial| {
                        contact.setup()?.sewn_placement(trial, &bodies)
                    });
                    let Some(displacement) = displacement else {
                        let count = counted(intersections.len(), "intersection", "intersections");
                        let reason = format!("its cloth has {count} on the next");
                        return Ok(GridStart::NotCarried(reason));
                    };
                    start = GridStart::Untangled(displacement);
                }
                Err(_) => {
                    let reason = "it has other bodies than the next".into();
                    return Ok(GridStart::NotCarried(reason));
                }
            }
        }

        let placed = PlacedSurfaces {
            positions: &positions,
            bodies: &bodies,
            growth_seconds: GROWTH_STEPS * self.stepping.clock().step,
        };
        self.stepping.start_at(ticks);
        let time = self.stepping.time();
        self.parts.garments.iter_mut().for_each(|garment| garment.hang(&positions));
        if self.world.begin_at(time, &placed).is_err() {
            return Ok(GridStart::NotCarried("its cloth cannot be placed on the next".into()));
        }

        // The rest criteria of the scene hold from the first step on this grid.
        let relaxation = self.rest.criteria;
        self.world.set_relaxing(relaxation.is_some_and(|relaxation| !relaxation.inertia));
        if is_sewn {
            self.stepping.reduce(&self.world, &self.parts.seams)?;
        }
        self.steps_to_forget = SMOOTHING_STEPS;
        self.phases.begun = vec![Phase { name: PhaseName::Relax, start: time, frame: 0 }];
        self.restart(relaxation)?;
        Ok(start)
    }
}

#[cfg(test)]
mod tests {
    use drape_input::Document;

    use super::*;
    use crate::world::world_tests::FABRIC;

    /// Two level sheets, 10 mm apart, and more of a scene.
    fn sheets(more: &str) -> Simulation {
        let text = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n[[panel]]\nname = \"sheet\"\n\
                    fabric = \"plain\"\nrectangle = [0.1, 0.1]\nturn = [-90, 0, 0]\n\
                    stack = { count = 2, step = [0, 0.01, 0] }\n\
                    [[pin]]\npanel = \"sheet\"\nedge = \"top\"\n\
                    [time]\nstep = 0.005\nend = 9\n[settle]\n";
        let text = format!("{text}{more}");
        let fabric = Document::new("plain.toml", FABRIC);
        let scene = Scene::from_documents(&Document::new("scene.toml", text), &[fabric]);
        Simulation::new(scene.expect("a right scene")).expect("a solver")
    }

    #[test]
    fn cloth_that_would_intersect_is_not_carried_and_leaves_the_grid_at_its_start() {
        let [mut own, mut other] = [sheets(""), sheets("")];
        let mut positions = own.positions().to_vec();
        let half = positions.len() / 2;
        // Half of the lower sheet is far above the upper one.
        positions[..half / 2].iter_mut().skip(1).step_by(3).for_each(|y| *y += 0.05);
        let carried = CarriedCloth { ticks: 100, positions, bodies: Some(Vec::new()) };
        let begun = own.begin_with(carried).expect("a solver");
        let GridStart::NotCarried(reason) = begun else { panic!("it intersects: {begun:?}") };
        assert!(reason.contains("intersections"), "{reason}");
        for _ in 0..3 {
            own.step().expect("a step");
            other.step().expect("a step");
        }
        assert_eq!(own.state_hash(), other.state_hash());
        assert_eq!(own.time(), other.time());
    }

    #[test]
    fn a_grid_whose_cloth_would_intersect_is_left_and_said() {
        let mut own =
            sheets("[refine]\nspacings = [0.05]\n[[pin]]\npanel = \"sheet 2\"\nedge = \"top\"\n");
        let start = own.positions().to_vec();
        let grid = &mut own.coarser[0].simulation;
        while !grid.step().expect("a step").finished {}
        assert!(grid.is_at_rest());
        let half = grid.world.state.positions.len() / 4;
        grid.world.state.positions[..half].iter_mut().for_each(|x| *x += 0.05);
        own.leave_coarser_grid().expect("a solver");
        assert_eq!((own.positions(), own.time()), (&start[..], 0.0));
        assert!(own.coarser.is_empty() && !own.grids[0].carried);
        let told = &own.outcome.events[0];
        assert!(
            told.contains("intersections") && told.contains("begins from its own start"),
            "{told}"
        );
    }

    #[test]
    fn cloth_with_one_particle_on_the_wrong_side_is_carried_untangled() {
        let mut own = sheets("");
        let mut positions = own.positions().to_vec();
        let middle = 3 * (positions.len() / 12) + 1;
        positions[middle] += 0.015;
        let carried = CarriedCloth { ticks: 100, positions, bodies: Some(Vec::new()) };
        let begun = own.begin_with(carried).expect("a solver");
        assert!(matches!(begun, GridStart::Untangled(_)), "{begun:?}");
        let now = own.positions().to_vec();
        let found = own.world.sewn_placement(&now).expect("finite positions");
        assert!(matches!(found, SewnPlacement::Free(_)), "{found:?}");
        own.step().expect("a step");
    }

    #[test]
    fn cloth_nearer_than_surfaces_keep_is_carried_with_shrunk_distances() {
        let mut own = sheets("");
        let mut positions = own.positions().to_vec();
        let half = positions.len() / 2;
        positions[half..].iter_mut().skip(1).step_by(3).for_each(|y| *y -= 0.01 - 5e-5);
        let carried = CarriedCloth { ticks: 100, positions, bodies: Some(Vec::new()) };
        let begun = own.begin_with(carried).expect("a solver");
        assert!(matches!(begun, GridStart::Carried), "{begun:?}");
        let surfaces = |simulation: &Simulation| {
            simulation.world.contact.surfaces().expect("surfaces").growth_fraction()
        };
        assert!(surfaces(&own) < 1.0 && own.time() > 0.0);
        for _ in 0..60 {
            own.step().expect("a step");
        }
        assert_eq!(surfaces(&own), 1.0);
    }
}
