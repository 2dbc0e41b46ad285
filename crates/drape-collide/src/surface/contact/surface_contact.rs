//! Contact of a surface with itself and with bodies, as one object for a solver.

use super::active_pairs::{ActivePair, ActivePairs};
use super::growth::Growth;
use super::obstacles::{Obstacles, check_bodies};
use super::open_seams::OpenSeams;
use super::pinch::{Pinch, PinchedVertices, vertices_of};
use super::saved::{SavedContact, SurfaceMemory};
use super::settings::{PinchPolicy, SurfaceSettings};
use super::summary::{PairDistance, SurfaceSummary};
use crate::error::Error;
use crate::surface::barrier::Gradient;
use crate::surface::contact_surface::Surface;
use crate::surface::exact::{Intersection, IntersectionTest, encloses, intersections};
use crate::surface::friction::{ActiveGap, FrictionEnergy, SurfaceFriction};
use crate::surface::geometry::PinchState;
use crate::surface::placement::Placement;
use crate::surface::step_filter::{StepLimiter, SurfaceStep};
use crate::surface::tracked_pairs::TrackedPairs;
use crate::vector::{Matrix, at, outer};

/// Contact of a surface with itself and with bodies: barrier and friction, their forces and
/// stiffness, and the step filter.
///
/// The caller moves the free vertices. The vertices of bodies follow the free ones in the
/// numbering, and move straight from their positions at the start of a step to their positions at
/// its end, which [`begin`](SurfaceContact::begin) takes.
///
/// After the first steps, memory is allocated only by [`memory`](SurfaceContact::memory),
/// [`intersections_with_released`](SurfaceContact::intersections_with_released) and
/// [`is_inside_body`](SurfaceContact::is_inside_body).
#[derive(Debug)]
pub struct SurfaceContact {
    pub(super) surface: Surface,
    stiffness: f64,
    pub(super) obstacles: Obstacles,
    tracked: TrackedPairs,
    pub(super) active: ActivePairs,
    friction: SurfaceFriction,
    pub(super) limiter: StepLimiter,
    intersection_test: IntersectionTest,
    pinch: Pinch,
    pub(super) growth: Growth,
    pub(super) open_seams: OpenSeams,
    /// Positions of all vertices for the evaluation in progress, in m.
    trial: Placement,
}

impl SurfaceContact {
    /// Returns the contact of `surface` with its bodies at the flat positions `bodies`, in m.
    ///
    /// # Errors
    /// A setting is out of range, or `bodies` has the wrong number of vertices.
    pub fn new(
        surface: Surface,
        settings: SurfaceSettings,
        bodies: Vec<f64>,
    ) -> Result<SurfaceContact, Error> {
        let group_count = surface.group_distances().len();
        settings.check(group_count)?;
        check_bodies(&bodies, 3 * (surface.vertex_count() - surface.free_count()))?;
        let distances = surface.group_distances().iter();
        let activation_distance =
            distances.map(|group| group.activation_distance).fold(0.0, f64::max);
        let edge = surface.median_edge_length();

        let SurfaceSettings { stiffness, sticking_displacement, friction_coefficients, pinch } =
            settings;
        Ok(SurfaceContact {
            surface,
            stiffness,
            obstacles: Obstacles::new(bodies),
            tracked: TrackedPairs::new(activation_distance, edge),
            active: ActivePairs::default(),
            friction: SurfaceFriction::new(
                friction_coefficients,
                group_count,
                sticking_displacement,
            ),
            limiter: StepLimiter::new(activation_distance, edge),
            intersection_test: IntersectionTest::default(),
            pinch: Pinch::new(pinch),
            growth: Growth::NONE,
            open_seams: OpenSeams::default(),
            trial: Placement::default(),
        })
    }

    /// Returns the [`Surface`] of cloth and bodies.
    #[must_use]
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Returns the positions of the bodies' vertices when the last step was committed, in m, flat.
    #[must_use]
    pub fn body_positions(&self) -> &[f64] {
        &self.obstacles.start
    }

