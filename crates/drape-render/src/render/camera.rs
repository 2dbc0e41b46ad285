//! View of a scene, and the camera that frames it.

use super::scene::{Scene, Surface, check_range};
use super::vector::{Bounds, Vector, add, cross, dot, perpendiculars, scale, subtract};
use crate::error::Error;

/// Number of directions in which an extent stores the farthest point of its shapes.
const DIRECTIONS: usize = 160;

/// Angle between successive directions, in rad, which distributes the directions evenly.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Fraction of the picture that the scene fills.
const FILL: f64 = 0.9;

/// Margin around the cloths within which bodies count for the framing, over the radius of the
/// cloths. A table is shown, but a room does not shrink the cloth to a dot.
const MARGIN: f64 = 0.35;

/// View of a scene: direction of the camera, field of view, size of the picture.
///
/// ```
/// use drape_render::{Scene, Surface, View};
///
/// let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
/// let scene = Scene { cloths: vec![Surface::cloth(&corners, &[[0, 1, 2]])], ..Scene::default() };
/// let view = View { azimuth_deg: 0.0, elevation_deg: 0.0, ..View::default() };
/// let camera = view.camera(&scene)?;
/// // Seen from the front, +x points to the right of the picture.
/// let [left, right] = [[0.0; 3], [1.0, 0.0, 0.0]].map(|corner| camera.project(corner).x);
/// assert!(left < right);
/// # Ok::<(), drape_render::Error>(())
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
    /// Returns the camera that shows the whole `scene`.
    ///
    /// # Errors
    /// A number of the view or of the scene out of range, or a scene without triangles.
    pub fn camera(&self, scene: &Scene) -> Result<Camera, Error> {
        self.check()?;
        scene.check()?;
        let axes = self.axes();
        let eye = fit(&points(scene), axes, self.slopes());
        Ok(Camera::new(self, axes, eye))
    }

    /// Returns the cameras of `views` of equal size, for pictures that can be compared. The shapes
    /// of `extent` have one scale in all pictures, and their middle has one position.
    ///
    /// # Errors
    /// A number of a view out of range, or an extent without points.
    pub fn cameras(views: &[View], extent: &Extent) -> Result<Vec<Camera>, Error> {
        views.iter().try_for_each(View::check)?;
        if extent.points.is_empty() {
            return Err(Error::EmptyScene);
        }
        let bounds = Bounds::of(extent.points.iter().copied());
        // Smallest distance of the camera from the middle at which a point is within the frame.
        let distance = |view: &View, point: &Vector| {
            let [right, up, forward] = view.axes();
            let from = subtract(*point, bounds.center);
            let sides = [right, up].into_iter().zip(view.slopes());
            let least = sides.map(|(axis, slope)| dot(from, axis).abs() / slope);
            least.fold(0.0, f64::max) - dot(from, forward)
        };
        let distances =
            views.iter().flat_map(|view| extent.points.iter().map(|p| distance(view, p)));
        let farthest = distances.fold(1e-3, f64::max);

        let camera = |view: &View| {
            let axes = view.axes();
            Camera::new(view, axes, add(bounds.center, scale(axes[2], -farthest)))
        };
        Ok(views.iter().map(camera).collect())
    }

    /// Returns unit vectors to the right of the picture, up in the picture and along the line of
    /// sight, for `azimuth_deg` and `elevation_deg`.
    fn axes(&self) -> [Vector; 3] {
        let (sine, cosine) = self.azimuth_deg.to_radians().sin_cos();
        let (rise, level) = self.elevation_deg.to_radians().sin_cos();
        let forward = [-level * sine, -rise, -level * cosine];
        let [mut right, mut up] = perpendiculars(forward);
        if self.elevation_deg.abs() > 87.0 {
            // In a view straight down or up, the azimuth still decides which direction is up in the
            // picture.
            right = [cosine, 0.0, -sine];
            up = cross(right, forward);
        }
        [right, up, forward]
    }

    /// Returns the slopes of lines of sight to the sides and up, within which the scene must lie,
    /// from `field_deg`.
    fn slopes(&self) -> [f64; 2] {
        let slope = FILL * (0.5 * self.field_deg).to_radians().tan();
        [slope * f64::from(self.width) / f64::from(self.height), slope]
    }

    /// Refuses numbers out of range, as [`Error::OutOfRange`].
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
    width: u32,
    height: u32,
}

