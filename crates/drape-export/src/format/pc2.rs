//! PC2, point cache of 3ds Max: positions of the cloth. They move an object with the vertices of
//! the cloth.

use std::io::Write;

use super::signed_count;
use crate::clip::Clip;
use crate::error::Error;

/// Writes `clip` to `to` as PC2: positions of the vertices of the cloth in m, y up, in single
/// precision.
///
/// The format has one distance between samples. Frames are therefore [resampled](Clip::resampled).
/// A sample is a frame, and the file does not say how many frames a second has.
/// [`write_rest_obj`](crate::write_rest_obj) writes the object that the cache moves.
///
/// # Errors
/// A frame cannot be read, there are too many frames for the format, or `to` fails.
pub fn write_pc2(clip: &Clip, mut to: impl Write) -> Result<(), Error> {
    let clip = clip.resampled();
    let points = clip.recording().topology().material.len();
    to.write_all(b"POINTCACHE2\0")?;
    to.write_all(&1_i32.to_le_bytes())?;
    to.write_all(&signed_count("PC2", "points", points)?.to_le_bytes())?;
    let (first, frames_per_sample) = (0.0_f32, 1.0_f32);
    to.write_all(&first.to_le_bytes())?;
    to.write_all(&frames_per_sample.to_le_bytes())?;
    to.write_all(&signed_count("PC2", "frames", clip.frame_count())?.to_le_bytes())?;
    for index in 0..clip.frame_count() {
        let frame = clip.read(index)?;
        let numbers = frame.cloth.iter().flatten();
        let bytes: Vec<u8> = numbers.flat_map(|part| (*part as f32).to_le_bytes()).collect();
        to.write_all(&bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use drape_frames::Recording;

    use super::*;
    use crate::example;

    #[test]
    fn the_cache_has_every_position() {
        let folder = example::folder(&[0.0, 0.04, 0.08]);
        let recording = Recording::open(folder.path()).unwrap();
        let mut pc2 = Vec::new();
        write_pc2(&Clip::new(&recording, 1..=2, None).unwrap(), &mut pc2).unwrap();
        let word = |at: usize| <[u8; 4]>::try_from(&pc2[at..at + 4]).unwrap();
        assert_eq!(&pc2[..12], b"POINTCACHE2\0");
        assert_eq!([12, 16, 28].map(|at| i32::from_le_bytes(word(at))), [1, 7, 2]);
        assert_eq!([20, 24].map(|at| f32::from_le_bytes(word(at))), [0.0, 1.0]);
        let positions = pc2[32..].as_chunks().0.iter().map(|word| f32::from_le_bytes(*word));
        let stored = [0.04, 0.08].map(example::cloth);
        let stored = stored.iter().flatten().flatten().map(|part| *part as f32);
        assert!(positions.eq(stored));
    }
}
