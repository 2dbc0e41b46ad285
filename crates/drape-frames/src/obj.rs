//! Wavefront OBJ: the files of a run of format 1.

use std::path::Path;

use crate::array::COORDINATE_MAX;
use crate::error::Error;
use crate::text::read_text;

/// Vertices and triangles of a file that has only lines `v`, `vt`, `f`, `o` and comments.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Obj {
    /// Position of each vertex, in m.
    pub(crate) vertices: Vec<[f64; 3]>,
    /// Material coordinates of each vertex, in m.
    pub(crate) material: Vec<[f64; 2]>,
    /// Vertex numbers of each triangle, from 0. They have not been compared with the number of
    /// vertices.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Time from the comment `t = … s`, in s.
    pub(crate) time: Option<f64>,
    /// Name of the file of the bodies, from the comment `bodies: NAME`.
    pub(crate) bodies: Option<String>,
    /// Growth fraction of the minimum separation, from the comment `grown: FRACTION`.
    pub(crate) growth: Option<f64>,
}

impl Obj {
    /// Reads the file `path`.
    pub(crate) fn read(path: &Path) -> Result<Obj, Error> {
        Obj::parse(path, &read_text(path)?)
    }

    /// Parses `text`, the content of the file `path`.
    fn parse(path: &Path, text: &str) -> Result<Obj, Error> {
        let mut obj = Obj::default();
        for (index, line) in text.lines().enumerate() {
            obj.parse_line(line).map_err(|reason| Error::malformed(path, index + 1, reason))?;
        }
        Ok(obj)
    }

    /// Adds the content of `line`.
    fn parse_line(&mut self, line: &str) -> Result<(), String> {
        let (keyword, values) = line.split_once(' ').unwrap_or((line, ""));
        match keyword {
            "v" => self.vertices.push(parse_numbers(values)?),
            "vt" => self.material.push(parse_numbers(values)?),
            "f" => self.triangles.push(parse_corners(values)?),
            "o" | "" => {}
            "#" => self.parse_comment(values)?,
            _ => return Err(format!("\"{keyword}\" is not a line of a frame")),
        }
        Ok(())
    }

    /// Adds the bodies, growth or time that the comment `text` gives.
    fn parse_comment(&mut self, text: &str) -> Result<(), String> {
        if let Some(name) = text.strip_prefix("bodies: ") {
            self.bodies = Some(name.trim().to_owned());
        }
        if let Some(growth) = text.strip_prefix("grown: ") {
            let growth =
                growth.parse::<f64>().ok().filter(|growth| *growth > 0.0 && *growth <= 1.0);
            if growth.is_none() {
                return Err(format!("\"{text}\" is no fraction of a distance"));
            }
            self.growth = growth;
        }
        if let Some((_, time)) = text.split_once("t = ") {
            self.time = time.strip_suffix(" s").and_then(|time| time.parse().ok());
        }
        Ok(())
    }
}

/// Parses `text` as `N` coordinates, separated by spaces.
fn parse_numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let mut words = text.split(' ');
    let mut values = [0.0_f64; N];
    for value in &mut values {
        let word = words.next().unwrap_or_default();
        *value = word.parse().map_err(|_| format!("\"{word}\" is not a number"))?;
        // The comparison is written so that NaN fails.
        if !(value.abs() <= COORDINATE_MAX) {
            return Err(format!("the coordinate {word} is not one of at most {COORDINATE_MAX} m"));
        }
    }
    words.next().map_or(Ok(values), |extra| Err(format!("\"{extra}\" is one number too many")))
}

/// Parses `text` as the three corners of a triangle, and returns their numbers from 0.
fn parse_corners(text: &str) -> Result<[u32; 3], String> {
    let mut words = text.split(' ');
    let mut corners = [0; 3];
    for corner in &mut corners {
        let word = words.next().unwrap_or_default();
        let (vertex, material) = word.split_once('/').unwrap_or((word, word));
        let number = vertex.parse::<u32>().ok().and_then(|vertex| vertex.checked_sub(1));
        // In a frame a vertex and its material coordinates have the same number.
        *corner = number
            .filter(|_| vertex == material)
            .ok_or_else(|| format!("\"{word}\" is not the number of a vertex"))?;
    }
    words.next().map_or(Ok(corners), |extra| Err(format!("\"{extra}\" is one corner too many")))
}
