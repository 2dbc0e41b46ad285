//! `drape export`: writes the frames of a run in the formats of other programs.
//!
//! The formats are those of `drape::export`; here are the files: their names, whether they are there
//! already, and what is said about them.

mod arguments;
mod pictures;

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use drape::export::{
    Clip, Field, Fields, GLB_FRAMES_MAX, Listed, PolyData, Surface, write_csv, write_glb,
    write_mdd, write_npz, write_obj, write_pc2, write_pvd, write_rest_obj, write_usda, write_vtp,
};
use drape::frames::{Frame, Recording};

pub(crate) use self::arguments::ExportArguments;
use self::arguments::Format;
use self::pictures::{ANIMATED, ClipPictures};
use crate::console::note;
use crate::failure::Failure;
use crate::file;
use crate::say::say_written;

/// Executes `drape export`.
pub(crate) fn export(arguments: &ExportArguments) -> Result<(), Failure> {
    let format = format(arguments)?;
    let is_pictures = matches!(format, Format::Png | Format::Apng);
    if let (false, Some(option)) = (is_pictures, arguments.look.given()) {
        return Err(Failure::Usage(format!(
            "{option} is for pictures; leave it out, or add --format png or apng"
        )));
    }
    let recording = Recording::open(&arguments.run)?;
    let numbers = numbers(arguments, format, recording.frames() - 1);
    let asked = numbers.clone().count();
    let clip = Clip::new(&recording, numbers, arguments.fps)?;
    if clip.count() < asked {
        let left_out = asked - clip.count();
        note(format_args!("frames left out, since a later one has the same time: {left_out}"));
    }
    let one = asked == 1;
    let rate = clip.rate();
    let clip = match format {
        Format::Obj | Format::Pc2 | Format::Mdd | Format::Png | Format::Apng
            if !clip.is_even() && (!is_pictures || arguments.fps.is_some()) =>
        {
            let resampled = clip.resampled();
            note(format_args!(
                "the frames do not follow each other at {rate} frames per second; those nearest in time are taken, {}",
                resampled.count()
            ));
            resampled
        }
        Format::Glb if clip.count() > GLB_FRAMES_MAX => {
            note(format_args!(
                "viewers of glTF hold {GLB_FRAMES_MAX} frames; so many of {} are taken, evenly",
                clip.count()
            ));
            clip.thinned(GLB_FRAMES_MAX)
        }
        _ => clip,
    };
    let files = Files { output: &arguments.output, force: arguments.force };
    match format {
        Format::Obj if one => files.one(|to| {
            let frame = recording.frame(clip.frames()[0])?;
            Ok(write_obj(&recording, &frame, to)?)
        })?,
        Format::Obj => files.sequence(&clip)?,
        Format::Glb => files.one(|to| write_glb(&clip, to))?,
        Format::Usda => files.one(|to| write_usda(&clip, to))?,
        Format::Pc2 => files.cache(&clip, |to| write_pc2(&clip, to))?,
        Format::Mdd => files.cache(&clip, |to| write_mdd(&clip, to))?,
        Format::Vtp => files.vtk(&clip, one)?,
        Format::Npz => files.one(|to| write_npz(&clip, to))?,
        Format::Csv => files.one(|to| write_csv(&clip, to))?,
        Format::Png => ClipPictures::new(&clip, &arguments.look, None)?.sequence(&files)?,
        Format::Apng => {
            ClipPictures::new(&clip, &arguments.look, Some(ANIMATED))?.animation(&files)?;
        }
    }
    let (count, output) = (clip.count(), arguments.output.display());
    match count {
        1 => say_written(format_args!("frame {} in {output}", clip.frames()[0])),
        _ => say_written(format_args!("{count} frames, {rate} per second, in {output}")),
    }
}

/// Returns the format that is asked for, or that the ending of the file says.
fn format(arguments: &ExportArguments) -> Result<Format, Failure> {
    let ending = arguments.output.extension().unwrap_or_default().to_string_lossy();
    let named = || <Format as clap::ValueEnum>::from_str(&ending, true).ok();
    arguments.format.or_else(named).ok_or_else(|| {
        let output = arguments.output.display();
        Failure::Usage(format!("{output} does not say its format; add it, such as --format glb"))
    })
}

