//! Pairs that lie close at rest.

use super::query::{PairLimit, PairQuery};
use super::scan::PairScan;
use crate::error::Error;
use crate::surface::geometry::{ContactDistances, Primitives, RestProximity, Separations};

/// Largest number of pairs that lie close at rest.
///
/// More pairs are a mistake of the input, and would take gigabytes.
const CAPACITY: usize = 50_000_000;

/// Smallest minimum separation of a pair that lies close at rest, in m. It is a thousand times the
/// rounding of coordinates of 1 m, and far below any cloth.
const LEAST: f64 = 1e-9;

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
    let query = PairQuery {
        primitives,
        separations,
        positions: rest_positions,
        limit: PairLimit::Rest,
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
