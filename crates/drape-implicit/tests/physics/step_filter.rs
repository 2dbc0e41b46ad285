//! A step filter: a particle over a floor that it must not pass, in trial steps neither.

use drape_implicit::{
    AllowedStep, BlockMatrix, Error, InitialMatrix, IntegratorState, Method, Settings, Sparsity,
    StepFilter, Stepper, Stiffness, Stop, System, TrialStep,
};

/// Height at which the floor begins to push, m.
const ACTIVATION_DISTANCE: f64 = 1e-3;
/// Stiffness of the floor, N/m.
const STIFFNESS: f64 = 1e8;

/// A particle of 1 kg above a floor that moves at a steady speed.
struct Floor {
    speed: f64,
    /// The floor at the start and at the end of the step, and now.
    ends: [f64; 2],
    now: f64,
    /// Least distance ever evaluated.
    nearest: f64,
    /// Largest advance of the floor in a trial step, as a part of its motion.
    advance_max: f64,
    /// Longest step whose solution is certified.
    certified: f64,
    /// Whether the floor tells its work.
    tells_work: bool,
    dt: f64,
    accepted: Vec<f64>,
}

impl Floor {
    fn new(speed: f64) -> Self {
        Self {
            speed,
            ends: [0.0; 2],
            now: 0.0,
            nearest: f64::INFINITY,
            advance_max: 1.0,
            certified: f64::INFINITY,
            tells_work: true,
            dt: 0.0,
            accepted: Vec::new(),
        }
    }

    fn gap(&mut self, positions: &[f64]) -> f64 {
        let gap = positions[1] - self.now;
        self.nearest = self.nearest.min(gap);
        gap
    }
}

impl System for Floor {
    fn particle_count(&self) -> usize {
        1
    }

    fn masses(&self) -> &[f64] {
        &[1.0]
    }

    fn held(&self) -> &[bool] {
        &[false]
    }

    fn begin(&mut self, end_time: f64, dt: f64, _: &[f64], _: &mut [f64]) {
        self.dt = dt;
        self.ends = [self.speed * (end_time - dt), self.speed * end_time];
        self.now = self.ends[1];
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        let gap = self.gap(positions);
        // A barrier that knows of no other side.
        let push = if gap <= 0.0 {
            f64::NAN
        } else if gap < ACTIVATION_DISTANCE {
            STIFFNESS * ACTIVATION_DISTANCE * (ACTIVATION_DISTANCE / gap - 1.0)
        } else {
            0.0
        };
        forces.copy_from_slice(&[0.0, push - 9.81, 0.0]);
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        let gap = self.gap(positions);
        let barrier = if gap < ACTIVATION_DISTANCE {
            STIFFNESS
                * ACTIVATION_DISTANCE
                * (gap
                    - ACTIVATION_DISTANCE
                    - ACTIVATION_DISTANCE * (gap / ACTIVATION_DISTANCE).ln())
        } else {
            0.0
        };
        barrier + 9.81 * positions[1]
    }

    fn stiffness(&mut self, positions: &[f64], _: Stiffness, matrix: &mut BlockMatrix) {
        let gap = self.gap(positions);
        matrix.values_mut()[4] = if gap < ACTIVATION_DISTANCE {
            STIFFNESS * (ACTIVATION_DISTANCE / gap).powi(2)
        } else {
            0.0
        };
    }

    fn sparsity(&self) -> Sparsity {
        Sparsity::from_pairs(1, []).unwrap()
    }

    fn accept(&mut self, positions: &[f64], _: &[f64], dt: f64) {
        assert!(positions[1] > self.now && self.now == self.ends[1]);
        self.accepted.push(dt);
    }
}

