//! Sections of bodies by planes, and the convex hulls of sections.
//!
//! A garment that goes round a body is measured against the convex hull of the body's section: a
//! string round it would not follow the hollows either.

/// Plane with directions in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SectionPlane {
    middle: [f64; 3],
    normal: [f64; 3],
    axes: [[f64; 3]; 2],
}

impl SectionPlane {
    /// Returns the horizontal plane at a height, in m.
    pub(crate) fn horizontal(height: f64) -> Self {
        Self {
            middle: [0.0, height, 0.0],
            normal: [0.0, 1.0, 0.0],
            axes: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        }
    }

    /// Returns the plane through the middle of a closed line, across the area that it encloses, if
    /// that is any.
    pub(crate) fn through(places: &[[f64; 3]]) -> Option<Self> {
        let count = places.len() as f64;
        let middle = [0, 1, 2].map(|k| places.iter().map(|place| place[k]).sum::<f64>() / count);
        let mut area = [0.0; 3];
        for (place, next) in places.iter().zip(places.iter().cycle().skip(1)) {
            let turn = cross(subtract(*place, middle), subtract(*next, middle));
            (0..3).for_each(|axis| area[axis] += turn[axis]);
        }
        let normal = unit(area)?;
        let axis = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
        let across = [0, 1, 2].map(|k| f64::from(u8::from(k == axis)));
        let first = unit(cross(across, normal))?;
        Some(Self { middle, normal, axes: [first, cross(normal, first)] })
    }

    /// Returns the plane moved along its normal by a distance, in m.
    pub(crate) fn moved(&self, distance: f64) -> Self {
        let middle = [0, 1, 2].map(|k| self.middle[k] + distance * self.normal[k]);
        Self { middle, ..*self }
    }

    /// Returns the height of its middle, in m.
    pub(crate) fn height(&self) -> f64 {
        self.middle[1]
    }

    /// Returns the foot of a point in the plane.
    pub(crate) fn flat(&self, point: [f64; 3]) -> [f64; 2] {
        self.axes.map(|axis| dot(axis, subtract(point, self.middle)))
    }

    /// Returns the points where the plane cuts the sides of a triangle.
    pub(crate) fn cuts(&self, corners: [[f64; 3]; 3]) -> Vec<[f64; 2]> {
        let heights = corners.map(|corner| dot(self.normal, subtract(corner, self.middle)));
        let cut = |k: usize| {
            let (a, b) = (k, (k + 1) % 3);
            ((heights[a] < 0.0) != (heights[b] < 0.0)).then(|| {
                let part = heights[a] / (heights[a] - heights[b]);
                self.flat(between(corners[a], corners[b], part))
            })
        };
        (0..3).filter_map(cut).collect()
    }
}

/// Returns the length of a closed line, in m.
pub(crate) fn perimeter(places: &[[f64; 2]]) -> f64 {
    let next = places.iter().cycle().skip(1);
    places.iter().zip(next).map(|([ax, ay], [bx, by])| (bx - ax).hypot(by - ay)).sum()
}

/// Returns whether a closed line goes round a point.
pub(crate) fn encloses(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let sides = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossed = sides.filter(|([ax, ay], [bx, by])| {
        (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
    });
    crossed.count() % 2 == 1
}

/// Returns the corners of the convex hull of points, in their order \[And79\].
pub(crate) fn convex_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let chain = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for &[x, y] in points {
            while let [.., [ax, ay], [bx, by]] = chain[..]
                && (bx - ax) * (y - ay) <= (by - ay) * (x - ax)
            {
                chain.pop();
            }
            chain.push([x, y]);
        }
        chain.pop();
        chain
    };
    [chain(&mut points.iter()), chain(&mut points.iter().rev())].concat()
}

/// Returns the point between two others at a fraction of their distance.
pub(crate) fn between<const N: usize>(a: [f64; N], b: [f64; N], part: f64) -> [f64; N] {
    std::array::from_fn(|axis| a[axis] + part * (b[axis] - a[axis]))
}

fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| a[axis] - b[axis])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(a, a).sqrt();
    (length > 0.0).then(|| a.map(|x| x / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_through_a_tilted_circle_sees_it_in_its_true_size() {
        let place = |k: i32| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 400.0).sin_cos();
            [1.0 + 0.2 * cos, 2.0 + 0.15 * sin, 0.2 * sin]
        };
        let tilted: Vec<[f64; 3]> = (0..400).map(place).collect();
        let plane = SectionPlane::through(&tilted).expect("it has an area");
        assert!((plane.height() - 2.0).abs() < 1e-12);
        let flat: Vec<[f64; 2]> = tilted.iter().map(|&place| plane.flat(place)).collect();
        let exact: f64 = tilted
            .iter()
            .zip(tilted.iter().cycle().skip(1))
            .map(|(a, b)| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt())
            .sum();
        assert!((perimeter(&flat) - exact).abs() < 1e-12);
        assert!(encloses(&flat, [0.0, 0.1]) && !encloses(&flat, [0.26, 0.0]));
        assert!((perimeter(&convex_hull(flat)) - exact).abs() < 1e-12);
    }
}
