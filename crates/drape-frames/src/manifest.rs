//! Manifest: the content of `surfaces.json`, the parts of a run and the distances that it promises.

use std::path::Path;

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::error::Error;

/// Format of the folders that this crate reads and writes.
const FORMAT: u64 = 2;

/// Widest gap at which the two sides of a seam count as closed while a garment is sewn, in m.
///
/// Until the vertices of a seam are merged, triangles from its two sides may intersect where the
/// seam is closed: where its vertices are within this distance of each other, and a tied vertex
/// within it of its edge. A run and the check of its frames both follow this rule.
pub const CLOSED_GAP: f64 = 1e-4;

/// Data that all frames of a run share: the content of `surfaces.json`.
///
/// The default has no parts, and its surfaces are not kept apart.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Manifest {
    /// Format of the folder, 2.
    pub format: u64,
    /// Whether contact kept surfaces apart. If not, only particles collided with bodies, and no
    /// distance was promised.
    #[serde(rename = "guarded")]
    pub surface_contact: bool,
    /// Panels of cloth, in the order of the vertices in a frame.
    pub panels: Vec<SurfacePart>,
    /// Bodies, in the order of the vertices in a file of bodies.
    pub bodies: Vec<SurfacePart>,
    /// Fraction of the minimum separation of cloth and bodies that holds where bodies pinch the
    /// cloth. The fraction is above 0 and at most 1.
    #[serde(rename = "thinned", default = "full_separation")]
    pub pinch_fraction: f64,
    /// Pairs of cloth vertices that are sewn together and count as one, by their numbers in the
    /// whole cloth, from 0.
    #[serde(rename = "twins", default)]
    pub seam_pairs: Vec<[u32; 2]>,
    /// Cloth vertices that are tied to a point of an edge, each with the two ends of the edge.
    #[serde(default)]
    pub ties: Vec<[u32; 3]>,
    /// Widest gap at which the two sides of a seam count as closed, in m: [`CLOSED_GAP`], also in
    /// folders of older versions.
    #[serde(default = "closed_gap")]
    pub closed_gap: f64,
}

/// Panel or body of a run.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct SurfacePart {
    /// Name in the scene.
    pub name: String,
    /// Number of vertices of the part.
    pub vertices: usize,
    /// Number of triangles of the part.
    pub triangles: usize,
    /// Half of the activation distance, in m. Two parts repel each other if they are closer than
    /// the sum of their halves. 0 if no distance was promised.
    #[serde(rename = "reach", default)]
    pub half_activation_distance: f64,
    /// Half of the minimum separation, in m. The distance of two parts is at least the sum of their
    /// halves. 0 if no distance was promised.
    #[serde(rename = "separation", default)]
    pub half_min_separation: f64,
    /// Name of the fabric of a panel, empty for a body.
    #[serde(default)]
    pub fabric: String,
    /// Direction of the weft in the coordinates of the panel, whose x is its width and y its
    /// height. The warp is a quarter turn anticlockwise from the weft.
    #[serde(default = "along_width")]
    pub weft: [f64; 2],
    /// Colour in sRGB that the scene states for the fabric of a panel; none where the scene states
    /// none, and in folders of older versions.
    #[serde(rename = "colour", default, deserialize_with = "hex_colour")]
    pub fabric_colour: Option<[u8; 3]>,
}

/// Returns the default of `pinch_fraction`, with which the full separation holds everywhere.
fn full_separation() -> f64 {
    1.0
}

/// Returns the default of `closed_gap`.
fn closed_gap() -> f64 {
    CLOSED_GAP
}

/// Returns the default of `weft`, the direction of the weft of a body and of a panel that states
/// none.
fn along_width() -> [f64; 2] {
    [1.0, 0.0]
}

/// Reads a colour such as `#b03a2e`.
fn hex_colour<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[u8; 3]>, D::Error> {
    let Some(text) = Option::<String>::deserialize(from)? else { return Ok(None) };
    let digits = text.strip_prefix('#').filter(|digits| {
        digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit())
    });
    let number = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
    let number = number.ok_or_else(|| {
        serde::de::Error::custom(format!("`{text}` is no colour; one is #RRGGBB, such as #b03a2e"))
    })?;
    let [_, red, green, blue] = number.to_be_bytes();
    Ok(Some([red, green, blue]))
}

