//! Friction of one element: the Dahl model, which is Bliman–Sorine friction of first order.

use crate::error::Error;
use crate::response::Response;
use crate::slip::Slip;

/// Dahl friction element, whose load rises like the load of a spring and saturates at a plateau.
///
/// Along a path of length `$u = \int|\mathrm{d}q|$` in the direction `$\sigma = \pm 1$`, with the
/// plateau `$F_c$`, the friction length `$x_f$` and the weight `$w$` of the plateau,
///
/// ```math
/// \frac{\mathrm{d}F}{\mathrm{d}u} = \frac{\sigma F_c\,w(u) - F}{x_f}
/// ```
///
/// This is Dahl's model with exponent one \[Dahl68\], the first-order model of \[BS95\] and eq. 1
/// of \[NB04\]. The rate model of \[THK03, eq. 3\] becomes this model with `$D_1 = 2F_c$` and
/// `$\alpha = 1/x_f$`. Every method returns the exact solution for a weight that is linear along
/// the piece. For `$w = 1$` and a slip `$\Delta q$` the load changes from `$F_0$` to
///
/// ```math
/// F_1 = \sigma F_c + (F_0 - \sigma F_c)\,e^{-|\Delta q|/x_f}
/// ```
///
/// Two half steps therefore equal one step, and the result does not depend on how a path is
/// divided.
///
/// The load has the sign of the slip: a deformation that increases raises it. It is the load that
/// deforms, so the force of the friction on a body that moves is its negative.
///
/// The caller chooses the units of load and deformation: N/m and a ratio for the tension of a yarn,
/// N and 1/m for a bending moment per width.
///
/// ```
/// use drape_hysteresis::Dahl;
///
/// let element = Dahl::new(6e-4, 4.0)?;
/// let half = element.advance(element.advance(0.0, 1.0), 1.0);
/// assert!((half - element.advance(0.0, 2.0)).abs() < 1e-18);
/// assert!((element.advance(0.0, 200.0) - 6e-4).abs() < 1e-18);
/// # Ok::<(), drape_hysteresis::Error>(())
/// ```
///
/// [`Dahl::new`] checks its numbers. An element that is written as a literal is not checked:
/// [`Dahl::check`] does that.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Dahl {
    /// Coulomb plateau `$F_c$`, in the unit of the load. Zero switches the element off. Only the
    /// slow element of a second-order model has a negative plateau.
    pub plateau: f64,
    /// Friction length `$x_f$`, in the unit of the deformation, greater than 0. The surfaces hardly
    /// slide over a shorter path (pre-sliding).
    pub length: f64,
}

/// Change of the load at the start of a piece over the piece.
struct Decay {
    /// Fraction of the load that is kept.
    kept: f64,
    /// Fraction of the load that is lost, `1.0 - kept`.
    lost: f64,
}

impl Dahl {
    /// Element without friction.
    pub const NONE: Self = Self { plateau: 0.0, length: 1.0 };

    /// Returns an element with the given `plateau` (in the unit of the load) and friction `length`
    /// (in the unit of the deformation).
    ///
    /// # Errors
    /// The plateau is negative, the length is not positive, or one of them is not finite.
    pub fn new(plateau: f64, length: f64) -> Result<Self, Error> {
        let element = Self { plateau, length };
        element.check()?;
        Ok(element)
    }

    /// Checks that the plateau is at least 0 and the length is greater than 0, both finite.
    ///
    /// # Errors
    /// [`Error::Plateau`] and [`Error::Length`].
    pub fn check(&self) -> Result<(), Error> {
        if !(self.plateau >= 0.0 && self.plateau.is_finite()) {
            return Err(Error::Plateau(self.plateau));
        }
        if !(self.length > 0.0 && self.length.is_finite()) {
            return Err(Error::Length(self.length));
        }
        Ok(())
    }

    /// Returns the stiffness at the start of a loading, `$F_c/x_f$`, in load per deformation.
    #[must_use]
    pub fn presliding_stiffness(&self) -> f64 {
        self.plateau / self.length
    }

    /// Returns the decay of the load over a piece of the given `amount`.
    fn decay(&self, amount: f64) -> Decay {
        let lost = -(-amount.abs() / self.length).exp_m1();
        Decay { kept: 1.0 - lost, lost }
    }

    /// Returns the load at the end of the piece `slip` that began with `load`, in the unit of the
    /// load.
    #[must_use]
    pub fn advance(&self, load: f64, slip: impl Into<Slip>) -> f64 {
        let slip = slip.into();
        if self.plateau == 0.0 || slip.amount == 0.0 {
            return load;
        }
        let Decay { kept, lost } = self.decay(slip.amount);
        let plateau = self.plateau.copysign(self.plateau * slip.amount);
        let ramp = (slip.weight_to - slip.weight_from) / slip.amount.abs();
        let lag = slip.amount.abs() - self.length * lost;
        load * kept + plateau * (slip.weight_from * lost + ramp * lag)
    }

