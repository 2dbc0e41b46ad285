//! Self-intersections of a triangulation, by an exact test.

use crate::mesh_io::Triangulation;
use crate::surface::segment_meets_triangle;
use crate::vector::{Vector, bounds, midpoint};

use super::edges::Edges;

/// Side of a cell of the grid, over the median length of an edge.
const CELL: f64 = 2.0;

/// Largest number of cells that one triangle may cover. Larger triangles make the grid coarser.
const CELLS_MAX: f64 = 4096.0;

/// Returns the middles of the edges of `mesh` that meet a triangle without a common vertex, in the
/// order of `edges`.
///
/// Touching counts. Only edges and triangles that share a cell of a grid are compared.
/// `edge_length` is the median length of the edges, in m.
pub(crate) fn intersections(mesh: &Triangulation, edges: &Edges, edge_length: f64) -> Vec<Vector> {
    let boxes: Vec<Bounds> =
        mesh.triangles.iter().map(|t| Bounds::around(&mesh.corners(*t))).collect();
    let largest = boxes.iter().map(Bounds::size).fold(0.0, f64::max);
    let cell = (CELL * edge_length).max(largest / CELLS_MAX.cbrt());
    if !(cell > 0.0 && cell.is_finite()) {
        return Vec::new();
    }

    // Cells of the grid with the triangles that cover them, sorted by cell.
    let mut entries: Vec<([i64; 3], u32)> = Vec::new();
    for (number, triangle_box) in boxes.iter().enumerate() {
        entries.extend(triangle_box.cells(cell).map(|key| (key, number as u32)));
    }
    entries.sort_unstable();

    let mut middles = Vec::new();
    for ([a, b], _) in edges.iter() {
        let segment = [mesh.point(a), mesh.point(b)];
        let segment_box = Bounds::around(&segment);
        let meets_triangle = segment_box.cells(cell).any(|key| {
            let first = entries.partition_point(|entry| entry.0 < key);
            let here = entries[first..].iter().take_while(|entry| entry.0 == key);
            here.map(|entry| entry.1 as usize).any(|number| {
                let triangle = mesh.triangles[number];
                !triangle.contains(&a)
                    && !triangle.contains(&b)
                    && segment_box.meets(&boxes[number])
                    && segment_meets_triangle(segment, mesh.corners(triangle))
            })
        });
        if meets_triangle {
            middles.push(midpoint(segment[0], segment[1]));
        }
    }
    middles
}

/// Box around points.
struct Bounds {
    low: Vector,
    high: Vector,
}

impl Bounds {
    fn around(points: &[Vector]) -> Bounds {
        let [low, high] = bounds(points.iter());
        Bounds { low, high }
    }

    /// Returns the largest extent along an axis, in m.
    fn size(&self) -> f64 {
        (0..3).map(|axis| self.high[axis] - self.low[axis]).fold(0.0, f64::max)
    }

    /// Returns whether this box and `other` have a common point.
    fn meets(&self, other: &Bounds) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Returns the cells that the box covers in a grid whose cells have the side `cell`, in m.
    fn cells(&self, cell: f64) -> impl Iterator<Item = [i64; 3]> + use<> {
        let [low, high] =
            [self.low, self.high].map(|corner| corner.map(|value| (value / cell).floor() as i64));
        (low[0]..=high[0]).flat_map(move |x| {
            (low[1]..=high[1]).flat_map(move |y| (low[2]..=high[2]).map(move |z| [x, y, z]))
        })
    }
}
