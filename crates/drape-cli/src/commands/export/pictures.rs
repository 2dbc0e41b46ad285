//! Export as pictures: a numbered sequence of PNG files, or one that is animated.

use std::path::{Path, PathBuf};

use drape::export::Clip;
use drape::report::{Animation, Picture};

use super::files::Files;
use crate::commands::show::look::LookArguments;
use crate::failure::Failure;
use crate::pages::run_picture::{Look, RunPictures};
use drape::run::file;

/// Width and height of an animation of one view, in pixels.
pub(super) const ANIMATED: [u32; 2] = [800, 600];

/// Largest number of pixels of all pictures together, which take some ten minutes.
const PIXELS_MAX: u64 = 1_500_000_000;

/// Pictures of a clip.
pub(super) struct ClipPictures<'a> {
    clip: &'a Clip<'a>,
    look: Look,
}

impl<'a> ClipPictures<'a> {
    /// Returns the pictures of a clip; `size` is taken where the options have none.
    pub(super) fn new(
        clip: &'a Clip<'a>,
        look: &LookArguments,
        size: Option<[u32; 2]>,
    ) -> Result<ClipPictures<'a>, Failure> {
        let look = look.look(clip.recording(), size)?;
        let [width, height] = look.size;
        let count = clip.frame_count();
        if count as u64 * u64::from(width) * u64::from(height) > PIXELS_MAX {
            let most = PIXELS_MAX / (u64::from(width) * u64::from(height));
            return Err(Failure::Usage(format!(
                "{count} pictures of {width} x {height} pixels are too many; at most {most}: give a smaller --size, fewer --frames or a lower --fps"
            )));
        }
        Ok(ClipPictures { clip, look })
    }

    /// Draws one picture after the other, and hands each on with its index.
    fn each(
        &self,
        mut take: impl FnMut(usize, &Picture) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let numbers = self.clip.frames();
        let mut pictures = RunPictures::new(self.clip.recording(), &self.look, numbers)?;
        let mut drawn: Option<(usize, Picture)> = None;
        for (index, number) in numbers.iter().enumerate() {
            let picture = match drawn.take() {
                Some((before, picture)) if before == *number => picture,
                _ => pictures.draw(*number)?,
            };
            take(index, &picture)?;
            drawn = Some((*number, picture));
        }
        Ok(())
    }

    /// Writes a file for each picture, with its number; of one picture the output itself.
    pub(super) fn sequence(&self, files: &Files<'_>) -> Result<(), Failure> {
        let first = self.clip.frames()[0];
        let path = |index: usize| match self.clip.frame_count() {
            1 => files.output.to_owned(),
            _ => files.beside(&format!("-{:05}.png", first + index)),
        };
        let paths: Vec<PathBuf> = (0..self.clip.frame_count()).map(path).collect();
        files.free(paths.iter().map(PathBuf::as_path))?;
        self.each(|index, picture| {
            Ok(file::write(&paths[index], picture.png().map_err(Failure::from_picture)?)?)
        })?;
        match self.clip.frame_count() {
            1 => Ok(()),
            count => files.remove_following((count..).map(path)),
        }
    }

    /// Writes an animated PNG file that loops, with the times of the frames.
    pub(super) fn animation(&self, files: &Files<'_>) -> Result<(), Failure> {
        files.free([files.output as &Path])?;
        let times = self.clip.times();
        file::write_by(files.output, |to| {
            let count = self.clip.frame_count() as u32;
            let mut animation =
                Animation::new(to, count, self.look.size).map_err(Failure::from_picture)?;
            self.each(|index, picture| {
                let until = times.get(index + 1);
                let seconds = until.map_or(1.0 / self.clip.rate(), |next| next - times[index]);
                animation.add(picture.clone(), seconds).map_err(Failure::from_picture)
            })?;
            animation.finish().map_err(Failure::from_picture)
        })
    }
}
