//! Law of traction: tension per width against strain along one yarn system.

use drape_hysteresis::{BlimanSorine, Response};

use crate::laws::law::{Law, Memory};
use crate::laws::path::Path;

/// Strain over which a compressed yarn buckles, a ratio.
///
/// Larger values make compression stiffer and the equations easier to solve; smaller ones sharpen the
/// corner of the load at zero strain, which slows quasi-Newton iterations. A fifth of a per cent is
/// well below the strains of a KES tensile curve (1 to 10 %).
pub const BUCKLING_STRAIN: f64 = 0.002;

/// Post-buckling stiffness of a yarn, in N/m.
///
/// The load grows with the square of the compression: 0.5 N/m at 10 %, a quarter of the weight of
/// a metre of cloth. Without it a segment could shrink to zero length without any load.
pub const POST_BUCKLING_STIFFNESS: f64 = 100.0;

/// Smallest toe ratio, a ratio; at one half the fabric would have no stiffness at rest.
pub const TOE_RATIO_MIN: f64 = 0.505;

/// Tension per width of a woven fabric along one of its yarn systems, against strain.
///
/// ```math
/// F = F_e(\varepsilon, \hat\varepsilon) + F_{fr}
/// ```
///
/// with the elastic backbone `$F_e$` ([`TractionBackbone`]; [`Buckling`] in compression) and the
/// friction `$F_{fr}$`, whose plateau carries the weight
///
/// ```math
/// g(\varepsilon) = \frac{(1-r)\,\varepsilon/\varepsilon_c + 2r-1}{r}\;(0 \le \varepsilon \le \varepsilon_c),
/// \qquad g = 1\;(\varepsilon > \varepsilon_c)
/// ```
///
/// because in the priming zone only part of the yarns bear load. Below zero strain the yarns buckle
/// and the weight falls linearly to zero at `$-\varepsilon_b$`. The factor printed in \[NB04, eq. 3\],
/// `$a\varepsilon + b$`, has the unit of a strain and jumps at `$\varepsilon_c$`; `$g$` is that factor
/// times `$k_t/F_1$`.
///
/// ```
/// use drape_fabric::{BlimanSorine, Buckling, Law, Primed, TractionBackbone, TractionLaw};
///
/// let toe = Primed { stiffness: 4000.0, toe_ratio: 0.7, toe_strain: 0.01, toe_strain_after: 0.01 };
/// let law = TractionLaw {
///     backbone: TractionBackbone::Primed(toe),
///     friction: BlimanSorine::none(),
///     buckling: Buckling::default(),
/// };
/// assert!((law.respond(&law.virgin(), 0.01).load - toe.toe_load()).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TractionLaw {
    /// Elastic load in tension, per width.
    pub backbone: TractionBackbone,
    /// Internal friction; its plateau is in N/m, its length a ratio.
    pub friction: BlimanSorine,
    /// Elastic load in compression, per width.
    pub buckling: Buckling,
}

/// Elastic load of a fabric in tension, per width.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TractionBackbone {
    /// Priming zone, then a line \[NB04, eq. 3\].
    Primed(Primed),
    /// Even polynomial of the strain \[THK03, fig. 8a\].
    Polynomial(Polynomial),
}

/// Priming zone (toe) and linear zone of a tensile curve \[NB04, eq. 3\].
///
/// With the stiffness `$k_t$`, the end `$\varepsilon_c$` of the priming zone, the load `$F_1$` there and
/// the toe ratio `$r = F_1/(k_t\varepsilon_c)$` the load is
///
/// ```math
/// F = k_t\left[(1-r)\,\varepsilon^2/\varepsilon_c + (2r-1)\,\varepsilon\right]
/// \;(\varepsilon \le \varepsilon_c), \qquad
/// F = k_t\left[\varepsilon - (1-r)\,\varepsilon_c\right]\;(\varepsilon > \varepsilon_c)
/// ```
///
/// It is once differentiable, and monotone for `$\tfrac12 \le r \le 1$`. The end of the toe depends on
/// the largest elongation so far, `$\hat\varepsilon$`:
///
/// ```math
/// \varepsilon_c = \varepsilon_1 + (\varepsilon_1'-\varepsilon_1)
/// \left(1 - e^{-(\hat\varepsilon-\varepsilon_1)/\varepsilon_1}\right),
/// \qquad \hat\varepsilon > \varepsilon_1
/// ```
///
/// with the toe ratio unchanged. The paper identifies two values of `$\varepsilon_c$` and gives no rule
/// between them. This rule is continuous, keeps the virgin curve rising while
/// `$\varepsilon_1' \le 2\varepsilon_1$`, and saturates, so that a fit is not extrapolated without
/// bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Primed {
    /// Stiffness `$k_t$` of the linear zone, in N/m.
    pub stiffness: f64,
    /// Toe ratio `$r$`, from 0.505 to 1; 1 is a straight line.
    pub toe_ratio: f64,
    /// Strain `$\varepsilon_1$` where the priming zone of a virgin fabric ends, a ratio.
    pub toe_strain: f64,
    /// Strain `$\varepsilon_1'$` where it ends after the fabric has been stretched, a ratio from
    /// `toe_strain` to twice that.
    pub toe_strain_after: f64,
}

