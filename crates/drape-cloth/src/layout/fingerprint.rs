//! Fingerprint of a cloth, by which a cloth knows its states.

/// Hash of the numbers that lay out a cloth or its seams, by the method FNV-1a \[FNV11\].
///
/// Equal cloths have equal fingerprints, in every run and on every machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    /// Returns the fingerprint of no numbers.
    pub(crate) fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// Adds `numbers` in their order.
    pub(crate) fn add(&mut self, numbers: impl IntoIterator<Item = u64>) {
        for number in numbers {
            for byte in number.to_le_bytes() {
                self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
            }
        }
    }

    /// Returns the fingerprint as a number.
    pub(crate) fn number(self) -> u64 {
        self.0
    }
}
