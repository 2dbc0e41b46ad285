//! Equations of one sub-step, and the iterates at which they are evaluated.
//!
//! The unknown is the deviation `d = x − x̃` and not `x`. The inertia is therefore exact however
//! short the step is.

use super::halt::Halt;
use crate::error::Error;
use crate::linear::block::{triples, triples_mut};
use crate::linear::system_matrix::SystemMatrix;
use crate::linear::vector::{dot, norm};
use crate::report::Report;
use crate::step_filter::{AllowedStep, SystemRef, TrialStep};
use crate::system::Stiffness;

/// Iterate: deviations, with the positions, residual and energy at these deviations.
#[derive(Clone, Debug)]
pub(crate) struct Iterate {
    /// Deviations `d` from free flight, in m.
    pub deviation: Vec<f64>,
    /// Positions `x̃ + d`, in m.
    pub positions: Vec<f64>,
    /// Residual `φ`, in N.
    pub residual: Vec<f64>,
    /// Norm of the residual, in N. NaN or infinite if the forces are NaN or infinite.
    pub norm: f64,
    /// Incremental energy, in J, if it has been computed.
    energy: Option<f64>,
    /// Completed fraction of the prescribed motions. Below 1 only with a step filter, and never in
    /// a solution.
    pub obstacle_time: f64,
}

impl Iterate {
    /// Allocates an iterate of vectors with `length` entries.
    pub(crate) fn new(length: usize) -> Self {
        let zeros = vec![0.0; length];
        Self {
            deviation: zeros.clone(),
            positions: zeros.clone(),
            residual: zeros,
            norm: f64::NAN,
            energy: None,
            obstacle_time: 1.0,
        }
    }

    /// Returns whether the norm of the residual is at most `limit`, in N: `false` for a NaN, `true`
    /// if all particles are held.
    pub(crate) fn solves(&self, limit: f64) -> bool {
        self.norm <= limit
    }
}

/// Equations of one sub-step, and the counters of the solver's work.
pub(crate) struct StepEquations<'a, 'b> {
    pub system: &'a mut SystemRef<'b>,
    /// Inertia `m/(β dt)²` of each particle, in N/m.
    pub inertia: &'a [f64],
    pub held: &'a [bool],
    /// Positions `x̃` of the free particles in free flight, and prescribed positions of the held
    /// particles, in m.
    pub base: &'a [f64],
    /// Positions at the start of the sub-step, in m.
    pub start: &'a [f64],
    /// Norm of the residual at or below which the step is solved, in N.
    pub limit: f64,
    /// Unit of relative residuals, in N.
    pub unit: f64,
    /// Extrapolated positions, in m. Empty unless the error of the step bounds the solver's error.
    pub predicted: &'a [f64],
    /// Largest error of the solver, as a fraction of the distance from `predicted`.
    pub error_fraction: f64,
    pub report: &'a mut Report,
}

impl StepEquations<'_, '_> {
    /// Computes positions and residual of `iterate`.
    pub(crate) fn evaluate(&mut self, iterate: &mut Iterate) {
        self.place(iterate);
        let Iterate { deviation, positions, residual, norm: residual_norm, .. } = iterate;
        self.system.system().forces(positions, residual);
        self.report.force_evaluations += 1;
        let particles = triples_mut(residual).iter_mut().zip(triples(deviation));
        for (((phi, d), inertia), &held) in particles.zip(self.inertia).zip(self.held) {
            for (phi, d) in phi.iter_mut().zip(d) {
                *phi = if held { 0.0 } else { inertia * d - *phi };
            }
        }
        *residual_norm = norm(residual);
    }

    /// Computes the positions of `iterate`, and moves obstacles to the iterate's obstacle time.
    pub(crate) fn place(&mut self, iterate: &mut Iterate) {
        iterate.energy = None;
        for ((x, base), d) in iterate.positions.iter_mut().zip(self.base).zip(&iterate.deviation) {
            *x = base + d;
        }
        self.system.set_obstacle_time(iterate.obstacle_time);
    }

    /// Limits a step from `iterate` by `displacements`, in m, and an advance of the obstacle time;
    /// see [`StepFilter::limit_step`](crate::StepFilter::limit_step).
    pub(crate) fn limit_step(
        &mut self,
        iterate: &Iterate,
        displacements: &mut [f64],
        obstacle_advance: f64,
    ) -> AllowedStep {
        let (start, obstacle_time) = (&iterate.positions[..], iterate.obstacle_time);
        self.system.limit_step(TrialStep { start, displacements, obstacle_time, obstacle_advance })
    }

    /// Returns the incremental energy of the evaluated `iterate`, in J.
    pub(crate) fn energy(&mut self, iterate: &mut Iterate) -> f64 {
        if let Some(energy) = iterate.energy {
            return energy;
        }
        self.report.potential_evaluations += 1;
        let mut kinetic = 0.0;
        for (d, inertia) in triples(&iterate.deviation).iter().zip(self.inertia) {
            kinetic += 0.5 * inertia * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        }
        *iterate.energy.insert(kinetic + self.system.system().potential(&iterate.positions))
    }

    /// Returns the energy of the largest admissible error of the solver, `½ Σ m |θ e|²/(β dt)²`, in
    /// J. `e` is the error of a step that ends at `iterate`, and `θ` the admissible fraction of it.
    pub(crate) fn negligible_energy(&self, iterate: &Iterate) -> f64 {
        let ends = triples(&iterate.positions).iter().zip(triples(self.predicted));
        let mut sum = 0.0;
        for (((x, predicted), inertia), &held) in ends.zip(self.inertia).zip(self.held) {
            if !held {
                let error = [0, 1, 2].map(|k| self.error_fraction * (x[k] - predicted[k]));
                sum += 0.5 * inertia * dot(&error, &error);
            }
        }
        sum
    }

    /// Returns the kinetic energy of a straight motion to `iterate`, `½ Σ m |x − x₀|²/(β dt)²`, in
    /// J.
    pub(crate) fn kinetic(&self, iterate: &Iterate) -> f64 {
        let ends = triples(&iterate.positions).iter().zip(triples(self.start));
        let mut sum = 0.0;
        for (((x, start), inertia), &held) in ends.zip(self.inertia).zip(self.held) {
            if !held {
                let displacement = [x[0] - start[0], x[1] - start[1], x[2] - start[2]];
                sum += 0.5 * inertia * dot(&displacement, &displacement);
            }
        }
        sum
    }

    /// Assembles the system matrix of the evaluated `iterate`, with a stiffness of `kind`, into
    /// `system_matrix`.
    pub(crate) fn assemble(
        &mut self,
        iterate: &Iterate,
        kind: Stiffness,
        system_matrix: &mut SystemMatrix,
    ) -> Result<(), Halt> {
        self.report.stiffness_assemblies += 1;
        let matrix = &mut system_matrix.matrix;
        matrix.clear();
        self.system.system().stiffness(&iterate.positions, kind, matrix);
        if let Some([row, column]) = matrix.outside_sparsity() {
            return Err(Halt::Fatal(Error::OutsideSparsity { row, column }));
        }
        matrix.add_inertia(self.inertia, self.held);
        Ok(())
    }
}
