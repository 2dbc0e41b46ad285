//! Order of primitives in space, in which trees of boxes are built.

use crate::vector::{Vector, subtract};

/// Number of boxes in a node, which are tested at once.
pub(crate) const WIDTH: usize = 4;

/// Order of primitives in space.
///
/// Primitives are sorted by group, and within a group by the Morton code of their middle at rest. A
/// place in this order is a *slot*.
#[derive(Debug, Clone)]
pub(crate) struct SpatialOrder {
    /// Primitive in each slot.
    pub(crate) items: Vec<u32>,
    /// For each level of the tree and each node, bits of the boxes with a free primitive.
    pub(crate) free: Vec<Vec<u8>>,
    /// For each level of the tree and each node, the largest number of a primitive in each box.
    pub(crate) last: Vec<Vec<[u32; WIDTH]>>,
}

/// Group and middle of a primitive at rest.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Primitive {
    pub(crate) group: u32,
    /// Mean position of its vertices, in m.
    pub(crate) middle: Vector,
    /// Whether the primitive is cloth.
    pub(crate) free: bool,
}

impl SpatialOrder {
    /// Returns the order of `primitives`.
    pub(crate) fn new(primitives: &[Primitive]) -> SpatialOrder {
        // Each group has its own box for Morton codes.
        let mut bounds: Vec<[Vector; 2]> = Vec::new();
        for &Primitive { group, middle, .. } in primitives {
            let group = group as usize;
            if bounds.len() <= group {
                bounds.resize(group + 1, [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]]);
            }
            let [low, high] = &mut bounds[group];
            for k in 0..3 {
                low[k] = low[k].min(middle[k]);
                high[k] = high[k].max(middle[k]);
            }
        }

        let mut keys: Vec<(u32, u64, u32)> = Vec::with_capacity(primitives.len());
        for (k, &Primitive { group, middle, .. }) in primitives.iter().enumerate() {
            keys.push((group, morton(middle, bounds[group as usize]), k as u32));
        }
        keys.sort_unstable();
        let items: Vec<u32> = keys.iter().map(|key| key.2).collect();

        // From the slots upwards, each level has a node for every four boxes of the level below.
        let mut level: Vec<bool> =
            items.iter().map(|&item| primitives[item as usize].free).collect();
        let mut level_last = items.clone();
        let (mut free, mut last) = (Vec::new(), Vec::new());
        loop {
            let nodes: Vec<u8> = level
                .chunks(WIDTH)
                .map(|four| four.iter().rev().fold(0, |bits, &b| 2 * bits + u8::from(b)))
                .collect();
            level = nodes.iter().map(|&bits| bits != 0).collect();
            free.push(nodes);

            let nodes: Vec<[u32; WIDTH]> = level_last
                .chunks(WIDTH)
                .map(|four| std::array::from_fn(|k| four.get(k).copied().unwrap_or(0)))
                .collect();
            level_last =
                level_last.chunks(WIDTH).filter_map(|four| four.iter().copied().max()).collect();
            last.push(nodes);
            if level.len() <= 1 {
                break;
            }
        }
        SpatialOrder { items, free, last }
    }
}

/// Primitives with consecutive numbers that lie together at rest. A query handles them at once.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PrimitiveRun {
    /// Number of the first primitive.
    pub(crate) first: u32,
    /// Number of primitives, from 1 to [`WIDTH`].
    pub(crate) count: usize,
}

impl PrimitiveRun {
    /// Divides `primitives` into runs. `extents` holds the largest extent of a run in each group,
    /// in m.
    pub(crate) fn divide(primitives: &[Primitive], extents: &[f64]) -> Vec<PrimitiveRun> {
        let mut runs: Vec<PrimitiveRun> = Vec::new();
        for (k, primitive) in primitives.iter().enumerate() {
            let extent = extents[primitive.group as usize];
            let joined = runs.last_mut().filter(|run| {
                let members = &primitives[run.first as usize..k];
                run.count < WIDTH && members.iter().all(|member| primitive.joins(member, extent))
            });
            match joined {
                Some(run) => run.count += 1,
                None => runs.push(PrimitiveRun { first: k as u32, count: 1 }),
            }
        }
        runs
    }
}

impl Primitive {
    /// Returns whether this primitive may share a run with `member`: it is of the same kind and at
    /// most `extent` away along each axis, in m.
    fn joins(&self, member: &Primitive, extent: f64) -> bool {
        let offset = subtract(self.middle, member.middle);
        self.group == member.group
            && self.free == member.free
            && offset.iter().all(|length| length.abs() <= extent)
    }
}

/// Number of bits per coordinate of a Morton code.
const BITS: u32 = 21;

/// Returns the Morton code of `point` within a box: the bits of its three coordinates in turn.
fn morton(point: Vector, [low, high]: [Vector; 2]) -> u64 {
    let side = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let cells = f64::from((1u32 << BITS) - 1);
    let mut code = 0;
    for k in 0..3 {
        let fraction = if side > 0.0 { (point[k] - low[k]) / side } else { 0.0 };
        let cell = (fraction * cells) as u64;
        let spread: u64 = (0..BITS).fold(0, |bits, bit| bits | ((cell >> bit) & 1) << (3 * bit));
        code |= spread << k;
    }
    code
}