impl Default for Manifest {
    fn default() -> Self {
        Self {
            format: FORMAT,
            surface_contact: false,
            panels: Vec::new(),
            bodies: Vec::new(),
            pinch_fraction: full_separation(),
            seam_pairs: Vec::new(),
            ties: Vec::new(),
            closed_gap: closed_gap(),
        }
    }
}

impl Serialize for Manifest {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct File<'a> {
            format: u64,
            /// Unit of all lengths.
            units: &'static str,
            /// Axis against gravity.
            up: &'static str,
            guarded: bool,
            panels: &'a [SurfacePart],
            bodies: &'a [SurfacePart],
            #[serde(skip_serializing_if = "Option::is_none")]
            thinned: Option<f64>,
            #[serde(skip_serializing_if = "<[_]>::is_empty")]
            twins: &'a [[u32; 2]],
            #[serde(skip_serializing_if = "<[_]>::is_empty")]
            ties: &'a [[u32; 3]],
            #[serde(skip_serializing_if = "Option::is_none")]
            closed_gap: Option<f64>,
        }

        let thinned = Some(self.pinch_fraction).filter(|fraction| *fraction != full_separation());
        let has_seams = !(self.seam_pairs.is_empty() && self.ties.is_empty());
        let file = File {
            format: self.format,
            units: "m",
            up: "y",
            guarded: self.surface_contact,
            panels: &self.panels,
            bodies: &self.bodies,
            thinned,
            twins: &self.seam_pairs,
            ties: &self.ties,
            closed_gap: has_seams.then_some(self.closed_gap),
        };
        file.serialize(to)
    }
}

impl Default for SurfacePart {
    fn default() -> Self {
        Self {
            name: String::new(),
            vertices: 0,
            triangles: 0,
            half_activation_distance: 0.0,
            half_min_separation: 0.0,
            fabric: String::new(),
            weft: along_width(),
            fabric_colour: None,
        }
    }
}

impl Serialize for SurfacePart {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct File<'a> {
            name: &'a str,
            vertices: usize,
            triangles: usize,
            reach: f64,
            separation: f64,
            #[serde(skip_serializing_if = "Option::is_none")]
            fabric: Option<&'a str>,
            #[serde(skip_serializing_if = "Option::is_none")]
            colour: Option<String>,
            #[serde(skip_serializing_if = "Option::is_none")]
            weft: Option<[f64; 2]>,
        }

        let colour = self.fabric_colour;
        // A body has no fabric, and no weft.
        let is_panel = !self.fabric.is_empty() || self.weft != along_width();
        let file = File {
            name: &self.name,
            vertices: self.vertices,
            triangles: self.triangles,
            reach: self.half_activation_distance,
            separation: self.half_min_separation,
            fabric: is_panel.then_some(&self.fabric),
            colour: colour.map(|[red, green, blue]| format!("#{red:02x}{green:02x}{blue:02x}")),
            weft: is_panel.then_some(self.weft),
        };
        file.serialize(to)
    }
}

impl SurfacePart {
    /// Returns the point of the panel with the weft coordinate `u` and the warp coordinate `v`, in
    /// m.
    ///
    /// The point has the coordinates of the panel, whose x is its width and y its height.
    #[must_use]
    pub fn pattern_point(&self, [u, v]: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.weft;
        [u * x - v * y, u * y + v * x]
    }
}

impl Manifest {
    /// Parses and checks `text`, the content of the file `path`.
    pub(crate) fn parse(path: &Path, text: &str) -> Result<Manifest, Error> {
        let manifest: Manifest = serde_json::from_str(text)
            .map_err(|error| Error::malformed(path, error.line(), error.to_string()))?;
        if manifest.format != FORMAT {
            let (format, known) = (manifest.format, FORMAT);
            return Err(Error::UnknownFormat { path: path.to_owned(), format, known });
        }
        manifest.check().map_err(|reason| Error::malformed(path, 1, reason))?;
        Ok(manifest)
    }

