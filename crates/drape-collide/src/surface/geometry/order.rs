//! Order of primitives in space, from which trees of boxes are built.

use crate::vector::{Vector, subtract};

/// Number of boxes of a node, which are tested at once.
pub(crate) const WIDTH: usize = 4;

/// Order of primitives in space.
///
/// They are sorted by group, and within it by the Morton code of their middle at rest. A place in
/// this order is a *slot*.
#[derive(Debug, Clone)]
pub(crate) struct Order {
    /// Primitive in each slot.
    pub(crate) items: Vec<u32>,
    /// For each level of the tree and each of its nodes, bits of the boxes with a free primitive.
    pub(crate) free: Vec<Vec<u8>>,
    /// Likewise the largest number of a primitive in each of the four boxes.
    pub(crate) last: Vec<Vec<[u32; WIDTH]>>,
}

/// Group and middle of a primitive at rest.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Primitive {
    pub(crate) group: u32,
    /// Mean position of its vertices, in m.
    pub(crate) middle: Vector,
    /// Whether it is cloth.
    pub(crate) free: bool,
}

impl Order {
    /// Sorts primitives.
    pub(crate) fn new(primitives: &[Primitive]) -> Order {
        let mut keys: Vec<(u32, u64, u32)> = Vec::with_capacity(primitives.len());
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
        for (k, &Primitive { group, middle, .. }) in primitives.iter().enumerate() {
            keys.push((group, morton(middle, bounds[group as usize]), k as u32));
        }
        keys.sort_unstable();
        let items: Vec<u32> = keys.iter().map(|key| key.2).collect();
        let mut level: Vec<bool> =
            items.iter().map(|&item| primitives[item as usize].free).collect();
        let mut lasts = items.clone();
        let (mut free, mut last) = (Vec::new(), Vec::new());
        loop {
            let bits = |four: &[bool]| four.iter().rev().fold(0, |all, &b| 2 * all + u8::from(b));
            let quads: Vec<u8> = level.chunks(WIDTH).map(bits).collect();
            level = quads.iter().map(|&bits| bits != 0).collect();
            free.push(quads);
            let four = |four: &[u32]| std::array::from_fn(|k| four.get(k).copied().unwrap_or(0));
            let quads: Vec<[u32; WIDTH]> = lasts.chunks(WIDTH).map(four).collect();
            lasts = lasts.chunks(WIDTH).filter_map(|four| four.iter().copied().max()).collect();
            last.push(quads);
            if level.len() <= 1 {
                break;
            }
        }
        Order { items, free, last }
    }
}

/// Primitives with consecutive numbers that lie together at rest, and so are queried at once.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    /// First of them.
    pub(crate) first: u32,
    /// Number of them, from 1 to [`WIDTH`].
    pub(crate) count: usize,
}

impl Run {
    /// Divides primitives into runs within an extent for each group, in m.
    pub(crate) fn divide(primitives: &[Primitive], extents: &[f64]) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        for (k, entry) in primitives.iter().enumerate() {
            let joins = |run: &&mut Run| {
                let near = |other: &Primitive| {
                    let offset = subtract(entry.middle, other.middle);
                    let extent = extents[entry.group as usize];
                    entry.group == other.group
                        && entry.free == other.free
                        && offset.iter().all(|length| length.abs() <= extent)
                };
                run.count < WIDTH && primitives[run.first as usize..k].iter().all(near)
            };
            match runs.last_mut().filter(joins) {
                Some(run) => run.count += 1,
                None => runs.push(Run { first: k as u32, count: 1 }),
            }
        }
        runs
    }
}

/// Number of bits of a coordinate.
const BITS: u32 = 21;

/// Returns the Morton code of a point within a box: the bits of its three coordinates in turn.
fn morton(point: Vector, [low, high]: [Vector; 2]) -> u64 {
    let side = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let cells = f64::from((1u32 << BITS) - 1);
    let spread = |k: usize| {
        let fraction = if side > 0.0 { (point[k] - low[k]) / side } else { 0.0 };
        let cell = (fraction * cells) as u64;
        (0..BITS).fold(0, |code, bit| code | ((cell >> bit) & 1) << (3 * bit))
    };
    spread(0) | spread(1) << 1 | spread(2) << 2
}
