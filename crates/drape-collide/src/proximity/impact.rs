//! Time of impact of moving meshes, with its pair and normal.

use super::boxes::{MovingBox, divided};
use super::first_contact::{PairMotion, Search};
use super::leaf::{LeafPair, NumberedLeaf, for_each_pair};
use super::mesh::MeshMotion;
use super::mesh_distance::intersection;
use super::primitive::PrimitivePair;
use crate::error::{Error, check};
use crate::vector::Vector;

/// First contact of two meshes on their motions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Fraction of the motions at the impact, 0 to 1.
    ///
    /// Before this fraction no primitives touch, with all rounding counted. The first contact
    /// follows within the tolerance.
    pub fraction: f64,
    /// Primitives that touch first: a vertex and a triangle, or two edges. If several pairs touch
    /// within the tolerance, it is one of them, and always the same one. An edge and a triangle
    /// intersect at the start of the motions.
    pub pair: PrimitivePair,
    /// Unit normal of the contact, from the second mesh to the first.
    ///
    /// The normal is zero if the meshes intersect at the start, or if they touch there and neither
    /// their positions nor their motions have a direction.
    pub normal: [f64; 3],
}

/// Returns the first contact of the meshes of the motions `first` and `second`, or `None` if they
/// do not touch.
///
/// All vertices move straight and evenly, at the same time. The fraction of the [`Impact`] is at
/// most the fraction at which the meshes first touch, and at least this less `tolerance`. Two
/// primitives touch if their distance is at most 64 units of the last place of their largest
/// coordinate (1.4·10⁻¹⁴ m at 1 m), so meshes that pass each other at such a distance touch too.
/// Meshes that touch or intersect at the start have the fraction 0, also if they part from there.
/// A mesh that is inside another at the start, without touching it, may meet it from inside.
///
/// One thread works, and the result has the same bits in every call.
///
/// # Errors
///
/// `tolerance` is not a positive number.
///
/// # Examples
///
/// ```
/// use drape_collide::{Primitive, ProximityMesh, earliest_impact};
///
/// // A triangle falls from a height of 0.4 m, by 1 m, on a floor. Its corner 2 hangs 0.1 m lower.
/// let floor = [[-5.0, 0.0, -5.0], [0.0, 0.0, 5.0], [5.0, 0.0, -5.0]];
/// let floor = ProximityMesh::new(&floor, &[[0, 1, 2]])?;
/// let start = [[0.0, 0.4, 0.0], [0.2, 0.4, 0.0], [0.1, 0.3, 0.1]];
/// let end = start.map(|[x, y, z]| [x, y - 1.0, z]);
/// let falling = ProximityMesh::new(&start, &[[0, 1, 2]])?;
///
/// let impact = earliest_impact(&falling.moving_to(&end)?, &floor.at_rest(), 1e-6)?;
/// let impact = impact.expect("it meets the floor");
/// assert!(impact.fraction <= 0.3 && impact.fraction >= 0.3 - 1e-6);
/// assert_eq!(impact.pair.first, Primitive::Vertex(2));
/// assert_eq!(impact.pair.second, Primitive::Triangle(0));
/// assert_eq!(impact.normal, [0.0, 1.0, 0.0]);
/// # Ok::<(), drape_collide::Error>(())
/// ```
pub fn earliest_impact(
    first: &MeshMotion<'_>,
    second: &MeshMotion<'_>,
    tolerance: f64,
) -> Result<Option<Impact>, Error> {
    Earliest::search([first, second], tolerance, false)
}

/// Returns the first contact of the mesh of `motion` with itself, or `None` if it does not touch
/// itself. Primitives with a common vertex are left out.
///
/// Apart from this, the result is like the result of [`earliest_impact`].
///
/// # Errors
///
/// `tolerance` is not a positive number.
pub fn earliest_self_impact(
    motion: &MeshMotion<'_>,
    tolerance: f64,
) -> Result<Option<Impact>, Error> {
    Earliest::search([motion, motion], tolerance, true)
}

