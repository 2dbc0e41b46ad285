//! A loop of one's own around cloth and solver: a sheet hangs from two pins, one of which moves,
//! and a wind blows on it.
//!
//! `cargo run --release --example own_loop -p drape-cloth`
//!
//! The adapter [`Sheet`] is all that `drape-cloth` and `drape-implicit` need to work together.
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use std::time::Instant;

use drape_cloth::{Cloth, Lattice, State, Workspace};
use drape_fabric::samples;
use drape_implicit::{
    BlockMatrix, IntegratorState, Settings, Sparsity, Stepper, Stiffness, System, check_system,
};

/// Side of the sheet and distance of its particles, in m.
const SIDE: f64 = 1.0;
const SPACING: f64 = 0.02;

/// Acceleration of gravity, in m/s².
const GRAVITY: f64 = 9.806_65;

/// Why lists of the sheet cannot be refused.
const FIT: &str = "state and lists belong to the cloth of the sheet";

/// Length of a frame, in s.
const FRAME: f64 = 1.0 / 60.0;

/// Position of the pin that moves at a time in s, in m: along a circle towards the other pin.
fn pin_position(time: f64) -> [f64; 3] {
    let angle = 1.5 * time.min(1.0);
    [SIDE - 0.4 * (1.0 - angle.cos()), 0.0, 0.4 * angle.sin()]
}

/// Sheet of cloth with its weight, two pins and a wind, as the system that the solver steps.
struct Sheet {
    cloth: Cloth,
    /// State at the start of the step, with the memories of the friction.
    state: State,
    workspace: Workspace,
    held: Vec<bool>,
    /// Number of the particle that is led.
    led: usize,
    /// Force of the wind on each particle during the step, in N.
    wind: Vec<[f64; 3]>,
}

impl Sheet {
    /// Sets the wind for the next step: a pressure of `pressure`, in Pa, on the side from which the
    /// normals point away.
    fn blow(&mut self, pressure: f64) {
        let normals = self.state.normals().as_chunks::<3>().0;
        let areas = self.cloth.areas();
        self.wind =
            normals.iter().zip(areas).map(|(n, area)| n.map(|n| pressure * area * n)).collect();
    }
}

impl System for Sheet {
    fn particle_count(&self) -> usize {
        self.held.len()
    }

    fn masses(&self) -> &[f64] {
        self.cloth.masses()
    }

    fn held(&self) -> &[bool] {
        &self.held
    }

    fn begin(&mut self, end_time: f64, _dt: f64, _start: &[f64], target: &mut [f64]) {
        target[3 * self.led..][..3].copy_from_slice(&pin_position(end_time));
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        let each = forces.as_chunks_mut::<3>().0.iter_mut().zip(self.cloth.masses());
        for ((force, mass), wind) in each.zip(&self.wind) {
            *force = [wind[0], wind[1] - mass * GRAVITY, wind[2]];
        }
        let trial = self.cloth.trial(&self.state, positions).expect(FIT);
        self.workspace.add_forces(trial, forces).expect(FIT);
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        let particles = positions.as_chunks::<3>().0.iter().zip(self.cloth.masses());
        let outer = particles.zip(&self.wind).map(|((x, mass), wind)| {
            mass * GRAVITY * x[1] - wind.iter().zip(x).map(|(force, x)| force * x).sum::<f64>()
        });
        let trial = self.cloth.trial(&self.state, positions).expect(FIT);
        outer.sum::<f64>() + self.workspace.potential(trial).expect(FIT)
    }

    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        let definite = kind == Stiffness::Definite;
        let trial = self.cloth.trial(&self.state, positions).expect(FIT);
        self.workspace.add_stiffness(trial, definite, matrix.values_mut()).expect(FIT);
    }

    fn sparsity(&self) -> Sparsity {
        Sparsity::from_rows(self.cloth.sparsity().rows()).expect("the rows of a cloth are right")
    }

    fn accept(&mut self, positions: &[f64], velocities: &[f64], _dt: f64) {
        self.workspace.commit(&self.cloth, &mut self.state, positions, velocities).expect(FIT);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The sheet hangs from its two upper corners.
    let lattice = Lattice::rectangle(SIDE, SIDE, SPACING)?;
    let cloth = Cloth::new(&[(&lattice, &samples::plain_weave_with_friction())])?;
    let positions: Vec<f64> =
        cloth.coordinates().iter().flat_map(|&[u, v]| [u, v - SIDE, 0.0]).collect();
    let corner = |u: f64| {
        let at_corner = |point: &[f64; 2]| (point[0] - u).hypot(point[1] - SIDE) < 1e-9;
        cloth.coordinates().iter().position(at_corner).ok_or("no corner")
    };
    let (still, led) = (corner(0.0)?, corner(SIDE)?);
    let mut held = vec![false; positions.len() / 3];
    (held[still], held[led]) = (true, true);

    let state = cloth.state(positions.clone())?;
    let workspace = cloth.workspace();
    let wind = vec![[0.0; 3]; held.len()];
    let mut sheet = Sheet { cloth, state, workspace, held, led, wind };

    // Forces and stiffness of a new system are compared with differences of its potential, at
    // positions where the yarns are taut: the laws have a kink where they go slack.
    sheet.blow(5.0);
    let bent: Vec<f64> = positions
        .as_chunks::<3>()
        .0
        .iter()
        .flat_map(|[x, y, _]| [1.002 * x + 0.02 * y, 1.003 * y, 0.02 * (4.0 * x).sin() * y])
        .collect();
    let check = check_system(&mut sheet, &positions, &bent, FRAME)?;
    println!("errors: forces {:.1e}, stiffness {:.1e}", check.force_error, check.stiffness_error);
    assert!(check.force_error < 1e-6 && check.stiffness_error < 1e-6, "{check:?}");

    // A step a frame. The wind blows for a second.
    // The solver may leave a third of the error of the step itself, which suits motion that is
    // looked at.
    let settings = Settings { error_fraction: 0.3, energy_forcing: 0.03, ..Settings::default() };
    let mut stepper = Stepper::new(&sheet, settings)?;
    let mut state = IntegratorState::at_rest(positions);
    let begin = Instant::now();
    for frame in 0..120 {
        sheet.blow(if frame < 60 { 0.5 } else { 0.0 });
        stepper.advance(&mut sheet, &mut state, FRAME)?;
    }
    let milliseconds = 1e3 * begin.elapsed().as_secs_f64() / 120.0;

    let particles = state.positions.as_chunks::<3>().0;
    assert_eq!(particles[still], [0.0; 3]);
    let away = (0..3).map(|k| (particles[led][k] - pin_position(2.0)[k]).abs()).fold(0.0, f64::max);
    assert!(away < 1e-12, "the led pin is {away} m away from its place");
    let lowest = particles.iter().map(|x| x[1]).fold(0.0, f64::min);
    assert!((-1.2..-0.8).contains(&lowest), "the lowest particle is at {lowest} m");
    println!("{} particles, {milliseconds:.1} ms a frame", particles.len());
    println!("the sheet hangs down to {:.0} mm below its pins", -1e3 * lowest);
    Ok(())
}
