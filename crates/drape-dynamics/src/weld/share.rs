use std::collections::{BTreeMap, BTreeSet};

use drape_cloth::Tie;
use drape_collide::equivalence_classes;
use drape_scene::Stitching;

/// Where a node is: at a particle, or at a part of the way from one to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Share {
    pub(super) particles: [u32; 2],
    /// Part of the way to the second; 0 at a particle.
    pub(super) part: f64,
}

impl Share {
    /// The particles, each with its weight.
    pub(super) fn parts(&self) -> impl Iterator<Item = (usize, f64)> {
        let [first, second] = self.particles.map(|particle| particle as usize);
        let both = [(first, 1.0 - self.part), (second, self.part)];
        both.into_iter().take(if self.is_tied() { 2 } else { 1 })
    }

    pub(super) fn is_tied(&self) -> bool {
        self.part != 0.0
    }
}

/// The particles of a block's row and column, with the weight of each pair; of a node with itself each pair once.
pub(super) fn couples(
    [row, column]: [&Share; 2],
    diagonal: bool,
) -> impl Iterator<Item = ([usize; 2], f64)> {
    row.parts().flat_map(move |(a, weight)| {
        let all = column.parts().map(move |(b, other)| ([a, b], weight * other));
        all.filter(move |([a, b], _)| !diagonal || a <= b)
    })
}

/// Moves the nodes of pairs to the middle of all that they are sewn to, weighed with the masses of the nodes, and those
/// that are tied between them.
pub(crate) fn join(sewn: &Stitching, masses: &[f64], values: &mut [f64]) {
    let places = places_of(masses.len(), sewn);
    let nodes = || places.iter().zip(masses).filter(|(place, _)| !place.is_tied());
    let own = |place: &Share| place.particles[0] as usize;
    let mut whole = vec![0.0; places.iter().map(|place| own(place) + 1).max().unwrap_or(0)];
    nodes().for_each(|(place, mass)| whole[own(place)] += mass);
    let mut means = vec![0.0; 3 * whole.len()];
    let all = places.iter().zip(masses).zip(values.chunks_exact(3));
    for ((place, mass), value) in all.filter(|((place, _), _)| !place.is_tied()) {
        let part = mass / whole[own(place)];
        (0..3).for_each(|axis| means[3 * own(place) + axis] += part * value[axis]);
    }
    for (place, value) in places.iter().zip(values.chunks_exact_mut(3)) {
        interpolate(place, &means, value);
    }
}

/// The value at a place, of those of all particles.
pub(super) fn interpolate(place: &Share, values: &[f64], value: &mut [f64]) {
    let [first, second] = place.particles.map(|particle| &values[3 * particle as usize..][..3]);
    value.copy_from_slice(first);
    if place.is_tied() {
        value.iter_mut().zip(second).for_each(|(x, end)| *x += place.part * (end - *x));
    }
}

/// Masses of the particles from those of their nodes.
pub(super) fn masses_of(places: &[Share], nodes: &[f64]) -> Vec<f64> {
    let count = places.iter().map(|place| place.particles[0] as usize + 1).max().unwrap_or(0);
    let mut masses = vec![0.0; count];
    for (place, mass) in places.iter().zip(nodes) {
        place.parts().for_each(|(particle, weight)| masses[particle] += weight * mass);
    }
    masses
}

/// Where each node is. The particles are numbered in the order of their first nodes; the nodes of a pair have the same.
pub(super) fn places_of(nodes: usize, sewn: &Stitching) -> Vec<Share> {
    let first = equivalence_classes(nodes, &sewn.pairs);
    let mut tie = vec![None; nodes];
    sewn.ties.iter().for_each(|own| tie[own.particle as usize] = Some(*own));
    let mut count = 0;
    let mut particle = vec![0; nodes];
    for node in (0..nodes).filter(|&node| tie[node].is_none()) {
        let own = first[node] as usize;
        if own == node {
            particle[node] = count;
            count += 1;
        } else {
            particle[node] = particle[own];
        }
    }
    let place = |node: usize| match tie[node] {
        Some(Tie { ends, fraction, .. }) => {
            Share { particles: ends.map(|end| particle[end as usize]), part: fraction }
        }
        None => Share { particles: [particle[node]; 2], part: 0.0 },
    };
    (0..nodes).map(place).collect()
}

/// The particles that tied nodes join, in groups.
pub(super) fn chains(places: &[Share], particles: usize) -> Vec<Vec<u32>> {
    let tied: Vec<[u32; 2]> =
        places.iter().filter(|place| place.is_tied()).map(|place| place.particles).collect();
    let first = equivalence_classes(particles, &tied);
    let mut chains: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    let joined: BTreeSet<u32> = tied.into_iter().flatten().collect();
    joined.into_iter().for_each(|own| chains.entry(first[own as usize]).or_default().push(own));
    chains.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_in_pairs_are_one_particle_through_any_chain() {
        let particles = |nodes: usize, pairs: &[[u32; 2]]| -> Vec<u32> {
            let sewn = Stitching { pairs: pairs.to_vec(), ties: Vec::new() };
            places_of(nodes, &sewn).iter().map(|place| place.particles[0]).collect()
        };
        assert_eq!(particles(6, &[[4, 1], [5, 4], [2, 2]]), [0, 1, 2, 3, 1, 1]);
        assert_eq!(particles(3, &[]), [0, 1, 2]);
    }
}
