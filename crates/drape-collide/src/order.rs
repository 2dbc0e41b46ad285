use crate::tree::WIDTH;
use crate::vector::Vector;

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
}

impl Order {
    /// The order of primitives of given group, place at rest, and freedom.
    pub(crate) fn new(entries: impl Iterator<Item = (u32, Vector, bool)>) -> Order {
        let entries: Vec<_> = entries.collect();
        let mut keys: Vec<(u32, u64, u32)> = Vec::with_capacity(entries.len());
        let mut bounds: Vec<(Vector, Vector)> = Vec::new();
        for &(group, place, _) in &entries {
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
        for (k, &(group, place, _)) in entries.iter().enumerate() {
            keys.push((group, morton(place, bounds[group as usize]), k as u32));
        }
        keys.sort_unstable();
        let items: Vec<u32> = keys.iter().map(|key| key.2).collect();
        let mut level: Vec<bool> = items.iter().map(|&item| entries[item as usize].2).collect();
        let mut free = Vec::new();
        loop {
            let bits = |four: &[bool]| four.iter().rev().fold(0, |all, &b| 2 * all + u8::from(b));
            let quads: Vec<u8> = level.chunks(WIDTH).map(bits).collect();
            level = quads.iter().map(|&bits| bits != 0).collect();
            free.push(quads);
            if level.len() <= 1 {
                break;
            }
        }
        Order { items, free }
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
