//! Specimens of a fabric in simulated KES instruments.
//!
//! A specimen has its true size and is held and moved as in the instrument, in a vacuum and without weight: clamps are
//! pins, and what they bear is the load. Every step of the simulation is a point of the curve.

use std::f64::consts::SQRT_2;

use drape_dynamics::{PinLoad, Simulation};
use drape_fabric::Fabric;
use drape_kes::{BendingPoints, Curve, Direction, EvaluationPoints, ShearPoints, Symbol, Test};
use drape_scene::Scene;

use crate::ValidationError;
use crate::instrument::{
    LARGEST_TENSION, SHEAR_TENSION, curve, cycle, extension, ideal, laws, on_the_bias,
};
use crate::stage::{ALONE, scene};

/// Width of a specimen: 20 cm.
const WIDTH: f64 = 0.2;
/// Free length in the tensile and the shear test: 5 cm.
const GAUGE: f64 = 0.05;
/// Free length in the bending test: 1 cm.
const BENDING_GAUGE: f64 = 0.01;
/// Time between two points of a curve, in s: as long as an instrument takes, and longer than any wave.
const STEP: f64 = 0.1;
/// Steps in which the tension of the shear test is put on.
const LOADING_STEPS: usize = 10;

/// The specimen, level, its yarns along x, and the clamp that moves.
struct Specimen {
    /// Angle from its length to the weft, in degrees.
    grain: f64,
    /// Spacing of the particles along the yarns, and of the rows across the specimen.
    spacing: f64,
    row: f64,
    /// Whole rows between the lines of the clamps.
    cells: usize,
    /// What the clamp that stays and the one that moves hold, as a pin's rows.
    rows: [usize; 2],
    /// Length of the panel and the middle of it along x; the line of the clamp that stays is at 0.
    length: f64,
    middle: f64,
    /// What the moving clamp turns about, along x.
    pivot: f64,
}

/// Where the moving clamp is: shift of its pivot, in m, and turn about z, in rad.
#[derive(Clone, Copy, Default)]
pub(crate) struct Place {
    pub(crate) shift: [f64; 3],
    pub(crate) turn: f64,
}

/// A clamp that bends a specimen to a curvature, in 1/m: where equal turns of so many rows at a distance, in m, lead it if
/// they keep that. The clamp that stays has its line at 0, and both lines are midway between two rows.
pub(crate) fn bent((row, cells): (f64, usize), curvature: f64) -> Place {
    let turn = curvature * row;
    let mut shift = [(1.0 - cells as f64) * row, 0.0, 0.0];
    for cell in 1..cells {
        let (sin, cos) = (cell as f64 * turn).sin_cos();
        shift = [shift[0] + row * cos, shift[1] + row * sin, 0.0];
    }
    Place { shift, turn: cells as f64 * turn }
}

/// How far the middle of what the second pin holds is beyond a pivot along x, in m.
pub(crate) fn arm(scene: &Scene, pivot: f64) -> f64 {
    let held = scene.pins[1].particles.iter().map(|particle| scene.start.positions[3 * particle]);
    held.clone().sum::<f64>() / held.count() as f64 - pivot
}

/// Moment of a pin's load about z through a pivot, in N·m; the middle of what it holds is an arm away, at a turn in rad.
pub(crate) fn moment(load: &PinLoad, arm: f64, turn: f64) -> f64 {
    let (sin, cos) = turn.sin_cos();
    load.moment[2] + arm * (cos * load.force[1] - sin * load.force[0])
}

