//! Friction of one or two elements: the Bliman–Sorine model, which the laws of a fabric use.

use crate::dahl::Dahl;
use crate::error::Error;
use crate::response::Response;
use crate::slip::Slip;

/// Loads of the two elements of a [`BlimanSorine`] friction, in the unit of the load. The loads are
/// the memory of the friction.
pub type Loads = [f64; 2];

/// Bliman–Sorine friction: one or two [`Dahl`] elements in parallel.
///
/// * First order: one element.
/// * Second order \[BS95; NB04, eq. 2\]: a fast element of plateau `$f_1$` and length `$\eta x_f$`
///   and a slow, negative one of plateau `$-f_2$` and length `$x_f$`, with `$f_1 > f_2 \ge 0$` and
///   `$0 < \eta < 1$`. From rest the load is
///   `$F = f_1\left(1 - e^{-u/\eta x_f}\right) - f_2\left(1 - e^{-u/x_f}\right)$`: it overshoots
///   (stiction) and settles at `$f_1 - f_2$` (the Stribeck drop).
/// * Two positive elements: loops whose width depends on their amplitude, as fabrics show at small
///   deformation.
///
/// ```
/// use drape_hysteresis::BlimanSorine;
///
/// let friction = BlimanSorine::second_order(1.0, 0.4, 0.2, 0.1)?;
/// let load = |slip: f64| friction.respond([0.0, 0.0], slip).load;
/// assert!(load(0.05) > friction.plateau(), "the load overshoots");
/// assert!((load(10.0) - 0.6).abs() < 1e-12, "and settles");
/// # Ok::<(), drape_hysteresis::Error>(())
/// ```
///
/// The constructors check their numbers, so that no closed cycle creates energy. Elements that are
/// written as literals are not checked: [`BlimanSorine::check`] does that.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BlimanSorine {
    /// The two elements. An element with a plateau of zero has no effect.
    pub elements: [Dahl; 2],
}

impl Default for BlimanSorine {
    fn default() -> Self {
        Self::none()
    }
}

impl From<Dahl> for BlimanSorine {
    /// Returns the friction of one element. The element is not checked.
    fn from(element: Dahl) -> Self {
        Self { elements: [element, Dahl::NONE] }
    }
}

impl BlimanSorine {
    /// Returns a friction without elements, whose load is zero.
    #[must_use]
    pub fn none() -> Self {
        Self { elements: [Dahl::NONE; 2] }
    }

    /// Returns the friction of one element with the given `plateau` (in the unit of the load) and
    /// friction `length` (in the unit of the deformation).
    ///
    /// # Errors
    /// The plateau is negative, the length is not positive, or one of them is not finite.
    pub fn first_order(plateau: f64, length: f64) -> Result<Self, Error> {
        Ok(Dahl::new(plateau, length)?.into())
    }

    /// Returns the friction of a fast element and a slow element of opposite sign.
    ///
    /// The plateaus are `fast_plateau` ≥ `slow_plateau` ≥ 0 (in the unit of the load). The friction
    /// lengths are `ratio × length` and `length` (in the unit of the deformation) with
    /// 0 < `ratio` < 1.
    ///
    /// # Errors
    /// A number is outside its range or not finite.
    pub fn second_order(
        fast_plateau: f64,
        slow_plateau: f64,
        ratio: f64,
        length: f64,
    ) -> Result<Self, Error> {
        let fast = Dahl::new(fast_plateau, ratio * length)?;
        let slow = Dahl { plateau: -slow_plateau, length };
        if !(slow_plateau >= 0.0) {
            return Err(Error::SlowPlateau { fast: fast_plateau, slow: slow_plateau });
        }
        Self::parallel(fast, slow)
    }

    /// Returns the friction of the elements `first` and `second` in parallel. The second element
    /// may have a negative plateau, as the slow element of a second-order model.
    ///
    /// # Errors
    /// As [`check`](Self::check).
    pub fn parallel(first: Dahl, second: Dahl) -> Result<Self, Error> {
        let friction = Self { elements: [first, second] };
        friction.check()?;
        Ok(friction)
    }

