use std::io::{self, Write};

/// The cloth at one moment, for writing and drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Number of the frame, from 0.
    pub number: usize,
    /// Time, in s.
    pub time: f64,
    /// Positions of the particles, three numbers each, in m.
    pub positions: Vec<f64>,
}

impl Frame {
    /// Writes the frame as Wavefront OBJ in metres, y up, with the material coordinates (in m, weft
    /// and warp) as texture coordinates.
    ///
    /// # Errors
    /// What the writer fails with.
    pub fn write_obj(
        &self,
        coordinates: &[[f64; 2]],
        triangles: &[[u32; 3]],
        mut to: impl Write,
    ) -> io::Result<()> {
        writeln!(to, "# metres, y up; t = {} s", self.time)?;
        for [x, y, z] in self.positions.as_chunks::<3>().0 {
            writeln!(to, "v {x:.7} {y:.7} {z:.7}")?;
        }
        for [u, v] in coordinates {
            writeln!(to, "vt {u:.6} {v:.6}")?;
        }
        for triangle in triangles {
            let [a, b, c] = triangle.map(|corner| corner + 1);
            writeln!(to, "f {a}/{a} {b}/{b} {c}/{c}")?;
        }
        Ok(())
    }
}
