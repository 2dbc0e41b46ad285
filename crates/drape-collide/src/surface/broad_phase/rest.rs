//! Pairs that lie close at rest.

use super::query::{Limit, Query};
use super::scan::Scan;
use crate::error::Error;
use crate::surface::geometry::{ContactDistances, Primitives, RestProximity, Separations};

/// Largest number of pairs that lie close at rest.
///
/// More than this is a mistake of the input, and would take gigabytes.
const CAPACITY: usize = 50_000_000;

/// Smallest minimum separation of a pair that lies close at rest, in m: a thousand times the
/// rounding of coordinates of 1 m, and far below any cloth.
const LEAST: f64 = 1e-9;

/// Returns the pairs of a group that lie within twice their activation distance at rest, sorted.
///
/// Their activation distance is at most half of their distance at rest, so a fine mesh does not
/// repel itself, and their minimum separation at most a quarter.
pub(crate) fn close_at_rest(
    primitives: &Primitives,
    separations: &Separations,
    rest_positions: &[f64],
) -> Result<Vec<RestProximity>, Error> {
    let query = Query {
        primitives,
        separations,
        positions: rest_positions,
        limit: Limit::Rest,
        mean_displacement: [0.0; 3],
    };
    let mut scan = Scan::default();
    scan.run(&query, CAPACITY, false)?;
    let mut close = Vec::new();
    for pair in scan.pairs().flatten() {
        let activation_distance = pair.activation_distance.min(0.5 * pair.distance);
        let min_separation = pair.min_separation.min(0.25 * pair.distance);
        // NaN fails.
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
