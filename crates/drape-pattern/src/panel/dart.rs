//! Darts: cloth that is cut out of a panel between two legs, which are sewn together.
//!
//! The legs of an open dart are edges of the outline, from its mouth to its tip. A closed dart is
//! pointed at both ends like the eye of a fish. Its legs are edges of a hole of the panel.

use crate::edge::{Edge, difference, distance};
use crate::mistake::Mistake;

/// Dart of a panel.
#[derive(Debug, Clone, PartialEq)]
pub struct Dart {
    /// Name of the dart. Its seam is called `PANEL.NAME`.
    pub name: String,
    /// Names of the edges of both legs, each leg from the mouth, or from the first tip, to the tip.
    pub legs: [Vec<String>; 2],
    /// Edges of the hole of a closed dart, in a row; none of an open dart.
    hole: Vec<Edge>,
    /// Whether the edges of the left leg run from the second tip to the first in `hole`. The edges
    /// of the right leg run in the opposite direction.
    left_runs_back: bool,
}

/// Open dart, before it is cut into an edge.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenDart {
    /// Name.
    pub name: String,
    /// Distances of the ends of its mouth from the start of the edge, in m, ascending.
    pub mouth: [f64; 2],
    /// Tip in the frame of the panel, in m.
    pub tip: [f64; 2],
}

/// Words for the two legs.
const SIDES: [&str; 2] = ["left", "right"];

impl Dart {
    /// Returns the closed dart `name` with the edges of its left and its right leg, as seen from
    /// the first tip towards the second. Each leg runs from the first tip to the second. The edges
    /// get the names `NAME left` and `NAME right`, with a number if a leg has several edges.
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
            let has_several = leg.len() > 1;
            for (number, edge) in leg.iter_mut().enumerate() {
                edge.name = if has_several {
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
        let left_runs_back = hole.iter().map(Edge::area).sum::<f64>() > 0.0;
        if left_runs_back {
            hole = hole.iter().rev().map(Edge::reversed).collect();
        }
        Self { name, legs: names, hole, left_runs_back }
    }

    /// Returns the closed dart `name` with straight legs between `tips`. It has its greatest width
    /// `width`, in m, at the distance `widest` from the first tip, in m.
    #[must_use]
    pub fn diamond(name: impl Into<String>, tips: [[f64; 2]; 2], width: f64, widest: f64) -> Self {
        let along = difference(tips[1], tips[0]);
        let length = distance(tips[0], tips[1]).max(f64::MIN_POSITIVE);
        let legs = [1.0, -1.0].map(|side| {
            let middle = [0, 1].map(|k| {
                let across = [-along[1], along[0]][k];
                tips[0][k] + (widest * along[k] + side * 0.5 * width * across) / length
            });
            vec![Edge::line("", tips[0], middle), Edge::line("", middle, tips[1])]
        });
        Self::closed(name, legs)
    }

    /// Returns the open dart `name`, whose `legs` are names of edges of the outline.
    pub(crate) fn open(name: String, legs: [String; 2]) -> Self {
        let legs = legs.map(|leg| vec![leg]);
        Self { name, legs, hole: Vec::new(), left_runs_back: false }
    }

    /// Edges of the hole of a closed dart, clockwise; none of an open dart.
    #[must_use]
    pub fn hole(&self) -> &[Edge] {
        &self.hole
    }

    /// Returns the edges of the left and the right leg of a closed dart, each leg from the first
    /// tip to the second.
    pub(crate) fn leg_edges(&self) -> [Vec<Edge>; 2] {
        [(0, self.left_runs_back), (1, !self.left_runs_back)].map(|(leg, runs_back)| {
            let names = self.legs[leg].iter();
            let edges = names.filter_map(|name| self.hole.iter().find(|edge| edge.name == *name));
            edges.map(|edge| if runs_back { edge.reversed() } else { edge.clone() }).collect()
        })
    }

    /// Returns the dart with the points of its hole mapped by the isometry `map`, a reflection if
    /// `reflects`. A reflected hole is turned round, so that it runs clockwise.
    pub(crate) fn mapped(&self, reflects: bool, map: impl Fn([f64; 2]) -> [f64; 2]) -> Self {
        let edges = self.hole.iter().map(|edge| edge.mapped(reflects, &map));
        let hole = if reflects {
            edges.rev().map(|edge| edge.reversed()).collect()
        } else {
            edges.collect()
        };
        Self { hole, left_runs_back: self.left_runs_back != reflects, ..self.clone() }
    }
}

impl OpenDart {
    /// Returns the mistake that the mouth is not on `edge`, an edge of `length`, in m, of `panel`.
    pub(crate) fn mouth_mistake(&self, panel: &str, edge: &str, length: f64) -> Mistake {
        Mistake::Mouth {
            panel: panel.to_owned(),
            dart: self.name.clone(),
            edge: edge.to_owned(),
            mouth: self.mouth,
            length,
        }
    }

    /// Returns the legs: from the first point of `mouth`, in m, to the tip, and from the tip to the
    /// second point.
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

    /// Area that `edges` run round, positive if anticlockwise, in m².
    fn area(edges: &[Edge]) -> f64 {
        edges.iter().map(Edge::area).sum()
    }

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
                let starts = dart.leg_edges().map(|leg| leg[0].start);
                assert_eq!(starts, [legs[0][0].start; 2], "legs begin at the first tip");
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
