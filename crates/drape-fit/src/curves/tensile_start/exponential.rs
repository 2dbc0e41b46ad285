//! Initial guesses of a fit with an exponential toe.
//!
//! ```math
//! F = k\,T(\varepsilon) + k\mu\,T(\varepsilon)\,g(\varepsilon)
//!     + k_0\,\varepsilon + c\,g(\varepsilon)
//! ```
//!
//! For a given steepness, end of the toe and friction length, the load is linear in the stiffness
//! `$k$` of the toe, `$k$` times the ratio `$\mu$` of the friction, the base stiffness `$k_0$` and
//! the plateau `$c$` of the friction, where `$T$` is the toe of unit stiffness and `$g$` the state
//! of the friction. The friction of the line is left out of a guess. Steepnesses, ends and lengths
//! are tried on a grid.

use drape_fabric::{
    Buckling, ExponentialToe, FRICTION_RATIO_MAX, ProportionalFriction, STEEPNESS_MIN,
    TractionBackbone, TractionFriction, TractionLaw,
};
use drape_lm::Parameter;

use crate::curves::tensile_form::TensileForm;
use crate::curves::tensile_start::{GROWTHS, InitialGuess, Start};
use crate::forward::friction_path::FrictionPath;
use crate::regression::linear::{LinearFit, Solution};
use crate::regression::residuals::NamedParameter;
use crate::settings::model::Toe;

/// Steepnesses of the toe to start from: from nearly a line to a toe that is flat for two thirds of
/// its length.
const STEEPNESSES: [f64; 5] = [0.3, 1.0, 2.5, 5.0, 10.0];
/// Ends of the toe to start from, over the largest strain.
const TOES: [f64; 4] = [0.3, 0.55, 0.8, 1.0];
/// Friction lengths to start from, over the largest strain.
const LENGTHS: [f64; 5] = [0.01, 0.04, 0.12, 0.35, 1.0];
/// Largest steepness of a toe: beyond it the toe is a corner at any sampling.
const LARGEST_STEEPNESS: f64 = 40.0;
/// Least end of a toe over the largest strain.
const LEAST_TOE: f64 = 0.02;
/// Largest plateau of the friction over the largest load: more would be friction without tension.
const LARGEST_PLATEAU: f64 = 0.25;

/// Point of the grid.
#[derive(Clone, Copy)]
struct GridPoint {
    steepness: f64,
    toe: f64,
    growth: f64,
}

impl InitialGuess {
    /// Returns the guess of `form` with the best friction length for each point of the grid.
    pub(super) fn exponentials(&self, form: &TensileForm) -> Vec<Start> {
        let growths = if form.toe == Toe::Moving { &GROWTHS[..] } else { &[1.0] };
        let ends = TOES.iter().flat_map(|&toe| growths.iter().map(move |&growth| (toe, growth)));
        let places = ends.flat_map(|(toe, growth)| {
            STEEPNESSES.map(|steepness| GridPoint { steepness, toe: toe * self.top_strain, growth })
        });
        let states = self.friction_states(form);
        places.filter_map(|point| self.exponential_at(form, point, &states)).collect()
    }

    /// Returns the states of the friction along the curve for each length of the grid; none for a
    /// `form` without recovery.
    fn friction_states(&self, form: &TensileForm) -> Vec<Vec<f64>> {
        if !form.strip.recovers {
            return Vec::new();
        }
        let path = FrictionPath::new(&self.strains);
        LENGTHS
            .into_iter()
            .map(|length| path.unit_friction(length * self.top_strain).constant)
            .collect()
    }

    /// Returns the guess of `form` with the best friction length at a point of the grid.
    fn exponential_at(
        &self,
        form: &TensileForm,
        point: GridPoint,
        states: &[Vec<f64>],
    ) -> Option<Start> {
        // Columns: the toe, the strain, then for each length the friction of the toe and its state.
        let toe = self.column(&unit_toe(point));
        let mut columns = vec![toe.clone(), self.strains.clone()];
        for state in states {
            columns.push(toe.iter().zip(state).map(|(toe, state)| toe * state).collect());
            columns.push(state.clone());
        }
        let fit = LinearFit::new(&columns, &self.load);

        let elastic = if form.has_line() { &[0, 1][..] } else { &[0] };
        if states.is_empty() {
            let Solution { coefficients, residual_sum } = fit.solve(elastic)?;
            let guess = Guess { point, elastic: &coefficients, friction: None };
            return self.exponential_start(form, residual_sum, guess);
        }

        let mut starts = Vec::new();
        for (index, length) in LENGTHS.iter().enumerate().take(states.len()) {
            let friction = 2 + 2 * index;
            let mut chosen = [elastic, &[friction]].concat();
            chosen.extend(form.has_plateau().then_some(friction + 1));
            let Some(Solution { coefficients, residual_sum }) = fit.solve(&chosen) else {
                continue;
            };
            let (elastic, friction) = coefficients.split_at(elastic.len());
            let friction = Some((friction, length * self.top_strain));
            starts.extend(self.exponential_start(
                form,
                residual_sum,
                Guess { point, elastic, friction },
            ));
        }
        starts.into_iter().min_by(|a, b| a.residual_sum.total_cmp(&b.residual_sum))
    }

