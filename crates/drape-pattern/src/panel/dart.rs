//! Darts: cloth that is cut out of a panel between two legs, which are sewn together.
//!
//! The legs of an open dart are edges of the outline, from its mouth to its tip. Those of a closed
//! one, which is pointed at both ends like the eye of a fish, are edges of a hole of the panel.

use crate::edge::{Edge, difference, distance};

/// Dart of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Dart {
    /// Name, by which its seam is called `PANEL.NAME`.
    pub name: String,
    /// Names of the edges of both legs, each from the mouth, or from one of the tips, to the tip.
    pub legs: [Vec<String>; 2],
    /// Edges of the hole of a closed dart, in a row; none of an open one.
    hole: Vec<Edge>,
}

/// Open dart that is to be cut into an edge.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenDart {
    /// Name.
    pub name: String,
    /// Distances of the ends of its mouth from the start of the edge, in m, ascending.
    pub mouth: [f64; 2],
    /// Its tip in the panel's frame, in m.
    pub tip: [f64; 2],
}

/// Words for the two legs.
const SIDES: [&str; 2] = ["left", "right"];

impl Dart {
    /// Returns a closed dart of two legs, the left one and the right one as seen on the way along them,
    /// each as edges from one tip to the other. The edges get the names `NAME left` and `NAME right`,
    /// with a number where a leg has several.
    ///
    /// ```
    /// use drape_pattern::{Dart, Edge, Panel};
    ///
    /// // 200 mm long and 24 mm wide, in a panel of 300 by 400 mm.
    /// let dart = Dart::diamond("waist", [[0.15, 0.3], [0.15, 0.1]], 0.024, 0.1);
    /// let corners = [[0.0, 0.0], [0.3, 0.0], [0.3, 0.4], [0.0, 0.4]];
    /// let edge = |k: usize| Edge::line(k.to_string(), corners[k], corners[(k + 1) % 4]);
    /// let panel = Panel::new("back", (0..4).map(edge).collect()).expect("it is simple");
    /// let panel = panel.with_darts(vec![dart]).expect("the dart is inside");
    /// assert!((panel.area() - (0.12 - 0.5 * 0.2 * 0.024)).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn closed(name: impl Into<String>, legs: [Vec<Edge>; 2]) -> Self {
        let name = name.into();
        let mut named = legs;
        for (leg, side) in named.iter_mut().zip(SIDES) {
            let several = leg.len() > 1;
            for (number, edge) in leg.iter_mut().enumerate() {
                edge.name = if several {
                    format!("{name} {side} {}", number + 1)
                } else {
                    format!("{name} {side}")
                };
            }
        }
        let names = named.each_ref().map(|leg| leg.iter().map(|edge| edge.name.clone()).collect());
        let [left, right] = named;
        let mut hole = left;
        hole.extend(right.iter().rev().map(Edge::reversed));
        // The cloth is on the left of all edges of a panel: a hole runs clockwise.
        if area(&hole) > 0.0 {
            hole = hole.iter().rev().map(Edge::reversed).collect();
        }
        Self { name, legs: names, hole }
    }

    /// Returns a closed dart with straight legs between two tips, as wide as a width in m at a distance
    /// from the first tip, in m.
    #[must_use]
    pub fn diamond(name: impl Into<String>, tips: [[f64; 2]; 2], width: f64, widest: f64) -> Self {
        let along = difference(tips[1], tips[0]);
        let length = distance(tips[0], tips[1]).max(f64::MIN_POSITIVE);
        let at = |side: f64| {
            [0, 1].map(|k| {
                let across = [-along[1], along[0]][k];
                tips[0][k] + (widest * along[k] + side * 0.5 * width * across) / length
            })
        };
        let leg = |side: f64| {
            let middle = at(side);
            vec![Edge::line("", tips[0], middle), Edge::line("", middle, tips[1])]
        };
        Self::closed(name, [leg(1.0), leg(-1.0)])
    }

    /// Returns an open dart, whose legs are edges of the outline.
    pub(crate) fn open(name: String, legs: [String; 2]) -> Self {
        Self { name, legs: legs.map(|leg| vec![leg]), hole: Vec::new() }
    }

    /// Edges of the hole of a closed dart, clockwise; none of an open one.
    #[must_use]
    pub fn hole(&self) -> &[Edge] {
        &self.hole
    }

    /// Returns the edges of the legs of a closed dart, each from one tip to the other.
    pub(crate) fn leg_edges(&self) -> [Vec<Edge>; 2] {
        let edge = |name: &String| self.hole.iter().find(|edge| edge.name == *name).cloned();
        let legs = self.legs.each_ref().map(|leg| leg.iter().filter_map(edge).collect());
        let [left, right]: [Vec<Edge>; 2] = legs;
        // One leg runs along the hole, the other one against it.
        let runs_back = |leg: &[Edge]| leg.windows(2).any(|two| two[0].start == two[1].end);
        let onward = |leg: Vec<Edge>, back: bool| {
            if back { leg.iter().map(Edge::reversed).collect() } else { leg }
        };
        let left_is_back = match (left.first(), right.first()) {
            _ if left.len() > 1 => runs_back(&left),
            _ if right.len() > 1 => !runs_back(&right),
            // Of two single edges either may be the one that runs back.
            _ => false,
        };
        [onward(left, left_is_back), onward(right, !left_is_back)]
    }

    /// Returns the dart with the edges of its hole changed by a function, and turned round where that
    /// reflects them.
    pub(crate) fn mapped(&self, reflects: bool, map: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let moved = self.hole.iter().map(|edge| edge.mapped(reflects, &map));
        let hole = if reflects {
            moved.rev().map(|edge| edge.reversed()).collect()
        } else {
            moved.collect()
        };
        Self { hole, ..self.clone() }
    }
}

