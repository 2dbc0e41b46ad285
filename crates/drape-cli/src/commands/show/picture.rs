//! `drape picture`: pictures of a run's frames, from any side and with any colour map.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use drape::frames::Recording;
use drape::report::{Animation, Picture};

use super::look::LookArguments;
use crate::failure::Failure;
use crate::input;
use crate::pages::run_picture::{Direction, Look, RunPictures};
use crate::say::say_written;
use drape::run::file::{self, FileKind};

/// Time in which a turntable turns once, in s.
const TURN: f64 = 6.0;

/// Width and height of a turntable, and of each frame of a strip, in pixels.
const TURNTABLE: [u32; 2] = [600, 800];
const FRAME: [u32; 2] = [400, 400];

#[derive(Args)]
pub(crate) struct PictureArguments {
    /// Folder of a run.
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// File of the picture [default: picture-FRAME.png in the folder of the run, with the map in its
    /// name; turntable.png, strip.png].
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

/// Number of a frame as it is typed.
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
    input::expect(&arguments.run, &[FileKind::Run])?;
    let recording = Recording::open(&arguments.run)?;
    if let Some(count) = arguments.strip {
        return strip(arguments, &recording, count);
    }
    let number = number(arguments, &recording)?;
    if let Some(count) = arguments.turntable {
        return turntable(arguments, &recording, [number, count as usize]);
    }
    let look = arguments.look.look(&recording, None)?;
    let picture = RunPictures::new(&recording, &look, &[number])?.draw(number)?;
    let map = look.map.map(|field| format!("-{}", field.key())).unwrap_or_default();
    save(arguments, &picture, &format!("picture-{number:05}{map}.png"))
}

/// Returns the number of the frame that is asked for.
fn number(arguments: &PictureArguments, recording: &Recording) -> Result<usize, Failure> {
    let last = recording.frame_count() - 1;
    let Some(asked) = arguments.time else {
        return Ok(match arguments.frame {
            Some(FrameNumber::Number(number)) => number,
            Some(FrameNumber::Last) | None => last,
        });
    };
    let mut times = Vec::new();
    for number in 0..=last {
        let time = recording.read_time(number)?;
        times.push(time.ok_or_else(|| {
            Failure::Usage(format!("--time {asked}: the frames have no times; give --frame"))
        })?);
    }
    let (first, end) = (times[0], times[last]);
    if !(first..=end).contains(&asked) {
        return Err(Failure::Usage(format!(
            "--time {asked}: the run has the times from {first} to {end} s; give one of them"
        )));
    }
    let away = |number: &usize| (times[*number] - asked).abs();
    let nearest = (0..=last).min_by(|a, b| away(a).total_cmp(&away(b)));
    Ok(nearest.unwrap_or(last))
}

/// Writes an animated picture of a frame that turns, of so many views.
fn turntable(
    arguments: &PictureArguments,
    recording: &Recording,
    [number, count]: [usize; 2],
) -> Result<(), Failure> {
    let mut look = arguments.look.look(recording, Some(TURNTABLE))?;
    let Direction { azimuth, elevation } = look.views[0];
    let turned = |k: usize| azimuth + 360.0 * k as f64 / count as f64;
    look.views = (0..count).map(|k| Direction { azimuth: turned(k), elevation }).collect();
    look.columns = 1;
    let mut pictures = RunPictures::new(recording, &look, &[number])?;
    let path = path(arguments, "turntable.png");
    file::write_by(&path, |to| {
        let mut animation =
            Animation::new(to, count as u32, look.size).map_err(Failure::from_picture)?;
        let legend = pictures.legend();
        pictures.draw_each(number, |picture| {
            animation.add(legend.below(picture), TURN / count as f64).map_err(Failure::from_picture)
        })?;
        animation.finish().map_err(Failure::from_picture)
    })?;
    say_written(format_args!("{count} views of frame {number} in {}", path.display()))
}

/// Writes a film strip of so many frames.
fn strip(arguments: &PictureArguments, recording: &Recording, count: u32) -> Result<(), Failure> {
    let count = (count as usize).min(recording.frame_count());
    let last = recording.frame_count() - 1;
    let frame = |k: usize| (2 * k * last + count - 1) / (2 * (count - 1).max(1));
    let numbers: Vec<usize> = (0..count).map(frame).collect();
    let size = [count as u32 * FRAME[0], FRAME[1]];
    let mut look: Look = arguments.look.look(recording, Some(size))?;
    look.size[0] = (look.size[0] / count as u32).max(1);
    look.check(&format!("{count} frames"))?;
    let mut pictures = RunPictures::new(recording, &look, &numbers)?;
    let mut drawn = Vec::new();
    for number in &numbers {
        let caption = pictures.caption(*number)?;
        drawn.push(pictures.draw_views(*number)?.captioned(&caption));
    }
    let sheet = pictures.legend().below(Picture::sheet(&drawn, drawn.len()));
    save(arguments, &sheet, "strip.png")
}

/// Returns the path of the picture, with its name in the folder of the run where none is given.
fn path(arguments: &PictureArguments, name: &str) -> PathBuf {
    arguments.output.clone().unwrap_or_else(|| arguments.run.join(name))
}

fn save(arguments: &PictureArguments, picture: &Picture, name: &str) -> Result<(), Failure> {
    let path = path(arguments, name);
    file::write(&path, picture.png().map_err(Failure::from_picture)?)?;
    say_written(format_args!("picture in {}", path.display()))
}
