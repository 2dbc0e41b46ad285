//! Bits: numbers as fractions of a range, in bytes that can be compressed well.

use std::io::Write;

use base64::Engine;
use flate2::Compression;
use flate2::write::ZlibEncoder;

/// Box around points, in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: [f64; 3],
    pub(super) high: [f64; 3],
}

impl Bounds {
    /// Box around nothing.
    pub(super) const EMPTY: Bounds =
        Bounds { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// Returns the box around this box and `points`.
    pub(super) fn with(mut self, points: &[[f64; 3]]) -> Bounds {
        for point in points {
            for (axis, x) in point.iter().enumerate() {
                self.low[axis] = self.low[axis].min(*x);
                self.high[axis] = self.high[axis].max(*x);
            }
        }
        self
    }

    /// Returns `point` as 16-bit fractions of the box.
    pub(super) fn words(&self, point: [f64; 3]) -> [u16; 3] {
        std::array::from_fn(|k| {
            let size = (self.high[k] - self.low[k]).max(f64::MIN_POSITIVE);
            (65535.0 * (point[k] - self.low[k]) / size).round() as u16
        })
    }
}

/// Returns `value` as an 8-bit fraction of a range.
pub(super) fn octet(value: f64, [low, high]: [f64; 2]) -> u8 {
    (255.0 * (value - low) / (high - low)).round() as u8
}

/// Frames of numbers, each stored as its difference from the frame before.
#[derive(Debug)]
pub(super) struct Differences<T> {
    before: Vec<T>,
}

impl<T> Differences<T> {
    /// Returns differences without a frame.
    pub(super) fn new() -> Self {
        Differences { before: Vec::new() }
    }
}

impl Differences<u16> {
    /// Adds the frame `words` to `to`: its low bytes, then its high bytes.
    pub(super) fn add(&mut self, words: Vec<u16>, to: &mut Vec<u8>) {
        self.before.resize(words.len(), 0);
        let differences: Vec<u16> =
            words.iter().zip(&self.before).map(|(now, then)| now.wrapping_sub(*then)).collect();
        to.extend(differences.iter().map(|word| *word as u8));
        to.extend(differences.iter().map(|word| (word >> 8) as u8));
        self.before = words;
    }
}

impl Differences<u8> {
    /// Adds the frame `octets` to `to`.
    pub(super) fn add(&mut self, octets: Vec<u8>, to: &mut Vec<u8>) {
        self.before.resize(octets.len(), 0);
        to.extend(octets.iter().zip(&self.before).map(|(now, then)| now.wrapping_sub(*then)));
        self.before = octets;
    }
}

/// Returns `bytes` deflated (RFC 1950), as base64.
pub(super) fn deflated(bytes: &[u8]) -> std::io::Result<String> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::new(6));
    encoder.write_all(bytes)?;
    Ok(base64::engine::general_purpose::STANDARD.encode(encoder.finish()?))
}
