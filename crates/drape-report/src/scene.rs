use crate::error::ReportError;
use crate::vector::{Vector, at};

/// Largest coordinate that can be drawn, in m: beyond it the numbers of a failed simulation begin.
const MAX_COORDINATE: f64 = 1e6;

/// A colour as the screen shows it: red, green, blue in sRGB.
pub type Colour = [u8; 3];

/// Default colour of the front of a cloth: a light blue.
const FRONT: Colour = [150, 182, 214];

/// Default colour of the back of a cloth: sand.
const BACK: Colour = [226, 196, 150];

/// Default colour of a body: a neutral grey.
const BODY: Colour = [190, 190, 188];

/// A triangle surface with its look.
#[derive(Debug, Clone, Copy)]
pub struct Surface<'a> {
    /// Three coordinates per vertex, in m.
    pub positions: &'a [f64],
    /// Three vertex numbers per triangle, counter-clockwise seen from the front.
    pub triangles: &'a [[u32; 3]],
    /// Two material coordinates per vertex, along the weft and along the warp, in m.
    ///
    /// With them the warp and weft lines of the cloth are drawn.
    pub coordinates: Option<&'a [f64]>,
    /// Distance between the warp lines and between the weft lines, in m.
    pub line_spacing: f64,
    /// A colour per vertex, instead of the two colours of the sides.
    pub tints: Option<&'a [Colour]>,
    /// Colour of the side from which the triangles run counter-clockwise.
    pub front: Colour,
    /// Colour of the other side.
    pub back: Colour,
}

impl<'a> Surface<'a> {
    /// A cloth in the default colours, without lines.
    pub fn cloth(positions: &'a [f64], triangles: &'a [[u32; 3]]) -> Surface<'a> {
        Surface {
            positions,
            triangles,
            coordinates: None,
            tints: None,
            line_spacing: 0.05,
            front: FRONT,
            back: BACK,
        }
    }

    /// A body in the default grey.
    pub fn body(positions: &'a [f64], triangles: &'a [[u32; 3]]) -> Surface<'a> {
        Surface { front: BODY, back: BODY, ..Surface::cloth(positions, triangles) }
    }

    /// The same surface with warp and weft lines a spacing in m apart.
    pub fn with_lines(self, coordinates: &'a [f64], line_spacing: f64) -> Surface<'a> {
        Surface { coordinates: Some(coordinates), line_spacing, ..self }
    }

    /// The same surface in a colour per vertex.
    pub fn with_tints(self, tints: &'a [Colour]) -> Surface<'a> {
        Surface { tints: Some(tints), ..self }
    }

    pub(crate) fn points(&self) -> impl Iterator<Item = Vector> {
        (0..self.positions.len() / 3).map(|vertex| at(self.positions, vertex))
    }

    fn check(&self, surface: impl Fn() -> String) -> Result<(), ReportError> {
        let vertices = self.positions.len() / 3;
        let bad_length = |what, length, expected| ReportError::BadLength {
            surface: surface(),
            what,
            length,
            expected,
        };
        if self.positions.len() != 3 * vertices {
            let expected = "three per vertex".to_string();
            return Err(bad_length("positions", self.positions.len(), expected));
        }
        check_numbers(self.positions, 3, "the position", &surface)?;
        if let Some(coordinates) = self.coordinates {
            if coordinates.len() != 2 * vertices {
                let expected = format!("two for each of {vertices} vertices");
                return Err(bad_length("coordinates", coordinates.len(), expected));
            }
            check_numbers(coordinates, 2, "the material coordinates", &surface)?;
            let what = "the spacing of the warp and weft lines (m)";
            check_range(what, self.line_spacing, "above 0", self.line_spacing > 0.0)?;
        }
        if let Some(tints) = self.tints
            && tints.len() != vertices
        {
            let expected = format!("one for each of {vertices} vertices");
            return Err(bad_length("tints", tints.len(), expected));
        }
        for (triangle, indices) in self.triangles.iter().enumerate() {
            if let Some(&index) = indices.iter().find(|index| **index as usize >= vertices) {
                return Err(ReportError::NoSuchVertex {
                    surface: surface(),
                    triangle,
                    index,
                    vertices,
                });
            }
        }
        Ok(())
    }
}

fn check_numbers(
    values: &[f64],
    width: usize,
    what: &'static str,
    surface: &impl Fn() -> String,
) -> Result<(), ReportError> {
    // NaN is in no range.
    let good = |value: &f64| (-MAX_COORDINATE..=MAX_COORDINATE).contains(value);
    match values.iter().position(|value| !good(value)) {
        None => Ok(()),
        Some(k) => Err(ReportError::BadCoordinate {
            surface: surface(),
            what,
            vertex: k / width,
            value: values[k],
        }),
    }
}

pub(crate) fn check_range(
    what: &'static str,
    value: f64,
    range: &'static str,
    holds: bool,
) -> Result<(), ReportError> {
    if value.is_finite() && holds {
        return Ok(());
    }
    Err(ReportError::OutOfRange { what, value, range })
}

/// What a picture shows; y is up.
#[derive(Debug, Clone, Default)]
pub struct Scene<'a> {
    /// The cloths; they fill the picture.
    pub cloths: Vec<Surface<'a>>,
    /// The bodies, as far as they are near the cloths.
    pub bodies: Vec<Surface<'a>>,
    /// Height of a floor that shows as its shadows only, in m.
    pub floor: Option<f64>,
}

impl Scene<'_> {
    pub(crate) fn check(&self) -> Result<(), ReportError> {
        for (k, cloth) in self.cloths.iter().enumerate() {
            cloth.check(|| format!("cloth {k}"))?;
        }
        for (k, body) in self.bodies.iter().enumerate() {
            body.check(|| format!("body {k}"))?;
        }
        if let Some(floor) = self.floor {
            check_range(
                "the height of the floor (m)",
                floor,
                "within a thousand kilometres",
                floor.abs() <= MAX_COORDINATE,
            )?;
        }
        let mut surfaces = self.cloths.iter().chain(&self.bodies);
        if surfaces.all(|surface| surface.triangles.is_empty()) {
            return Err(ReportError::EmptyScene);
        }
        Ok(())
    }
}
