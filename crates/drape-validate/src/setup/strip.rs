//! Strip: a rectangular strip of a fabric with linear laws, held at its left end.
//!
//! The exact solutions describe thin strips, so most cases simulate a strip. The shape of a strip
//! depends on the ratio `$wL^3/B$` of its weight per area `$w$`, length `$L$` and bending rigidity
//! `$B$`.

use drape_dynamics::Simulation;
use drape_fabric::Fabric;
use drape_scene::{PanelSpec, PinSpec, Scene, SceneSpec};

use super::fabrics::fabric;
use super::scene::with_panel;
use crate::error::ValidationError;

/// Acceleration of gravity in all scenes of the suite, in m/s².
pub const GRAVITY: f64 = 9.81;

/// Hold of the left end of a strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Hold {
    /// In a clamp: place and slope.
    ///
    /// A clamp holds three rows of particles, and its line lies midway between the second and the
    /// third row. At this line the slope is held, and the third row bends as the first free cell of
    /// a beam does. The second row of a panel also bends for the half cell at its edge, so a line
    /// next to the first row would be wrong by a third of a cell.
    #[default]
    Clamp,
    /// By a hinge: the first row stays in its place and turns.
    Hinge,
    /// Not at all.
    Free,
}

/// Friction of a Dahl element in bending \[Dahl68\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    /// Plateau per width, in N; none if zero.
    pub plateau: f64,
    /// Curvature over which the friction builds up, in 1/m.
    pub length: f64,
}

/// Point of the middle line of a strip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinePoint {
    /// Distance from the held end along the strip at rest, in m.
    pub distance: f64,
    /// Position in space, in m.
    pub position: [f64; 3],
}

/// Rectangular strip along its weft, held at its left end, where its free length begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strip {
    /// Free length, in m.
    pub length: f64,
    /// Width, in m.
    pub width: f64,
    /// Whole cells along the free length.
    pub cells: usize,
    /// Hold of its left end.
    pub hold: Hold,
    /// Mass per area, in kg/m².
    pub density: f64,
    /// Bending rigidity of both yarn systems, in N·m.
    pub rigidity: f64,
    /// Tensile stiffness of both yarn systems, in N/m.
    pub stiffness: f64,
    /// Friction of bending of both yarn systems.
    pub friction: Friction,
    /// Rate of turning about z through its middle at the start, in 1/s.
    pub spin: f64,
}

impl Default for Strip {
    /// Returns a strip of 10 × 2 cm of a nearly inextensible fabric of 200 g/m² with a bending
    /// length of 20 mm.
    fn default() -> Self {
        Self {
            length: 0.1,
            width: 0.02,
            cells: 40,
            hold: Hold::Clamp,
            density: 0.2,
            rigidity: 1.6e-5,
            stiffness: 1e4,
            friction: Friction { plateau: 0.0, length: 1.0 },
            spin: 0.0,
        }
    }
}

impl Strip {
    /// Returns the strip with the length at which `$wL^3/B$` is `ratio`. The number of cells stays.
    #[must_use]
    pub fn with_weight(self, ratio: f64) -> Self {
        let length = (ratio * self.rigidity / (self.density * GRAVITY)).cbrt();
        Self { length, width: 0.2 * length, ..self }
    }

