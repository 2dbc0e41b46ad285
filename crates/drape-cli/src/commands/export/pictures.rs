//! Export as pictures: a numbered sequence of PNG files, or one animated PNG.

use std::path::{Path, PathBuf};

use drape::export::Clip;
use drape::render::{Animation, Picture};

use super::files::OutputFiles;
use crate::commands::show::look::LookArguments;
use crate::failure::Failure;
use crate::pages::run_picture::{PictureSettings, RunPictures};
use drape::run::file;

/// Width and height of an animation of one view, in pixels.
pub(super) const ANIMATED: [u32; 2] = [800, 600];

/// Largest number of pixels of all pictures together. Drawing that number takes some ten minutes.
const PIXELS_MAX: u64 = 1_500_000_000;

/// Pictures of a clip.
pub(super) struct ClipPictures<'a> {
    clip: &'a Clip<'a>,
    settings: PictureSettings,
}

impl<'a> ClipPictures<'a> {
    /// Returns the pictures of `clip`. `size` is the default width and height, in pixels, if `look`
    /// has none.
    pub(super) fn new(
        clip: &'a Clip<'a>,
        look: &LookArguments,
        size: Option<[u32; 2]>,
    ) -> Result<ClipPictures<'a>, Failure> {
        let settings = look.settings(clip.recording(), size)?;
        let [width, height] = settings.size;
        let count = clip.frame_count();
        if count as u64 * u64::from(width) * u64::from(height) > PIXELS_MAX {
            let count_max = PIXELS_MAX / (u64::from(width) * u64::from(height));
            return Err(Failure::Usage(format!(
                "{count} pictures of {width} x {height} pixels are too many; at most {count_max}: give a smaller --size, fewer --frames or a lower --fps"
            )));
        }
        Ok(ClipPictures { clip, settings })
    }

    /// Draws one picture after the other, and passes each with its index to `take`. A frame that
    /// repeats is drawn once.
    fn each(
        &self,
        mut take: impl FnMut(usize, &Picture) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let numbers = self.clip.frames();
        let mut pictures = RunPictures::new(self.clip.recording(), &self.settings, numbers)?;
        let mut drawn: Option<(usize, Picture)> = None;
        for (index, number) in numbers.iter().enumerate() {
            let picture = match drawn.take() {
                Some((earlier, picture)) if earlier == *number => picture,
                _ => pictures.draw(*number)?,
            };
            take(index, &picture)?;
            drawn = Some((*number, picture));
        }
        Ok(())
    }

    /// Writes a file with its number for each picture. A single picture is written to the output
    /// itself.
    pub(super) fn sequence(&self, files: &OutputFiles<'_>) -> Result<(), Failure> {
        let first = self.clip.frames()[0];
        let count = self.clip.frame_count();
        let mut numbered = (first..).map(|number| files.beside(&format!("-{number:05}.png")));
        let paths: Vec<PathBuf> = if count == 1 {
            vec![files.output.to_owned()]
        } else {
            numbered.by_ref().take(count).collect()
        };

        files.refuse_existing(paths.iter().map(PathBuf::as_path))?;
        self.each(|index, picture| {
            Ok(file::write(&paths[index], picture.png().map_err(Failure::from_picture)?)?)
        })?;
        if count == 1 { Ok(()) } else { files.remove_following(numbered) }
    }

    /// Writes an animated PNG file that loops. Each picture is shown until the time of the next
    /// frame.
    pub(super) fn animation(&self, files: &OutputFiles<'_>) -> Result<(), Failure> {
        files.refuse_existing([files.output as &Path])?;
        let times = self.clip.times();
        file::write_by(files.output, |to| {
            let count = self.clip.frame_count() as u32;
            let mut animation =
                Animation::new(to, count, self.settings.size).map_err(Failure::from_picture)?;
            self.each(|index, picture| {
                let until = times.get(index + 1);
                let seconds = until.map_or(1.0 / self.clip.rate(), |next| next - times[index]);
                animation.add(picture.clone(), seconds).map_err(Failure::from_picture)
            })?;
            animation.finish().map_err(Failure::from_picture)
        })
    }
}
