//! View of a scene, and the camera that frames it.

use super::scene::{Scene, Surface, check_range};
use super::vector::{Bounds, Vector, add, cross, dot, perpendiculars, scale, subtract};
use crate::error::Error;

/// Fraction of the picture that the scene fills.
const FILL: f64 = 0.9;

/// Margin around the cloths within which bodies count for the framing, over the radius of the cloths: a
/// table is shown, a room does not shrink the cloth to a dot.
const MARGIN: f64 = 0.35;

/// View of a scene: direction of the camera, field of view, size of the picture.
///
/// ```
/// use drape_report::{Scene, Surface, View};
///
/// let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
/// let scene = Scene { cloths: vec![Surface::cloth(&corners, &[[0, 1, 2]])], ..Scene::default() };
/// let view = View { azimuth_deg: 0.0, elevation_deg: 0.0, ..View::default() };
/// let camera = view.camera(&scene)?;
/// // Seen from the front, +x points to the right of the picture.
/// let [left, right] = [[0.0; 3], [1.0, 0.0, 0.0]].map(|corner| camera.project(corner).x);
/// assert!(left < right);
/// # Ok::<(), drape_report::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Azimuth of the camera about the vertical, in degrees: 0 from +z, 90 from +x.
    pub azimuth_deg: f64,
    /// Elevation of the camera above the horizon, from -90 to 90 degrees.
    pub elevation_deg: f64,
    /// Vertical field of view, in degrees.
    pub field_deg: f64,
    /// Width of the picture, in pixels.
    pub width: u32,
    /// Height of the picture, in pixels.
    pub height: u32,
}

impl Default for View {
    /// Returns a view from the front right and above, 1200 × 900 pixels.
    fn default() -> View {
        View { azimuth_deg: 30.0, elevation_deg: 28.0, field_deg: 24.0, width: 1200, height: 900 }
    }
}

impl View {
    /// Returns the camera that shows the whole of a scene.
    ///
    /// # Errors
    /// A number of the view or of the scene out of range, or a scene without triangles.
    pub fn camera(&self, scene: &Scene) -> Result<Camera, Error> {
        self.check()?;
        scene.check()?;
        Ok(Camera::framing(self, scene))
    }

    /// Refuses numbers out of range.
    fn check(&self) -> Result<(), Error> {
        let within = |what, value: f64, range, least, most| {
            check_range(what, value, range, (least..=most).contains(&value))
        };
        let size = "from 16 to 16384";
        within("the azimuth (°)", self.azimuth_deg, "finite", -1e6, 1e6)?;
        within("the elevation (°)", self.elevation_deg, "from -90 to 90", -90.0, 90.0)?;
        within("the field of view (°)", self.field_deg, "from 1 to 120", 1.0, 120.0)?;
        within("the width (pixels)", self.width.into(), size, 16.0, 16384.0)?;
        within("the height (pixels)", self.height.into(), size, 16.0, 16384.0)
    }
}

/// Camera: a perspective projection.
#[derive(Debug, Clone)]
pub struct Camera {
    eye: Vector,
    right: Vector,
    up: Vector,
    forward: Vector,
    /// Focal length, in pixels.
    focal: f64,
    /// Principal point, in pixels.
    middle: [f64; 2],
}

impl Camera {
    /// Position of the camera, in m.
    #[must_use]
    pub fn eye(&self) -> [f64; 3] {
        self.eye
    }

    /// Returns the projection of a point; points with a depth of 0 or less are not visible.
    #[must_use]
    pub fn project(&self, point: [f64; 3]) -> ScreenPoint {
        let ray = subtract(point, self.eye);
        let depth = dot(ray, self.forward);
        ScreenPoint {
            x: self.middle[0] + self.focal * dot(ray, self.right) / depth,
            y: self.middle[1] - self.focal * dot(ray, self.up) / depth,
            depth,
        }
    }

    /// Unit vector to the right of the picture.
    pub(crate) fn right(&self) -> Vector {
        self.right
    }

    /// Returns the camera closest to the scene, in the direction of the view, that has all of it in the frame.
    fn framing(view: &View, scene: &Scene) -> Camera {
        let (sine, cosine) = view.azimuth_deg.to_radians().sin_cos();
        let (rise, level) = view.elevation_deg.to_radians().sin_cos();
        let forward = [-level * sine, -rise, -level * cosine];
        let [mut right, mut up] = perpendiculars(forward);
        if view.elevation_deg.abs() > 87.0 {
            // Straight down or up, the azimuth still decides which direction is up in the picture.
            right = [cosine, 0.0, -sine];
            up = cross(right, forward);
        }
        let slope = (0.5 * view.field_deg).to_radians().tan();
        let (width, height) = (f64::from(view.width), f64::from(view.height));
        let middle = [0.5 * width, 0.5 * height];
        let focal = middle[1] / slope;
        let eye =
            fit(points(scene), [right, up, forward], [FILL * slope * width / height, FILL * slope]);
        Camera { eye, right, up, forward, focal, middle }
    }
}

/// Point of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScreenPoint {
    /// Pixels to the right of the left edge.
    pub x: f64,
    /// Pixels below the upper edge.
    pub y: f64,
    /// Distance along the line of sight, in m.
    pub depth: f64,
}

/// Returns the points that must be in the picture.
fn points(scene: &Scene) -> Vec<Vector> {
    let used = |surfaces: &[Surface]| -> Vec<Vector> {
        surfaces.iter().flat_map(|s| s.points()).collect()
    };
    let (mut cloth, body) = (used(&scene.cloths), used(&scene.bodies));
    if cloth.is_empty() {
        return body;
    }
    let low: Vector = extreme(&cloth, f64::MAX, f64::min);
    let high: Vector = extreme(&cloth, f64::MIN, f64::max);
    let margin = MARGIN * Bounds::of(cloth.iter().copied()).radius;
    cloth.extend(body.iter().map(|p| -> Vector {
        std::array::from_fn(|k| p[k].clamp(low[k] - margin, high[k] + margin))
    }));
    cloth
}

/// Returns the smallest or largest coordinates of points.
fn extreme(points: &[Vector], start: f64, choose: fn(f64, f64) -> f64) -> Vector {
    points.iter().fold([start; 3], |sum, p| std::array::from_fn(|k| choose(sum[k], p[k])))
}

/// Returns the position of the camera from which all points are within slopes to the sides and up and down.
///
/// In the axes of the camera a point `$(x, z)$` is within the slope `$t$` if `$|x - x_0| \le t\,(z - z_0)$`.
/// The two sides give the largest `$x - tz$` and the largest `$-x - tz$`; half of their difference is
/// `$x_0$`, and half of their sum over `$-t$` the closest `$z_0$`.
fn fit(points: Vec<Vector>, [right, up, forward]: [Vector; 3], slopes: [f64; 2]) -> Vector {
    let mut eye = [0.0; 3];
    let mut closest = f64::MAX;
    for (axis, slope) in [right, up].into_iter().zip(slopes) {
        let largest = |sign: f64| {
            let all = points.iter().map(|p| sign * dot(*p, axis) - slope * dot(*p, forward));
            all.fold(f64::MIN, f64::max)
        };
        let (plus, minus) = (largest(1.0), largest(-1.0));
        eye = add(eye, scale(axis, 0.5 * (plus - minus)));
        closest = closest.min(-0.5 * (plus + minus) / slope);
    }
    // With a single point the camera would be at that point.
    let front = points.iter().map(|p| dot(*p, forward)).fold(f64::MAX, f64::min);
    add(eye, scale(forward, closest.min(front - 1e-3)))
}