/// Even polynomial `$F = c_2\varepsilon^2 + c_4\varepsilon^4$` \[THK03, fig. 8a\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polynomial {
    /// Coefficient `$c_2$` of the squared strain, in N/m.
    pub quadratic: f64,
    /// Coefficient `$c_4$` of the fourth power, in N/m.
    pub quartic: f64,
}

/// Load of a compressed yarn, which buckles at a length below the spacing of the particles.
///
/// ```math
/// F = k_0\varepsilon_b\left(e^{\varepsilon/\varepsilon_b}-1\right) - \tfrac12 k_p\varepsilon^2,
/// \qquad \varepsilon < 0
/// ```
///
/// with the stiffness `$k_0$` at rest, so that the slope is continuous. No KES test measures it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Buckling {
    /// Strain `$\varepsilon_b$` over which the stiffness at rest decays, a ratio.
    pub strain: f64,
    /// Increase `$k_p$` of the stiffness per strain after buckling, in N/m.
    pub stiffness: f64,
}

impl Default for Buckling {
    fn default() -> Self {
        Self { strain: BUCKLING_STRAIN, stiffness: POST_BUCKLING_STIFFNESS }
    }
}

impl Primed {
    /// Returns the strain where the priming zone ends after the largest elongation `peak`, a ratio.
    #[must_use]
    pub fn toe(&self, peak: f64) -> f64 {
        let beyond = (peak - self.toe_strain).max(0.0) / self.toe_strain;
        self.toe_strain - (self.toe_strain_after - self.toe_strain) * (-beyond).exp_m1()
    }

    /// Load `$F_1$` at the end of the virgin priming zone, in N/m.
    #[must_use]
    pub fn toe_load(&self) -> f64 {
        self.toe_ratio * self.stiffness * self.toe_strain
    }

    /// Returns load and tangent at a strain of at least 0 with a toe of fixed length.
    fn fixed(&self, toe: f64, strain: f64) -> Response {
        let Self { stiffness, toe_ratio, .. } = *self;
        if strain <= toe {
            let bend = (1.0 - toe_ratio) * strain / toe;
            Response {
                load: stiffness * strain * (bend + 2.0 * toe_ratio - 1.0),
                tangent: stiffness * (2.0 * bend + 2.0 * toe_ratio - 1.0),
            }
        } else {
            let load = stiffness * (strain - (1.0 - toe_ratio) * toe);
            Response { load, tangent: stiffness }
        }
    }

    /// Returns load and tangent at a strain beyond every earlier one and beyond the virgin toe.
    fn virgin(&self, strain: f64) -> Response {
        let toe = self.toe(strain);
        let growth = (self.toe_strain_after - toe) / self.toe_strain;
        Response {
            load: self.stiffness * (strain - (1.0 - self.toe_ratio) * toe),
            tangent: self.stiffness * (1.0 - (1.0 - self.toe_ratio) * growth),
        }
    }

    fn respond(&self, peak: f64, strain: f64) -> Response {
        if strain > peak.max(self.toe_strain) {
            self.virgin(strain)
        } else {
            self.fixed(self.toe(peak), strain)
        }
    }

    /// Returns the integral of the load from 0 to a strain of at least 0 with a toe of fixed length, in
    /// J/m².
    pub(crate) fn fixed_energy(&self, toe: f64, strain: f64) -> f64 {
        let Self { stiffness, toe_ratio, .. } = *self;
        let within = strain.min(toe);
        let square = within * within;
        let toe_part = (1.0 - toe_ratio) * square * within / (3.0 * toe)
            + 0.5 * (2.0 * toe_ratio - 1.0) * square;
        let beyond = strain - within;
        stiffness * (toe_part + beyond * (0.5 * (strain + within) - (1.0 - toe_ratio) * toe))
    }