    /// Returns the [`Error`] of the last detection, if it failed. Forces are then NaN.
    #[must_use]
    pub fn failure(&self) -> Option<&Error> {
        self.active.failure.as_ref()
    }

    /// Opens a step from the positions `start` of the free vertices, in m, in which the bodies move
    /// to the positions `bodies`.
    ///
    /// The bodies return to their positions when the last step was committed. Friction takes its
    /// normal forces and tangent planes from there.
    ///
    /// # Panics
    /// `bodies` has the wrong number of coordinates.
    pub fn begin(&mut self, start: &[f64], bodies: &[f64]) {
        self.obstacles.begin(bodies);
        self.friction.clear();
        self.update_pinch(start);
        self.update(start);
        for ActivePair { pair, gap } in self.active.iter() {
            let [a, b] = [pair.vertices[0], pair.vertices[3]];
            let groups = [a, b].map(|vertex| self.surface.group(vertex));
            let active = ActiveGap { pair, gap };
            self.friction.open_pair(active, groups, &self.active.positions, self.stiffness);
        }
    }

    /// Sets the obstacle time to `time`: the fraction of the bodies' motion in the open step, 0 to
    /// 1.
    pub fn set_obstacle_time(&mut self, time: f64) {
        self.obstacles.time = time;
    }

    /// Commits the step at the `positions` of the free vertices, in m. Slip of friction becomes
    /// permanent.
    pub fn commit(&mut self, positions: &[f64]) {
        self.obstacles.time = 1.0;
        self.update(positions);
        self.friction.commit(&self.active.positions);
        self.obstacles.commit();
        self.pinch.committed.clone_from(&self.surface.separations.pinch);
        self.growth.fraction = self.surface.separations.growth_fraction;
    }

    /// Returns the state between two steps as a [`SurfaceMemory`].
    #[must_use]
    pub fn memory(&self) -> SurfaceMemory {
        let mut memory = SurfaceMemory::default();
        self.save(&mut memory);
        memory
    }

    /// Writes the state between two steps to `memory`, whose lists are reused.
    pub fn save(&self, memory: &mut SurfaceMemory) {
        let SurfaceMemory { stretches, bodies, pinch, growth_fraction } = memory;
        stretches.clone_from(&self.friction.stretches);
        bodies.clone_from(&self.obstacles.start);
        pinch.clone_from(&self.pinch.committed);
        *growth_fraction = self.growth.fraction;
    }

    /// Restores the state `memory`, as if the steps since then had not been committed.
    pub fn restore(&mut self, memory: &SurfaceMemory) {
        let SurfaceMemory { stretches, bodies, pinch, growth_fraction } = memory;
        self.friction.stretches.clone_from(stretches);
        self.pinch.committed.clone_from(pinch);
        self.growth.fraction = *growth_fraction;
        self.set_pinch(pinch);
        self.set_growth_fraction(*growth_fraction);
        self.obstacles.restore(bodies);
    }

    /// Returns the whole state of the contact as a [`SavedContact`], for a file.
    #[must_use]
    pub fn saved(&self) -> SavedContact {
        SavedContact {
            memory: self.memory(),
            seam_gaps: self.surface.separations.seam_gaps.clone(),
            tracked: self.tracked.memory(),
        }
    }

    /// Restores the state `saved`, which was saved with the free vertices at `positions`, in m.
    /// From then on, every result is identical to the uninterrupted run's.
    ///
    /// # Errors
    /// `saved` belongs to another surface, or holds numbers that no contact produces.
    pub fn resume(&mut self, positions: &[f64], saved: &SavedContact) -> Result<(), Error> {
        let SavedContact { memory, seam_gaps, tracked } = saved;
        memory.check(self.surface.free_count(), self.obstacles.start.len())?;
        let (needed, found) = (3 * self.surface.free_count(), positions.len());
        if found != needed {
            return Err(Error::WrongLength { what: "positions", found, needed });
        }

        let vertices = self.surface.vertex_count();
        if !tracked.fits(3 * vertices) || !self.open_seams.may_have(seam_gaps) {
            return Err(Error::SavedContact);
        }

        // An evaluation at the positions reports errors before the saved pairs are restored.
        self.surface.separations.seam_gaps.clone_from(seam_gaps);
        self.restore(memory);
        self.active.invalidate();
        self.summary_at(positions)?;
        self.tracked.restore(&self.surface, tracked)
    }