/// Returns the numbers of the frames that are asked for.
fn numbers(arguments: &ExportArguments, format: Format, last: usize) -> RangeInclusive<usize> {
    match (arguments.frame, arguments.frames) {
        (Some(number), _) => number..=number,
        (None, Some(range)) => range.numbers(last),
        (None, None) if format == Format::Obj => last..=last,
        (None, None) => 0..=last,
    }
}

type Writer = std::io::BufWriter<std::fs::File>;

/// Files of an export.
struct Files<'a> {
    output: &'a Path,
    force: bool,
}

impl Files<'_> {
    /// Returns a path beside the output, or in a folder of its name: its name with something added.
    fn beside(&self, added: &str) -> PathBuf {
        let mut name = self.output.file_stem().unwrap_or_default().to_owned();
        name.push(added);
        self.output.with_file_name(name)
    }

    /// Refuses to replace files.
    fn free<'p>(&self, paths: impl IntoIterator<Item = &'p Path>) -> Result<(), Failure> {
        let mut paths = paths.into_iter();
        paths
            .try_for_each(|path| file::refuse_existing(path, self.force, "replace it with --force"))
    }

    /// Writes the output itself.
    fn one(
        &self,
        content: impl FnOnce(&mut Writer) -> Result<(), drape::export::Error>,
    ) -> Result<(), Failure> {
        self.free([self.output])?;
        file::write_by(self.output, content)
    }

    /// Writes an OBJ file for each frame, with its number.
    fn sequence(&self, clip: &Clip) -> Result<(), Failure> {
        let first = clip.frames()[0];
        let path = |index: usize| self.beside(&format!("-{:05}.obj", first + index));
        let paths: Vec<PathBuf> = (0..clip.count()).map(path).collect();
        self.free(paths.iter().map(PathBuf::as_path))?;
        for (path, number) in paths.iter().zip(clip.frames()) {
            let frame = clip.recording().frame(*number)?;
            let write = |to: &mut Writer| write_obj(clip.recording(), &frame, to);
            file::write_by(path, |to| write(to).map_err(drape::export::Error::from))?;
        }
        Ok(())
    }

    /// Writes a point cache, and beside it the OBJ file that it moves, in its first frame.
    fn cache(
        &self,
        clip: &Clip,
        content: impl FnOnce(&mut Writer) -> Result<(), drape::export::Error>,
    ) -> Result<(), Failure> {
        let rest = self.output.with_extension("obj");
        self.free([self.output, &rest])?;
        let frame = clip.recording().frame(clip.frames()[0])?;
        let write = |to: &mut Writer| write_rest_obj(clip.recording(), &frame, to);
        file::write_by(&rest, |to| write(to).map_err(drape::export::Error::from))?;
        file::write_by(self.output, content)
    }

    /// Writes files of VTK: of one frame the output itself, of more a list of files in a folder beside
    /// it. Bodies have files of their own, one for each place where they are.
    fn vtk(&self, clip: &Clip, one: bool) -> Result<(), Failure> {
        let (recording, has_bodies) =
            (clip.recording(), !clip.recording().manifest().bodies.is_empty());
        let mut fields = Fields::new(recording)?;
        let mut vtp = |path: &Path, number: usize, surface: Surface| {
            let frame = recording.frame(number)?;
            let fields = match surface {
                Surface::Cloth => values(&mut fields, recording, &frame)?,
                Surface::Bodies => Vec::new(),
            };
            let data = PolyData { recording, frame: &frame, surface, fields: &fields };
            let write = |to: &mut Writer| write_vtp(&data, to);
            file::write_by(path, |to| write(to).map_err(drape::export::Error::from))
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
            listed.push(Listed { time, file: format!("{name}/{cloth}"), surface: Surface::Cloth });
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
                listed.push(Listed { time, file, surface: Surface::Bodies });
            }
        }
        file::write_by(&list, |to| write_pvd(&listed, to))
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