    /// Returns the load at the end of the piece `slip` that began with `load`, and the derivative
    /// of this load with respect to `slip.amount`, in load per deformation.
    ///
    /// At a reversal the derivative has two values. An amount of `+0.0` gives the derivative for an
    /// increasing deformation, and `-0.0` gives the derivative for a decreasing deformation.
    #[must_use]
    pub fn respond(&self, load: f64, slip: impl Into<Slip>) -> Response {
        let slip = slip.into();
        if self.plateau == 0.0 {
            return Response { load, tangent: 0.0 };
        }
        let end = self.advance(load, slip);
        let tangent = (self.plateau * slip.weight_to - slip.amount.signum() * end) / self.length;
        Response { load: end, tangent }
    }

    /// Returns the work of the load over the piece `slip` that began with `load`,
    /// `$\int F\,\mathrm{d}q$`, in load times deformation.
    ///
    /// If `load` is the load at the start of a time step, the work is the potential of the element
    /// within the step: its derivative with respect to `slip.amount` is [`Dahl::advance`].
    #[must_use]
    pub fn work(&self, load: f64, slip: impl Into<Slip>) -> f64 {
        let slip = slip.into();
        if self.plateau == 0.0 || slip.amount == 0.0 {
            return load * slip.amount;
        }
        let Decay { lost, .. } = self.decay(slip.amount);
        let path = slip.amount.abs();
        let plateau = self.plateau.copysign(self.plateau * slip.amount);
        let ramp = (slip.weight_to - slip.weight_from) / path;
        let lag = path - self.length * lost;
        let magnitude = load * self.length * lost
            + plateau * (slip.weight_from * lag + ramp * (0.5 * path * path - self.length * lag));
        magnitude.copysign(magnitude * slip.amount)
    }

    /// Returns the energy that the element gives back when it is unloaded from `load`,
    /// `$F^2 x_f / 2F_c$`, in load times deformation.
    #[must_use]
    pub fn stored(&self, load: f64) -> f64 {
        if self.plateau == 0.0 { 0.0 } else { 0.5 * load * load * self.length / self.plateau }
    }

