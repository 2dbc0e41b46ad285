//! Point caches: positions of a mesh's vertices from frame to frame, in PC2 files.

use std::path::Path;

use super::mesh_file::{MESH_BYTES_MAX, read_bytes};
use crate::error::Error;

/// Size of the header before the coordinates, in bytes.
const HEADER: usize = 32;

/// Positions of a mesh's vertices from frame to frame, as stored in a PC2 file.
#[derive(Debug, Clone, PartialEq)]
pub struct PointCache {
    /// Number of frames from one sample to the next.
    pub frames_per_sample: f64,
    /// Positions of all vertices in each sample, in units of the file.
    pub samples: Vec<Vec<[f64; 3]>>,
}

impl PointCache {
    /// Reads the point cache at `path`, of at most [`MESH_BYTES_MAX`].
    ///
    /// Its content, little-endian: `POINTCACHE2` and a zero byte; the version 1; number of
    /// vertices; first frame; frames per sample; number of samples; and the coordinates as 32-bit
    /// floats, sample after sample.
    ///
    /// # Errors
    /// The file is longer, is no point cache, is cut off, or has a coordinate that is not finite.
    pub fn read(path: impl AsRef<Path>) -> Result<PointCache, Error> {
        Self::read_within(path, MESH_BYTES_MAX)
    }

    /// Reads the point cache at `path`, of at most `limit` bytes, as [`read`](Self::read) does.
    ///
    /// # Errors
    /// As for [`read`](Self::read), with `limit` in place of [`MESH_BYTES_MAX`].
    pub fn read_within(path: impl AsRef<Path>, limit: u64) -> Result<PointCache, Error> {
        let path = path.as_ref();
        Self::parse(path, &read_bytes(path, limit)?)
    }

    /// Parses the content `bytes` of a point cache, as [`read`](Self::read) does. `path` is named
    /// in errors.
    ///
    /// # Errors
    /// The errors of [`read`](Self::read), except for the length.
    ///
    /// ```
    /// use drape_collide::PointCache;
    ///
    /// // Two samples of one vertex, which rises by half a unit.
    /// let mut bytes = b"POINTCACHE2\0".to_vec();
    /// bytes.extend([1_i32, 1].map(i32::to_le_bytes).concat());
    /// bytes.extend([0.0_f32, 1.0].map(f32::to_le_bytes).concat());
    /// bytes.extend(2_i32.to_le_bytes());
    /// bytes.extend([0.0_f32, 0.0, 0.0, 0.0, 0.5, 0.0].map(f32::to_le_bytes).concat());
    /// let cache = PointCache::parse("rising.pc2", &bytes)?;
    /// assert_eq!(cache.samples, [[[0.0, 0.0, 0.0]], [[0.0, 0.5, 0.0]]]);
    /// # Ok::<(), drape_collide::Error>(())
    /// ```
    pub fn parse(path: impl AsRef<Path>, bytes: &[u8]) -> Result<PointCache, Error> {
        let path = path.as_ref();
        parse(bytes).map_err(|reason| Error::MalformedFile { path: path.to_path_buf(), reason })
    }
}

fn parse(bytes: &[u8]) -> Result<PointCache, String> {
    let (words, _) = bytes.as_chunks::<4>();
    let [_, _, _, version, points, _, frames_per_sample, samples, coordinates @ ..] = words else {
        return Err(format!("its {} bytes are no point cache, or it is cut off", bytes.len()));
    };

    // The header.
    if !bytes.starts_with(b"POINTCACHE2\0") {
        return Err("it does not begin with POINTCACHE2".to_string());
    }
    let version = i32::from_le_bytes(*version);
    if version != 1 {
        return Err(format!("it is of version {version}, and version 1 is read"));
    }
    let frames_per_sample = f64::from(f32::from_le_bytes(*frames_per_sample));
    if !(frames_per_sample > 0.0 && frames_per_sample.is_finite()) {
        return Err(format!("it has {frames_per_sample} frames per sample"));
    }
    let [points, samples] = [points, samples].map(|count| i32::from_le_bytes(*count));
    let count = usize::try_from(points).ok().filter(|count| *count > 0);
    let (Some(count), true) = (count, samples > 0) else {
        return Err(format!("it has {points} vertices and {samples} samples"));
    };
    // The product of the largest counts needs more than 64 bits.
    let needed = 12 * count as u128 * samples as u128;
    let available = (bytes.len() - HEADER) as u128;
    if needed != available {
        return Err(format!(
            "{samples} samples of {points} vertices take {needed} bytes, and it has {available}"
        ));
    }

    // The coordinates.
    let triples = coordinates.as_chunks::<3>().0.iter();
    let positions: Vec<[f64; 3]> =
        triples.map(|triple| triple.map(|value| f64::from(f32::from_le_bytes(value)))).collect();
    let first_bad = positions.iter().position(|p| !p.iter().all(|x| x.is_finite()));
    if let Some(bad) = first_bad {
        let (sample, vertex) = (bad / count, bad % count);
        return Err(format!("vertex {vertex} of sample {sample} is at {:?}", positions[bad]));
    }
    Ok(PointCache {
        frames_per_sample,
        samples: positions.chunks(count).map(<[_]>::to_vec).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(counts: [i32; 2], values: &[f32]) -> Vec<u8> {
        let mut bytes = b"POINTCACHE2\0".to_vec();
        bytes.extend(1_i32.to_le_bytes());
        bytes.extend(counts[0].to_le_bytes());
        bytes.extend(0_f32.to_le_bytes());
        bytes.extend(2_f32.to_le_bytes());
        bytes.extend(counts[1].to_le_bytes());
        bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        bytes
    }

    #[test]
    fn samples_come_in_their_order() {
        let values: Vec<f32> = (0..12).map(|k| k as f32).collect();
        let cache = parse(&file([2, 2], &values)).expect("a right file");
        assert_eq!(cache.frames_per_sample, 2.0);
        let expected = [[[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]], [[6.0, 7.0, 8.0], [9.0, 10.0, 11.0]]];
        assert_eq!(cache.samples, expected.map(|sample| sample.to_vec()));
    }

    #[test]
    fn files_that_are_none_are_refused() {
        let right = file([2, 2], &[0.5; 12]);
        for end in 0..right.len() {
            assert!(parse(&right[..end]).is_err(), "cut at {end}");
        }
        let cases = [
            (file([2, 2], &[0.5; 13]), "has 52"),
            (file([i32::MAX, i32::MAX], &[0.5; 12]), "take"),
            (file([-2, 2], &[0.5; 12]), "-2 vertices"),
            (file([2, 0], &[]), "0 samples"),
            (file([2, 1], &[0.5, 0.5, 0.5, 0.5, f32::NAN, 0.5]), "vertex 1 of sample 0"),
            (vec![b'P'; 100], "POINTCACHE2"),
        ];
        for (bytes, words) in cases {
            let reason = parse(&bytes).expect_err(words);
            assert!(reason.contains(words), "{words:?} is missing in: {reason}");
        }
    }
}
