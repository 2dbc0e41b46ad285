//! Pseudorandom numbers from the output of BLAKE3, equal on every machine.

/// Sequence of pseudorandom numbers.
pub(crate) struct Random(blake3::OutputReader);

impl Random {
    /// Creates the sequence that belongs to `purpose` and `numbers`, such as a seed.
    pub(crate) fn new(purpose: &str, numbers: &[u32]) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(purpose.as_bytes());
        for number in numbers {
            hasher.update(&number.to_le_bytes());
        }
        Self(hasher.finalize_xof())
    }

    /// Returns the next number of the uniform distribution over 0 ≤ x < 1.
    pub(crate) fn uniform(&mut self) -> f64 {
        let mut bytes = [0; 8];
        self.0.fill(&mut bytes);
        (u64::from_le_bytes(bytes) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns the next number of the normal distribution with mean 0 and deviation 1, by the
    /// method of Box and Muller.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}
