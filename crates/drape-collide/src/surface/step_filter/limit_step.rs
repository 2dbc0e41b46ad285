//! How far a step of surfaces may go.

use crate::course::Sweep;
use crate::error::Error;
use crate::filter::BUDGET;
use crate::surface_contact::SurfaceContact;
use crate::vector::{at, norm, scale};

/// Longest way of a step over the length of an edge, of all vertices alike and of each by itself: the list of pairs that
/// can meet on longer ones costs more than to go twice.
const LONGEST: [f64; 2] = [4.0, 0.5];

/// Share of a step below which it is shortened vertex by vertex and not as a whole. What is one step for all keeps
/// going downhill, but one near pair then stops everything.
const LOCKED: f64 = 0.2;

/// The longest ways of a step for edges of a length and the distance at which surfaces push, in m; see [`LONGEST`].
pub(crate) fn longest_ways(edge: f64, activation_distance: f64) -> [f64; 2] {
    LONGEST.map(|edges| (edges * edge).max(activation_distance))
}

/// A step that a solver is about to take, of the free vertices and of the bodies.
#[derive(Debug)]
pub struct SurfaceStep<'a> {
    /// Positions of the free vertices, in m.
    pub from: &'a [f64],
    /// Their displacements, in m.
    pub displacements: &'a mut [f64],
    /// The free vertices that move by prescription, as the bodies do.
    pub held: &'a [usize],
    /// Fraction of the bodies' motion in the open step that is done, from 0 to 1.
    pub progress: f64,
    /// Fraction of it that the step adds.
    pub advance: &'a mut f64,
}

impl SurfaceContact {
    /// Shortens a step of the free vertices, and of the bodies that go so much of their way along, to what keeps every
    /// pair apart; says whether it is still the whole one.
    ///
    /// The step is shortened for all vertices alike or, where that would leave little of it, vertex by vertex. The
    /// bodies and the free vertices that are held go a common share of their way.
    pub fn limit_step(&mut self, step: SurfaceStep<'_>) -> bool {
        let SurfaceStep { from, displacements: step, held, progress, advance } = step;
        if !self.filter.guards.filter {
            return true;
        }
        let places = self.all(from, progress);
        let [start, end] = &self.bodies;
        let mut moves = step.to_vec();
        moves.extend(start.iter().zip(end).map(|(start, end)| *advance * (end - start)));
        let shared = self.shorten(&places, &mut moves, held);
        let Ok(share) = shared.map_err(|failure| self.failure = Some(failure)) else {
            // Nothing is known to be safe.
            step.fill(0.0);
            *advance = 0.0;
            return false;
        };
        if share.is_some() {
            step.copy_from_slice(&moves[..step.len()]);
        }
        *advance *= share.unwrap_or(1.0);
        share.is_none()
    }

    /// Shortens the ways of all vertices. Returns the share of theirs that bodies and held vertices go, none if all go
    /// the whole way.
    fn shorten(
        &mut self,
        places: &[f64],
        moves: &mut [f64],
        held: &[usize],
    ) -> Result<Option<f64>, Error> {
        let whole = moves.to_vec();
        let shared = self.cover(places, moves, true)?;
        let fraction = self.filter.common_fraction(self.detector.pairs(), places, moves)?.value;
        if fraction >= 1.0 {
            return Ok((shared < 1.0).then_some(shared));
        }
        if fraction >= LOCKED {
            moves.iter_mut().for_each(|way| *way *= fraction);
            return Ok(Some(shared * fraction));
        }
        moves.copy_from_slice(&whole);
        self.cover(places, moves, false)?;
        self.filter.truncate(self.detector.pairs(), places, moves)?;
        let free = 3 * self.surface.free_count();
        let went = |vertex: usize| {
            let [after, before] = [norm(at(moves, vertex)), norm(at(&whole, vertex))];
            if before > 0.0 { after / before } else { 1.0 }
        };
        let bodies = self.surface.free_count()..moves.len() / 3;
        let share = held.iter().copied().chain(bodies).map(went).fold(1.0, f64::min);
        // Less of a safe way is safe too.
        let prescribed = held.iter().flat_map(|vertex| 3 * vertex..3 * vertex + 3);
        for k in prescribed.chain(free..moves.len()) {
            moves[k] = share * whole[k];
        }
        Ok(Some(share))
    }

    /// Detects the pairs that can meet on the ways of all vertices, if those at hand do not do. Shortens ways that are
    /// too long for that, together or each by itself; returns the share that is left of the longest.
    fn cover(&mut self, places: &[f64], moves: &mut [f64], together: bool) -> Result<f64, Error> {
        let farthest = longest(moves);
        let most = self.longest[usize::from(!together)];
        let share = if farthest > most { most / farthest } else { 1.0 };
        for way in moves.as_chunks_mut::<3>().0 {
            let share = if together { share } else { (most / norm(*way)).min(1.0) };
            *way = scale(*way, share);
        }
        self.detector.follow(places);
        self.detector.pairs().astray(moves, together, &mut self.astray);
        let farthest = longest(&self.astray);
        // Written so that NaN detects anew.
        let near = self.stray(places) + farthest <= BUDGET * self.detector.pairs().margin();
        if !near && self.filter.guards.cover {
            let course = if together { Sweep::Common(moves) } else { Sweep::Individual(moves) };
            self.detect(places, course)?;
        }
        Ok(share)
    }
}

/// The longest of some flat ways.
fn longest(ways: &[f64]) -> f64 {
    ways.as_chunks::<3>().0.iter().map(|way| norm(*way)).fold(0.0, f64::max)
}
