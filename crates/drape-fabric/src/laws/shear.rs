//! Law of shear: shear force per length against the sine of the shear angle.

use drape_hysteresis::{BlimanSorine, Response};

use crate::laws::law::{Law, Memory};
use crate::laws::path::Path;
use crate::laws::piecewise::Piecewise;
use crate::laws::varying::Varying;

/// Fraction of the interval from the onset of locking to its limit, beyond which the load is a
/// line.
///
/// The load of [`Locking`] has a pole that a solver's trial may overshoot. Beyond this fraction the
/// load continues as its tangent, which is 400 times as steep as at the onset. Every trial thus has
/// a finite load.
const LINE_FROM: f64 = 0.95;

/// Shear force per length against the sine of the shear angle.
///
/// The deformation is `$s = \sin\varphi$` with the KES shear angle `$\varphi$`. The work of the KES
/// force is `$F\cos\varphi\,\mathrm{d}\varphi = F\,\mathrm{d}s$` \[BHW94, eq. 5.7\], so the
/// measured force equals the load of this law without a factor. Up to 8°, the end of the KES test,
/// the sine differs from the angle by 0.3 %.
///
/// ```math
/// F = F_e(s) + F_{fr},\qquad F_c(s) = F_c\,(1 + \gamma|s|)
/// ```
///
/// The plateau of the friction grows with the deformation, because KES loops widen with the angle
/// (2HG5 > 2HG). The constant plateau of \[NB04, eq. 5\] cannot represent this.
///
/// ```
/// use drape_fabric::{BlimanSorine, Law, ShearBackbone, ShearLaw};
///
/// let law = ShearLaw {
///     backbone: ShearBackbone::Linear { stiffness: 35.0 },
///     friction: BlimanSorine::first_order(0.5, 0.004)?,
///     growth: 6.0,
///     locking: None,
/// };
/// let force = law.respond(&law.virgin(), 5_f64.to_radians().sin()).load;
/// assert!(force > 35.0 * 5_f64.to_radians().sin(), "friction adds to the elastic force");
/// # Ok::<(), drape_fabric::FrictionError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearLaw {
    /// Elastic load, per length.
    pub backbone: ShearBackbone,
    /// Friction of first or second order, with a plateau in N/m and a length that is a sine.
    pub friction: BlimanSorine,
    /// Growth `$\gamma$` of the plateau per unit of the sine, at least 0.
    pub growth: f64,
    /// Locking of the yarns at large angles, if modelled.
    pub locking: Option<Locking>,
}

/// Elastic shear force per length, odd in the sine of the shear angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ShearBackbone {
    /// Line `$F_e = k_s\,s$`.
    Linear {
        /// Shear stiffness `$k_s$`, in N/m per unit of the sine.
        stiffness: f64,
    },
    /// Stiffness that changes with the shear: stiffnesses in N/m, transition a sine.
    Varying(Varying),
    /// Quadratic and line: slope and intercept in N/m, knot a sine.
    Piecewise(Piecewise),
}

/// Locking of the yarns: beyond the onset the load follows `$a/(s_l - s) + b$`.
///
/// Value and slope are continuous at the onset. The pole at 1.05 rad keeps the shear below about
/// 60°. In \[BHW94, §5.3\] the energy has this pole instead of the load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Locking {
    /// Sine of the angle at which locking begins: the end of the measurement.
    pub onset: f64,
    /// Sine of the largest possible angle.
    pub limit: f64,
}

impl Default for Locking {
    /// Returns locking from 8°, the end of the KES test, with the limit 1.05 rad.
    fn default() -> Self {
        Self { onset: 8_f64.to_radians().sin(), limit: 1.05_f64.sin() }
    }
}

impl ShearBackbone {
    /// Returns load and tangent at `shear`, a sine.
    pub(crate) fn respond(&self, shear: f64) -> Response {
        match self {
            Self::Linear { stiffness } => Response { load: stiffness * shear, tangent: *stiffness },
            Self::Varying(varying) => varying.respond(shear),
            Self::Piecewise(p) => Response { load: p.load(shear), tangent: p.tangent(shear) },
        }
    }

    /// Returns the energy per area at `shear`, a sine, in J/m².
    pub(crate) fn energy(&self, shear: f64) -> f64 {
        match self {
            Self::Linear { stiffness } => 0.5 * stiffness * shear * shear,
            Self::Varying(varying) => varying.energy(shear * shear),
            Self::Piecewise(piecewise) => piecewise.energy(shear),
        }
    }
}

/// Elastic load and tangent, and the elastic energy per area, in J/m².
#[derive(Debug, Clone, Copy)]
pub(crate) struct Elastic {
    pub(crate) response: Response,
    pub(crate) energy: f64,
}

impl Locking {
    /// Returns the response at a `shear` of at least the onset, with the energy from the onset to
    /// `shear`. `at_onset` is the response at the onset.
    pub(crate) fn respond(&self, at_onset: Response, shear: f64) -> Elastic {
        let span = self.limit - self.onset;
        let pole = at_onset.tangent * span * span;
        let end = self.onset + LINE_FROM * span;
        let on_curve = shear.min(end);
        let remaining = self.limit - on_curve;
        let load = at_onset.load + pole * (1.0 / remaining - 1.0 / span);
        let tangent = pole / (remaining * remaining);
        let beyond_onset = on_curve - self.onset;
        let energy =
            at_onset.load * beyond_onset + pole * ((span / remaining).ln() - beyond_onset / span);
        let line = shear - on_curve;
        Elastic {
            response: Response { load: load + tangent * line, tangent },
            energy: energy + line * (load + 0.5 * tangent * line),
        }
    }
}

impl ShearLaw {
    /// Returns elastic load, tangent and energy at `shear`, a sine.
    pub(crate) fn elastic(&self, shear: f64) -> Elastic {
        let size = shear.abs();
        match self.locking {
            Some(locking) if size > locking.onset => {
                let at_onset = self.backbone.respond(locking.onset);
                let Elastic { mut response, energy } = locking.respond(at_onset, size);
                response.load = response.load.copysign(shear);
                Elastic { response, energy: energy + self.backbone.energy(locking.onset) }
            }
            _ => Elastic {
                response: self.backbone.respond(shear),
                energy: self.backbone.energy(shear),
            },
        }
    }

    /// Returns the path of the friction from `memory` to `shear`.
    fn path(&self, memory: &Memory, shear: f64) -> Path {
        Path::new(memory.position, shear, &[0.0], |s: f64| 1.0 + self.growth * s.abs())
    }
}

impl Law for ShearLaw {
    fn respond(&self, memory: &Memory, shear: f64) -> Response {
        let elastic = self.elastic(shear).response;
        let friction = self.path(memory, shear).respond(&self.friction, memory.friction);
        Response { load: elastic.load + friction.load, tangent: elastic.tangent + friction.tangent }
    }

    fn work(&self, memory: &Memory, shear: f64) -> f64 {
        self.elastic(shear).energy - self.elastic(memory.position).energy
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
        self.elastic(memory.position).energy + self.friction.stored(memory.friction)
    }
}