/// Returns the area that edges in a row run round, positive if anticlockwise, in m².
fn area(edges: &[Edge]) -> f64 {
    edges.iter().map(Edge::area).sum()
}

impl OpenDart {
    /// Returns the legs, from one end of the mouth to the tip and from there to the other end.
    pub(crate) fn legs(&self, mouth: [[f64; 2]; 2]) -> [Edge; 2] {
        let names = SIDES.map(|side| format!("{} {side}", self.name));
        let [first, second] = names;
        [Edge::line(first, mouth[0], self.tip), Edge::line(second, self.tip, mouth[1])]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edge::Curve;

    #[test]
    fn legs_run_from_tip_to_tip_however_the_dart_is_made() {
        let tips = [[0.1, 0.3], [0.2, 0.1]];
        let curved = |bulge: f64| {
            vec![Edge::line("", tips[0], tips[1]).curved(Curve::Quadratic([0.15 + bulge, 0.2]))]
        };
        for legs in [
            Dart::diamond("d", tips, 0.02, 0.08).leg_edges(),
            [curved(0.02), curved(-0.02)],
            [curved(-0.02), curved(0.02)],
            [Dart::diamond("d", tips, 0.02, 0.08).leg_edges()[0].clone(), curved(-0.03)],
        ] {
            for flipped in [false, true] {
                let legs = if flipped { [legs[1].clone(), legs[0].clone()] } else { legs.clone() };
                let dart = Dart::closed("d", legs.clone());
                assert!(area(dart.hole()) < 0.0, "it runs clockwise");
                let next = dart.hole().iter().cycle().skip(1);
                assert!(dart.hole().iter().zip(next).all(|(edge, next)| edge.end == next.start));
                for turned in [dart.clone(), dart.mapped(true, |[x, y]| [-x, y])] {
                    assert!(area(turned.hole()) < 0.0);
                    let ends = |leg: &[Edge]| [leg[0].start, leg[leg.len() - 1].end];
                    let [one, other] = turned.leg_edges();
                    assert_eq!(ends(&one), ends(&other), "{:?}", turned.leg_edges());
                    assert!(
                        one.windows(2)
                            .chain(other.windows(2))
                            .all(|two| two[0].end == two[1].start)
                    );
                }
            }
        }
    }
}
