//! Material: the numbers of a fabric that other programs ask for, by virtual tests of its laws.

use drape_fabric::Fabric;
use drape_fit::fabric_values;
use drape_kes::{BendingPoints, Direction, EvaluationPoints, ShearPoints, Sheet};

use crate::error::Error;
use crate::loss;
use crate::stretch::{Stretch, compression};

/// Loads at which a secant can be read, in N/m: from the weight of a hem to a load that tears.
const LOADS: std::ops::RangeInclusive<f64> = 0.1..=1e4;

/// Directions, in the order of pairs: warp, weft.
const DIRECTIONS: [Direction; 2] = [Direction::Warp, Direction::Weft];

/// Numbers of a fabric that other programs ask for, in SI. Pairs are of warp and weft.
///
/// ```
/// use drape_fabric::Fabric;
/// use drape_input::Document;
/// use drape_material::Material;
///
/// let text = r#"
///     name = "plain weave"
///     density = 0.12
///     thickness = 0.0003
///     shear.stiffness = 35.0
///     [warp]
///     traction.polynomial = { quadratic = 8.4e4, quartic = 0.0 }
///     bending.rigidity = 1.2e-5
///     [weft]
///     traction.polynomial = { quadratic = 8.4e4, quartic = 0.0 }
///     bending.rigidity = 0.8e-5
/// "#;
/// let fabric = Fabric::from_document(&Document::new("plain.toml", text))?;
/// let material = Material::of(&fabric, Material::LOAD)?;
/// // 20 N/m stretch it by sqrt(20 / 84000) = 1.54 %.
/// assert!((material.stretch[0].strain - 0.015_430).abs() < 1e-6);
/// assert!((material.stretch[0].stiffness - 1296.1).abs() < 0.1);
/// assert!((material.bending[1] - 0.8e-5).abs() < 1e-12);
/// assert!(material.to_blender().contains("DENSITY = 0.12"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name of the fabric.
    pub name: String,
    /// Mass per area, in kg/m².
    pub density: f64,
    /// Thickness under 49 Pa, in m.
    pub thickness: f64,
    /// Coefficient of friction of the surface, a ratio.
    pub surface_friction: f64,
    /// Stretch by the load, of warp and weft.
    pub stretch: [Stretch; 2],
    /// Stiffness against compression of 1 % from rest, in N/m.
    pub compression: [f64; 2],
    /// Bending rigidity, KES B, in N·m.
    pub bending: [f64; 2],
    /// Shear stiffness, KES G, in N/m per rad.
    pub shear: f64,
    /// What these numbers lose of the fabric, a sentence or two each.
    pub losses: Vec<String>,
    /// The fabric itself, as TOML.
    pub toml: String,
}

impl Material {
    /// Usual load at which the stretch is read, in N/m. The weight of a garment pulls with some
    /// newtons per metre, and a movement of its wearer with more. FAST reads its E20 at 19.6 N/m.
    pub const LOAD: f64 = 20.0;

    /// Reads the numbers off the laws of a fabric; the stretch at a load, in N/m.
    ///
    /// Stretch and compression are secants of the traction laws of a virgin fabric. Bending and
    /// shear are KES B and G of simulated KES tests ([`fabric_values`]).
    ///
    /// # Errors
    /// [`Error::Load`] for a load beyond 0.1 to 10 000 N/m, [`Error::NoStretch`] for one that the
    /// fabric never carries, [`Error::Missing`] for laws that give no B or G.
    pub fn of(fabric: &Fabric, load: f64) -> Result<Self, Error> {
        if !LOADS.contains(&load) {
            return Err(Error::Load { load });
        }
        let points = EvaluationPoints {
            maximum_tension: Sheet::default().maximum_tension(),
            bending: BendingPoints::default(),
            shear: ShearPoints::default(),
        };
        let values = DIRECTIONS.map(|direction| fabric_values(fabric, direction, &points));
        let [warp, weft] = [&fabric.warp, &fabric.weft].map(|laws| &laws.traction);
        let stretch = [Stretch::of(warp, "warp", load)?, Stretch::of(weft, "weft", load)?];
        let missing = |direction: Direction, value: &'static str| Error::Missing {
            direction: direction.name(),
            value,
        };
        let rigidity = |index: usize| {
            let rigidity = values[index].bending_rigidity();
            rigidity.ok_or_else(|| missing(DIRECTIONS[index], "bending rigidity B"))
        };
        let shear = values[0].shear_stiffness();
        Ok(Self {
            name: fabric.name.clone(),
            density: fabric.density,
            thickness: fabric.thickness,
            surface_friction: fabric.surface_friction,
            stretch,
            compression: [compression(warp), compression(weft)],
            bending: [rigidity(0)?, rigidity(1)?],
            shear: shear.ok_or_else(|| missing(Direction::Warp, "shear stiffness G"))?,
            losses: loss::of(fabric, &values, stretch),
            toml: fabric.to_toml(),
        })
    }

    /// Stiffnesses of the stretch, in N/m.
    pub(crate) fn stiffnesses(&self) -> [f64; 2] {
        self.stretch.map(|stretch| stretch.stiffness)
    }

    /// Returns the losses of a format that has one number for warp and weft, and no friction.
    pub(crate) fn losses_without_direction(&self, program: &str) -> Vec<String> {
        let mut losses = self.losses.clone();
        losses.push(loss::direction(program, self.stiffnesses(), self.bending));
        losses
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use drape_input::Document;

    /// Linear laws without friction, with numbers that no two have alike.
    pub(crate) const LINEAR: &str = r#"
        name = "linear"
        density = 0.15
        thickness = 0.0004
        surface_friction = 0.25
        shear.stiffness = 40.0
        [warp]
        traction.primed = { stiffness = 3000.0, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }
        bending.rigidity = 1.5e-5
        [weft]
        traction.primed = { stiffness = 2000.0, toe_ratio = 1.0, toe_strain = 0.01, toe_strain_after = 0.01 }
        bending.rigidity = 0.9e-5
    "#;

    pub(crate) fn linear() -> Material {
        let fabric =
            Fabric::from_document(&Document::new("linear.toml", LINEAR)).expect("a fabric");
        Material::of(&fabric, Material::LOAD).expect("numbers")
    }
}
