//! Files of an export: their names, and whether they are there already.

use std::path::{Path, PathBuf};

use drape::export::{
    Clip, CollectionFile, Field, Fields, PatternMap, PolyData, Surface, write_obj, write_pvd,
    write_rest_obj, write_svg, write_vtp,
};
use drape::frames::{Frame, Recording};

use crate::failure::Failure;
use drape::run::file;

type Writer = std::io::BufWriter<std::fs::File>;

/// Files of an export.
pub(super) struct Files<'a> {
    pub(super) output: &'a Path,
    pub(super) force: bool,
}

impl Files<'_> {
    /// Returns a path beside the output, or in a folder of its name: its name with something added.
    pub(super) fn beside(&self, added: &str) -> PathBuf {
        let mut name = self.output.file_stem().unwrap_or_default().to_owned();
        name.push(added);
        self.output.with_file_name(name)
    }

    /// Refuses to replace files.
    pub(super) fn free<'p>(
        &self,
        paths: impl IntoIterator<Item = &'p Path>,
    ) -> Result<(), Failure> {
        let help = "replace it with --force";
        let mut paths = paths.into_iter();
        Ok(paths.try_for_each(|path| file::refuse_existing(path, self.force, help))?)
    }

    /// Writes the output itself.
    pub(super) fn one(
        &self,
        content: impl FnOnce(&mut Writer) -> Result<(), drape::export::Error>,
    ) -> Result<(), Failure> {
        self.free([self.output])?;
        file::write_by(self.output, |to| content(to).map_err(Failure::from))
    }

    /// Writes a field of the first frame of a clip on the flat pattern.
    pub(super) fn pattern_map(&self, clip: &Clip, field: Field) -> Result<(), Failure> {
        let recording = clip.recording();
        let frame = recording.frame(clip.frames()[0])?;
        let fields = values(&mut Fields::new(recording), recording, &frame)?;
        let Some((_, values)) = fields.iter().find(|(own, _)| *own == field) else {
            let known: Vec<&str> = fields.iter().map(|(own, _)| own.key()).collect();
            return Err(Failure::Usage(format!(
                "--map {}: it is not known in frame {}; what is known is {}",
                field.key(),
                frame.number,
                known.join(", ")
            )));
        };
        let map = PatternMap { recording, frame: &frame, field, values };
        self.one(|to| write_svg(&map, to).map_err(drape::export::Error::from))
    }

    /// Writes an OBJ file for each frame, with its number, and removes those of a longer sequence that
    /// was there.
    pub(super) fn sequence(&self, clip: &Clip) -> Result<(), Failure> {
        let first = clip.frames()[0];
        let path = |index: usize| self.beside(&format!("-{:05}.obj", first + index));
        let paths: Vec<PathBuf> = (0..clip.frame_count()).map(path).collect();
        self.free(paths.iter().map(PathBuf::as_path))?;
        for (path, number) in paths.iter().zip(clip.frames()) {
            let frame = clip.recording().frame(*number)?;
            let write = |to: &mut Writer| write_obj(clip.recording(), &frame, to);
            file::write_by(path, |to| {
                write(to).map_err(|error| Failure::from(drape::export::Error::from(error)))
            })?;
        }
        self.remove_following((clip.frame_count()..).map(path))
    }

    /// Removes the files of a longer sequence that was there, where files may be replaced.
    pub(super) fn remove_following(
        &self,
        paths: impl Iterator<Item = PathBuf>,
    ) -> Result<(), Failure> {
        if self.force { Ok(file::remove_following(paths)?) } else { Ok(()) }
    }

    /// Writes a point cache, and beside it the OBJ file that it moves, in its first frame.
    pub(super) fn cache(
        &self,
        clip: &Clip,
        content: impl FnOnce(&mut Writer) -> Result<(), drape::export::Error>,
    ) -> Result<(), Failure> {
        let rest = self.output.with_extension("obj");
        self.free([self.output, &rest])?;
        let frame = clip.recording().frame(clip.frames()[0])?;
        let write = |to: &mut Writer| write_rest_obj(clip.recording(), &frame, to);
        file::write_by(&rest, |to| {
            write(to).map_err(|error| Failure::from(drape::export::Error::from(error)))
        })?;
        file::write_by(self.output, |to| content(to).map_err(Failure::from))
    }

    /// Writes files of VTK: of one frame the output itself, of more a list of files in a folder beside
    /// it. Bodies have files of their own, one for each place where they are.
    pub(super) fn vtk(&self, clip: &Clip, one: bool) -> Result<(), Failure> {
        let (recording, has_bodies) =
            (clip.recording(), !clip.recording().manifest().bodies.is_empty());
        let mut fields = Fields::new(recording);
        let mut vtp = |path: &Path, number: usize, surface: Surface| {
            let frame = recording.frame(number)?;
            let fields = match surface {
                Surface::Cloth => values(&mut fields, recording, &frame)?,
                Surface::Bodies => Vec::new(),
            };
            let data = PolyData { recording, frame: &frame, surface, fields: &fields };
            let write = |to: &mut Writer| write_vtp(&data, to);
            file::write_by(path, |to| {
                write(to).map_err(|error| Failure::from(drape::export::Error::from(error)))
            })
        };
        if one {
            let bodies = self.beside("-bodies.vtp");
            self.free([self.output])?;
            vtp(self.output, clip.frames()[0], Surface::Cloth)?;
            if has_bodies {
                self.free([&*bodies])?;
                vtp(&bodies, clip.frames()[0], Surface::Bodies)?;
            }
            return Ok(());
        }
        let folder = self.beside("");
        let list = self.output.with_extension("pvd");
        self.free([&*folder, &list])?;
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        let (mut listed, mut bodies) = (Vec::new(), None);
        for (number, &time) in clip.frames().iter().zip(clip.times()) {
            let cloth = format!("cloth-{number:05}.vtp");
            vtp(&folder.join(&cloth), *number, Surface::Cloth)?;
            listed.push(CollectionFile {
                time,
                file: format!("{name}/{cloth}"),
                surface: Surface::Cloth,
            });
            if has_bodies {
                let source = recording.frame(*number)?.bodies_file;
                let file = match bodies.take().filter(|(before, _)| *before == source) {
                    Some((_, file)) => file,
                    None => {
                        let file = format!("bodies-{number:05}.vtp");
                        vtp(&folder.join(&file), *number, Surface::Bodies)?;
                        file
                    }
                };
                bodies = Some((source, file.clone()));
                let file = format!("{name}/{file}");
                listed.push(CollectionFile { time, file, surface: Surface::Bodies });
            }
        }
        file::write_by(&list, |to| write_pvd(&listed, to).map_err(Failure::from))
    }
}

/// Returns the fields of a frame that are known.
fn values(
    fields: &mut Fields,
    recording: &Recording,
    frame: &Frame,
) -> Result<Vec<(Field, Vec<f64>)>, Failure> {
    let before = frame.number.checked_sub(1).map(|number| recording.frame(number)).transpose()?;
    let mut value = |field: Field| Some((field, fields.values(field, frame, before.as_ref())?));
    Ok(Field::ALL.into_iter().filter_map(&mut value).collect())
}
