//! MDD, point cache of LightWave: positions of the cloth with their times. They move an object with
//! the vertices of the cloth.

use std::io::Write;

use super::signed_count;
use crate::clip::Clip;
use crate::error::Error;

/// Writes `clip` to `to` as MDD: times in s, positions of the vertices of the cloth in m, y up, in
/// single precision.
///
/// Programs play one sample in each frame whatever its time. Frames are therefore
/// [resampled](Clip::resampled). [`write_rest_obj`](crate::write_rest_obj) writes the object that
/// the cache moves.
///
/// # Errors
/// A frame cannot be read, there are too many frames for the format, or `to` fails.
pub fn write_mdd(clip: &Clip, mut to: impl Write) -> Result<(), Error> {
    let clip = clip.resampled();
    let points = clip.recording().topology().material.len();
    to.write_all(&signed_count("MDD", "frames", clip.frame_count())?.to_be_bytes())?;
    to.write_all(&signed_count("MDD", "points", points)?.to_be_bytes())?;
    for seconds in clip.seconds() {
        to.write_all(&(seconds as f32).to_be_bytes())?;
    }
    for index in 0..clip.frame_count() {
        let frame = clip.read(index)?;
        let numbers = frame.cloth.iter().flatten();
        let bytes: Vec<u8> = numbers.flat_map(|part| (*part as f32).to_be_bytes()).collect();
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
    fn the_cache_has_every_position_and_the_times() {
        let times = [2.0, 2.04, 2.08];
        let folder = example::folder(&times);
        let recording = Recording::open(folder.path()).unwrap();
        let mut mdd = Vec::new();
        write_mdd(&Clip::new(&recording, 0..=2, None).unwrap(), &mut mdd).unwrap();
        let words: Vec<[u8; 4]> = mdd.as_chunks().0.to_vec();
        assert_eq!(4 * words.len(), mdd.len());
        assert_eq!([words[0], words[1]].map(i32::from_be_bytes), [3, 7]);
        let numbers: Vec<f32> = words[2..].iter().map(|word| f32::from_be_bytes(*word)).collect();
        let apart = |(a, b): (&f32, f32)| (a - b).abs();
        let late = numbers[..3].iter().zip([0.0, 0.04, 0.08]).map(apart).fold(0.0, f32::max);
        assert!(late < 1e-6, "{:?}", &numbers[..3]);
        let stored = times.map(example::cloth);
        assert!(
            numbers[3..].iter().copied().eq(stored
                .iter()
                .flatten()
                .flatten()
                .map(|part| *part as f32))
        );
    }
}
