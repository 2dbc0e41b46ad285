//! Order and sense of seams: whether their sides, as listed, fit each other at the start.
//!
//! A seam that is reversed, or whose edges are listed in another order, draws its stitches across
//! the whole garment and twists it. With `$\overline{g^2}$` the mean square of the gaps of the
//! stitches at the start and `$L$` the length of the seam, another order or sense fits better by
//!
//! ```math
//! \frac{\overline{g^2} - \overline{g_\text{best}^2}}{L^2 / 3}
//! ```
//!
//! which is 1 for two parallel sides of which one runs the wrong way, at any distance of theirs.
//! Called on each garment when its panels are at their places.

use drape_input::{Diagnostic, Document, Edit, Subject, toml_key, toml_string};
use drape_pattern::{DEFAULT_EASE, EdgeId, Pattern, Seam};

/// Advantage of another order above which the listed one is a mistake. Sides in the right order
/// have 0, a reversed one about 1, two equal edges that are swapped three quarters. The shipped
/// garments have 0.
const ADVANTAGE: f64 = 0.25;

/// Number of stitches by which orders are compared.
const STITCHES: usize = 48;

/// Largest number of edges of a side of which all orders are compared; of more edges, the order as
/// listed and the opposite one.
const EDGES_MAX: usize = 4;

/// Largest distance of two points that are one point of a panel, in m.
const JOINED: f64 = 1e-6;

/// Edge on a side of a seam.
#[derive(Debug, Clone)]
pub(crate) struct SideEdge {
    /// PANEL.EDGE.
    pub(crate) name: String,
    /// Its nodes at the start, along its outline, in m.
    pub(crate) places: Vec<[f64; 3]>,
}

/// Order in which the edges of a seam are sewn.
#[derive(Debug, Clone, PartialEq)]
struct Order {
    /// Numbers of the edges of each side.
    edges: [Vec<usize>; 2],
    /// Whether the second side runs along its outlines.
    reversed: bool,
}

/// Order that fits better than the listed one, with the root mean squares of the gaps of the
/// stitches in both orders, in m.
#[derive(Debug, Clone, PartialEq)]
struct Better {
    order: Order,
    listed_gap: f64,
    gap: f64,
}

/// File that states the seams of a garment, or that can: its pattern, or the scene for patterns of
/// other formats.
pub(crate) struct SeamHome<'a> {
    pub(crate) document: &'a Document,
    /// Key path of its seams.
    pub(crate) key: String,
}

/// Seam whose edges are at their places.
pub(crate) struct PlacedSeam<'a> {
    pub(crate) seam: &'a Seam,
    pub(crate) sides: [Vec<SideEdge>; 2],
}

impl<'a> PlacedSeam<'a> {
    /// Returns a seam whose edges have their places from a function.
    pub(crate) fn new(
        pattern: &Pattern,
        seam: &'a Seam,
        places: impl Fn(EdgeId) -> Vec<[f64; 3]>,
    ) -> Self {
        let edge = |&id: &EdgeId| {
            let panel = &pattern.panels()[id.panel];
            let edge = panel.edges().nth(id.edge).map_or("", |edge| &edge.name);
            let name = format!("{}.{edge}", panel.name());
            SideEdge { name, places: places(id) }
        };
        Self { seam, sides: seam.sides.each_ref().map(|side| side.iter().map(edge).collect()) }
    }

    /// Returns the mistake of a seam that another order fits better, at the place where the seam is
    /// stated, or can be.
    pub(crate) fn mistake(&self, home: &SeamHome<'_>) -> Option<Diagnostic> {
        let Better { order, listed_gap, gap } = self.better()?;
        let name = &self.seam.name;
        let (fault, change) = if order.edges == self.listed().edges {
            ("reversed", "if the second side ran the other way")
        } else {
            ("twisted", "if its edges were in the order that fits")
        };
        let message = format!(
            "the seam is {fault}: its stitches are {:.0} mm long at the start, in the root mean square, and would be {:.0} mm {change}",
            1e3 * listed_gap,
            1e3 * gap
        );
        let key = home.seam(name);
        let help = format!(
            "write under [{}]: {}; or list \"{name}\" in the scene's sew.twisted if the twist is meant",
            home.heading(name),
            self.line(home, &order)
        );
        let mistake = home.document.at(&key, message).help(help).about(Subject::Seam(name.clone()));
        Some(mistake.with_edits(self.edits(home, &order)))
    }

    /// Returns the order as it is listed.
    fn listed(&self) -> Order {
        let edges = self.sides.each_ref().map(|side| (0..side.len()).collect());
        Order { edges, reversed: self.seam.reversed }
    }

