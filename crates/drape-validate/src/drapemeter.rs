//! Simulated drapemeters: a disc of fabric between two smaller ones, let down.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use drape_fabric::{Fabric, ShearBackbone};
use drape_scene::Simulation;
use rayon::prelude::*;

use crate::ValidationError;
use crate::shadow::{HARMONICS, LowPass, PROMINENCE, Shadow, maxima};
use crate::stage::simulation;
use crate::strip::{GRAVITY, finish};

/// Height of the disc's pedestal, in m: higher than a specimen hangs.
const PEDESTAL: f64 = 0.3;
/// Distance at which the cloth feels disc and platform, in m.
const GAP: f64 = 1e-3;
/// How fast the platform sinks, in m/s. At 5 mm spacing a cotton of 83 % drapes to 84 % at 20 mm/s
/// (10 starts), 79 % at 67 (4) and 77 % at 200 (1).
const SINK_SPEED: f64 = 0.02;
/// Length of a step, and for how long the specimen hangs before its shadow is read, in s.
const STEP: f64 = 0.005;
const REST: f64 = 2.5;
/// How far beyond the disc particles are held, over the spacing: the last ones lie half a spacing beyond the line
/// where the slope is held, and half a spacing less than this beyond the disc on the average.
const CLAMP_REACH: f64 = 1.0;

/// A drapemeter: its disc and the specimen's size, radii in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drapemeter {
    /// Radius of the disc that holds the specimen.
    pub disc: f64,
    /// Radius of the specimen.
    pub specimen: f64,
}

impl Drapemeter {
    /// The FRL meter: 127 mm on 63.5 mm.
    pub const FRL: Self = Self { disc: 0.0635, specimen: 0.127 };
    /// Cusick's with the specimen of 24 cm, for limp fabrics (BS 5058, ISO 9073-9).
    pub const CUSICK_24: Self = Self { disc: 0.09, specimen: 0.12 };
    /// Cusick's with the specimen of 30 cm.
    pub const CUSICK_30: Self = Self { disc: 0.09, specimen: 0.15 };
    /// Cusick's with the specimen of 36 cm, for stiff fabrics.
    pub const CUSICK_36: Self = Self { disc: 0.09, specimen: 0.18 };
}

/// What is read from the shadow of a draped specimen.
#[derive(Debug, Clone, PartialEq)]
pub struct Drape {
    /// Area of the shadow beyond the disc over that of the flat specimen beyond it.
    pub coefficient: f64,
    /// Folds: maxima of the shadow's edge.
    pub nodes: usize,
    /// Amplitudes of the edge's harmonics 1, 2, … around the disc, in m.
    pub amplitudes: Vec<f64>,
    /// Radius of the shadow's edge at even angles, in m.
    pub edge: Vec<f64>,
    /// How fast the fastest particle still was, in m/s.
    pub speed: f64,
}

/// Drapes from several starts.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// One for each start.
    pub drapes: Vec<Drape>,
}

impl Study {
    /// Mean of the drape coefficients.
    pub fn mean(&self) -> f64 {
        let sum: f64 = self.drapes.iter().map(|drape| drape.coefficient).sum();
        sum / self.drapes.len() as f64
    }

    /// Standard deviation of the drape coefficients over the starts.
    pub fn deviation(&self) -> f64 {
        let mean = self.mean();
        let squares = self.drapes.iter().map(|drape| (drape.coefficient - mean).powi(2));
        (squares.sum::<f64>() / (self.drapes.len() as f64 - 1.0)).sqrt()
    }

    /// How many starts ended with each number of nodes.
    pub fn nodes(&self) -> BTreeMap<usize, usize> {
        let mut counts = BTreeMap::new();
        self.drapes.iter().for_each(|drape| *counts.entry(drape.nodes).or_default() += 1);
        counts
    }

    /// Mean amplitudes of the edge's harmonics 1, 2, …, in m.
    pub fn amplitudes(&self) -> Vec<f64> {
        let mean = |harmonic: usize| {
            let sum: f64 = self.drapes.iter().map(|drape| drape.amplitudes[harmonic]).sum();
            sum / self.drapes.len() as f64
        };
        (0..HARMONICS).map(mean).collect()
    }
}

/// The coarsest spacing at which a fabric's drape coefficient is within some points of that of finer ones, in m: a
/// quarter of the length at which its weight bends it, `$(B/w)^{1/3}$`.
pub fn spacing_bound(fabric: &Fabric) -> f64 {
    let rigidity = fabric.warp.bending.backbone.respond(0.0).tangent;
    let rigidity = rigidity.min(fabric.weft.bending.backbone.respond(0.0).tangent);
    0.25 * (rigidity / (fabric.density * GRAVITY)).cbrt()
}

/// What a drape depends on and a sheet with values alone does not have, from one end of what it may be to the other.
///
/// No survey of many fabrics is behind the ends; they are meant to be wide for apparel weaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// G, in N/(m·rad).
    pub stiffness: f64,
    /// Half of 2HG, in N/m.
    pub plateau: f64,
    /// Curvature over which the friction of bending builds up, in 1/m.
    pub length: f64,
}

impl Prior {
    /// The end at which a fabric drapes most: G 0.3 gf/(cm·deg), 2HG 0.2 gf/cm, 0.2 1/cm.
    pub const LIMP: Self = Self { stiffness: 16.86, plateau: 0.0981, length: 20.0 };
    /// The end at which it drapes least: G 1 gf/(cm·deg), 2HG 2 gf/cm, 0.02 1/cm.
    pub const STIFF: Self = Self { stiffness: 56.19, plateau: 0.9807, length: 2.0 };