/// Search for the earliest impact of two motions.
struct Earliest<'a> {
    motions: [&'a MeshMotion<'a>; 2],
    starts: [&'a [Vector]; 2],
    ends: [&'a [Vector]; 2],
    tolerance: f64,
    /// Whether both motions are of one mesh.
    of_one_mesh: bool,
    impact: Option<Impact>,
}

impl<'a> Earliest<'a> {
    /// Returns the earliest impact of `motions`, which are both of one mesh with `of_one_mesh`.
    fn search(
        motions: [&'a MeshMotion<'a>; 2],
        tolerance: f64,
        of_one_mesh: bool,
    ) -> Result<Option<Impact>, Error> {
        check("the tolerance of an impact", tolerance, "above 0", tolerance > 0.0)?;
        let mut earliest = Earliest {
            starts: motions.map(|motion| motion.mesh.positions()),
            ends: motions.map(|motion| motion.end),
            motions,
            tolerance,
            of_one_mesh,
            impact: None,
        };
        earliest.descend();
        Ok(earliest.impact)
    }

    /// Returns the fraction of the earliest impact so far.
    fn limit(&self) -> f64 {
        self.impact.map_or(f64::INFINITY, |impact| impact.fraction)
    }

    /// Returns the moving box of `node` of the mesh of motion number `which`.
    fn moving_box(&self, which: usize, node: u32) -> MovingBox {
        let motion = self.motions[which];
        let start = motion.mesh.boxes()[node as usize];
        MovingBox { start, end: motion.end_boxes[node as usize] }
    }

    /// Returns the time at which the boxes of `nodes` meet, or `None` if they stay apart.
    fn entry(&self, nodes: [u32; 2]) -> Option<f64> {
        // A node meets itself from the start.
        if self.of_one_mesh && nodes[0] == nodes[1] {
            return Some(0.0);
        }
        let window = self.moving_box(0, nodes[0]).window(&self.moving_box(1, nodes[1]));
        window.map(|window| window.entry)
    }

    /// Descends both trees. Of two pairs of nodes the pair that meets earlier is divided first.
    fn descend(&mut self) {
        let trees = self.motions.map(|motion| motion.mesh.tree());
        let mut open: Vec<(f64, [u32; 2])> = Vec::new();
        open.extend(self.entry([0, 0]).map(|entry| (entry, [0, 0])));
        while let Some((entry, nodes)) = open.pop() {
            if entry >= self.limit() {
                continue;
            }
            let one_node = self.of_one_mesh && nodes[0] == nodes[1];
            if one_node {
                if let Some([a, b]) = trees[0].children(nodes[0]) {
                    let pairs = [[a, b], [b, b], [a, a]];
                    open.extend(
                        pairs.into_iter().filter_map(|nodes| Some((self.entry(nodes)?, nodes))),
                    );
                }
                continue;
            }

            let [first, second] = [0, 1].map(|which| self.moving_box(which, nodes[which]).start);
            match divided(trees, nodes, [&first, &second]) {
                Some(below) => {
                    let mut pairs =
                        below.map(|nodes| self.entry(nodes).map(|entry| (entry, nodes)));
                    if let [Some(one), Some(two)] = &pairs
                        && one.0 <= two.0
                    {
                        pairs.swap(0, 1);
                    }
                    open.extend(pairs.into_iter().flatten());
                }
                None => {
                    let numbers = [0, 1].map(|which| trees[which].item(nodes[which]));
                    if let [Some(a), Some(b)] = numbers {
                        let [first, second] = self.motions.map(|motion| motion.mesh);
                        self.take_leaves([first.leaf(a), second.leaf(b)], entry);
                    }
                }
            }
        }
    }

    /// Takes the earliest impact of the primitives of two `leaves` whose boxes meet at `entry`.
    fn take_leaves(&mut self, leaves: [NumberedLeaf<'_>; 2], entry: f64) {
        for_each_pair(leaves, |pair| self.take(pair));
        // Only boxes that overlap at the start may hold primitives that intersect there.
        if entry == 0.0
            && self.limit() > 0.0
            && let Some((pair, _)) = intersection(leaves, self.starts, self.of_one_mesh)
        {
            self.impact = Some(Impact { fraction: 0.0, pair, normal: [0.0; 3] });
        }
    }

    /// Takes the impact of `pair` if it is earlier.
    fn take(&mut self, pair: LeafPair) {
        if self.of_one_mesh && pair.share_vertex() {
            return;
        }
        let (start, end) = (pair.points(self.starts), pair.points(self.ends));
        let first = pair.kind.first_vertex_count();
        let [one, two] =
            [0..first, first..4].map(|part| MovingBox::around(&start[part.clone()], &end[part]));
        let limit = self.limit();
        let Some(window) = one.window(&two).filter(|window| window.entry < limit) else { return };

        let motion = PairMotion { kind: pair.kind, start, end };
        let search = Search { window, limit, tolerance: self.tolerance };
        if let Some(fraction) = motion.first_contact(search) {
            // The normal of a pair leads to its first primitive, which the second mesh may have.
            let normal = motion.contact_normal(fraction).map(|part| pair.orientation() * part);
            self.impact = Some(Impact { fraction, pair: pair.primitives, normal });
        }
    }
}
