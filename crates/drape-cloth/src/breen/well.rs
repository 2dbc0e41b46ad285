//! Energy of two particles as a function of their distance: stretching and repulsion in one well.

use crate::measure::block::Block;
use crate::measure::vector::{Vector, length};

/// Standard gravity, in m/s².
const GRAVITY: f64 = 9.806_65;

/// Energy well of two particles \[BHW94, eqs. 3.2 and 3.3\]. With the distance `$\rho$` in units of
/// the spacing,
///
/// ```math
/// U = C_0\,(\rho - 1)^5\;(\rho > 1), \qquad U = C_0\,\frac{(1 - \rho)^5}{\rho}\;(\rho \le 1)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Well {
    /// Distance at which the energy is zero, in m.
    pub(crate) spacing: f64,
    /// Factor `$C_0$`, in J.
    pub(crate) energy: f64,
}

/// Energy at a distance, in J, and its derivatives with respect to the distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WellResponse {
    pub(crate) energy: f64,
    pub(crate) first: f64,
    pub(crate) second: f64,
}

impl Well {
    /// Returns the factor per area, in J/m², for which the weight of a metre of cloth of `density`
    /// has the given `strain`. The tension per width is `$5C_0\varepsilon^4$`.
    pub(crate) fn depth(density: f64, strain: f64) -> f64 {
        density * GRAVITY / (5.0 * strain.powi(4))
    }

    /// Returns the well between two particles: the mean of the wells `a` and `b` of both.
    pub(crate) fn between(a: &Self, b: &Self) -> Self {
        Self { spacing: 0.5 * (a.spacing + b.spacing), energy: 0.5 * (a.energy + b.energy) }
    }

    /// Returns energy and derivatives at `distance`, in m.
    pub(crate) fn at(&self, distance: f64) -> WellResponse {
        let unit = 1.0 / self.spacing;
        let ratio = distance * unit;
        let apart = ratio - 1.0;
        let cube = apart * apart * apart;

        // Both branches are derivatives with respect to the ratio ρ.
        let [energy, first, second] = if apart > 0.0 {
            [cube * apart * apart, 5.0 * cube * apart, 20.0 * cube]
        } else {
            // With y = 1 − ρ: y⁵/ρ, −y⁴(5ρ + y)/ρ², (20y³ρ² + 10y⁴ρ + 2y⁵)/ρ³.
            let y = -apart;
            let (cube, inverse) = (-cube, 1.0 / ratio);
            let bend = 20.0 * ratio * ratio + 10.0 * y * ratio + 2.0 * y * y;
            [
                cube * y * y * inverse,
                -cube * y * (5.0 * ratio + y) * inverse * inverse,
                cube * bend * inverse * inverse * inverse,
            ]
        };
        WellResponse {
            energy: self.energy * energy,
            first: self.energy * first * unit,
            second: self.energy * second * unit * unit,
        }
    }

    /// Returns the second derivatives with respect to `span`, the vector from one particle to the
    /// other. With `definite`, compression across the pair is left out.
    pub(crate) fn block(&self, span: Vector, definite: bool) -> Block {
        let distance = length(span);
        let WellResponse { first, second, .. } = self.at(distance);
        let across = first / distance;
        let across = if definite { across.max(0.0) } else { across };
        let along = (second - across) / (distance * distance);
        std::array::from_fn(|k| {
            let diagonal = if k % 4 == 0 { across } else { 0.0 };
            along * span[k / 3] * span[k % 3] + diagonal
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WELL: Well = Well { spacing: 0.02, energy: 300.0 };

    #[test]
    fn the_energy_is_the_papers_in_spacings() {
        for ratio in [0.3, 0.8, 0.99, 1.0, 1.01, 1.2] {
            let found = WELL.at(ratio * WELL.spacing).energy / WELL.energy;
            let exact = if ratio > 1.0 {
                f64::powi(ratio - 1.0, 5)
            } else {
                f64::powi(1.0 - ratio, 5) / ratio
            };
            assert!((found - exact).abs() < 1e-15 + 1e-9 * exact, "{found} at {ratio}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_energy() {
        for ratio in [0.2, 0.6, 0.9, 1.05, 1.5] {
            let (at, h) = (ratio * WELL.spacing, 1e-6 * WELL.spacing);
            let WellResponse { first, second, .. } = WELL.at(at);
            let slope = (WELL.at(at + h).energy - WELL.at(at - h).energy) / (2.0 * h);
            let bend = (WELL.at(at + h).first - WELL.at(at - h).first) / (2.0 * h);
            assert!((slope / first - 1.0).abs() < 1e-6, "{slope} and {first} at {ratio}");
            assert!((bend / second - 1.0).abs() < 1e-6, "{bend} and {second} at {ratio}");
            assert!(second > 0.0, "the well is convex at {ratio}");
        }
    }

    #[test]
    fn the_weight_of_a_metre_strains_the_yarns_as_asked() {
        // Yarns a spacing apart, each of a square of cloth per edge.
        let (density, strain, spacing) = (0.2, 0.01, 0.02);
        let energy = Well::depth(density, strain) * spacing * spacing;
        let pull = Well { spacing, energy }.at((1.0 + strain) * spacing).first;
        assert!((pull / spacing / (density * GRAVITY) - 1.0).abs() < 1e-12);
    }
}
