//! Hash of a frame, by which a reader notices that files have changed since a run wrote them.

/// Number of hexadecimal digits of a hash that are kept.
const DIGITS: usize = 32;

/// Hashes of the files of a frame, of which `frames.csv` keeps one hash.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct FileHashes {
    /// Hash of the positions of the cloth.
    pub(crate) cloth: Option<[u8; 32]>,
    /// Hash of the positions of the bodies, in a run with bodies.
    pub(crate) bodies: Option<[u8; 32]>,
    /// Hash of the pressures, where something touches.
    pub(crate) pressures: Option<[u8; 32]>,
}

impl FileHashes {
    /// Returns the hash of the frame: 32 hexadecimal digits.
    pub(crate) fn text(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        for hash in [self.cloth, self.bodies, self.pressures] {
            hasher.update(&hash.unwrap_or_default());
        }
        hasher.finalize().to_hex()[..DIGITS].to_owned()
    }
}

/// Returns the hash of the `content` of a file.
pub(crate) fn hash(content: &[u8]) -> [u8; 32] {
    *blake3::hash(content).as_bytes()
}
