//! Material: the numbers of a fabric for other programs, by virtual tests of its laws.

use drape_fabric::Fabric;
use drape_fit::fabric_values;
use drape_kes::{BendingPoints, Direction, EvaluationPoints, ShearPoints, Sheet};

use crate::error::Error;
use crate::loss;
use crate::stretch::{Stretch, compression};

/// Admissible loads of a secant, in N/m: from the weight of a hem to a load that tears the fabric.
const LOADS: std::ops::RangeInclusive<f64> = 0.1..=1e4;

/// Directions, in the order of pairs: warp, weft.
const DIRECTIONS: [Direction; 2] = [Direction::Warp, Direction::Weft];

/// Numbers of a fabric for other programs, in SI. The first number of a pair belongs to the warp,
/// the second to the weft.
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
/// let material = Material::from_fabric(&fabric, Material::LOAD)?;
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
    /// Stretch under the load, of warp and weft.
    pub stretch: [Stretch; 2],
    /// Stiffness against compression of 1 % from rest, in N/m.
    pub compression: [f64; 2],
    /// Bending rigidity, KES B, in N·m.
    pub bending: [f64; 2],
    /// Shear stiffness, KES G, in N/m per rad.
    pub shear: f64,
    /// Properties of the fabric that these numbers lose, each in a sentence or two.
    pub losses: Vec<String>,
    /// The fabric itself, as TOML.
    pub toml: String,
}

impl Material {
    /// Usual load of the stretch, in N/m. The weight of a garment pulls with a few newtons per
    /// metre, and a movement of the wearer with more. FAST reads its E20 at 19.6 N/m.
    pub const LOAD: f64 = 20.0;

    /// Returns the numbers of `fabric`, with the stretch under `load`, in N/m.
    ///
    /// Stretch and compression are secants of the traction laws of a virgin fabric. Bending and
    /// shear are KES B and G of simulated KES tests ([`fabric_values`]).
    ///
    /// # Errors
    /// [`Error::Load`] for a load outside 0.1 to 10 000 N/m, [`Error::NoStretch`] for a load that
    /// the fabric does not carry, and [`Error::Missing`] for laws without a B or G.
    pub fn from_fabric(fabric: &Fabric, load: f64) -> Result<Self, Error> {
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
        let stretch = [Stretch::new(warp, "warp", load)?, Stretch::new(weft, "weft", load)?];
        let mut bending = [0.0; 2];
        for ((rigidity, values), direction) in bending.iter_mut().zip(&values).zip(DIRECTIONS) {
            let value = values.bending_rigidity();
            *rigidity = value.ok_or(missing(direction, "bending rigidity B"))?;
        }
        let shear = values[0].shear_stiffness();

        Ok(Self {
            name: fabric.name.clone(),
            density: fabric.density,
            thickness: fabric.thickness,
            surface_friction: fabric.surface_friction,
            stretch,
            compression: [compression(warp), compression(weft)],
            bending,
            shear: shear.ok_or(missing(Direction::Warp, "shear stiffness G"))?,
            losses: loss::losses(fabric, &values, stretch),
            toml: fabric.to_toml(),
        })
    }

    /// Returns the secant stiffnesses of `stretch`, in N/m.
    pub(crate) fn stiffnesses(&self) -> [f64; 2] {
        self.stretch.map(|stretch| stretch.stiffness)
    }

    /// Returns the losses of the format of a `program` with one number for warp and weft.
    pub(crate) fn losses_without_direction(&self, program: &str) -> Vec<String> {
        let mut losses = self.losses.clone();
        losses.push(loss::direction(program, self.stiffnesses(), self.bending));
        losses
    }
}

/// Returns the error for a missing `value` of a `direction`.
fn missing(direction: Direction, value: &'static str) -> Error {
    Error::Missing { direction: direction.name(), value }
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
        Material::from_fabric(&fabric, Material::LOAD).expect("numbers")
    }
}
