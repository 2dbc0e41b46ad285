//! Straight path of a law's deformation, cut into pieces with a linear weight of the friction.

use drape_hysteresis::{BlimanSorine, Loads, Response, Slip};

/// Straight path, cut at the deformations where the weight of the friction changes its slope.
pub(crate) struct Path {
    slips: [Slip; 4],
    count: usize,
}

impl Path {
    /// Returns the path between the deformations `from` and `to`, cut at up to three `knots` in
    /// rising order. `weight` is linear between the knots.
    pub(crate) fn new(from: f64, to: f64, knots: &[f64], weight: impl Fn(f64) -> f64) -> Self {
        debug_assert!(knots.len() <= 3);
        let mut path = Self { slips: [Slip::from(0.0); 4], count: 0 };
        let mut start = from;
        if to >= from {
            for &knot in knots.iter().filter(|&&k| k > from && k < to) {
                path.push(start, knot, &weight);
                start = knot;
            }
        } else {
            for &knot in knots.iter().rev().filter(|&&k| k < from && k > to) {
                path.push(start, knot, &weight);
                start = knot;
            }
        }
        path.push(start, to, &weight);
        path
    }

    /// Appends the piece from `start` to `end`.
    fn push(&mut self, start: f64, end: f64, weight: &impl Fn(f64) -> f64) {
        self.slips[self.count] = Slip::weighted(end - start, weight(start), weight(end));
        self.count += 1;
    }

    /// Returns the loads of `friction` at the end of the path, from `loads` at the start.
    pub(crate) fn advance(&self, friction: &BlimanSorine, loads: Loads) -> Loads {
        self.slips[..self.count].iter().fold(loads, |loads, slip| friction.advance(loads, *slip))
    }

    /// Returns the load of `friction` at the end of the path and its derivative with respect to the
    /// end, from `loads` at the start.
    pub(crate) fn respond(&self, friction: &BlimanSorine, loads: Loads) -> Response {
        let (last, earlier) = (self.slips[self.count - 1], &self.slips[..self.count - 1]);
        let loads = earlier.iter().fold(loads, |loads, slip| friction.advance(loads, *slip));
        friction.respond(loads, last)
    }

    /// Returns the work of `friction` over the path, from `loads` at the start.
    pub(crate) fn work(&self, friction: &BlimanSorine, loads: Loads) -> f64 {
        let mut loads = loads;
        let mut work = 0.0;
        for slip in &self.slips[..self.count] {
            work += friction.work(loads, *slip);
            loads = friction.advance(loads, *slip);
        }
        work
    }
}
