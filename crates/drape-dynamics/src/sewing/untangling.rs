//! Untangling: particles of sewn cloth that intersects are displaced a little, until nothing does.
//!
//! Where seams are merged, or cloth comes from a coarser grid, a corner or an edge can lie on the wrong side
//! of other cloth: at an underarm, for example, four edges meet. One particle of an intersection after
//! the other is displaced by a point of a sequence that fills a cube evenly. A displacement is kept if it
//! lets no more edges intersect triangles, or leaves more distance. In the end each particle goes back as
//! far as that distance allows.

use std::collections::{BTreeMap, BTreeSet};

use drape_collide::{Error, SewnPlacement, equivalence_classes};
use drape_scene::SeamPairs;

use super::node_map::merge;

/// Number of displacements that are tried.
const TRIES: usize = 320;

/// Largest number of intersections that are untangled.
const INTERSECTIONS_MAX: usize = 100;

/// Largest coordinates of displacements, in turn, over the spacing.
const REACHES: [f64; 3] = [0.05, 0.15, 0.3];

/// Largest coordinate of the displacement that a particle may have in the end, over the spacing.
const FARTHEST: f64 = 0.6;

/// Smallest ratio of a distance and its minimum separation that is enough. Minimum separations are reduced
/// to fit it, and grow again; from much smaller ratios, steps had no solution.
const ENOUGH: f64 = 0.3;

/// Fractions of the displacement of a particle, in ascending order. The first that leaves enough distance
/// replaces the whole displacement.
const FRACTIONS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Fractions by which the points of the sequence follow one another: the powers of 1 over the root of
/// `$x^4 = x + 1$`. \[Rob18\]
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
    /// First of the particles that are merged with each.
    first: Vec<u32>,
    /// All that are merged with one, by the first, where there are others.
    merged: BTreeMap<u32, Vec<u32>>,
}

impl Untangling {
    /// Particles with seams, masses, those that are held, and their spacing, in m.
    pub(crate) fn new(pairs: SeamPairs, masses: Vec<f64>, held: Vec<bool>, spacing: f64) -> Self {
        let first = equivalence_classes(masses.len(), &pairs.pairs);
        let mut merged: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for particle in pairs.pairs.iter().flatten().collect::<BTreeSet<_>>() {
            merged.entry(first[*particle as usize]).or_default().push(*particle);
        }
        Self { pairs, masses, held, spacing, first, merged }
    }

    /// Displaces particles from positions in m, at which seams are merged, until nothing intersects. Returns
    /// the longest displacement, in m, or none if that does not succeed. Another start of the sequence
    /// tries other displacements.
    pub(crate) fn untangle(
        &self,
        positions: &mut Vec<f64>,
        start: usize,
        mut placement: impl FnMut(&[f64]) -> Result<SewnPlacement, Error>,
    ) -> Option<f64> {
        let from = positions.clone();
        let mut own = placement(positions).ok()?;
        let mut moved = BTreeSet::new();
        for number in 0..TRIES {
            let movable = match &own {
                SewnPlacement::Free(ratio) if *ratio >= ENOUGH => break,
                SewnPlacement::Free(_) => moved.clone(),
                SewnPlacement::Intersecting(found) if found.len() > INTERSECTIONS_MAX => {
                    return None;
                }
                SewnPlacement::Intersecting(found) => self.movable(found),
            };
            let particle = *movable.iter().nth(number % movable.len().max(1))?;
            let shift = self.shift(start * TRIES + number);
            let trial = self.displaced(positions, particle, shift);
            if !self.is_near(&trial, &from, particle) {
                continue;
            }
            let other = placement(&trial).ok()?;
            if is_as_good(&other, &own) {
                (*positions, own) = (trial, other);
                moved.insert(particle);
            }
        }
        let SewnPlacement::Free(ratio) = own else { return None };
        self.return_some(positions, &from, &moved, |trial| {
            matches!(placement(trial), Ok(SewnPlacement::Free(other)) if other >= ratio.min(ENOUGH))
        });
        let ways = moved.iter().map(|&particle| {
            difference(&from, positions, particle).map(|x| x * x).iter().sum::<f64>().sqrt()
        });
        Some(ways.fold(0.0, f64::max))
    }

    /// Takes particles back towards where they come from, one after the other, as far as a placement is good.
    fn return_some(
        &self,
        positions: &mut Vec<f64>,
        from: &[f64],
        moved: &BTreeSet<u32>,
        mut is_good: impl FnMut(&[f64]) -> bool,
    ) {
        for &particle in moved {
            let way = difference(positions, from, particle);
            let nearer = FRACTIONS.into_iter().find_map(|fraction| {
                let shift = way.map(|x| (1.0 - fraction) * x);
                let trial = self.displaced(positions, particle, shift);
                is_good(&trial).then_some(trial)
            });
            if let Some(nearer) = nearer {
                *positions = nearer;
            }
        }
    }

    /// First particles of all at intersections that are merged with none that is held.
    fn movable(&self, found: &[[u32; 5]]) -> BTreeSet<u32> {
        let first = found.iter().flatten().filter_map(|&vertex| self.first.get(vertex as usize));
        let is_free = |first: &&u32| {
            let merged = self.merged.get(first).into_iter().flatten().chain([*first]);
            !merged.into_iter().any(|&particle| self.held[particle as usize])
        };
        first.filter(is_free).copied().collect()
    }

    /// Displacement with a number, in m.
    fn shift(&self, number: usize) -> [f64; 3] {
        let reach = REACHES[number % REACHES.len()] * self.spacing;
        INCREMENTS.map(|own| reach * (2.0 * ((number + 1) as f64 * own).fract() - 1.0))
    }

    /// Positions with a particle, and all that are merged with it, displaced.
    fn displaced(&self, positions: &[f64], particle: u32, shift: [f64; 3]) -> Vec<f64> {
        let mut displaced = positions.to_vec();
        let alone = [particle];
        let all = self.merged.get(&particle).map_or(&alone[..], Vec::as_slice);
        for &own in all {
            let place = &mut displaced[3 * own as usize..][..3];
            place.iter_mut().zip(shift).for_each(|(x, shift)| *x += shift);
        }
        // Tied particles follow.
        merge(&self.pairs, &self.masses, &mut displaced);
        displaced
    }

    /// Whether a particle is near enough to where it comes from.
    fn is_near(&self, positions: &[f64], from: &[f64], particle: u32) -> bool {
        let way = difference(from, positions, particle);
        way.into_iter().all(|x| x.abs() <= FARTHEST * self.spacing)
    }
}

/// Difference of the places of a particle, in m.
fn difference(from: &[f64], to: &[f64], particle: u32) -> [f64; 3] {
    let own = 3 * particle as usize;
    [0, 1, 2].map(|axis| to[own + axis] - from[own + axis])
}

/// Whether a placement is as good as another.
fn is_as_good(one: &SewnPlacement, other: &SewnPlacement) -> bool {
    match (one, other) {
        (SewnPlacement::Free(one), SewnPlacement::Free(other)) => one > other,
        (SewnPlacement::Free(_), SewnPlacement::Intersecting(_)) => true,
        (SewnPlacement::Intersecting(_), SewnPlacement::Free(_)) => false,
        (SewnPlacement::Intersecting(one), SewnPlacement::Intersecting(other)) => {
            one.len() <= other.len()
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

    /// Placement with a floor 0.5 mm high below particle 1, from which as much again is to be kept. It
    /// is of a body of the vertices 5 to 7.
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