    /// Returns the distance of the particles along the strip, in m: `length` over the free cells.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        let half_cell = if self.hold == Hold::Clamp { 0.5 } else { 0.0 };
        self.length / (self.cells as f64 + half_cell)
    }

    /// Returns the length of the strip inside its clamp, in m: zero without [`Hold::Clamp`].
    pub(crate) fn clamped_length(&self) -> f64 {
        if self.hold == Hold::Clamp { 1.5 * self.spacing() } else { 0.0 }
    }

    /// Returns the fabric of the strip, with equal laws along warp and weft.
    ///
    /// # Errors
    /// The numbers of the strip make no fabric.
    fn fabric(&self) -> Result<Fabric, ValidationError> {
        let Self { density, rigidity, stiffness, friction: Friction { plateau, length }, .. } =
            self;
        let friction = if *plateau > 0.0 {
            format!("friction = [{{ plateau = {plateau:e}, length = {length:e} }}], ")
        } else {
            String::new()
        };

        // A toe ratio of one makes the traction linear.
        let direction = format!(
            "traction = {{ primed = {{ stiffness = {stiffness:e}, toe_ratio = 1.0, toe_strain = 0.01, \
             toe_strain_after = 0.01 }} }}\nbending = {{ {friction}rigidity = {rigidity:e} }}\n"
        );
        fabric(&format!(
            "name = \"strip\"\ndensity = {density:e}\nthickness = 0.0001\nshear = {{ stiffness = 50 }}\n\
             [warp]\n{direction}[weft]\n{direction}"
        ))
    }

    /// Returns a simulation of the strip without air. The strip is held at the origin, and turned
    /// from x about z by `angle`, in degrees.
    ///
    /// `rest` is the rest of the scene: times, further pins, the solver.
    ///
    /// # Errors
    /// The scene has mistakes, or cannot be prepared.
    pub fn simulation(&self, angle: f64, rest: SceneSpec) -> Result<Simulation, ValidationError> {
        Ok(Simulation::new(self.scene(angle, rest)?)?)
    }

    /// Returns the scene of [`Strip::simulation`], with the same `angle` and `rest`.
    ///
    /// # Errors
    /// The scene has mistakes.
    pub fn scene(&self, angle: f64, rest: SceneSpec) -> Result<Scene, ValidationError> {
        let (clamped, width, spacing) = (self.clamped_length(), self.width, self.spacing());
        let held_rows = match self.hold {
            Hold::Clamp => 3,
            Hold::Hinge => 1,
            Hold::Free => 0,
        };

        // A panel turns about its middle.
        let panel = self.length + clamped;
        let middle = 0.5 * panel - clamped;
        let (sin, cos) = angle.to_radians().sin_cos();
        let mut spec = SceneSpec { name: Some("strip".into()), spacing, ..rest };
        spec.air.density = 0.0;
        spec.contact.surfaces = Some(false);
        let panel = PanelSpec {
            name: "strip".into(),
            fabric: "strip".into(),
            rectangle: Some([panel, width]),
            center: [middle * cos, middle * sin, 0.0],
            turn: [-90.0, 0.0, angle],
            spin: [0.0, 0.0, 360.0 * self.spin],
            ..PanelSpec::default()
        };
        let mut spec = with_panel(spec, panel, &self.fabric()?);
        if held_rows > 0 {
            let edge = Some("left".into());
            let panel = "strip".into();
            spec.pin.insert(0, PinSpec { panel, edge, rows: held_rows, ..PinSpec::default() });
        }
        Ok(spec.build()?)
    }

    /// Returns the points of the middle line of the strip in `simulation`, from the held end to the
    /// free end.
    #[must_use]
    pub fn line(&self, simulation: &Simulation) -> Vec<LinePoint> {
        let coordinates = simulation.coordinates();
        let positions = simulation.positions().to_vec();

        // The line is the row of particles nearest to the middle, or the lower of two such rows.
        let across = coordinates.iter().map(|c| c[1]).fold(f64::MIN, f64::max);
        let nearest =
            coordinates.iter().map(|c| (c[1] - 0.5 * across).abs()).fold(f64::INFINITY, f64::min);
        let mut line: Vec<LinePoint> = coordinates
            .iter()
            .zip(positions.chunks_exact(3))
            .filter(|(c, _)| {
                (c[1] - 0.5 * across).abs() <= nearest * (1.0 + 1e-9) + 1e-12
                    && c[1] <= 0.5 * across + 1e-12
            })
            .map(|(c, x)| LinePoint {
                distance: c[0] - self.clamped_length(),
                position: [x[0], x[1], x[2]],
            })
            .collect();
        line.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        line
    }

    /// Returns the middle of the free end in `simulation`, in m. Not numbers if the strip has no
    /// particles.
    #[must_use]
    pub fn tip(&self, simulation: &Simulation) -> [f64; 3] {
        self.line(simulation).last().map_or([f64::NAN; 3], |point| point.position)
    }
}
