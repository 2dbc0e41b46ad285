//! Rim: the triangles between the outline and the full cells of the lattice.
//!
//! A constrained Delaunay triangulation fills the strip. Where it leaves sharp angles, the lattice
//! is thinned near the outline, and other phases of the lattice are tried.

use std::collections::BTreeMap;

use spade::handles::FixedFaceHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::lattice::{LOOSE, Lattice};
use super::region::Region;
use crate::edge::difference;

/// Angle of a triangle below which the lattice is thinned, in rad: 22 degrees.
const SHARP: f64 = 22.0 * std::f64::consts::PI / 180.0;

/// Largest number of times that the lattice is thinned at one phase. Where twelve do not help, the
/// outline itself is sharp.
const PASSES: usize = 12;

/// Lattice inside a region and the triangles between them. Lengths are in spacings.
#[derive(Debug, Clone)]
pub(crate) struct Rim {
    pub lattice: Lattice,
    /// Corners of the triangles, anticlockwise: numbers of the region's corners, then of the
    /// lattice's nodes, row by row.
    pub triangles: Vec<[u32; 3]>,
    /// Smallest angle of the triangles that is not one of the region's own corners, in rad.
    smallest_angle: f64,
}

impl Rim {
    /// Returns the rim of a region between simple polygons; `None` if triangulation failed.
    ///
    /// The phases of the lattice are tried in the order of their numbers of cells until one leaves
    /// no sharp angle; if none does, the one with the largest smallest angle is taken.
    pub fn new(region: &Region) -> Option<Self> {
        let mut best: Option<Self> = None;
        for phase in Lattice::phases(region) {
            let rim = Self::thinned(region, Lattice::new(region, phase))?;
            if best.as_ref().is_none_or(|b| rim.smallest_angle > b.smallest_angle) {
                best = Some(rim);
            }
            if best.as_ref().is_some_and(|b| b.smallest_angle >= SHARP) {
                break;
            }
        }
        best
    }

    /// Returns the rim of a lattice that is thinned as long as that may help.
    fn thinned(region: &Region, lattice: Lattice) -> Option<Self> {
        let mut best = Self::of(region, lattice)?;
        let mut rim = best.clone();
        for _ in 0..PASSES {
            if rim.smallest_angle >= SHARP || !rim.thin(region) {
                break;
            }
            rim = Self::of(region, rim.lattice)?;
            if rim.smallest_angle > best.smallest_angle {
                best = rim.clone();
            }
        }
        Some(best)
    }

    /// Returns the rim of a lattice.
    fn of(region: &Region, lattice: Lattice) -> Option<Self> {
        let nodes: Vec<[usize; 2]> = lattice.nodes().collect();
        let triangles = triangulate(region, &lattice, &nodes)?;
        let mut rim = Self { lattice, triangles, smallest_angle: std::f64::consts::PI };
        let position = |node: u32| rim.position(region, &nodes, node);
        let sharp = rim.triangles.iter().map(|t| free_angle(region, *t, t.map(position)));
        rim.smallest_angle = sharp.fold(std::f64::consts::PI, f64::min);
        Some(rim)
    }

    /// Returns the position of a corner of the region or node of the lattice.
    fn position(&self, region: &Region, nodes: &[[usize; 2]], node: u32) -> [f64; 2] {
        let node = node as usize;
        match region.corners.get(node) {
            Some(corner) => *corner,
            None => self.lattice.position(nodes[node - region.corners.len()]),
        }
    }

    /// Drops from each sharp triangle its lattice node nearest to the outline, if that is loose;
    /// returns whether any was dropped.
    fn thin(&mut self, region: &Region) -> bool {
        let nodes: Vec<[usize; 2]> = self.lattice.nodes().collect();
        let mut lost = Vec::new();
        for &triangle in &self.triangles {
            let corners = triangle.map(|node| self.position(region, &nodes, node));
            if free_angle(region, triangle, corners) >= SHARP {
                continue;
            }
            let sides = region.corners.len();
            let own = triangle.iter().filter_map(|&n| nodes.get((n as usize).wrapping_sub(sides)));
            let clear = |node: &[usize; 2]| self.lattice.clearance(*node);
            let nearest = own.min_by(|a, b| clear(a).total_cmp(&clear(b)));
            lost.extend(nearest.filter(|node| clear(node) < LOOSE));
        }
        lost.iter().for_each(|&node| self.lattice.drop_node(node));
        !lost.is_empty()
    }
}

/// Returns the angles at the corners of a triangle, in rad.
pub(crate) fn angles(corners: [[f64; 2]; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let (u, v) = (
            difference(corners[(k + 1) % 3], corners[k]),
            difference(corners[(k + 2) % 3], corners[k]),
        );
        (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1])
    })
}

