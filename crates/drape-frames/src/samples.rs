//! Sample runs, for examples and tests of programs that read frames.

use std::fs::File;
use std::io;
use std::path::Path;

use crate::write::npy;

/// Run that is written to a folder in the format of frames.
///
/// ```
/// use drape_frames::{Recording, samples::SampleRun};
///
/// let flag = SampleRun::triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
/// let folder = tempfile::tempdir()?;
/// flag.write(folder.path())?;
/// let recording = Recording::open(folder.path())?;
/// assert_eq!(recording.frame(0)?.cloth, flag.frames[0].cloth);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SampleRun {
    /// Text of `surfaces.json`: a JSON object with the panels and bodies.
    pub manifest: String,
    /// Weft and warp coordinates of the vertices of the cloth at rest, in m.
    pub material: Vec<[f64; 2]>,
    /// Triangles of the cloth: numbers of vertices, from 0.
    pub triangles: Vec<[u32; 3]>,
    /// Triangles of the bodies: numbers of vertices of the bodies, from 0.
    pub body_triangles: Vec<[u32; 3]>,
    /// Frames, at least one.
    pub frames: Vec<SampleFrame>,
}

/// Positions of cloth and bodies at one time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SampleFrame {
    /// Time, in s.
    pub time: f64,
    /// Positions of the vertices of the cloth, in m.
    pub cloth: Vec<[f64; 3]>,
    /// Positions of the vertices of the bodies, in m.
    pub bodies: Vec<[f64; 3]>,
}

impl SampleRun {
    /// Returns the run of a panel `name` with `material` coordinates, in m, and `triangles`,
    /// without frames. The name has no quotes and no backslashes.
    #[must_use]
    pub fn panel(name: &str, material: Vec<[f64; 2]>, triangles: Vec<[u32; 3]>) -> Self {
        let manifest = format!(
            "{{ \"format\": 2, \"guarded\": true, \"panels\": [ {{ \"name\": \"{name}\", \
             \"vertices\": {}, \"triangles\": {} }} ], \"bodies\": [] }}",
            material.len(),
            triangles.len()
        );
        Self { manifest, material, triangles, body_triangles: Vec::new(), frames: Vec::new() }
    }

    /// Returns the run of a panel of one triangle, 1 m wide and high, with the positions `cloth`,
    /// in m, at the time 0.
    #[must_use]
    pub fn triangle(cloth: [[f64; 3]; 3]) -> Self {
        let material = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let mut run = Self::panel("flag", material, vec![[0, 1, 2]]);
        run.frames = vec![SampleFrame { cloth: cloth.to_vec(), ..SampleFrame::default() }];
        run
    }

    /// Returns the run of a panel `"sheet"` of `columns` by `rows` vertices, `spacing` apart, in m.
    /// The function `shape` gives the position, in m, of the vertex with given material coordinates
    /// at a given time, for a frame at each of `times`, in s.
    #[must_use]
    pub fn grid(
        [columns, rows]: [u32; 2],
        spacing: f64,
        times: &[f64],
        shape: impl Fn([f64; 2], f64) -> [f64; 3],
    ) -> Self {
        let points = (0..columns * rows).map(|vertex| [vertex % columns, vertex / columns]);
        let material: Vec<[f64; 2]> =
            points.clone().map(|point| point.map(|count| spacing * f64::from(count))).collect();

        // Two triangles for each cell, which begins at its vertex of the smallest number.
        let cells = points.filter(|[column, row]| column + 1 < columns && row + 1 < rows);
        let triangles = cells.flat_map(|[column, row]| {
            let first = row * columns + column;
            let [right, above, across] = [first + 1, first + columns, first + columns + 1];
            [[first, right, across], [first, across, above]]
        });

        let mut run = Self::panel("sheet", material, triangles.collect());
        for &time in times {
            let cloth = run.material.iter().map(|&point| shape(point, time)).collect();
            run.frames.push(SampleFrame { time, cloth, bodies: Vec::new() });
        }
        run
    }

    /// Writes the run to `folder`, which exists.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, folder: &Path) -> io::Result<()> {
        std::fs::write(folder.join("surfaces.json"), format!("{}\n", self.manifest))?;
        npy::write(&mut File::create(folder.join("material.npy"))?, &self.material)?;
        npy::write(&mut File::create(folder.join("triangles.npy"))?, &self.triangles)?;
        let has_bodies = !self.body_triangles.is_empty();
        if has_bodies {
            npy::write(
                &mut File::create(folder.join("body-triangles.npy"))?,
                &self.body_triangles,
            )?;
        }

        let mut list = "number,time,growth,bodies\n".to_owned();
        for (number, SampleFrame { time, cloth, bodies }) in self.frames.iter().enumerate() {
            npy::write(&mut File::create(folder.join(format!("frame-{number:05}.npy")))?, cloth)?;
            if has_bodies {
                npy::write(
                    &mut File::create(folder.join(format!("bodies-{number:05}.npy")))?,
                    bodies,
                )?;
            }
            let bodies_number = if has_bodies { number.to_string() } else { String::new() };
            list += &format!("{number},{time:?},1.0,{bodies_number}\n");
        }
        std::fs::write(folder.join("frames.csv"), list)
    }
}
