//! Drapemeter: the scene of a specimen that is let down, and what its shadow shows.
//!
//! The FRL and Cusick instruments differ by their diameters. Places of the grid over the starts
//! follow the additive recurrence of the plastic number \[Rob18\].

use std::f64::consts::PI;

use drape_dynamics::{Simulation, Snapshot};
use drape_fabric::Fabric;
use rayon::prelude::*;

use super::protocol::{Protocol, Strokes, shaken};
use super::study::{Drape, HARMONICS, Sampling, Study};
use crate::error::ValidationError;
use crate::outline::{Harmonics, Shadow, Surface, maxima};
use crate::setup::{GRAVITY, finish, simulation};

/// Height of the disc's pedestal, in m: higher than a specimen hangs.
const PEDESTAL: f64 = 0.3;

/// Distance at which the cloth feels disc and platform, in m.
const GAP: f64 = 1e-3;

/// Tolerance of a step, over g. Ten times tighter takes half as long again, and two starts of a
/// wool drape to the same within 0.05 points, as they do ten times looser.
const TOLERANCE: f64 = 1e-3;

/// Length over which the heights of an uneven specimen change, in m.
const UNEVEN_LENGTH: f64 = 0.02;

/// How long the specimen hangs before its shadow is read, in s.
const REST: f64 = 2.5;

/// How far beyond the disc particles are held, over the spacing: the last ones lie half a spacing
/// beyond the line where the slope is held, and half a spacing less than this beyond the disc on
/// the average.
const CLAMP_REACH: f64 = 1.0;

/// How far inside the disc the simulated cloth ends, over the spacing: a connector reaches two
/// spacings from a particle that moves to others that are held.
const HELD_ROWS: f64 = 2.0;

/// How far a fold must stand out, in m.
const PROMINENCE: f64 = 3e-3;

/// Drapemeter: radii of disc and specimen, in m, and the protocol.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drapemeter {
    /// Radius of the disc that holds the specimen.
    pub disc: f64,
    /// Radius of the specimen.
    pub specimen: f64,
    /// Protocol of the test.
    pub protocol: Protocol,
}

impl Drapemeter {
    /// The FRL meter: 127 mm on 63.5 mm.
    #[must_use]
    pub fn frl() -> Self {
        Self::of_diameters(0.127, 0.254)
    }

    /// Cusick's, 18 cm, with a specimen of some diameter in m: 0.24 for limp fabrics, 0.3, or 0.36
    /// for stiff ones (BS 5058, ISO 9073-9).
    #[must_use]
    pub fn cusick(specimen: f64) -> Self {
        Self::of_diameters(0.18, specimen)
    }

    fn of_diameters(disc: f64, specimen: f64) -> Self {
        Self { disc: 0.5 * disc, specimen: 0.5 * specimen, protocol: Protocol::default() }
    }
}

impl Drapemeter {
    /// Drapes specimens of particles at a spacing, in m, from so many starts, side by side; tells
    /// after each.
    ///
    /// # Errors
    /// Those of the first start that fails, and fewer than two starts.
    pub fn study(
        &self,
        fabric: &Fabric,
        sampling: Sampling,
        done: &(dyn Fn() + Sync),
    ) -> Result<Study, ValidationError> {
        let Sampling { spacing, starts } = sampling;
        if starts < 2 {
            return Err(ValidationError::Starts { starts });
        }
        let drape = |seed: u64| {
            let drape = self.drape(fabric, spacing, seed);
            done();
            drape
        };
        let drapes = (1..=starts).into_par_iter().map(drape).collect::<Result<Vec<_>, _>>()?;
        Ok(Study { drapes })
    }

    /// Drapes a specimen of particles at a spacing, in m, from a start that a seed perturbs: how
    /// uneven it is, and where the grid lies on it.
    ///
    /// The specimen lies on the disc and on a platform around it, which sinks away from under it,
    /// and then hangs in air for a while. Its inertia matters, however slow the platform: as folds
    /// fall into place the cloth sways, and works against its friction. Without inertia a cotton
    /// and a wool of 83 and 50 % drape to 91 and 58 %.
    ///
    /// # Errors
    /// A simulation that cannot be run to its end.
    pub fn drape(
        &self,
        fabric: &Fabric,
        spacing: f64,
        seed: u64,
    ) -> Result<Drape, ValidationError> {
        let mut simulation = self.simulation(fabric, spacing, seed)?;
        finish(&mut simulation)?;
        Ok(self.read(&simulation))
    }

    /// Drapes a specimen as [`Drapemeter::drape`] does, and returns the cloth on its disc at the end, for a
    /// picture.
    ///
    /// # Errors
    /// Those of [`Drapemeter::drape`].
    pub fn snapshot(
        &self,
        fabric: &Fabric,
        spacing: f64,
        seed: u64,
    ) -> Result<Snapshot, ValidationError> {
        let mut simulation = self.simulation(fabric, spacing, seed)?;
        finish(&mut simulation)?;
        Ok(simulation.snapshot())
    }

