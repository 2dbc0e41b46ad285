//! Open step: what a solver asks while it moves the free vertices, and the two ends of a step.

use super::active_pairs::ActivePair;
use super::energy::{SurfaceEnergy, for_each_gradient};
use super::obstacles::{Obstacles, check_bodies};
use super::pairs::SurfacePairs;
use super::surface_contact::SurfaceContact;
use crate::error::{Error, check_index, check_length, check_positions};
use crate::surface::exact::Intersection;
use crate::surface::friction::ActiveGap;
use crate::surface::step_filter::SurfaceTrial;

/// Start of a step, for [`SurfaceContact::begin`].
#[derive(Debug, Clone, Copy)]
pub struct SurfaceStart<'a> {
    /// Positions of the free vertices at the start of the step, flat, in m.
    pub positions: &'a [f64],
    /// Positions of the bodies' vertices at the end of the step, flat, in m.
    pub bodies: &'a [f64],
    /// Gap at each free vertex while seams are open, in m, or `None` if gaps stay. Gaps only become
    /// narrower. Gaps have no effect once the seams are closed.
    pub seam_gaps: Option<&'a [f64]>,
    /// Largest increase of the fraction of their distances that surfaces keep, 0 to 1.
    ///
    /// The increase is as large as the nearest pair has room for. The fraction never falls below
    /// the fraction when the last step was committed.
    pub growth_increment: f64,
}

impl<'a> SurfaceStart<'a> {
    /// Returns the start of a step from the free vertices' `positions`, in which the bodies'
    /// vertices move to `bodies`, both flat, in m. Seams keep their gaps, and distances do not
    /// grow.
    #[must_use]
    pub fn new(positions: &'a [f64], bodies: &'a [f64]) -> SurfaceStart<'a> {
        SurfaceStart { positions, bodies, seam_gaps: None, growth_increment: 0.0 }
    }
}

/// Step of a [`SurfaceContact`] that is open.
///
/// [`SurfaceContact::begin`] opens a step. Then [`set_obstacle_time`](OpenStep::set_obstacle_time),
/// [`energy`](OpenStep::energy), [`limit`](OpenStep::limit) and
/// [`intersections`](OpenStep::intersections) may be called any number of times and in any order:
/// none of them changes what the contact remembers. Before a commit, a solver tests the end
/// positions with `intersections` at the obstacle time 1.
///
/// [`commit`](OpenStep::commit) and [`reject`](OpenStep::reject) end the step. If the handle is
/// dropped, the step stays open, and [`SurfaceContact::step`] returns a handle again. So a solver
/// can hold the contact and borrow the step for one call at a time.
///
/// A handle cannot be used after the end of its step:
///
/// ```compile_fail,E0382
/// # fn step(contact: &mut drape_collide::SurfaceContact, end: &[f64]) {
/// let step = contact.begin(drape_collide::SurfaceStart::new(end, &[])).unwrap();
/// step.commit(end).unwrap();
/// step.commit(end).unwrap();
/// # }
/// ```
///
/// While a handle exists, the contact cannot be set up or opened:
///
/// ```compile_fail,E0499
/// # fn step(contact: &mut drape_collide::SurfaceContact, end: &[f64]) {
/// let step = contact.begin(drape_collide::SurfaceStart::new(end, &[])).unwrap();
/// contact.setup().unwrap().close_seams();
/// step.commit(end).unwrap();
/// # }
/// ```
#[derive(Debug)]
pub struct OpenStep<'a> {
    contact: &'a mut SurfaceContact,
}

impl<'a> OpenStep<'a> {
    /// Opens a step of `contact` from `start`, see [`SurfaceContact::begin`].
    pub(super) fn begin(
        contact: &'a mut SurfaceContact,
        start: SurfaceStart<'_>,
    ) -> Result<OpenStep<'a>, Error> {
        let SurfaceStart { positions, bodies, seam_gaps, growth_increment } = start;
        contact.check_free("positions", positions)?;
        check_bodies(bodies, contact.obstacles.start.len())?;
        if let Some(gaps) = seam_gaps {
            check_length("gaps of seams", gaps.len(), contact.surface.free_count())?;
        }

