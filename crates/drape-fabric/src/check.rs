//! Check of a fabric: the admissible range of each number, with a remedy. The reader of files and the
//! fit call it.

use std::ops::RangeInclusive;

use drape_hysteresis::BlimanSorine;
use drape_input::figure;

use crate::fabric::Fabric;
use crate::laws::bending::{BendingBackbone, BendingLaw};
use crate::laws::piecewise::Piecewise;
use crate::laws::shear::{Locking, ShearBackbone, ShearLaw};
use crate::laws::traction::{TOE_RATIO_MIN, TractionBackbone, TractionLaw};

/// Number of a fabric outside its admissible range.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Key path of the number, such as `warp.bending.rigidity`.
    pub key: String,
    /// The number and the range it should have.
    pub message: String,
    /// Remedy.
    pub help: String,
}

/// Asks for a unit of a thousandth in which a number would be within its range.
fn asked(value: f64, range: &RangeInclusive<f64>, unit: &str) -> Option<String> {
    let meant = range.contains(&(1e-3 * value));
    meant.then(|| format!("did you mean \"{} {unit}\"?", figure(value)))
}

impl Fabric {
    /// Returns every number outside its admissible range: none for a usable fabric.
    #[must_use]
    pub fn problems(&self) -> Vec<Problem> {
        let mut check = Check(Vec::new());
        let (range, help) =
            (0.005..=5.0, "mass per area in kg/m²: 0.12, or \"120 g/m2\" with its unit");
        let help = asked(self.density, &range, "g/m2").unwrap_or_else(|| help.to_owned());
        check.within("density", self.density, range, &help);
        let (range, help) = (1e-6..=0.02, "in m: 0.0003, or \"0.3 mm\" with its unit");
        let help = asked(self.thickness, &range, "mm").unwrap_or_else(|| help.to_owned());
        check.within("thickness", self.thickness, range, &help);
        if let Some(pressed) = self.pressed_thickness {
            let help = "in m, under 4.9 kPa: no more than the thickness";
            check.within("pressed_thickness", pressed, 1e-6..=self.thickness, help);
        }
        if let Some(linearity) = self.compression_linearity {
            let help = "LC of the compression test, a ratio: 1 for a straight line, 0.2 to 0.5 for fabrics";
            check.within("compression_linearity", linearity, 0.02..=1.0, help);
        }
        check.within("surface_friction", self.surface_friction, 0.0..=5.0, "a ratio such as 0.2");
        for (name, direction) in [("warp", &self.warp), ("weft", &self.weft)] {
            check.traction(&format!("{name}.traction"), &direction.traction);
            check.bending(&format!("{name}.bending"), &direction.bending);
        }
        check.shear(&self.shear);
        check.0
    }
}

struct Check(Vec<Problem>);

impl Check {
    fn fail(&mut self, key: &str, message: String, help: &str) {
        self.0.push(Problem { key: key.into(), message, help: help.into() });
    }

    /// Fails a number outside a range, and NaN.
    fn within(&mut self, key: &str, value: f64, range: RangeInclusive<f64>, help: &str) {
        let (low, high) = (range.start(), range.end());
        if !(value >= *low && value <= *high) {
            self.fail(
                key,
                format!("{} is not between {} and {}", figure(value), figure(*low), figure(*high)),
                help,
            );
        }
    }

    fn positive(&mut self, key: &str, value: f64, help: &str) {
        if !(value > 0.0 && value.is_finite()) {
            self.fail(key, format!("{} is not greater than 0", figure(value)), help);
        }
    }

