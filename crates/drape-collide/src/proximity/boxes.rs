//! Boxes along the axes, at rest and moving, and the tree that holds them.

use crate::vector::{Vector, bounds};

/// Relative rounding of a time or of a squared distance of boxes, with room.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Box along the axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct AxisBox {
    pub(super) low: Vector,
    pub(super) high: Vector,
}

impl AxisBox {
    /// Returns the box around `points`.
    pub(super) fn around(points: &[Vector]) -> AxisBox {
        let [low, high] = bounds(points.iter());
        AxisBox { low, high }
    }

    /// Returns the box around this box and `other`.
    fn union(&self, other: &AxisBox) -> AxisBox {
        AxisBox {
            low: std::array::from_fn(|axis| self.low[axis].min(other.low[axis])),
            high: std::array::from_fn(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    /// Returns a lower bound of the squared distance from this box to `other`, in m².
    pub(super) fn squared_distance(&self, other: &AxisBox) -> f64 {
        let mut square = 0.0;
        for axis in 0..3 {
            let apart =
                (self.low[axis] - other.high[axis]).max(other.low[axis] - self.high[axis]).max(0.0);
            square += apart * apart;
        }
        square * (1.0 - ROUNDING)
    }

    /// Returns the sum of the lengths of the sides, in m.
    fn extent(&self) -> f64 {
        (0..3).map(|axis| self.high[axis] - self.low[axis]).sum()
    }
}

/// Box whose sides move linearly from `start` to `end`. Points that move linearly and begin and end
/// in the two boxes are in the moving box all the time.
#[derive(Debug, Clone, Copy)]
pub(super) struct MovingBox {
    pub(super) start: AxisBox,
    pub(super) end: AxisBox,
}

/// Range of fractions of a motion outside of which two moving boxes are surely apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Window {
    pub(super) entry: f64,
    pub(super) exit: f64,
}

impl MovingBox {
    /// Returns the moving box around points that move from `start` to `end`.
    pub(super) fn around(start: &[Vector], end: &[Vector]) -> MovingBox {
        MovingBox { start: AxisBox::around(start), end: AxisBox::around(end) }
    }

    /// Returns the [`Window`] in which this box may overlap `other`, or `None` if they stay apart.
    pub(super) fn window(&self, other: &MovingBox) -> Option<Window> {
        let mut window = Window { entry: 0.0, exit: 1.0 };
        for axis in 0..3 {
            let gaps = [
                [
                    self.start.low[axis] - other.start.high[axis],
                    self.end.low[axis] - other.end.high[axis],
                ],
                [
                    other.start.low[axis] - self.start.high[axis],
                    other.end.low[axis] - self.end.high[axis],
                ],
            ];
            // Each gap is linear in time, and the boxes overlap along an axis where no gap is
            // above 0. The quotient of two gaps has a small relative error.
            for [start, end] in gaps {
                if start > 0.0 && end > 0.0 {
                    return None;
                }
                if start > 0.0 {
                    window.entry = window.entry.max(start / (start - end) * (1.0 - ROUNDING));
                } else if end > 0.0 {
                    window.exit = window.exit.min(start / (start - end) * (1.0 + ROUNDING));
                }
            }
        }
        (window.entry <= window.exit).then_some(window)
    }
}

/// Tree of boxes over items, one in each leaf. The nodes are in depth-first order, and the first
/// child of a node follows the node.
#[derive(Debug, Clone)]
pub(super) struct Tree {
    nodes: Vec<Node>,
}

/// Node of a [`Tree`].
#[derive(Debug, Clone, Copy)]
enum Node {
    /// Number of an item.
    Leaf(u32),
    /// Number of the second child.
    Inner(u32),
}

impl Tree {
    /// Returns a tree over items with the `centres`. Items are halved along the longest side of the
    /// box around their centres, by their order along this side and then by their number.
    pub(super) fn new(centres: &[Vector]) -> Tree {
        let mut tree = Tree { nodes: Vec::with_capacity(2 * centres.len()) };
        let mut items: Vec<u32> = (0..centres.len() as u32).collect();
        if !items.is_empty() {
            tree.divide(&mut items, centres);
        }
        tree
    }

    /// Adds the node over `items`, and all nodes below.
    fn divide(&mut self, items: &mut [u32], centres: &[Vector]) {
        if let [item] = items {
            return self.nodes.push(Node::Leaf(*item));
        }
        let [low, high] = bounds(items.iter().map(|&item| &centres[item as usize]));
        let side = |axis: &usize| high[*axis] - low[*axis];
        let axis = (0..3).max_by(|a, b| side(a).total_cmp(&side(b))).unwrap_or(0);
        let half = items.len() / 2;
        items.select_nth_unstable_by(half, |&a, &b| {
            let [along_a, along_b] = [a, b].map(|item| centres[item as usize][axis]);
            along_a.total_cmp(&along_b).then(a.cmp(&b))
        });

        let (first, second) = items.split_at_mut(half);
        let node = self.nodes.len();
        self.nodes.push(Node::Inner(0));
        self.divide(first, centres);
        self.nodes[node] = Node::Inner(self.nodes.len() as u32);
        self.divide(second, centres);
    }

    /// Returns the box of each node. `item_box` returns the box of an item.
    pub(super) fn fit(&self, item_box: impl Fn(u32) -> AxisBox) -> Vec<AxisBox> {
        let mut boxes = vec![AxisBox { low: [0.0; 3], high: [0.0; 3] }; self.nodes.len()];
        for (node, kind) in self.nodes.iter().enumerate().rev() {
            boxes[node] = match *kind {
                Node::Leaf(item) => item_box(item),
                Node::Inner(second) => boxes[node + 1].union(&boxes[second as usize]),
            };
        }
        boxes
    }

    /// Returns the item of `node`, or `None` if `node` is not a leaf.
    pub(super) fn item(&self, node: u32) -> Option<u32> {
        match self.nodes[node as usize] {
            Node::Leaf(item) => Some(item),
            Node::Inner(_) => None,
        }
    }

    /// Returns the children of `node`, or `None` for a leaf.
    pub(super) fn children(&self, node: u32) -> Option<[u32; 2]> {
        match self.nodes[node as usize] {
            Node::Leaf(_) => None,
            Node::Inner(second) => Some([node + 1, second]),
        }
    }
}

/// Returns the pairs of nodes below the pair of node `a` of `first` and node `b` of `second`, or
/// `None` if both are leaves. The node with the larger box, `boxes`, is divided.
pub(super) fn divided(
    [first, second]: [&Tree; 2],
    [a, b]: [u32; 2],
    boxes: [&AxisBox; 2],
) -> Option<[[u32; 2]; 2]> {
    let first_is_larger = boxes[0].extent() >= boxes[1].extent();
    match (first.children(a), second.children(b)) {
        (None, None) => None,
        (Some(children), other) if first_is_larger || other.is_none() => {
            Some(children.map(|child| [child, b]))
        }
        (_, Some(children)) => Some(children.map(|child| [a, child])),
        (Some(children), None) => Some(children.map(|child| [child, b])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_that_passes_another_overlaps_it_from_its_entry_to_its_exit() {
        let cube = |x: f64| AxisBox { low: [x, 0.0, 0.0], high: [x + 1.0, 1.0, 1.0] };
        let rests = MovingBox { start: cube(0.0), end: cube(0.0) };
        let passes = MovingBox { start: cube(-5.0), end: cube(5.0) };
        let Window { entry, exit } = rests.window(&passes).expect("they overlap");
        assert!(entry <= 0.4 && (entry - 0.4).abs() < 1e-14, "{entry}");
        assert!(exit >= 0.6 && (exit - 0.6).abs() < 1e-14, "{exit}");
        assert_eq!(passes.window(&rests), rests.window(&passes));

        // A box that is beside the path stays apart, and so does a box that turns back.
        let beside = MovingBox {
            start: AxisBox { low: [-5.0, 1.5, 0.0], high: [-4.0, 2.0, 1.0] },
            end: AxisBox { low: [5.0, 1.5, 0.0], high: [6.0, 2.0, 1.0] },
        };
        assert_eq!(rests.window(&beside), None);
        let short = MovingBox { start: cube(-5.0), end: cube(-1.5) };
        assert_eq!(rests.window(&short), None);
    }

    #[test]
    fn every_item_is_in_one_leaf_and_in_the_boxes_above() {
        let centres: Vec<Vector> =
            (0..37).map(|k| [f64::from(k * 7 % 11), f64::from(k * 5 % 13), f64::from(k)]).collect();
        let tree = Tree::new(&centres);
        let boxes = tree.fit(|item| AxisBox::around(&[centres[item as usize]]));
        let mut seen = vec![0; centres.len()];
        let mut open = vec![0];
        while let Some(node) = open.pop() {
            if let Some(item) = tree.item(node) {
                seen[item as usize] += 1;
                assert_eq!(boxes[node as usize].low, centres[item as usize]);
            }
            for child in tree.children(node).into_iter().flatten() {
                let (inner, outer) = (&boxes[child as usize], &boxes[node as usize]);
                assert!(
                    (0..3).all(|k| inner.low[k] >= outer.low[k] && inner.high[k] <= outer.high[k])
                );
                open.push(child);
            }
        }
        assert_eq!(seen, vec![1; centres.len()]);
    }
}
