//! Untangling: particles of sewn cloth are displaced a little until nothing intersects.
//!
//! Where seams are merged, or cloth comes from a coarser grid, a corner or an edge can lie on the
//! wrong side of other cloth: at an underarm, for example, four edges meet. The particles of
//! intersections are displaced one by one, each by a point of a sequence that fills a cube evenly.
//! A displacement is kept if the number of intersections does not grow, or if distances grow. In
//! the end the displacement of each particle is reduced as far as the distances allow.

use std::collections::{BTreeMap, BTreeSet};

use drape_collide::{Error, SewnPlacement, equivalence_classes};
use drape_scene::SeamPairs;

use super::node_map::merge;

/// Number of displacements that are tried.
const TRIES: usize = 320;

/// Largest number of intersections that is untangled.
const INTERSECTIONS_MAX: usize = 100;

/// Largest coordinates of trial displacements over the spacing, used in turn.
const REACHES: [f64; 3] = [0.05, 0.15, 0.3];

/// Largest coordinate of the total displacement of a particle over the spacing.
const FARTHEST: f64 = 0.6;

/// Smallest sufficient ratio of a distance to its minimum separation. Minimum separations are
/// reduced to fit this ratio, and grow again. From much smaller ratios, steps had no solution.
const ENOUGH: f64 = 0.3;

/// Fractions of the displacement of a particle, in ascending order. The first fraction that leaves
/// enough distance replaces the whole displacement.
const FRACTIONS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Increments of the sequence of points: the first three powers of `$1/x$`, where `$x$` is the root
/// of `$x^4 = x + 1$`. \[Rob18\]
const INCREMENTS: [f64; 3] =
    [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_5];

/// Particles of sewn cloth that may be displaced.
#[derive(Debug)]
pub(crate) struct Untangling {
    pairs: SeamPairs,
    masses: Vec<f64>,
    held: Vec<bool>,
    /// Smallest distance of particles before deformation, in m.
    spacing: f64,
    /// First of the particles with which each particle is merged.
    first: Vec<u32>,
    /// Merged groups of two or more particles, keyed by their first particle.
    merged: BTreeMap<u32, Vec<u32>>,
}

impl Untangling {
    /// Returns the untangling of particles with the seams `pairs`. `held` says which particles are
    /// held, and `spacing` is the smallest distance of particles before deformation, in m.
    pub(crate) fn new(pairs: SeamPairs, masses: Vec<f64>, held: Vec<bool>, spacing: f64) -> Self {
        let first = equivalence_classes(masses.len(), &pairs.pairs).expect("pairs name particles");
        let mut merged: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for particle in pairs.pairs.iter().flatten().collect::<BTreeSet<_>>() {
            merged.entry(first[*particle as usize]).or_default().push(*particle);
        }
        Self { pairs, masses, held, spacing, first, merged }
    }

    /// Displaces particles from `positions`, in m, at which seams are merged, until `placement`
    /// finds no intersection. Returns the longest displacement, in m, or `None` if this fails.
    ///
    /// Each `start` begins at another point of the sequence of displacements.
    pub(crate) fn untangle(
        &self,
        positions: &mut Vec<f64>,
        start: usize,
        mut placement: impl FnMut(&[f64]) -> Result<SewnPlacement, Error>,
    ) -> Option<f64> {
        let from = positions.clone();
        let mut current = placement(positions).ok()?;
        let mut moved = BTreeSet::new();
        for number in 0..TRIES {
            let movable = match &current {
                SewnPlacement::Free(ratio) if *ratio >= ENOUGH => break,
                SewnPlacement::Free(_) => moved.clone(),
                SewnPlacement::Intersecting(intersections)
                    if intersections.len() > INTERSECTIONS_MAX =>
                {
                    return None;
                }
                SewnPlacement::Intersecting(intersections) => self.movable(intersections),
            };

            let particle = *movable.iter().nth(number % movable.len().max(1))?;
            let shift = self.shift(start * TRIES + number);
            let trial = self.displaced(positions, particle, shift);
            if !self.is_near(&trial, &from, particle) {
                continue;
            }
            let trial_placement = placement(&trial).ok()?;
            if is_as_good(&trial_placement, &current) {
                (*positions, current) = (trial, trial_placement);
                moved.insert(particle);
            }
        }

        // Displacements that were needed only on the way are taken back.
        let SewnPlacement::Free(ratio) = current else { return None };
        self.shorten_displacements(positions, &from, &moved, |trial| {
            matches!(placement(trial), Ok(SewnPlacement::Free(shortened)) if shortened >= ratio.min(ENOUGH))
        });
        let lengths = moved.iter().map(|&particle| {
            difference(&from, positions, particle).map(|x| x * x).iter().sum::<f64>().sqrt()
        });
        Some(lengths.fold(0.0, f64::max))
    }