    /// Checks ranges and counts, so that a wrong file asks for no memory that it does not need.
    ///
    /// # Errors
    /// The fault, in words.
    pub(crate) fn check(&self) -> Result<(), String> {
        /// Largest number of vertices and triangles of all parts together.
        const COUNT_MAX: usize = 1 << 27;

        let mut total = 0_usize;
        for part in self.panels.iter().chain(&self.bodies) {
            total = total.saturating_add(part.vertices).saturating_add(part.triangles);
            let distances = [part.half_activation_distance, part.half_min_separation];
            if !distances.iter().all(|distance| (0.0..=1.0).contains(distance)) {
                return Err(format!("\"{}\" has no distances", part.name));
            }
            let [x, y] = part.weft;
            if !((x.hypot(y) - 1.0).abs() < 1e-6) {
                return Err(format!("the weft of \"{}\" has no direction", part.name));
            }
        }

        if !(self.pinch_fraction > 0.0 && self.pinch_fraction <= 1.0) {
            return Err(format!("{} is no fraction of a distance", self.pinch_fraction));
        }
        if !(0.0..=CLOSED_GAP).contains(&self.closed_gap) {
            let widest = 1e3 * CLOSED_GAP;
            return Err(format!("closed_gap is not between 0 and {widest} mm"));
        }
        if total > COUNT_MAX {
            return Err(format!("{total} vertices and triangles are too many"));
        }

        let cloth_vertices: usize = self.panels.iter().map(|panel| panel.vertices).sum();
        let mut sewn = self.seam_pairs.iter().flatten().chain(self.ties.iter().flatten());
        if sewn.any(|&vertex| vertex as usize >= cloth_vertices) {
            return Err("a vertex is sewn that does not exist".to_owned());
        }
        Ok(())
    }

    /// Returns the [`Counts`] of the cloth.
    pub(crate) fn cloth_counts(&self) -> Counts {
        Counts::sum(&self.panels)
    }

    /// Returns the [`Counts`] of all bodies.
    pub(crate) fn body_counts(&self) -> Counts {
        Counts::sum(&self.bodies)
    }
}

/// Numbers of vertices and triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) vertices: usize,
    pub(crate) triangles: usize,
}

impl Counts {
    /// Returns the numbers of vertices and triangles of all `parts`.
    fn sum(parts: &[SurfacePart]) -> Counts {
        Counts {
            vertices: parts.iter().map(|part| part.vertices).sum(),
            triangles: parts.iter().map(|part| part.triangles).sum(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pattern_points_lie_along_the_weft_and_a_quarter_turn_anticlockwise_from_it() {
        for weft in [[1.0, 0.0], [0.6, 0.8], [0.0, 1.0], [-0.8, 0.6]] {
            let part = SurfacePart { weft, ..SurfacePart::default() };
            let [x, y] = weft;
            assert_eq!(part.pattern_point([1.0, 0.0]), weft);
            assert_eq!(part.pattern_point([0.0, 1.0]), [-y, x]);
            let [across, up] = part.pattern_point([3.0, -2.0]);
            let exact = [3.0 * x + 2.0 * y, 3.0 * y - 2.0 * x];
            let error = (across - exact[0]).hypot(up - exact[1]);
            assert!(
                error < 1e-15 && (across.hypot(up) - 13.0_f64.sqrt()).abs() < 1e-14,
                "{weft:?}"
            );
        }
    }

    #[test]
    fn colours_of_fabrics_are_read_and_older_folders_have_none() {
        let text = |colour: &str| {
            format!(
                "{{\"format\": 2, \"guarded\": false, \"bodies\": [], \"panels\": [{{\"name\": \"front\", \
                 \"vertices\": 3, \"triangles\": 1, \"fabric\": \"wool\"{colour}}}]}}"
            )
        };
        let read = |colour: &str| Manifest::parse(Path::new("surfaces.json"), &text(colour));
        let colour = |text: &str| read(text).expect("a manifest").panels[0].fabric_colour;
        assert_eq!(colour(""), None);
        assert_eq!(colour(", \"colour\": null"), None);
        assert_eq!(colour(", \"colour\": \"#b03A2e\""), Some([0xb0, 0x3a, 0x2e]));
        for bad in ["b03a2e", "#b03a2", "#b03a2ef", "#+03a2e", "#éa2e", "red"] {
            let error = read(&format!(", \"colour\": \"{bad}\"")).expect_err(bad).to_string();
            assert!(error.contains(bad) && error.contains("#RRGGBB"), "{error}");
        }
    }
}
