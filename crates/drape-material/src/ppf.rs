//! ppf-contact-solver: a material profile of its Blender add-on, with the parameters of its Python
//! interface in the comments.

use askama::Template;
use toml::Value;

use crate::material::Material;
use crate::number::{brief, mean, number, one_line, wrapped};

/// Factor from the solver's `bend` to a bending rigidity over mass per area, in m⁴/s².
const BEND_SCALE: f64 = 1.28e-5;

/// Largest number of letters of a line of comments.
const LETTERS: usize = 96;

/// Parameters of a shell of ppf-contact-solver \[PPF26\].
///
/// The Baraff–Witkin model has the energy per mass
/// `$\tfrac12\mu((|F_u|-1)^2 + (|F_v|-1)^2) + \tfrac12\lambda(F_u\cdot F_v)^2$`, with the Lamé
/// parameters of a solid. Stretch and shear stiffness therefore are `$K = \rho\mu$` and
/// `$G = \rho\lambda$`:
///
/// ```math
/// \nu = \frac{G/K}{2(1 + G/K)},\qquad E = 2(1 + \nu)\,K/\rho
/// ```
///
/// A hinge has the stiffness `$1.28\cdot10^{-5}\,b\,\rho\,|e|^2/(A_1 + A_2)$`. In a sheet of right
/// or equilateral triangles this is the rigidity `$B = 1.28\cdot10^{-5}\,b\,\rho$`.
pub(crate) struct Shell {
    /// Ratio of modulus to density, in Pa per kg/m³, of a shell of unit thickness.
    pub(crate) young_modulus: f64,
    pub(crate) poisson_ratio: f64,
    /// Parameter `bend` of warp and weft.
    pub(crate) bend: [f64; 2],
}

impl Shell {
    /// Returns the parameters of `material`.
    pub(crate) fn new(material: &Material) -> Self {
        let stretch = mean(material.stiffnesses());
        let ratio = material.shear / stretch;
        let poisson_ratio = ratio / (2.0 * (1.0 + ratio));
        let bend = material.bending.map(|rigidity| rigidity / (BEND_SCALE * material.density));
        Self {
            young_modulus: 2.0 * (1.0 + poisson_ratio) * stretch / material.density,
            poisson_ratio,
            bend,
        }
    }
}

/// Profile with its numbers as texts.
#[derive(Template)]
#[template(path = "ppf.toml", escape = "none")]
struct Profile {
    heading: Vec<String>,
    losses: Vec<Vec<String>>,
    key: String,
    density: String,
    stretch: String,
    load: String,
    young_modulus: String,
    shear: String,
    poisson_ratio: String,
    bending: String,
    bend: String,
    bend_least: String,
    bend_warp: String,
    bend_weft: String,
    friction: String,
    contact_offset: String,
}

impl Material {
    /// Returns a material profile of the Blender add-on of ppf-contact-solver, as TOML. Comments
    /// state the origin of each number and the `losses`.
    #[must_use]
    pub fn to_ppf(&self) -> String {
        let Shell { young_modulus, poisson_ratio, bend } = Shell::new(self);
        let least = bend[0].min(bend[1]);

        let heading = format!(
            "Fabric \"{}\" for ppf-contact-solver (github.com/st-tech/ppf-contact-solver), written by drape {}.",
            one_line(&self.name),
            env!("CARGO_PKG_VERSION"),
        );
        let profile = Profile {
            heading: wrapped(&heading, LETTERS),
            losses: self.ppf_losses().iter().map(|loss| wrapped(loss, LETTERS - 2)).collect(),
            key: key(&self.name),
            density: number(self.density),
            stretch: number(mean(self.stiffnesses())),
            load: number(self.stretch[0].load),
            young_modulus: number(young_modulus),
            shear: number(self.shear),
            poisson_ratio: number(poisson_ratio),
            bending: number(mean(self.bending)),
            bend: number(mean(bend)),
            bend_least: number(least),
            bend_warp: number(bend[0] - least),
            bend_weft: number(bend[1] - least),
            friction: number(self.surface_friction),
            contact_offset: number(0.5 * self.thickness),
        };
        profile.render().expect("writing to a string does not fail")
    }

    /// Returns the `losses` of this format: a shell of the solver has one stiffness for warp and
    /// weft, and does not buckle.
    fn ppf_losses(&self) -> Vec<String> {
        let mut losses = self.losses_without_direction("the profile");
        losses.push(format!(
            "Compression: a shell resists it like tension. The yarns of the fabric buckle: {} and {} N/m (warp \
             and weft) from rest to 1 %.",
            brief(self.compression[0]),
            brief(self.compression[1]),
        ));
        losses.push(
            "Bias: a shell bends there like along the yarns, a weave at half of that.".into(),
        );
        losses
    }
}

/// Returns `name` as a key of TOML, in quotes.
fn key(name: &str) -> String {
    let name = one_line(name);
    Value::String(if name.is_empty() { "fabric".into() } else { name }).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::tests::linear;
    use crate::number::rounded;

    #[test]
    fn the_energies_of_the_solver_are_those_of_a_linear_fabric() {
        let material = linear();
        let Shell { young_modulus, poisson_ratio, bend } = Shell::new(&material);
        // The Lamé parameters that the solver makes of them, by its own formulas.
        let mu = young_modulus / (2.0 * (1.0 + poisson_ratio));
        let lambda =
            young_modulus * poisson_ratio / ((1.0 + poisson_ratio) * (1.0 - 2.0 * poisson_ratio));
        let stretch = mean(material.stiffnesses());
        assert!((material.density * mu / stretch - 1.0).abs() < 1e-12, "{mu}");
        assert!((material.density * lambda / material.shear - 1.0).abs() < 1e-12, "{lambda}");
        for (bend, rigidity) in bend.into_iter().zip(material.bending) {
            assert!((BEND_SCALE * bend * material.density / rigidity - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_name_is_a_key_whatever_it_holds() {
        let mut material = linear();
        for name in ["cotton \"no. 1\"", "綿ブロード", "a.b [c]\n= 1", ""] {
            material.name = name.into();
            let table: toml::Table = material.to_ppf().parse().expect("TOML");
            let (key, profile) = table.iter().next().expect("one material");
            assert_eq!(*key, if name.is_empty() { "fabric".into() } else { one_line(name) });
            assert_eq!(profile["shell_density"].as_float(), Some(rounded(material.density)));
        }
    }
}
