//! Scene of a picture: cloths, bodies and a floor, checked before anything is drawn.

use super::vector::{Vector, at};
use crate::error::Error;
use crate::picture::Colour;

/// Largest coordinate that can be drawn, in m. Larger coordinates come from a failed simulation.
const MAX_COORDINATE: f64 = 1e6;

/// Default colour of the front of a cloth: a light blue.
const FRONT: Colour = [150, 182, 214];

/// Default colour of the back of a cloth: sand.
const BACK: Colour = [226, 196, 150];

/// Default colour of a body: a neutral grey.
const BODY: Colour = [190, 190, 188];

/// Triangle mesh with its colours.
///
/// ```
/// use drape_render::Surface;
///
/// let positions = [0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5, 0.0];
/// let coordinates = [0.0, 0.0, 0.5, 0.0, 0.0, 0.5];
/// let cloth = Surface::cloth(&positions, &[[0, 1, 2]]).with_lines(&coordinates, 0.05);
/// assert!(cloth.tints.is_none() && cloth.front != cloth.back);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Surface<'a> {
    /// Positions: three coordinates per vertex, in m.
    pub positions: &'a [f64],
    /// Triangles: three vertex numbers each, anticlockwise seen from the front.
    pub triangles: &'a [[u32; 3]],
    /// Material coordinates: two per vertex, along the weft and along the warp, in m. With them
    /// warp and weft lines are drawn.
    pub coordinates: Option<&'a [f64]>,
    /// Distance of the warp lines and of the weft lines, in m.
    pub line_spacing: f64,
    /// Colours: one per vertex, instead of the two colours of the sides.
    pub tints: Option<&'a [Colour]>,
    /// Colours of the front and the back: one pair per triangle, instead of the two colours of the
    /// sides. Triangles that share a vertex have the same colours.
    pub sides: Option<&'a [[Colour; 2]]>,
    /// Colour of the front, from which the triangles run anticlockwise.
    pub front: Colour,
    /// Colour of the back.
    pub back: Colour,
    /// Thickness of a cloth, in m, which is the width of its rim along the hem. A rim has at least
    /// the width that can be seen.
    pub thickness: f64,
}

