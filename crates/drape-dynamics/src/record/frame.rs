//! Frame: the cloth and the bodies at one time, and its form as Wavefront OBJ.

use std::io::{self, Write};

use crate::record::topology::Topology;

/// Cloth and bodies at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Number of the frame, from 0.
    pub number: usize,
    /// Time, in s.
    pub time: f64,
    /// Positions of the particles, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Positions of the vertices of all bodies, likewise.
    pub bodies: Vec<f64>,
    /// Fraction of their distances that surfaces keep at that time, 0 to 1.
    pub grown: f64,
}

impl Frame {
    /// Writes the cloth as Wavefront OBJ in metres, y up, with the material coordinates (in m, weft
    /// and warp) as texture coordinates; `bodies` names the file of the bodies.
    ///
    /// Every number is written with as many digits as tell it from its neighbours, so the file has the very state of
    /// the simulation.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_obj(
        &self,
        topology: &Topology,
        bodies: Option<&str>,
        mut to: impl Write,
    ) -> io::Result<()> {
        writeln!(to, "# metres, y up; t = {} s", self.time)?;
        if let Some(bodies) = bodies {
            writeln!(to, "# bodies: {bodies}")?;
        }
        if self.grown < 1.0 {
            writeln!(to, "# grown: {:?}", self.grown)?;
        }
        write_vertices(&self.positions, &mut to)?;
        for [u, v] in &topology.coordinates {
            writeln!(to, "vt {u:?} {v:?}")?;
        }
        for triangle in &topology.triangles {
            let [a, b, c] = triangle.map(|corner| corner + 1);
            writeln!(to, "f {a}/{a} {b}/{b} {c}/{c}")?;
        }
        Ok(())
    }

    /// Writes the bodies as Wavefront OBJ, likewise.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_bodies_obj(&self, topology: &Topology, mut to: impl Write) -> io::Result<()> {
        writeln!(to, "# metres, y up; bodies at t = {} s", self.time)?;
        write_vertices(&self.bodies, &mut to)?;
        let mut triangles = topology.body_triangles.iter();
        for body in &topology.bodies {
            writeln!(to, "o {}", body.name.replace(char::is_control, " "))?;
            for triangle in triangles.by_ref().take(body.triangles) {
                let [a, b, c] = triangle.map(|corner| corner + 1);
                writeln!(to, "f {a} {b} {c}")?;
            }
        }
        Ok(())
    }
}

fn write_vertices(positions: &[f64], mut to: impl Write) -> io::Result<()> {
    for [x, y, z] in positions.as_chunks::<3>().0 {
        writeln!(to, "v {x:?} {y:?} {z:?}")?;
    }
    Ok(())
}
