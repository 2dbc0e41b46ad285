//! Numbers that look random, the same on every machine: the output of BLAKE3.

/// Sequence of random numbers.
pub(crate) struct Random(blake3::OutputReader);

impl Random {
    /// Makes the sequence of a purpose and of some numbers, such as a seed.
    pub(crate) fn new(purpose: &str, numbers: &[u32]) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(purpose.as_bytes());
        for number in numbers {
            hasher.update(&number.to_le_bytes());
        }
        Self(hasher.finalize_xof())
    }

    /// Returns a number from 0 to 1, without 1.
    pub(crate) fn uniform(&mut self) -> f64 {
        let mut bytes = [0; 8];
        self.0.fill(&mut bytes);
        (u64::from_le_bytes(bytes) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Returns a number of the normal distribution of mean 0 and deviation 1, by the method of Box
    /// and Muller.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.uniform()).cos()
    }
}
