//! Newton's method with a line search, and Broyden's on its tangents.

use crate::broyden::Updates;
use crate::error::Quantity;
use crate::incremental::{Halt, Incremental, Point, first_not_finite};
use crate::tangent::Tangent;
use crate::vector::{add_scaled, dot};
use crate::{Error, Method, Settings, Stiffness, Stop};

/// A full Newton step that shrinks the residual by this factor shows that the tangent describes the neighbourhood:
/// only then is it kept for Broyden steps. Larger values keep tangents that waste iterations, smaller ones throw
/// useful ones away; on a sheet of 2500 particles the cost was flat, within a tenth, from 0.1 to 0.9.
const TRUSTED_CONTRACTION: f64 = 1.0 / 3.0;

/// A tangent is kept only if one more step with it, contracting as well as the last, would bring the residual below
/// this multiple of the limit. Farther away the quadratic convergence of Newton's method is worth its tangents: on a
/// swinging sheet of 2500 particles at 5 ms, 4 to 6 tangents per step became 3 to 4 with half as many evaluations of
/// the forces. From 3 to 10 the cost was flat.
const REACH: f64 = 5.0;

/// No contraction better than this is expected of a step on a kept tangent, however well the last one did.
const EXPECTED_CONTRACTION: f64 = 0.1;

/// A Broyden step that leaves more than this of the residual is the last on its tangent. The cost was as flat from 0.3
/// to 0.9.
const SLOW_CONTRACTION: f64 = 0.5;

/// Broyden updates are refused where the tangent along a step has fallen below this fraction of the frozen one. The
/// update would stretch later directions, and the errors of their linear solves, by the inverse of it.
const TANGENT_FLOOR: f64 = 0.1;

/// Decrease that a line search asks for, as a fraction of what the slope promises: the customary value, small, so
/// that it only excludes steps that gain nothing.
pub(crate) const ARMIJO: f64 = 1e-4;

/// A line search takes what leaves at most this of the least residual so far, without asking for the energy. With the
/// residual before in its place a step that gained residual and one that gained energy could undo each other for good.
const GAIN: f64 = 0.9;

/// A direction that was not solved for, because it met negative curvature, and of which a line search leaves this much or
/// less, is followed by definite matrices: its like would hardly be longer.
const STUB: f64 = 0.25;

/// The exact tangent is left out for at most two to this power of iterations at a time, and only once where a step has to
/// be balanced whatever it gains. With times that double, and not always one, two garments in layers were sewn with a fifth
/// fewer tangents, a T-shirt with an eighth fewer; but a swing took a tenth more iterations, and the last steps of a flounce
/// on its way to rest, by definite tangents, left a saddle too slowly.
const LEFT_OUT_MAX: u32 = 6;

/// Halvings in a line search before the direction is given up: 2⁻¹⁶ of a Newton step is no progress.
pub(crate) const MAX_CUTS: usize = 16;

/// Relative difference of two energies below which rounding may have made it; the slopes then decide in their
/// place (Hager & Zhang 2005, SIAM J. Optim. 16, eq. 4.1).
const ENERGY_NOISE: f64 = 1e-12;

/// Part of the convergence limit that a linear solve need not go below: the last one would otherwise be solved a
/// hundred times too well. The rest is left to the nonlinearity.
const LINEAR_SHARE: f64 = 0.3;

/// What a step that has little energy left to gain may leave of the residual, times the limit. Without a bound, or with
/// one of a thousand, some steps of a cloth on a cube ended with contacts that were too tight for the next ones.
const UNBALANCED_MAX: f64 = 100.0;

/// A Newton step that was taken.
struct Taken {
    /// Whether it went the whole way.
    whole: bool,
    /// What it promised to gain of the energy, J; infinite if that is not known.
    promise: f64,
}

