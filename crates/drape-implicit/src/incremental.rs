//! The equations of one sub-step, as the gradient of an energy.
//!
//! With `d = x − x̃` the deviation from free flight and `h = β dt`, the end positions solve
//! `φ = M d/h² − f(x̃ + d) = 0`, where the energy `½ Σ m d²/h² + V(x̃ + d)` is stationary. Solving for `d` and not
//! for `x` keeps the inertia exact however short the step is.

use crate::error::Quantity;
use crate::step_filter::SystemRef;
use crate::tangent::Tangent;
use crate::{Error, Report, StepLimit, Stiffness, Stop, TrialStep, block, vector};

/// Why an attempt at a sub-step ends without a solution.
#[derive(Clone, Debug)]
pub(crate) enum Halt {
    /// A shorter step may help.
    Stop(Stop),
    /// A shorter step may help: this was not finite, first of all for this particle.
    NotFinite(Quantity, usize),
    /// Nothing helps.
    Fatal(Error),
}

/// A trial: deviations and what follows from them.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// `d`, m.
    pub deviation: Vec<f64>,
    /// `x̃ + d`, m.
    pub positions: Vec<f64>,
    /// `φ`, N.
    pub residual: Vec<f64>,
    /// `‖φ‖₂`, N. NaN or infinite if the forces are.
    pub norm: f64,
    /// The energy, J, if it has been asked for.
    energy: Option<f64>,
    /// Fraction of the prescribed motions that is done; below 1 only on the way to it with a step filter.
    pub obstacle_time: f64,
}

impl Point {
    pub(crate) fn new(length: usize) -> Self {
        let zeros = || vec![0.0; length];
        Self {
            deviation: zeros(),
            positions: zeros(),
            residual: zeros(),
            norm: f64::NAN,
            energy: None,
            obstacle_time: 1.0,
        }
    }

    /// Whether the residual is within the limit: never if it is NaN, and with all particles held always.
    pub(crate) fn solves(&self, limit: f64) -> bool {
        self.norm <= limit
    }
}

/// One sub-step's equations and the counters of the work done on them.
pub(crate) struct Incremental<'a, 'b> {
    pub system: &'a mut SystemRef<'b>,
    /// `m/h²` per particle, N/m.
    pub inertia: &'a [f64],
    pub held: &'a [bool],
    /// `x̃` for free particles, the prescribed positions for held ones, m.
    pub base: &'a [f64],
    /// Where the sub-step starts, m.
    pub start: &'a [f64],
    /// The norm of `φ` at which the step is solved, N.
    pub limit: f64,
    pub report: &'a mut Report,
}

impl Incremental<'_, '_> {
    /// Fills in what follows from the deviations.
    pub(crate) fn evaluate(&mut self, point: &mut Point) {
        self.locate(point);
        let Point { deviation, positions, residual, norm, .. } = point;
        self.system.system().forces(positions, residual);
        self.report.force_evaluations += 1;
        let triples = block::triples_mut(residual).iter_mut().zip(block::triples(deviation));
        for (((phi, d), inertia), &held) in triples.zip(self.inertia).zip(self.held) {
            for (phi, d) in phi.iter_mut().zip(d) {
                *phi = if held { 0.0 } else { inertia * d - *phi };
            }
        }
        *norm = vector::norm(residual);
    }

    /// Fills in the positions, and puts there what moves by prescription.
    pub(crate) fn locate(&mut self, point: &mut Point) {
        point.energy = None;
        for ((x, base), d) in point.positions.iter_mut().zip(self.base).zip(&point.deviation) {
            *x = base + d;
        }
        self.system.set_obstacle_time(point.obstacle_time);
    }

    /// Limits the step from a point; see [`StepFilter::limit_step`](crate::StepFilter::limit_step).
    pub(crate) fn limit_step(
        &mut self,
        point: &Point,
        displacements: &mut [f64],
        obstacle_advance: f64,
    ) -> StepLimit {
        let (start, obstacle_time) = (&point.positions[..], point.obstacle_time);
        self.system.limit_step(TrialStep { start, displacements, obstacle_time, obstacle_advance })
    }

    /// The energy of an evaluated point, J.
    pub(crate) fn energy(&mut self, point: &mut Point) -> f64 {
        if let Some(energy) = point.energy {
            return energy;
        }
        self.report.potential_evaluations += 1;
        let mut kinetic = 0.0;
        for (d, inertia) in block::triples(&point.deviation).iter().zip(self.inertia) {
            kinetic += 0.5 * inertia * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        }
        *point.energy.insert(kinetic + self.system.system().potential(&point.positions))
    }

    /// The kinetic energy of going straight to a point, `½ Σ m |x − x₀|²/h²`, J.
    pub(crate) fn kinetic(&self, point: &Point) -> f64 {
        let ways = block::triples(&point.positions).iter().zip(block::triples(self.start));
        let mut sum = 0.0;
        for (((x, start), inertia), &held) in ways.zip(self.inertia).zip(self.held) {
            if !held {
                let way = [x[0] - start[0], x[1] - start[1], x[2] - start[2]];
                sum += 0.5 * inertia * vector::dot(&way, &way);
            }
        }
        sum
    }

    /// Assembles the matrix of an evaluated point.
    pub(crate) fn assemble(
        &mut self,
        point: &Point,
        kind: Stiffness,
        tangent: &mut Tangent,
    ) -> Result<(), Halt> {
        self.report.stiffness_assemblies += 1;
        let matrix = &mut tangent.matrix;
        matrix.clear();
        self.system.system().stiffness(&point.positions, kind, matrix);
        if let Some([row, column]) = matrix.outside_sparsity() {
            return Err(Halt::Fatal(Error::OutsideSparsity { row, column }));
        }
        matrix.complete(self.inertia, self.held);
        Ok(())
    }
}

/// The first particle with an entry that is not finite.
pub(crate) fn first_not_finite(x: &[f64]) -> Option<usize> {
    x.iter().position(|x| !x.is_finite()).map(|k| k / 3)
}