impl Camera {
    /// Returns the position `eye` of the camera, in m.
    #[must_use]
    pub fn eye(&self) -> [f64; 3] {
        self.eye
    }

    /// Returns the projection of a `point`. Points with a depth of 0 or less are not visible.
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

    /// Returns the `width` of the picture, in pixels.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Returns the `height` of the picture, in pixels.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns the unit vector to the `right` of the picture.
    pub(crate) fn right(&self) -> Vector {
        self.right
    }

    /// Returns the direction of the line of sight through the point `x`, `y` of the picture, in
    /// pixels.
    pub(crate) fn ray(&self, [x, y]: [f64; 2]) -> Vector {
        let [across, along] = [x - self.middle[0], self.middle[1] - y].map(|k| k / self.focal);
        add(self.forward, add(scale(self.right, across), scale(self.up, along)))
    }

    /// Returns the camera of a `view` at the position `eye`.
    fn new(view: &View, [right, up, forward]: [Vector; 3], eye: Vector) -> Camera {
        let middle = [view.width, view.height].map(|size| 0.5 * f64::from(size));
        let focal = middle[1] / (0.5 * view.field_deg).to_radians().tan();
        let [width, height] = [view.width, view.height];
        Camera { eye, right, up, forward, focal, middle, width, height }
    }
}

/// Points that pictures of some scenes must show: cloths, and the parts of bodies near them.
///
/// The extent stores the points that are farthest in one of many directions.
#[derive(Debug, Clone, Default)]
pub struct Extent {
    points: Vec<Vector>,
}

impl Extent {
    /// Returns the extent of a `scene`.
    #[must_use]
    pub fn of(scene: &Scene) -> Extent {
        Extent::default().with(scene)
    }

    /// Returns the extent widened by the extent of a further `scene`.
    #[must_use]
    pub fn with(self, scene: &Scene) -> Extent {
        let all: Vec<Vector> = self.points.into_iter().chain(points(scene)).collect();
        let farthest = |number: usize| {
            let height = 1.0 - (2.0 * number as f64 + 1.0) / DIRECTIONS as f64;
            let level = (1.0 - height * height).sqrt();
            let (sine, cosine) = (number as f64 * GOLDEN_ANGLE).sin_cos();
            let direction = [level * sine, height, level * cosine];
            all.iter().copied().max_by(|a, b| dot(*a, direction).total_cmp(&dot(*b, direction)))
        };
        Extent { points: (0..DIRECTIONS).filter_map(farthest).collect() }
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

/// Returns the points of a `scene` that must be in the picture.
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

/// Returns the smallest or largest coordinates of `points`, as `choose` decides.
fn extreme(points: &[Vector], start: f64, choose: fn(f64, f64) -> f64) -> Vector {
    points.iter().fold([start; 3], |sum, p| std::array::from_fn(|k| choose(sum[k], p[k])))
}

/// Returns the position of the camera from which all `points` lie within `slopes` to the sides and
/// up and down.
///
/// In the axes of the camera a point `$(x, z)$` lies within the slope `$t$` if
/// `$|x - x_0| \le t\,(z - z_0)$`. The two sides give the largest `$x - tz$` and the largest
/// `$-x - tz$`. Half of their difference is `$x_0$`, and half of their sum over `$-t$` is the
/// closest `$z_0$`.
fn fit(points: &[Vector], [right, up, forward]: [Vector; 3], slopes: [f64; 2]) -> Vector {
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
    // A single point would put the camera at the point itself.
    let front = points.iter().map(|p| dot(*p, forward)).fold(f64::MAX, f64::min);
    add(eye, scale(forward, closest.min(front - 1e-3)))
}