        if let Some(gaps) = seam_gaps {
            contact.set_seam_gaps(gaps);
        }
        grow_distances(contact, positions, growth_increment);

        contact.is_open = true;
        contact.obstacles.begin(bodies);
        contact.friction.clear();
        contact.update_pinch(positions);
        contact.update(positions);
        for ActivePair { pair, gap } in contact.active.iter() {
            let [a, b] = [pair.vertices[0], pair.vertices[3]];
            let groups = [a, b].map(|vertex| contact.surface.primitives().group(vertex));
            let active = ActiveGap { pair, gap };
            contact.friction.open_pair(
                active,
                groups,
                &contact.active.positions,
                contact.stiffness,
            );
        }
        Ok(OpenStep { contact })
    }

    /// Returns the step of `contact` that is open.
    ///
    /// # Errors
    /// [`Error::NoOpenStep`].
    pub(super) fn resume(contact: &'a mut SurfaceContact) -> Result<OpenStep<'a>, Error> {
        if contact.is_open { Ok(OpenStep { contact }) } else { Err(Error::NoOpenStep) }
    }

    /// Sets the obstacle time to `time`: the fraction of the bodies' motion in this step, 0 to 1.
    /// The step begins at 0. The other methods refer to the time that was set last, except for
    /// [`limit`](OpenStep::limit), whose trial has its own. A solver that evaluates only at the end
    /// of a step sets 1.
    pub fn set_obstacle_time(&mut self, time: f64) {
        self.contact.obstacles.time = time;
    }

    /// Returns the [`SurfaceEnergy`] at the `positions` of the free vertices, in m, and at the
    /// present obstacle time. See [`SurfaceContact::energy`].
    ///
    /// # Errors
    /// There are not three coordinates for each free vertex.
    pub fn energy(&mut self, positions: &[f64]) -> Result<SurfaceEnergy<'_>, Error> {
        SurfaceEnergy::new(self.contact, positions)
    }

    /// Returns the work of the bodies in this step, in J: their forces at `positions` and the
    /// present obstacle time, times their displacements.
    ///
    /// # Errors
    /// There are not three coordinates for each free vertex.
    pub fn body_work(&mut self, positions: &[f64]) -> Result<f64, Error> {
        self.contact.check_free("positions", positions)?;
        if !self.contact.obstacles.moves() {
            return Ok(0.0);
        }
        self.contact.update(positions);
        let free = 3 * self.contact.surface.free_count();
        let SurfaceContact { stiffness, obstacles, active, friction, .. } = &mut *self.contact;
        let Obstacles { start, end, .. } = &*obstacles;
        let mut work = 0.0;
        for_each_gradient(*stiffness, active, friction, |vertices, gradient| {
            for (corner, &vertex) in vertices.iter().enumerate() {
                if let Some(first) = (3 * vertex as usize).checked_sub(free) {
                    for axis in 0..3 {
                        let displacement = end[first + axis] - start[first + axis];
                        work += gradient[3 * corner + axis] * displacement;
                    }
                }
            }
        });
        Ok(work)
    }

    /// Returns the energy that the growth of distances in this step added to the contact, in J. See
    /// [`SurfaceStart::growth_increment`].
    #[must_use]
    pub fn growth_work(&self) -> f64 {
        self.contact.growth.work
    }

    /// Limits `trial` such that every pair stays above its minimum separation. Returns whether the
    /// trial step is still whole.
    ///
    /// All displacements are shortened by a common fraction. Where this would leave little of the
    /// step, they are shortened vertex by vertex. Bodies and held vertices move by a common
    /// fraction. Where positions or displacements are not finite, nothing moves.
    ///
    /// # Errors
    /// A list of `trial` has the wrong length, or a held vertex is not a free vertex.
    pub fn limit(&mut self, trial: SurfaceTrial<'_>) -> Result<bool, Error> {
        let SurfaceTrial { start, displacements, held, obstacle_time, obstacle_advance } = trial;
        self.contact.check_free("positions", start)?;
        self.contact.check_free("displacements", displacements)?;
        for &vertex in held {
            check_index("free vertex", vertex, self.contact.surface.free_count())?;
        }

        let SurfaceContact { surface, obstacles, limiter, tracked, active, .. } =
            &mut *self.contact;
        obstacles.place(start, obstacle_time, &mut limiter.positions);
        limiter.displacements.clear();
        limiter.displacements.extend_from_slice(displacements);
        // Bodies at rest have no displacements, unless the pairs were detected while they moved.
        if obstacles.moves() || tracked.pairs().have_moving_bodies() {
            let Obstacles { start, end, .. } = &*obstacles;
            let bodies =
                start.iter().zip(end).map(|(start, end)| *obstacle_advance * (end - start));
            limiter.displacements.extend(bodies);
        }

        let is_whole = match limiter.limit(surface, tracked, held) {
            Ok(None) => true,
            Ok(Some(fraction)) => {
                displacements.copy_from_slice(&limiter.displacements[..displacements.len()]);
                *obstacle_advance *= fraction;
                false
            }
            Err(failure) => {
                // Without a detection no motion is known to be safe.
                active.failure = Some(failure);
                displacements.fill(0.0);
                *obstacle_advance = 0.0;
                false
            }
        };
        Ok(is_whole)
    }

    /// Returns every [`Intersection`] at the `positions` of the free vertices, in m, and at the
    /// present obstacle time. See [`SurfaceContact::intersections`].
    ///
    /// # Errors
    /// Positions are not finite.
    pub fn intersections(&mut self, positions: &[f64]) -> Result<&[Intersection], Error> {
        self.contact.intersections(positions)
    }

    /// Commits the step at the `positions` of the free vertices, in m. Slip of friction becomes
    /// permanent, and bodies are at the end of their motion.
    ///
    /// # Errors
    /// There are not three coordinates for each free vertex, or a coordinate is not finite. Then
    /// the step stays open.
    pub fn commit(self, positions: &[f64]) -> Result<(), Error> {
        let contact = self.contact;
        contact.check_free("positions", positions)?;
        if positions.iter().any(|coordinate| !coordinate.is_finite()) {
            check_positions("vertex", positions)?;
        }
        contact.obstacles.time = 1.0;
        contact.update(positions);
        contact.friction.commit(&contact.active.positions);
        contact.obstacles.commit();
        contact.pinch.committed.clone_from(&contact.surface.separations.pinch);
        contact.growth.fraction = contact.surface.separations.growth_fraction;
        contact.is_open = false;
        Ok(())
    }

    /// Rejects the step: bodies, pinched vertices and distances are as they were before the step.
    /// Open seams keep their gaps, which only become narrower.
    pub fn reject(self) {
        self.contact.reject();
    }
}

/// Increases the kept fraction of distances of `contact` by up to `increment`, before a step from
/// the positions `start` of the free vertices is opened, in m.
fn grow_distances(contact: &mut SurfaceContact, start: &[f64], increment: f64) {
    contact.growth.work = 0.0;
    if contact.growth.fraction >= 1.0 {
        return;
    }
    contact.obstacles.time = 0.0;

    // Pinch states and distances of a rejected step must not affect this step.
    contact.set_committed_pinch();
    contact.set_growth_fraction(contact.growth.fraction);
    if increment == 0.0 {
        return;
    }
    contact.update(start);
    let before = contact.active.energy(contact.stiffness);

    let wanted = contact.growth.increased(increment);
    contact.set_growth_fraction(wanted);
    contact.update(start);
    let min_ratio = SurfacePairs::new(&contact.active).summary().min_ratio;
    if let Some(limited) = contact.growth.limited(wanted, min_ratio) {
        contact.set_growth_fraction(limited);
        contact.update(start);
    }
    contact.growth.work = contact.active.energy(contact.stiffness) - before;
}