    /// Simulates the begin of a specimen's test for as long as `go_on` says, and returns the part of the
    /// test that was simulated: from its duration that of a whole test can be told.
    ///
    /// # Errors
    /// A simulation whose begin cannot be run.
    pub fn begin(
        &self,
        fabric: &Fabric,
        spacing: f64,
        go_on: &dyn Fn() -> bool,
    ) -> Result<f64, ValidationError> {
        let mut simulation = self.simulation(fabric, spacing, 1)?;
        let end = shaken(self.protocol.shake, self.sink() / self.protocol.sink_speed).end + REST;
        loop {
            let step = simulation.step()?;
            if step.finished || !go_on() {
                return Ok((step.time / end).min(1.0));
            }
        }
    }

    /// Returns how far the platform sinks, in m: a little more than the specimen can hang, shaken or not.
    fn sink(&self) -> f64 {
        let shake = self.protocol.shake.map_or(0.0, |shake| 2.0 * shake.amplitude);
        1.1 * (self.specimen - self.disc) + shake
    }

    fn simulation(
        &self,
        fabric: &Fabric,
        spacing: f64,
        seed: u64,
    ) -> Result<Simulation, ValidationError> {
        let Self { disc, specimen, protocol } = self;
        let Protocol { sink_speed, shake, turn, step, unevenness } = protocol;
        let sink = self.sink();
        let grid = grid(seed).map(|part| part * spacing);
        let down = sink / sink_speed;
        let Strokes { keys, end } = shaken(*shake, down);
        let hole = 2.0 * (disc - HELD_ROWS * spacing);
        let hole = if hole > 0.0 { format!("hole = {hole:e}\n") } else { String::new() };
        let text = format!(
            "name = \"drapemeter\"\nspacing = {spacing:e}\nfabric.specimen.file = \"fabric.toml\"\n\
             [[panel]]\nname = \"specimen\"\nfabric = \"specimen\"\ndisc = {:e}\n{hole}grid = {grid:?}\n\
             turn = [-90, {turn:?}, 0]\nnoise = {{ amplitude = {unevenness:e}, length = {UNEVEN_LENGTH:e}, seed = {seed} }}\n\
             [[pin]]\npanel = \"specimen\"\npoints = [[0, 0]]\nradius = {:e}\nmotion = {keys}\n\
             [[collider.cylinder]]\nname = \"disc\"\nradius = {disc:e}\nheight = {PEDESTAL:e}\n\
             edge_radius = 0.0005\ncenter = [0, {:e}, 0]\nmotion = {keys}\n\
             [[collider.plane]]\nname = \"platform\"\ncenter = [0, {:e}, 0]\n\
             [collider.plane.motion]\ntimes = [0, {down:e}]\nshift = [[0, 0, 0], [0, {:e}, 0]]\n\
             [contact]\nsurfaces = false\noffset = {GAP:e}\n[solver]\ntolerance = {TOLERANCE:e}\n[time]\nstep = {step:e}\nend = {:e}\n\
             [output]\nenergy = false\n",
            2.0 * specimen,
            disc + CLAMP_REACH * spacing,
            -0.5 * PEDESTAL - GAP,
            -GAP,
            -sink,
            end + REST,
        );
        simulation(text, fabric.to_toml())
    }

    /// Reads the shadow of a draped specimen from straight above.
    fn read(&self, simulation: &Simulation) -> Drape {
        let positions = simulation.frame().positions;
        let shadow = Shadow::of(
            Surface {
                triangles: simulation.triangles(),
                coordinates: simulation.coordinates(),
                positions: &positions,
            },
            self.specimen,
        )
        .with_disc(self.disc);
        let [disc, specimen] = [self.disc, self.specimen].map(|radius| PI * radius * radius);
        let edge = shadow.edge();
        let smooth = Harmonics::of(&edge, HARMONICS);
        Drape {
            coefficient: (shadow.area() - disc) / (specimen - disc),
            nodes: maxima(&smooth.curve(edge.len()), PROMINENCE).len(),
            amplitudes: smooth.amplitudes(),
            edge,
            speed: simulation.summary().speed_max,
        }
    }
}

/// The coarsest spacing at which a fabric's drape coefficient is within some points of that of
/// finer ones, in m: 0.22 of the length at which its weight bends it, `$(B/w)^{1/3}$`.
#[must_use]
pub fn spacing_bound(fabric: &Fabric) -> f64 {
    let rigidity = fabric.warp.bending.backbone.respond(0.0).tangent;
    let rigidity = rigidity.min(fabric.weft.bending.backbone.respond(0.0).tangent);
    0.22 * (rigidity / (fabric.density * GRAVITY)).cbrt()
}

/// Where the grid of a start has a particle, from the specimen's middle in spacings: places that
/// fill the square evenly (the additive recurrence of the plastic number, \[Rob18\]).
fn grid(seed: u64) -> [f64; 2] {
    [0.754_877_666_246_693, 0.569_840_290_998_053].map(|step| (seed as f64 * step).fract() - 0.5)
}
