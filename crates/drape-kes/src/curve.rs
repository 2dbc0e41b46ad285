//! A measured load-deformation curve, in SI.

use crate::Error;

/// Which test a curve comes from; it fixes what deformation and load mean.
///
/// | test | deformation | load, per width |
/// |---|---|---|
/// | tensile | strain, a ratio | force, in N/m |
/// | shear | shear angle, in rad | force, in N/m |
/// | bending | curvature, in 1/m | moment, in N |
/// | loop bending | clamp distance over specimen length, minus one | force, in N/m |
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Test {
    /// A strip is stretched along its yarns (KES-FB1).
    Tensile,
    /// A strip is sheared at constant tension (KES-FB1).
    Shear,
    /// A strip is bent to a uniform curvature (KES-FB2).
    Bending,
    /// Two parallel clamps are brought together and the strip between them buckles into an arch.
    LoopBending,
}

impl Test {
    /// The name used in sheets and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tensile => "tensile",
            Self::Shear => "shear",
            Self::Bending => "bending",
            Self::LoopBending => "loop-bending",
        }
    }
}

/// The yarns along which a strip was cut and loaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Direction {
    /// Along the loom.
    Warp,
    /// Across the loom.
    Weft,
}

impl Direction {
    /// The name used in sheets and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Warp => "warp",
            Self::Weft => "weft",
        }
    }
}

/// A load-deformation curve in the order it was measured, in SI.
///
/// Its points are one history: the fabric remembers, so loading, unloading and repeated cycles must
/// stay in the order in which they happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What the curve is called in reports.
    pub name: String,
    /// The test, which fixes the meaning of deformation and load.
    pub test: Test,
    /// The yarns along which the strip was loaded.
    pub direction: Direction,
    /// Free length of the specimen between the clamps, where it was given; in metres.
    pub gauge: Option<f64>,
    /// Whether the strip hung slack at the start, so that the zeros of strain and of force are both
    /// unknown and belong to the fit.
    pub slack: bool,
    deformation: Vec<f64>,
    load: Vec<f64>,
}

impl Curve {
    /// A curve from its points in SI, in the order of measurement.
    ///
    /// # Errors
    /// The two columns differ in length, there are fewer than two points, a value is not finite, or the
    /// deformation never changes.
    pub fn new(
        test: Test,
        direction: Direction,
        deformation: Vec<f64>,
        load: Vec<f64>,
    ) -> Result<Self, Error> {
        if deformation.len() != load.len() {
            let (deformations, loads) = (deformation.len(), load.len());
            return Err(Error::Unpaired { deformations, loads });
        }
        if deformation.len() < 2 {
            return Err(Error::TooShort { points: deformation.len() });
        }
        for (index, (&q, &f)) in deformation.iter().zip(&load).enumerate() {
            if !(q.is_finite() && f.is_finite()) {
                return Err(Error::NotFinite { index, deformation: q, load: f });
            }
        }
        if deformation.iter().all(|&q| q == deformation[0]) {
            return Err(Error::NoMotion { deformation: deformation[0] });
        }
        let name = format!("{} {}", test.name(), direction.name());
        Ok(Self { name, test, direction, gauge: None, slack: false, deformation, load })
    }

    /// The same curve through other points, in SI.
    pub(crate) fn with_points(mut self, points: Vec<(f64, f64)>) -> Self {
        (self.deformation, self.load) = points.into_iter().unzip();
        self
    }

    /// The deformation at each point, in SI: see [`Test`].
    pub fn deformation(&self) -> &[f64] {
        &self.deformation
    }

    /// The load per width at each point, in SI: see [`Test`].
    pub fn load(&self) -> &[f64] {
        &self.load
    }

    /// The lowest and the highest deformation, in SI.
    pub fn deformation_range(&self) -> (f64, f64) {
        range(&self.deformation)
    }

    /// The lowest and the highest load, in SI.
    pub fn load_range(&self) -> (f64, f64) {
        range(&self.load)
    }
}

fn range(values: &[f64]) -> (f64, f64) {
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &v| (low.min(v), high.max(v)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(deformation: &[f64], load: &[f64]) -> Result<Curve, Error> {
        Curve::new(Test::Bending, Direction::Warp, deformation.to_vec(), load.to_vec())
    }

    #[test]
    fn a_curve_needs_two_paired_finite_points_that_move() {
        assert!(curve(&[0.0, 1.0], &[0.0, 2.0]).is_ok());
        assert!(matches!(curve(&[0.0, 1.0], &[0.0]), Err(Error::Unpaired { .. })));
        assert!(matches!(curve(&[0.0], &[0.0]), Err(Error::TooShort { points: 1 })));
        let nan = curve(&[0.0, 1.0], &[0.0, f64::NAN]);
        assert!(matches!(nan, Err(Error::NotFinite { index: 1, .. })));
        assert!(matches!(curve(&[1.0, 1.0], &[0.0, 2.0]), Err(Error::NoMotion { .. })));
    }
}
