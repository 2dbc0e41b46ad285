//! Rim: the triangles between the outline and the full cells of the lattice.
//!
//! A constrained Delaunay triangulation fills the strip. If it leaves sharp angles, the lattice is
//! thinned near the outline, and other phases of the lattice are tried.

use std::collections::BTreeMap;

use spade::handles::FixedFaceHandle;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use super::lattice::{LOOSE, Lattice};
use super::region::Region;
use crate::edge::{difference, turning_angle};

/// Angle of a triangle below which the lattice is thinned, in rad: 22 degrees.
const SHARP: f64 = 22.0 * std::f64::consts::PI / 180.0;

/// Largest number of times that the lattice is thinned at one phase. Where twelve do not help, the
/// outline itself is sharp.
const PASSES: usize = 12;

/// Lattice inside a region and the triangles between them. Lengths are in spacings.
#[derive(Debug, Clone)]
pub(crate) struct Rim {
    pub lattice: Lattice,
    /// Corners of the triangles, anticlockwise. Numbers of the region's corners come first, then
    /// numbers of the lattice's nodes, row by row.
    pub triangles: Vec<[u32; 3]>,
    /// Smallest angle of the triangles, without angles between two sides of the region, in rad.
    smallest_angle: f64,
}

impl Rim {
    /// Returns the rim of `region`, which lies between simple polygons; `None` if triangulation
    /// failed.
    ///
    /// The phases of the lattice are tried in descending order of their numbers of cells, until a
    /// phase leaves no sharp angle. If none does, the phase with the largest smallest angle is
    /// taken.
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

    /// Returns the rim of `lattice`, which is thinned while that may help.
    fn thinned(region: &Region, lattice: Lattice) -> Option<Self> {
        let mut best = Self::from_lattice(region, lattice)?;
        let mut rim = best.clone();
        for _ in 0..PASSES {
            if rim.smallest_angle >= SHARP || !rim.thin(region) {
                break;
            }
            rim = Self::from_lattice(region, rim.lattice)?;
            if rim.smallest_angle > best.smallest_angle {
                best = rim.clone();
            }
        }
        Some(best)
    }

    /// Returns the rim between `region` and `lattice`.
    fn from_lattice(region: &Region, lattice: Lattice) -> Option<Self> {
        let nodes: Vec<[usize; 2]> = lattice.nodes().collect();
        let triangles = triangulate(region, &lattice, &nodes)?;
        let mut rim = Self { lattice, triangles, smallest_angle: std::f64::consts::PI };
        let angles = rim.triangles.iter().map(|triangle| {
            let corners = triangle.map(|node| rim.position(region, &nodes, node));
            free_angle(region, *triangle, corners)
        });
        rim.smallest_angle = angles.fold(std::f64::consts::PI, f64::min);
        Some(rim)
    }

    /// Returns the position of `node`, a corner of `region` or a node of the lattice.
    fn position(&self, region: &Region, nodes: &[[usize; 2]], node: u32) -> [f64; 2] {
        let node = node as usize;
        match region.corners.get(node) {
            Some(corner) => *corner,
            None => self.lattice.position(nodes[node - region.corners.len()]),
        }
    }

    /// Drops from each sharp triangle its lattice node nearest to the outline, if that node is
    /// loose. Returns whether a node was dropped.
    fn thin(&mut self, region: &Region) -> bool {
        let nodes: Vec<[usize; 2]> = self.lattice.nodes().collect();
        let mut lost = Vec::new();
        for &triangle in &self.triangles {
            let corners = triangle.map(|node| self.position(region, &nodes, node));
            if free_angle(region, triangle, corners) >= SHARP {
                continue;
            }
            let corner_count = region.corners.len();
            let lattice_nodes =
                triangle.iter().filter_map(|&n| nodes.get((n as usize).wrapping_sub(corner_count)));
            let nearest = lattice_nodes
                .map(|&node| (self.lattice.clearance(node), node))
                .min_by(|a, b| a.0.total_cmp(&b.0));
            lost.extend(nearest.filter(|(clearance, _)| *clearance < LOOSE).map(|(_, node)| node));
        }
        lost.iter().for_each(|&node| self.lattice.drop_node(node));
        !lost.is_empty()
    }
}

/// Returns the angles at `corners`, the corners of a triangle, in rad.
pub(crate) fn angles(corners: [[f64; 2]; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let [next, last] =
            [(k + 1) % 3, (k + 2) % 3].map(|corner| difference(corners[corner], corners[k]));
        turning_angle(next, last)
    })
}

/// Returns the smallest angle of `triangle`, whose points are `corners`, in rad. An angle between
/// two sides of `region` does not count: no lattice can change it.
fn free_angle(region: &Region, triangle: [u32; 3], corners: [[f64; 2]; 3]) -> f64 {
    let angles = angles(corners);
    let free = (0..3).filter(|&k| {
        let (node, next, last) = (triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]);
        !(is_side(region, node, next) && is_side(region, last, node))
    });
    free.map(|k| angles[k]).fold(std::f64::consts::PI, f64::min)
}

/// Returns whether the line from `from` to `to` is a side of `region`.
fn is_side(region: &Region, from: u32, to: u32) -> bool {
    let (from, to) = (from as usize, to as usize);
    let count = region.corners.len();
    from < count && to < count && region.next(from) == to
}

/// Returns the triangles between the sides of `region` and the full cells of `lattice`, whose nodes
/// are `nodes`; `None` if triangulation failed.
fn triangulate(region: &Region, lattice: &Lattice, nodes: &[[usize; 2]]) -> Option<Vec<[u32; 3]>> {
    let number: BTreeMap<[usize; 2], usize> =
        nodes.iter().enumerate().map(|(k, &node)| (node, region.corners.len() + k)).collect();

    // Vertices are the corners, then the outer nodes. Nodes between four cells take no part.
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
    // Sides are directed so that the rim lies on the left.
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
    // Flood fill from the constraint edges, without crossing one.
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

/// Returns `triangle` with its lowest corner first.
fn lowest_first(triangle: [u32; 3]) -> [u32; 3] {
    let lowest = (0..3).min_by_key(|&k| triangle[k]).unwrap_or(0);
    [0, 1, 2].map(|k| triangle[(lowest + k) % 3])
}

/// Returns the nodes of `nodes` that do not lie between four full cells.
fn outer_nodes(lattice: &Lattice, nodes: &[[usize; 2]]) -> Vec<[usize; 2]> {
    let outer = nodes.iter().filter(|[column, row]| {
        let is_inner = *column > 0
            && *row > 0
            && [[0, 0], [1, 0], [1, 1], [0, 1]]
                .iter()
                .all(|[x, y]| lattice.is_full([column - x, row - y]));
        !is_inner
    });
    outer.copied().collect()
}

/// Returns the sides of full cells of `lattice` that belong to one cell only, with the cell on the
/// left.
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
