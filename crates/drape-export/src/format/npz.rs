//! NPZ: arrays of NumPy with all numbers of a clip, in one file.

use std::io::{Seek, Write};

use drape_frames::{EnergyTable, Frame, SurfacePart};
use npyz::{AutoSerialize, DType, Serialize, TypeChar, TypeStr, WriterBuilder};
use zip::CompressionMethod;
use zip::write::SimpleFileOptions;

use crate::clip::Clip;
use crate::error::Error;
use crate::mesh;

/// Writes `clip` to `to` as NPZ, which `numpy.load` opens. The arrays are positions of cloth and
/// bodies with every bit, times, triangles, pattern coordinates, and the panel of each vertex with
/// the names of the panels. If the run has them, pressures of contact and the balance of the energy
/// with the names of its entries are written too.
///
/// Lengths are in m, times in s, pressures in Pa, energies in J, y is up. Bodies that do not move
/// have one frame. Pressures and energies that were not stored are not a number.
///
/// # Errors
/// Frames cannot be read, or `to` fails.
pub fn write_npz(clip: &Clip, to: impl Write + Seek) -> Result<(), Error> {
    let (manifest, topology) = (clip.recording().manifest(), clip.recording().topology());
    let mut archive = Archive { zip: zip::ZipWriter::new(to) };

    // The cloth.
    let (frames, vertices) = (clip.frame_count(), topology.material.len());
    archive.array("positions", &[frames, vertices, 3], |clip_index| {
        Ok(clip.read(clip_index)?.cloth.into_flattened())
    })?;
    archive.table("times", &[frames], clip.times().to_vec())?;
    let numbers = clip.frames().iter().map(|number| *number as u64).collect();
    archive.table("frames", &[frames], numbers)?;
    archive.table("frames_per_second", &[], vec![clip.rate()])?;
    archive.rows("triangles", &topology.cloth)?;
    archive.rows("uv", &mesh::pattern(clip.recording()))?;
    archive.rows("seam_pairs", &manifest.seam_pairs)?;
    archive.table("panel", &[vertices], owners(&manifest.panels))?;
    archive.strings("panels", manifest.panels.iter().map(|panel| &*panel.name))?;
    archive.strings("fabrics", manifest.panels.iter().map(|panel| &*panel.fabric))?;
    archive.strings("units", ["m", "s"])?;
    archive.strings("up", ["y"])?;

    // Quantities that only some runs have.
    if clip.recording().has_pressures() {
        archive.array("pressure", &[frames, vertices], |clip_index| {
            Ok(match clip.read(clip_index)?.pressures {
                Some(pressures) => pressures.into_iter().map(|pressure| pressure as f32).collect(),
                None => vec![f32::NAN; vertices],
            })
        })?;
    }
    if let Some(EnergyTable { names, rows }) = clip.recording().energy()? {
        let mut values = Vec::new();
        for number in clip.frames() {
            match &rows[*number] {
                Some(row) => values.extend(row),
                None => values.resize(values.len() + names.len(), f64::NAN),
            }
        }
        archive.table("energy", &[frames, names.len()], values)?;
        archive.strings("energies", names.iter().map(|name| &**name))?;
    }
    if !manifest.bodies.is_empty() {
        archive.bodies(clip)?;
    }
    archive.zip.finish().map_err(std::io::Error::from)?;
    Ok(())
}

/// Returns for each vertex of `parts` the number of its part.
fn owners(parts: &[SurfacePart]) -> Vec<u32> {
    (0..).zip(parts).flat_map(|(index, part)| std::iter::repeat_n(index, part.vertices)).collect()
}

