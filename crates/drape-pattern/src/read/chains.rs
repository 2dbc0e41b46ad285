//! Chains of edges whose ends meet: closed outlines from lines that were drawn apart.

use crate::edge::{Edge, distance};

/// Distance between ends that count as one point, in m: the rounding of drawings.
const MEET: f64 = 1e-4;

/// Largest number of chains that are compared with each other.
const MOST_CHAINS: usize = 5000;

/// Joins `chains` whose ends meet. Returns the chains that close, and leaves the others in
/// `chains`.
pub(crate) fn joined(chains: &mut Vec<Vec<Edge>>) -> Vec<Vec<Edge>> {
    chains.retain(|chain| !chain.is_empty());
    let mut closed = Vec::new();
    if chains.len() > MOST_CHAINS {
        return closed;
    }

    // The stack has the first chain on top, so that chains keep their order.
    let mut open: Vec<Vec<Edge>> = Vec::new();
    let mut remaining = std::mem::take(chains);
    remaining.reverse();
    while let Some(mut chain) = remaining.pop() {
        loop {
            let [start, end] = ends(&chain);
            if chain.len() > 1 && distance(start, end) <= MEET {
                closed.push(shut(chain));
                break;
            }
            let next = remaining.iter().rposition(|candidate| {
                let mut ends = ends(candidate).into_iter();
                ends.any(|p| distance(end, p) <= MEET || distance(start, p) <= MEET)
            });
            let Some(number) = next else {
                open.push(chain);
                break;
            };
            chain = appended(chain, remaining.remove(number));
        }
    }
    *chains = open;
    closed
}

/// Returns the first and the last point of `chain`, which has edges.
fn ends(chain: &[Edge]) -> [[f64; 2]; 2] {
    [chain[0].start, chain[chain.len() - 1].end]
}

/// Returns one chain of two whose ends meet: `added` is put behind or before `chain`, reversed if
/// necessary.
fn appended(chain: Vec<Edge>, added: Vec<Edge>) -> Vec<Edge> {
    let ([start, end], [from, to]) = (ends(&chain), ends(&added));
    if distance(end, from) <= MEET {
        [chain, added].concat()
    } else if distance(end, to) <= MEET {
        [chain, reversed(&added)].concat()
    } else if distance(start, to) <= MEET {
        [added, chain].concat()
    } else {
        [reversed(&added), chain].concat()
    }
}

/// Returns `chain` in the opposite direction.
fn reversed(chain: &[Edge]) -> Vec<Edge> {
    chain.iter().rev().map(Edge::reversed).collect()
}

/// Returns the closed chain `chain` with edges that begin exactly where the edges before them end.
fn shut(mut chain: Vec<Edge>) -> Vec<Edge> {
    for k in 0..chain.len() {
        let end = chain[(k + chain.len() - 1) % chain.len()].end;
        chain[k].start = end;
    }
    chain.retain(|edge| edge.start != edge.end);
    chain
}
