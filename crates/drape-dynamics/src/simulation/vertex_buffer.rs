//! Surface of the cloth for a picture: positions and normals in single precision, and indices.

use super::Simulation;
use super::prescription::unsuited;
use crate::error::Error;

impl Simulation {
    /// Returns the material coordinates of the particles, along weft and warp, in m.
    #[must_use]
    pub fn coordinates(&self) -> &[[f64; 2]] {
        self.world.cloth.coordinates()
    }

    /// Returns the triangles of the surface, each as the numbers of three particles.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        self.world.cloth.triangles()
    }

    /// Writes the positions of the particles, in m, to `positions`, and the unit normals of the
    /// surface to `normals`: three numbers in single precision for each particle, in the order of
    /// the particles. Nothing is allocated.
    ///
    /// [`triangle_indices`](Self::triangle_indices) are the triangles of these vertices. The right
    /// side of the cloth is in front. Each side of a seam has its vertices and normals.
    ///
    /// # Errors
    /// [`Error::Unsuited`] if a slice does not have three numbers for each particle. Nothing is
    /// written then.
    pub fn write_vertices(&self, positions: &mut [f32], normals: &mut [f32]) -> Result<(), Error> {
        let state = &self.world.state;
        let needed = state.positions.len();
        for (name, length) in [("positions", positions.len()), ("normals", normals.len())] {
            if length != needed {
                return Err(unsuited(format!(
                    "{length} numbers for the {name} of {} particles; give a slice of {needed}",
                    needed / 3
                )));
            }
        }

        for (written, values) in [(positions, &state.positions[..]), (normals, state.normals())] {
            written.iter_mut().zip(values).for_each(|(single, double)| *single = *double as f32);
        }
        Ok(())
    }

    /// Returns the triangles of the surface as one list of vertex numbers, three for each triangle,
    /// for an index buffer.
    #[must_use]
    pub fn triangle_indices(&self) -> &[u32] {
        self.triangles().as_flattened()
    }
}
