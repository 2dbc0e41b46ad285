//! Check of a fabric: the admissible range of each number, with a remedy. The reader of files and
//! the fit call the check.

use std::ops::RangeInclusive;

use drape_hysteresis::BlimanSorine;
use drape_input::figure;

use crate::fabric::Fabric;
use crate::laws::bending::{BendingBackbone, BendingLaw};
use crate::laws::piecewise::Piecewise;
use crate::laws::shear::{Locking, ShearBackbone, ShearLaw};
use crate::laws::traction::buckling::Buckling;
use crate::laws::traction::exponential::{ExponentialToe, STEEPNESS_MIN};
use crate::laws::traction::primed::TOE_RATIO_MIN;
use crate::laws::traction::proportional::{FRICTION_RATIO_MAX, ProportionalFriction};
use crate::laws::traction::{TractionBackbone, TractionFriction, TractionLaw};
use crate::laws::varying::Varying;

/// Number of a fabric outside its admissible range.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Key path of the number, such as `warp.bending.rigidity`.
    pub key: String,
    /// Statement of the number and its admissible range.
    pub message: String,
    /// Remedy.
    pub help: String,
    /// Number with the unit that the writer probably meant, if a unit is likely.
    pub meant: Option<String>,
}

/// Returns `value` with `unit`, a thousandth of the SI unit, if the value in this unit is within
/// `range`.
fn meant(value: f64, range: &RangeInclusive<f64>, unit: &str) -> Option<String> {
    range.contains(&(1e-3 * value)).then(|| format!("{} {unit}", figure(value)))
}

impl Fabric {
    /// Returns a [`Problem`] for every number outside its admissible range, none for a usable
    /// fabric.
    #[must_use]
    pub fn problems(&self) -> Vec<Problem> {
        let mut check = Checker(Vec::new());

        let (range, help) =
            (0.005..=5.0, "mass per area in kg/m²: 0.12, or \"120 g/m2\" with its unit");
        let meant_density = meant(self.density, &range, "g/m2");
        check.within_or("density", self.density, (range, help), meant_density);
        let (range, help) = (1e-6..=0.02, "in m: 0.0003, or \"0.3 mm\" with its unit");
        let meant_thickness = meant(self.thickness, &range, "mm");
        check.within_or("thickness", self.thickness, (range, help), meant_thickness);

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

impl TractionLaw {
    /// Returns a [`Problem`] for every number outside its admissible range, with keys such as
    /// `traction.buckling.strain`.
    #[must_use]
    pub fn problems(&self) -> Vec<Problem> {
        let mut check = Checker(Vec::new());
        check.traction("traction", self);
        check.0
    }
}

impl BendingLaw {
    /// Returns a [`Problem`] for every number outside its admissible range, with keys such as
    /// `bending.rigidity`.
    #[must_use]
    pub fn problems(&self) -> Vec<Problem> {
        let mut check = Checker(Vec::new());
        check.bending("bending", self);
        check.0
    }
}

impl ShearLaw {
    /// Returns a [`Problem`] for every number outside its admissible range, with keys such as
    /// `shear.stiffness`.
    #[must_use]
    pub fn problems(&self) -> Vec<Problem> {
        let mut check = Checker(Vec::new());
        check.shear(self);
        check.0
    }
}

/// Collector of the problems of a fabric.
struct Checker(Vec<Problem>);

impl Checker {
    /// Adds the problem of the number at `key`.
    fn fail(&mut self, key: &str, message: String, help: &str) {
        self.0.push(Problem { key: key.into(), message, help: help.into(), meant: None });
    }

    /// Adds a problem if `value` is outside its range. The remedy proposes the number `meant`, if
    /// there is one.
    fn within_or(
        &mut self,
        key: &str,
        value: f64,
        (range, help): (RangeInclusive<f64>, &str),
        meant: Option<String>,
    ) {
        let question = meant.as_ref().map(|meant| format!("did you mean \"{meant}\"?"));
        let before = self.0.len();
        self.within(key, value, range, question.as_deref().unwrap_or(help));
        self.0[before..].iter_mut().for_each(|problem| problem.meant.clone_from(&meant));
    }

    /// Adds a problem if `value` is outside `range` or NaN.
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

    /// Adds a problem unless `value` is finite and greater than 0.
    fn positive(&mut self, key: &str, value: f64, help: &str) {
        if !(value > 0.0 && value.is_finite()) {
            self.fail(key, format!("{} is not greater than 0", figure(value)), help);
        }
    }

    /// Checks the numbers of a law of traction with the key `key`.
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
            TractionBackbone::Exponential(toe) => {
                self.exponential(&format!("{key}.exponential"), toe)
            }
            TractionBackbone::Polynomial(polynomial) => {
                let key = format!("{key}.polynomial");
                let help = "in N/m, not negative, so that the curve rises";
                self.within(&format!("{key}.quadratic"), polynomial.quadratic, 0.0..=1e12, help);
                self.within(&format!("{key}.quartic"), polynomial.quartic, 0.0..=1e15, help);
            }
        }

        let buckling = &law.buckling;
        self.within(&format!("{key}.buckling.strain"), buckling.strain, 1e-5..=0.5, "a ratio");
        let help = "in N/m, not negative";
        self.within(&format!("{key}.buckling.stiffness"), buckling.stiffness, 0.0..=1e6, help);
        self.traction_friction(key, law);
    }