/// Returns the smallest angle of a triangle, except one between two sides of the region, which is the
/// region's own.
fn free_angle(region: &Region, triangle: [u32; 3], corners: [[f64; 2]; 3]) -> f64 {
    let angles = angles(corners);
    let sides = region.corners.len();
    let follows = |a: u32, b: u32| {
        let (a, b) = (a as usize, b as usize);
        a < sides && b < sides && region.next(a) == b
    };
    let free = (0..3).filter(|&k| {
        let (node, next, last) = (triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
        !(follows(node, next) && follows(last, node))
    });
    free.map(|k| angles[k]).fold(std::f64::consts::PI, f64::min)
}

/// Returns the triangles between the sides of a region and the full cells of a lattice.
fn triangulate(region: &Region, lattice: &Lattice, nodes: &[[usize; 2]]) -> Option<Vec<[u32; 3]>> {
    let number: BTreeMap<[usize; 2], usize> =
        nodes.iter().enumerate().map(|(k, &node)| (node, region.corners.len() + k)).collect();
    // Nodes inside the cells take no part.
    let outer = outer_nodes(lattice, nodes);
    let corners = &region.corners;
    let mut vertices: Vec<Point2<f64>> = corners.iter().map(|p| Point2::new(p[0], p[1])).collect();
    let mut names: Vec<u32> = (0..corners.len() as u32).collect();
    let mut vertex: BTreeMap<usize, usize> = (0..corners.len()).map(|k| (k, k)).collect();
    for &node in &outer {
        let [x, y] = lattice.position(node);
        vertex.insert(number[&node], vertices.len());
        names.push(number[&node] as u32);
        vertices.push(Point2::new(x, y));
    }
    // Directed so that the rim lies on the left.
    let mut sides: Vec<[usize; 2]> = region.sides().collect();
    for [from, to] in cell_sides(lattice) {
        sides.push([vertex[&number[&to]], vertex[&number[&from]]]);
    }
    let mut conflict = false;
    let count = vertices.len();
    let triangulation: ConstrainedDelaunayTriangulation<Point2<f64>> =
        ConstrainedDelaunayTriangulation::try_bulk_load_cdt(vertices, sides.clone(), |_| {
            conflict = true;
        })
        .ok()?;
    if conflict || triangulation.num_vertices() != count {
        return None;
    }
    // Flood fill from the constraint edges, without crossing another.
    let mut reached = vec![false; triangulation.num_all_faces()];
    let mut front: Vec<FixedFaceHandle<spade::handles::InnerTag>> = Vec::new();
    let handle = spade::handles::FixedVertexHandle::from_index;
    for [from, to] in sides {
        let side = triangulation.get_edge_from_neighbors(handle(from), handle(to))?;
        front.push(side.face().as_inner()?.fix());
    }
    let mut triangles = Vec::new();
    while let Some(face) = front.pop() {
        if std::mem::replace(&mut reached[face.index()], true) {
            continue;
        }
        let face = triangulation.face(face);
        triangles.push(lowest_first(face.vertices().map(|v| names[v.fix().index()])));
        for edge in face.adjacent_edges() {
            if !edge.is_constraint_edge() {
                front.push(edge.rev().face().as_inner()?.fix());
            }
        }
    }
    triangles.sort_unstable();
    Some(triangles)
}

/// Returns a triangle with its lowest corner first.
fn lowest_first(triangle: [u32; 3]) -> [u32; 3] {
    let lowest = (0..3).min_by_key(|&k| triangle[k]).unwrap_or(0);
    [0, 1, 2].map(|k| triangle[(lowest + k) % 3])
}

/// Returns the nodes that are not between four full cells.
fn outer_nodes(lattice: &Lattice, nodes: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let inner = |&[column, row]: &[usize; 2]| {
        column > 0
            && row > 0
            && [[0, 0], [1, 0], [1, 1], [0, 1]]
                .iter()
                .all(|[x, y]| lattice.is_full([column - x, row - y]))
    };
    nodes.iter().filter(|node| !inner(node)).copied().collect()
}

/// Returns the sides of full cells that belong to one cell only, with the cell on the left.
fn cell_sides(lattice: &Lattice) -> Vec<[[usize; 2]; 2]> {
    let mut sides = Vec::new();
    for [c, r] in lattice.cells() {
        if r == 0 || !lattice.is_full([c, r - 1]) {
            sides.push([[c, r], [c + 1, r]]);
        }
        if !lattice.is_full([c + 1, r]) {
            sides.push([[c + 1, r], [c + 1, r + 1]]);
        }
        if !lattice.is_full([c, r + 1]) {
            sides.push([[c + 1, r + 1], [c, r + 1]]);
        }
        if c == 0 || !lattice.is_full([c - 1, r]) {
            sides.push([[c, r + 1], [c, r]]);
        }
    }
    sides
}