    /// Returns the energy that is dissipated over the piece `slip` that began with `load`: the work
    /// ([`Dahl::work`]) less the change of the stored energy ([`Dahl::stored`]), in load times
    /// deformation.
    ///
    /// With a weight of one the energy is `$\int F^2/F_c\,\mathrm{d}u \ge 0$`. With a varying
    /// weight the energy may be negative over part of a cycle, but is positive over every closed
    /// cycle.
    #[must_use]
    pub fn dissipated(&self, load: f64, slip: impl Into<Slip>) -> f64 {
        let slip = slip.into();
        let end = self.advance(load, slip);
        self.work(load, slip) - (self.stored(end) - self.stored(load))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ELEMENT: Dahl = Dahl { plateau: 0.7, length: 0.03 };

    fn pieces() -> Vec<(f64, Slip)> {
        let mut pieces = Vec::new();
        for load in [-0.7, -0.2, 0.0, 0.4, 0.9] {
            for amount in [-0.3, -0.02, -1e-6, 1e-7, 0.004, 0.05, 2.0] {
                for (from, to) in [(1.0, 1.0), (0.2, 1.0), (1.4, 0.5), (0.0, 0.8)] {
                    pieces.push((load, Slip::weighted(amount, from, to)));
                }
            }
        }
        pieces
    }

    #[test]
    fn two_half_steps_equal_one_step() {
        for (load, slip) in pieces() {
            let half = 0.5 * slip.amount;
            let middle_weight = 0.5 * (slip.weight_from + slip.weight_to);
            let first = Slip::weighted(half, slip.weight_from, middle_weight);
            let second = Slip::weighted(half, middle_weight, slip.weight_to);
            let middle = ELEMENT.advance(load, first);
            let (two, one) = (ELEMENT.advance(middle, second), ELEMENT.advance(load, slip));
            assert!((two - one).abs() < 1e-14, "{load} {slip:?}: {two} against {one}");
            let two = ELEMENT.work(load, first) + ELEMENT.work(middle, second);
            let one = ELEMENT.work(load, slip);
            assert!((two - one).abs() < 1e-14, "{load} {slip:?}: work {two} against {one}");
        }
    }

    #[test]
    fn the_load_solves_the_differential_equation() {
        // Fourth-order Runge–Kutta with 4000 stages is good to about 1e-11 here.
        for (load, slip) in pieces().into_iter().filter(|(_, slip)| slip.amount.abs() < 0.4) {
            let steps = 4000;
            let du = slip.amount.abs() / f64::from(steps);
            let rate = |u: f64, f: f64| {
                let part = u / slip.amount.abs();
                let weight = slip.weight_from + (slip.weight_to - slip.weight_from) * part;
                (slip.amount.signum() * ELEMENT.plateau * weight - f) / ELEMENT.length
            };
            let mut f = load;
            for step in 0..steps {
                let u = f64::from(step) * du;
                let k1 = rate(u, f);
                let k2 = rate(u + 0.5 * du, f + 0.5 * du * k1);
                let k3 = rate(u + 0.5 * du, f + 0.5 * du * k2);
                let k4 = rate(u + du, f + du * k3);
                f += du / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
            }
            let exact = ELEMENT.advance(load, slip);
            assert!((f - exact).abs() < 1e-10, "{load} {slip:?}: {exact}, integrated {f}");
        }
    }

    #[test]
    fn work_is_the_potential_of_the_load_and_the_tangent_its_slope() {
        for (load, slip) in pieces().into_iter().filter(|(_, s)| s.amount.abs() > 1e-3) {
            // The end weight moves with the amount: the weight is a function of the deformation.
            let ramp = (slip.weight_to - slip.weight_from) / slip.amount;
            let at = |amount: f64| {
                Slip::weighted(amount, slip.weight_from, slip.weight_from + ramp * amount)
            };
            let d = 1e-5;
            let around = |f: &dyn Fn(Slip) -> f64, k: f64| f(at(slip.amount + k * d)) / (12.0 * d);
            let slope = |f: &dyn Fn(Slip) -> f64| {
                around(f, -2.0) - 8.0 * around(f, -1.0) + 8.0 * around(f, 1.0) - around(f, 2.0)
            };
            let force = slope(&|s| ELEMENT.work(load, s));
            assert!((force - ELEMENT.advance(load, slip)).abs() < 1e-9, "{load} {slip:?}: {force}");
            let tangent = slope(&|s| ELEMENT.advance(load, s));
            let exact = ELEMENT.respond(load, slip).tangent;
            assert!((tangent - exact).abs() < 1e-7, "{load} {slip:?}: {tangent} against {exact}");
        }
    }

    #[test]
    fn an_element_without_plateau_keeps_its_load_and_works_with_it() {
        // The state keeps what was there before the plateau became zero.
        let without = Dahl { plateau: 0.0, length: 0.03 };
        for (load, amount) in [(0.4, 0.1), (0.4, -0.2), (-0.3, 0.5), (0.0, 0.1)] {
            let work = without.work(load, amount);
            assert!(work == load * amount, "{load} {amount}: {work}");
            assert!(ELEMENT.work(load, 0.0) == 0.0, "{load}");
        }
    }

    #[test]
    fn a_reversal_is_continuous_from_every_state_and_has_two_slopes() {
        for load in [-0.7, -0.3, 0.0, 0.5, 0.7] {
            for tiny in [1e-9, -1e-9] {
                let change = ELEMENT.advance(load, tiny) - load;
                assert!(change.abs() < 1e-6, "{load}: jumped by {change}");
            }
            let stiffness = ELEMENT.presliding_stiffness();
            let [up, down] = [0.0, -0.0].map(|amount| ELEMENT.respond(load, amount).tangent);
            assert!((up + down - 2.0 * stiffness).abs() < 1e-12, "{load}: {up} {down}");
        }
    }

    #[test]
    fn closed_loops_dissipate_and_the_steady_loop_has_the_known_area() {
        let (amplitude, plateau, length) = (0.05, ELEMENT.plateau, ELEMENT.length);
        let mut load = 0.0;
        let mut lost = 0.0;
        for _ in 0..40 {
            lost = 0.0;
            for slip in [2.0 * amplitude, -2.0 * amplitude] {
                lost += ELEMENT.work(load, slip);
                load = ELEMENT.advance(load, slip);
            }
        }
        let exact = 4.0 * plateau * (amplitude - length * (amplitude / length).tanh());
        assert!((lost - exact).abs() < 1e-9 * exact, "area {lost}, exact {exact}");
        let mut state = 12_345_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        let mut load = 0.0;
        for _ in 0..1000 {
            let slip = 0.2 * random();
            let lost = ELEMENT.dissipated(load, slip);
            assert!(lost >= -1e-16, "piece {slip} from {load} gained {lost}");
            load = ELEMENT.advance(load, slip);
        }
    }

    #[test]
    fn a_closed_loop_under_a_varying_weight_dissipates() {
        // A weight that falls to zero at one end, as in the priming zone of a yarn.
        for length in [0.001, 0.01, 0.1, 1.0] {
            let element = Dahl::new(1.0, length).expect("a friction");
            let mut load = 0.0;
            let mut lost = 0.0;
            for _ in 0..2000 {
                let up = Slip::weighted(0.05, 0.0, 1.0);
                let down = Slip::weighted(-0.05, 1.0, 0.0);
                lost = element.work(load, up);
                load = element.advance(load, up);
                lost += element.work(load, down);
                load = element.advance(load, down);
            }
            assert!(lost > 0.0, "length {length}: loop gained {lost}");
        }
    }
}
