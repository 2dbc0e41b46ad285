//! Map from independent particles of a sewn garment to all particles of its panels.
//!
//! The map `$S$` has a row for each particle of the panels, with one weight, 1, or, for a tied
//! particle, the two weights `$1 - \lambda$` and `$\lambda$` of the ends between which it lies.

use std::collections::{BTreeMap, BTreeSet};

use drape_cloth::Tie;
use drape_collide::equivalence_classes;
use drape_scene::SeamPairs;

/// Row of the map: the independent particles that determine the position of a particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Row {
    /// The two ends of a tied particle. Both are equal if the particle is not tied.
    pub(super) ends: [u32; 2],
    /// Fraction of the distance from the first end to the second. 0 if the particle is not tied.
    pub(super) fraction: f64,
}

/// Weight of an independent particle in a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weight {
    pub(super) particle: usize,
    pub(super) weight: f64,
}

/// Pair of independent particles that a pair of rows couples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct CoupledPair {
    pub(super) row: usize,
    pub(super) column: usize,
    /// Product of the weights in the two rows.
    pub(super) weight: f64,
}

impl Row {
    /// Returns the weights of the row that are not zero, as [`Weight`]s.
    pub(super) fn weights(&self) -> impl Iterator<Item = Weight> + use<> {
        let [first, second] = self.ends.map(|particle| particle as usize);
        let weights = [
            Weight { particle: first, weight: 1.0 - self.fraction },
            Weight { particle: second, weight: self.fraction },
        ];
        weights.into_iter().take(if self.is_tied() { 2 } else { 1 })
    }

    /// Returns whether the particle is tied between two others.
    pub(super) fn is_tied(&self) -> bool {
        self.fraction != 0.0
    }

    /// Returns the independent particle of a row that is not tied.
    pub(super) fn particle(&self) -> usize {
        self.ends[0] as usize
    }

    /// Writes the value of the row to `value`, three numbers, from the `values` of all independent
    /// particles.
    pub(super) fn interpolate(&self, values: &[f64], value: &mut [f64]) {
        let [first, second] = self.ends.map(|end| &values[3 * end as usize..][..3]);
        value.copy_from_slice(first);
        if self.is_tied() {
            value.iter_mut().zip(second).for_each(|(x, end)| *x += self.fraction * (end - *x));
        }
    }
}

/// Returns the pairs of independent particles that a block in the rows `row` and `column` couples.
pub(super) fn coupled_pairs(row: &Row, column: &Row) -> impl Iterator<Item = CoupledPair> {
    row.weights().flat_map(move |a| {
        column.weights().map(move |b| CoupledPair {
            row: a.particle,
            column: b.particle,
            weight: a.weight * b.weight,
        })
    })
}

/// Returns the pairs of independent particles that the diagonal block of `row` couples, each once.
pub(super) fn coupled_diagonal_pairs(row: &Row) -> impl Iterator<Item = CoupledPair> {
    coupled_pairs(row, row).filter(|pair| pair.row <= pair.column)
}

/// Merges the particles of each pair of `pairs`: moves the particles to the mean of their `values`,
/// three numbers each, weighted with their `masses`. Tied particles move between their ends.
pub(crate) fn merge(pairs: &SeamPairs, masses: &[f64], values: &mut [f64]) {
    let rows = rows(masses.len(), pairs);
    let count = rows.iter().map(|row| row.particle() + 1).max().unwrap_or(0);
    let mut total_masses = vec![0.0; count];
    for (row, mass) in rows.iter().zip(masses).filter(|(row, _)| !row.is_tied()) {
        total_masses[row.particle()] += mass;
    }

    let mut means = vec![0.0; 3 * total_masses.len()];
    let particles = rows.iter().zip(masses).zip(values.chunks_exact(3));
    for ((row, mass), value) in particles.filter(|((row, _), _)| !row.is_tied()) {
        let fraction = mass / total_masses[row.particle()];
        (0..3).for_each(|axis| means[3 * row.particle() + axis] += fraction * value[axis]);
    }

    for (row, value) in rows.iter().zip(values.chunks_exact_mut(3)) {
        row.interpolate(&means, value);
    }
}

/// Returns the masses of the independent particles from the `masses` of all particles, one for each
/// of `rows`.
pub(super) fn reduced_masses(rows: &[Row], masses: &[f64]) -> Vec<f64> {
    let count = rows.iter().map(|row| row.particle() + 1).max().unwrap_or(0);
    let mut reduced = vec![0.0; count];
    for (row, mass) in rows.iter().zip(masses) {
        row.weights().for_each(|end| reduced[end.particle] += end.weight * mass);
    }
    reduced
}

/// Returns the rows of the map for `particles` particles with the seams `pairs`. Independent
/// particles are numbered in the order of their first particle of the panels. The two particles of
/// a pair have the same independent particle.
pub(super) fn rows(particles: usize, pairs: &SeamPairs) -> Vec<Row> {
    let first = equivalence_classes(particles, &pairs.pairs).expect("pairs name particles");
    let mut ties = vec![None; particles];
    pairs.ties.iter().for_each(|tie| ties[tie.particle as usize] = Some(*tie));

    // The first particle of each class gets the next number, and the others share it.
    let mut count = 0;
    let mut independent = vec![0; particles];
    for particle in (0..particles).filter(|&particle| ties[particle].is_none()) {
        let representative = first[particle] as usize;
        if representative == particle {
            independent[particle] = count;
            count += 1;
        } else {
            independent[particle] = independent[representative];
        }
    }

    let rows = ties.iter().zip(&independent).map(|(tie, &number)| match tie {
        Some(Tie { ends, fraction, .. }) => {
            Row { ends: ends.map(|end| independent[end as usize]), fraction: *fraction }
        }
        None => Row { ends: [number; 2], fraction: 0.0 },
    });
    rows.collect()
}

/// Returns the groups of independent particles that ties in `rows` join, directly or through other
/// ties. `independent` is the number of independent particles.
pub(super) fn tied_groups(rows: &[Row], independent: usize) -> Vec<Vec<u32>> {
    let tied: Vec<[u32; 2]> = rows.iter().filter(|row| row.is_tied()).map(|row| row.ends).collect();
    let first = equivalence_classes(independent, &tied).expect("pairs name particles");
    let mut groups: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let joined: BTreeSet<u32> = tied.into_iter().flatten().collect();
    for particle in joined {
        groups.entry(first[particle as usize]).or_default().push(particle);
    }
    groups.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn particles_in_pairs_are_one_through_any_chain() {
        let independent = |particles: usize, pairs: &[[u32; 2]]| -> Vec<u32> {
            let pairs = SeamPairs { pairs: pairs.to_vec(), ties: Vec::new() };
            rows(particles, &pairs).iter().map(|row| row.ends[0]).collect()
        };
        assert_eq!(independent(6, &[[4, 1], [5, 4], [2, 2]]), [0, 1, 2, 3, 1, 1]);
        assert_eq!(independent(3, &[]), [0, 1, 2]);
    }
}