    /// Checks the elements: each has a plateau of at least 0 and a positive length. A second
    /// element with a negative plateau has no larger plateau and a larger length than the first
    /// element.
    ///
    /// # Errors
    /// An element that is out of range.
    pub fn check(&self) -> Result<(), Error> {
        let [first, second] = self.elements;
        first.check()?;
        Dahl { plateau: second.plateau.abs(), ..second }.check()?;
        if second.plateau < 0.0 {
            if -second.plateau > first.plateau {
                return Err(Error::SlowPlateau { fast: first.plateau, slow: -second.plateau });
            }
            if !(second.length > first.length) {
                return Err(Error::SlowLength { fast: first.length, slow: second.length });
            }
        }
        Ok(())
    }

    /// Returns the load that a long slip reaches, in the unit of the load.
    #[must_use]
    pub fn plateau(&self) -> f64 {
        self.elements[0].plateau + self.elements[1].plateau
    }

    /// Returns the loads of the elements at the end of the piece `slip` that began with `loads`.
    #[must_use]
    pub fn advance(&self, loads: Loads, slip: impl Into<Slip>) -> Loads {
        let slip = slip.into();
        let [first, second] = self.elements;
        [first.advance(loads[0], slip), second.advance(loads[1], slip)]
    }

    /// Returns the total load at the end of the piece `slip` that began with `loads`, and the
    /// derivative of this load with respect to `slip.amount`, in load per deformation. See
    /// [`Dahl::respond`] for a reversal.
    #[must_use]
    pub fn respond(&self, loads: Loads, slip: impl Into<Slip>) -> Response {
        let slip = slip.into();
        let [first, second] = self.elements;
        let (first, second) = (first.respond(loads[0], slip), second.respond(loads[1], slip));
        Response { load: first.load + second.load, tangent: first.tangent + second.tangent }
    }

    /// Returns the work of the total load over the piece `slip` that began with `loads`, in load
    /// times deformation. See [`Dahl::work`].
    #[must_use]
    pub fn work(&self, loads: Loads, slip: impl Into<Slip>) -> f64 {
        let slip = slip.into();
        let [first, second] = self.elements;
        first.work(loads[0], slip) + second.work(loads[1], slip)
    }

    /// Returns the energy that the elements give back when they are unloaded from `loads`, in load
    /// times deformation.
    #[must_use]
    pub fn stored(&self, loads: Loads) -> f64 {
        self.elements[0].stored(loads[0]) + self.elements[1].stored(loads[1])
    }