/// The iteration and its work space. Nothing in it outlives a sub-step.
#[derive(Debug)]
pub(crate) struct Solver {
    pub current: Point,
    pub trial: Point,
    /// One of two places to begin from.
    pub spare: Point,
    /// The step to take, or the last one taken, m.
    pub direction: Vec<f64>,
    /// The residual times the inverse in use, m.
    pub image: Vec<f64>,
    pub updates: Updates,
    /// What textbook Broyden starts from, N/m.
    pub diagonal: Vec<f64>,
    pub tangent: Tangent,
    pub iterations: usize,
    /// The least norm of the residual since things moved by prescription, N.
    best: f64,
    /// Iterations for which the exact tangent is left out.
    left_out: u32,
    /// Exact tangents in a row that left no step worth its name.
    stubs: u32,
}

impl Solver {
    pub(crate) fn new(tangent: Tangent, settings: &Settings) -> Self {
        let length = 3 * tangent.matrix.sparsity().particles();
        let updates =
            if settings.method == Method::Broyden { settings.iterations_per_matrix - 1 } else { 0 };
        Self {
            current: Point::new(length),
            trial: Point::new(length),
            spare: Point::new(length),
            direction: vec![0.0; length],
            image: vec![0.0; length],
            updates: Updates::with_room(updates, length),
            diagonal: Vec::new(),
            tangent,
            iterations: 0,
            best: f64::INFINITY,
            left_out: 0,
            stubs: 0,
        }
    }

    /// Solves the equations from the deviations in `current`, or, if the forces there are not finite, from those
    /// in `trial`. The solution is left in `current`.
    pub(crate) fn solve(
        &mut self,
        problem: &mut Incremental<'_, '_>,
        settings: &Settings,
    ) -> Result<(), Halt> {
        self.iterations = 0;
        (self.left_out, self.stubs) = (0, 0);
        self.tangent.forget();
        self.current.obstacle_time = 1.0;
        self.trial.obstacle_time = 1.0;
        if problem.system.is_filtered() {
            self.approach(problem, settings.begin_at_prediction);
        } else {
            problem.evaluate(&mut self.current);
        }
        if !self.current.norm.is_finite() {
            core::mem::swap(&mut self.current, &mut self.trial);
            problem.evaluate(&mut self.current);
        }
        if !self.current.norm.is_finite() {
            let particle = first_not_finite(&self.current.residual).unwrap_or(0);
            return Err(Halt::NotFinite(Quantity::Force, particle));
        }
        match settings.method {
            Method::Textbook { .. } if problem.system.is_filtered() => {
                Err(Halt::Fatal(Error::UnfilteredMethod))
            }
            Method::Textbook { initial } => self.textbook(problem, settings, initial),
            Method::Newton => self.on_tangents(problem, settings, 1),
            Method::Broyden => self.on_tangents(problem, settings, settings.iterations_per_matrix),
        }
    }

    /// Counts an iteration, if there is one left.
    pub(crate) fn count(
        &mut self,
        problem: &mut Incremental<'_, '_>,
        settings: &Settings,
    ) -> Result<(), Halt> {
        if self.iterations == settings.max_iterations {
            return Err(Halt::Stop(Stop::Iterations));
        }
        self.iterations += 1;
        problem.report.iterations += 1;
        Ok(())
    }

    /// Alternates one safeguarded Newton step and up to `uses − 1` Broyden steps on its tangent.
    fn on_tangents(
        &mut self,
        problem: &mut Incremental<'_, '_>,
        settings: &Settings,
        uses: usize,
    ) -> Result<(), Halt> {
        self.best = self.current.norm;
        while self.current.obstacle_time < 1.0 || !self.current.solves(problem.limit) {
            self.count(problem, settings)?;
            if self.current.obstacle_time < 1.0 {
                self.carry(problem)?;
                self.best = self.current.norm;
            }
            let before = self.current.norm;
            self.best = self.best.min(before);
            let Taken { whole, promise } = self.newton_step(problem, settings)?;
            if settings.energy_tolerance > 0.0 && self.may_end(problem) {
                let left = promise / problem.kinetic(&self.current);
                if left <= settings.energy_tolerance {
                    problem.report.energy_left = problem.report.energy_left.max(left);
                    break;
                }
            }
            self.updates.forget();
            let contraction = self.current.norm / before;
            let expected = self.current.norm * contraction.max(EXPECTED_CONTRACTION);
            let mut trusted = whole
                && self.current.obstacle_time == 1.0
                && contraction <= TRUSTED_CONTRACTION
                && expected <= REACH * problem.limit;
            let mut left = uses - 1;
            while trusted && left > 0 && !self.current.solves(problem.limit) {
                self.count(problem, settings)?;
                trusted = self.broyden_step(problem, settings.broyden_forcing);
                left -= 1;
            }
        }
        Ok(())
    }

