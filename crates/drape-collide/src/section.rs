//! Sections of bodies by planes, and the convex hulls of sections.
//!
//! A garment around a body is measured against the convex hull of the body's section, because a
//! string around the body would not follow its hollows either.

use std::collections::BTreeMap;

use crate::error::{Error, check_index};
use crate::mesh_io::Triangulation;
use crate::surface::classes;
use crate::vector::{Vector, cross, dot, norm, subtract};

/// Plane through a body, with two axes in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionPlane {
    middle: [f64; 3],
    normal: [f64; 3],
    axes: [[f64; 3]; 2],
}

impl SectionPlane {
    /// Returns the horizontal plane at `height`, in m.
    #[must_use]
    pub fn horizontal(height: f64) -> Self {
        Self {
            middle: [0.0, height, 0.0],
            normal: [0.0, 1.0, 0.0],
            axes: [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
        }
    }

    /// Returns the plane through the mean of the corners of the closed line `points`, in m,
    /// perpendicular to the vector area of the line. Returns `None` if that area is zero.
    #[must_use]
    pub fn through(points: &[[f64; 3]]) -> Option<Self> {
        let count = points.len() as f64;
        let middle = [0, 1, 2].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / count);
        let mut area = [0.0; 3];
        for (point, next) in points.iter().zip(points.iter().cycle().skip(1)) {
            let turn = cross(subtract(*point, middle), subtract(*next, middle));
            (0..3).for_each(|axis| area[axis] += turn[axis]);
        }
        let normal = unit(area)?;
        let axis = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
        let across = [0, 1, 2].map(|k| f64::from(u8::from(k == axis)));
        let first = unit(cross(across, normal))?;
        Some(Self { middle, normal, axes: [first, cross(normal, first)] })
    }

    /// Returns this plane moved along its normal by `distance`, in m.
    #[must_use]
    pub fn moved(&self, distance: f64) -> Self {
        let middle = [0, 1, 2].map(|k| self.middle[k] + distance * self.normal[k]);
        Self { middle, ..*self }
    }

    /// Returns this plane moved by the vector `shift`, in m.
    #[must_use]
    pub fn shifted(&self, shift: [f64; 3]) -> Self {
        Self { middle: [0, 1, 2].map(|k| self.middle[k] + shift[k]), ..*self }
    }

