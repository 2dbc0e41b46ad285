//! Values of a sheet in a list, each with what the model uses it for.

use std::ops::RangeInclusive;

use crate::sheets::checks::plausible;
use crate::sheets::sheet::Sheet;
use crate::symbol::Symbol;
use crate::test::{Direction, Test};

/// Value of a sheet, as the laboratory wrote it.
///
/// ```
/// use drape_kes::Sheet;
///
/// let mut sheet = Sheet::default();
/// (sheet.w, sheet.rc) = (Some(12.0), Some(45.0));
/// let listed = sheet.listed();
/// assert_eq!((listed[0].symbol, listed[0].value, listed[0].unit), ("RC", 45.0, "%"));
/// assert_eq!(listed[0].used_for, None);
/// assert_eq!(listed[1].used_for, Some("mass"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SheetValue {
    /// Symbol.
    pub symbol: &'static str,
    /// Name in words.
    pub name: &'static str,
    /// Direction, where the value has one.
    pub direction: Option<Direction>,
    /// Value, in the laboratory's unit.
    pub value: f64,
    /// Laboratory's unit; empty for a ratio.
    pub unit: &'static str,
    /// Part of the model that it gives; `None` where the model does not use it.
    pub used_for: Option<&'static str>,
}

/// Returns the words of a symbol.
fn words(symbol: Symbol) -> &'static str {
    match symbol {
        Symbol::B => "bending rigidity",
        Symbol::TwoHb => "bending loop width",
        Symbol::G => "shear stiffness",
        Symbol::TwoHg => "shear loop width at 0.5°",
        Symbol::TwoHg5 => "shear loop width at 5°",
        Symbol::Lt => "tensile linearity",
        Symbol::Wt => "tensile work",
        Symbol::Rt => "tensile resilience",
        Symbol::Em => "extension at the largest load",
    }
}

impl Sheet {
    /// Returns every value of the sheet, in the order in which laboratories print them: tension,
    /// shear, bending, compression, surface, thickness and mass.
    ///
    /// A value whose test has a curve in the sheet is not used: the curve is.
    #[must_use]
    pub fn listed(&self) -> Vec<SheetValue> {
        use Symbol::{B, Em, G, Lt, Rt, TwoHb, TwoHg, TwoHg5, Wt};
        let mut listed = Vec::new();
        let has_curve = |test: Test, direction: Direction| match test {
            // One law for both directions.
            Test::Shear => self.curves.iter().any(|curve| curve.test == test),
            Test::Bending => self.curves.iter().any(|curve| {
                curve.direction == direction
                    && matches!(curve.test, Test::Bending | Test::LoopBending)
            }),
            _ => self.curves_of(test, direction).next().is_some(),
        };
        for symbol in [Lt, Wt, Rt, Em, G, TwoHg, TwoHg5, B, TwoHb] {
            for direction in [Direction::Warp, Direction::Weft] {
                let Some(value) = self.values(direction).get(symbol) else { continue };
                let law = match symbol.test() {
                    Test::Tensile => "traction",
                    Test::Shear => "shear",
                    Test::Bending | Test::LoopBending => "bending",
                };
                let used_for = (!has_curve(symbol.test(), direction)).then_some(law);
                listed.push(SheetValue {
                    symbol: symbol.name(),
                    name: words(symbol),
                    direction: Some(direction),
                    value,
                    unit: symbol.unit(),
                    used_for,
                });
            }
        }
        let mut add = |direction, symbol, name, value: Option<f64>, unit, used_for| {
            let one =
                value.map(|value| SheetValue { symbol, name, direction, value, unit, used_for });
            listed.extend(one);
        };
        let contact = Some("contact");
        let needed = self.tm.is_none() || self.lc.is_none();
        add(None, "LC", "compression linearity", self.lc, "", contact);
        add(None, "WC", "compression work", self.wc, "gf·cm/cm²", contact.filter(|_| needed));
        add(None, "RC", "compression resilience", self.rc, "%", None);
        for direction in [Direction::Warp, Direction::Weft] {
            let values = self.values(direction);
            let surface = [
                ("MIU", "surface friction", values.miu, "", Some("friction")),
                ("MMD", "deviation of the friction", values.mmd, "", None),
                ("SMD", "surface roughness", values.smd, "µm", None),
            ];
            for (symbol, name, value, unit, used_for) in surface {
                add(Some(direction), symbol, name, value, unit, used_for);
            }
        }
        add(None, "T0", "thickness at 0.5 gf/cm²", self.t0, "mm", Some("thickness, contact"));
        add(None, "TM", "thickness at 50 gf/cm²", self.tm, "mm", contact);
        let thickness = Some("thickness, contact").filter(|_| self.t0.is_none());
        add(None, "T", "thickness", self.t, "mm", thickness);
        add(None, "W", "mass per area", self.w, "mg/cm²", Some("mass"));
        add(None, "FM", "largest load of the tensile test", self.fm, "gf/cm", Some("traction"));
        listed
    }

    /// Returns the range, in SI, that nine fabrics in ten have of a value, by its symbol; `c` stands for
    /// the bending length. That of G is for fabrics of the sheet's mass per area.
    ///
    /// `None` where the value was not measured on many fabrics.
    ///
    /// ```
    /// use drape_kes::Sheet;
    ///
    /// let mut sheet = Sheet::default();
    /// sheet.w = Some(11.0);
    /// let [least, most] = sheet.usual_range("G", None).map(|range| [*range.start(), *range.end()]).expect("known");
    /// // 0.18 to 1.6 gf/(cm·deg).
    /// assert!((least - 9.9).abs() < 0.1 && (most - 87.2).abs() < 0.1);
    /// assert_eq!(sheet.usual_range("MMD", None), None);
    /// ```
    #[must_use]
    pub fn usual_range(
        &self,
        symbol: &str,
        direction: Option<Direction>,
    ) -> Option<RangeInclusive<f64>> {
        plausible::usual_range(symbol, direction, self.density())
    }

    /// Returns where the range of [`Sheet::usual_range`] was published; `None` where there is none.
    #[must_use]
    pub fn usual_source(symbol: &str) -> Option<&'static str> {
        plausible::usual_source(symbol)
    }

    /// Returns the bending length of a direction, the cube root of rigidity over weight, in m; none
    /// without B or W.
    #[must_use]
    pub fn bending_length(&self, direction: Direction) -> Option<f64> {
        let rigidity = self.values(direction).bending_rigidity()?;
        Some(plausible::bending_length(rigidity, self.density()?))
    }
}