/// Returns whether bodies move between frames of `clip`.
fn bodies_move(clip: &Clip) -> Result<bool, Error> {
    let first = clip.read(0)?;
    for index in 1..clip.frame_count() {
        let Frame { bodies_frame, bodies, .. } = clip.read(index)?;
        if bodies_frame != first.bodies_frame && bodies != first.bodies {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Archive of arrays.
struct Archive<W: Write + Seek> {
    zip: zip::ZipWriter<W>,
}

impl<W: Write + Seek> Archive<W> {
    /// Writes the bodies of `clip`, with one frame if they do not move.
    fn bodies(&mut self, clip: &Clip) -> Result<(), Error> {
        let (manifest, topology) = (clip.recording().manifest(), clip.recording().topology());
        let owners = owners(&manifest.bodies);
        let frames = if bodies_move(clip)? { clip.frame_count() } else { 1 };
        self.array("body_positions", &[frames, owners.len(), 3], |clip_index| {
            Ok(clip.read(clip_index)?.bodies.into_flattened())
        })?;
        self.rows("body_triangles", &topology.bodies)?;
        self.table("body", &[owners.len()], owners)?;
        self.strings("bodies", manifest.bodies.iter().map(|body| &*body.name))
    }

    /// Begins the array `name`. It is not compressed, because the digits of positions hardly
    /// shrink.
    fn begin(&mut self, name: &str) -> Result<(), Error> {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .large_file(true);
        let name = npyz::npz::file_name_from_array_name(name);
        Ok(self.zip.start_file(name, options).map_err(std::io::Error::from)?)
    }

    /// Writes an array of `shape` whose frames `read` returns by their index.
    fn array<T: AutoSerialize>(
        &mut self,
        name: &str,
        shape: &[usize],
        mut read: impl FnMut(usize) -> Result<Vec<T>, Error>,
    ) -> Result<(), Error> {
        self.begin(name)?;
        let sizes: Vec<u64> = shape.iter().map(|size| *size as u64).collect();
        let options = npyz::WriteOptions::new().default_dtype().shape(&sizes);
        let mut writer = options.writer(&mut self.zip).begin_nd()?;
        for index in 0..shape[0] {
            writer.extend(read(index)?)?;
        }
        Ok(writer.finish()?)
    }

    /// Writes an array of `shape` with `values`.
    fn table<T: AutoSerialize>(
        &mut self,
        name: &str,
        shape: &[usize],
        values: Vec<T>,
    ) -> Result<(), Error> {
        self.typed(name, T::default_dtype(), shape, values)
    }

    /// Writes an array with `rows`.
    fn rows<T: AutoSerialize + Copy, const N: usize>(
        &mut self,
        name: &str,
        rows: &[[T; N]],
    ) -> Result<(), Error> {
        self.table(name, &[rows.len(), N], rows.iter().flatten().copied().collect())
    }

    /// Writes an array of `words`.
    fn strings<'a>(
        &mut self,
        name: &str,
        words: impl IntoIterator<Item = &'a str>,
    ) -> Result<(), Error> {
        let words: Vec<String> = words.into_iter().map(str::to_owned).collect();
        let longest = words.iter().map(|word| word.chars().count()).max().unwrap_or(0).max(1);
        let text = format!("<{}{longest}", TypeChar::UnicodeStr);
        let kind: TypeStr = text.parse().expect("NumPy has strings of any length");
        self.typed(name, DType::Plain(kind), &[words.len()], words)
    }

    /// Writes an array of `shape` with `values` of the type `kind`.
    fn typed<T: Serialize>(
        &mut self,
        name: &str,
        kind: DType,
        shape: &[usize],
        values: Vec<T>,
    ) -> Result<(), Error> {
        self.begin(name)?;
        let sizes: Vec<u64> = shape.iter().map(|size| *size as u64).collect();
        let options = npyz::WriteOptions::new().dtype(kind).shape(&sizes);
        let mut writer = options.writer(&mut self.zip).begin_nd()?;
        writer.extend(values)?;
        Ok(writer.finish()?)
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Read};

    use drape_frames::Recording;
    use npyz::{Deserialize, NpyFile};

    use super::*;
    use crate::example;

    /// Reads an array with its shape.
    fn read<T: Deserialize>(npz: &[u8], name: &str) -> (Vec<u64>, Vec<T>) {
        let mut archive = zip::ZipArchive::new(Cursor::new(npz)).unwrap();
        let mut bytes = Vec::new();
        archive.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
        let file = NpyFile::new(&bytes[..]).unwrap();
        (file.shape().to_vec(), file.into_vec().unwrap())
    }

    #[test]
    fn every_array_is_as_the_run_has_it() {
        let times = [0.0, 0.04, 0.08];
        let folder = example::folder(&times);
        let recording = Recording::open(folder.path()).unwrap();
        let mut npz = Cursor::new(Vec::new());
        write_npz(&Clip::new(&recording, 1..=2, None).unwrap(), &mut npz).unwrap();
        let npz = npz.into_inner();
        let stored: Vec<f64> =
            times[1..].iter().flat_map(|time| example::cloth(*time)).flatten().collect();
        assert_eq!(read::<f64>(&npz, "positions"), (vec![2, 7, 3], stored));
        assert_eq!(read::<f64>(&npz, "times"), (vec![2], vec![0.04, 0.08]));
        assert_eq!(read::<u64>(&npz, "frames"), (vec![2], vec![1, 2]));
        assert_eq!(read::<f64>(&npz, "frames_per_second"), (vec![], vec![25.0]));
        assert_eq!(read::<u32>(&npz, "panel"), (vec![7], vec![0, 0, 0, 0, 1, 1, 1]));
        assert_eq!(read::<u32>(&npz, "triangles").1[..6], [0, 2, 1, 1, 2, 3]);
        let names = vec!["front".to_owned(), example::HOSTILE.to_owned()];
        assert_eq!(read::<String>(&npz, "panels"), (vec![2], names));
        assert_eq!(read::<String>(&npz, "units").1, ["m", "s"]);
        assert_eq!(read::<f64>(&npz, "uv").1[8..], [0.0, 0.0, 0.0, 0.5, -0.25, 0.0]);
        assert_eq!(read::<f64>(&npz, "body_positions").0, [1, 8, 3]);
        let (shape, pressures) = read::<f32>(&npz, "pressure");
        assert_eq!((shape, &pressures[..8]), (vec![2, 7], &[0., 0., 1.5, 0., 0., 0., 0., 0.][..]));
        assert_eq!(pressures[9], 2.5);
        assert_eq!(read::<f64>(&npz, "energy"), (vec![2, 2], vec![0.5, -1.5, 0.75, -2.5]));
        assert_eq!(read::<String>(&npz, "energies").1, ["kinetic", "gravity"]);
        assert_eq!(read::<String>(&npz, "bodies").1, ["box"]);
    }
}
