//! Hashes of the state after each step, by which two runs are compared to the last bit.
//!
//! Each hash depends on the previous one. Two runs whose hashes agree at a step therefore agree in
//! all earlier steps, and the first step in which the runs differ follows their last common hash.

use serde::{Deserialize, Serialize};

/// Largest number of hashes that are kept.
const KEPT_MAX: usize = 1024;

/// Number of bytes of a hash that are kept.
const BYTES: usize = 8;

/// Chained hashes of positions and velocities after the steps of a run, at most 1024 of them.
/// Longer runs keep the hashes after every second step, every fourth, and so on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StepHashes {
    /// Number of steps between two hashes.
    pub every: usize,
    /// First 64 bits of each hash. The first hash is the one after step `every`.
    pub hashes: Vec<String>,
    /// Full hash after the last step. Empty before the first step.
    pub last: String,
    /// Number of steps.
    pub steps: usize,
}

impl Default for StepHashes {
    fn default() -> Self {
        Self { every: 1, hashes: Vec::new(), last: String::new(), steps: 0 }
    }
}

impl StepHashes {
    /// Adds the hash of the `positions` and `velocities` after a step.
    pub(crate) fn add(&mut self, positions: &[f64], velocities: &[f64]) {
        let mut hasher = blake3::Hasher::new();
        hasher.update(self.last.as_bytes());
        for values in [positions, velocities] {
            for chunk in values.chunks(128) {
                let mut bytes = [0; 8 * 128];
                for (slot, value) in bytes.as_chunks_mut::<8>().0.iter_mut().zip(chunk) {
                    *slot = value.to_le_bytes();
                }
                hasher.update(&bytes[..8 * chunk.len()]);
            }
        }
        self.note(hasher.finalize().to_hex().to_string());
    }

    /// Adds `hash`, the hash after a step.
    fn note(&mut self, hash: String) {
        self.steps += 1;
        if self.steps.is_multiple_of(self.every) {
            if self.hashes.len() == KEPT_MAX {
                let mut number = 0;
                self.hashes.retain(|_| {
                    number += 1;
                    number % 2 == 0
                });
                self.every *= 2;
            }
            if self.steps.is_multiple_of(self.every) {
                self.hashes.push(hash[..2 * BYTES].to_owned());
            }
        }
        self.last = hash;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hashes of steps whose positions are a function of their number.
    fn run(steps: usize, position: impl Fn(usize) -> f64) -> StepHashes {
        let mut hashes = StepHashes::default();
        for step in 0..steps {
            hashes.add(&[position(step), 0.0, 0.0], &[0.0; 3]);
        }
        hashes
    }

    #[test]
    fn a_long_run_keeps_the_hashes_of_every_so_many_steps() {
        let (short, long) = (run(1024, |step| step as f64), run(5000, |step| step as f64));
        assert_eq!((short.every, short.hashes.len()), (1, 1024));
        assert_eq!((long.every, long.hashes.len(), long.steps), (8, 625, 5000));
        for (kept, hash) in long.hashes.iter().enumerate().take(128) {
            assert_eq!(*hash, short.hashes[8 * (kept + 1) - 1], "after step {}", 8 * (kept + 1));
        }
    }

    #[test]
    fn one_bit_changes_the_hashes_from_its_step_on() {
        let flipped = |step| if step == 7 { f64::from_bits(1_f64.to_bits() + 1) } else { 1.0 };
        let (one, other) = (run(20, |_| 1.0), run(20, flipped));
        assert_eq!(one.hashes[..7], other.hashes[..7]);
        assert!((7..20).all(|step| one.hashes[step] != other.hashes[step]));
        assert_ne!(one.last, other.last);
        // The sign of a zero is a bit too, and a velocity is no position.
        assert_ne!(run(1, |_| 0.0), run(1, |_| -0.0));
        let mut swapped = StepHashes::default();
        swapped.add(&[0.0; 3], &[1.0, 0.0, 0.0]);
        assert_ne!(swapped, run(1, |_| 1.0));
    }
}
