//! Contact of a surface with itself and with bodies, as one object for a solver.

use super::active_pairs::ActivePairs;
use super::growth::Growth;
use super::obstacles::{Obstacles, check_bodies};
use super::open_seams::OpenSeams;
use super::pairs::SurfacePairs;
use super::pinch::{Pinch, vertices_of};
use super::settings::{PinchPolicy, SurfaceSettings};
use crate::error::{Error, check_length, check_positions};
use crate::surface::contact_surface::Surface;
use crate::surface::exact::{Intersection, IntersectionTest};
use crate::surface::friction::SurfaceFriction;
use crate::surface::geometry::PinchState;
use crate::surface::placement::Placement;
use crate::surface::step_filter::StepLimiter;
use crate::surface::tracked_pairs::TrackedPairs;

/// Contact of a surface with itself and with bodies: barrier and friction, their forces and
/// stiffness, and the step filter.
///
/// The caller moves the free vertices. The vertices of bodies follow the free ones in the
/// numbering. In a step the bodies move straight from their positions when the last step was
/// committed to the positions in [`SurfaceStart::bodies`].
///
/// [`begin`](SurfaceContact::begin) opens a step and returns an [`OpenStep`]. While the step is
/// open, [`step`](SurfaceContact::step) returns the [`OpenStep`] too. [`OpenStep::commit`] and
/// [`OpenStep::reject`] end the step. [`setup`](SurfaceContact::setup) has what may change between
/// two steps only, and is refused while a step is open.
///
/// Pairs, energies and intersections can be asked for at any time. Between two steps the bodies are
/// at rest. In an open step the bodies are at the obstacle time of the step.
///
/// After the first steps, memory is allocated only by [`setup`](SurfaceContact::setup), by the
/// memories of [`state`](SurfaceContact::state) and by [`inspect`](SurfaceContact::inspect).
///
/// # Examples
///
/// A sheet of one triangle falls on a box. An explicit solver takes steps of 1 ms.
///
/// ```
/// use drape_collide::{Body, ContactDistances, Pose, Shape, Surface, SurfaceContact};
/// use drape_collide::{SurfaceParts, SurfaceSettings, SurfaceStart, SurfaceTrial};
///
/// // A box of 0.2 m whose top is at y = 0, and a sheet of three vertices 20 mm above.
/// let shape = Shape::Box { half_extents: [0.1; 3], edge_radius: 0.0 };
/// let table = Body::new("box", shape, Pose::new([0.0, -0.1, 0.0])).triangulate()?;
/// let bodies = table.vertices.concat();
/// let mut positions = vec![-0.05, 0.02, 0.0, 0.0, 0.02, 0.04, 0.05, 0.02, 0.0];
/// let corners = table.triangles.iter().map(|corners| corners.map(|corner| corner + 3));
/// let surface = Surface::new(SurfaceParts {
///     rest_positions: [&positions[..], &bodies].concat(),
///     triangles: [[0, 1, 2]].into_iter().chain(corners).collect(),
///     areas: vec![1e-3; 3 + table.vertices.len()],
///     groups: [vec![0; 3], vec![1; table.vertices.len()]].concat(),
///     distances: vec![ContactDistances { activation_distance: 3e-4, min_separation: 1e-4 }; 2],
///     free_vertices: 3,
///     ..SurfaceParts::default()
/// })?;
/// let settings = SurfaceSettings::new(1e5, vec![0.3; 4]);
/// let mut contact = SurfaceContact::new(surface, settings, bodies.clone())?;
///
/// let (mass, dt) = (1e-3, 1e-3);
/// let mut velocities = [0.0; 9];
/// for _ in 0..400 {
///     let mut step = contact.begin(SurfaceStart::new(&positions, &bodies))?;
///
///     // Energy: forces of contact, and weight.
///     let mut forces = [0.0, -9.81 * mass, 0.0].repeat(3);
///     step.energy(&positions)?.add_forces(&mut forces)?;
///     let mut displacements: Vec<f64> =
///         (0..9).map(|k| dt * (0.9 * velocities[k] + dt * forces[k] / mass)).collect();
///
///     // Limit: no surface comes nearer to another than its minimum separation.
///     step.limit(SurfaceTrial {
///         start: &positions,
///         displacements: &mut displacements,
///         held: &[],
///         obstacle_time: 0.0,
///         obstacle_advance: &mut 1.0,
///     })?;
///     let end: Vec<f64> = positions.iter().zip(&displacements).map(|(x, dx)| x + dx).collect();
///
///     // Test, exactly, before the step is committed.
///     assert!(step.intersections(&end)?.is_empty());
///     step.commit(&end)?;
///     (0..9).for_each(|k| velocities[k] = displacements[k] / dt);
///     positions = end;
/// }
///
/// // The sheet rests on the box, between the minimum separation and the activation distance.
/// let summary = contact.detect(&positions)?.summary();
/// assert!(summary.touching > 0 && (2e-4..6e-4).contains(&summary.min_distance));
/// # Ok::<(), drape_collide::Error>(())
/// ```
///
/// [`OpenStep`]: super::OpenStep
/// [`OpenStep::commit`]: super::OpenStep::commit
/// [`OpenStep::reject`]: super::OpenStep::reject
/// [`SurfaceStart::bodies`]: super::SurfaceStart::bodies
#[derive(Debug)]
pub struct SurfaceContact {
    pub(super) surface: Surface,
    /// Stiffness per area, in N/m³.
    pub(super) stiffness: f64,
    pub(super) obstacles: Obstacles,
    pub(super) tracked: TrackedPairs,
    pub(super) active: ActivePairs,
    pub(super) friction: SurfaceFriction,
    pub(super) limiter: StepLimiter,
    intersection_test: IntersectionTest,
    pub(super) pinch: Pinch,
    pub(super) growth: Growth,
    pub(super) open_seams: OpenSeams,
    /// Whether a step is open.
    pub(super) is_open: bool,
    /// Positions of all vertices for the evaluation in progress, in m.
    trial: Placement,
}

