//! Backbone with friction along a hysteresis loop, for bending and shear: its parameters, its law
//! and its loads.
//!
//! ```math
//! F = F_0 + F_e(q) + P\,[u(\eta x) + w\,u(x)], \qquad u = c + \gamma g
//! ```
//!
//! with the elastic load `$F_e$`, a line or a [`Varying`] stiffness, the fast plateau `$P$`, the
//! slow plateau `$wP$`, the lengths `$\eta x$` and `$x$`, and the unit friction `$u$` of
//! `forward::friction_path` with the growth `$\gamma$` of the plateau. One element has `$w = 0$`,
//! `$\eta = 1$`. `loop_start` builds the candidates of `bending` and `shear` from these forms.

use drape_fabric::{BlimanSorine, Dahl, Varying};
use nalgebra::DMatrix;

use crate::forward::friction_path::{FrictionPath, UnitFriction};
use crate::regression::residuals::ForwardModel;
use crate::settings::model::{FrictionOrder, LoopModel, Plateau};

/// Elastic load of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Elastic {
    /// Line.
    Line,
    /// Stiffness that changes along the test.
    Varying,
}

/// Parameters that the law of a loop has.
#[derive(Clone, Copy)]
pub(crate) struct LoopForm {
    pub(crate) elastic: Elastic,
    pub(crate) order: FrictionOrder,
    pub(crate) plateau: Plateau,
}

/// Elastic load of a law with its numbers.
#[derive(Clone, Copy)]
pub(crate) enum LoopBackbone {
    Line(f64),
    Varying(Varying),
}

/// Law of a loop, and the zero of its load.
#[derive(Clone, Copy)]
pub(crate) struct LoopLaw {
    pub(crate) backbone: LoopBackbone,
    pub(crate) zero: f64,
    /// Growth of the plateau per unit of the deformation.
    pub(crate) growth: f64,
    pub(crate) friction: BlimanSorine,
}

impl LoopForm {
    /// Returns the forms that the law `model` admits with the given `plateaus`, in the order of
    /// preference. A stiffness that changes comes after every line, with one friction element.
    pub(crate) fn admitted(model: Option<LoopModel>, plateaus: &[Plateau]) -> Vec<Self> {
        let lines = FrictionOrder::ALL.map(|order| (Elastic::Line, order));
        let forms = lines.into_iter().chain([(Elastic::Varying, FrictionOrder::First)]);
        let wanted = forms.filter(|(elastic, order)| match model {
            Some(LoopModel::Linear(wanted)) => *elastic == Elastic::Line && *order == wanted,
            Some(LoopModel::Varying) => *elastic == Elastic::Varying,
            Some(LoopModel::Piecewise) | None => true,
        });
        wanted
            .flat_map(|(elastic, order)| {
                plateaus.iter().map(move |&plateau| Self { elastic, order, plateau })
            })
            .collect()
    }

    /// Returns the model that admits this form and no other, except forms with another `plateau`.
    pub(crate) fn model(self) -> LoopModel {
        match self.elastic {
            Elastic::Line => LoopModel::Linear(self.order),
            Elastic::Varying => LoopModel::Varying,
        }
    }

    /// Returns the name of elastic load and friction in reports.
    pub(crate) fn name(self) -> String {
        self.model().title()
    }

    /// Returns whether the `plateau` grows.
    pub(crate) fn has_growth(self) -> bool {
        self.plateau == Plateau::Growing
    }

    /// Returns the number of parameters of the elastic load.
    fn elastic_count(self) -> usize {
        if self.elastic == Elastic::Line { 1 } else { 3 }
    }