    /// Moves each particle of `moved` back towards its position in `from`, one after the other, as
    /// far as `is_good` accepts the positions.
    fn shorten_displacements(
        &self,
        positions: &mut Vec<f64>,
        from: &[f64],
        moved: &BTreeSet<u32>,
        mut is_good: impl FnMut(&[f64]) -> bool,
    ) {
        for &particle in moved {
            let way_back = difference(positions, from, particle);
            let nearer = FRACTIONS.into_iter().find_map(|fraction| {
                let shift = way_back.map(|x| (1.0 - fraction) * x);
                let trial = self.displaced(positions, particle, shift);
                is_good(&trial).then_some(trial)
            });
            if let Some(nearer) = nearer {
                *positions = nearer;
            }
        }
    }

    /// Returns the first particle of each merged group that takes part in `intersections`, an edge
    /// and a triangle each, and is not held.
    fn movable(&self, intersections: &[[u32; 5]]) -> BTreeSet<u32> {
        let vertices = intersections.iter().flatten();
        let particles = vertices.filter_map(|&vertex| self.first.get(vertex as usize));
        particles.filter(|&&particle| self.is_free(particle)).copied().collect()
    }

    /// Returns whether no pin holds a particle of the merged group whose first particle is `first`.
    fn is_free(&self, first: u32) -> bool {
        let mut group = self.merged.get(&first).into_iter().flatten().chain([&first]);
        !group.any(|&particle| self.held[particle as usize])
    }

    /// Returns the displacement `number` of the sequence, in m.
    fn shift(&self, number: usize) -> [f64; 3] {
        let reach = REACHES[number % REACHES.len()] * self.spacing;
        INCREMENTS.map(|step| reach * (2.0 * ((number + 1) as f64 * step).fract() - 1.0))
    }

    /// Returns `positions` with `particle`, and all particles that are merged with it, displaced by
    /// `shift`, in m.
    fn displaced(&self, positions: &[f64], particle: u32, shift: [f64; 3]) -> Vec<f64> {
        let mut displaced = positions.to_vec();
        let alone = [particle];
        let all = self.merged.get(&particle).map_or(&alone[..], Vec::as_slice);
        for &merged in all {
            let position = &mut displaced[3 * merged as usize..][..3];
            position.iter_mut().zip(shift).for_each(|(x, shift)| *x += shift);
        }
        // Tied particles follow.
        merge(&self.pairs, &self.masses, &mut displaced);
        displaced
    }

    /// Returns whether `particle` in `positions` is near enough to its position in `from`.
    fn is_near(&self, positions: &[f64], from: &[f64], particle: u32) -> bool {
        difference(from, positions, particle)
            .into_iter()
            .all(|x| x.abs() <= FARTHEST * self.spacing)
    }
}

/// Returns the displacement of `particle` between the positions `from` and `to`, in m.
fn difference(from: &[f64], to: &[f64], particle: u32) -> [f64; 3] {
    let start = 3 * particle as usize;
    [0, 1, 2].map(|axis| to[start + axis] - from[start + axis])
}