impl SurfaceContact {
    /// Returns the contact of `surface` with its bodies at the flat positions `bodies`, in m.
    /// `bodies` is empty for a surface without bodies.
    ///
    /// # Errors
    /// A setting is out of range; or `bodies` has the wrong number of vertices, or a coordinate
    /// that is not finite or beyond 1000 km.
    pub fn new(
        surface: Surface,
        settings: SurfaceSettings,
        bodies: Vec<f64>,
    ) -> Result<SurfaceContact, Error> {
        let group_count = surface.group_distances().len();
        settings.check(group_count)?;
        check_bodies(&bodies, 3 * (surface.vertex_count() - surface.free_count()))?;
        check_positions("vertex of a body", &bodies)?;
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
            is_open: false,
            trial: Placement::default(),
        })
    }

    /// Checks that `list` has three numbers of `what` for each free vertex.
    pub(super) fn check_free(&self, what: &'static str, list: &[f64]) -> Result<(), Error> {
        check_length(what, list.len(), 3 * self.surface.free_count())
    }

    /// Returns the [`Surface`] of cloth and bodies.
    #[must_use]
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Returns every [`Intersection`] of the surface with itself and with bodies, at the
    /// `positions` of the free vertices, in m. The test is exact. Cloth through which a body passes
    /// is exempt.
    ///
    /// # Errors
    /// Positions are not finite, or there are not three for each free vertex.
    pub fn intersections(&mut self, positions: &[f64]) -> Result<&[Intersection], Error> {
        self.check_free("positions", positions)?;
        self.obstacles.place(positions, self.obstacles.time, &mut self.trial);
        self.intersection_test.run_placed(&self.surface, &self.trial)?;
        let surface = &self.surface;
        self.intersection_test
            .intersections
            .retain(|each| surface.pinch_fraction(&vertices_of(surface, *each)).is_some());
        Ok(&self.intersection_test.intersections)
    }

    /// Detects the active pairs at the `positions` of the free vertices, in m.
    ///
    /// # Errors
    /// Positions are not finite, or there are too many pairs.
    pub(super) fn detect_pairs(&mut self, positions: &[f64]) -> Result<SurfacePairs<'_>, Error> {
        self.check_free("positions", positions)?;
        self.update(positions);
        match &self.active.failure {
            Some(failure) => Err(failure.clone()),
            None => Ok(SurfacePairs::new(&self.active)),
        }
    }

    /// Rejects the open step: bodies, pinch states and distances are as they were before it.
    pub(super) fn reject(&mut self) {
        self.set_committed_pinch();
        self.set_growth_fraction(self.growth.fraction);
        self.obstacles.reject();
        self.is_open = false;
    }

    /// Finds the vertices that bodies pinch in the open step from the positions `start`.
    pub(super) fn update_pinch(&mut self, start: &[f64]) {
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

    /// Sets the pinch states of the next detection to the states of the last commit.
    pub(super) fn set_committed_pinch(&mut self) {
        self.with_states(|contact, committed, _| contact.set_pinch(committed));
    }

    /// Sets the pinch states of the next detection to `states`.
    pub(super) fn set_pinch(&mut self, states: &[PinchState]) {
        let all_free = states.iter().all(|state| *state == PinchState::Free);
        let states = if all_free { &[] } else { states };
        let current = &mut self.surface.separations.pinch;
        if current.as_slice() != states {
            current.clear();
            current.extend_from_slice(states);
            self.drop_pairs();
        }
    }

    /// Sets the gaps of the open seams at the free vertices to `gaps`, in m. Gaps only become
    /// narrower. Nothing happens once the seams are closed.
    pub(super) fn set_seam_gaps(&mut self, gaps: &[f64]) {
        let gaps = self.open_seams.gaps_of_classes(&self.surface, gaps);
        if gaps != self.surface.separations.seam_gaps {
            gaps.clone_into(&mut self.surface.separations.seam_gaps);
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
    pub(super) fn update(&mut self, positions: &[f64]) {
        self.obstacles.place(positions, self.obstacles.time, &mut self.trial);
        self.active.update(&self.surface, &mut self.tracked, &mut self.trial);
    }
}
