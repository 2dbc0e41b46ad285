//! A sheet that falls on a box and comes to rest: contact of surfaces in the implicit solver.
use drape_collide::{Body, ContactDistances, OpenStep, Pose, Shape, Surface};
use drape_collide::{SurfaceContact, SurfaceParts, SurfaceSettings, SurfaceStart, SurfaceTrial};
use drape_implicit::{AllowedStep, BlockMatrix, IntegratorState, Settings, Sparsity, StepFilter};
use drape_implicit::{Stepper, Stiffness, System, TrialStep};

/// What the solver keeps, so that contact refuses no list.
const LISTS: &str = "the solver has three numbers for each vertex";

/// Contact of a triangle of three particles of 1 g with a box, and the positions of the box.
struct Sheet(SurfaceContact, Vec<f64>);

impl Sheet {
    fn step(&mut self) -> OpenStep<'_> {
        self.0.step().expect("the solver begins each step")
    }
}

#[rustfmt::skip]
impl System for Sheet {
    fn particle_count(&self) -> usize { 3 }
    fn masses(&self) -> &[f64] { &[1e-3; 3] }
    fn held(&self) -> &[bool] { &[false; 3] }
    fn begin(&mut self, _: f64, _: f64, x: &[f64], _: &mut [f64]) { self.0.begin(SurfaceStart::new(x, &self.1)).expect(LISTS); }
    fn forces(&mut self, x: &[f64], forces: &mut [f64]) {
        (0..9).for_each(|k| forces[k] = if k % 3 == 1 { -9.81e-3 } else { 0.0 });
        self.0.energy(x).and_then(|mut energy| energy.add_forces(forces)).expect(LISTS);
    }
    fn potential(&mut self, x: &[f64]) -> f64 { 9.81e-3 * (x[1] + x[4] + x[7]) + self.0.energy(x).expect(LISTS).potential() }
    fn stiffness(&mut self, x: &[f64], _: Stiffness, matrix: &mut BlockMatrix) {
        self.0.energy(x).expect(LISTS).add_stiffness(&mut |[i, j], block| matrix.add(i, j, block));
    }
    fn sparsity(&self) -> Sparsity { Sparsity::from_pairs(3, [[0, 1], [1, 2], [0, 2]]).expect("three") }
    fn accept(&mut self, x: &[f64], _: &[f64], _: f64) { self.step().commit(x).expect(LISTS); }
}
#[rustfmt::skip]
impl StepFilter for Sheet {
    fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep {
        let TrialStep { start, displacements, obstacle_time, obstacle_advance: mut advance } = step;
        let obstacle_advance = &mut advance;
        let trial = SurfaceTrial { start, displacements, held: &[], obstacle_time, obstacle_advance };
        if self.step().limit(trial).expect(LISTS) { return AllowedStep::Whole; }
        AllowedStep::Shortened { obstacle_advance: advance }
    }
    fn set_obstacle_time(&mut self, time: f64) { self.step().set_obstacle_time(time); }
    fn is_intersection_free(&mut self, x: &[f64]) -> bool { self.step().intersections(x).is_ok_and(|i| i.is_empty()) }
}
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let shape = Shape::Box { half_extents: [0.1; 3], edge_radius: 0.0 };
    let table = Body::new("box", shape, Pose::new([0.0, -0.1, 0.0])).triangulate()?;
    let bodies = table.vertices.concat();
    let sheet = vec![-0.05, 0.02, 0.0, 0.0, 0.03, 0.04, 0.05, 0.02, 0.0];
    let corners = table.triangles.iter().map(|corners| corners.map(|corner| corner + 3));
    let surface = Surface::new(SurfaceParts {
        rest_positions: [&sheet[..], &bodies].concat(),
        triangles: [[0, 1, 2]].into_iter().chain(corners).collect(),
        areas: vec![1e-3; 3 + table.vertices.len()],
        groups: [vec![0; 3], vec![1; table.vertices.len()]].concat(),
        distances: vec![ContactDistances { activation_distance: 3e-4, min_separation: 1e-4 }; 2],
        free_vertices: 3,
        ..SurfaceParts::default()
    })?;
    let settings = SurfaceSettings::new(1e8, vec![0.3; 4]);
    let mut system = Sheet(SurfaceContact::new(surface, settings, bodies.clone())?, bodies);
    let mut stepper = Stepper::new(&system, Settings::default())?;
    let mut state = IntegratorState::at_rest(sheet);
    (0..200).try_for_each(|_| stepper.advance_filtered(&mut system, &mut state, 5e-3).map(drop))?;
    let heights = [1, 4, 7].map(|k| state.positions[k]);
    assert!(heights.iter().all(|h| (2e-4..6e-4).contains(h)), "it rests on the box: {heights:?} m");
    Ok(())
}