impl Specimen {
    /// Between two lines of particles.
    fn between_lines(spacing: f64) -> Self {
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

    /// In clamps that hold the slope too: three rows each, its line midway between the second and the third, which
    /// bends as the first free cell does. A single cell is bent at the third row of both, which the clamp that stays
    /// holds. The moving clamp turns about its third row.
    fn in_clamps(spacing: f64) -> Self {
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

    /// The same on the bias: rows of particles across the specimen are nearer to each other than particles along the
    /// yarns by a factor of √2, and what a pin takes for two rows are three of them.
    fn on_the_bias(spacing: f64) -> Self {
        let cells = (BENDING_GAUGE * SQRT_2 / spacing).round().max(2.0) as usize;
        let h = BENDING_GAUGE / cells as f64;
        let along = Self::in_clamps(h);
        Self { grain: 45.0, spacing: h * SQRT_2, rows: [2, 2], ..along }
    }

    /// The panel's keys that cut it on the bias from a grid with rows at both ends; a particle in its middle is in a row.
    fn bias_keys(&self) -> String {
        let odd = (self.length / self.row).round() % 2.0 == 1.0;
        let grid = if odd { 0.5 * self.spacing } else { 0.0 };
        format!("grain = {}\ngrid = [{grid:e}, 0]\n", self.grain)
    }

    /// Moves the clamp from place to place, one in each step, and records what it bears; the moment is about its pivot.
    fn drive(
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

/// The curve that a simulated instrument draws of a specimen of particles at a spacing, in m.
///
/// The path is [`cycle`]'s with so many points in a branch; the spacing is the nearest that divides the free length.
///
/// # Errors
/// A specimen that cannot be simulated, or a load that is no number.
pub fn measure(
    fabric: &Fabric,
    test: Test,
    direction: Direction,
    (spacing, points): (f64, usize),
) -> Result<Curve, ValidationError> {
    let path = cycle(fabric, test, direction, points);
    let load = match test {
        Test::Tensile => stretch(fabric, direction, spacing, &path)?,
        Test::Shear => shear(fabric, direction, spacing, &path)?,
        Test::Bending | Test::LoopBending => {
            bend(fabric, direction, &Specimen::in_clamps(spacing), &path)?
        }
    };
    Ok(curve(test, direction, path, load)?)
}

/// Tension per width at strains.
fn stretch(fabric: &Fabric, direction: Direction, spacing: f64, path: &[f64]) -> Loads {
    let specimen = Specimen::between_lines(spacing);
    let place = |strain: &f64| Place { shift: [strain * GAUGE, 0.0, 0.0], turn: 0.0 };
    let places: Vec<Place> = path[1..].iter().map(place).collect();
    let loads = specimen.drive(fabric, direction, &places)?;
    Ok(from_rest(loads.iter().map(|load| -load.force[0] / WIDTH)))
}

/// Force per width across the specimen at angles, less the part of its tension: that is not the fabric's resistance.
///
/// The clamp moves so that the yarns keep the length that the tension has given them. The law is one per area of relaxed
/// cloth, so the force counts by that length over the relaxed one.
fn shear(fabric: &Fabric, direction: Direction, spacing: f64, path: &[f64]) -> Loads {
    let specimen = Specimen::between_lines(spacing);
    let strain = extension(&laws(fabric, direction).traction, SHEAR_TENSION);
    let pulled = |strain: f64, angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let length = (1.0 + strain) * GAUGE;
        Place { shift: [length * cos - GAUGE, 0.0, length * sin], turn: 0.0 }
    };
    let loading =
        (1..=LOADING_STEPS).map(|k| pulled(strain * k as f64 / LOADING_STEPS as f64, 0.0));
    let places: Vec<Place> =
        loading.chain(path[1..].iter().map(|&angle| pulled(strain, angle))).collect();
    let loads = specimen.drive(fabric, direction, &places)?;
    let share = (1.0 + strain) / WIDTH;
    let across = loads[LOADING_STEPS..].iter().zip(&path[1..]);
    Ok(from_rest(across.map(|(load, angle)| share * (load.force[0] * angle.tan() - load.force[2]))))
}

/// Moment per width at curvatures.
fn bend(fabric: &Fabric, direction: Direction, specimen: &Specimen, path: &[f64]) -> Loads {
    let places: Vec<Place> = path[1..]
        .iter()
        .map(|&curvature| bent((specimen.row, specimen.cells), curvature))
        .collect();
    let loads = specimen.drive(fabric, direction, &places)?;
    Ok(from_rest(loads.iter().map(|load| -load.moment[2] / WIDTH)))
}

/// The curve of a bending specimen cut on the bias, up to a curvature in 1/m; it stands as one of the warp. The spacing is
/// one of [`bias_spacing`].
///
/// # Errors
/// Those of [`measure`].
pub fn bend_on_the_bias(
    fabric: &Fabric,
    largest: f64,
    (spacing, points): (f64, usize),
) -> Result<Curve, ValidationError> {
    let path = on_the_bias(fabric, largest, points).deformation().to_vec();
    let load = bend(fabric, Direction::Weft, &Specimen::on_the_bias(spacing), &path)?;
    Ok(curve(Test::Bending, Direction::Warp, path, load)?)
}

/// The spacing nearest to one in m, and below 8 mm, whose rows across a specimen on the bias divide its free length.
pub fn bias_spacing(spacing: f64) -> f64 {
    Specimen::on_the_bias(spacing).spacing
}

type Loads = Result<Vec<f64>, ValidationError>;

/// A history that begins without load.
fn from_rest(loads: impl Iterator<Item = f64>) -> Vec<f64> {
    std::iter::once(0.0).chain(loads).collect()
}

/// A curve of a simulated instrument beside that of the laws.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// What the simulated instrument draws.
    pub measured: Curve,
    /// What the laws alone answer.
    pub ideal: Curve,
}

impl Comparison {
    /// Simulates a test and drives the laws through the same deformations; see [`measure`].
    ///
    /// # Errors
    /// Those of [`measure`].
    pub fn of(
        fabric: &Fabric,
        (test, direction): (Test, Direction),
        resolution: (f64, usize),
    ) -> Result<Self, ValidationError> {
        let measured = measure(fabric, test, direction, resolution)?;
        Ok(Self { measured, ideal: ideal(fabric, test, direction, resolution.1) })
    }

    /// Root mean square of the differences of the loads, over the range of the laws' loads.
    pub fn distance(&self) -> f64 {
        let pairs = self.measured.load().iter().zip(self.ideal.load());
        let count = self.measured.load().len().min(self.ideal.load().len());
        let squares: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
        (squares / count as f64).sqrt() / self.ideal.load_range().span()
    }

    /// The KES values of both, simulated and of the laws, in the laboratory's units; those that both curves have.
    pub fn values(&self) -> Vec<(Symbol, [f64; 2])> {
        let points = EvaluationPoints {
            maximum_tension: LARGEST_TENSION,
            bending: BendingPoints::default(),
            shear: ShearPoints::default(),
        };
        let [measured, ideal] = [&self.measured, &self.ideal].map(|curve| curve.values(&points));
        let pairs = measured.into_iter().zip(ideal);
        pairs.filter_map(|(a, b)| Some((a.symbol, [a.value.ok()?, b.value.ok()?]))).collect()
    }
}
