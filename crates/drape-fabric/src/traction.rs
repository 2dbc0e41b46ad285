use drape_hysteresis::BlimanSorine;

use crate::law::{Law, Memory, Response};
use crate::path::Path;

/// Strain over which a compressed yarn gives way, a ratio.
///
/// Larger values make compression stiffer and the equations easier; smaller ones sharpen the corner
/// at zero strain, on which quasi-Newton iterations stumble. A fifth of a per cent is well below the
/// strains of a KES tensile curve (1 to 10 %).
pub const BUCKLING_STRAIN: f64 = 0.002;

/// Stiffness that keeps a buckled yarn segment from collapsing, in N/m.
///
/// The load grows with the square of the compression: 0.5 N/m at 10 %, a quarter of the weight of
/// a metre of cloth. Without it a segment could shrink to nothing at no cost.
pub const POST_BUCKLING_STIFFNESS: f64 = 100.0;

/// Smallest toe ratio; at one half the fabric would have no stiffness at rest.
pub const TOE_RATIO_MIN: f64 = 0.505;

/// Tension of a woven fabric along one of its yarns, per width, against strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TractionLaw {
    /// Elastic load in tension.
    pub backbone: TractionBackbone,
    /// Internal friction; its plateau is in N/m, its length a ratio.
    pub friction: BlimanSorine,
    /// What a yarn carries in compression.
    pub buckling: Buckling,
}

/// Elastic load of a fabric in tension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TractionBackbone {
    /// A priming zone that runs into a line [Ngo Ngoc & Boivin 2004, eq. 3].
    Primed(Primed),
    /// Even polynomial of the strain [Tagawa et al. 2003, fig. 8a].
    Polynomial(Polynomial),
}

/// Priming zone (toe) and linear zone of a tensile curve [Ngo Ngoc & Boivin 2004, eq. 3].
///
/// With the toe ratio `$r = F_1/(k_t\varepsilon_c)$` the load is
///
/// ```math
/// F = k_t\left[(1-r)\,\varepsilon^2/\varepsilon_c + (2r-1)\,\varepsilon\right]
/// \;(\varepsilon \le \varepsilon_c), \qquad
/// F = k_t\left[\varepsilon - (1-r)\,\varepsilon_c\right]\;(\varepsilon > \varepsilon_c)
/// ```
///
/// once differentiable, and monotone for `$\tfrac12 \le r \le 1$`. The length of the toe remembers
/// the largest elongation `$\hat\varepsilon$`:
///
/// ```math
/// \varepsilon_c = \varepsilon_1 + (\varepsilon_1'-\varepsilon_1)
/// \left(1 - e^{-(\hat\varepsilon-\varepsilon_1)/\varepsilon_1}\right),
/// \qquad \hat\varepsilon > \varepsilon_1
/// ```
///
/// with the toe ratio unchanged. The paper has two values of `$\varepsilon_c$` and no rule between
/// them; this one is continuous, keeps the virgin curve rising while
/// `$\varepsilon_1' \le 2\varepsilon_1$`, and saturates, so that it does not extrapolate a fit to
/// absurd lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Primed {
    /// Linear rigidity `$k_t$`, in N/m.
    pub stiffness: f64,
    /// Toe ratio `$r$`, from 0.505 to 1; 1 is a straight line.
    pub toe_ratio: f64,
    /// Strain `$\varepsilon_1$` where the priming zone of a virgin fabric ends, a ratio.
    pub toe_strain: f64,
    /// Strain `$\varepsilon_1'$` where it ends once the fabric has been stretched, a ratio from
    /// `toe_strain` to twice that.
    pub toe_strain_after: f64,
}

/// Even polynomial `$F = c_2\varepsilon^2 + c_4\varepsilon^4$` [Tagawa et al. 2003, fig. 8a].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polynomial {
    /// Coefficient `$c_2$` of the squared strain, in N/m.
    pub quadratic: f64,
    /// Coefficient `$c_4$` of the fourth power, in N/m.
    pub quartic: f64,
}

/// Load of a compressed yarn, which buckles below the spacing of the particles.
///
/// ```math
/// F = k_0\varepsilon_b\left(e^{\varepsilon/\varepsilon_b}-1\right) - \tfrac12 k_p\varepsilon^2,
/// \qquad \varepsilon < 0
/// ```
///
/// where `$k_0$` is the stiffness at rest, so that the slope is continuous. No KES test measures it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Buckling {
    /// Strain `$\varepsilon_b$` over which the stiffness at rest is lost, a ratio.
    pub strain: f64,
    /// Growth `$k_p$` of the stiffness after buckling, in N/m.
    pub stiffness: f64,
}

impl Default for Buckling {
    fn default() -> Self {
        Self { strain: BUCKLING_STRAIN, stiffness: POST_BUCKLING_STIFFNESS }
    }
}

impl Primed {
    /// Strain where the priming zone ends after the largest elongation `peak`, a ratio.
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

    /// Load and slope at a strain of at least 0 with a toe of fixed length.
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

    /// Load and slope at a strain beyond every earlier one and beyond the virgin toe.
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

    /// Integral of the load from 0 to a strain of at least 0 with a toe of fixed length, in J/m².
    pub(crate) fn fixed_energy(&self, toe: f64, strain: f64) -> f64 {
        let Self { stiffness, toe_ratio, .. } = *self;
        let within = strain.min(toe);
        let square = within * within;
        let toe_part = (1.0 - toe_ratio) * square * within / (3.0 * toe)
            + 0.5 * (2.0 * toe_ratio - 1.0) * square;
        let beyond = strain - within;
        stiffness * (toe_part + beyond * (0.5 * (strain + within) - (1.0 - toe_ratio) * toe))
    }

    /// Integral of the load from 0, the largest elongation before being `peak`, in J/m².
    fn energy(&self, peak: f64, strain: f64) -> f64 {
        let seen = peak.max(self.toe_strain);
        if strain <= seen {
            return self.fixed_energy(self.toe(peak), strain);
        }
        // The moving toe's integral: ∫ε_c dε = ε₁'Δε − ε₁(ε_c(end) − ε_c(start)).
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
    /// Elastic load and slope with the largest earlier elongation `peak`, in N/m.
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

    /// The path of the friction, whose plateau is weighted by the share of yarns that bear.
    ///
    /// In the priming zone the weight is `$g = [(1-r)\varepsilon/\varepsilon_c + 2r-1]/r$`, which is
    /// one at its end; the paper's own factor has the unit of a strain and jumps there. Below zero
    /// strain the yarns buckle and the weight falls to nothing.
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
        let (load, tangent) = self.path(memory, strain).respond(&self.friction, memory.friction);
        Response { load: elastic.load + load, tangent: elastic.tangent + tangent }
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