    /// Returns the order that fits better than the listed one, if there is one.
    fn better(&self) -> Option<Better> {
        let listed = self.listed();
        let listed_square = self.mean_square_gap(&listed);
        let lengths = self.sides.each_ref().map(|side| side.iter().map(SideEdge::length).sum());
        let [one, other]: [f64; 2] = lengths;
        let scale = one * other / 3.0;
        // A point that is sewn to itself, such as the tip of a dart, stays so.
        let is_joined = self.has_joined_end(&listed);
        let mut best: Option<(Order, f64)> = None;
        for order in self.orders() {
            if is_joined && !self.has_joined_end(&order) {
                continue;
            }
            let square = self.mean_square_gap(&order);
            if best.as_ref().is_none_or(|(_, best)| square < *best) {
                best = Some((order, square));
            }
        }
        let (order, square) = best?;
        let better = listed_square - square > ADVANTAGE * scale;
        better.then_some(Better { order, listed_gap: listed_square.sqrt(), gap: square.sqrt() })
    }

    /// Returns the orders to compare, those with the listed sense first.
    fn orders(&self) -> Vec<Order> {
        let [one, other] = self.sides.each_ref().map(|side| orders_of(side.len()));
        let senses = [self.seam.reversed, !self.seam.reversed].into_iter();
        let both = senses.flat_map(|reversed| {
            let other = &other;
            one.iter().flat_map(move |one| {
                let pair = move |other: &Vec<usize>| [one.clone(), other.clone()];
                other.iter().map(move |other| Order { edges: pair(other), reversed })
            })
        });
        both.collect()
    }

    /// Returns the mean square of the gaps of the stitches of an order, in m².
    fn mean_square_gap(&self, order: &Order) -> f64 {
        let along = [true, order.reversed];
        let [one, other] = [0, 1].map(|side| {
            let edges: Vec<&SideEdge> =
                order.edges[side].iter().map(|&edge| &self.sides[side][edge]).collect();
            stitches(&edges, along[side])
        });
        let squares: Vec<f64> = one
            .iter()
            .zip(&other)
            .map(|(a, b)| (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum())
            .collect();
        let count = squares.len().max(1) as f64;
        squares.iter().sum::<f64>() / count
    }

    /// Returns whether an `order` sews both sides to each other where they meet, at one of its
    /// ends.
    fn has_joined_end(&self, order: &Order) -> bool {
        let along = [true, order.reversed];
        let ends = [0, 1].map(|side| {
            let edge = |edge: Option<&usize>, at_end: bool| {
                let places = &self.sides[side][*edge?].places;
                (if at_end { places.last() } else { places.first() }).copied()
            };
            let edges = &order.edges[side];
            [edge(edges.first(), !along[side]), edge(edges.last(), along[side])]
        });
        let meet = |end: usize| match [ends[0][end], ends[1][end]] {
            [Some(one), Some(other)] => distance(one, other) < JOINED,
            _ => false,
        };
        meet(0) || meet(1)
    }

    /// Returns the sides of an order, in TOML.
    fn sides(&self, order: &Order) -> String {
        let side = |side: usize| {
            let names = order.edges[side].iter().map(|&edge| &self.sides[side][edge].name);
            names.map(|name| toml_string(name)).collect::<Vec<_>>().join(", ")
        };
        format!("[[{}], [{}]]", side(0), side(1))
    }

    /// Returns the lines of TOML that give a seam an order.
    fn line(&self, home: &SeamHome<'_>, order: &Order) -> String {
        let mut line = format!("sides = {}", self.sides(order));
        if self.is_fuller_than(home) {
            line += &format!(", max_ease = {}", self.seam.max_ease);
        }
        match (order.reversed, self.seam.reversed) {
            (true, _) => line + " and reversed = true",
            (false, true) => line + ", without reversed = true",
            (false, false) => line,
        }
    }

    /// Returns the changes that give a seam an order.
    fn edits(&self, home: &SeamHome<'_>, order: &Order) -> Vec<Edit> {
        let key = home.seam(&self.seam.name);
        let set =
            |field: &str, new: Option<&str>| home.document.edit(&format!("{key}.{field}"), new);
        let mut edits = Vec::new();
        if order.edges != self.listed().edges || !home.document.has(&key) {
            edits.push(set("sides", Some(&self.sides(order))));
        }
        if order.reversed != self.seam.reversed || !home.document.has(&key) && order.reversed {
            edits.push(set("reversed", order.reversed.then_some("true")));
        }
        if self.is_fuller_than(home) {
            edits.push(set("max_ease", Some(&self.seam.max_ease.to_string())));
        }
        edits.into_iter().flatten().collect()
    }

    /// Returns whether a seam of another file, which takes the place of this one, would allow less
    /// fullness.
    fn is_fuller_than(&self, home: &SeamHome<'_>) -> bool {
        !home.document.has(&home.seam(&self.seam.name)) && self.seam.max_ease > DEFAULT_EASE
    }
}

impl SeamHome<'_> {
    /// Returns the key path of a seam.
    fn seam(&self, name: &str) -> String {
        format!("{}.{}", self.key, toml_key(name))
    }

