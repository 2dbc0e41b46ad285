//! Region of a triangulated panel in which a field is not below a level, as closed outlines.
//!
//! The field is linear in a triangle. The part of the region in a triangle is therefore a polygon
//! of corners and of points where an edge crosses the level. Sides that two triangles share cancel,
//! which leaves the outline of the region.

/// Field on a flat panel.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlatField<'a> {
    /// Corners of the triangles, all anticlockwise.
    pub(super) triangles: &'a [[u32; 3]],
    /// Values at the vertices.
    pub(super) values: &'a [f64],
}

/// Point of an outline. A vertex is given twice. A point of an edge at the level is given by the
/// vertex with the lower number and the vertex with the higher number.
pub(super) type Node = [u32; 2];

/// Side of a polygon, from one point to the next.
type Side = [Node; 2];

impl FlatField<'_> {
    /// Returns the outlines of the region in which the field is at least `level`: closed, with the
    /// region on their left.
    pub(super) fn outlines(&self, level: f64) -> Vec<Vec<Node>> {
        chained(uncancelled(self.sides(level)))
    }

    /// Returns the sides of the part of the region above `level` in each triangle.
    fn sides(&self, level: f64) -> Vec<Side> {
        let mut sides = Vec::new();
        let mut polygon: Vec<Node> = Vec::with_capacity(5);
        for &[a, b, c] in self.triangles {
            polygon.clear();
            for [vertex, next] in [[a, b], [b, c], [c, a]] {
                let [is_in, is_next_in] =
                    [vertex, next].map(|vertex| self.values[vertex as usize] >= level);
                if is_in {
                    polygon.push([vertex, vertex]);
                }
                if is_in != is_next_in {
                    polygon.push([vertex.min(next), vertex.max(next)]);
                }
            }
            let next = polygon.iter().cycle().skip(1);
            sides.extend(polygon.iter().zip(next).map(|(node, next)| [*node, *next]));
        }
        sides
    }
}

/// Returns the `sides` that do not cancel with sides in the opposite direction.
fn uncancelled(mut sides: Vec<Side>) -> Vec<Side> {
    sides.sort_unstable_by_key(undirected);
    let mut remaining = Vec::new();
    for equal in sides.chunk_by(|a, b| undirected(a) == undirected(b)) {
        let forward = equal.iter().filter(|side| **side == undirected(side)).count();
        let backward = equal.len() - forward;
        let [start, end] = undirected(&equal[0]);
        remaining.extend(std::iter::repeat_n([start, end], forward.saturating_sub(backward)));
        remaining.extend(std::iter::repeat_n([end, start], backward.saturating_sub(forward)));
    }
    remaining
}

/// Returns a side from its lower to its higher node.
fn undirected(&[start, end]: &Side) -> Side {
    [start.min(end), start.max(end)]
}

/// Returns `sides` as closed outlines. At each point the same number of sides begins and ends.
fn chained(mut sides: Vec<Side>) -> Vec<Vec<Node>> {
    // In sorted order the sides that begin at a point are found by bisection.
    sides.sort_unstable();
    let mut is_used = vec![false; sides.len()];
    let mut outlines = Vec::new();
    for first in 0..sides.len() {
        let mut outline = Vec::new();
        let mut next = Some(first).filter(|side| !is_used[*side]);
        while let Some(side) = next {
            is_used[side] = true;
            outline.push(sides[side][0]);
            let end = sides[side][1];
            let from = sides.partition_point(|[start, _]| *start < end);
            next = (from..sides.len())
                .take_while(|&side| sides[side][0] == end)
                .find(|&side| !is_used[side]);
        }
        if outline.len() > 2 {
            outlines.push(outline);
        }
    }
    outlines
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles of a square, with the values 0, 1, 2, 3 at its corners.
    const SQUARE: FlatField =
        FlatField { triangles: &[[0, 1, 2], [2, 1, 3]], values: &[0.0, 1.0, 2.0, 3.0] };

    #[test]
    fn below_all_values_the_region_is_the_panel() {
        assert_eq!(SQUARE.outlines(-1.0), [[[0, 0], [1, 1], [3, 3], [2, 2]]]);
        assert!(SQUARE.outlines(3.5).is_empty());
    }

    #[test]
    fn a_level_cuts_edges_and_the_shared_side_is_gone() {
        let outlines = SQUARE.outlines(1.5);
        assert_eq!(outlines, [[[0, 2], [1, 2], [1, 3], [3, 3], [2, 2]]]);
    }

    #[test]
    fn a_hole_is_an_outline_of_its_own() {
        // A fan around a vertex that is low.
        let rim = 1..=6_u32;
        let triangles: Vec<[u32; 3]> = rim.map(|k| [0, k, k % 6 + 1]).collect();
        let values = [0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
        let mut outlines = FlatField { triangles: &triangles, values: &values }.outlines(0.5);
        outlines.sort_by_key(Vec::len);
        assert_eq!(outlines.len(), 2);
        assert!(outlines.iter().all(|outline| outline.len() == 6), "{outlines:?}");
    }
}