    /// Adds the forces on the free vertices at `positions` to `forces`, in N. They are NaN if
    /// `positions` are not finite.
    pub fn add_forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        self.update(positions);
        if self.active.failure.is_some() {
            return forces.fill(f64::NAN);
        }
        let Self { stiffness, active, friction, .. } = self;
        for_each_gradient(*stiffness, active, friction, |vertices, gradient| {
            for (corner, &vertex) in vertices.iter().enumerate() {
                let first = 3 * vertex as usize;
                if first < forces.len() {
                    for axis in 0..3 {
                        forces[first + axis] -= gradient[3 * corner + axis];
                    }
                }
            }
        });
    }

    /// Returns the work of the bodies in the open step, in J: their forces at `positions` and the
    /// present obstacle time, times their displacements.
    pub fn body_work(&mut self, positions: &[f64]) -> f64 {
        if !self.obstacles.moves() {
            return 0.0;
        }
        self.update(positions);
        let free = 3 * self.surface.free_count();
        let Self { stiffness, obstacles, active, friction, .. } = self;
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
        work
    }

    /// Returns the energy of the contact at `positions` with the potential of friction, in J. It is
    /// infinite or NaN if `positions` are not finite.
    pub fn potential(&mut self, positions: &[f64]) -> f64 {
        self.update(positions);
        if self.active.failure.is_some() {
            return f64::NAN;
        }
        self.active.energy(self.stiffness) + self.friction_energy().potential
    }

    /// Returns the [`FrictionEnergy`] at the positions of the last evaluation: the potential of
    /// friction, and its part that is dissipated if the step ends there, in J.
    #[must_use]
    pub fn friction_energy(&self) -> FrictionEnergy {
        self.friction.energy(&self.active.positions, self.surface.free_count())
    }

    /// Calls `add` with two free vertices and the block of the potential's second derivative with
    /// respect to both, row by row, in N/m. Each two vertices of a pair come once, in either order,
    /// and each vertex comes with itself.
    ///
    /// The blocks are the Gauss–Newton part, without negative eigenvalues. With the exact second
    /// derivative a stack of sheets took no fewer iterations.
    pub fn add_stiffness(&mut self, positions: &[f64], add: &mut dyn FnMut([usize; 2], &[f64; 9])) {
        self.update(positions);
        let free = self.surface.free_count();
        // Barriers and friction both have one block per pair, times the weights of two vertices.
        let mut add_weighted = |vertices: [u32; 4], weights: [f64; 4], block: &Matrix| {
            for a in 0..4 {
                for b in a..4 {
                    let [i, j] = [vertices[a], vertices[b]].map(|vertex| vertex as usize);
                    let weight = weights[a] * weights[b];
                    if i < free && j < free && weight != 0.0 {
                        add([i, j], &block.map(|entry| weight * entry));
                    }
                }
            }
        };
        for ActivePair { pair, gap } in self.active.iter() {
            let curvature = gap.gauss_newton(self.stiffness).factor;
            let block = outer(gap.normal()).map(|entry| curvature * entry);
            add_weighted(pair.vertices, gap.weights(), &block);
        }
        self.friction.for_each_stiffness(&self.active.positions, add_weighted);
    }

    /// Limits the trial `step` such that every pair stays above its minimum separation. Returns
    /// whether the step is still whole.
    ///
    /// All displacements are shortened by a common fraction. Where this would leave little of the
    /// step, they are shortened vertex by vertex. Bodies and held vertices move by a common
    /// fraction.
    pub fn limit_step(&mut self, step: SurfaceStep<'_>) -> bool {
        let SurfaceStep { start, displacements, held, obstacle_time, obstacle_advance } = step;
        self.obstacles.place(start, obstacle_time, &mut self.limiter.positions);
        self.limiter.displacements.clear();
        self.limiter.displacements.extend_from_slice(displacements);
        // Bodies at rest have no displacements, unless the pairs were detected while they moved.
        if self.obstacles.moves() || self.tracked.pairs().have_moving_bodies() {
            let Obstacles { start, end, .. } = &self.obstacles;
            let bodies =
                start.iter().zip(end).map(|(start, end)| *obstacle_advance * (end - start));
            self.limiter.displacements.extend(bodies);
        }

        match self.limiter.limit(&self.surface, &mut self.tracked, held) {
            Ok(None) => true,
            Ok(Some(fraction)) => {
                let limited = &self.limiter.displacements;
                displacements.copy_from_slice(&limited[..displacements.len()]);
                *obstacle_advance *= fraction;
                false
            }
            Err(failure) => {
                // Without a detection no motion is known to be safe.
                self.active.failure = Some(failure);
                displacements.fill(0.0);
                *obstacle_advance = 0.0;
                false
            }
        }
    }

    /// Returns every [`Intersection`] of the surface with itself and with bodies in the open step,
    /// at the `positions` of the free vertices, in m. The test is exact. Cloth through which a body
    /// passes is exempt.
    ///
    /// # Errors
    /// Positions are not finite.
    pub fn intersections(&mut self, positions: &[f64]) -> Result<&[Intersection], Error> {
        self.obstacles.place(positions, self.obstacles.time, &mut self.trial);
        self.intersection_test.run_placed(&self.surface, &self.trial)?;
        let surface = &self.surface;
        self.intersection_test
            .intersections
            .retain(|each| surface.pinch_fraction(&vertices_of(surface, *each)).is_some());
        Ok(&self.intersection_test.intersections)
    }

    /// Like [`intersections`](SurfaceContact::intersections), but includes cloth that
    /// [`PinchPolicy::Release`] exempts.
    ///
    /// # Errors
    /// Positions are not finite.
    pub fn intersections_with_released(
        &self,
        positions: &[f64],
    ) -> Result<Vec<Intersection>, Error> {
        intersections(&self.surface, &self.placed(positions))
    }

    /// Returns the [`Placement`] of all vertices with the free vertices at `positions`, in m.
    pub(super) fn placed(&self, positions: &[f64]) -> Placement {
        let mut all = Placement::default();
        self.obstacles.place(positions, self.obstacles.time, &mut all);
        all
    }

    /// Returns whether the free `vertex` is inside a body, with the free vertices at `positions`,
    /// in m.
    #[must_use]
    pub fn is_inside_body(&self, vertex: usize, positions: &[f64]) -> bool {
        let all = self.placed(positions);
        let bodies = self.surface.free_count()..self.surface.vertex_count();
        let mut groups: Vec<u32> = bodies.map(|v| self.surface.group(v as u32)).collect();
        groups.dedup();
        groups.iter().any(|&group| encloses(&self.surface, group, at(&all, vertex), &all))
    }

    /// Returns the [`SurfaceSummary`] of active pairs at the `positions` of the free vertices, in
    /// m.
    ///
    /// # Errors
    /// Positions are not finite, or there are too many pairs.
    pub fn summary_at(&mut self, positions: &[f64]) -> Result<SurfaceSummary, Error> {
        self.update(positions);
        self.active.failure.clone().map_or_else(|| Ok(self.summary()), Err)
    }

    /// Returns the [`SurfaceSummary`] of active pairs at the positions of the last evaluation.
    #[must_use]
    pub fn summary(&self) -> SurfaceSummary {
        SurfaceSummary::new(self.active.iter())
    }

    /// Returns the active pair with the smallest ratio of distance to minimum separation at the
    /// positions of the last evaluation, as a [`PairDistance`].
    #[must_use]
    pub fn closest_pair(&self) -> Option<PairDistance<'_>> {
        let pairs = self.active.iter().map(PairDistance::new);
        pairs.min_by(|a, b| a.ratio().total_cmp(&b.ratio()))
    }

    /// Returns a [`PairDistance`] for each pair below its minimum separation at the positions of
    /// the last evaluation.
    pub fn pairs_below_min_separation(&self) -> impl Iterator<Item = PairDistance<'_>> {
        let pairs = self.active.iter().map(PairDistance::new);
        pairs.filter(|PairDistance { pair, distance }| !(*distance >= pair.min_separation))
    }

    /// Returns the fraction of activation distances and minimum separations that surfaces keep
    /// since the last step, 0 to 1. See [`grow_distances`](SurfaceContact::grow_distances).
    #[must_use]
    pub fn growth_fraction(&self) -> f64 {
        self.growth.fraction
    }

    /// Returns the energy that the last growth of distances added to the contact, in J.
    #[must_use]
    pub fn growth_work(&self) -> f64 {
        self.growth.work
    }

    /// Shrinks all distances until no pair is active at the `positions` of the free vertices, in m.
    ///
    /// The fraction of the distances that is kept becomes the smallest ratio of a pair's distance
    /// to its activation distance, or stays if no pair is active.
    ///
    /// # Errors
    /// Positions are not finite, or there are too many pairs.
    pub fn shrink_distances(&mut self, positions: &[f64]) -> Result<(), Error> {
        self.summary_at(positions)?;
        self.growth.fraction = self
            .active
            .iter()
            .map(|active| active.gap.distance() / active.pair.activation_distance)
            .fold(self.growth.fraction, f64::min);
        self.set_growth_fraction(self.growth.fraction);
        Ok(())
    }

    /// Increases the kept fraction of distances by up to `increment`, before a step from the
    /// positions `start` of the free vertices is opened, in m. The increase is as large as the
    /// nearest pair has room for. The fraction never falls below the fraction of the last step.
    pub fn grow_distances(&mut self, start: &[f64], increment: f64) {
        self.growth.work = 0.0;
        if self.growth.fraction >= 1.0 {
            return;
        }
        self.obstacles.time = 0.0;

        // Pinch states of a rejected step must not affect this step.
        self.with_states(|contact, committed, _| contact.set_pinch(committed));
        self.set_growth_fraction(self.growth.fraction);
        self.update(start);
        let before = self.active.energy(self.stiffness);

        let wanted = self.growth.increased(increment);
        self.set_growth_fraction(wanted);
        self.update(start);
        if let Some(limited) = self.growth.limited(wanted, self.summary().min_ratio) {
            self.set_growth_fraction(limited);
            self.update(start);
        }
        self.growth.work = self.active.energy(self.stiffness) - before;
    }

    /// Opens the seams at the `positions` of the free vertices, in m. `gaps` holds the gap at each
    /// free vertex, in m: 0 where its seam is one point, infinite without a seam.
    ///
    /// The two sides of an open seam are two cloths. They repel each other below half of the gap,
    /// and keep a tenth of the gap, or the usual distances where these are smaller.
    ///
    /// # Errors
    /// Positions are not finite, or there are too many pairs.
    ///
    /// # Panics
    /// There is not one gap for each free vertex.
    pub fn open_seams(&mut self, gaps: &[f64], positions: &[f64]) -> Result<(), Error> {
        assert_eq!(gaps.len(), self.surface.free_count(), "a gap for each free vertex");
        self.open_seams.open(&self.surface);
        self.set_seam_gaps(gaps);
        self.summary_at(positions)?;
        self.open_seams.limit(&self.surface, self.active.iter());
        self.set_seam_gaps(gaps);
        Ok(())
    }

    /// Sets the gaps of the open seams at the free vertices to `gaps`, in m, before a step is
    /// opened. Gaps only become narrower. Nothing happens once the seams are closed.
    pub fn set_seam_gaps(&mut self, gaps: &[f64]) {
        let gaps = self.open_seams.gaps_of_classes(&self.surface, gaps);
        if gaps != self.surface.separations.seam_gaps {
            gaps.clone_into(&mut self.surface.separations.seam_gaps);
            self.drop_pairs();
        }
    }

    /// Closes the seams: from now on, primitives with vertices that seams join or tie are exempt
    /// from contact with each other. The vertices must be at their sewn positions.
    pub fn close_seams(&mut self) {
        self.open_seams.close();
        self.set_seam_gaps(&[]);
    }

    /// Returns the fraction of its minimum separation from bodies that pinched cloth keeps:
    /// [`PinchPolicy::THINNED_FRACTION`] or 1.
    #[must_use]
    pub fn thinned_fraction(&self) -> f64 {
        if self.pinch.policy == PinchPolicy::Thin { PinchPolicy::THINNED_FRACTION } else { 1.0 }
    }

    /// Returns the numbers of free vertices that bodies pinch since the last step, as
    /// [`PinchedVertices`].
    #[must_use]
    pub fn pinched_vertices(&self) -> PinchedVertices {
        self.pinch.count()
    }

    /// Finds the vertices that bodies pinch in the open step from the positions `start`.
    fn update_pinch(&mut self, start: &[f64]) {
        if self.pinch.policy == PinchPolicy::Error {
            return;
        }
        // Faces on both sides of cloth are seen at the whole minimum separation.
        self.set_pinch(&[]);
        self.update(start);
        if self.active.failure.is_some() {
            return;
        }
        self.intersection_test.intersections.clear();
        if self.pinch.any_released() {
            // Positions that fail have no intersections. The detection reports their error.
            let _ = self.intersection_test.run_placed(&self.surface, &self.active.positions);
        }
        let intersections = &self.intersection_test.intersections;
        self.pinch.update(&self.surface, &self.obstacles, &self.active, intersections);
        self.with_states(|contact, _, next| contact.set_pinch(next));
        self.update(start);
    }

    /// Calls `apply` with the committed and the next pinch states, which are lent to it.
    fn with_states(&mut self, apply: impl FnOnce(&mut Self, &[PinchState], &[PinchState])) {
        let committed = std::mem::take(&mut self.pinch.committed);
        let next = std::mem::take(&mut self.pinch.next);
        apply(self, &committed, &next);
        (self.pinch.committed, self.pinch.next) = (committed, next);
    }

    /// Sets the pinch states of the next detection to `states`.
    fn set_pinch(&mut self, states: &[PinchState]) {
        let all_free = states.iter().all(|state| *state == PinchState::Free);
        let states = if all_free { &[] } else { states };
        let current = &mut self.surface.separations.pinch;
        if current.as_slice() != states {
            current.clear();
            current.extend_from_slice(states);
            self.drop_pairs();
        }
    }

    /// Sets the kept fraction of distances for all later detections to `fraction`.
    pub(super) fn set_growth_fraction(&mut self, fraction: f64) {
        if self.surface.separations.growth_fraction != fraction {
            self.surface.separations.growth_fraction = fraction;
            self.drop_pairs();
        }
    }

    /// Drops all pairs, because their distances have changed.
    pub(super) fn drop_pairs(&mut self) {
        self.active.invalidate();
        self.tracked.clear();
    }

    /// Finds the active pairs at the `positions` of the free vertices, in m.
    fn update(&mut self, positions: &[f64]) {
        self.obstacles.place(positions, self.obstacles.time, &mut self.trial);
        self.active.update(&self.surface, &mut self.tracked, &mut self.trial);
    }
}

/// Calls `visit` with the vertices and the gradient of each energy, in N: of barriers with
/// `stiffness`, in N/m³, then of friction.
fn for_each_gradient(
    stiffness: f64,
    active: &mut ActivePairs,
    friction: &SurfaceFriction,
    mut visit: impl FnMut(&[u32; 4], &Gradient),
) {
    active.for_each_gradient(stiffness, &mut visit);
    friction.for_each_gradient(&active.positions, &mut visit);
}