    /// Whether a step that has little energy left to gain may end here.
    fn may_end(&self, problem: &Incremental<'_, '_>) -> bool {
        self.current.obstacle_time == 1.0 && self.current.solves(UNBALANCED_MAX * problem.limit)
    }

    /// A step along the exact tangent's direction, or along the definite one's if that fails.
    ///
    /// After a direction of negative curvature that leaves no step worth its name the exact tangent is left out: tried at
    /// every iteration, most of them were assembled in vain.
    fn newton_step(
        &mut self,
        problem: &mut Incremental<'_, '_>,
        settings: &Settings,
    ) -> Result<Taken, Halt> {
        let mut stop = Stop::Indefinite;
        let kinds: &[Stiffness] = match self.left_out {
            0 => &[Stiffness::Exact, Stiffness::Definite],
            _ => &[Stiffness::Definite],
        };
        self.left_out = self.left_out.saturating_sub(1);
        for &kind in kinds {
            problem.assemble(&self.current, kind, &mut self.tangent)?;
            let Some((mut slope, solved)) = self.newton_direction(problem, settings.newton_forcing)
            else {
                if let Some(entry) =
                    self.tangent.matrix.values().iter().position(|x| !x.is_finite())
                {
                    return Err(Halt::NotFinite(Quantity::Stiffness, self.row_of(entry / 9)));
                }
                if kind == Stiffness::Exact {
                    problem.report.negative_curvatures += 1;
                    self.leave_out(settings);
                    self.tangent.forget();
                }
                continue;
            };
            let promise = if solved { -0.5 * slope } else { f64::INFINITY };
            let whole = problem.limit_step(&self.current, &mut self.direction, 0.0).is_whole();
            if !whole {
                slope = dot(&self.direction, &self.current.residual);
            }
            stop = Stop::LineSearch;
            if let Some(length) = self.line_search(problem, slope) {
                match (kind, solved) {
                    (Stiffness::Exact, true) => self.stubs = 0,
                    (Stiffness::Exact, false) if length <= STUB => self.leave_out(settings),
                    _ => {}
                }
                return Ok(Taken { whole: whole && length == 1.0, promise });
            }
        }
        Err(Halt::Stop(stop))
    }

    /// Leaves the exact tangent out, once or, if it fails again and again on a step that may end with energy left to gain,
    /// for a time that doubles.
    fn leave_out(&mut self, settings: &Settings) {
        let most = if settings.energy_tolerance > 0.0 { LEFT_OUT_MAX } else { 0 };
        self.left_out = 1 << self.stubs.saturating_sub(1).min(most);
        self.stubs += 1;
    }

    /// Solves for the Newton direction. Returns the slope of the energy along it, and whether it is solved as well as
    /// asked; `None` unless the slope is negative.
    fn newton_direction(
        &mut self,
        problem: &mut Incremental<'_, '_>,
        forcing: f64,
    ) -> Option<(f64, bool)> {
        self.tangent.prepare(problem.report).ok()?;
        let target = linear_target(&self.current, forcing, problem.limit);
        let Self { current, direction, tangent, .. } = self;
        let solved = tangent.solve(&current.residual, direction, target, problem.report).ok()?;
        for p in direction.iter_mut() {
            *p = -*p;
        }
        let slope = dot(direction, &current.residual);
        (slope < 0.0).then_some((slope, solved))
    }

