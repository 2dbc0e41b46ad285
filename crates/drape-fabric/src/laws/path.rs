//! Straight path of a law's deformation, in pieces along which the weight of the friction is linear.

use drape_hysteresis::{BlimanSorine, Loads, Response, Slip};

/// Straight path, cut where the weight of the friction changes its slope.
pub(crate) struct Path {
    slips: [Slip; 4],
    count: usize,
}

impl Path {
    /// Cuts the path between two deformations at up to three knots, given in rising order, between
    /// which `weight` is linear.
    pub(crate) fn new(from: f64, to: f64, knots: &[f64], weight: impl Fn(f64) -> f64) -> Self {
        debug_assert!(knots.len() <= 3);
        let mut path = Self { slips: [Slip::from(0.0); 4], count: 0 };
        let mut at = from;
        let mut push = |at: &mut f64, end: f64| {
            path.slips[path.count] = Slip::weighted(end - *at, weight(*at), weight(end));
            path.count += 1;
            *at = end;
        };
        if to >= from {
            for &knot in knots.iter().filter(|&&k| k > from && k < to) {
                push(&mut at, knot);
            }
        } else {
            for &knot in knots.iter().rev().filter(|&&k| k < from && k > to) {
                push(&mut at, knot);
            }
        }
        push(&mut at, to);
        path
    }

    /// Returns the friction loads at the end of the path.
    pub(crate) fn advance(&self, friction: &BlimanSorine, loads: Loads) -> Loads {
        self.slips[..self.count].iter().fold(loads, |loads, slip| friction.advance(loads, *slip))
    }

    /// Returns the friction load at the end and its derivative with respect to the end.
    pub(crate) fn respond(&self, friction: &BlimanSorine, loads: Loads) -> Response {
        let (last, before) = (self.slips[self.count - 1], &self.slips[..self.count - 1]);
        let loads = before.iter().fold(loads, |loads, slip| friction.advance(loads, *slip));
        friction.respond(loads, last)
    }

    /// Returns the work of the friction over the path.
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
