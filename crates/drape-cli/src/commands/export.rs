//! `drape export`: writes the frames of a run in the formats of other programs.
//!
//! The formats are written by `drape::export`, and pictures by [`pictures`]. This module chooses
//! the frames and reports which frames are left out.

mod arguments;
mod files;
mod pictures;

use std::ops::RangeInclusive;

use clap::ValueEnum;
use drape::export::{
    Clip, Field, GLB_FRAMES_MAX, write_csv, write_glb, write_mdd, write_npz, write_obj, write_pc2,
    write_usda,
};
use drape::frames::Recording;

pub(crate) use self::arguments::ExportArguments;
use self::arguments::Format;
use self::files::OutputFiles;
use self::pictures::{ANIMATED, ClipPictures};
use crate::console::note;
use crate::failure::Failure;
use crate::input;
use crate::say::say_written;

/// Executes `drape export`.
pub(crate) fn export(arguments: &ExportArguments) -> Result<(), Failure> {
    let format = format(arguments)?;
    let is_pictures = matches!(format, Format::Png | Format::Apng);

    // Options of pictures do not apply to other formats.
    let mut given = arguments.look.given();
    if let Some(option) = given.find(|option| match format {
        Format::Svg => *option != "--map",
        _ => !is_pictures,
    }) {
        let formats = if option == "--map" { "png, apng or svg" } else { "png or apng" };
        return Err(Failure::Usage(format!(
            "{option} is for pictures; leave it out, or add --format {formats}"
        )));
    }

    input::expect_run(&arguments.run)?;
    let recording = Recording::open(&arguments.run)?;
    let numbers = numbers(arguments, format, recording.frame_count() - 1);
    let requested_count = numbers.clone().count();
    if format == Format::Svg && requested_count != 1 {
        let reason = "--frames: svg shows one frame; name it with --frame";
        return Err(Failure::Usage(reason.to_owned()));
    }

    let clip = Clip::new(&recording, numbers, arguments.fps)?;
    if clip.frame_count() < requested_count {
        let left_out = requested_count - clip.frame_count();
        note(format_args!("frames left out, since a later one has the same time: {left_out}"));
    }

    // Formats with a fixed frame rate need frames at equal times.
    let is_single = requested_count == 1;
    let rate = clip.rate();
    let clip = match format {
        Format::Obj | Format::Pc2 | Format::Mdd | Format::Png | Format::Apng
            if !clip.is_even() && (!is_pictures || arguments.fps.is_some()) =>
        {
            let resampled = clip.resampled();
            note(format_args!(
                "the frames do not follow each other at {rate} frames per second; those nearest in time are taken, {}",
                resampled.frame_count()
            ));
            resampled
        }
        Format::Glb if clip.frame_count() > GLB_FRAMES_MAX => {
            note(format_args!(
                "viewers of glTF hold {GLB_FRAMES_MAX} frames, so {GLB_FRAMES_MAX} of {} are taken, evenly",
                clip.frame_count()
            ));
            clip.thinned(GLB_FRAMES_MAX)
        }
        _ => clip,
    };

    let files = OutputFiles { output: &arguments.output, force: arguments.force };
    match format {
        Format::Obj if is_single => files.write_one(|to| {
            let frame = recording.frame(clip.frames()[0])?;
            Ok(write_obj(&recording, &frame, to)?)
        })?,
        Format::Obj => files.sequence(&clip)?,
        Format::Glb => files.write_one(|to| write_glb(&clip, to))?,
        Format::Usda => files.write_one(|to| write_usda(&clip, to))?,
        Format::Pc2 => files.cache(&clip, |to| write_pc2(&clip, to))?,
        Format::Mdd => files.cache(&clip, |to| write_mdd(&clip, to))?,
        Format::Vtp => files.vtk(&clip, is_single)?,
        Format::Npz => files.write_one(|to| write_npz(&clip, to))?,
        Format::Csv => files.write_one(|to| write_csv(&clip, to))?,
        Format::Png => ClipPictures::new(&clip, &arguments.look, None)?.sequence(&files)?,
        Format::Apng => {
            ClipPictures::new(&clip, &arguments.look, Some(ANIMATED))?.animation(&files)?;
        }
        Format::Svg => {
            files.pattern_map(&clip, arguments.look.map().unwrap_or(Field::StrainWarp))?
        }
    }

    let (count, output) = (clip.frame_count(), arguments.output.display());
    match count {
        1 => say_written(format_args!("frame {} in {output}", clip.frames()[0])),
        _ => say_written(format_args!("{count} frames, {rate} per second, in {output}")),
    }
}

/// Returns the format of `--format`, or the format that the ending of the output names.
fn format(arguments: &ExportArguments) -> Result<Format, Failure> {
    let ending = arguments.output.extension().unwrap_or_default().to_string_lossy();
    let format = arguments.format.or_else(|| <Format as ValueEnum>::from_str(&ending, true).ok());
    format.ok_or_else(|| {
        let output = arguments.output.display();
        if ending.is_empty() {
            let advice = "add it, such as --format glb";
            return Failure::Usage(format!("{output} does not say its format; {advice}"));
        }

        let formats = Format::value_variants().iter().filter_map(ValueEnum::to_possible_value);
        let formats: Vec<String> = formats.map(|format| format.get_name().to_owned()).collect();
        let instead = match ending.to_ascii_lowercase().as_str() {
            "abc" => "; programs that read Alembic read usda, or pc2 and mdd with an OBJ file",
            "fbx" | "dae" | "gltf" => "; programs that read it read glb too, with its movement",
            "usd" | "usdc" | "usdz" => "; usda is USD as text, and may be renamed to *.usd",
            "stl" | "ply" | "3mf" => "; obj has the mesh of one frame",
            "mp4" | "mov" | "gif" | "webm" | "avi" => {
                "; apng moves, and png writes numbered pictures"
            }
            _ => "",
        };
        Failure::Usage(format!(
            "{output}: there is no format {ending}; the formats are {}{instead}",
            formats.join(", ")
        ))
    })
}

/// Returns the requested frame numbers. `last` is the number of the run's last frame.
fn numbers(arguments: &ExportArguments, format: Format, last: usize) -> RangeInclusive<usize> {
    match (arguments.frame, arguments.frames) {
        (Some(number), _) => number..=number,
        (None, Some(range)) => range.numbers(last),
        (None, None) if matches!(format, Format::Obj | Format::Svg) => last..=last,
        (None, None) => 0..=last,
    }
}
