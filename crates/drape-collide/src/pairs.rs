use crate::course::{Sweep, nearest};
use crate::pair::Pair;
use std::ops::Range;

/// A sorted list of all pairs that were near each other at some positions or on a course from
/// there.
///
/// As long as no vertex is farther than half of the margin from the course, no other pair is within
/// its activation_distance.
#[derive(Debug, Clone, Default)]
pub struct CandidatePairs {
    list: Vec<Pair>,
    /// The place on the course that is looked at, of each vertex.
    positions: Vec<f64>,
    pub(crate) margin: f64,
    pub(crate) free: usize,
    /// Where the course starts, and the ways; both empty if there is none.
    start: Vec<f64>,
    ways: Vec<f64>,
    together: bool,
}

impl CandidatePairs {
    /// The pairs, sorted by kind and features.
    pub fn as_slice(&self) -> &[Pair] {
        &self.list
    }

    /// The flat positions at which they were detected, in m; of pairs along a course, the place on
    /// it that was followed last.
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// By how much each pair's distance could exceed its activation_distance, in m.
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Takes on other pairs.
    pub(crate) fn replace<'a>(
        &mut self,
        found: impl Iterator<Item = &'a [Pair]>,
        (positions, course): (&[f64], Sweep<'_>),
        (margin, free): (f64, usize),
    ) {
        self.list.clear();
        found.for_each(|pairs| self.list.extend_from_slice(pairs));
        let fill = |own: &mut Vec<f64>, from: &[f64]| {
            own.clear();
            own.extend_from_slice(from);
        };
        fill(&mut self.positions, positions);
        let ways = course.ways().unwrap_or_default();
        fill(&mut self.start, if ways.is_empty() { &[] } else { positions });
        fill(&mut self.ways, ways);
        self.together = matches!(course, Sweep::Common(_));
        (self.margin, self.free) = (margin, free);
    }

    /// Moves on the course to where it comes nearest to flat positions.
    pub(crate) fn follow(&mut self, places: &[f64]) {
        let count = self.ways.len();
        if count == 0 || places.len() != count {
            return;
        }
        for own in self.parts() {
            let (start, way) = (&self.start[own.clone()], &self.ways[own.clone()]);
            let gone = places[own.clone()].iter().zip(start).map(|(place, start)| place - start);
            let share = nearest(way.iter().zip(gone).map(|(way, gone)| [*way, gone]));
            for ((position, start), way) in self.positions[own].iter_mut().zip(start).zip(way) {
                *position = start + share * way;
            }
        }
    }

    /// Fills in what of displacements from near the place that is followed leads off the course, in
    /// m, if all vertices go the same share of theirs or else each its own.
    pub(crate) fn astray(&self, displacements: &[f64], together: bool, rest: &mut Vec<f64>) {
        rest.clear();
        rest.extend_from_slice(displacements);
        if self.ways.len() != displacements.len() || (self.together && !together) {
            return;
        }
        for own in self.parts() {
            // What is left of the way.
            let ahead = |k: usize| self.start[k] + self.ways[k] - self.positions[k];
            let share = nearest(own.clone().map(|k| [ahead(k), displacements[k]]));
            for k in own {
                rest[k] -= share * ahead(k);
            }
        }
    }

    /// Components that go the same share of their ways.
    fn parts(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        let count = self.ways.len();
        let part = if self.together { count.max(1) } else { 3 };
        (0..count).step_by(part).map(move |first| first..first + part)
    }
}