impl StepFilter for Floor {
    fn limit_step(&mut self, step: TrialStep<'_>) -> AllowedStep {
        // A tenth of the gap is kept.
        let closing = (self.ends[1] - self.ends[0]) * step.obstacle_advance - step.displacements[1];
        let room = 0.9 * (step.start[1] - self.now);
        if closing <= room {
            return match step.obstacle_advance <= self.advance_max {
                true => AllowedStep::Whole,
                false => AllowedStep::Shortened { obstacle_advance: self.advance_max },
            };
        }
        let part = room / closing;
        step.displacements.iter_mut().for_each(|displacement| *displacement *= part);
        AllowedStep::Shortened { obstacle_advance: step.obstacle_advance * part }
    }

    fn set_obstacle_time(&mut self, time: f64) {
        let [start, end] = self.ends;
        self.now = if time == 1.0 { end } else { start + time * (end - start) };
    }

    fn obstacle_work(&mut self, positions: &[f64]) -> f64 {
        let gap = self.gap(positions);
        let push = STIFFNESS * ACTIVATION_DISTANCE * (ACTIVATION_DISTANCE / gap - 1.0).max(0.0);
        if self.tells_work { push * (self.ends[1] - self.ends[0]) } else { 0.0 }
    }

    fn is_intersection_free(&mut self, _: &[f64]) -> bool {
        assert!(self.now == self.ends[1], "a solution is one with the floor at its end");
        self.dt <= self.certified
    }
}

fn falling(height: f64, speed: f64) -> IntegratorState {
    let mut state = IntegratorState::at_rest(vec![0.0, height, 0.0]);
    state.velocities[1] = -speed;
    state
}

fn settings() -> Settings {
    Settings { tolerance: 1e-9, energy_balance: true, ..Settings::default() }
}

#[test]
fn a_bullet_does_not_pass_a_floor_thinner_than_its_step() {
    for (method, begin_at_prediction) in
        [(Method::Broyden, false), (Method::Newton, false), (Method::Newton, true)]
    {
        let mut floor = Floor::new(0.0);
        let settings = Settings { method, begin_at_prediction, ..settings() };
        let mut stepper = Stepper::new(&floor, settings).unwrap();
        let mut state = falling(0.5, 100.0);
        let mut height: f64 = 0.5;
        for _ in 0..40 {
            stepper.advance_filtered(&mut floor, &mut state, 0.01).unwrap();
            height = height.max(state.positions[1]);
        }
        assert!(floor.nearest > 0.0, "evaluated at {:e} m", floor.nearest);
        // A bullet's energy at the start is 5 kJ, that at the top no more.
        assert!(9.81 * height <= 5000.0 + 9.81 * 0.5, "bounced to {height} m");
        assert!(state.positions[1] > 0.0);
    }
}

#[test]
fn a_step_begins_at_its_prediction_if_asked_to_and_nothing_limits_it() {
    let evaluations = |height: f64, begin_at_prediction: bool| {
        let mut floor = Floor::new(0.0);
        let mut stepper =
            Stepper::new(&floor, Settings { begin_at_prediction, ..settings() }).unwrap();
        let mut state = falling(height, 1.0);
        let report = stepper.advance_filtered(&mut floor, &mut state, 0.01).unwrap();
        (report.force_evaluations, state.positions[1])
    };
    let [(looking, height), (going, same)] =
        [false, true].map(|begin_at_prediction| evaluations(0.5, begin_at_prediction));
    assert_eq!((looking - going, height), (1, same));
    assert_eq!(evaluations(0.01, false), evaluations(0.01, true));
}

#[test]
fn a_floor_that_rises_by_many_times_its_activation_distance_carries_the_particle() {
    let mut floor = Floor::new(1.0);
    let mut stepper = Stepper::new(&floor, settings()).unwrap();
    let mut state = falling(ACTIVATION_DISTANCE, 0.0);
    for _ in 0..20 {
        stepper.advance_filtered(&mut floor, &mut state, 0.01).unwrap();
        assert!(state.positions[1] > state.time, "{:?} at {}", state.positions, state.time);
    }
    assert!(floor.nearest > 0.0);
    // It flies at most as an elastic collision would throw it.
    assert!(state.velocities[1] <= 2.0 + 1e-9, "{:?}", state.velocities);
}

