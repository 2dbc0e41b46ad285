//! Blender: a script that sets the cloth modifier of a mesh, from the fabric and from the mesh.
//!
//! The formulas come from the sources of Blender \[Ble25\]. In Blender 4.5 a hanging strip, a
//! sheared panel and a cantilever reached the shapes that were calculated by hand.

use askama::Template;

use crate::material::Material;
use crate::number::{brief, mean, number, one_line, wrapped};

/// Largest number of letters of a line of comments.
const LETTERS: usize = 96;

/// Script with its numbers as texts.
#[derive(Template)]
#[template(path = "blender.py", escape = "none")]
struct Script<'a> {
    name: String,
    /// Name as a string literal of Python.
    literal: String,
    version: &'static str,
    density: String,
    thickness: String,
    load: String,
    stretch: String,
    compression: String,
    shear: String,
    /// Shear stiffness with slack yarns, in N/m.
    slack_shear: String,
    bending: String,
    losses: Vec<Vec<String>>,
    material: &'a Material,
}

impl Material {
    /// Returns a script for Blender that sets the cloth modifier of the selected meshes.
    ///
    /// The settings depend on the mesh, because a spring of Blender represents cloth of the width
    /// of a cell. The script therefore contains the numbers of the fabric, and computes the
    /// settings from the selected mesh.
    #[must_use]
    pub fn to_blender(&self) -> String {
        let name = one_line(&self.name);
        let losses = self.losses_without_direction("Blender");
        let script = Script {
            literal: serde_json::Value::from(name.clone()).to_string(),
            name,
            version: env!("CARGO_PKG_VERSION"),
            density: number(self.density),
            thickness: number(self.thickness),
            load: number(self.stretch[0].load),
            stretch: python_pair(self.stiffnesses()),
            compression: python_pair(self.compression),
            shear: number(self.shear),
            slack_shear: brief(self.slack_shear()),
            bending: python_pair(self.bending),
            losses: losses.iter().map(|loss| wrapped(loss, LETTERS)).collect(),
            material: self,
        };
        script.render().expect("writing to a string does not fail")
    }

    /// Returns the shear stiffness of Blender's cells with slack yarns, in N/m, from `shear` and
    /// `compression`.
    ///
    /// A shear stress `$\tau$` is the tension of one diagonal, which compresses the yarns of both
    /// directions by `$\tau$`. With the yarns' stiffness `$K_c$` against compression the angle
    /// grows by `$2\tau/K_c$`, so that `$1/G' = 1/G + 2/K_c$`.
    fn slack_shear(&self) -> f64 {
        let shear = self.shear;
        shear / (1.0 + 2.0 * shear / mean(self.compression))
    }
}

/// Returns `pair` as a tuple of Python.
fn python_pair(pair: [f64; 2]) -> String {
    format!("({}, {})", number(pair[0]), number(pair[1]))
}