    /// Shortens the step until the residual falls below all before or, failing that, the energy falls. Moves `current`
    /// there and returns the length accepted.
    fn line_search(&mut self, problem: &mut Incremental<'_, '_>, slope: f64) -> Option<f64> {
        let mut length = 1.0;
        // A way that was cut need not lead down.
        if !(slope < 0.0) {
            return None;
        }
        for _ in 0..=MAX_CUTS {
            self.try_step(problem, length);
            if self.trial.norm <= GAIN * self.best {
                return Some(self.accept(length));
            }
            if self.trial.norm.is_finite() {
                let start = problem.energy(&mut self.current);
                let end = problem.energy(&mut self.trial);
                let noise = ENERGY_NOISE * (start.abs() + end.abs());
                let good = if noise.is_finite() && (end - start).abs() <= noise {
                    dot(&self.trial.residual, &self.direction) <= (2.0 * ARMIJO - 1.0) * slope
                } else {
                    end.is_finite() && end <= start + ARMIJO * length * slope
                };
                if good {
                    return Some(self.accept(length));
                }
            }
            problem.report.backtracks += 1;
            length *= 0.5;
        }
        None
    }

    /// One step with the updated inverse of the frozen tangent, taken only if the residual falls. Returns whether
    /// the tangent is worth keeping.
    fn broyden_step(&mut self, problem: &mut Incremental<'_, '_>, forcing: f64) -> bool {
        let target = linear_target(&self.current, forcing, problem.limit);
        let Self { current, image, tangent, .. } = self;
        if tangent.solve(&current.residual, image, target, problem.report).is_err() {
            return false;
        }
        if !self.turn(1.0, TANGENT_FLOOR) {
            return false;
        }
        let before = self.current.norm;
        let whole = problem.limit_step(&self.current, &mut self.direction, 0.0).is_whole();
        self.try_step(problem, 1.0);
        if self.trial.norm < before {
            self.accept(1.0);
        }
        whole && self.current.norm <= SLOW_CONTRACTION * before
    }

    /// Learns from the last step, of the given length along `direction`, with `image = H₀ φ` of its end; sets
    /// `direction` to the next one.
    pub(crate) fn turn(&mut self, length: f64, floor: f64) -> bool {
        self.updates.apply(&mut self.image);
        if !self.updates.learn(&self.direction, length, &self.image, floor) {
            return false;
        }
        self.updates.apply_last(&mut self.image);
        for (p, z) in self.direction.iter_mut().zip(&self.image) {
            *p = -z;
        }
        true
    }

    /// Evaluates the point at some length along the direction.
    pub(crate) fn try_step(&mut self, problem: &mut Incremental<'_, '_>, length: f64) {
        self.move_trial(length);
        problem.evaluate(&mut self.trial);
    }

    /// Moves the trial to some length along the direction.
    pub(crate) fn move_trial(&mut self, length: f64) {
        self.trial.deviation.copy_from_slice(&self.current.deviation);
        add_scaled(&mut self.trial.deviation, length, &self.direction);
        self.trial.obstacle_time = self.current.obstacle_time;
    }

    /// Makes the trial the current point.
    pub(crate) fn accept(&mut self, length: f64) -> f64 {
        core::mem::swap(&mut self.current, &mut self.trial);
        length
    }

    /// The row that a slot lies in.
    fn row_of(&self, slot: usize) -> usize {
        let offsets = self.tangent.matrix.sparsity().offsets();
        offsets.partition_point(|&offset| offset <= slot) - 1
    }
}

/// How exactly a linear system is worth solving: relative to the residual, but not beyond what convergence needs.
fn linear_target(point: &Point, forcing: f64, limit: f64) -> f64 {
    (forcing * point.norm).max(LINEAR_SHARE * limit)
}
