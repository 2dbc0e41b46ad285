//! `drape picture`: pictures of a run's frames, from any side and with any colour map.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use drape::frames::Recording;
use drape::render::{Animation, Picture};

use super::look::LookArguments;
use crate::failure::Failure;
use crate::input;
use crate::pages::run_picture::{Direction, PictureSettings, RunPictures};
use crate::say::say_written;
use drape::run::file;

/// Duration of one turn of a turntable, in s.
const TURN_SECONDS: f64 = 6.0;

/// Width and height of a turntable, in pixels.
const TURNTABLE_SIZE: [u32; 2] = [600, 800];

/// Width and height of each frame of a strip, in pixels.
const STRIP_FRAME_SIZE: [u32; 2] = [400, 400];

#[derive(Args)]
pub(crate) struct PictureArguments {
    /// Folder of a run.
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// File of the picture [default: picture-FRAME.png in the folder of the run, with the map in
    /// its name; turntable.png, strip.png].
    #[arg(short, long, value_name = "FILE.png")]
    output: Option<PathBuf>,
    /// Frame: its number, from 0, or last [default: last].
    #[arg(long, value_name = "N", conflicts_with = "time")]
    frame: Option<FrameNumber>,
    /// Time of the run, in s: the frame that is nearest to it.
    #[arg(long, value_name = "SECONDS")]
    time: Option<f64>,
    /// Animated picture of N views in a turn round the vertical.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=360))]
    turntable: Option<u32>,
    /// Film strip of N frames from the first to the last, side by side.
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u32).range(2..=24),
        conflicts_with_all = ["frame", "time", "turntable"]
    )]
    strip: Option<u32>,
    #[command(flatten)]
    look: LookArguments,
}

/// Number of a frame, parsed from digits or `last`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FrameNumber {
    Last,
    Number(usize),
}

impl FromStr for FrameNumber {
    type Err = String;

    fn from_str(text: &str) -> Result<FrameNumber, String> {
        match text {
            "last" => Ok(FrameNumber::Last),
            digits => digits
                .parse()
                .map(FrameNumber::Number)
                .map_err(|_| format!("`{text}` is no frame; give its number, from 0, or last")),
        }
    }
}

/// Executes `drape picture`.
pub(crate) fn picture(arguments: &PictureArguments) -> Result<(), Failure> {
    input::expect_run(&arguments.run)?;
    let recording = Recording::open(&arguments.run)?;
    if let Some(count) = arguments.strip {
        return strip(arguments, &recording, count);
    }
    let number = number(arguments, &recording)?;
    if let Some(count) = arguments.turntable {
        return turntable(arguments, &recording, [number, count as usize]);
    }
    let settings = arguments.look.settings(&recording, None)?;
    let picture = RunPictures::new(&recording, &settings, &[number])?.draw(number)?;
    let map = settings.map.map(|field| format!("-{}", field.key())).unwrap_or_default();
    save(arguments, &picture, &format!("picture-{number:05}{map}.png"))
}

/// Returns the number of the requested frame, by `--frame` or by the time nearest to `--time`.
fn number(arguments: &PictureArguments, recording: &Recording) -> Result<usize, Failure> {
    let last = recording.frame_count() - 1;
    let Some(requested) = arguments.time else {
        return Ok(match arguments.frame {
            Some(FrameNumber::Number(number)) => number,
            Some(FrameNumber::Last) | None => last,
        });
    };

    let mut times = Vec::new();
    for number in 0..=last {
        times.push(recording.time(number)?);
    }
    let (first, end) = (times[0], times[last]);
    if !(first..=end).contains(&requested) {
        return Err(Failure::Usage(format!(
            "--time {requested}: the run has the times from {first} to {end} s; give one of them"
        )));
    }
    let nearest = (0..=last)
        .min_by(|&a, &b| (times[a] - requested).abs().total_cmp(&(times[b] - requested).abs()));
    Ok(nearest.unwrap_or(last))
}

/// Writes an animated picture of frame `number` that turns once, in `count` views.
fn turntable(
    arguments: &PictureArguments,
    recording: &Recording,
    [number, count]: [usize; 2],
) -> Result<(), Failure> {
    let mut settings = arguments.look.settings(recording, Some(TURNTABLE_SIZE))?;
    let Direction { azimuth, elevation } = settings.views[0];
    settings.views = (0..count)
        .map(|k| Direction { azimuth: azimuth + 360.0 * k as f64 / count as f64, elevation })
        .collect();
    settings.columns = 1;

    let mut pictures = RunPictures::new(recording, &settings, &[number])?;
    let path = path(arguments, "turntable.png");
    file::write_by(&path, |to| {
        let mut animation =
            Animation::new(to, count as u32, settings.size).map_err(Failure::from_picture)?;
        let legend = pictures.legend();
        pictures.draw_each(number, |picture| {
            animation
                .add(legend.below(picture), TURN_SECONDS / count as f64)
                .map_err(Failure::from_picture)
        })?;
        animation.finish().map_err(Failure::from_picture)
    })?;
    say_written(format_args!("{count} views of frame {number} in {}", path.display()))
}

/// Writes a film strip of `count` frames at about equal distances, from the first to the last.
fn strip(arguments: &PictureArguments, recording: &Recording, count: u32) -> Result<(), Failure> {
    let count = (count as usize).min(recording.frame_count());
    let last = recording.frame_count() - 1;
    let numbers: Vec<usize> =
        (0..count).map(|k| (2 * k * last + count - 1) / (2 * (count - 1).max(1))).collect();
    let size = [count as u32 * STRIP_FRAME_SIZE[0], STRIP_FRAME_SIZE[1]];
    let mut settings: PictureSettings = arguments.look.settings(recording, Some(size))?;
    settings.size[0] = (settings.size[0] / count as u32).max(1);
    settings.check(&format!("{count} frames"))?;

    let mut pictures = RunPictures::new(recording, &settings, &numbers)?;
    let mut drawn = Vec::new();
    for number in &numbers {
        let caption = pictures.caption(*number)?;
        drawn.push(pictures.draw_views(*number)?.captioned(&caption));
    }
    let sheet = pictures.legend().below(Picture::sheet(&drawn, drawn.len()));
    save(arguments, &sheet, "strip.png")
}

/// Returns the path of the output, by default `name` in the folder of the run.
fn path(arguments: &PictureArguments, name: &str) -> PathBuf {
    arguments.output.clone().unwrap_or_else(|| arguments.run.join(name))
}

fn save(arguments: &PictureArguments, picture: &Picture, name: &str) -> Result<(), Failure> {
    let path = path(arguments, name);
    file::write(&path, picture.png().map_err(Failure::from_picture)?)?;
    say_written(format_args!("picture in {}", path.display()))
}
