//! Partition: division of the particles into parts, which are eliminated side by side, and
//! separators between the parts.

use super::levels::Levels;
use crate::linear::sparsity::Sparsity;

/// Largest number of particles of a part, as long as there are fewer than [`MAX_PARTS`] parts.
const MAX_PARTICLES: usize = 16_000;

/// Largest number of parts.
const MAX_PARTS: usize = 16;

/// Parts and separators of a sparsity.
///
/// A part consists of consecutive levels in the order of the particles' numbers. All parts have
/// about equally many particles. A separator holds the particles of a part that are coupled to
/// later parts. Without the separators no two parts are coupled: this is a dissection \[Geo73\]
/// along one direction. Cuts along levels leave the diagonals of the runs whole. With cuts across a
/// sheet, a curtain and a swing of 40 000 particles took 1.6 and 1.4 times as long in eight parts
/// as in one, with equally many iterations.
///
/// Parts suit stabilised factors with a coarse level: in 2, 4 and 8 parts, curtain and swing took 0
/// to 10 % more iterations. Compensated factors of 10 000 particles took a quarter more iterations
/// in two parts, and twice as many in four.
#[derive(Debug)]
pub(crate) struct Partition {
    /// Parts, with a separator after each part except the last. Each group lists its particles in
    /// the order of elimination. All parts are eliminated before the first separator.
    pub groups: Vec<Vec<u32>>,
}

impl Partition {
    /// Returns the partition of a large matrix, a function of `sparsity` and never of the threads.
    pub(crate) fn new(sparsity: &Sparsity) -> Self {
        let parts = sparsity.particle_count().div_ceil(MAX_PARTICLES).next_power_of_two();
        Self::into_parts(sparsity, parts.clamp(2, MAX_PARTS))
    }

    /// Returns the partition of `sparsity` into `count` parts.
    pub(crate) fn into_parts(sparsity: &Sparsity, count: usize) -> Self {
        let part_of = parts(sparsity, count);
        let mut separates = vec![false; part_of.len()];
        for particle in 0..part_of.len() {
            for &other in sparsity.later(particle) {
                let other = other as usize;
                if part_of[particle] != part_of[other] {
                    let is_first = part_of[particle] < part_of[other];
                    separates[if is_first { particle } else { other }] = true;
                }
            }
        }

        let mut groups = vec![Vec::new(); 2 * count - 1];
        for (particle, &part) in part_of.iter().enumerate() {
            groups[2 * part + usize::from(separates[particle])].push(particle as u32);
        }

        // Elimination backwards ends at a separator instead of beginning there, which gives a
        // better factor.
        for part in 1..count {
            if part % 2 == 1 || part + 1 == count {
                groups[2 * part].reverse();
            }
        }
        Self { groups }
    }
}

/// Returns the number of the part of each particle, for `count` parts. A part is a range of levels.
/// All parts have about equally many particles.
fn parts(sparsity: &Sparsity, count: usize) -> Vec<usize> {
    let particles = sparsity.particle_count();
    let all: Vec<u32> = (0..particles as u32).collect();
    let mut part_of = vec![0; particles];
    let mut earlier_particles = 0;
    for level in Levels::new(sparsity).levels_of(&all) {
        let part = earlier_particles * count / particles;
        level.iter().for_each(|&particle| part_of[particle as usize] = part);
        earlier_particles += level.len();
    }
    part_of
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::level_schedule::row_order::ABSENT;
    use crate::linear::level_schedule::sample::{layout, rimmed, weave};

    #[test]
    fn parts_are_uncoupled_and_about_equal_and_separators_small() {
        for (sparsity, count) in [(weave(60), 2), (weave(60), 4), (rimmed(60), 3)] {
            let Partition { groups } = Partition::into_parts(&sparsity, count);
            let particles = sparsity.particle_count();
            let mut group_of = vec![usize::MAX; particles];
            for (group, own) in groups.iter().enumerate() {
                for &particle in own {
                    assert_eq!(group_of[particle as usize], usize::MAX, "{particle} twice");
                    group_of[particle as usize] = group;
                }
            }
            for particle in 0..particles {
                for &other in sparsity.later(particle) {
                    let [a, b] = [particle, other as usize].map(|one| group_of[one]);
                    assert!(a == b || a % 2 == 1 || b % 2 == 1, "{a} and {b} are coupled");
                }
            }
            for part in groups.iter().step_by(2) {
                let share = part.len() as f64 * count as f64 / particles as f64;
                assert!((0.75..1.1).contains(&share), "{} of {particles}", part.len());
            }
            let separators: usize = groups.iter().skip(1).step_by(2).map(Vec::len).sum();
            assert!(separators < 150 * (count - 1), "{separators} between {count} parts");
        }
    }

    #[test]
    fn parts_and_separators_may_be_empty() {
        let uncoupled = Sparsity::from_pairs(20, []).unwrap();
        let star = Sparsity::from_pairs(20, (1..20).map(|other| [0, other])).unwrap();
        for sparsity in [uncoupled, star, Sparsity::from_pairs(0, []).unwrap()] {
            let particles = sparsity.particle_count();
            let Partition { groups } = Partition::into_parts(&sparsity, 4);
            assert_eq!(groups.iter().map(Vec::len).sum::<usize>(), particles);
            let layout = layout(&sparsity, 4);
            assert_eq!(
                layout.main_slots.iter().flatten().filter(|&&s| s != ABSENT).count(),
                particles
            );
        }
    }

    #[test]
    fn one_part_is_the_particles_own_order() {
        let Partition { groups } = Partition::into_parts(&weave(20), 1);
        assert_eq!(groups, [(0..400).collect::<Vec<u32>>()]);
    }
}
