//! The sixteen KES values of one direction: symbols in laboratory units, words in SI.

use crate::unit::Quantity;

/// KES values of one direction, in the units that the laboratory prints; each may be missing.
///
/// Fields carry the laboratory's symbols and units. The methods with words convert to SI.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Values {
    /// B, bending rigidity per width, in gf·cm²/cm.
    pub b: Option<f64>,
    /// 2HB, width of the bending loop, in gf·cm/cm.
    pub two_hb: Option<f64>,
    /// G, shear stiffness, in gf/(cm·deg).
    pub g: Option<f64>,
    /// 2HG, width of the shear loop at 0.5°, in gf/cm.
    pub two_hg: Option<f64>,
    /// 2HG5, width of the shear loop at 5°, in gf/cm.
    pub two_hg5: Option<f64>,
    /// LT, linearity of the tensile curve, a ratio.
    pub lt: Option<f64>,
    /// WT, tensile work per area, in gf·cm/cm².
    pub wt: Option<f64>,
    /// RT, tensile resilience, in percent.
    pub rt: Option<f64>,
    /// EM, extension at the maximum load, in percent.
    pub em: Option<f64>,
}

impl Values {
    /// B: bending rigidity per width, in N·m.
    pub fn bending_rigidity(&self) -> Option<f64> {
        si(self.b, Quantity::BendingRigidity)
    }

    /// 2HB: width of the bending loop, moment per width, in N.
    pub fn bending_loop_width(&self) -> Option<f64> {
        si(self.two_hb, Quantity::MomentPerWidth)
    }

    /// G: shear stiffness, in N/(m·rad).
    pub fn shear_stiffness(&self) -> Option<f64> {
        si(self.g, Quantity::ShearStiffness)
    }

    /// 2HG: width of the shear loop at 0.5°, in N/m.
    pub fn shear_loop_width(&self) -> Option<f64> {
        si(self.two_hg, Quantity::ForcePerWidth)
    }

    /// 2HG5: width of the shear loop at 5°, in N/m.
    pub fn shear_loop_width_at_five_degrees(&self) -> Option<f64> {
        si(self.two_hg5, Quantity::ForcePerWidth)
    }

    /// LT: work to the maximum load over the work of a straight line to it, a ratio.
    pub fn tensile_linearity(&self) -> Option<f64> {
        self.lt
    }

    /// WT: work per area to the maximum load, in J/m².
    pub fn tensile_work(&self) -> Option<f64> {
        si(self.wt, Quantity::WorkPerArea)
    }

    /// RT: work recovered over work spent, a ratio.
    pub fn tensile_resilience(&self) -> Option<f64> {
        si(self.rt, Quantity::Ratio)
    }

    /// EM: strain at the maximum load, a ratio.
    pub fn tensile_extension(&self) -> Option<f64> {
        si(self.em, Quantity::Ratio)
    }

    /// Whether no value is given at all.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

fn si(value: Option<f64>, quantity: Quantity) -> Option<f64> {
    value.map(|value| value * quantity.laboratory().factor)
}
