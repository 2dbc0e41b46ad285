//! Region of a triangulated panel in which a field is not below a level, as closed outlines.
//!
//! The field is linear in a triangle, so that the region's part of it is a polygon of corners and of
//! points where an edge crosses the level. Sides that two triangles share cancel, which leaves the
//! outline of the whole.

/// Panel, flat, with a field.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flat<'a> {
    /// Corners of the triangles, all anticlockwise.
    pub(super) triangles: &'a [[u32; 3]],
    /// Values at the vertices.
    pub(super) values: &'a [f64],
}

/// Point of an outline: a vertex, twice, or the point of an edge at the level, by its lower and its
/// higher end.
pub(super) type Node = [u32; 2];

/// Side of a polygon, from one point to the next.
type Side = [Node; 2];

impl Flat<'_> {
    /// Returns the outlines of the region: closed, with the region on their left.
    pub(super) fn outlines(&self, level: f64) -> Vec<Vec<Node>> {
        chained(uncancelled(self.sides(level)))
    }

    /// Returns the sides of the region's part of each triangle.
    fn sides(&self, level: f64) -> Vec<Side> {
        let is_in = |vertex: u32| self.values[vertex as usize] >= level;
        let mut sides = Vec::new();
        let mut polygon: Vec<Node> = Vec::with_capacity(5);
        for &[a, b, c] in self.triangles {
            polygon.clear();
            for [one, next] in [[a, b], [b, c], [c, a]] {
                if is_in(one) {
                    polygon.push([one, one]);
                }
                if is_in(one) != is_in(next) {
                    polygon.push([one.min(next), one.max(next)]);
                }
            }
            let next = polygon.iter().cycle().skip(1);
            sides.extend(polygon.iter().zip(next).map(|(one, next)| [*one, *next]));
        }
        sides
    }
}

/// Returns the sides that are not there in the other direction too.
fn uncancelled(mut sides: Vec<Side>) -> Vec<Side> {
    let undirected = |&[one, next]: &Side| [one.min(next), one.max(next)];
    sides.sort_unstable_by_key(undirected);
    let mut left = Vec::new();
    for same in sides.chunk_by(|one, other| undirected(one) == undirected(other)) {
        let forward = same.iter().filter(|side| **side == undirected(side)).count();
        let backward = same.len() - forward;
        let [one, next] = undirected(&same[0]);
        left.extend(std::iter::repeat_n([one, next], forward.saturating_sub(backward)));
        left.extend(std::iter::repeat_n([next, one], backward.saturating_sub(forward)));
    }
    left
}

/// Returns sides as closed outlines. As many sides lead to a point as away from it.
fn chained(mut sides: Vec<Side>) -> Vec<Vec<Node>> {
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
            let leading = (from..sides.len()).take_while(|&side| sides[side][0] == end);
            next = leading.into_iter().find(|&side| !is_used[side]);
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
    const SQUARE: Flat = Flat { triangles: &[[0, 1, 2], [2, 1, 3]], values: &[0.0, 1.0, 2.0, 3.0] };

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
        let mut outlines = Flat { triangles: &triangles, values: &values }.outlines(0.5);
        outlines.sort_by_key(Vec::len);
        assert_eq!(outlines.len(), 2);
        assert!(outlines.iter().all(|outline| outline.len() == 6), "{outlines:?}");
    }
}