    /// Checks the numbers of an exponential toe with the key `key`.
    fn exponential(&mut self, key: &str, toe: &ExponentialToe) {
        let ExponentialToe { base_stiffness, stiffness, steepness, toe_strain, toe_strain_after } =
            *toe;
        let help = "tension per width and strain in N/m; woven fabrics have 0 to 1e5";
        self.within(&format!("{key}.base_stiffness"), base_stiffness, 0.0..=1e7, help);
        let help = "tension per width and strain in N/m; woven fabrics have 1e3 to 1e6";
        self.within(&format!("{key}.stiffness"), stiffness, 1.0..=1e10, help);
        let help = "logarithm of the growth of the stiffness over the toe, 1 to 6 as a rule";
        self.within(&format!("{key}.steepness"), steepness, STEEPNESS_MIN..=60.0, help);
        let help = "a ratio; 1.5 % is 0.015";
        self.within(&format!("{key}.toe_strain"), toe_strain, 1e-6..=3.0, help);
        let range = toe_strain..=2.0 * toe_strain;
        let help = "from toe_strain to twice toe_strain";
        self.within(&format!("{key}.toe_strain_after"), toe_strain_after, range, help);
    }

    /// Checks the friction of a law of traction with the key `key`, and that it suits the backbone.
    fn traction_friction(&mut self, key: &str, law: &TractionLaw) {
        match (&law.backbone, &law.friction) {
            (TractionBackbone::Exponential(toe), TractionFriction::Proportional(friction)) => {
                self.proportional(key, toe, friction, &law.buckling);
            }

            (TractionBackbone::Exponential(_), TractionFriction::Plateau(friction)) => {
                self.friction(&format!("{key}.friction"), friction);
                if friction.elements[1].plateau != 0.0 {
                    self.fail(
                        &format!("{key}.friction"),
                        "an exponential toe has one friction element".into(),
                        "leave out the second, or write the table `proportional_friction`",
                    );
                }
            }
            (_, TractionFriction::Plateau(friction)) => {
                self.friction(&format!("{key}.friction"), friction);
            }
            (_, TractionFriction::Proportional(_)) => self.fail(
                &format!("{key}.proportional_friction"),
                "this friction needs an exponential toe".into(),
                "write the table `exponential`, or `friction` with plateaus",
            ),
        }
    }

