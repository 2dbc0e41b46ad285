//! Drapemeter: the scene of a specimen that is lowered, and the measurement of its shadow.
//!
//! The FRL and Cusick instruments differ by their diameters. The offsets of the grid over the
//! starts follow the additive recurrence of the plastic number \[Rob18\].

use std::f64::consts::PI;

use drape_dynamics::{Simulation, Snapshot};
use drape_fabric::Fabric;
use drape_scene::{
    CylinderSpec, MotionSpec, NoiseSpec, PanelSpec, PinSpec, PlaneSpec, SceneSpec, TimeSpec,
};
use rayon::prelude::*;

use super::protocol::{Protocol, Strokes, shaken};
use super::study::{Drape, HARMONICS, Sampling, Study};
use crate::error::ValidationError;
use crate::outline::{Harmonics, Shadow, Surface, maxima};
use crate::setup::{GRAVITY, alone, finish, simulation, tolerance, with_panel};

/// Time for which the specimen hangs before its shadow is read, in s.
const REST: f64 = 2.5;

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
    /// Returns the FRL meter: a specimen with a radius of 127 mm on a disc with a radius of 63.5
    /// mm.
    #[must_use]
    pub fn frl() -> Self {
        Self::from_diameters(0.127, 0.254)
    }

    /// Returns Cusick's meter with a disc of 18 cm and a specimen of the diameter `specimen`, in m:
    /// 0.24 for limp fabrics, 0.3 for others, or 0.36 for stiff fabrics (BS 5058, ISO 9073-9).
    #[must_use]
    pub fn cusick(specimen: f64) -> Self {
        Self::from_diameters(0.18, specimen)
    }

    /// Returns a meter with the diameters of `disc` and `specimen`, in m, and the usual protocol.
    fn from_diameters(disc: f64, specimen: f64) -> Self {
        Self { disc: 0.5 * disc, specimen: 0.5 * specimen, protocol: Protocol::default() }
    }
}

