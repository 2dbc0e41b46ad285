//! Values of a sheet in a list, each with its use in the model.

use std::ops::RangeInclusive;

use crate::sheets::checks::plausible;
use crate::sheets::sheet::Sheet;
use crate::symbol::Symbol;
use crate::test::{Direction, Test};

/// Symbol, name in words, value, unit and use of a value.
type Row = (&'static str, &'static str, Option<f64>, &'static str, Option<&'static str>);

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
    /// Part of the model that the value gives; `None` where the model does not use the value.
    pub used_for: Option<&'static str>,
}

/// Returns the name of `symbol` in words.
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
    /// Returns every value of the sheet, in the order in which laboratories print values: tension,
    /// shear, bending, compression, surface, thickness and mass.
    ///
    /// A value whose test has a curve in the sheet is not used, because the law follows the curve.
    #[must_use]
    pub fn listed(&self) -> Vec<SheetValue> {
        use Symbol::{B, Em, G, Lt, Rt, TwoHb, TwoHg, TwoHg5, Wt};
        let mut listed = Vec::new();
        for symbol in [Lt, Wt, Rt, Em, G, TwoHg, TwoHg5, B, TwoHb] {
            for direction in [Direction::Warp, Direction::Weft] {
                let law = match symbol.test() {
                    Test::Tensile => "traction",
                    Test::Shear => "shear",
                    Test::Bending | Test::LoopBending => "bending",
                };
                let used_for = (!self.has_curve(symbol.test(), direction)).then_some(law);
                let value = self.values(direction).get(symbol);
                let row = (symbol.name(), words(symbol), value, symbol.unit(), used_for);
                add(&mut listed, Some(direction), &[row]);
            }
        }

        // The contact needs WC only where TM or LC is missing.
        let contact = Some("contact");
        let is_needed = self.tm.is_none() || self.lc.is_none();
        let compression = [
            ("LC", "compression linearity", self.lc, "", contact),
            ("WC", "compression work", self.wc, "gf·cm/cm²", contact.filter(|_| is_needed)),
            ("RC", "compression resilience", self.rc, "%", None),
        ];
        add(&mut listed, None, &compression);
        for direction in [Direction::Warp, Direction::Weft] {
            let values = self.values(direction);
            let surface = [
                ("MIU", "surface friction", values.miu, "", Some("friction")),
                ("MMD", "deviation of the friction", values.mmd, "", None),
                ("SMD", "surface roughness", values.smd, "µm", None),
            ];
            add(&mut listed, Some(direction), &surface);
        }

        let of_thickness = Some("thickness, contact");
        let of_t = of_thickness.filter(|_| self.t0.is_none());
        let whole = [
            ("T0", "thickness at 0.5 gf/cm²", self.t0, "mm", of_thickness),
            ("TM", "thickness at 50 gf/cm²", self.tm, "mm", contact),
            ("T", "thickness", self.t, "mm", of_t),
            ("W", "mass per area", self.w, "mg/cm²", Some("mass")),
            ("FM", "largest load of the tensile test", self.fm, "gf/cm", Some("traction")),
        ];
        add(&mut listed, None, &whole);
        listed
    }

    /// Returns whether the sheet has a curve that replaces the values of `test` in `direction`.
    fn has_curve(&self, test: Test, direction: Direction) -> bool {
        match test {
            // Shear has one law for both directions.
            Test::Shear => self.curves.iter().any(|curve| curve.test == test),
            Test::Bending => self.curves.iter().any(|curve| {
                curve.direction == direction
                    && matches!(curve.test, Test::Bending | Test::LoopBending)
            }),
            _ => self.curves_of(test, direction).next().is_some(),
        }
    }

    /// Returns the range of the value `symbol` that nine in ten fabrics have, in SI. The symbol `c`
    /// stands for the bending length. The range of G is the range of fabrics of the sheet's mass
    /// per area.
    ///
    /// Returns `None` where the value was not measured on many fabrics.
    ///
    /// ```
    /// use drape_kes::Sheet;
    ///
    /// let mut sheet = Sheet::default();
    /// sheet.w = Some(11.0);
    /// let range = sheet.usual_range("G", None).expect("known");
    /// let [least, most] = [*range.start(), *range.end()];
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

    /// Returns the publication of the range that [`Sheet::usual_range`] has for `symbol`; `None`
    /// where there is no range.
    #[must_use]
    pub fn usual_source(symbol: &str) -> Option<&'static str> {
        plausible::usual_source(symbol)
    }

    /// Returns the bending length of `direction`, the cube root of rigidity over weight per area,
    /// in m. Returns `None` without B or W.
    #[must_use]
    pub fn bending_length(&self, direction: Direction) -> Option<f64> {
        let rigidity = self.values(direction).bending_rigidity()?;
        Some(plausible::bending_length(rigidity, self.density()?))
    }
}

/// Adds the values of `rows` that are given to `listed`, with their `direction`.
fn add(listed: &mut Vec<SheetValue>, direction: Option<Direction>, rows: &[Row]) {
    for &(symbol, name, value, unit, used_for) in rows {
        let value =
            value.map(|value| SheetValue { symbol, name, direction, value, unit, used_for });
        listed.extend(value);
    }
}