/// Returns whether the placement `trial` may replace `current`: it has at most as many
/// intersections or, without intersections, larger distances.
fn is_as_good(trial: &SewnPlacement, current: &SewnPlacement) -> bool {
    match (trial, current) {
        (SewnPlacement::Free(trial), SewnPlacement::Free(current)) => trial > current,
        (SewnPlacement::Free(_), SewnPlacement::Intersecting(_)) => true,
        (SewnPlacement::Intersecting(_), SewnPlacement::Free(_)) => false,
        (SewnPlacement::Intersecting(trial), SewnPlacement::Intersecting(current)) => {
            trial.len() <= current.len()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACING: f64 = 0.01;

    /// Particles 0 and 2, which are merged with 1 and 3, and 4, half-way between them.
    fn untangling(held: [bool; 5]) -> Untangling {
        let tie = drape_cloth::Tie { particle: 4, ends: [0, 2], fraction: 0.5 };
        let pairs = SeamPairs { pairs: vec![[0, 1], [3, 2]], ties: vec![tie] };
        Untangling::new(pairs, vec![1.0, 3.0, 1.0, 1.0, 1.0], held.to_vec(), SPACING)
    }

    /// Positions of the particles before.
    fn start() -> Vec<f64> {
        let mut start = vec![0.0; 15];
        start[6..12].fill(0.2);
        start[12..].fill(0.1);
        start
    }

    /// Placement with a floor 0.5 mm high below particle 1, from which as much again is to be kept.
    /// It is of a body of the vertices 5 to 7.
    fn above_a_floor(positions: &[f64]) -> Result<SewnPlacement, Error> {
        let height = positions[4] - 5e-4;
        Ok(match height > 0.0 {
            true => SewnPlacement::Free(height / 5e-4),
            false => SewnPlacement::Intersecting(vec![[1, 4, 5, 6, 7]]),
        })
    }

    #[test]
    fn merged_particles_move_together_until_there_is_separation_enough() {
        let mut positions = start();
        let untangling = untangling([false; 5]);
        let way = untangling.untangle(&mut positions, 3, above_a_floor).expect("there is room");
        assert_eq!(positions[..3], positions[3..6]);
        assert_eq!(positions[6..12], start()[6..12], "others stay");
        assert!(
            (0..3).all(|axis| (positions[12 + axis] - 0.5 * (positions[axis] + 0.2)).abs() < 1e-15)
        );
        let height = positions[1];
        assert!((6.5e-4..=FARTHEST * SPACING).contains(&height), "{height} m");
        let moved = positions[..3].iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((way - moved).abs() < 1e-15);
        // It goes back as far as the separation allows: a quarter of the way less is too near.
        let less = positions.iter().zip(start()).map(|(x, from)| from + 0.6 * (x - from));
        let less: Vec<f64> = less.collect();
        let is_enough = matches!(above_a_floor(&less), Ok(SewnPlacement::Free(r)) if r >= ENOUGH);
        assert!(!is_enough, "{height} m");
    }

    #[test]
    fn particles_that_are_held_and_vertices_of_bodies_stay() {
        let mut positions = start();
        let own = untangling([true, false, false, false, false]);
        assert_eq!(own.untangle(&mut positions, 0, above_a_floor), None);
        assert_eq!(positions, start());
    }

    #[test]
    fn many_intersections_are_left_alone() {
        let mut tries = 0;
        let own = untangling([false; 5]);
        let found = own.untangle(&mut start(), 0, |_| {
            tries += 1;
            Ok(SewnPlacement::Intersecting(vec![[0, 2, 5, 6, 7]; INTERSECTIONS_MAX + 1]))
        });
        assert_eq!((found, tries), (None, 1));
    }

    #[test]
    fn no_displacement_adds_intersections_or_goes_far() {
        let mut positions = start();
        let mut fewest = usize::MAX;
        let own = untangling([false; 5]);
        let result = own.untangle(&mut positions, 0, |trial| {
            // The more of them the further it is to the right; and no place is free.
            let count = 50 + (1e4 * trial[0]) as usize;
            fewest = fewest.min(count);
            Ok(SewnPlacement::Intersecting(vec![[0, 2, 5, 6, 7]; count]))
        });
        assert_eq!(result, None);
        assert_eq!(50 + (1e4 * positions[0]) as usize, fewest, "the best is kept");
        assert!(
            positions.iter().zip(start()).all(|(x, from)| (x - from).abs() <= FARTHEST * SPACING)
        );
    }
}