impl Drapemeter {
    /// Drapes specimens of `fabric` from each start of `sampling` in parallel, and calls `done`
    /// after each start.
    ///
    /// # Errors
    /// The error of the first start that fails, or `sampling` has fewer than two starts.
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
        let drapes: Result<Vec<Drape>, ValidationError> = (1..=starts)
            .into_par_iter()
            .map(|seed| {
                let drape = self.drape(fabric, spacing, seed);
                done();
                drape
            })
            .collect();
        Ok(Study { drapes: drapes? })
    }

    /// Drapes a specimen of `fabric` with particles at `spacing`, in m. `seed` perturbs the start:
    /// the unevenness of the specimen and the offset of its grid.
    ///
    /// At first the specimen lies on the disc and on a platform around the disc. The platform
    /// sinks, and then the specimen hangs in air for a while. Inertia matters even if the platform
    /// is slow: while folds form, the cloth sways and works against its friction. Without inertia,
    /// a cotton of 83 % drapes to 91 %, and a wool of 50 % to 58 %.
    ///
    /// # Errors
    /// The simulation cannot be run to its end.
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

    /// Drapes a specimen as [`Drapemeter::drape`] does, and returns the cloth on its disc at the
    /// end, for a picture.
    ///
    /// # Errors
    /// The errors of [`Drapemeter::drape`].
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

    /// Simulates the begin of a test while `go_on` returns true, and returns the simulated part of
    /// the test, a ratio. The caller estimates the duration of a whole test from this part.
    ///
    /// # Errors
    /// The begin of the simulation cannot be run.
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

    /// Returns the distance by which the platform sinks, in m: a little more than the specimen can
    /// hang, also if `protocol` shakes the disc.
    fn sink(&self) -> f64 {
        let shake = self.protocol.shake.map_or(0.0, |shake| 2.0 * shake.amplitude);
        1.1 * (self.specimen - self.disc) + shake
    }

    /// Returns the simulation of a test of `fabric` with particles at `spacing`, in m, and a start
    /// that `seed` perturbs.
    fn simulation(
        &self,
        fabric: &Fabric,
        spacing: f64,
        seed: u64,
    ) -> Result<Simulation, ValidationError> {
        /// Height of the pedestal of the disc, in m: higher than a specimen hangs.
        const PEDESTAL: f64 = 0.3;

        /// Activation distance of the contact with disc and platform, in m.
        const GAP: f64 = 1e-3;

        /// Tolerance of a step, over g. A tolerance that is ten times tighter costs half as much
        /// time again. Two starts of a wool drape to equal coefficients within 0.05 points with
        /// tolerances ten times tighter and ten times looser.
        const TOLERANCE: f64 = 1e-3;

        /// Length over which the heights of an uneven specimen change, in m.
        const UNEVEN_LENGTH: f64 = 0.02;

        /// Distance from the disc within which particles are held, over the spacing. The last held
        /// particles lie half a spacing beyond the line where the slope is held. On average they
        /// lie half a spacing nearer to the disc than this distance.
        const CLAMP_REACH: f64 = 1.0;

        /// Distance inside the edge of the disc at which the simulated cloth ends, over the
        /// spacing. A connector reaches two spacings from a free particle to held particles.
        const HELD_ROWS: f64 = 2.0;

        let Self { disc, specimen, protocol } = self;
        let Protocol { sink_speed, shake, turn, step, unevenness } = protocol;
        let sink = self.sink();
        let grid = grid(seed).map(|part| part * spacing);
        let down = sink / sink_speed;
        let Strokes { motion, end } = shaken(*shake, down);

        // Cloth in the middle of the disc is held, so it is left out.
        let hole = 2.0 * (disc - HELD_ROWS * spacing);
        let panel = PanelSpec {
            name: "specimen".into(),
            fabric: "specimen".into(),
            disc: Some(2.0 * specimen),
            hole: (hole > 0.0).then_some(hole),
            grid: Some(grid),
            turn: [-90.0, *turn, 0.0],
            noise: Some(NoiseSpec { amplitude: *unevenness, length: Some(UNEVEN_LENGTH), seed }),
            ..PanelSpec::default()
        };
        let mut spec = SceneSpec {
            name: Some("drapemeter".into()),
            spacing,
            time: TimeSpec { step: *step, end: end + REST, ..TimeSpec::default() },
            solver: tolerance(TOLERANCE),
            ..alone()
        };
        spec.contact.offset = GAP;
        spec.pin.push(PinSpec {
            panel: "specimen".into(),
            points: vec![[0.0; 2]],
            radius: Some(disc + CLAMP_REACH * spacing),
            motion: Some(motion.clone()),
            ..PinSpec::default()
        });
        spec.collider.cylinder.push(CylinderSpec {
            name: Some("disc".into()),
            radius: *disc,
            height: PEDESTAL,
            edge_radius: 0.0005,
            center: [0.0, -0.5 * PEDESTAL - GAP, 0.0],
            motion: Some(motion),
            ..CylinderSpec::default()
        });
        let sinking = MotionSpec {
            times: vec![0.0, down],
            shift: vec![[0.0; 3], [0.0, -sink, 0.0]],
            ..MotionSpec::default()
        };
        spec.collider.plane.push(PlaneSpec {
            name: Some("platform".into()),
            center: [0.0, -GAP, 0.0],
            motion: Some(sinking),
            ..PlaneSpec::default()
        });
        simulation(&with_panel(spec, panel, fabric))
    }

    /// Reads the shadow of the draped specimen in `simulation` from straight above.
    fn read(&self, simulation: &Simulation) -> Drape {
        /// Prominence of a fold, in m.
        const PROMINENCE: f64 = 3e-3;

        let positions = simulation.positions().to_vec();
        let shadow = Shadow::new(
            Surface {
                triangles: simulation.triangles(),
                coordinates: simulation.coordinates(),
                positions: &positions,
            },
            self.specimen,
        )
        .with_disc(self.disc);

        // The disc and the flat specimen bound the area of the shadow.
        let [disc, specimen] = [self.disc, self.specimen].map(|radius| PI * radius * radius);
        let edge = shadow.edge();
        let smooth = Harmonics::new(&edge, HARMONICS);
        Drape {
            coefficient: (shadow.area() - disc) / (specimen - disc),
            nodes: maxima(&smooth.curve(edge.len()), PROMINENCE).len(),
            amplitudes: smooth.amplitudes(),
            edge,
            speed: simulation.summary().speed_max,
        }
    }
}

/// Returns the coarsest spacing, in m, at which the drape coefficient of `fabric` is within a few
/// points of the coefficient on finer grids: 0.22 of the length `$(B/w)^{1/3}$` over which `fabric`
/// bends under its own weight.
#[must_use]
pub fn spacing_bound(fabric: &Fabric) -> f64 {
    let rigidity = fabric.warp.bending.backbone.respond(0.0).tangent;
    let rigidity = rigidity.min(fabric.weft.bending.backbone.respond(0.0).tangent);
    0.22 * (rigidity / (fabric.density * GRAVITY)).cbrt()
}

/// Returns the offset of the grid of the start `seed` from the specimen's middle, in spacings. The
/// offsets of consecutive seeds fill the square evenly (the additive recurrence of the plastic
/// number, \[Rob18\]).
fn grid(seed: u64) -> [f64; 2] {
    [0.754_877_666_246_693, 0.569_840_290_998_053].map(|step| (seed as f64 * step).fract() - 0.5)
}