    /// Returns the energy that is dissipated over the piece `slip` that began with `loads`, in load
    /// times deformation. See [`Dahl::dissipated`].
    #[must_use]
    pub fn dissipated(&self, loads: Loads, slip: impl Into<Slip>) -> f64 {
        let slip = slip.into();
        let [first, second] = self.elements;
        first.dissipated(loads[0], slip) + second.dissipated(loads[1], slip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sum(loads: Loads) -> f64 {
        loads[0] + loads[1]
    }

    #[test]
    fn second_order_shows_a_stiction_peak_and_settles() {
        let (f1, f2, ratio, length) = (1.0, 0.4, 0.2, 0.1);
        let friction = BlimanSorine::second_order(f1, f2, ratio, length).expect("a friction");
        let load = |u: f64| sum(friction.advance([0.0, 0.0], u));
        // dF/du = 0 of the virgin curve f1(1 − e^{−u/ηx}) − f2(1 − e^{−u/x}).
        let rate = 1.0 / (ratio * length) - 1.0 / length;
        let peak_at = (f1 / (ratio * f2)).ln() / rate;
        let peak = load(peak_at);
        for u in [0.9 * peak_at, 0.99 * peak_at, 1.01 * peak_at, 1.1 * peak_at] {
            assert!(load(u) < peak, "peak {peak} at {peak_at}, {} at {u}", load(u));
        }
        assert!(peak > f1 - f2 + 0.05, "peak {peak} stands above the kinetic level");
        let settled = load(40.0 * length);
        assert!((settled - (f1 - f2)).abs() < 1e-9, "settled at {settled}");
        assert!((friction.plateau() - (f1 - f2)).abs() < 1e-15);
    }

    #[test]
    fn the_response_of_two_elements_is_the_virgin_curve_and_its_slope() {
        let (f1, f2, ratio, length) = (1.0, 0.4, 0.2, 0.1);
        let friction = BlimanSorine::second_order(f1, f2, ratio, length).expect("a friction");
        for u in [0.003, 0.02, 0.07, 0.5] {
            let [fast, slow] = [(-u / (ratio * length)).exp(), (-u / length).exp()];
            let load = f1 * (1.0 - fast) - f2 * (1.0 - slow);
            let tangent = f1 / (ratio * length) * fast - f2 / length * slow;
            let found = friction.respond([0.0, 0.0], u);
            assert!((found.load - load).abs() < 1e-14, "at {u}: {found:?}, load {load}");
            assert!((found.tangent - tangent).abs() < 1e-12, "at {u}: {found:?}, slope {tangent}");
        }
    }

    #[test]
    fn the_steady_loop_has_the_known_tip_width_and_area() {
        // Closed forms of a Dahl loop between ±q: tip Fc·tanh(q/x), width at p
        // 2Fc(1 − cosh(p/x)/cosh(q/x)), area 4Fc(q − x·tanh(q/x)).
        let (plateau, length, amplitude) = (0.6, 0.04, 0.25);
        let friction = BlimanSorine::first_order(plateau, length).expect("a friction");
        let mut lower = [0.0, 0.0];
        for _ in 0..20 {
            let upper = friction.advance(lower, 2.0 * amplitude);
            lower = friction.advance(upper, -2.0 * amplitude);
        }
        let upper = friction.advance(lower, 2.0 * amplitude);
        let tip = plateau * (amplitude / length).tanh();
        assert!((sum(upper) - tip).abs() < 1e-9, "tip {} exact {tip}", sum(upper));
        for p in [-0.2, -0.1, 0.0, 0.07, 0.2, 0.24] {
            let rising = sum(friction.advance(lower, p + amplitude));
            let falling = sum(friction.advance(upper, p - amplitude));
            let exact = 2.0 * plateau * (1.0 - (p / length).cosh() / (amplitude / length).cosh());
            assert!((rising - falling - exact).abs() < 1e-9, "at {p}: {}", rising - falling);
        }
        let area = friction.work(lower, 2.0 * amplitude) + friction.work(upper, -2.0 * amplitude);
        let exact = 4.0 * plateau * (amplitude - length * (amplitude / length).tanh());
        assert!((area - exact).abs() < 1e-9, "area {area} exact {exact}");
    }

    #[test]
    fn two_positive_elements_give_loops_that_widen_with_amplitude() {
        let friction = BlimanSorine::parallel(
            Dahl::new(0.2, 0.01).expect("a friction"),
            Dahl::new(0.5, 0.3).expect("a friction"),
        )
        .expect("a friction");
        let width = |amplitude: f64| {
            let mut lower = [0.0, 0.0];
            for _ in 0..200 {
                lower = friction.advance(lower, 2.0 * amplitude);
                lower = friction.advance(lower, -2.0 * amplitude);
            }
            let upper = friction.advance(lower, 2.0 * amplitude);
            sum(friction.advance(lower, amplitude)) - sum(friction.advance(upper, -amplitude))
        };
        let widths = [0.02, 0.1, 0.4, 1.6].map(width);
        assert!(widths.windows(2).all(|w| w[1] > 1.1 * w[0]), "{widths:?}");
        assert!((widths[3] - 1.4).abs() < 0.02, "wide loops reach twice the plateaus: {widths:?}");
    }

    #[test]
    fn closed_loops_of_the_second_order_dissipate() {
        let friction = BlimanSorine::second_order(1.0, 0.4, 0.2, 0.1).expect("a friction");
        for amplitude in [0.001, 0.01, 0.05, 0.2, 1.0] {
            let mut loads = [0.0, 0.0];
            let mut lost = 0.0;
            for _ in 0..2000 {
                lost = 0.0;
                for slip in [2.0 * amplitude, -2.0 * amplitude] {
                    lost += friction.work(loads, slip);
                    loads = friction.advance(loads, slip);
                }
            }
            assert!(lost > 0.0, "amplitude {amplitude}: loop gained {lost}");
        }
    }
}
