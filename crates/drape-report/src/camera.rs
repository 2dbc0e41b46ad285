use crate::scene::Scene;
use crate::vector::{Vector, add, dot, frame, scale, subtract, surround};
use crate::view::View;

/// Share of the picture that the scene fills.
const FILL: f64 = 0.9;

/// How far beyond the cloths a body still counts for the framing, as a share of their half
/// diagonal: a table shows, a room does not shrink the cloth to a dot.
const NEIGHBOURHOOD: f64 = 0.35;

/// A perspective projection.
#[derive(Debug, Clone)]
pub struct Camera {
    eye: Vector,
    right: Vector,
    up: Vector,
    forward: Vector,
    /// Pixels per unit of slope.
    focal: f64,
    middle: [f64; 2],
}

impl Camera {
    /// Eye position, in m.
    pub fn eye(&self) -> [f64; 3] {
        self.eye
    }

    /// Where a point appears: pixels to the right, pixels down, and depth in m.
    ///
    /// Nothing appears at depths of 0 and below.
    pub fn project(&self, point: [f64; 3]) -> [f64; 3] {
        let ray = subtract(point, self.eye);
        let depth = dot(ray, self.forward);
        [
            self.middle[0] + self.focal * dot(ray, self.right) / depth,
            self.middle[1] - self.focal * dot(ray, self.up) / depth,
            depth,
        ]
    }

    pub(crate) fn right(&self) -> Vector {
        self.right
    }

    /// The nearest eye, in the direction of the view, from which all of the scene is in the frame.
    pub(crate) fn framing(view: &View, scene: &Scene) -> Camera {
        let (sine, cosine) = view.azimuth_deg.to_radians().sin_cos();
        let (rise, level) = view.elevation_deg.to_radians().sin_cos();
        let forward = [-level * sine, -rise, -level * cosine];
        let [mut right, mut up] = frame(forward);
        if view.elevation_deg.abs() > 87.0 {
            // Straight down or up the azimuth still tells which way is up in the picture.
            right = [cosine, 0.0, -sine];
            up = crate::vector::cross(right, forward);
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

/// The points that must be in the picture.
fn points(scene: &Scene) -> Vec<Vector> {
    let used = |surfaces: &[crate::scene::Surface]| -> Vec<Vector> {
        surfaces.iter().flat_map(|s| s.points()).collect()
    };
    let (mut cloth, body) = (used(&scene.cloths), used(&scene.bodies));
    if cloth.is_empty() {
        return body;
    }
    let low: Vector = extreme(&cloth, f64::MAX, f64::min);
    let high: Vector = extreme(&cloth, f64::MIN, f64::max);
    let margin = NEIGHBOURHOOD * surround(cloth.iter().copied()).1;
    cloth.extend(body.iter().map(|p| -> Vector {
        std::array::from_fn(|k| p[k].clamp(low[k] - margin, high[k] + margin))
    }));
    cloth
}

fn extreme(points: &[Vector], start: f64, choose: fn(f64, f64) -> f64) -> Vector {
    points.iter().fold([start; 3], |sum, p| std::array::from_fn(|k| choose(sum[k], p[k])))
}

/// The eye from which all points are within the slopes to the sides and up and down.
///
/// In the camera's axes a point (x, z) is within if |x - x0| ≤ t (z - z0). The two sides give the
/// largest x - t z and the largest -x - t z; half their difference is x0, and half their sum over
/// -t the nearest z0.
fn fit(points: Vec<Vector>, [right, up, forward]: [Vector; 3], slopes: [f64; 2]) -> Vector {
    let mut eye = [0.0; 3];
    let mut nearest = f64::MAX;
    for (axis, slope) in [right, up].into_iter().zip(slopes) {
        let reach = |sign: f64| {
            let reaches = points.iter().map(|p| sign * dot(*p, axis) - slope * dot(*p, forward));
            reaches.fold(f64::MIN, f64::max)
        };
        let (plus, minus) = (reach(1.0), reach(-1.0));
        eye = add(eye, scale(axis, 0.5 * (plus - minus)));
        nearest = nearest.min(-0.5 * (plus + minus) / slope);
    }
    // A single point would have the eye in it.
    let front = points.iter().map(|p| dot(*p, forward)).fold(f64::MAX, f64::min);
    add(eye, scale(forward, nearest.min(front - 1e-3)))
}