    /// Returns the height of the plane's middle, in m.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.middle[1]
    }

    /// Returns the coordinates of the foot of `point` along the plane's two axes, in m.
    #[must_use]
    pub fn flat(&self, point: [f64; 3]) -> [f64; 2] {
        self.axes.map(|axis| dot(axis, subtract(point, self.middle)))
    }

    /// Returns the points where the plane cuts the sides of the triangle with `corners`, in m along
    /// the plane's axes.
    #[must_use]
    pub fn cuts(&self, corners: [[f64; 3]; 3]) -> Vec<[f64; 2]> {
        let heights = corners.map(|corner| self.height_of(corner));
        (0..3)
            .map(|k| (k, (k + 1) % 3))
            .filter(|&(a, b)| (heights[a] < 0.0) != (heights[b] < 0.0))
            .map(|(a, b)| {
                let fraction = heights[a] / (heights[a] - heights[b]);
                self.flat(between(corners[a], corners[b], fraction))
            })
            .collect()
    }

    /// Returns the height of `point` over the plane, in m.
    fn height_of(&self, point: [f64; 3]) -> f64 {
        dot(self.normal, subtract(point, self.middle))
    }

    /// Returns the points in which the plane cuts the edges of `mesh`, in m along the plane's axes,
    /// grouped by line. A closed `mesh` gives a closed line for each limb that the plane cuts.
    ///
    /// # Errors
    /// A triangle names a vertex that does not exist.
    pub fn lines(&self, mesh: &Triangulation) -> Result<Vec<Vec<[f64; 2]>>, Error> {
        let MeshCut { points, class, .. } = self.cut(mesh)?;
        let mut lines: BTreeMap<u32, Vec<[f64; 2]>> = BTreeMap::new();
        for (point, class) in points.into_iter().zip(class) {
            lines.entry(class).or_default().push(point);
        }
        Ok(lines.into_values().collect())
    }

    /// Returns the straight pieces of the lines in which the plane cuts a mesh, line by line. The
    /// pieces of a line are in the order of the triangles, not along the line.
    ///
    /// # Errors
    /// A triangle names a vertex that does not exist.
    pub fn pieces(&self, mesh: &Triangulation) -> Result<Vec<Vec<[[f64; 2]; 2]>>, Error> {
        let MeshCut { points, pieces, class } = self.cut(mesh)?;
        let mut lines: BTreeMap<u32, Vec<[[f64; 2]; 2]>> = BTreeMap::new();
        for ends in pieces {
            let line = lines.entry(class[ends[0] as usize]).or_default();
            line.push(ends.map(|end| points[end as usize]));
        }
        Ok(lines.into_values().collect())
    }

    /// Returns the cut through a mesh.
    fn cut(&self, mesh: &Triangulation) -> Result<MeshCut, Error> {
        for &corner in mesh.triangles.as_flattened() {
            check_index("vertex", corner as usize, mesh.vertices.len())?;
        }
        let is_below: Vec<bool> = mesh.vertices.iter().map(|v| self.height_of(*v) < 0.0).collect();
        // Number each side of a triangle that is cut, and join the two sides of each triangle.
        let mut edges: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        let mut pieces = Vec::new();
        for triangle in &mesh.triangles {
            let below = triangle.map(|corner| is_below[corner as usize]);
            if below == [below[0]; 3] {
                continue;
            }
            let cut = (0..3).filter(|&k| below[k] != below[(k + 1) % 3]).map(|k| {
                let [a, b] = [triangle[k], triangle[(k + 1) % 3]];
                let next = edges.len() as u32;
                *edges.entry([a.min(b), a.max(b)]).or_insert(next)
            });
            // A triangle has no or two sides that are cut.
            pieces.extend(<[u32; 2]>::try_from(&cut.collect::<Vec<u32>>()[..]));
        }

        // A line is a class of sides that pieces join. Points are in the order of the sides.
        let class = classes(edges.len(), &pieces);
        let mut place = vec![0; edges.len()];
        let (mut points, mut classes) = (Vec::new(), Vec::new());
        for (edge, number) in edges {
            let [a, b] = edge.map(|corner| mesh.vertices[corner as usize]);
            let (low, high) = (self.height_of(a), self.height_of(b));
            place[number as usize] = points.len() as u32;
            points.push(self.flat(between(a, b, low / (low - high))));
            classes.push(class[number as usize]);
        }
        let pieces = pieces.into_iter().map(|ends| ends.map(|end| place[end as usize])).collect();
        Ok(MeshCut { points, pieces, class: classes })
    }
}

/// Cut of a plane through a mesh.
struct MeshCut {
    /// Points on the sides of triangles.
    points: Vec<[f64; 2]>,
    /// Straight pieces across triangles, by the numbers of their ends.
    pieces: Vec<[u32; 2]>,
    /// Line of each point.
    class: Vec<u32>,
}

/// Returns the length of a closed line in a plane or in space, in m.
#[must_use]
pub fn perimeter<const N: usize>(points: &[[f64; N]]) -> f64 {
    points
        .iter()
        .zip(points.iter().cycle().skip(1))
        .map(|(a, b)| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt())
        .sum()
}

/// Returns whether the closed line `ring` goes around a point.
#[must_use]
pub fn encloses(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let sides = ring.iter().zip(ring.iter().cycle().skip(1));
    let crossed = sides.filter(|([ax, ay], [bx, by])| {
        (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
    });
    crossed.count() % 2 == 1
}

/// Returns the corners of the convex hull of `points`, in order around the hull \[And79\].
#[must_use]
pub fn convex_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    [convex_chain(points.iter()), convex_chain(points.iter().rev())].concat()
}

/// Returns one side of the convex hull of the sorted `points`, without its last point.
fn convex_chain<'a>(points: impl Iterator<Item = &'a [f64; 2]>) -> Vec<[f64; 2]> {
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
}

/// Returns the point at `fraction` of the way from `a` to `b`.
#[must_use]
pub fn between<const N: usize>(a: [f64; N], b: [f64; N], fraction: f64) -> [f64; N] {
    std::array::from_fn(|axis| a[axis] + fraction * (b[axis] - a[axis]))
}