#[test]
fn a_step_ends_only_when_the_floor_has_arrived_however_slowly_it_is_let_on() {
    for advance_max in [0.3, 0.1] {
        // It never comes near the particle, whose forces balance all the while.
        let mut floor = Floor { advance_max, ..Floor::new(1.0) };
        let mut stepper = Stepper::new(&floor, settings()).unwrap();
        let mut state = falling(10.0, 0.0);
        stepper.advance_filtered(&mut floor, &mut state, 0.01).unwrap();
        assert_eq!((floor.now, &floor.accepted[..]), (0.01, &[0.01][..]));
    }
}

#[test]
fn the_balance_closes_with_the_work_of_a_floor_that_rises_and_opens_without() {
    for tells_work in [true, false] {
        let mut floor = Floor { tells_work, ..Floor::new(0.05) };
        let mut stepper = Stepper::new(&floor, settings()).unwrap();
        let mut state = falling(0.9 * ACTIVATION_DISTANCE, 0.0);
        let (mut open, mut work) = (0.0, 0.0);
        for _ in 0..200 {
            let report = stepper.advance_filtered(&mut floor, &mut state, 0.001).unwrap();
            let energy = report.energy.unwrap();
            open += energy.open();
            work += energy.work;
        }
        println!("{open:e} J open, {work:e} J of work");
        // The weight of 1 kg rises by 10 mm.
        match tells_work {
            true => assert!(open.abs() < 1e-6 * work && work > 0.09, "{open:e} of {work:e} J"),
            false => assert!(work == 0.0 && open.abs() > 0.09, "{open:e} of {work:e} J"),
        }
    }
}

#[test]
fn a_solution_that_is_not_certified_is_tried_in_halves() {
    let mut floor = Floor { certified: 0.003, ..Floor::new(0.0) };
    let mut stepper = Stepper::new(&floor, settings()).unwrap();
    let mut state = falling(1.0, 0.0);
    let report = stepper.advance_filtered(&mut floor, &mut state, 0.01).unwrap();
    assert!(floor.accepted.iter().all(|&dt| dt <= 0.003), "{:?}", floor.accepted);
    assert!(report.rejected >= 2 && (state.time - 0.01).abs() < 1e-15);

    floor.certified = 0.0;
    let before = state.positions.clone();
    let error = stepper.advance_filtered(&mut floor, &mut state, 0.01).unwrap_err();
    assert!(matches!(error, Error::NotConverged { stop: Stop::Intersection, .. }), "{error}");
    assert_eq!(state.positions, before);
}

#[test]
fn a_floor_that_rises_too_fast_blocks_the_step() {
    // It would have to be pushed by 10 m in a step that is allowed no halves, and by a thousandth
    // at a time.
    let mut floor = Floor::new(1000.0);
    let settings = Settings { max_halvings: 0, ..settings() };
    let mut stepper = Stepper::new(&floor, settings).unwrap();
    let mut state = falling(1e-6, 0.0);
    let error = stepper.advance_filtered(&mut floor, &mut state, 0.01).unwrap_err();
    assert!(matches!(error, Error::NotConverged { stop: Stop::Blocked, .. }), "{error}");
    assert_eq!(state.positions[1], 1e-6);
}

#[test]
fn textbook_broyden_refuses_a_step_filter() {
    let mut floor = Floor::new(0.0);
    let method = Method::Textbook { initial: InitialMatrix::Mass };
    let mut stepper = Stepper::new(&floor, Settings { method, ..settings() }).unwrap();
    let refused = stepper.advance_filtered(&mut floor, &mut falling(1.0, 0.0), 0.001);
    assert_eq!(refused.unwrap_err(), Error::UnfilteredMethod);
}
