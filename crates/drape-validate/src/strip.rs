use drape_input::Document;
use drape_scene::{PinLoad, Scene, Simulation};

use crate::ValidationError;

/// A rectangular strip of an elastic fabric along its weft, clamped at its left end.
///
/// The clamp holds three rows of particles, and its line lies midway between the second and the third: there the
/// slope is held, and the third row bends as the first free cell of a beam does. (The second row of a panel
/// bends for the half cell at its edge as well, so a line next to the first row would be a third of a cell off.)
/// The free length begins at that line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strip {
    /// Free length, in m.
    pub length: f64,
    /// Width, in m.
    pub width: f64,
    /// Cells along the free length, the half one at the clamp not counted.
    pub cells: usize,
    /// Mass per area, in kg/m².
    pub density: f64,
    /// Bending rigidity of both yarn systems, in N·m.
    pub rigidity: f64,
    /// Tensile stiffness of both yarn systems, in N/m.
    pub stiffness: f64,
    /// Shear stiffness, in N/m.
    pub shear: f64,
    /// Plateau and length of the bending friction, in N and 1/m.
    pub friction: Option<[f64; 2]>,
}

impl Default for Strip {
    /// A strip of 10 × 2 cm of a fabric of 200 g/m² with a bending length of 20 mm, nearly inextensible.
    fn default() -> Self {
        Self {
            length: 0.1,
            width: 0.02,
            cells: 20,
            density: 0.2,
            rigidity: 1.6e-5,
            stiffness: 5000.0,
            shear: 50.0,
            friction: None,
        }
    }
}

/// Acceleration of gravity in all scenes here, in m/s².
pub const GRAVITY: f64 = 9.81;

impl Strip {
    /// Spacing of the particles along the strip, in m.
    pub fn spacing(&self) -> f64 {
        self.length / (self.cells as f64 + 0.5)
    }

    /// Length of the panel, with what the clamp holds, in m.
    fn panel(&self) -> f64 {
        (self.cells + 2) as f64 * self.spacing()
    }

    fn fabric(&self) -> Document {
        let Self { density, rigidity, stiffness, shear, .. } = self;
        let friction = self.friction.map_or(String::new(), |[plateau, length]| {
            format!(", friction = [{{ plateau = {plateau:e}, length = {length:e} }}]")
        });
        let direction = format!(
            "traction = {{ primed = {{ stiffness = {stiffness:e}, toe_ratio = 1.0, toe_strain = 0.01, \
             toe_strain_after = 0.01 }} }}\nbending = {{ rigidity = {rigidity:e}{friction} }}\n"
        );
        let text = format!(
            "name = \"strip\"\ndensity = {density:e}\nthickness = 0.0001\n\
             shear = {{ stiffness = {shear:e} }}\n[warp]\n{direction}[weft]\n{direction}"
        );
        Document::new("strip-fabric.toml", text)
    }

    /// A simulation of the strip, lying level along x with the clamp's line at the origin.
    ///
    /// The text holds further tables of the scene: time, what turns or moves, how it is solved.
    ///
    /// # Errors
    /// A scene that cannot be read or prepared.
    pub fn simulation(&self, turn: [f64; 3], rest: &str) -> Result<Simulation, ValidationError> {
        let (panel, width, spacing) = (self.panel(), self.width, self.spacing());
        // The clamp's line is one and a half cells from the panel's left edge; the panel turns about its middle.
        let middle = 0.5 * panel - 1.5 * spacing;
        let (sin, cos) = turn[2].to_radians().sin_cos();
        let center = [middle * cos, middle * sin, 0.0];
        let text = format!(
            "name = \"strip\"\nspacing = {spacing:e}\n[fabric.strip]\nfile = \"strip-fabric.toml\"\n\
             [[panel]]\nname = \"strip\"\nfabric = \"strip\"\nrectangle = [{panel:e}, {width:e}]\n\
             center = {center:?}\nturn = {turn:?}\n[[pin]]\npanel = \"strip\"\nedge = \"left\"\nrows = 3\n{rest}"
        );
        let scene = Scene::from_documents(&Document::new("strip.toml", text), &[self.fabric()])?;
        Ok(Simulation::new(scene)?)
    }

    /// The middle of the free end, in m.
    pub fn tip(&self, simulation: &Simulation) -> [f64; 3] {
        let coordinates = simulation.coordinates();
        let positions = simulation.frame().positions;
        let end = coordinates.iter().map(|c| c[0]).fold(f64::MIN, f64::max) - 0.5 * self.spacing();
        let last = coordinates.iter().zip(positions.chunks_exact(3)).filter(|(c, _)| c[0] > end);
        let (mut sum, mut count) = ([0.0; 3], 0.0);
        for (_, place) in last {
            (0..3).for_each(|axis| sum[axis] += place[axis]);
            count += 1.0;
        }
        sum.map(|sum| sum / count)
    }
}

/// Runs a simulation to its end.
///
/// # Errors
/// A step that cannot be solved, or a cloth that does not come to rest where the scene asks for it.
pub fn finish(simulation: &mut Simulation) -> Result<(), ValidationError> {
    while !simulation.step()?.finished {}
    Ok(())
}

/// What the clamp bears.
pub fn clamp(simulation: &mut Simulation) -> PinLoad {
    simulation.pin_loads().first().copied().unwrap_or_default()
}