/// Returns the vector of length 1 in the direction of `a`, or `None` if `a` is zero.
fn unit(a: Vector) -> Option<Vector> {
    let length = norm(a);
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

    /// A circle of a radius about a point at a height, tilted about x by a slope.
    fn circle(radius: f64, slope: f64) -> Vec<[f64; 3]> {
        let place = |k: i32| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 400.0).sin_cos();
            [1.0 + radius * cos, 2.0 + slope * radius * sin, radius * sin]
        };
        (0..400).map(place).collect()
    }

    #[test]
    fn a_tilted_circle_lies_about_its_middle_and_is_cut_where_it_crosses() {
        let tilted: Vec<[f64; 3]> = circle(0.2, 0.75);
        let plane = SectionPlane::through(&tilted).expect("it has an area");
        // The middle is the circle's, and the normal is across its slope of 3 in 4.
        assert!(norm(subtract(plane.middle, [1.0, 2.0, 0.0])) < 1e-12);
        let slope = [plane.normal[1].abs(), plane.normal[2].abs()];
        assert!((slope[0] - 0.8).abs() < 1e-9 && (slope[1] - 0.6).abs() < 1e-9, "{slope:?}");
        let flat: Vec<[f64; 2]> = tilted.iter().map(|&place| plane.flat(place)).collect();
        assert!((perimeter(&flat) - perimeter(&tilted)).abs() < 1e-12);
        assert!(encloses(&flat, [0.0, 0.1]) && !encloses(&flat, [0.26, 0.0]));
        // A triangle across it is cut twice, one beside it never.
        let across = [[0.9, 1.9, 0.0], [1.1, 1.9, 0.0], [1.0, 2.2, 0.0]];
        assert_eq!(plane.cuts(across).len(), 2);
        assert!(plane.cuts(across.map(|[x, y, z]| [x, y + 1.0, z])).is_empty());
        assert!(SectionPlane::through(&[[0.0; 3], [1.0, 0.0, 0.0]]).is_none());
    }

    #[test]
    fn a_plane_cuts_a_body_in_a_line_for_each_limb() {
        // Two tetrahedra side by side.
        let tetrahedron = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]];
        let beside = tetrahedron.map(|[x, y, z]| [x + 2.0, y, z]);
        let faces = [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]];
        let mesh = Triangulation {
            vertices: [tetrahedron, beside].concat(),
            triangles: [faces, faces.map(|face| face.map(|corner| corner + 4))].concat(),
        };
        let mut lines = SectionPlane::horizontal(0.5).lines(&mesh).expect("all vertices exist");
        lines.sort_by(|a, b| a[0][0].total_cmp(&b[0][0]));
        assert_eq!(lines.len(), 2);
        for (line, left) in lines.into_iter().zip([0.0, 2.0]) {
            let corners = convex_hull(line);
            assert_eq!(corners, [[left, 0.0], [left + 0.5, 0.0], [left, 0.5]]);
        }
        // The three pieces of each line go once round its corners.
        let mut pieces = SectionPlane::horizontal(0.5).pieces(&mesh).expect("all vertices exist");
        pieces.sort_by(|a, b| a[0][0][0].total_cmp(&b[0][0][0]));
        for line in &pieces {
            let length = |[[a, b], [c, d]]: &[[f64; 2]; 2]| (c - a).hypot(d - b);
            let round = line.iter().map(length).sum::<f64>();
            assert!(line.len() == 3 && (round - 1.0 - 0.5_f64.sqrt()).abs() < 1e-12, "{line:?}");
        }
        assert_eq!(pieces.len(), 2);
        assert!(SectionPlane::horizontal(1.5).lines(&mesh).is_ok_and(|lines| lines.is_empty()));
    }

    #[test]
    fn a_hull_leaves_out_what_is_hollow_or_inside() {
        let star = vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [1.0, 0.5],
            [2.0, 2.0],
            [0.0, 2.0],
            [0.2, 1.0],
            [1.0, 0.0],
        ];
        let corners = convex_hull(star);
        assert_eq!(corners, [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        assert!((perimeter(&corners) - 8.0).abs() < 1e-12);
    }
}
