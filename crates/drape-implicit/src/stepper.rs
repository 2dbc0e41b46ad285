use crate::error::Quantity;
use crate::incremental::{Halt, Incremental, first_not_finite};
use crate::solver::Solver;
use crate::tangent::Tangent;
use crate::{Energy, Error, Integrator, Motion, Previous, Report, Settings, System, block, vector};

/// Largest ratio of a second-order step to the one before it: below 1 + √2, where the formula ceases to be stable.
const MAX_GROWTH: f64 = 2.0;

/// Room for rounding in the ratio of two steps that should be equal.
const GROWTH_ROUNDING: f64 = 1e-9;

/// Advances the motion of a system in time.
///
/// It holds settings and work space, nothing that the next step depends on: a new stepper gives the same bits.
/// After the first step of a system none allocates memory, unless its pattern changes or a motion restarts.
#[derive(Debug)]
pub struct Stepper {
    settings: Settings,
    solver: Solver,
    version: u64,
    masses: Vec<f64>,
    held: Vec<bool>,
    inertia: Vec<f64>,
    /// What the formula makes of past positions and velocities, before any acceleration.
    drift: Vec<f64>,
    momentum: Vec<f64>,
    base: Vec<f64>,
    velocities: Vec<f64>,
}

/// One attempted sub-step.
#[derive(Clone, Copy)]
struct Span {
    start: f64,
    end: f64,
    dt: f64,
}

/// Weights of a formula `x₁ = current x₀ + previous x₋₁ + reach v₁`, and likewise for momentum and force.
#[derive(Clone, Copy)]
struct Formula {
    current: f64,
    previous: f64,
    /// `β dt`, s.
    reach: f64,
}

impl Formula {
    fn new(integrator: Integrator, motion: &Motion, dt: f64) -> Self {
        match (integrator, &motion.previous) {
            (Integrator::Bdf2, Some(previous)) if grows_gently(dt, previous) => {
                let ratio = dt / previous.dt;
                let whole = 1.0 + 2.0 * ratio;
                Self {
                    current: (1.0 + ratio) * (1.0 + ratio) / whole,
                    previous: -ratio * ratio / whole,
                    reach: (1.0 + ratio) / whole * dt,
                }
            }
            _ => Self {
                current: 1.0,
                previous: 0.0,
                reach: dt,
            },
        }
    }
}

fn grows_gently(dt: f64, previous: &Previous) -> bool {
    dt <= MAX_GROWTH * (1.0 + GROWTH_ROUNDING) * previous.dt
}

impl Stepper {
    /// Prepares to advance a system.
    ///
    /// # Errors
    /// [`Error::Setting`], [`Error::Dimension`], or [`Error::TooLarge`] with the factorising solver.
    pub fn new(system: &dyn System, settings: Settings) -> Result<Self, Error> {
        settings.check()?;
        let solver = solver_for(system, &settings)?;
        let particles = system.particles();
        let zeros = || vec![0.0; 3 * particles];
        Ok(Self {
            settings,
            solver,
            version: system.pattern_version(),
            masses: vec![0.0; particles],
            held: vec![false; particles],
            inertia: vec![0.0; particles],
            drift: zeros(),
            momentum: zeros(),
            base: zeros(),
            velocities: zeros(),
        })
    }

    /// The settings.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Advances the motion by exactly `dt`, in s, in one step or, where that fails, in halves, quarters …
    ///
    /// # Errors
    /// [`Error::NotConverged`] or [`Error::NotFinite`] if the shortest sub-step allowed fails, and others for
    /// input that no step can be made with. The motion is then at the end of the last sub-step accepted, which
    /// its time tells.
    pub fn advance(
        &mut self,
        system: &mut dyn System,
        motion: &mut Motion,
        dt: f64,
    ) -> Result<Report, Error> {
        self.check(system, motion, dt)?;
        let mut report = Report::default();
        let origin = motion.time;
        let finest = self.settings.max_halvings;
        let whole = 1_u64 << finest;
        let mut halvings = self.first_halvings(motion, dt);
        // The position within the step in units of the finest sub-step: exact.
        let mut at = 0;
        while at < whole {
            let next = at + (whole >> halvings);
            let end = if next == whole {
                origin + dt
            } else {
                origin + dt * (next as f64 / whole as f64)
            };
            let span = Span {
                start: motion.time,
                end,
                dt: dt / (1_u64 << halvings) as f64,
            };
            match self.attempt(system, motion, span, &mut report) {
                Ok(()) => {
                    report.sub_steps += 1;
                    at = next;
                    // Longer again, but at most by two and on the grid of the longer step.
                    let aligned = finest.saturating_sub(at.trailing_zeros());
                    halvings = aligned.max(halvings.saturating_sub(1));
                }
                Err(Halt::Fatal(error)) => return Err(error),
                Err(halt) => {
                    report.rejected += 1;
                    if halvings == finest {
                        return Err(self.failure(halt, span));
                    }
                    halvings += 1;
                }
            }
        }
        Ok(report)
    }

