//! Tangled starts: surfaces that cross at the start of a scene, or are too near to each other.

use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::PathBuf;

use drape_input::Diagnostics;

/// Start at which surfaces cross, or are nearer than they may ever be.
#[derive(Debug, Clone, PartialEq)]
pub struct Tangle {
    /// Mistakes of the scene.
    pub mistakes: Diagnostics,
    /// Index of the mistake about the surfaces.
    pub(crate) mistake: usize,
    /// Folder for results that the scene asks for.
    pub folder: Option<PathBuf>,
    /// Pairs of triangles, of different parts first, up to 1000.
    pub overlaps: Vec<Overlap>,
    /// Number of all such pairs.
    pub total: usize,
}

/// Two triangles that cross or are too near.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlap {
    /// Panels or bodies that they are of.
    pub parts: [String; 2],
    /// Place, in m.
    pub place: [f64; 3],
    /// Distance, in m; 0 if they cross.
    pub distance: f64,
    /// Numbers among all triangles, which tell them apart.
    pub triangles: [u32; 2],
    /// Corners, in m.
    pub corners: [[[f64; 3]; 3]; 2],
}

/// Triangle in a file.
struct Face {
    corners: [[f64; 3]; 3],
    /// Red, green and blue.
    colour: &'static str,
    /// Number of its part.
    part: usize,
}

impl Tangle {
    /// Writes each of the triangles once, as a PLY file in m. Those that cross are red, those too
    /// near are orange, and each has the number of its part in the order in which parts are named.
    ///
    /// # Errors
    /// `to` fails.
    pub fn write_ply(&self, mut to: impl Write) -> io::Result<()> {
        let mut parts: Vec<&str> = Vec::new();
        let mut seen = BTreeSet::new();
        let mut faces: Vec<Face> = Vec::new();
        for overlap in &self.overlaps {
            for k in 0..2 {
                let name = overlap.parts[k].as_str();
                let known = parts.iter().position(|part| *part == name);
                let part = known.unwrap_or(parts.len());
                if known.is_none() {
                    parts.push(name);
                }
                if seen.insert(overlap.triangles[k]) {
                    let colour = if overlap.distance == 0.0 { "220 30 30" } else { "240 150 30" };
                    faces.push(Face { corners: overlap.corners[k], colour, part });
                }
            }
        }
        writeln!(to, "ply\nformat ascii 1.0")?;
        for (number, part) in parts.iter().enumerate() {
            writeln!(to, "comment part {number}: {}", part.replace(char::is_control, " "))?;
        }
        writeln!(to, "element vertex {}", 3 * faces.len())?;
        writeln!(to, "property double x\nproperty double y\nproperty double z")?;
        writeln!(to, "element face {}", faces.len())?;
        writeln!(to, "property list uchar int vertex_indices")?;
        writeln!(to, "property uchar red\nproperty uchar green\nproperty uchar blue")?;
        writeln!(to, "property int part\nend_header")?;
        for [x, y, z] in faces.iter().flat_map(|face| &face.corners) {
            writeln!(to, "{x:?} {y:?} {z:?}")?;
        }
        for (number, Face { colour, part, .. }) in faces.iter().enumerate() {
            let first = 3 * number;
            writeln!(to, "3 {first} {} {} {colour} {part}", first + 1, first + 2)?;
        }
        Ok(())
    }

    /// Adds to the remedy of the mistake about the surfaces.
    pub fn add_help(&mut self, more: &str) {
        if let Some(mistake) = self.mistakes.0.get_mut(self.mistake) {
            let help = mistake.help.take().unwrap_or_default();
            mistake.help = Some(format!("{help}; {more}"));
        }
    }
}
