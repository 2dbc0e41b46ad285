use drape_hysteresis::BlimanSorine;

use crate::Piecewise;
use crate::law::{Law, Memory, Response};
use crate::path::Path;

/// Part of the way from the onset of locking to its limit after which the load goes on straight.
///
/// The load of [`Locking`] has a pole that a solver's trial may overshoot; beyond this part it is a
/// line with the slope reached there, 400 times the slope at the onset, so that every trial has a
/// finite load.
const STRAIGHT_FROM: f64 = 0.95;

/// Shear force per length of a fabric against the sine of the shear angle.
///
/// The deformation is `$s = \sin\varphi$` with the KES shear angle `$\varphi$`: the work of the KES
/// force is `$F\cos\varphi\,\mathrm{d}\varphi = F\,\mathrm{d}s$` [Breen, House & Wozny 1994, eq. 5.7],
/// so the measured force is the load of this law as it stands. Up to 8°, the end of the KES test,
/// the sine differs from the angle by 0.3 %.
///
/// The friction's plateau grows with the deformation, `$F_c(1+\gamma|s|)$`, because KES loops do
/// (2HG5 > 2HG).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearLaw {
    /// Elastic load.
    pub backbone: ShearBackbone,
    /// Friction of first or second order; its plateau is in N/m, its length a sine.
    pub friction: BlimanSorine,
    /// Growth `$\gamma$` of the plateau per unit of the sine, at least 0.
    pub growth: f64,
    /// Jamming of the yarns at large angles, if modelled.
    pub locking: Option<Locking>,
}

/// Elastic shear force per length, odd in the sine of the shear angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ShearBackbone {
    /// Proportional to the sine of the angle.
    Linear {
        /// Shear rigidity `$k_s$`, in N/m per unit of the sine.
        stiffness: f64,
    },
    /// Breen's quadratic and line; slope and intercept are in N/m, the knot a sine.
    Piecewise(Piecewise),
}

/// Yarns that jam: from the onset on, the load follows `$a/(s_l - s) + b$`.
///
/// Value and slope are continuous at the onset. Breen's singularity at 1.05 rad [Breen, House &
/// Wozny 1994, §5.3] (there of the energy) keeps the shear below about 60°.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Locking {
    /// Sine of the angle where the yarns begin to jam; the end of the measurement.
    pub onset: f64,
    /// Sine of the angle that cannot be passed.
    pub limit: f64,
}

impl Default for Locking {
    /// From 8°, where the KES test ends, towards 1.05 rad.
    fn default() -> Self {
        Self { onset: 8_f64.to_radians().sin(), limit: 1.05_f64.sin() }
    }
}

impl ShearBackbone {
    pub(crate) fn respond(&self, shear: f64) -> Response {
        match self {
            Self::Linear { stiffness } => Response { load: stiffness * shear, tangent: *stiffness },
            Self::Piecewise(p) => Response { load: p.load(shear), tangent: p.tangent(shear) },
        }
    }

    pub(crate) fn energy(&self, shear: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => 0.5 * stiffness * shear * shear,
            Self::Piecewise(piecewise) => piecewise.energy(shear),
        }
    }
}

impl Locking {
    /// Response at a shear of at least the onset, with the energy from the onset on.
    pub(crate) fn respond(&self, at_onset: Response, shear: f64) -> (Response, f64) {
        let reach = self.limit - self.onset;
        let pole = at_onset.tangent * reach * reach;
        let end = self.onset + STRAIGHT_FROM * reach;
        let on_curve = shear.min(end);
        let left = self.limit - on_curve;
        let load = at_onset.load + pole * (1.0 / left - 1.0 / reach);
        let tangent = pole / (left * left);
        let way = on_curve - self.onset;
        let energy = at_onset.load * way + pole * ((reach / left).ln() - way / reach);
        let straight = shear - on_curve;
        let response = Response { load: load + tangent * straight, tangent };
        (response, energy + straight * (load + 0.5 * tangent * straight))
    }
}

impl ShearLaw {
    /// Elastic load and slope, and the elastic energy per area, at a shear.
    pub(crate) fn elastic(&self, shear: f64) -> (Response, f64) {
        let size = shear.abs();
        match self.locking {
            Some(locking) if size > locking.onset => {
                let at_onset = self.backbone.respond(locking.onset);
                let (mut response, energy) = locking.respond(at_onset, size);
                response.load = response.load.copysign(shear);
                (response, energy + self.backbone.energy(locking.onset))
            }
            _ => (self.backbone.respond(shear), self.backbone.energy(shear)),
        }
    }

    fn path(&self, memory: &Memory, shear: f64) -> Path {
        Path::new(memory.position, shear, &[0.0], |s: f64| 1.0 + self.growth * s.abs())
    }
}

impl Law for ShearLaw {
    fn respond(&self, memory: &Memory, shear: f64) -> Response {
        let (elastic, _) = self.elastic(shear);
        let (load, tangent) = self.path(memory, shear).respond(&self.friction, memory.friction);
        Response { load: elastic.load + load, tangent: elastic.tangent + tangent }
    }

    fn work(&self, memory: &Memory, shear: f64) -> f64 {
        self.elastic(shear).1 - self.elastic(memory.position).1
            + self.path(memory, shear).work(&self.friction, memory.friction)
    }

    fn commit(&self, memory: &Memory, shear: f64) -> Memory {
        Memory {
            position: shear,
            friction: self.path(memory, shear).advance(&self.friction, memory.friction),
            peak: memory.peak.max(shear.abs()),
        }
    }

    fn stored(&self, memory: &Memory) -> f64 {
        self.elastic(memory.position).1 + self.friction.stored(memory.friction)
    }
}
