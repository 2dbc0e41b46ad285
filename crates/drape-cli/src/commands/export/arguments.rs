//! Arguments of `drape export`.

use std::num::ParseIntError;
use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, ValueEnum};

use crate::commands::show::look::LookArguments;

#[derive(Args)]
pub(crate) struct ExportArguments {
    /// Folder of a run.
    #[arg(value_name = "RUN")]
    pub(crate) run: PathBuf,
    /// Format [default: by the ending of FILE].
    #[arg(long, value_enum, value_name = "F")]
    pub(crate) format: Option<Format>,
    /// File to write. What a format has in several files is beside it: the OBJ file that PC2 and
    /// MDD move, the numbered files of a sequence.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// One frame, by its number, from 0.
    #[arg(long, value_name = "N", conflicts_with = "frames")]
    pub(crate) frame: Option<usize>,
    /// Frames from number A to number B, which is one of them; without A from the first, without B
    /// to the last [default: all; of OBJ and SVG the last frame].
    #[arg(long, value_name = "A..B")]
    pub(crate) frames: Option<FrameRange>,
    /// Frames per second [default: the rate of the run].
    #[arg(long, value_name = "F")]
    pub(crate) fps: Option<f64>,
    /// Replaces files that exist; of a sequence, those after its end are removed.
    #[arg(long)]
    pub(crate) force: bool,
    #[command(flatten)]
    pub(crate) look: LookArguments,
}

/// Format of another program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Wavefront OBJ: one frame, or a numbered sequence.
    Obj,
    /// Binary glTF: the last frame, animated by up to 120 frames.
    Glb,
    /// USD as text: positions at the times of the frames.
    Usda,
    /// Point cache of 3ds Max, Blender and Marvelous Designer, with the OBJ file that it moves.
    Pc2,
    /// Point cache of LightWave, Blender and Marvelous Designer, with the OBJ file that it moves.
    Mdd,
    /// PolyData of VTK, for ParaView and PyVista: a file for each frame, and a list of them (PVD).
    #[value(alias = "pvd")]
    Vtp,
    /// Arrays of NumPy in one file.
    Npz,
    /// Table with a line for each frame: heights, area, speeds, pressure, energy.
    Csv,
    /// Panels of one frame, flat on the pattern, with a field in colours.
    Svg,
    /// Pictures: one frame, or a numbered sequence.
    Png,
    /// Animated PNG, which loops with the times of the frames.
    Apng,
}

/// Range of frame numbers, parsed from `A..B`, `A..` or `..B`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FrameRange {
    first: Option<usize>,
    last: Option<usize>,
}

impl FrameRange {
    /// Returns the frame numbers. `last` is the number of the run's last frame.
    pub(crate) fn numbers(self, last: usize) -> RangeInclusive<usize> {
        self.first.unwrap_or(0)..=self.last.unwrap_or(last)
    }
}

impl FromStr for FrameRange {
    type Err = String;

    fn from_str(text: &str) -> Result<FrameRange, String> {
        let range = text
            .split_once("..")
            .and_then(|(first, last)| Some((range_end(first).ok()?, range_end(last).ok()?)))
            .map(|(first, last)| FrameRange { first, last });
        range.ok_or_else(|| {
            format!("`{text}` is no range of frames; give two numbers, such as 10..20")
        })
    }
}

/// Parses one end of a range. An empty `text` leaves the end open.
fn range_end(text: &str) -> Result<Option<usize>, ParseIntError> {
    match text.trim() {
        "" => Ok(None),
        digits => digits.parse().map(Some),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_has_both_ends() {
        let numbers = |text: &str| text.parse().map(|range: FrameRange| range.numbers(60));
        assert_eq!(numbers("10..20"), Ok(10..=20));
        assert_eq!(numbers("10.."), Ok(10..=60));
        assert_eq!(numbers("..20"), Ok(0..=20));
        for wrong in ["10", "a..b", "1...3", "-1..3", ""] {
            assert!(numbers(wrong).is_err_and(|error| error.contains("10..20")), "{wrong}");
        }
    }
}