    /// Returns the start of a `guess`; `None` if its toe or its friction is negative.
    fn exponential_start(
        &self,
        form: &TensileForm,
        residual_sum: f64,
        guess: Guess<'_>,
    ) -> Option<Start> {
        let GridPoint { steepness, toe, growth } = guess.point;
        let stiffness = guess.elastic[0];
        let mut values = vec![stiffness, steepness, toe];
        values.extend((form.toe == Toe::Moving).then_some(growth));
        values.extend(guess.elastic.get(1).map(|base| base.max(0.0)));
        if let Some((friction, length)) = guess.friction {
            let ratio = friction[0] / stiffness;
            if ratio <= 0.0 {
                return None;
            }
            values.extend([ratio.min(0.95 * FRICTION_RATIO_MAX), length]);
            values.extend(friction.get(1).map(|plateau| plateau.max(0.0)));
        }
        (stiffness > 0.0).then_some(Start { residual_sum, values })
    }

    /// Returns the guess of `form` for a curve whose linear fit has no solution.
    pub(super) fn exponential_fallback(&self, form: &TensileForm) -> Start {
        let strain = self.top_strain;
        let mut values = vec![self.stiffness, 2.0, 0.8 * strain];
        values.extend((form.toe == Toe::Moving).then_some(1.2));
        values.extend(form.has_line().then_some(0.1 * self.stiffness));
        if form.strip.recovers {
            values.extend([0.5, 0.1 * strain]);
            values.extend(form.has_plateau().then_some(0.01 * self.top_load));
        }
        Start { residual_sum: 0.0, values }
    }

    /// Returns names, scales and bounds of the parameters of the law of `form`, in the order in
    /// which [`TensileForm::law`] takes them.
    ///
    /// The toe ends within the test: beyond its largest strain the law continues as its tangent.
    pub(super) fn exponential_bounds(&self, form: &TensileForm) -> Vec<NamedParameter> {
        let (strain, load, k) = (self.top_strain, self.top_load, self.stiffness);
        let mut named = Vec::new();
        let mut push = |name, parameter| named.push(NamedParameter::new(name, parameter));
        push("toe_stiffness", Parameter::new(k).between(1e-3 * k, 1e3 * k));
        let steepness = Parameter::new(2.0).between(STEEPNESS_MIN, LARGEST_STEEPNESS);
        push("steepness", steepness);
        push("toe_end", Parameter::new(strain).between(LEAST_TOE * strain, strain));
        if form.toe == Toe::Moving {
            push("toe_growth", Parameter::new(1.2).between(1.0, 2.0));
        }

        if form.has_line() {
            let base = Parameter::new(0.0).with_scale(0.1 * k).between(0.0, 10.0 * k);
            push("base_stiffness", base);
        }

        if form.strip.recovers {
            let ratio = Parameter::new(0.5).between(0.0, FRICTION_RATIO_MAX);
            push("friction_ratio", ratio.with_scale(0.1));
            push("friction_length", self.length());
            if form.has_plateau() {
                let plateau = Parameter::new(0.0).with_scale(0.01 * load);
                push("friction_plateau", plateau.between(0.0, LARGEST_PLATEAU * load));
            }
        }
        named
    }
}

/// Coefficients of the linear fit at a point of the grid.
struct Guess<'a> {
    point: GridPoint,
    /// Stiffness of the toe, and of the line.
    elastic: &'a [f64],
    /// Friction of the toe and plateau, with the friction length; `None` without recovery.
    friction: Option<(&'a [f64], f64)>,
}

/// Returns the law of a toe of unit stiffness at `point`, without friction.
fn unit_toe(point: GridPoint) -> TractionLaw {
    let GridPoint { steepness, toe, growth } = point;
    let friction = ProportionalFriction { ratio: 0.0, plateau: 0.0, length: toe };
    TractionLaw {
        backbone: TractionBackbone::Exponential(ExponentialToe {
            base_stiffness: 0.0,
            stiffness: 1.0,
            steepness,
            toe_strain: toe,
            toe_strain_after: growth * toe,
        }),
        friction: TractionFriction::Proportional(friction),
        buckling: Buckling::default(),
    }
}
