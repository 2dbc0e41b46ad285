//! CSV: a line for each frame, with what can be said of it from positions alone.

use std::io::Write;

use drape_frames::Frame;

use crate::clip::Clip;
use crate::error::Error;
use crate::vector::{area_vector, difference, length};

/// Names of the columns, with their units.
const COLUMNS: [&str; 7] = [
    "frame",
    "time (s)",
    "lowest (m)",
    "highest (m)",
    "area (m2)",
    "mean speed (m/s)",
    "largest speed (m/s)",
];

/// Writes a clip as CSV, a line for each frame: its number and time, heights of the lowest and the
/// highest vertex of the cloth, its area, mean and largest speed of its vertices since the line
/// before.
///
/// # Errors
/// Frames cannot be read, or those of the writer.
pub fn write_csv(clip: &Clip, to: impl Write) -> Result<(), Error> {
    let mut table = csv::Writer::from_writer(to);
    let failed = |error: csv::Error| Error::Write(error.into());
    table.write_record(COLUMNS).map_err(failed)?;
    let mut before: Option<(f64, Frame)> = None;
    for (index, &time) in clip.times().iter().enumerate() {
        let frame = clip.read(index)?;
        let heights = || frame.cloth.iter().map(|position| position[1]);
        let area: f64 = clip
            .recording()
            .topology()
            .cloth
            .iter()
            .map(|corners| area_vector(&frame.cloth, corners))
            .map(length)
            .sum();
        let speeds = before.map(|(earlier, before)| speeds(&before, &frame, time - earlier));
        let cell = |value: f64| if value.is_finite() { format!("{value}") } else { String::new() };
        let speed = |k: usize| speeds.map_or(String::new(), |speeds| cell(speeds[k]));
        let cells = [
            clip.frames()[index].to_string(),
            cell(time),
            cell(heights().fold(f64::INFINITY, f64::min)),
            cell(heights().fold(f64::NEG_INFINITY, f64::max)),
            cell(0.5 * area),
            speed(0),
            speed(1),
        ];
        table.write_record(cells).map_err(failed)?;
        before = Some((time, frame));
    }
    Ok(table.flush()?)
}

/// Returns the mean and the largest speed of the vertices of the cloth between two frames, in m/s.
fn speeds(before: &Frame, after: &Frame, seconds: f64) -> [f64; 2] {
    let moved = before.cloth.iter().zip(&after.cloth).map(|(a, b)| length(difference(*b, *a)));
    let (sum, largest) =
        moved.fold((0.0, 0.0_f64), |(sum, largest), moved| (sum + moved, largest.max(moved)));
    [sum / after.cloth.len() as f64 / seconds, largest / seconds]
}

#[cfg(test)]
mod tests {
    use drape_frames::Recording;

    use super::*;
    use crate::example;

    #[test]
    fn a_line_has_the_measures_of_its_frame() {
        let folder = example::folder(&[0.0, 0.3, 0.9]);
        let recording = Recording::open(folder.path()).unwrap();
        let mut text = Vec::new();
        write_csv(&Clip::new(&recording, 0..=2, None).unwrap(), &mut text).unwrap();
        let mut reader = csv::Reader::from_reader(&text[..]);
        assert_eq!(reader.headers().unwrap(), &csv::StringRecord::from(COLUMNS.to_vec()));
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        let row = |n: usize| {
            rows[n].iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect::<Vec<f64>>()
        };
        // It falls a third of a metre a second.
        let expected = [2.0, 0.9, 0.2, 0.7, 0.1 * 0.2 + 0.5 * 0.5 * 0.1, 1.0 / 3.0, 1.0 / 3.0];
        let apart = row(2).iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-12, "{:?}", row(2));
        assert_eq!([&rows[0][5], &rows[0][6]], ["", ""], "nothing is before the first");
    }
}
