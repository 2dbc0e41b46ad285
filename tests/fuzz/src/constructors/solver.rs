//! The implicit solver with a system whose lists, masses and blocks are of any kind.

use drape::implicit::{
    BlockMatrix, ErrorEstimate, Explicit, Integrator, IntegratorState, LinearSolver, MaterialPoint,
    Method, PreviousState, Settings, Sparsity, Stepper, Stiffness, System, check_system,
};

use crate::shapes::Source;

/// System of springs to the origin, with lists of any length.
struct Springs {
    particles: usize,
    masses: Vec<f64>,
    held: Vec<bool>,
    stiffness: f64,
    sparsity: Sparsity,
    points: Vec<MaterialPoint>,
    block: [u32; 2],
}

impl System for Springs {
    fn particle_count(&self) -> usize {
        self.particles
    }

    fn masses(&self) -> &[f64] {
        &self.masses
    }

    fn held(&self) -> &[bool] {
        &self.held
    }

    fn begin(&mut self, _end: f64, _dt: f64, _start: &[f64], _target: &mut [f64]) {}

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        for (force, place) in forces.iter_mut().zip(positions) {
            *force = -self.stiffness * place;
        }
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        0.5 * self.stiffness * positions.iter().map(|x| x * x).sum::<f64>()
    }

    fn stiffness(&mut self, _positions: &[f64], _kind: Stiffness, matrix: &mut BlockMatrix) {
        let [row, column] = self.block.map(|particle| particle as usize);
        let k = self.stiffness;
        matrix.add(row, column, &[k, 0.0, 0.0, 0.0, k, 0.0, 0.0, 0.0, k]);
        matrix.add_block(column, &[k, 0.0, 0.0, 0.0, k, 0.0, 0.0, 0.0, k]);
        matrix.add_coupling(row, column, &[0.0; 9]);
    }

    fn sparsity(&self) -> Sparsity {
        self.sparsity.clone()
    }

    fn material_points(&self) -> Vec<MaterialPoint> {
        self.points.clone()
    }

    fn accept(&mut self, _positions: &[f64], _velocities: &[f64], _dt: f64) {}
}

fn system(source: &mut Source<'_>) -> Option<Springs> {
    let particles = source.below(4) as usize;
    let pairs: Vec<[usize; 2]> =
        (0..source.below(3)).map(|_| [0; 2].map(|_| source.number(particles) as usize)).collect();
    let points = if source.below(3) == 0 {
        let point = |source: &mut Source<'_>| MaterialPoint {
            sheet: source.whole() as u32,
            coordinates: [source.odd(), source.odd()],
            spacing: source.odd(),
        };
        (0..source.length(particles)).map(|_| point(source)).collect()
    } else {
        Vec::new()
    };
    let columns = source.length(particles);
    Some(Springs {
        masses: (0..source.length(particles)).map(|_| source.mostly_positive(12)).collect(),
        held: (0..source.length(particles)).map(|_| source.below(4) == 0).collect(),
        stiffness: source.odd(),
        sparsity: Sparsity::from_pairs(columns, pairs).ok()?,
        block: [source.number(particles), source.number(particles)],
        particles,
        points,
    })
}

fn state(source: &mut Source<'_>, particles: usize) -> IntegratorState {
    let mut state =
        IntegratorState::new(source.odd_list(3 * particles), source.odd_list(3 * particles));
    state.time = source.odd();
    if source.below(3) == 0 {
        state.previous = Some(PreviousState {
            dt: source.odd(),
            positions: source.odd_list(3 * particles),
            velocities: source.odd_list(3 * particles),
        });
    }
    state
}

pub fn step(source: &mut Source<'_>) {
    let Some(mut system) = system(source) else { return };
    let particles = system.particles;
    let integrators = [Integrator::BackwardEuler, Integrator::Bdf2];
    let mut settings = Settings {
        integrator: integrators[source.below(2) as usize],
        method: [Method::Newton, Method::Broyden][source.below(2) as usize],
        linear_solver: [LinearSolver::Cholesky, LinearSolver::ConjugateGradient]
            [source.below(2) as usize],
        ..Settings::default()
    };
    if source.below(3) == 0 {
        settings.tolerance = source.odd();
        settings.max_iterations = source.below(20) as usize;
    }
    let dt = source.mostly_positive(6);
    let mut at = state(source, particles);
    let mut estimate = ErrorEstimate::new(source.length(particles));
    let _ = estimate.predict(&at, settings.integrator, dt);
    if let Ok(mut stepper) = Stepper::new(&system, settings) {
        let _ = stepper.advance(&mut system, &mut at, dt);
    }
    let _ = estimate.estimate(&at);

    // A motion with few sub-steps.
    system.stiffness = system.stiffness.clamp(-1e3, 1e3);
    let mut at = state(source, particles);
    if let Ok(mut explicit) = Explicit::new(&system).with_fraction(source.mostly_positive(4)) {
        let stable = explicit.stable_step(&mut system, &at, 1e-3);
        if stable.is_ok_and(|stable| stable > 1e-5) {
            let _ = explicit.advance(&mut system, &mut at, 1e-3);
        }
    }
    let (start, trial) = (source.odd_list(3 * particles), source.odd_list(3 * particles));
    let _ = check_system(&mut system, &start, &trial, dt);
}

pub fn matrix(source: &mut Source<'_>) {
    let particles = source.below(4) as usize;
    let offsets = (0..source.below(6)).map(|_| source.below(8) as usize).collect();
    let columns = (0..source.below(8)).map(|_| source.number(particles)).collect();
    let rows: Vec<Vec<usize>> = (0..source.below(4))
        .map(|row| std::iter::once(row as usize).chain([source.number(4) as usize]).collect())
        .collect();
    let sparsity = match source.below(2) {
        0 => Sparsity::new(offsets, columns),
        _ => Sparsity::from_rows(rows.iter().map(Vec::as_slice)),
    };
    let Ok(sparsity) = sparsity else { return };
    let count = sparsity.particle_count();
    let _ = sparsity.row(source.number(count) as usize);
    let _ = sparsity.slot(source.number(count) as usize, source.number(count) as usize);
    let mut matrix = BlockMatrix::zeros(sparsity);
    matrix.add_block(source.number(count) as usize, &[source.odd(); 9]);
    matrix.add(source.number(count) as usize, source.number(count) as usize, &[1.0; 9]);
    matrix.add_coupling(source.number(count) as usize, source.number(count) as usize, &[1.0; 9]);
    let (x, mut y) = (source.odd_list(3 * count), source.odd_list(3 * count));
    let _ = matrix.multiply(&x, &mut y);
}