    /// Returns the heading of the table of a seam.
    fn heading(&self, name: &str) -> String {
        let table = if self.key == "seam" { "seam" } else { "garment.seam" };
        format!("{table}.{}", toml_key(name))
    }
}

impl SideEdge {
    /// Returns its length, in m.
    fn length(&self) -> f64 {
        self.places.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
    }

    /// Returns the point at a distance from its start, in m.
    fn at(&self, along: f64) -> Option<[f64; 3]> {
        let mut left = along;
        for pair in self.places.windows(2) {
            let length = distance(pair[0], pair[1]);
            if left <= length && length > 0.0 {
                let part = left / length;
                return Some([0, 1, 2].map(|k| pair[0][k] + part * (pair[1][k] - pair[0][k])));
            }
            left -= length;
        }
        self.places.last().copied()
    }
}

/// Returns places at equal fractions of a side whose edges are sewn one after the other, along
/// their outlines or against them.
fn stitches(edges: &[&SideEdge], along: bool) -> Vec<[f64; 3]> {
    let lengths: Vec<f64> = edges.iter().map(|edge| edge.length()).collect();
    let whole: f64 = lengths.iter().sum();
    let place = |stitch: usize| {
        let mut left = whole * (stitch as f64 + 0.5) / STITCHES as f64;
        for (edge, &length) in edges.iter().zip(&lengths) {
            if left <= length {
                return edge.at(if along { left } else { length - left });
            }
            left -= length;
        }
        None
    };
    (0..STITCHES).filter_map(place).collect()
}

/// Returns the orders of `count` edges that are compared.
fn orders_of(count: usize) -> Vec<Vec<usize>> {
    if count > EDGES_MAX {
        return vec![(0..count).collect(), (0..count).rev().collect()];
    }
    let mut orders = vec![Vec::new()];
    for _ in 0..count {
        let longer = |order: Vec<usize>| -> Vec<Vec<usize>> {
            let left = (0..count).filter(|edge| !order.contains(edge));
            left.map(|edge| [order.as_slice(), &[edge]].concat()).collect()
        };
        orders = orders.into_iter().flat_map(longer).collect();
    }
    orders
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns whether another order fits a dart better, with its mouth from `left` to `right` and
    /// its `tip`. Its legs run along the outline, over the tip.
    fn is_mistaken(reversed: bool, [left, tip, right]: [[f64; 3]; 3]) -> bool {
        let edges = [[0, 1], [0, 2]].map(|[panel, edge]| vec![EdgeId { panel, edge }]);
        let seam = Seam {
            name: "dart".into(),
            sides: edges,
            reversed,
            max_ease: DEFAULT_EASE,
            angle: 0.0,
            allowance: 0.0,
        };
        let leg = |name: &str, ends: [[f64; 3]; 2]| {
            vec![SideEdge { name: name.into(), places: ends.to_vec() }]
        };
        let sides = [leg("front.left", [left, tip]), leg("front.right", [tip, right])];
        PlacedSeam { seam: &seam, sides }.better().is_some()
    }

    #[test]
    fn a_dart_is_closed_from_its_mouth_to_its_tip() {
        let narrow = [[-0.01, 0.0, 0.0], [0.0, -0.1, 0.0], [0.01, 0.0, 0.0]];
        assert!(!is_mistaken(false, narrow));
        assert!(is_mistaken(true, narrow), "the tip would be sewn to the mouth");

        // The legs of a straight dart lie on a line. With one leg the other way round all gaps are
        // 0.1 m, less than the root mean square of gaps from 0 to 0.2 m.
        let straight = [[-0.1, 0.0, 0.0], [0.0; 3], [0.1, 0.0, 0.0]];
        assert!(!is_mistaken(false, straight), "the tip stays closed");
    }

    #[test]
    fn few_edges_are_compared_in_every_order() {
        assert_eq!(orders_of(3).len(), 6);
        assert_eq!(orders_of(3)[0], [0, 1, 2], "the listed one comes first");
        assert_eq!(orders_of(6).len(), 2);
    }
}