    fn traction(&mut self, key: &str, law: &TractionLaw) {
        match &law.backbone {
            TractionBackbone::Primed(primed) => {
                let key = format!("{key}.primed");
                self.within(
                    &format!("{key}.stiffness"),
                    primed.stiffness,
                    1.0..=1e7,
                    "tension per width and strain in N/m; woven fabrics have 1e3 to 1e5",
                );
                self.within(
                    &format!("{key}.toe_ratio"),
                    primed.toe_ratio,
                    TOE_RATIO_MIN..=1.0,
                    "F1/(k_t ε1); outside this range the curve is not monotone",
                );
                self.within(
                    &format!("{key}.toe_strain"),
                    primed.toe_strain,
                    1e-6..=1.0,
                    "a ratio; 1.5 % is 0.015",
                );
                self.within(
                    &format!("{key}.toe_strain_after"),
                    primed.toe_strain_after,
                    primed.toe_strain..=2.0 * primed.toe_strain,
                    "from toe_strain to twice toe_strain",
                );
            }
            TractionBackbone::Polynomial(polynomial) => {
                let key = format!("{key}.polynomial");
                let help = "in N/m, not negative, so that the curve rises";
                self.within(&format!("{key}.quadratic"), polynomial.quadratic, 0.0..=1e12, help);
                self.within(&format!("{key}.quartic"), polynomial.quartic, 0.0..=1e15, help);
            }
        }
        let buckling = &law.buckling;
        self.within(&format!("{key}.buckling.strain"), buckling.strain, 1e-5..=0.1, "a ratio");
        let help = "in N/m, not negative";
        self.within(&format!("{key}.buckling.stiffness"), buckling.stiffness, 0.0..=1e6, help);
        self.friction(&format!("{key}.friction"), &law.friction);
    }

    fn bending(&mut self, key: &str, law: &BendingLaw) {
        let rigidity = |check: &mut Self, key: &str, value: f64| {
            check.within(
                key,
                value,
                1e-7..=1e-3,
                "in N·m: 1.2e-5, or KES B with its unit, \"0.12 gf.cm2/cm\"",
            );
        };
        match &law.backbone {
            BendingBackbone::Linear { rigidity: value } => {
                rigidity(self, &format!("{key}.rigidity"), *value);
            }
            BendingBackbone::Piecewise(piecewise) => {
                rigidity(self, &format!("{key}.piecewise.slope"), piecewise.slope);
                self.piecewise(&format!("{key}.piecewise"), piecewise);
            }
        }
        let help = "a curvature in 1/m";
        self.within(&format!("{key}.rest_curvature"), law.rest_curvature, -1e4..=1e4, help);
        self.friction(&format!("{key}.friction"), &law.friction);
    }

    fn shear(&mut self, law: &ShearLaw) {
        match &law.backbone {
            ShearBackbone::Linear { stiffness } => {
                let help = "in N/m: 35, or KES G with its unit, \"0.6 gf/(cm.deg)\"";
                self.within("shear.stiffness", *stiffness, 0.01..=1e5, help);
            }
            ShearBackbone::Piecewise(piecewise) => {
                self.piecewise("shear.piecewise", piecewise);
            }
        }
        self.within("shear.growth", law.growth, 0.0..=1e3, "per unit of the sine, not negative");
        if let Some(Locking { onset, limit }) = law.locking {
            self.within("shear.locking.onset", onset, 0.01..=0.99, "a sine; 8° is 0.139");
            let help = "a sine larger than the onset; 60° is 0.866";
            self.within("shear.locking.limit", limit, onset + 1e-3..=1.0, help);
        }
        self.friction("shear.friction", &law.friction);
    }

    fn piecewise(&mut self, key: &str, piecewise: &Piecewise) {
        self.positive(&format!("{key}.slope"), piecewise.slope, "the curve must rise");
        self.positive(&format!("{key}.knot"), piecewise.knot, "in the unit of the deformation");
        let rising = -0.5 * piecewise.slope * piecewise.knot;
        let help = "at least −slope·knot/2, so that the curve rises from the origin";
        self.within(&format!("{key}.intercept"), piecewise.intercept, rising..=1e9, help);
    }

    fn friction(&mut self, key: &str, friction: &BlimanSorine) {
        let [first, second] = friction.elements;
        for (index, element) in [first, second].iter().enumerate() {
            if element.plateau != 0.0 || element.length != 1.0 {
                let key = format!("{key}[{index}].length");
                self.positive(&key, element.length, "in the unit of the deformation");
            }
        }
        let help = "not negative; the first element is the fast one of a second-order model";
        self.within(&format!("{key}[0].plateau"), first.plateau, 0.0..=1e9, help);
        if !(second.plateau >= -first.plateau) {
            let message = format!("{} outweighs the first element", figure(second.plateau));
            let help = "a negative second plateau must be smaller than the first one";
            self.fail(&format!("{key}[1].plateau"), message, help);
        }
        if second.plateau < 0.0 && !(second.length > first.length) {
            let message =
                format!("{} is not longer than the first element's", figure(second.length));
            let help = "the negative element of a second-order model is the slow, long one";
            self.fail(&format!("{key}[1].length"), message, help);
        }
    }
}
