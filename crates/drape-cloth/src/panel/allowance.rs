//! Allowances of seams and hems: cloth along an outline that adds mass to the particles there.

use crate::error::Error;
use crate::panel::lattice::Lattice;

/// Strip of cloth along part of a panel's outline: the allowance of a seam, or a hem.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Allowance {
    /// Consecutive particles along the outline, by their numbers in the panel, from 0.
    pub line: Vec<u32>,
    /// Width of the strip of cloth, in m.
    pub width: f64,
}

impl Lattice {
    /// Returns the panel with `allowances` along parts of its outline.
    ///
    /// An allowance has the length of its line in material coordinates. Half of the mass of each
    /// segment is added to either end. An allowance has no connectors and no contact. Where two
    /// consecutive particles of a line are not neighbours on the outline, as over the mouth of a
    /// dart, nothing is added.
    ///
    /// # Errors
    /// A width is negative or not finite, or a particle does not exist.
    pub fn with_allowances(mut self, allowances: &[Allowance]) -> Result<Self, Error> {
        let particles = self.coordinates.len();

        // All allowances are checked before any is added.
        for Allowance { line, width } in allowances {
            if !(*width >= 0.0 && width.is_finite()) {
                return Err(Error::Width { width: *width });
            }
            if let Some(&node) = line.iter().find(|&&node| node as usize >= particles) {
                let (part, index) = ("node", node as usize);
                let what = "has an allowance and does not exist";
                return Err(Error::Mesh { part, index, what });
            }
        }
        if allowances.iter().all(|allowance| allowance.width == 0.0) {
            return Ok(self);
        }

        let outline = self.outline();
        self.allowances.resize(particles, 0.0);
        for Allowance { line, width } in allowances {
            for pair in line.windows(2) {
                let [a, b] = [pair[0], pair[1]];
                if outline.contains(&[a.min(b), a.max(b)]) {
                    let [from, to] = [a, b].map(|node| self.coordinates[node as usize]);
                    let half = 0.5 * width * (to[0] - from[0]).hypot(to[1] - from[1]);
                    [a, b].iter().for_each(|&node| self.allowances[node as usize] += half);
                }
            }
        }
        Ok(self)
    }

    /// Returns the areas that give the particles their mass, in m²: `areas` plus allowances.
    pub(crate) fn areas_of_mass(&self, areas: &[f64]) -> Vec<f64> {
        let mut sums = areas.to_vec();
        sums.iter_mut().zip(&self.allowances).for_each(|(area, allowance)| *area += allowance);
        sums
    }
}

#[cfg(test)]
mod tests {
    use drape_fabric::{Fabric, samples};

    use super::*;
    use crate::{Cloth, Grain, Mesh};

    fn allowance(line: &[u32], width: f64) -> Allowance {
        Allowance { line: line.to_vec(), width }
    }

    fn masses(lattice: &Lattice) -> Vec<f64> {
        let fabric = Fabric { density: 0.2, ..samples::plain_weave() };
        let cloth = Cloth::new(&[(lattice, &fabric)]).expect("a cloth");
        assert!((cloth.areas().iter().sum::<f64>() / lattice.area() - 1.0).abs() < 1e-12);
        let areas = cloth.connector_areas();
        for area in areas.traction.into_iter().chain([areas.shear]).chain(areas.bending) {
            assert!((area / lattice.area() - 1.0).abs() < 1e-12, "{area}");
        }
        cloth.masses().to_vec()
    }

    #[test]
    fn allowances_weigh_on_their_line_and_nowhere_else() {
        // 5 × 3 particles.
        let plain = Lattice::rectangle(0.4, 0.2, 0.1).expect("a rectangle");
        let lines = [allowance(&[0, 1, 2, 3, 4], 0.02), allowance(&[4, 9, 14], 0.01)];
        let sewn = plain.clone().with_allowances(&lines).expect("lines of its outline");
        let (before, after) = (masses(&plain), masses(&sewn));
        let added: Vec<f64> = after.iter().zip(&before).map(|(new, old)| new - old).collect();
        let hem = 0.2 * 0.02 * 0.1;
        let side = 0.2 * 0.01 * 0.1;
        let mut expected = [0.0; 15];
        expected[..4].copy_from_slice(&[0.5 * hem, hem, hem, hem]);
        (expected[4], expected[9], expected[14]) = (0.5 * (hem + side), side, 0.5 * side);
        for (particle, (added, expected)) in added.iter().zip(expected).enumerate() {
            assert!((added - expected).abs() < 1e-16, "{particle}: {added} and {expected}");
        }
    }

    #[test]
    fn a_leap_from_one_part_of_the_outline_to_another_adds_nothing() {
        let plain = Lattice::rectangle(0.4, 0.2, 0.1).expect("a rectangle");
        // Over the corner, inwards, and back.
        let leaps = [allowance(&[3, 9, 7, 2], 0.02)];
        let sewn = plain.clone().with_allowances(&leaps).expect("they are particles");
        assert_eq!(masses(&sewn), masses(&plain));
    }

    #[test]
    fn the_sides_of_a_rim_have_allowances_of_their_own_length() {
        let mesh = Mesh {
            spacing: [0.01; 2],
            coordinates: vec![[0.0, 0.0], [0.01, 0.0], [0.0, 0.01], [0.01, 0.01], [0.005, 0.018]],
            grid: vec![[0, 0], [1, 0], [0, 1], [1, 1]],
            cells: vec![[0, 1, 3, 2]],
            triangles: vec![[2, 3, 4]],
        };
        let plain = Lattice::from_mesh(mesh, Grain::default()).expect("a panel");
        // The last pair is the side of the cell, with cloth on both sides.
        let sewn =
            plain.clone().with_allowances(&[allowance(&[3, 4, 2, 3], 0.004)]).expect("a line");
        let [before, after] = [&plain, &sewn].map(|l| masses(l).iter().sum::<f64>());
        let added = 0.2 * 0.004 * 2.0 * 0.005_f64.hypot(0.008);
        assert!(((after - before) / added - 1.0).abs() < 1e-12, "{after} {before} {added}");
    }

    #[test]
    fn widths_that_are_none_are_refused_and_zero_leaves_the_panel_as_it_is() {
        let plain = Lattice::rectangle(0.4, 0.2, 0.1).expect("a rectangle");
        let with =
            |line: Vec<u32>, width| plain.clone().with_allowances(&[allowance(&line, width)]);
        assert_eq!(with(vec![0, 1], 0.0), Ok(plain.clone()));
        assert!(matches!(with(vec![0, 1], -0.01), Err(Error::Width { .. })));
        assert!(matches!(with(vec![0, 1], f64::NAN), Err(Error::Width { .. })));
        assert!(matches!(with(vec![0, 15], 0.01), Err(Error::Mesh { index: 15, .. })));
    }
}
