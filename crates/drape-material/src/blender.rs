//! Blender: a script that sets the cloth modifier of a mesh, from the fabric and from the mesh.
//!
//! Its formulas were read in the sources of Blender \[Ble25\] and tried in Blender 4.5: a strip that
//! hangs, a panel that shears and a cantilever come to the places that they have by hand.

use askama::Template;

use crate::material::Material;
use crate::number::{brief, mean, number, one_line, wrapped};

/// Letters of a line of comments.
const LETTERS: usize = 96;

#[derive(Template)]
#[template(path = "blender.py", escape = "none")]
struct Script<'a> {
    name: String,
    /// Name as a text of Python.
    literal: String,
    version: &'static str,
    density: String,
    thickness: String,
    load: String,
    stretch: String,
    compression: String,
    shear: String,
    /// Shear stiffness where yarns are slack, in N/m.
    slack_shear: String,
    bending: String,
    losses: Vec<Vec<String>>,
    material: &'a Material,
}

impl Material {
    /// Returns a script for Blender that sets the cloth modifier of the selected meshes.
    ///
    /// The settings depend on the mesh: the springs of Blender stand for cloth of the width of a
    /// cell. So the script has the numbers of the fabric, and makes settings of them by the mesh.
    #[must_use]
    pub fn to_blender(&self) -> String {
        let name = one_line(&self.name);
        let pair = |pair: [f64; 2]| format!("({}, {})", number(pair[0]), number(pair[1]));
        let losses = self.losses_without_direction("Blender");
        let script = Script {
            literal: serde_json::Value::from(name.clone()).to_string(),
            name,
            version: env!("CARGO_PKG_VERSION"),
            density: number(self.density),
            thickness: number(self.thickness),
            load: number(self.stretch[0].load),
            stretch: pair(self.stiffnesses()),
            compression: pair(self.compression),
            shear: number(self.shear),
            slack_shear: brief(self.slack_shear()),
            bending: pair(self.bending),
            losses: losses.iter().map(|loss| wrapped(loss, LETTERS)).collect(),
            material: self,
        };
        script.render().expect("writing to a string does not fail")
    }

    /// Returns the shear stiffness of Blender's cells where the yarns are slack, in N/m.
    ///
    /// A shear stress `$\tau$` is the tension of one diagonal, which presses the yarns of both
    /// directions by `$\tau$`: the angle grows by `$2\tau/K_c$`, with their stiffness `$K_c$`
    /// against compression, so that `$1/G' = 1/G + 2/K_c$`.
    fn slack_shear(&self) -> f64 {
        let shear = self.shear;
        shear / (1.0 + 2.0 * shear / mean(self.compression))
    }
}