    /// Returns the forward model of the form along `history`, whose friction path is `path`.
    pub(crate) fn forward<'a>(
        self,
        history: &'a [f64],
        path: &'a FrictionPath,
    ) -> Box<dyn ForwardModel + 'a> {
        Box::new(LoopForward { history, path, form: self })
    }

    /// Returns the law with the parameters `p`, in the order of `MeasuredLoop::starts`: the
    /// parameters of the elastic load, the zero, the growth if there is one, and the parameters of
    /// the friction.
    pub(crate) fn law(self, p: &[f64]) -> LoopLaw {
        let (elastic, rest) = p.split_at(self.elastic_count());
        let backbone = match *elastic {
            [initial_stiffness, final_stiffness, transition] => {
                LoopBackbone::Varying(Varying { initial_stiffness, final_stiffness, transition })
            }
            _ => LoopBackbone::Line(elastic[0]),
        };
        let (zero, rest) = (rest[0], &rest[1..]);
        let (growth, rest) = if self.has_growth() { (rest[0], &rest[1..]) } else { (0.0, rest) };
        LoopLaw { backbone, zero, growth, friction: friction(rest) }
    }
}

/// Returns the elastic load at the deformation `q`.
impl LoopBackbone {
    fn load(&self, q: f64) -> f64 {
        match self {
            Self::Line(stiffness) => stiffness * q,
            Self::Varying(varying) => varying.respond(q).load,
        }
    }
}

/// Returns the friction with the parameters `p`: plateau and length. Two elements add the slow
/// plateau over the fast plateau, and the fast length over the slow length.
pub(crate) fn friction(p: &[f64]) -> BlimanSorine {
    match *p {
        [plateau, length] => Dahl { plateau, length }.into(),
        [plateau, length, slow, ratio] => {
            let fast = Dahl { plateau, length: ratio * length };
            BlimanSorine { elements: [fast, Dahl { plateau: slow * plateau, length }] }
        }
        _ => BlimanSorine::none(),
    }
}

/// Returns the parts of the load of a [`Varying`] stiffness at `q` that belong to an initial and to
/// a final stiffness of one.
pub(crate) fn varying_parts(q: f64, transition: f64) -> [f64; 2] {
    [1.0, 0.0].map(|initial_stiffness| {
        let final_stiffness = 1.0 - initial_stiffness;
        Varying { initial_stiffness, final_stiffness, transition }.respond(q).load
    })
}

/// Forward model of a loop along a history.
struct LoopForward<'a> {
    history: &'a [f64],
    path: &'a FrictionPath,
    form: LoopForm,
}

/// Friction element with its unit loads along the history.
struct Element {
    plateau: f64,
    unit: UnitFriction,
}

impl Element {
    /// Returns load, slope by the length, and growing load of a unit plateau with the given
    /// `growth`, at the point `i`.
    fn derivatives(&self, i: usize, growth: f64) -> [f64; 3] {
        let unit = &self.unit;
        let load = unit.constant[i] + growth * unit.growing[i];
        let slope = unit.constant_slope[i] + growth * unit.growing_slope[i];
        [load, slope, unit.growing[i]]
    }
}

impl LoopForward<'_> {
    /// Returns the friction elements of `law` with their unit loads.
    fn elements(&self, law: &LoopLaw) -> Vec<Element> {
        let present = law.friction.elements.into_iter();
        // The second element of the first order is absent; it has no parameters either.
        let count = if self.form.order == FrictionOrder::First { 1 } else { 2 };
        present
            .take(count)
            .map(|dahl| Element {
                plateau: dahl.plateau,
                unit: self.path.unit_friction(dahl.length),
            })
            .collect()
    }

    /// Writes the derivatives by the parameters of the elastic load of `law` to `out`.
    fn elastic_jacobian(&self, law: &LoopLaw, out: &mut DMatrix<f64>) {
        for (i, &q) in self.history.iter().enumerate() {
            match law.backbone {
                LoopBackbone::Line(_) => out[(i, 0)] = q,
                LoopBackbone::Varying(varying) => {
                    let Varying { initial_stiffness, final_stiffness, transition } = varying;
                    let [initial, last] = varying_parts(q, transition);
                    // With s = (1 + u²)^{-1/2} and u = q/q_t, ds/dq_t = u² s³/q_t.
                    let square = (q / transition).powi(2);
                    let slope = square / ((1.0 + square) * transition);
                    out[(i, 0)] = initial;
                    out[(i, 1)] = last;
                    out[(i, 2)] = (initial_stiffness - final_stiffness) * initial * slope;
                }
            }
        }
    }
}

