use std::io::Read;
use std::path::Path;

use crate::error::VerifyError;

/// Longest file that is read, in bytes: 4 million particles take a quarter of it.
const BYTES_MAX: u64 = 1 << 32;

/// Largest coordinate, in m: what a run can have.
const COORDINATE_MAX: f64 = 1e6;

/// A file of vertices and triangles as a run writes it: Wavefront OBJ of `v`, `vt`, `f`, `o` and comments only.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Wavefront {
    /// Three coordinates each, in m.
    pub(crate) vertices: Vec<[f64; 3]>,
    /// Two material coordinates each, in m.
    pub(crate) material: Vec<[f64; 2]>,
    /// Numbers of vertices from 0, not checked against them.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// Time, in s, where a comment says `t = … s`.
    pub(crate) time: Option<f64>,
    /// The file of the bodies, where a comment says `bodies: NAME`.
    pub(crate) bodies: Option<String>,
    /// Part of the distances that surfaces keep which they kept by then, where a comment says `grown: PART`.
    pub(crate) grown: Option<f64>,
}

/// The text of a file, which must end its last line.
pub(crate) fn read_text(path: &Path) -> Result<String, VerifyError> {
    let fail = |error: std::io::Error| {
        let reason = error.to_string();
        VerifyError::Unreadable { path: path.to_owned(), reason }
    };
    let file = std::fs::File::open(path).map_err(fail)?;
    let bytes = file.metadata().map_err(fail)?.len();
    if bytes > BYTES_MAX {
        return Err(VerifyError::TooLarge { path: path.to_owned(), bytes, limit: BYTES_MAX });
    }
    let mut text = String::new();
    file.take(BYTES_MAX).read_to_string(&mut text).map_err(fail)?;
    if !text.ends_with('\n') {
        let (line, reason) = (text.lines().count().max(1), "the file is cut off here".to_owned());
        return Err(VerifyError::Malformed { path: path.to_owned(), line, reason });
    }
    Ok(text)
}

impl Wavefront {
    pub(crate) fn read(path: &Path) -> Result<Wavefront, VerifyError> {
        Wavefront::parse(path, &read_text(path)?)
    }

    fn parse(path: &Path, text: &str) -> Result<Wavefront, VerifyError> {
        let mut all = Wavefront::default();
        for (index, line) in text.lines().enumerate() {
            all.line(line).map_err(|reason| VerifyError::Malformed {
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
        if let Some(part) = text.strip_prefix("grown: ") {
            let sound = |part: &f64| *part > 0.0 && *part <= 1.0;
            let part = part.parse().ok().filter(sound);
            self.grown = Some(part.ok_or_else(|| format!("\"{text}\" is no part of a distance"))?);
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
