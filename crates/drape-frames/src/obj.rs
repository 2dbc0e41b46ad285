//! Wavefront OBJ: the files of a run of format 1.

use std::path::Path;

use crate::array::COORDINATE_MAX;
use crate::error::Error;
use crate::text::read_text;

/// File of vertices and triangles as a run wrote it: `v`, `vt`, `f`, `o` and comments only.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Obj {
    /// Position of each vertex, in m.
    pub(crate) vertices: Vec<[f64; 3]>,
    /// Material coordinates of each vertex, in m.
    pub(crate) material: Vec<[f64; 2]>,
    /// Vertex numbers of each triangle, from 0; not yet checked against the vertices.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Time from the comment `t = … s`, in s.
    pub(crate) time: Option<f64>,
    /// Name of the file of the bodies, from the comment `bodies: NAME`.
    pub(crate) bodies: Option<String>,
    /// Growth fraction of the minimum separation, from the comment `grown: FRACTION`.
    pub(crate) growth: Option<f64>,
}

impl Obj {
    pub(crate) fn read(path: &Path) -> Result<Obj, Error> {
        Obj::parse(path, &read_text(path)?)
    }

    fn parse(path: &Path, text: &str) -> Result<Obj, Error> {
        let mut all = Obj::default();
        for (index, line) in text.lines().enumerate() {
            all.line(line).map_err(|reason| Error::Malformed {
                path: path.to_owned(),
                line: index + 1,
                reason,
            })?;
        }
        Ok(all)
    }

    fn line(&mut self, line: &str) -> Result<(), String> {
        let (kind, rest) = line.split_once(' ').unwrap_or((line, ""));
        match kind {
            "v" => self.vertices.push(numbers(rest)?),
            "vt" => self.material.push(numbers(rest)?),
            "f" => self.triangles.push(corners(rest)?),
            "o" | "" => {}
            "#" => self.comment(rest)?,
            _ => return Err(format!("\"{kind}\" is not a line of a frame")),
        }
        Ok(())
    }

    fn comment(&mut self, text: &str) -> Result<(), String> {
        if let Some(name) = text.strip_prefix("bodies: ") {
            self.bodies = Some(name.trim().to_owned());
        }
        if let Some(growth) = text.strip_prefix("grown: ") {
            let valid = |growth: &f64| *growth > 0.0 && *growth <= 1.0;
            let growth = growth.parse().ok().filter(valid);
            let wrong = || format!("\"{text}\" is no fraction of a distance");
            self.growth = Some(growth.ok_or_else(wrong)?);
        }
        if let Some((_, time)) = text.split_once("t = ") {
            self.time = time.strip_suffix(" s").and_then(|time| time.parse().ok());
        }
        Ok(())
    }
}

fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let mut words = text.split(' ');
    let mut values = [0.0_f64; N];
    for value in &mut values {
        let word = words.next().unwrap_or_default();
        *value = word.parse().map_err(|_| format!("\"{word}\" is not a number"))?;
        // Written so that NaN fails.
        if !(value.abs() <= COORDINATE_MAX) {
            return Err(format!("the coordinate {word} is not one of at most {COORDINATE_MAX} m"));
        }
    }
    words.next().map_or(Ok(values), |more| Err(format!("\"{more}\" is one number too many")))
}

fn corners(text: &str) -> Result<[u32; 3], String> {
    let mut words = text.split(' ');
    let mut corners = [0; 3];
    for corner in &mut corners {
        let word = words.next().unwrap_or_default();
        let (vertex, material) = word.split_once('/').unwrap_or((word, word));
        let number = vertex.parse::<u32>().ok().and_then(|vertex| vertex.checked_sub(1));
        // A frame numbers its material coordinates as its vertices.
        *corner = number
            .filter(|_| vertex == material)
            .ok_or_else(|| format!("\"{word}\" is not the number of a vertex"))?;
    }
    words.next().map_or(Ok(corners), |more| Err(format!("\"{more}\" is one corner too many")))
}
