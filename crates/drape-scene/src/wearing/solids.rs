//! Solid bodies that garments are worn on, and where a garment is relative to them.
//!
//! A garment is about a body if its horizontal outline goes round a part of the body.

use drape_collide::section::{SectionPlane, convex_hull, encloses};
use drape_collide::{Body, Shape, Triangulation};

/// Number of heights at which the outline of a garment is compared with the bodies.
const HEIGHTS: usize = 24;

/// Least fraction of the heights at which a garment that is worn goes round a body. The shipped
/// garments go round it at 9 of 10.
const AROUND_MIN: f64 = 0.25;

/// Least height of a garment over its width if it goes round a body. Lower garments lie flat and
/// fall on the body.
const FLAT: f64 = 0.1;

/// A garment below this fraction of a figure's height is about its feet.
pub(crate) const FEET: f64 = 0.3;

/// A garment taller than this fraction of a figure's height is neither a shoe nor a sock.
const TALL: f64 = 0.25;

/// Largest fraction of a garment's particles inside a body at which its place still counts as
/// right.
const INSIDE_MAX: f64 = 0.002;

/// Bodies that a garment can be worn on: all but floors.
pub(crate) struct Solids<'a> {
    bodies: Vec<&'a Body>,
    pub(crate) outlines: Vec<Triangulation>,
    /// Low corner of the bounding box of all outlines, in m.
    pub(crate) low: [f64; 3],
    /// High corner of this box, in m.
    pub(crate) high: [f64; 3],
}

/// Place of a garment relative to the bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GarmentPlace {
    /// The garment goes round a body.
    About,
    /// The garment goes round the feet of a figure.
    Feet,
    /// A `fraction` of the particles is inside a body.
    Inside {
        /// The fraction.
        fraction: f64,
    },
    /// The garment goes round a body at no more than a `fraction` of its heights.
    Beside {
        /// The fraction.
        fraction: f64,
    },
}

impl<'a> Solids<'a> {
    /// Returns the solid ones among `bodies`, or `None` if all `bodies` are floors.
    pub(crate) fn new(bodies: impl Iterator<Item = &'a Body>) -> Option<Self> {
        let solid = bodies.filter(|body| !matches!(body.shape, Shape::Plane));
        let outlined = solid.filter_map(|body| Some((body, body.triangulate().ok()?)));
        let (bodies, outlines): (Vec<_>, Vec<Triangulation>) = outlined.unzip();
        let [low, high] = extent(outlines.iter().flat_map(|outline| &outline.vertices));
        (!bodies.is_empty()).then_some(Self { bodies, outlines, low, high })
    }

    /// Returns the signed distance of `point` from the nearest body, in m.
    pub(crate) fn distance(&self, point: [f64; 3]) -> f64 {
        let distances = self.bodies.iter().filter_map(|body| body.signed_distance(point).ok());
        distances.map(|near| near.distance).fold(f64::INFINITY, f64::min)
    }

    /// Returns the fraction of [`HEIGHTS`] at which the horizontal outline of `points` goes round a
    /// part of a body.
    fn fraction_around(&self, points: &[[f64; 3]]) -> f64 {
        let [low, high] = extent(points.iter());
        let band = (high[1] - low[1]) / HEIGHTS as f64;
        let around = (0..HEIGHTS).filter(|k| {
            let height = low[1] + (*k as f64 + 0.5) * band;
            let plane = SectionPlane::horizontal(height);
            let near = points.iter().filter(|point| (point[1] - height).abs() <= band);
            let outline = convex_hull(near.map(|&point| plane.flat(point)).collect());
            self.outlines.iter().any(|body| {
                let corners = |t: &[u32; 3]| t.map(|corner| body.vertices[corner as usize]);
                let mut cuts = body.triangles.iter().flat_map(|t| plane.cuts(corners(t)));
                cuts.any(|point| encloses(&outline, point))
            })
        });
        around.count() as f64 / HEIGHTS as f64
    }

    /// Returns the fraction of `points` that are inside a body.
    fn fraction_inside(&self, points: &[[f64; 3]]) -> f64 {
        let inside = points.iter().filter(|&&point| self.distance(point) < 0.0).count();
        inside as f64 / points.len().max(1) as f64
    }

    /// Returns the place of a garment whose particles are at `points`.
    pub(crate) fn place(&self, points: &[[f64; 3]]) -> GarmentPlace {
        let [low, high] = extent(points.iter());
        let width = (high[0] - low[0]).max(high[2] - low[2]);
        let [figure, garment] = [self.high[1] - self.low[1], high[1] - low[1]];
        if garment < FLAT * width {
            return GarmentPlace::About;
        }
        let around = self.fraction_around(points);
        let inside = self.fraction_inside(points);
        let is_figure = figure > (self.high[0] - self.low[0]).max(self.high[2] - self.low[2]);
        let is_at_feet = garment > TALL * figure && high[1] < self.low[1] + FEET * figure;

        if around < AROUND_MIN {
            GarmentPlace::Beside { fraction: around }
        } else if inside > INSIDE_MAX {
            GarmentPlace::Inside { fraction: inside }
        } else if is_figure && is_at_feet {
            GarmentPlace::Feet
        } else {
            GarmentPlace::About
        }
    }

    /// Returns whether `points` moved by `shift`, in m, go round a body.
    pub(crate) fn is_around(&self, points: &[[f64; 3]], shift: [f64; 3]) -> bool {
        let moved: Vec<[f64; 3]> = points.iter().map(|point| moved(point, shift)).collect();
        self.fraction_around(&moved) >= AROUND_MIN
    }
}

/// Returns `point` moved by `shift`.
pub(crate) fn moved(point: &[f64; 3], shift: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| point[k] + shift[k])
}

/// Returns the low and the high corner of the bounding box of `points`.
pub(crate) fn extent<'a>(points: impl Iterator<Item = &'a [f64; 3]>) -> [[f64; 3]; 2] {
    points.fold([[f64::MAX; 3], [f64::MIN; 3]], |[low, high], point| {
        [[0, 1, 2].map(|k| low[k].min(point[k])), [0, 1, 2].map(|k| high[k].max(point[k]))]
    })
}