    fn check(&mut self, system: &dyn System, motion: &Motion, dt: f64) -> Result<(), Error> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(Error::StepLength { dt });
        }
        let particles = self.masses.len();
        let agree = |what, expected, found| {
            if expected == found {
                Ok(())
            } else {
                Err(Error::Dimension {
                    what,
                    expected,
                    found,
                })
            }
        };
        agree("particles", particles, system.particles())?;
        agree("masses", particles, system.masses().len())?;
        agree("held", particles, system.held().len())?;
        agree("positions", 3 * particles, motion.positions.len())?;
        agree("velocities", 3 * particles, motion.velocities.len())?;
        if let Some(previous) = &motion.previous {
            agree(
                "previous positions",
                3 * particles,
                previous.positions.len(),
            )?;
            agree(
                "previous velocities",
                3 * particles,
                previous.velocities.len(),
            )?;
        }
        self.masses.copy_from_slice(system.masses());
        let bad = self
            .masses
            .iter()
            .position(|&mass| !(mass > 0.0 && mass.is_finite()));
        if let Some(particle) = bad {
            return Err(Error::Mass {
                particle,
                mass: self.masses[particle],
            });
        }
        let start = [
            (Quantity::Position, Some(&motion.positions)),
            (Quantity::Velocity, Some(&motion.velocities)),
            (
                Quantity::Position,
                motion.previous.as_ref().map(|previous| &previous.positions),
            ),
            (
                Quantity::Velocity,
                motion
                    .previous
                    .as_ref()
                    .map(|previous| &previous.velocities),
            ),
        ];
        for (quantity, values) in start {
            if let Some(particle) = values.and_then(|values| first_not_finite(values)) {
                return Err(Error::NotFinite {
                    quantity,
                    particle,
                    time: motion.time,
                    dt,
                });
            }
        }
        if system.pattern_version() != self.version {
            self.solver = solver_for(system, &self.settings)?;
            self.version = system.pattern_version();
        }
        Ok(())
    }

    fn first_halvings(&self, motion: &Motion, dt: f64) -> u32 {
        let Some(previous) = &motion.previous else {
            return 0;
        };
        if self.settings.integrator != Integrator::Bdf2 {
            return 0;
        }
        let finest = self.settings.max_halvings;
        let length = |halvings: u32| dt / (1_u64 << halvings) as f64;
        (0..=finest)
            .find(|&h| grows_gently(length(h), previous))
            .unwrap_or(finest)
    }

    fn attempt(
        &mut self,
        system: &mut dyn System,
        motion: &mut Motion,
        span: Span,
        report: &mut Report,
    ) -> Result<(), Halt> {
        let formula = Formula::new(self.settings.integrator, motion, span.dt);
        self.predict(motion, formula);
        let target = &mut self.base;
        target.copy_from_slice(&motion.positions);
        system.begin(span.end, span.dt, &motion.positions, target);
        self.held.copy_from_slice(system.held());
        let limit = self.place(motion, formula, span.dt)?;
        let start = self.settings.energy_balance.then(|| {
            report.potential_evaluations += 1;
            (
                self.kinetic(&motion.velocities),
                system.potential(&motion.positions),
            )
        });

        let mut problem = Incremental {
            system: &mut *system,
            inertia: &self.inertia,
            held: &self.held,
            base: &self.base,
            limit: limit * self.settings.tolerance,
            report: &mut *report,
        };
        self.solver.solve(&mut problem, &self.settings)?;

        self.set_velocities(formula);
        if let Some(start) = start {
            let balance = self.balance(system, motion, formula, start);
            report.potential_evaluations += 1;
            report.force_evaluations += 1;
            *report.energy.get_or_insert_default() += balance;
        }
        let end = &self.solver.current;
        report.residual = report.residual.max(relative(end.norm, limit));
        system.accept(&end.positions, &self.velocities, span.dt);
        commit(motion, span, &end.positions, &self.velocities);
        Ok(())
    }

    /// Fills in what past positions and velocities amount to.
    fn predict(&mut self, motion: &Motion, formula: Formula) {
        let combine = |out: &mut [f64], now: &[f64], before: Option<&[f64]>| {
            out.copy_from_slice(now);
            if let (Some(before), true) = (before, formula.previous != 0.0) {
                for (out, before) in out.iter_mut().zip(before) {
                    *out = formula.current * *out + formula.previous * before;
                }
            }
        };
        let previous = motion.previous.as_ref();
        combine(
            &mut self.drift,
            &motion.positions,
            previous.map(|p| &p.positions[..]),
        );
        combine(
            &mut self.momentum,
            &motion.velocities,
            previous.map(|p| &p.velocities[..]),
        );
    }

    /// Turns targets into the base of deviations, and sets the first guess and the one to fall back on. Returns the
    /// norm that residuals are relative to, N.
    fn place(&mut self, motion: &Motion, formula: Formula, dt: f64) -> Result<f64, Halt> {
        let Self {
            solver,
            base,
            drift,
            momentum,
            held,
            inertia,
            masses,
            ..
        } = self;
        let mut squares = 0.0;
        for (particle, &held) in held.iter().enumerate() {
            let mass = masses[particle];
            inertia[particle] = mass / (formula.reach * formula.reach);
            if !held {
                squares += mass * mass;
            }
            for k in 3 * particle..3 * particle + 3 {
                let (mut guess, mut fallback) = (0.0, 0.0);
                if held {
                    if !base[k].is_finite() {
                        return Err(Halt::NotFinite(Quantity::Target, particle));
                    }
                } else {
                    base[k] = drift[k] + formula.reach * momentum[k];
                    fallback = motion.positions[k] - base[k];
                    guess = fallback + dt * motion.velocities[k];
                }
                solver.current.deviation[k] = guess;
                solver.trial.deviation[k] = fallback;
            }
        }
        Ok(self.settings.acceleration * squares.sqrt())
    }

    fn set_velocities(&mut self, formula: Formula) {
        let end = &self.solver.current;
        for (particle, &held) in self.held.iter().enumerate() {
            for k in 3 * particle..3 * particle + 3 {
                self.velocities[k] = if held {
                    (end.positions[k] - self.drift[k]) / formula.reach
                } else {
                    self.momentum[k] + end.deviation[k] / formula.reach
                };
            }
        }
    }

    fn kinetic(&self, velocities: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (mass, v) in self.masses.iter().zip(block::triples(velocities)) {
            sum += 0.5 * mass * vector::dot(v, v);
        }
        sum
    }

    fn balance(
        &mut self,
        system: &mut dyn System,
        motion: &Motion,
        formula: Formula,
        (kinetic, potential): (f64, f64),
    ) -> Energy {
        let end = &self.solver.current;
        let forces = &mut self.solver.image;
        system.forces(&end.positions, forces);
        let mut work = 0.0;
        for (k, force) in forces.iter().enumerate().filter(|(k, _)| self.held[k / 3]) {
            let acceleration = (self.velocities[k] - self.momentum[k]) / formula.reach;
            let pull = self.masses[k / 3] * acceleration - force;
            work += pull * (end.positions[k] - motion.positions[k]);
        }
        let kinetic = self.kinetic(&self.velocities) - kinetic;
        let potential = system.potential(&end.positions) - potential;
        Energy {
            kinetic,
            potential,
            work,
            numerical_dissipation: work - kinetic - potential,
        }
    }

    fn failure(&self, halt: Halt, span: Span) -> Error {
        let (time, dt) = (span.start, span.dt);
        match halt {
            Halt::Fatal(error) => error,
            Halt::NotFinite(quantity, particle) => Error::NotFinite {
                quantity,
                particle,
                time,
                dt,
            },
            Halt::Stop(stop) => {
                let free = self
                    .masses
                    .iter()
                    .zip(&self.held)
                    .filter(|(_, held)| !**held);
                let squares: f64 = free.map(|(mass, _)| mass * mass).sum();
                let unit = self.settings.acceleration * squares.sqrt();
                Error::NotConverged {
                    time,
                    dt,
                    residual: relative(self.solver.current.norm, unit),
                    tolerance: self.settings.tolerance,
                    iterations: self.solver.iterations,
                    stop,
                }
            }
        }
    }
}

fn solver_for(system: &dyn System, settings: &Settings) -> Result<Solver, Error> {
    let pattern = system.pattern();
    let (expected, found) = (system.particles(), pattern.particles());
    if expected != found {
        return Err(Error::Dimension {
            what: "pattern",
            expected,
            found,
        });
    }
    Ok(Solver::new(Tangent::new(pattern, settings)?, settings))
}

fn relative(norm: f64, unit: f64) -> f64 {
    if unit > 0.0 { norm / unit } else { 0.0 }
}

fn commit(motion: &mut Motion, span: Span, positions: &[f64], velocities: &[f64]) {
    let Motion { previous, .. } = motion;
    let previous = previous.get_or_insert_with(|| Previous {
        dt: span.dt,
        positions: vec![0.0; positions.len()],
        velocities: vec![0.0; velocities.len()],
    });
    previous.dt = span.dt;
    previous.positions.copy_from_slice(&motion.positions);
    previous.velocities.copy_from_slice(&motion.velocities);
    motion.positions.copy_from_slice(positions);
    motion.velocities.copy_from_slice(velocities);
    motion.time = span.end;
}
