//! Files of an export: their names, and the check that no file is replaced unasked.

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
pub(super) struct OutputFiles<'a> {
    pub(super) output: &'a Path,
    pub(super) force: bool,
}

impl OutputFiles<'_> {
    /// Returns a path beside the output, whose name is the stem of the output followed by `suffix`.
    pub(super) fn beside(&self, suffix: &str) -> PathBuf {
        let mut name = self.output.file_stem().unwrap_or_default().to_owned();
        name.push(suffix);
        self.output.with_file_name(name)
    }

    /// Refuses to replace any of `paths` that exist, unless the user gave `--force`.
    pub(super) fn refuse_existing<'p>(
        &self,
        paths: impl IntoIterator<Item = &'p Path>,
    ) -> Result<(), Failure> {
        let help = "replace it with --force";
        let mut paths = paths.into_iter();
        Ok(paths.try_for_each(|path| file::refuse_existing(path, self.force, help))?)
    }

    /// Writes the output file by `content`.
    pub(super) fn write_one(
        &self,
        content: impl FnOnce(&mut Writer) -> Result<(), drape::export::Error>,
    ) -> Result<(), Failure> {
        self.refuse_existing([self.output])?;
        file::write_by(self.output, |to| content(to).map_err(Failure::from))
    }

    /// Writes `field` in the first frame of `clip` as colours on the flat pattern.
    pub(super) fn pattern_map(&self, clip: &Clip, field: Field) -> Result<(), Failure> {
        let recording = clip.recording();
        let frame = recording.frame(clip.frames()[0])?;
        let fields = FieldSource::new(recording).values(&frame)?;
        let Some((_, values)) = fields.iter().find(|(known, _)| *known == field) else {
            let known: Vec<&str> = fields.iter().map(|(known, _)| known.key()).collect();
            return Err(Failure::Usage(format!(
                "--map {}: it is not known in frame {}; what is known is {}",
                field.key(),
                frame.number,
                known.join(", ")
            )));
        };
        let map = PatternMap { recording, frame: &frame, field, values };
        self.write_one(|to| write_svg(&map, to).map_err(drape::export::Error::from))
    }

    /// Writes an OBJ file with its number for each frame of `clip`. Files of an earlier, longer
    /// sequence are removed.
    pub(super) fn sequence(&self, clip: &Clip) -> Result<(), Failure> {
        let first = clip.frames()[0];
        let mut numbered = (first..).map(|number| self.beside(&format!("-{number:05}.obj")));
        let paths: Vec<PathBuf> = numbered.by_ref().take(clip.frame_count()).collect();
        self.refuse_existing(paths.iter().map(PathBuf::as_path))?;
        for (path, number) in paths.iter().zip(clip.frames()) {
            let frame = clip.recording().frame(*number)?;
            file::write_by(path, |to| {
                write_obj(clip.recording(), &frame, to)
                    .map_err(|error| Failure::from(drape::export::Error::from(error)))
            })?;
        }
        self.remove_following(numbered)
    }

    /// Removes the files of an earlier, longer sequence, whose next names are `paths`, if the user
    /// gave `--force`.
    pub(super) fn remove_following(
        &self,
        paths: impl Iterator<Item = PathBuf>,
    ) -> Result<(), Failure> {
        if self.force { Ok(file::remove_following(paths)?) } else { Ok(()) }
    }

    /// Writes a point cache by `content`, and beside it the OBJ file that the cache moves, in the
    /// first frame of `clip`.
    pub(super) fn cache(
        &self,
        clip: &Clip,
        content: impl FnOnce(&mut Writer) -> Result<(), drape::export::Error>,
    ) -> Result<(), Failure> {
        let rest = self.output.with_extension("obj");
        self.refuse_existing([self.output, &rest])?;
        let frame = clip.recording().frame(clip.frames()[0])?;
        file::write_by(&rest, |to| {
            write_rest_obj(clip.recording(), &frame, to)
                .map_err(|error| Failure::from(drape::export::Error::from(error)))
        })?;
        file::write_by(self.output, |to| content(to).map_err(Failure::from))
    }

    /// Writes files of VTK. For a single frame the output is a `.vtp` file. For several frames the
    /// output is a list of the files in a folder beside it. Bodies have separate files, one for
    /// each state of motion.
    pub(super) fn vtk(&self, clip: &Clip, is_single: bool) -> Result<(), Failure> {
        let (recording, has_bodies) =
            (clip.recording(), !clip.recording().manifest().bodies.is_empty());
        let mut fields = FieldSource::new(recording);
        if is_single {
            let number = clip.frames()[0];
            self.refuse_existing([self.output])?;
            write_surface(self.output, &mut fields, &recording.frame(number)?, Surface::Cloth)?;
            if has_bodies {
                let bodies = self.beside("-bodies.vtp");
                self.refuse_existing([&*bodies])?;
                write_surface(&bodies, &mut fields, &recording.frame(number)?, Surface::Bodies)?;
            }
            return Ok(());
        }

        let folder = self.beside("");
        let list = self.output.with_extension("pvd");
        self.refuse_existing([&*folder, &list])?;
        let name = folder.file_name().unwrap_or_default().to_string_lossy();
        let (mut listed, mut bodies) = (Vec::new(), None);
        for (number, &time) in clip.frames().iter().zip(clip.times()) {
            let cloth = format!("cloth-{number:05}.vtp");
            let frame = recording.frame(*number)?;
            write_surface(&folder.join(&cloth), &mut fields, &frame, Surface::Cloth)?;
            listed.push(CollectionFile {
                time,
                file: format!("{name}/{cloth}"),
                surface: Surface::Cloth,
            });

            // Frames between which no body moves share the file of the bodies.
            if has_bodies {
                let source = frame.bodies_frame;
                let file = match bodies.take().filter(|(earlier, _)| *earlier == source) {
                    Some((_, file)) => file,
                    None => {
                        let file = format!("bodies-{number:05}.vtp");
                        write_surface(&folder.join(&file), &mut fields, &frame, Surface::Bodies)?;
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

/// Writes one `surface` of `frame` as a `.vtp` file; the cloth has its known `fields`.
fn write_surface(
    path: &Path,
    fields: &mut FieldSource<'_>,
    frame: &Frame,
    surface: Surface,
) -> Result<(), Failure> {
    let values = match surface {
        Surface::Cloth => fields.values(frame)?,
        Surface::Bodies => Vec::new(),
    };
    let data = PolyData { recording: fields.recording, frame, surface, fields: &values };
    file::write_by(path, |to| {
        write_vtp(&data, to).map_err(|error| Failure::from(drape::export::Error::from(error)))
    })
}

/// Fields of the frames of a recording.
struct FieldSource<'a> {
    recording: &'a Recording,
    fields: Fields<'a>,
}

impl<'a> FieldSource<'a> {
    fn new(recording: &'a Recording) -> Self {
        Self { recording, fields: Fields::new(recording) }
    }

    /// Returns the values of each field that is known in `frame`.
    fn values(&mut self, frame: &Frame) -> Result<Vec<(Field, Vec<f64>)>, Failure> {
        let earlier = frame.number.checked_sub(1);
        let earlier = earlier.map(|number| self.recording.frame(number)).transpose()?;
        let known = Field::ALL
            .into_iter()
            .filter_map(|field| Some((field, self.fields.values(field, frame, earlier.as_ref())?)));
        Ok(known.collect())
    }
}
