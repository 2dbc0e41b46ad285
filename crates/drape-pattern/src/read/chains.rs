//! Chains of edges whose ends meet: closed outlines of lines that were drawn apart.

use crate::edge::{Edge, distance};

/// Distance between ends that count as one point, in m: the rounding of drawings.
const MEET: f64 = 1e-4;

/// Largest number of chains that are tried against each other.
const MOST: usize = 5000;

/// Joins chains whose ends meet, takes out those that close, and returns them.
pub(crate) fn joined(chains: &mut Vec<Vec<Edge>>) -> Vec<Vec<Edge>> {
    chains.retain(|chain| !chain.is_empty());
    let mut closed = Vec::new();
    if chains.len() > MOST {
        return closed;
    }
    let mut open: Vec<Vec<Edge>> = Vec::new();
    let mut left = std::mem::take(chains);
    left.reverse();
    while let Some(mut chain) = left.pop() {
        loop {
            let (start, end) = (chain[0].start, chain[chain.len() - 1].end);
            let long = chain.len() > 1;
            if long && distance(start, end) <= MEET {
                closed.push(shut(chain));
                break;
            }
            let meets = |other: &Vec<Edge>| {
                let (from, to) = (other[0].start, other[other.len() - 1].end);
                [from, to].iter().any(|p| distance(end, *p) <= MEET || distance(start, *p) <= MEET)
            };
            let Some(number) = left.iter().rposition(meets) else {
                open.push(chain);
                break;
            };
            let other = left.remove(number);
            let (from, to) = (other[0].start, other[other.len() - 1].end);
            let flipped = || other.iter().rev().map(Edge::reversed).collect::<Vec<Edge>>();
            let before = |mut first: Vec<Edge>, then: Vec<Edge>| {
                first.extend(then);
                first
            };
            chain = if distance(end, from) <= MEET {
                before(chain, other)
            } else if distance(end, to) <= MEET {
                let other = flipped();
                before(chain, other)
            } else if distance(start, to) <= MEET {
                before(other, chain)
            } else {
                before(flipped(), chain)
            };
        }
    }
    *chains = open;
    closed
}

/// Returns a closed chain whose edges begin exactly where those before them end.
fn shut(mut chain: Vec<Edge>) -> Vec<Edge> {
    for k in 0..chain.len() {
        let end = chain[(k + chain.len() - 1) % chain.len()].end;
        chain[k].start = end;
    }
    chain.retain(|edge| edge.start != edge.end);
    chain
}
