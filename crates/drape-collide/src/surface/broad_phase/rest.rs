//! Pairs that lie close at rest.

use super::query::{PairLimit, PairQuery};
use super::scan::PairScan;
use crate::error::Error;
use crate::surface::geometry::{ContactDistances, Primitives, RestProximity, Separations};
use crate::vector::Vector;

/// Largest number of pairs that lie close at rest.
///
/// More pairs are a mistake of the input, and would take gigabytes.
const CAPACITY: usize = 50_000_000;

/// Smallest minimum separation of a pair that lies close at rest, in m. It is a thousand times the
/// rounding of coordinates of 1 m, and far below any cloth.
const LEAST: f64 = 1e-9;

/// Returns a displacement for each group, in m, that lays the groups out side by side in a cubic
/// grid.
///
/// The panels of a garment all lie about the origin at rest. In one place, the search would meet
/// every two of them.
fn group_offsets(
    primitives: &Primitives,
    separations: &Separations,
    rest_positions: &[f64],
) -> Vec<Vector> {
    let group_count = separations.groups.len();
    let mut bounds = vec![[[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]]; group_count];
    for (vertex, point) in rest_positions.as_chunks::<3>().0.iter().enumerate() {
        let [low, high] = &mut bounds[primitives.group(vertex as u32) as usize];
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }

    // A cell has room for the largest group, and for the margins of the boxes on both sides.
    let reach = separations.groups.iter().map(|group| group.activation_distance);
    let margin = 8.0 * reach.fold(0.0, f64::max);
    let sizes = [0, 1, 2].map(|axis| {
        let extents = bounds.iter().map(|[low, high]| high[axis] - low[axis]);
        extents.fold(0.0, f64::max) + margin
    });

    let side = (1..).find(|side| side * side * side >= group_count).unwrap_or(1);
    let offset = |(number, [low, _]): (usize, &[Vector; 2])| {
        let cell = [number % side, number / side % side, number / (side * side)];
        // A group without vertices has no place.
        let place = |axis: usize| cell[axis] as f64 * sizes[axis] - low[axis];
        if low[0] > f64::MAX { [0.0; 3] } else { [0, 1, 2].map(place) }
    };
    bounds.iter().enumerate().map(offset).collect()
}

/// Returns the pairs within a group whose distance at `rest_positions` is below twice their
/// activation distance, sorted.
///
/// Their activation distance is at most half of their distance at rest, so a fine mesh does not
/// repel itself. Their minimum separation is at most a quarter of it.
pub(crate) fn close_at_rest(
    primitives: &Primitives,
    separations: &Separations,
    rest_positions: &[f64],
) -> Result<Vec<RestProximity>, Error> {
    let offsets = group_offsets(primitives, separations, rest_positions);
    let query = PairQuery {
        primitives,
        separations,
        positions: rest_positions,
        limit: PairLimit::Rest { offsets: &offsets },
        mean_displacement: [0.0; 3],
    };
    let mut scan = PairScan::default();
    scan.run(&query, CAPACITY, false)?;

    let mut close = Vec::new();
    for pair in scan.pairs().flatten() {
        let activation_distance = pair.activation_distance.min(0.5 * pair.distance);
        let min_separation = pair.min_separation.min(0.25 * pair.distance);
        // A separation of NaN fails the comparison.
        if !(min_separation >= LEAST) {
            return Err(Error::ContactAtRest {
                vertices: pair.vertices,
                distance: pair.distance,
                least: 4.0 * LEAST,
            });
        }
        let distances = ContactDistances { activation_distance, min_separation };
        close.push(RestProximity { key: pair.key(), distances });
    }
    Ok(close)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::broad_phase::tree::Bounds;
    use crate::surface::geometry::SurfaceParts;

    /// Returns `count` squares of 3 × 3 vertices, 1 mm apart, that lie in one place at rest.
    fn squares(count: u32) -> SurfaceParts {
        let distances = ContactDistances { activation_distance: 1e-3, min_separation: 1e-4 };
        let mut parts = SurfaceParts {
            distances: vec![distances; count as usize],
            free_vertices: 9 * count as usize,
            ..SurfaceParts::default()
        };
        for group in 0..count {
            for vertex in 0..9_u32 {
                let [x, y] = [vertex % 3, vertex / 3].map(|step| 1e-3 * f64::from(step) - 2e-3);
                parts.rest_positions.extend([x, y, 0.0]);
            }
            parts.areas.extend([1e-6; 9]);
            parts.groups.extend([group; 9]);
            for corner in [0, 1, 3, 4].map(|corner| 9 * group + corner) {
                parts.triangles.push([corner, corner + 1, corner + 4]);
                parts.triangles.push([corner, corner + 4, corner + 3]);
            }
        }
        parts
    }

    /// Returns the boxes of the triangles of `parts` in the search, with their groups, and the
    /// pairs that are found.
    fn searched(parts: SurfaceParts) -> (Vec<(u32, Bounds)>, Vec<RestProximity>) {
        let positions = parts.rest_positions.clone();
        let separations = Separations::new(parts.distances.clone());
        let primitives = Primitives::new(parts).expect("the squares are sound");
        let offsets = group_offsets(&primitives, &separations, &positions);
        let query = PairQuery {
            primitives: &primitives,
            separations: &separations,
            positions: &positions,
            limit: PairLimit::Rest { offsets: &offsets },
            mean_displacement: [0.0; 3],
        };
        let triangles = primitives.triangles.iter();
        let boxes = triangles.map(|&corners| (primitives.group(corners[0]), query.bounds(corners)));
        let close = close_at_rest(&primitives, &separations, &positions);
        (boxes.collect(), close.expect("no two primitives touch"))
    }

    #[test]
    fn groups_in_one_place_at_rest_do_not_meet_in_the_search() {
        let (_, alone) = searched(squares(1));
        assert!(!alone.is_empty());
        for count in [2, 7, 8, 9, 28] {
            let (boxes, close) = searched(squares(count));
            let meetings = boxes.iter().enumerate().flat_map(|(k, one)| {
                let others = boxes[..k].iter().filter(|other| one.0 != other.0);
                others.filter(|other| one.1.overlaps(&other.1))
            });
            assert_eq!(meetings.count(), 0, "{count} groups");
            assert_eq!(close.len(), count as usize * alone.len(), "{count} groups");
        }
    }
}