    /// Returns the integral of the load from 0 after the largest elongation `peak`, in J/m².
    fn energy(&self, peak: f64, strain: f64) -> f64 {
        let seen = peak.max(self.toe_strain);
        if strain <= seen {
            return self.fixed_energy(self.toe(peak), strain);
        }
        // Integral of the moving toe: ∫ε_c dε = ε₁'Δε − ε₁(ε_c(end) − ε_c(start)).
        let toes = self.toe_strain_after * (strain - seen)
            - self.toe_strain * (self.toe(strain) - self.toe(seen));
        let line = 0.5 * (strain - seen) * (strain + seen);
        self.fixed_energy(self.toe(seen), seen)
            + self.stiffness * (line - (1.0 - self.toe_ratio) * toes)
    }
}

impl TractionBackbone {
    /// Stiffness at rest, in N/m.
    #[must_use]
    pub fn rest_stiffness(&self) -> f64 {
        match self {
            Self::Primed(primed) => primed.stiffness * (2.0 * primed.toe_ratio - 1.0),
            Self::Polynomial(_) => 0.0,
        }
    }

    fn respond(&self, peak: f64, strain: f64) -> Response {
        match self {
            Self::Primed(primed) => primed.respond(peak, strain),
            Self::Polynomial(Polynomial { quadratic, quartic }) => {
                let square = strain * strain;
                Response {
                    load: square * (quadratic + quartic * square),
                    tangent: strain * (2.0 * quadratic + 4.0 * quartic * square),
                }
            }
        }
    }

    fn energy(&self, peak: f64, strain: f64) -> f64 {
        match self {
            Self::Primed(primed) => primed.energy(peak, strain),
            Self::Polynomial(Polynomial { quadratic, quartic }) => {
                let square = strain * strain;
                strain * square * (quadratic / 3.0 + quartic * square / 5.0)
            }
        }
    }
}

impl TractionLaw {
    /// Returns the elastic load and its tangent after the largest elongation `peak`, in N/m.
    #[must_use]
    pub fn elastic(&self, peak: f64, strain: f64) -> Response {
        if strain >= 0.0 {
            return self.backbone.respond(peak, strain);
        }
        let rest = self.backbone.rest_stiffness();
        let Buckling { strain: scale, stiffness } = self.buckling;
        let lost = (strain / scale).exp_m1();
        Response {
            load: rest * scale * lost - 0.5 * stiffness * strain * strain,
            tangent: rest * (1.0 + lost) - stiffness * strain,
        }
    }

    fn elastic_energy(&self, peak: f64, strain: f64) -> f64 {
        if strain >= 0.0 {
            return self.backbone.energy(peak, strain);
        }
        let rest = self.backbone.rest_stiffness();
        let Buckling { strain: scale, stiffness } = self.buckling;
        rest * scale * (scale * (strain / scale).exp_m1() - strain)
            - stiffness * strain * strain * strain / 6.0
    }

    /// Returns the path of the friction with the weight `$g$` of the type's documentation.
    fn path(&self, memory: &Memory, strain: f64) -> Path {
        let slack = -self.buckling.strain;
        let (toe, at_rest) = match &self.backbone {
            TractionBackbone::Primed(p) => (p.toe(memory.peak), 2.0 - 1.0 / p.toe_ratio),
            TractionBackbone::Polynomial(_) => (0.0, 1.0),
        };
        let weight = |strain: f64| {
            if strain >= toe {
                1.0
            } else if strain >= 0.0 {
                at_rest + (1.0 - at_rest) * strain / toe
            } else {
                at_rest * (1.0 - strain / slack).max(0.0)
            }
        };
        Path::new(memory.position, strain, &[slack, 0.0, toe], weight)
    }
}

impl Law for TractionLaw {
    fn respond(&self, memory: &Memory, strain: f64) -> Response {
        let elastic = self.elastic(memory.peak, strain);
        let friction = self.path(memory, strain).respond(&self.friction, memory.friction);
        Response { load: elastic.load + friction.load, tangent: elastic.tangent + friction.tangent }
    }

    fn work(&self, memory: &Memory, strain: f64) -> f64 {
        self.elastic_energy(memory.peak, strain) - self.elastic_energy(memory.peak, memory.position)
            + self.path(memory, strain).work(&self.friction, memory.friction)
    }

    fn commit(&self, memory: &Memory, strain: f64) -> Memory {
        Memory {
            position: strain,
            friction: self.path(memory, strain).advance(&self.friction, memory.friction),
            peak: memory.peak.max(strain),
        }
    }

    fn stored(&self, memory: &Memory) -> f64 {
        self.elastic_energy(memory.peak, memory.position) + self.friction.stored(memory.friction)
    }
}