impl<'a> Surface<'a> {
    /// Returns a cloth of `triangles` in the default colours, without lines.
    #[must_use]
    pub fn cloth(positions: &'a [f64], triangles: &'a [[u32; 3]]) -> Surface<'a> {
        Surface {
            positions,
            triangles,
            coordinates: None,
            tints: None,
            sides: None,
            line_spacing: 0.05,
            front: FRONT,
            back: BACK,
            thickness: 0.0,
        }
    }

    /// Returns a body of `triangles` in the default grey.
    #[must_use]
    pub fn body(positions: &'a [f64], triangles: &'a [[u32; 3]]) -> Surface<'a> {
        Surface { front: BODY, back: BODY, ..Surface::cloth(positions, triangles) }
    }

    /// Returns the surface with warp and weft lines at `line_spacing`, in m, by its material
    /// `coordinates`.
    #[must_use]
    pub fn with_lines(self, coordinates: &'a [f64], line_spacing: f64) -> Surface<'a> {
        Surface { coordinates: Some(coordinates), line_spacing, ..self }
    }

    /// Returns the surface with `tints`, a colour per vertex.
    #[must_use]
    pub fn with_tints(self, tints: &'a [Colour]) -> Surface<'a> {
        Surface { tints: Some(tints), ..self }
    }

    /// Returns the surface with `sides`, the colours of the front and the back of each triangle.
    #[must_use]
    pub fn with_sides(self, sides: &'a [[Colour; 2]]) -> Surface<'a> {
        Surface { sides: Some(sides), ..self }
    }

    /// Returns the `positions` of the vertices, in m.
    pub(crate) fn points(&self) -> impl Iterator<Item = Vector> {
        (0..self.positions.len() / 3).map(|vertex| at(self.positions, vertex))
    }

    /// Refuses incomplete lists, bad coordinates and vertices that do not exist. The error names
    /// the surface by `surface`.
    fn check(&self, surface: impl Fn() -> String) -> Result<(), Error> {
        let vertices = self.positions.len() / 3;
        let bad_length = |what, length, expected| Error::BadLength {
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
        if let Some(sides) = self.sides
            && sides.len() != self.triangles.len()
        {
            let expected = format!("one for each of {} triangles", self.triangles.len());
            return Err(bad_length("sides", sides.len(), expected));
        }

        let what = "the thickness of the cloth (m)";
        check_range(what, self.thickness, "from 0 to 1", (0.0..=1.0).contains(&self.thickness))?;
        for (triangle, indices) in self.triangles.iter().enumerate() {
            if let Some(&index) = indices.iter().find(|index| **index as usize >= vertices) {
                return Err(Error::NoSuchVertex { surface: surface(), triangle, index, vertices });
            }
        }
        Ok(())
    }
}

/// Refuses coordinates out of range. The list `values` has `width` numbers per vertex.
fn check_numbers(
    values: &[f64],
    width: usize,
    what: &'static str,
    surface: &impl Fn() -> String,
) -> Result<(), Error> {
    // NaN lies in no range.
    let good = |value: &f64| (-MAX_COORDINATE..=MAX_COORDINATE).contains(value);
    match values.iter().position(|value| !good(value)) {
        None => Ok(()),
        Some(k) => Err(Error::BadCoordinate {
            surface: surface(),
            what,
            vertex: k / width,
            value: values[k],
        }),
    }
}

/// Refuses a `value` that is not finite, or whose range does not hold as `holds` says.
pub(crate) fn check_range(
    what: &'static str,
    value: f64,
    range: &'static str,
    holds: bool,
) -> Result<(), Error> {
    if value.is_finite() && holds {
        return Ok(());
    }
    Err(Error::OutOfRange { what, value, range })
}

/// Colours of a picture behind its scene, with a gradient from the top to the bottom.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ground {
    /// Colour at the top.
    pub top: Colour,
    /// Colour at the bottom.
    pub bottom: Colour,
}

impl Ground {
    /// White, like a page.
    pub const WHITE: Ground = Ground { top: [255; 3], bottom: [255; 3] };

    /// Quiet grey, in front of which light and dark cloth stands out.
    pub const GREY: Ground = Ground { top: [214, 218, 223], bottom: [233, 234, 235] };
}

impl Default for Ground {
    /// Returns [`Ground::WHITE`].
    fn default() -> Ground {
        Ground::WHITE
    }
}

/// Scene of a picture. The y axis points up.
#[derive(Debug, Clone, Default)]
pub struct Scene<'a> {
    /// Cloths, which fill the picture.
    pub cloths: Vec<Surface<'a>>,
    /// Bodies. Their parts near the cloths are framed.
    pub bodies: Vec<Surface<'a>>,
    /// Height of a floor that shows only shadows, in m.
    pub floor: Option<f64>,
    /// Colours behind cloths and bodies.
    pub ground: Ground,
    /// Depth bias of bodies, in m: the distance by which bodies are moved back behind cloth in
    /// depth tests.
    ///
    /// The chord between two particles on either side of a convex edge dips below the edge. With a
    /// bias of that depth the edge does not show through the cloth.
    pub body_depth_bias: f64,
}

impl Scene<'_> {
    /// Refuses bad surfaces and a scene without triangles, as [`Error`].
    pub(crate) fn check(&self) -> Result<(), Error> {
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

        let bias = self.body_depth_bias;
        let what = "the depth bias of bodies (m)";
        check_range(what, bias, "from 0 to 1", (0.0..=1.0).contains(&bias))?;
        let mut surfaces = self.cloths.iter().chain(&self.bodies);
        if surfaces.all(|surface| surface.triangles.is_empty()) {
            return Err(Error::EmptyScene);
        }
        Ok(())
    }
}
