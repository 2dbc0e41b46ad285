//! KES values of one direction: symbols in laboratory units, words in SI.

use crate::symbol::Symbol;
use drape_input::Quantity;

/// KES values of one direction, in the laboratory's units; each may be missing.
///
/// Fields have the laboratory's symbols and units. The methods with words convert to SI.
///
/// ```
/// use drape_kes::Values;
///
/// let values = Values { b: Some(0.118), ..Values::default() };
/// let rigidity = values.bending_rigidity().expect("B is given");
/// assert!((rigidity / 1.157e-5 - 1.0).abs() < 1e-3);
/// ```
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
    /// MIU, coefficient of friction of the surface, a ratio.
    pub miu: Option<f64>,
    /// MMD, mean deviation of MIU along the path, a ratio; the model does not use it.
    pub mmd: Option<f64>,
    /// SMD, mean deviation of the height of the surface, in µm; the model does not use it.
    pub smd: Option<f64>,
}

impl Values {
    /// Returns `B`: bending rigidity per width, in N·m.
    #[must_use]
    pub fn bending_rigidity(&self) -> Option<f64> {
        si(self.b, Quantity::BendingRigidity)
    }

    /// Returns `2HB`: width of the bending loop, moment per width, in N.
    #[must_use]
    pub fn bending_loop_width(&self) -> Option<f64> {
        si(self.two_hb, Quantity::MomentPerWidth)
    }

    /// Returns `G`: shear stiffness, in N/(m·rad).
    #[must_use]
    pub fn shear_stiffness(&self) -> Option<f64> {
        si(self.g, Quantity::ShearStiffness)
    }

    /// Returns `2HG`: width of the shear loop at 0.5°, in N/m.
    #[must_use]
    pub fn shear_loop_width(&self) -> Option<f64> {
        si(self.two_hg, Quantity::ForcePerWidth)
    }

    /// Returns `2HG5`: width of the shear loop at 5°, in N/m.
    #[must_use]
    pub fn shear_loop_width_at_five_degrees(&self) -> Option<f64> {
        si(self.two_hg5, Quantity::ForcePerWidth)
    }

    /// Returns `LT`: work to the maximum load over the work of a straight line to the maximum load,
    /// a ratio.
    #[must_use]
    pub fn tensile_linearity(&self) -> Option<f64> {
        self.lt
    }

    /// Returns `WT`: work per area to the maximum load, in J/m².
    #[must_use]
    pub fn tensile_work(&self) -> Option<f64> {
        si(self.wt, Quantity::WorkPerArea)
    }

    /// Returns `RT`: work recovered over work spent, a ratio.
    #[must_use]
    pub fn tensile_resilience(&self) -> Option<f64> {
        si(self.rt, Quantity::Ratio)
    }

    /// Returns `EM`: strain at the maximum load, a ratio.
    #[must_use]
    pub fn tensile_extension(&self) -> Option<f64> {
        si(self.em, Quantity::Ratio)
    }

    /// Returns whether all values are `None`.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the value of `symbol`, in the laboratory's unit.
    #[must_use]
    pub fn get(&self, symbol: Symbol) -> Option<f64> {
        match symbol {
            Symbol::B => self.b,
            Symbol::TwoHb => self.two_hb,
            Symbol::G => self.g,
            Symbol::TwoHg => self.two_hg,
            Symbol::TwoHg5 => self.two_hg5,
            Symbol::Lt => self.lt,
            Symbol::Wt => self.wt,
            Symbol::Rt => self.rt,
            Symbol::Em => self.em,
        }
    }

    /// Returns a mutable reference to the value of `symbol`.
    pub fn get_mut(&mut self, symbol: Symbol) -> &mut Option<f64> {
        match symbol {
            Symbol::B => &mut self.b,
            Symbol::TwoHb => &mut self.two_hb,
            Symbol::G => &mut self.g,
            Symbol::TwoHg => &mut self.two_hg,
            Symbol::TwoHg5 => &mut self.two_hg5,
            Symbol::Lt => &mut self.lt,
            Symbol::Wt => &mut self.wt,
            Symbol::Rt => &mut self.rt,
            Symbol::Em => &mut self.em,
        }
    }
}

/// Converts `value` from the laboratory's unit of `quantity` to SI.
fn si(value: Option<f64>, quantity: Quantity) -> Option<f64> {
    value.map(|value| value * quantity.laboratory().factor)
}