    /// Checks a proportional friction of the law of traction with the key `key`.
    fn proportional(
        &mut self,
        key: &str,
        toe: &ExponentialToe,
        friction: &ProportionalFriction,
        buckling: &Buckling,
    ) {
        let friction_key = format!("{key}.proportional_friction");
        let help =
            "friction over elastic load; with more the cloth has no stiffness when it is unloaded";
        self.within(
            &format!("{friction_key}.ratio"),
            friction.ratio,
            0.0..=FRICTION_RATIO_MAX,
            help,
        );
        let help = "in N/m, not negative";
        self.within(&format!("{friction_key}.plateau"), friction.plateau, 0.0..=1e5, help);
        let help = "a strain, greater than 0";
        self.positive(&format!("{friction_key}.length"), friction.length, help);

        // The load must rise with the strain in compression too.
        let least = friction.plateau / toe.rest_stiffness();
        if buckling.strain < least * (1.0 - 1e-9) {
            let message = format!("{} is less than {}", figure(buckling.strain), figure(least));
            let help = "at least the plateau over the stiffness at rest, so that the load rises with \
                        the strain in compression";
            self.fail(&format!("{key}.buckling.strain"), message, help);
        }
    }

    /// Checks a bending rigidity.
    fn rigidity(&mut self, key: &str, value: f64) {
        let help = "in N·m: 1.2e-5, or KES B with its unit, \"0.12 gf.cm2/cm\"";
        self.within(key, value, 1e-7..=1e-3, help);
    }

    /// Checks the numbers of a law of bending with the key `key`.
    fn bending(&mut self, key: &str, law: &BendingLaw) {
        match &law.backbone {
            BendingBackbone::Linear { rigidity } => {
                self.rigidity(&format!("{key}.rigidity"), *rigidity);
            }
            BendingBackbone::Varying(varying) => {
                let key = format!("{key}.varying");
                self.rigidity(&format!("{key}.initial_stiffness"), varying.initial_stiffness);
                self.rigidity(&format!("{key}.final_stiffness"), varying.final_stiffness);
                let help = "a curvature in 1/m, greater than 0";
                self.positive(&format!("{key}.transition"), varying.transition, help);
            }
            BendingBackbone::Piecewise(piecewise) => {
                self.rigidity(&format!("{key}.piecewise.slope"), piecewise.slope);
                self.piecewise(&format!("{key}.piecewise"), piecewise);
            }
        }

        let help = "a curvature in 1/m";
        self.within(&format!("{key}.rest_curvature"), law.rest_curvature, -1e4..=1e4, help);
        self.friction(&format!("{key}.friction"), &law.friction);
    }

    /// Checks the numbers of the law of shear.
    fn shear(&mut self, law: &ShearLaw) {
        match &law.backbone {
            ShearBackbone::Linear { stiffness } => {
                let help = "in N/m: 35, or KES G with its unit, \"0.6 gf/(cm.deg)\"";
                self.within("shear.stiffness", *stiffness, 0.01..=1e5, help);
            }
            ShearBackbone::Varying(varying) => {
                let help = "in N/m: 35, or KES G with its unit, \"0.6 gf/(cm.deg)\"";
                let Varying { initial_stiffness, final_stiffness, transition } = *varying;
                let range = 0.01..=1e5;
                let key = "shear.varying.initial_stiffness";
                self.within(key, initial_stiffness, range.clone(), help);
                self.within("shear.varying.final_stiffness", final_stiffness, range, help);
                let help = "a sine, greater than 0";
                self.positive("shear.varying.transition", transition, help);
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

    /// Checks the numbers of a backbone of a quadratic and a line with the key `key`.
    fn piecewise(&mut self, key: &str, piecewise: &Piecewise) {
        self.positive(&format!("{key}.slope"), piecewise.slope, "the curve must rise");
        self.positive(&format!("{key}.knot"), piecewise.knot, "in the unit of the deformation");
        let rising = -0.5 * piecewise.slope * piecewise.knot;
        let help = "at least −slope·knot/2, so that the curve rises from the origin";
        self.within(&format!("{key}.intercept"), piecewise.intercept, rising..=1e9, help);
    }

    /// Checks the elements of a friction with the key `key`.
    fn friction(&mut self, key: &str, friction: &BlimanSorine) {
        let [first, second] = friction.elements;
        for (index, element) in [first, second].iter().enumerate() {
            if element.plateau != 0.0 || element.length != 1.0 {
                let key = format!("{key}[{index}].length");
                self.positive(&key, element.length, "in the unit of the deformation");
            }
        }

        // A negative second element makes the model one of second order.
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
