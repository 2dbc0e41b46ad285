//! CSV: a line for each frame, with its measurements.

use std::io::Write;

use drape_frames::vector::{area_vector, difference, length};
use drape_frames::{EnergyTable, Frame, Recording};

use crate::clip::Clip;
use crate::error::Error;

/// Names of the columns of every run, with their units.
const COLUMNS: [&str; 7] = [
    "frame",
    "time (s)",
    "lowest (m)",
    "highest (m)",
    "area (m2)",
    "mean speed (m/s)",
    "largest speed (m/s)",
];

/// Names of the further columns of a run that has pressures.
const PRESSURE_COLUMNS: [&str; 2] = ["largest pressure (Pa)", "vertices under pressure"];

/// Writes `clip` to `to` as CSV, a line for each frame: its number and time, the heights of the
/// lowest and the highest vertex of the cloth, its area, and the mean and the largest speed of its
/// vertices since the line before. If the run has them, the largest pressure, the number of
/// vertices under pressure and the entries of the balance of the energy follow. Unknown values are
/// empty.
///
/// # Errors
/// Frames cannot be read, or `to` fails.
pub fn write_csv(clip: &Clip, to: impl Write) -> Result<(), Error> {
    let recording = clip.recording();
    let mut table = csv::Writer::from_writer(to);
    let has_pressures = recording.has_pressures();
    let energy = recording.energy()?;
    let mut names: Vec<String> = COLUMNS.map(str::to_owned).to_vec();
    if has_pressures {
        names.extend(PRESSURE_COLUMNS.map(str::to_owned));
    }
    if let Some(EnergyTable { names: entries, .. }) = &energy {
        names.extend(entries.iter().map(|entry| format!("{} (J)", entry.replace('_', " "))));
    }
    table.write_record(names).map_err(failed)?;

    let mut before: Option<(f64, Frame)> = None;
    for (index, &time) in clip.times().iter().enumerate() {
        let frame = clip.read(index)?;
        let speeds = before.map(|(earlier, before)| speeds(&before, &frame, time - earlier));
        let mut values = vec![time];
        values.extend(extent(recording, &frame));
        values.extend(speeds.unwrap_or([f64::NAN; 2]));
        if has_pressures {
            values.extend(under_pressure(&frame));
        }
        if let Some(EnergyTable { names, rows }) = &energy {
            match &rows[frame.number] {
                Some(row) => values.extend(row),
                None => values.resize(values.len() + names.len(), f64::NAN),
            }
        }
        let mut cells = vec![frame.number.to_string()];
        cells.extend(values.into_iter().map(cell));
        table.write_record(cells).map_err(failed)?;
        before = Some((time, frame));
    }
    Ok(table.flush()?)
}

/// Returns the error of the writer of a table.
fn failed(error: csv::Error) -> Error {
    Error::Write(error.into())
}

/// Returns `value` as the content of a cell, which is empty if it is not known.
fn cell(value: f64) -> String {
    if value.is_finite() { value.to_string() } else { String::new() }
}

/// Returns the heights of the lowest and the highest vertex of the cloth in `frame`, in m, and its
/// area, in m².
fn extent(recording: &Recording, frame: &Frame) -> [f64; 3] {
    let heights = frame.cloth.iter().map(|position| position[1]);
    let triangles = recording.topology().cloth.iter();
    let at = |corner: u32| frame.cloth[corner as usize];
    let twice: f64 = triangles.map(|corners| length(area_vector(corners.map(at)))).sum();
    let (low, high) = (f64::INFINITY, f64::NEG_INFINITY);
    [heights.clone().fold(low, f64::min), heights.fold(high, f64::max), 0.5 * twice]
}

/// Returns the largest pressure in `frame`, in Pa, and the number of vertices under pressure.
fn under_pressure(frame: &Frame) -> [f64; 2] {
    let Some(pressures) = &frame.pressures else { return [f64::NAN; 2] };
    let touched = pressures.iter().filter(|pressure| **pressure > 0.0).count();
    [pressures.iter().copied().fold(0.0, f64::max), touched as f64]
}

/// Returns the mean and the largest speed of the vertices of the cloth from `before` to `after`, in
/// m/s. `seconds` is the time between them.
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
        let energies = ["kinetic (J)", "gravity (J)"];
        let names = [&COLUMNS[..], &PRESSURE_COLUMNS, &energies].concat();
        assert_eq!(reader.headers().unwrap(), &csv::StringRecord::from(names));
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        let row = |n: usize| {
            rows[n].iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect::<Vec<f64>>()
        };
        // It falls a third of a metre a second.
        let expected = [2.0, 0.9, 0.2, 0.7, 0.1 * 0.2 + 0.5 * 0.5 * 0.1, 1.0 / 3.0, 1.0 / 3.0];
        let apart = row(2).iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-12, "{:?}", row(2));
        assert_eq!([&rows[0][5], &rows[0][6]], ["", ""], "nothing is before the first");
        assert_eq!(row(0)[7..], [0.0, 0.0, 0.25, -0.5]);
        assert_eq!(row(2)[7..], [2.5, 1.0, 0.75, -2.5]);
    }
}
