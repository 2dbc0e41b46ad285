//! Specimen: a panel of a fabric in two clamps, at its true size, in a vacuum and without weight.
//!
//! Clamps are pins. One stays; the other goes through placements, one in each step, and its load is
//! recorded.

use std::f64::consts::SQRT_2;

use drape_dynamics::{PinLoad, Simulation};
use drape_fabric::Fabric;
use drape_kes::Direction;

use super::placement::{Place, arm, moment};
use crate::error::ValidationError;
use crate::setup::{ALONE, scene};

/// Width of a specimen: 20 cm.
pub(crate) const WIDTH: f64 = 0.2;

/// Free length in the tensile and the shear test: 5 cm.
pub(crate) const GAUGE: f64 = 0.05;

/// Free length in the bending test: 1 cm.
const BENDING_GAUGE: f64 = 0.01;

/// Time between two points of a curve, in s: as long as an instrument takes, and longer than any
/// wave.
const STEP: f64 = 0.1;

/// Specimen, level along x, with the clamp that moves.
pub(crate) struct Specimen {
    /// Angle from its length to the weft, in degrees.
    grain: f64,
    /// Spacing of the particles along the yarns, and of the rows across the specimen.
    pub(super) spacing: f64,
    pub(super) row: f64,
    /// Whole rows between the lines of the clamps.
    pub(super) cells: usize,
    /// Rows that the fixed and the moving clamp hold.
    rows: [usize; 2],
    /// Length of the panel and the middle of it along x; the line of the clamp that stays is at 0.
    length: f64,
    middle: f64,
    /// Pivot of the moving clamp, along x.
    pivot: f64,
}

impl Specimen {
    /// Returns a specimen between two lines of particles.
    pub(super) fn between_lines(spacing: f64) -> Self {
        let cells = (GAUGE / spacing).round().max(1.0) as usize;
        let spacing = GAUGE / cells as f64;
        Self {
            grain: 0.0,
            spacing,
            row: spacing,
            cells,
            rows: [1, 1],
            length: GAUGE,
            middle: 0.5 * GAUGE,
            pivot: GAUGE,
        }
    }

    /// In clamps that hold the slope too: three rows each, its line midway between the second and
    /// the third, which bends as the first free cell does. A single cell is bent at the third row
    /// of both, which the clamp that stays holds. The moving clamp turns about its third row.
    pub(super) fn in_clamps(spacing: f64) -> Self {
        let cells = (BENDING_GAUGE / spacing).round().max(1.0) as usize;
        let h = BENDING_GAUGE / cells as f64;
        Self {
            grain: 0.0,
            spacing: h,
            row: h,
            cells,
            rows: [3, if cells == 1 { 2 } else { 3 }],
            length: BENDING_GAUGE + 3.0 * h,
            middle: 0.5 * BENDING_GAUGE,
            pivot: BENDING_GAUGE - 0.5 * h,
        }
    }

    /// The same on the bias: rows of particles across the specimen are nearer to each other than
    /// particles along the yarns by a factor of √2, and what a pin takes for two rows are three of
    /// them.
    pub(super) fn on_the_bias(spacing: f64) -> Self {
        let cells = (BENDING_GAUGE * SQRT_2 / spacing).round().max(2.0) as usize;
        let h = BENDING_GAUGE / cells as f64;
        let along = Self::in_clamps(h);
        Self { grain: 45.0, spacing: h * SQRT_2, rows: [2, 2], ..along }
    }

    /// The panel's keys that cut it on the bias from a grid with rows at both ends; a particle in
    /// its middle is in a row.
    fn bias_keys(&self) -> String {
        let odd = (self.length / self.row).round() % 2.0 == 1.0;
        let grid = if odd { 0.5 * self.spacing } else { 0.0 };
        format!("grain = {}\ngrid = [{grid:e}, 0]\n", self.grain)
    }

    /// Moves the clamp from place to place, one in each step, and records what it bears; the moment
    /// is about its pivot.
    pub(super) fn drive(
        &self,
        fabric: &Fabric,
        direction: Direction,
        places: &[Place],
    ) -> Result<Vec<PinLoad>, ValidationError> {
        let Self { grain, spacing, length, middle, pivot, rows: [still, moving], .. } = self;
        let grain = if *grain == 0.0 { String::new() } else { self.bias_keys() };
        let (size, turn, edges) = match direction {
            Direction::Weft => ([*length, WIDTH], [-90, 0, 0], ["left", "right"]),
            Direction::Warp => ([WIDTH, *length], [-90, -90, 0], ["bottom", "top"]),
        };
        let list = |of: &dyn Fn(&Place) -> String| {
            let first = of(&Place::default());
            places.iter().fold(first, |list, place| list + ", " + &of(place))
        };
        let times: Vec<f64> = (0..=places.len()).map(|k| k as f64 * STEP).collect();
        let shifts = list(&|place| format!("{:?}", place.shift));
        let turns = list(&|place| format!("[0, 0, {:e}]", place.turn.to_degrees()));
        let text = format!(
            "{ALONE}name = \"specimen\"\nspacing = {spacing:e}\ngravity = [0, 0, 0]\nair = {{ density = 0 }}\n\
             fabric.specimen.file = \"fabric.toml\"\n[[panel]]\nname = \"specimen\"\n\
             fabric = \"specimen\"\nrectangle = {size:?}\ncenter = [{middle:e}, 0, 0]\nturn = {turn:?}\n{grain}\
             [[pin]]\npanel = \"specimen\"\nedge = \"{}\"\nrows = {still}\n\
             [[pin]]\npanel = \"specimen\"\nedge = \"{}\"\nrows = {moving}\n\
             [pin.motion]\ntimes = {times:?}\ncenter = [{pivot:e}, 0, 0]\n\
             shift = [{shifts}]\nturn = [{turns}]\n\
             [time]\nstep = {STEP}\nend = {:e}\n[output]\nenergy = false\n",
            edges[0],
            edges[1],
            STEP * places.len() as f64
        );
        let scene = scene(text, fabric.to_toml())?;
        let arm = arm(&scene, *pivot);
        let mut simulation = Simulation::new(scene)?;
        let mut loads = Vec::with_capacity(places.len());
        for place in places {
            simulation.step()?;
            let load = simulation.pin_loads()[1];
            let [x, y, _] = load.moment;
            loads.push(PinLoad { moment: [x, y, moment(&load, arm, place.turn)], ..load });
        }
        Ok(loads)
    }
}
