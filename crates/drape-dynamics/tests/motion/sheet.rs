//! A square metre of cloth, or less, in scenes that differ in few words.

use drape_dynamics::Simulation;
use drape_input::Document;
use drape_scene::{Error, Scene};

/// A cloth and how it is held. `Sheet::default()` is 0.2 kg/m² of plain weave in a vacuum.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Particles along a side.
    pub particles: usize,
    /// Length of a side, m.
    pub side: f64,
    /// Tension per width and strain, N/m.
    pub stiffness: f64,
    /// Bending rigidity, N·m.
    pub rigidity: f64,
    pub friction: bool,
    /// Whether bending has friction, if anything has.
    pub bending_friction: bool,
    /// More tables of the scene. Only particles meet bodies where they say nothing of contact.
    pub scene: String,
    /// Keys of the panel.
    pub panel: String,
}

impl Default for Sheet {
    fn default() -> Self {
        Self {
            particles: 11,
            side: 1.0,
            stiffness: 5000.0,
            rigidity: 1.2e-5,
            friction: true,
            bending_friction: true,
            scene: String::new(),
            panel: String::new(),
        }
    }
}

/// Held at two corners.
pub const CORNERS: &str = "[[pin]]\npanel = \"sheet\"\npoints = [[0, SIDE], [SIDE, SIDE]]\n";

/// Horizontal.
pub const FLAT: &str = "turn = [-90, 0, 0]\n";

impl Sheet {
    pub fn simulation(&self) -> Simulation {
        Simulation::new(self.scene()).unwrap()
    }

    pub fn scene(&self) -> Scene {
        self.try_scene().unwrap()
    }

    pub fn try_scene(&self) -> Result<Scene, Error> {
        let Self { particles, side, panel, scene, .. } = self;
        let spacing = side / (*particles as f64 - 1.0);
        let contact = if scene.contains("contact") { "" } else { "contact.surfaces = false\n" };
        let text = format!(
            "spacing = {spacing}\n{contact}fabric.plain.file = \"plain.toml\"\n{scene}\n[[panel]]\n\
             name = \"sheet\"\nfabric = \"plain\"\nrectangle = [SIDE, SIDE]\n{panel}"
        );
        let text = text.replace("SIDE", &format!("{side:?}"));
        let scene = Document::new("sheet.toml", text).allowing(&[std::env::temp_dir()]);
        let fabric = Document::new("plain.toml", self.fabric());
        Scene::from_documents(&scene, &[fabric])
    }

    fn fabric(&self) -> String {
        let friction = |scale: f64, plateau: f64, length: f64| match self.friction {
            true => {
                format!("friction = [{{ plateau = {:e}, length = {length} }}]", scale * plateau)
            }
            false => String::new(),
        };
        let (k, b) = (self.stiffness, self.rigidity);
        let traction = friction(k / 5000.0, 4.0, 0.001);
        let bending = friction(b / 1.2e-5, 6e-4, 4.0);
        let direction = format!(
            "traction.primed = {{ stiffness = {k}, toe_ratio = 0.6, toe_strain = 0.015, \
             toe_strain_after = 0.02 }}\n{}bending.rigidity = {b:e}\n{}",
            if self.friction { format!("traction.{traction}\n") } else { String::new() },
            if self.friction && self.bending_friction {
                format!("bending.{bending}\n")
            } else {
                String::new()
            },
        );
        format!(
            "name = \"plain\"\ndensity = 0.2\nthickness = 0.0004\n[warp]\n{direction}[weft]\n\
             {direction}[shear]\nstiffness = 50.0\n{}\n",
            friction(1.0, 0.5, 0.004)
        )
    }
}

/// Largest distance of a particle in two simulations, m.
pub fn apart(one: &Simulation, other: &Simulation) -> f64 {
    let (one, other) = (one.positions().to_vec(), other.positions().to_vec());
    one.iter().zip(&other).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}