impl ForwardModel for LoopForward<'_> {
    fn loads(&self, p: &[f64], out: &mut [f64]) {
        let law = self.form.law(p);
        for (load, q) in out.iter_mut().zip(self.history) {
            *load = law.zero + law.backbone.load(*q);
        }
        for Element { plateau, unit } in &self.elements(&law) {
            let columns = unit.constant.iter().zip(&unit.growing);
            for (load, (constant, growing)) in out.iter_mut().zip(columns) {
                *load += plateau * (constant + law.growth * growing);
            }
        }
    }

    fn jacobian(&self, p: &[f64], out: &mut DMatrix<f64>) -> bool {
        let law = self.form.law(p);
        self.elastic_jacobian(&law, out);

        let elements = self.elements(&law);
        let zero = self.form.elastic_count();
        let first = if self.form.has_growth() { zero + 2 } else { zero + 1 };
        let (plateau, length) = (p[first], p[first + 1]);
        let (slow, ratio) = match elements.len() {
            2 => (p[first + 2], p[first + 3]),
            _ => (0.0, 1.0),
        };
        for i in 0..self.history.len() {
            let fast = elements[0].derivatives(i, law.growth);
            let [slow_load, slow_slope, slow_growing] = match elements.get(1) {
                Some(element) => element.derivatives(i, law.growth),
                None => [0.0; 3],
            };
            out[(i, zero)] = 1.0;
            if self.form.has_growth() {
                out[(i, zero + 1)] = plateau * (fast[2] + slow * slow_growing);
            }
            out[(i, first)] = fast[0] + slow * slow_load;
            out[(i, first + 1)] = plateau * (ratio * fast[1] + slow * slow_slope);
            if elements.len() == 2 {
                out[(i, first + 2)] = plateau * slow_load;
                out[(i, first + 3)] = plateau * length * fast[1];
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_derivatives_of_every_form_are_those_of_differences() {
        let history: Vec<f64> = (0..120).map(|i| 0.14 * (0.11 * f64::from(i)).sin()).collect();
        let path = FrictionPath::new(&history);
        let plateaus = [Plateau::Constant, Plateau::Growing];
        for form in LoopForm::admitted(None, &plateaus) {
            let mut p = match form.elastic {
                Elastic::Line => vec![30.0, 0.1],
                Elastic::Varying => vec![20.0, 60.0, 0.05, 0.1],
            };
            p.extend(form.has_growth().then_some(6.0));
            p.extend([0.6, 0.03]);
            match form.order {
                FrictionOrder::First => {}
                FrictionOrder::TwoElements => p.extend([0.5, 0.2]),
                FrictionOrder::Second => p.extend([-0.4, 0.2]),
            }
            let forward = LoopForward { history: &history, path: &path, form };
            let mut jacobian = DMatrix::zeros(history.len(), p.len());
            assert!(forward.jacobian(&p, &mut jacobian));
            let loads = |p: &[f64]| {
                let mut out = vec![0.0; history.len()];
                forward.loads(p, &mut out);
                out
            };
            for j in 0..p.len() {
                let step = 1e-6 * p[j].abs();
                let (mut more, mut less) = (p.clone(), p.clone());
                (more[j], less[j]) = (more[j] + step, less[j] - step);
                let (more, less) = (loads(&more), loads(&less));
                for i in 0..history.len() {
                    let difference = (more[i] - less[i]) / (2.0 * step);
                    let error = (jacobian[(i, j)] - difference).abs() * p[j].abs();
                    // Rounding of 1e-15 over steps of 1e-6, in loads of some N/m.
                    assert!(error < 1e-7, "{} parameter {j}: {error}", form.name());
                }
            }
        }
    }
}
