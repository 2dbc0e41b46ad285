use crate::{Dahl, exp_m1};

/// A straight path from the remembered deformation to a trial, prepared for many evaluations side by
/// side: its results are those of the pieces that [`Slip`](crate::Slip) cuts it into.
///
/// The weight of the plateau starts at `weight` and changes by `ramp` per way. Where the path passes
/// a knot of the weight, a [`Bend`] adds what the slope gains there: the equation is linear in the
/// weight, so the parts add up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// Direction `$\sigma = \pm 1$`.
    pub sign: f64,
    /// Length of the path, at least 0, in the unit of the deformation.
    pub way: f64,
    /// Weight of the plateau at the start.
    pub weight: f64,
    /// Growth of the weight per way at the start.
    pub ramp: f64,
}

/// A change of the weight's slope on the path of a [`Stroke`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// Gain of the growth of the weight per way.
    pub ramp: f64,
    /// Way that is left behind the knot, 0 when the path does not reach it.
    pub way: f64,
}

/// A [`Dahl`] element prepared for many evaluations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slider {
    plateau: f64,
    length: f64,
    inverse: f64,
}

/// How much of a load is lost on a way, and how far the load lags behind a ramp.
#[derive(Debug, Clone, Copy)]
struct Decay {
    lost: f64,
    lag: f64,
}

impl Slider {
    /// Prepares an element.
    #[must_use]
    pub fn new(element: Dahl) -> Self {
        Self { plateau: element.plateau, length: element.length, inverse: 1.0 / element.length }
    }

    #[inline(always)]
    fn decay(&self, way: f64) -> Decay {
        let lost = -exp_m1(-way * self.inverse);
        Decay { lost, lag: way - self.length * lost }
    }

    /// Load at the end of a stroke that began with `load`, in the unit of the load.
    #[inline(always)]
    #[must_use]
    pub fn load(&self, load: f64, stroke: Stroke) -> f64 {
        let Decay { lost, lag } = self.decay(stroke.way);
        let gained = stroke.weight * lost + stroke.ramp * lag;
        load * (1.0 - lost) + stroke.sign * self.plateau * gained
    }

    /// What a bend adds to the load at the end of a stroke in the direction `sign`, in the unit of
    /// the load.
    #[inline(always)]
    #[must_use]
    pub fn bend_load(&self, sign: f64, bend: Bend) -> f64 {
        sign * self.plateau * bend.ramp * self.decay(bend.way).lag
    }

    /// Derivative of the load with respect to the end of a stroke, in load per deformation, where the
    /// load is `load` and the weight `weight`.
    #[inline(always)]
    #[must_use]
    pub fn tangent(&self, load: f64, sign: f64, weight: f64) -> f64 {
        (self.plateau * weight - sign * load) * self.inverse
    }

    /// Work over a stroke that began with `load`, in load times deformation.
    #[inline(always)]
    #[must_use]
    pub fn work(&self, load: f64, stroke: Stroke) -> f64 {
        let Stroke { way, .. } = stroke;
        let Decay { lost, lag } = self.decay(way);
        let gained = stroke.weight * lag + stroke.ramp * (0.5 * way * way - self.length * lag);
        stroke.sign * load * self.length * lost + self.plateau * gained
    }

    /// What a bend adds to the work, in load times deformation.
    #[inline(always)]
    #[must_use]
    pub fn bend_work(&self, bend: Bend) -> f64 {
        let Decay { lag, .. } = self.decay(bend.way);
        self.plateau * bend.ramp * (0.5 * bend.way * bend.way - self.length * lag)
    }

    /// Energy that the element gives back, as [`Dahl::stored`]; the plateau must not be 0.
    #[inline(always)]
    #[must_use]
    pub fn stored(&self, load: f64) -> f64 {
        0.5 * load * load * self.length / self.plateau
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Slip;

    const ELEMENT: Dahl = Dahl { plateau: 0.7, length: 0.03 };

    /// Weight with a knot at 0.01, like that of a yarn whose toe ends there.
    fn weight(at: f64) -> f64 {
        if at < 0.01 { 0.4 + 60.0 * at } else { 1.0 }
    }

    #[test]
    fn a_bent_stroke_is_its_pieces_one_after_the_other() {
        let slider = Slider::new(ELEMENT);
        for load in [-0.7, 0.0, 0.3] {
            for (from, to) in [(0.002_f64, 0.03), (0.03, 0.002), (0.0, 0.011), (0.2, -0.002)] {
                let sign = (to - from).signum();
                let start = if from < 0.01 { 60.0 * sign } else { 0.0 };
                let stroke =
                    Stroke { sign, way: (to - from).abs(), weight: weight(from), ramp: start };
                let bend = Bend { ramp: -60.0, way: (to - 0.01_f64).abs() };
                let slips = [
                    Slip::weighted(0.01 - from, weight(from), 1.0),
                    Slip::weighted(to - 0.01, 1.0, weight(to)),
                ];
                let middle = ELEMENT.advance(load, slips[0]);
                let (end, slope) = ELEMENT.respond(middle, slips[1]);
                let work = ELEMENT.work(load, slips[0]) + ELEMENT.work(middle, slips[1]);
                let found = slider.load(load, stroke) + slider.bend_load(sign, bend);
                assert!((found - end).abs() < 1e-15, "{from} to {to}: {found} {end}");
                let tangent = slider.tangent(found, sign, weight(to));
                assert!((tangent - slope).abs() < 1e-13, "{tangent} {slope}");
                let found = slider.work(load, stroke) + slider.bend_work(bend);
                assert!((found - work).abs() < 1e-15, "{found} {work}");
            }
        }
    }
}
