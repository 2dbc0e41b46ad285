//! Strip: a rectangular strip of a fabric with linear laws, held at its left end.
//!
//! Exact solutions are those of thin strips, so most cases simulate one. Its weight counts by the
//! ratio `$wL^3/B$` of its weight per area `$w$`, length `$L$` and bending rigidity `$B$`.

use drape_dynamics::Simulation;
use drape_scene::Scene;

use super::scene::{ALONE, scene};
use crate::error::ValidationError;

/// Acceleration of gravity in all scenes here, in m/s².
pub const GRAVITY: f64 = 9.81;

/// Hold of the left end of a strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Hold {
    /// In a clamp: place and slope.
    ///
    /// It holds three rows of particles, and its line lies midway between the second and the third:
    /// there the slope is held, and the third row bends as the first free cell of a beam does. (The
    /// second row of a panel bends for the half cell at its edge as well, so a line next to the
    /// first row would be a third of a cell off.)
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
    /// A strip of 10 × 2 cm of a fabric of 200 g/m² with a bending length of 20 mm, nearly
    /// inextensible.
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
    /// Returns the strip with the length at which `$wL^3/B$` is a given ratio, with as many cells.
    #[must_use]
    pub fn of_weight(self, ratio: f64) -> Self {
        let length = (ratio * self.rigidity / (self.density * GRAVITY)).cbrt();
        Self { length, width: 0.2 * length, ..self }
    }

    /// Returns the spacing of the particles along the strip, in m.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        let held = if self.hold == Hold::Clamp { 0.5 } else { 0.0 };
        self.length / (self.cells as f64 + held)
    }

    /// Returns the length of the strip inside its clamp, in m.
    pub(crate) fn beyond(&self) -> f64 {
        if self.hold == Hold::Clamp { 1.5 * self.spacing() } else { 0.0 }
    }

    fn fabric(&self) -> String {
        let Self { density, rigidity, stiffness, friction: Friction { plateau, length }, .. } =
            self;
        let friction = if *plateau > 0.0 {
            format!("friction = [{{ plateau = {plateau:e}, length = {length:e} }}], ")
        } else {
            String::new()
        };
        let direction = format!(
            "traction = {{ primed = {{ stiffness = {stiffness:e}, toe_ratio = 1.0, toe_strain = 0.01, \
             toe_strain_after = 0.01 }} }}\nbending = {{ {friction}rigidity = {rigidity:e} }}\n"
        );
        format!(
            "name = \"strip\"\ndensity = {density:e}\nthickness = 0.0001\nshear = {{ stiffness = 50 }}\n\
             [warp]\n{direction}[weft]\n{direction}"
        )
    }

    /// Returns a simulation of the strip without air, held at the origin, turned from x about z by
    /// an angle in degrees.
    ///
    /// The text is the rest of the scene: time, further pins, how it is solved.
    ///
    /// # Errors
    /// A scene that cannot be read or prepared.
    pub fn simulation(&self, angle: f64, rest: &str) -> Result<Simulation, ValidationError> {
        Ok(Simulation::new(self.scene(angle, rest)?)?)
    }

    /// Returns the scene of [`Strip::simulation`].
    ///
    /// # Errors
    /// A scene that cannot be read.
    pub fn scene(&self, angle: f64, rest: &str) -> Result<Scene, ValidationError> {
        let (beyond, width, spacing) = (self.beyond(), self.width, self.spacing());
        let spin = 360.0 * self.spin;
        let panel = self.length + beyond;
        let pin =
            |rows: usize| format!("[[pin]]\npanel = \"strip\"\nedge = \"left\"\nrows = {rows}\n");
        let pin = match self.hold {
            Hold::Clamp => pin(3),
            Hold::Hinge => pin(1),
            Hold::Free => String::new(),
        };
        // A panel turns about its middle.
        let middle = 0.5 * panel - beyond;
        let (sin, cos) = angle.to_radians().sin_cos();
        let (x, y) = (middle * cos, middle * sin);
        let text = format!(
            "{ALONE}name = \"strip\"\nspacing = {spacing:e}\nair = {{ density = 0 }}\n\
             fabric.strip.file = \"fabric.toml\"\n{}[[panel]]\nname = \"strip\"\nfabric = \"strip\"\n\
             rectangle = [{panel:e}, {width:e}]\ncenter = [{x:e}, {y:e}, 0]\nturn = [-90, 0, {angle:e}]\n\
             spin = [0, 0, {spin:e}]\n{pin}{}",
            rest.lines().filter(|line| line.starts_with("gravity")).collect::<String>() + "\n",
            rest.lines().filter(|line| !line.starts_with("gravity")).collect::<Vec<_>>().join("\n")
        );
        scene(text, self.fabric())
    }

    /// Returns the points of the middle line of the strip, from its held end on.
    #[must_use]
    pub fn line(&self, simulation: &Simulation) -> Vec<LinePoint> {
        let coordinates = simulation.coordinates();
        let positions = simulation.frame().positions;
        let across = coordinates.iter().map(|c| c[1]).fold(f64::MIN, f64::max);
        let off = |c: &[f64; 2]| (c[1] - 0.5 * across).abs();
        let nearest = coordinates.iter().map(off).fold(f64::INFINITY, f64::min);
        let middle =
            |c: &[f64; 2]| off(c) <= nearest * (1.0 + 1e-9) + 1e-12 && c[1] <= 0.5 * across + 1e-12;
        let places = coordinates.iter().zip(positions.chunks_exact(3)).filter(|(c, _)| middle(c));
        let point = |(c, x): (&[f64; 2], &[f64])| LinePoint {
            distance: c[0] - self.beyond(),
            position: [x[0], x[1], x[2]],
        };
        let mut line: Vec<LinePoint> = places.map(point).collect();
        line.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        line
    }

    /// Returns the middle of the free end, in m.
    #[must_use]
    pub fn tip(&self, simulation: &Simulation) -> [f64; 3] {
        self.line(simulation).last().map_or([f64::NAN; 3], |point| point.position)
    }
}
