//! A measured path in pieces, and what friction of a given length does along it.

use drape_hysteresis::exp_m1;

/// A piece of the path on which the deformation has one sign and one sense.
struct Piece {
    /// Amount of the deformation covered.
    way: f64,
    /// Sense of the deformation.
    sense: f64,
    /// Size of the deformation at the start, and how it grows along the way.
    from: f64,
    ramp: f64,
    /// Whether a measured point is at its end.
    measured: bool,
}

/// A path from rest through measured points.
pub(crate) struct Strokes {
    pieces: Vec<Piece>,
    points: usize,
}

/// Loads along a path of a friction element with a given length, and their derivatives by that length.
///
/// The load of an element of plateau `$F_c$` that grows by `$\gamma$` per unit of the deformation is
/// `$F_c(c + \gamma g)$`.
pub(crate) struct Element {
    /// With a plateau of one.
    pub constant: Vec<f64>,
    /// With a plateau of the size of the deformation.
    pub grown: Vec<f64>,
    pub constant_slope: Vec<f64>,
    pub grown_slope: Vec<f64>,
}

impl Strokes {
    /// Cuts a path at its points and at zero.
    pub fn new(path: &[f64]) -> Self {
        let mut pieces = Vec::with_capacity(path.len() + 8);
        let mut at = 0.0_f64;
        for &point in path {
            let crosses = at * point < 0.0;
            for (end, measured) in [(0.0, false), (point, true)] {
                if measured || crosses {
                    pieces.push(Piece::new(at, end, measured));
                    at = end;
                }
            }
        }
        Self { pieces, points: path.len() }
    }

    /// The loads of an element of some length, each piece's the exact solution of
    /// [`Dahl`](drape_fabric::Dahl).
    ///
    /// They are those of the laws' own friction, found for all points at once: the exponentials side by side,
    /// and each load with its derivative from the one before.
    pub fn element(&self, length: f64) -> Element {
        let mut lost: Vec<f64> = self.pieces.iter().map(|piece| -piece.way / length).collect();
        lost.iter_mut().for_each(|lost| *lost = -exp_m1(*lost));
        let column = || Vec::with_capacity(self.points);
        let (mut constant, mut grown) = (column(), column());
        let (mut constant_slope, mut grown_slope) = (column(), column());
        let (mut c, mut g, mut c_slope, mut g_slope) = (0.0, 0.0, 0.0, 0.0);
        let inverse = 1.0 / length;
        for (piece, &lost) in self.pieces.iter().zip(&lost) {
            let Piece { way, sense, from, ramp, measured } = *piece;
            let kept = 1.0 - lost;
            // What a longer element keeps more of its load, per length.
            let more = kept * way * inverse * inverse;
            let lag = way - length * lost;
            c_slope = c_slope * kept + (c - sense) * more;
            g_slope =
                g_slope * kept + g * more - sense * (from * more + ramp * (lost - length * more));
            c = c * kept + sense * lost;
            g = g * kept + sense * (from * lost + ramp * lag);
            if measured {
                constant.push(c);
                grown.push(g);
                constant_slope.push(c_slope);
                grown_slope.push(g_slope);
            }
        }
        Element { constant, grown, constant_slope, grown_slope }
    }
}

impl Piece {
    fn new(from: f64, to: f64, measured: bool) -> Self {
        let way = (to - from).abs();
        let ramp = if way > 0.0 { (to.abs() - from.abs()) / way } else { 0.0 };
        Self { way, sense: (to - from).signum(), from: from.abs(), ramp, measured }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drape_fabric::{BlimanSorine, Law, ShearBackbone, ShearLaw, drive};

    /// Out, through zero twice, a point twice, and on.
    fn path() -> Vec<f64> {
        let mut path: Vec<f64> = (0..40).map(|i| 0.14 * (0.3 * f64::from(i)).sin()).collect();
        path.extend([0.05, 0.05, -0.02, 0.14]);
        path
    }

    #[test]
    fn elements_side_by_side_are_the_friction_of_the_law() {
        let path = path();
        let strokes = Strokes::new(&path);
        for length in [1e-4, 0.004, 0.03, 0.5] {
            let law = ShearLaw {
                backbone: ShearBackbone::Linear { stiffness: 0.0 },
                friction: BlimanSorine::first_order(0.7, length),
                growth: 9.0,
                locking: None,
            };
            let exact = drive(&law, law.virgin(), &path);
            let element = strokes.element(length);
            let columns = element.constant.iter().zip(&element.grown);
            for (exact, (constant, grown)) in exact.iter().zip(columns) {
                let found = 0.7 * (constant + 9.0 * grown);
                assert!((found - exact).abs() < 1e-14, "length {length}: {found} not {exact}");
            }
        }
    }

    #[test]
    fn their_derivatives_are_those_of_differences() {
        let strokes = Strokes::new(&path());
        for length in [0.004, 0.03, 0.5] {
            let step = 1e-5 * length;
            let (less, more) = (strokes.element(length - step), strokes.element(length + step));
            let at = strokes.element(length);
            let pairs = [
                (&at.constant_slope, &less.constant, &more.constant),
                (&at.grown_slope, &less.grown, &more.grown),
            ];
            for (slopes, less, more) in pairs {
                for ((slope, less), more) in slopes.iter().zip(less).zip(more) {
                    let difference = 0.5 * (more - less) / step;
                    // The formula errs by the square of the step, rounding by 1e-16 over the step.
                    assert!((slope - difference).abs() * length < 1e-9, "{slope} not {difference}");
                }
            }
        }
    }
}