    /// The fabric with these in the place of what was assumed in its fit; none if nothing of them was.
    pub fn of(self, fabric: &Fabric) -> Option<Fabric> {
        let assumed = &fabric.provenance.as_ref()?.assumed;
        let starts = |with: &str| assumed.iter().any(|text| text.starts_with(with));
        let [shear, warp, weft] =
            ["shear stiffness", "warp bending friction", "weft bending friction"].map(starts);
        let mut changed = fabric.clone();
        if shear {
            changed.shear.backbone = ShearBackbone::Linear { stiffness: self.stiffness };
            changed.shear.friction.elements[0].plateau = self.plateau;
        }
        for (laws, assumed) in [(&mut changed.warp, warp), (&mut changed.weft, weft)] {
            if assumed {
                laws.bending.friction.elements[0].length = self.length;
            }
        }
        (shear || warp || weft).then_some(changed)
    }
}

impl Drapemeter {
    /// Drapes specimens of particles at a spacing, in m, from so many starts, side by side; tells after each.
    ///
    /// # Errors
    /// Those of the first start that fails, and fewer than two starts.
    pub fn study(
        &self,
        fabric: &Fabric,
        (spacing, starts): (f64, u64),
        told: &(dyn Fn() + Sync),
    ) -> Result<Study, ValidationError> {
        if starts < 2 {
            return Err(ValidationError::Starts { starts });
        }
        let drape = |seed: u64| {
            let drape = self.drape(fabric, (spacing, seed));
            told();
            drape
        };
        let drapes = (1..=starts).into_par_iter().map(drape).collect::<Result<Vec<_>, _>>()?;
        Ok(Study { drapes })
    }

    /// Drapes a specimen of particles at a spacing, in m, from a start that a seed perturbs: the particles' heights by
    /// a tenth of a millimetre, and where the grid lies on the specimen.
    ///
    /// The specimen lies on the disc and on a platform around it, which sinks away from under it, and then hangs in air
    /// for a while. Its inertia matters, however slow the platform: as folds fall into place the cloth sways, and works
    /// against its friction. Without inertia a cotton and a wool of 83 and 50 % drape to 91 and 58 %.
    ///
    /// # Errors
    /// A simulation that cannot be run to its end.
    pub fn drape(
        &self,
        fabric: &Fabric,
        (spacing, seed): (f64, u64),
    ) -> Result<Drape, ValidationError> {
        let mut simulation = self.simulation(fabric, (spacing, seed))?;
        finish(&mut simulation)?;
        Ok(self.read(&simulation))
    }

    fn simulation(
        &self,
        fabric: &Fabric,
        (spacing, seed): (f64, u64),
    ) -> Result<Simulation, ValidationError> {
        let Self { disc, specimen } = self;
        // A little more than the specimen can hang.
        let sink = 1.1 * (specimen - disc);
        let grid = grid(seed).map(|part| part * spacing);
        let text = format!(
            "name = \"drapemeter\"\nspacing = {spacing:e}\nfabric.specimen.file = \"fabric.toml\"\n\
             [[panel]]\nname = \"specimen\"\nfabric = \"specimen\"\ndisc = {:e}\ngrid = {grid:?}\nturn = [-90, 0, 0]\n\
             noise = {{ amplitude = 1e-4, seed = {seed} }}\n\
             [[pin]]\npanel = \"specimen\"\npoints = [[0, 0]]\nradius = {:e}\n\
             [[collider.cylinder]]\nname = \"disc\"\nradius = {disc:e}\nheight = {PEDESTAL:e}\n\
             edge_radius = 0.0005\ncenter = [0, {:e}, 0]\n\
             [[collider.plane]]\nname = \"platform\"\ncenter = [0, {:e}, 0]\n\
             [collider.plane.motion]\ntimes = [0, {:e}]\nshift = [[0, 0, 0], [0, {:e}, 0]]\n\
             [contact]\noffset = {GAP:e}\n[time]\nstep = {STEP}\nend = {:e}\n\
             [output]\nenergy = false\n",
            2.0 * specimen,
            disc + CLAMP_REACH * spacing,
            -0.5 * PEDESTAL - GAP,
            -GAP,
            sink / SINK_SPEED,
            -sink,
            sink / SINK_SPEED + REST,
        );
        simulation(text, fabric.to_toml())
    }

    /// Reads the shadow of a draped specimen from straight above.
    fn read(&self, simulation: &Simulation) -> Drape {
        let positions = simulation.frame().positions;
        let shadow = Shadow::of(
            simulation.triangles(),
            (simulation.coordinates(), &positions),
            self.specimen,
        );
        let [disc, specimen] = [self.disc, self.specimen].map(|radius| PI * radius * radius);
        let edge = shadow.edge();
        let smooth = LowPass::of(&edge, HARMONICS);
        Drape {
            coefficient: (shadow.area() - disc) / (specimen - disc),
            nodes: maxima(&smooth.curve(edge.len()), PROMINENCE).len(),
            amplitudes: smooth.amplitudes(),
            edge,
            speed: simulation.summary().speed_max,
        }
    }
}

/// Where the grid of a start has a particle, from the specimen's middle in spacings: places that fill the square evenly
/// (the additive recurrence of the plastic number, Roberts 2018).
fn grid(seed: u64) -> [f64; 2] {
    [0.754_877_666_246_693, 0.569_840_290_998_053].map(|step| (seed as f64 * step).fract() - 0.5)
}
