//! Intersections of a triangulation with itself, exactly.

use crate::mesh_io::Triangulation;
use crate::surface::segment_meets_triangle;
use crate::vector::Vector;

use super::edges::Edges;

/// Side of a cell of the grid, over the median length of an edge.
const CELL: f64 = 2.0;

/// Largest number of cells of a box; a triangle that is larger fills a coarser grid.
const CELLS_MAX: f64 = 4096.0;

/// Returns the middles of the edges that meet a triangle with which they share no vertex, in the
/// order of the edges.
///
/// Touching counts. Edges and triangles are compared that share a cell of a grid.
pub(crate) fn intersections(mesh: &Triangulation, edges: &Edges, edge_length: f64) -> Vec<Vector> {
    let point = |vertex: u32| mesh.vertices[vertex as usize];
    let mut cell = CELL * edge_length;
    let largest =
        mesh.triangles.iter().map(|t| Bounds::around(&t.map(point)).size()).fold(0.0, f64::max);
    cell = cell.max(largest / CELLS_MAX.cbrt());
    if !(cell > 0.0 && cell.is_finite()) {
        return Vec::new();
    }
    let mut entries: Vec<([i64; 3], u32)> = Vec::new();
    for (number, triangle) in mesh.triangles.iter().enumerate() {
        let cells = Bounds::around(&triangle.map(point)).cells(cell);
        entries.extend(cells.map(|key| (key, number as u32)));
    }
    entries.sort_unstable();
    let meets = |[a, b]: [u32; 2]| {
        let segment = [point(a), point(b)];
        let own = Bounds::around(&segment);
        own.cells(cell).any(|key| {
            let first = entries.partition_point(|entry| entry.0 < key);
            let here = entries[first..].iter().take_while(|entry| entry.0 == key);
            here.map(|entry| mesh.triangles[entry.1 as usize]).any(|triangle| {
                !triangle.contains(&a)
                    && !triangle.contains(&b)
                    && own.meets(&Bounds::around(&triangle.map(point)))
                    && segment_meets_triangle(segment, triangle.map(point))
            })
        })
    };
    let middle = |[a, b]: [u32; 2]| {
        let (a, b) = (point(a), point(b));
        std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]))
    };
    edges.iter().map(|(edge, _)| edge).filter(|edge| meets(*edge)).map(middle).collect()
}

/// Box around points.
struct Bounds {
    low: Vector,
    high: Vector,
}

impl Bounds {
    fn around(points: &[Vector]) -> Bounds {
        let fold = |start: f64, pick: fn(f64, f64) -> f64| -> Vector {
            std::array::from_fn(|axis| points.iter().map(|p| p[axis]).fold(start, pick))
        };
        Bounds { low: fold(f64::INFINITY, f64::min), high: fold(f64::NEG_INFINITY, f64::max) }
    }

    fn size(&self) -> f64 {
        (0..3).map(|axis| self.high[axis] - self.low[axis]).fold(0.0, f64::max)
    }

    fn meets(&self, other: &Bounds) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }

    /// Returns the cells of a grid that the box meets.
    fn cells(&self, cell: f64) -> impl Iterator<Item = [i64; 3]> + use<> {
        let number = |value: f64| (value / cell).floor() as i64;
        let (low, high) = (self.low.map(number), self.high.map(number));
        (low[0]..=high[0]).flat_map(move |x| {
            (low[1]..=high[1]).flat_map(move |y| (low[2]..=high[2]).map(move |z| [x, y, z]))
        })
    }
}
