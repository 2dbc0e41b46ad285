use crate::tree::WIDTH;
use crate::vector::{Vector, subtract};

/// The order of primitives in space, from which their tree of boxes is built.
///
/// Primitives follow each other by group, and within it by the Morton code of their place at rest.
/// A place in this order is a *slot*.
#[derive(Debug, Clone)]
pub(crate) struct Order {
    /// The primitive in each slot.
    pub(crate) items: Vec<u32>,
    /// For each level of the tree and each of its quads, which of the four boxes hold a free
    /// primitive, as bits.
    pub(crate) free: Vec<Vec<u8>>,
    /// Likewise the largest number of a primitive in each of the four boxes.
    pub(crate) last: Vec<Vec<[u32; WIDTH]>>,
}

/// Where a primitive is at rest.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Entry {
    pub(crate) group: u32,
    /// Middle of its vertices, in m.
    pub(crate) place: Vector,
    pub(crate) free: bool,
}

impl Order {
    pub(crate) fn new(entries: &[Entry]) -> Order {
        let mut keys: Vec<(u32, u64, u32)> = Vec::with_capacity(entries.len());
        let mut bounds: Vec<(Vector, Vector)> = Vec::new();
        for &Entry { group, place, .. } in entries {
            let group = group as usize;
            if bounds.len() <= group {
                bounds.resize(group + 1, ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]));
            }
            let (low, high) = &mut bounds[group];
            for k in 0..3 {
                low[k] = low[k].min(place[k]);
                high[k] = high[k].max(place[k]);
            }
        }
        for (k, &Entry { group, place, .. }) in entries.iter().enumerate() {
            keys.push((group, morton(place, bounds[group as usize]), k as u32));
        }
        keys.sort_unstable();
        let items: Vec<u32> = keys.iter().map(|key| key.2).collect();
        let mut level: Vec<bool> = items.iter().map(|&item| entries[item as usize].free).collect();
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

/// Primitives with consecutive numbers that lie together at rest, and so may be looked for at once.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    pub(crate) first: u32,
    /// From 1 to [`WIDTH`].
    pub(crate) count: usize,
}

impl Run {
    /// Divides primitives into runs within a size for each group, in m.
    pub(crate) fn divide(entries: &[Entry], sizes: &[f64]) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        for (k, entry) in entries.iter().enumerate() {
            let joins = |run: &&mut Run| {
                let near = |other: &Entry| {
                    let way = subtract(entry.place, other.place);
                    let size = sizes[entry.group as usize];
                    entry.group == other.group
                        && entry.free == other.free
                        && way.iter().all(|length| length.abs() <= size)
                };
                run.count < WIDTH && entries[run.first as usize..k].iter().all(near)
            };
            match runs.last_mut().filter(joins) {
                Some(run) => run.count += 1,
                None => runs.push(Run { first: k as u32, count: 1 }),
            }
        }
        runs
    }
}

/// Bits of the place along each axis.
const BITS: u32 = 21;

/// The bits of the three coordinates in turn, of the place within a box.
fn morton(place: Vector, (low, high): (Vector, Vector)) -> u64 {
    let side = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    let cells = f64::from((1u32 << BITS) - 1);
    let spread = |k: usize| {
        let share = if side > 0.0 { (place[k] - low[k]) / side } else { 0.0 };
        let cell = (share * cells) as u64;
        (0..BITS).fold(0, |code, bit| code | ((cell >> bit) & 1) << (3 * bit))
    };
    spread(0) | spread(1) << 1 | spread(2) << 2
}
