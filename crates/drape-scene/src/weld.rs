use drape_collide::classes;
use drape_implicit::{BlockMatrix, Error, Motion, Pattern, Report, Stiffness, System, Way};

use crate::scheme::{Integration, Scheme};
use crate::world::World;

/// Which nodes of a sewn cloth are one particle of the system that is solved.
///
/// The cloth, its contact and its frames know the nodes of the panels; nodes that are sewn to each other have one place
/// and one velocity. With the map `$S$` from particles to nodes the forces are `$S^Tf(Sx)$` and the stiffness is
/// `$S^TKS$`.
#[derive(Debug)]
pub(crate) struct Weld {
    /// The particle of each node.
    particle: Vec<u32>,
    masses: Vec<f64>,
    held: Vec<bool>,
    /// Room for places, ways and forces of the nodes.
    places: Vec<f64>,
    others: Vec<f64>,
    /// The stiffness of the nodes, and where each of its blocks goes.
    matrix: BlockMatrix,
    goals: Vec<Goal>,
    pattern: Pattern,
}

/// Where a block of the nodes' matrix goes in that of the particles.
#[derive(Debug, Clone, Copy)]
struct Goal {
    slot: u32,
    /// Whether it is turned round.
    turned: bool,
    /// Whether it couples two nodes of one particle, and so goes there both ways.
    twice: bool,
}

/// A world whose sewn nodes are one particle each.
pub(crate) struct Sewn<'a> {
    pub(crate) world: &'a mut World,
    pub(crate) weld: &'a mut Weld,
}

impl Weld {
    /// Joins the nodes of pairs in a world.
    ///
    /// # Errors
    /// A pair of nodes that are not there.
    pub(crate) fn new(world: &World, pairs: &[[u32; 2]]) -> Result<Self, Error> {
        let particle = particles(world.particles(), pairs);
        let masses = masses_of(&particle, world.masses());
        let count = masses.len();
        let nodes = world.pattern();
        let blocks = (0..nodes.particles()).flat_map(|row| {
            let columns = &nodes.columns()[nodes.row(row)];
            columns.iter().map(move |&column| [row, column as usize])
        });
        let blocks: Vec<[usize; 2]> =
            blocks.map(|nodes| nodes.map(|node| particle[node] as usize)).collect();
        let pattern =
            Pattern::from_pairs(count, blocks.iter().map(|&[row, column]| (row, column)))?;
        // The first block of a row of nodes is that of a node with itself.
        let mut goals = Vec::with_capacity(blocks.len());
        for row in 0..nodes.particles() {
            for slot in nodes.row(row) {
                let [a, b] = blocks[slot];
                let goal = pattern.slot(a, b).unwrap_or_default() as u32;
                let twice = a == b && slot != nodes.row(row).start;
                goals.push(Goal { slot: goal, turned: a > b, twice });
            }
        }
        let numbers = 3 * particle.len();
        Ok(Self {
            particle,
            masses,
            held: vec![false; count],
            places: vec![0.0; numbers],
            others: vec![0.0; numbers],
            matrix: BlockMatrix::zeros(nodes),
            goals,
            pattern,
        })
    }

    /// Sets up a scheme for the sewn world.
    pub(crate) fn start(
        &mut self,
        world: &mut World,
        scheme: &Scheme,
    ) -> Result<Integration, Error> {
        scheme.start(&Sewn { world, weld: self })
    }

    /// Advances the motion of all nodes by a step, in s.
    pub(crate) fn advance(
        &mut self,
        (world, integration): (&mut World, &mut Integration),
        motion: &mut Motion,
        dt: f64,
    ) -> Result<Report, Error> {
        let previous = motion.previous.as_ref().map(|previous| drape_implicit::Previous {
            dt: previous.dt,
            positions: self.narrow(&previous.positions),
            velocities: self.narrow(&previous.velocities),
        });
        let mut own = Motion {
            time: motion.time,
            positions: self.narrow(&motion.positions),
            velocities: self.narrow(&motion.velocities),
            previous,
        };
        let report = integration.advance(&mut Sewn { world, weld: self }, &mut own, dt);
        // Also a step that failed has moved on by the parts that were made.
        motion.time = own.time;
        self.widen(&own.positions, &mut motion.positions);
        self.widen(&own.velocities, &mut motion.velocities);
        motion.previous = own.previous.map(|previous| {
            let widen = |values: &[f64]| {
                let mut wide = vec![0.0; motion.positions.len()];
                self.widen(values, &mut wide);
                wide
            };
            drape_implicit::Previous {
                dt: previous.dt,
                positions: widen(&previous.positions),
                velocities: widen(&previous.velocities),
            }
        });
        report
    }

    /// The values of the particles from equal ones of their nodes.
    pub(crate) fn narrow(&self, values: &[f64]) -> Vec<f64> {
        let mut own = vec![0.0; 3 * self.masses.len()];
        for (&particle, value) in self.particle.iter().zip(values.chunks_exact(3)) {
            own[3 * particle as usize..][..3].copy_from_slice(value);
        }
        own
    }

    /// Gives every node the values of its particle.
    pub(crate) fn widen(&self, values: &[f64], nodes: &mut [f64]) {
        for (&particle, node) in self.particle.iter().zip(nodes.chunks_exact_mut(3)) {
            node.copy_from_slice(&values[3 * particle as usize..][..3]);
        }
    }
}

impl Sewn<'_> {
    /// Calls the world with the places of the nodes.
    fn at<T>(&mut self, positions: &[f64], ask: impl FnOnce(&mut World, &[f64]) -> T) -> T {
        let mut places = std::mem::take(&mut self.weld.places);
        self.weld.widen(positions, &mut places);
        let answer = ask(self.world, &places);
        self.weld.places = places;
        answer
    }
}

impl System for Sewn<'_> {
    fn particles(&self) -> usize {
        self.weld.masses.len()
    }

    fn masses(&self) -> &[f64] {
        &self.weld.masses
    }

    fn held(&self) -> &[bool] {
        &self.weld.held
    }

    fn begin(&mut self, end_time: f64, dt: f64, start: &[f64], target: &mut [f64]) {
        let mut ends = std::mem::take(&mut self.weld.others);
        self.at(start, |world, places| {
            ends.copy_from_slice(places);
            world.begin(end_time, dt, places, &mut ends);
        });
        self.weld.held.fill(false);
        let nodes = self.weld.particle.iter().zip(self.world.held()).zip(ends.chunks_exact(3));
        for ((&particle, _), end) in nodes.filter(|((_, held), _)| **held) {
            self.weld.held[particle as usize] = true;
            target[3 * particle as usize..][..3].copy_from_slice(end);
        }
        self.weld.others = ends;
    }

    fn forces(&mut self, positions: &[f64], forces: &mut [f64]) {
        let mut pulls = std::mem::take(&mut self.weld.others);
        self.at(positions, |world, places| world.forces(places, &mut pulls));
        forces.fill(0.0);
        for (&particle, pull) in self.weld.particle.iter().zip(pulls.chunks_exact(3)) {
            let force = &mut forces[3 * particle as usize..][..3];
            force.iter_mut().zip(pull).for_each(|(force, pull)| *force += pull);
        }
        self.weld.others = pulls;
    }

    fn potential(&mut self, positions: &[f64]) -> f64 {
        self.at(positions, World::potential)
    }

    fn stiffness(&mut self, positions: &[f64], kind: Stiffness, matrix: &mut BlockMatrix) {
        let mut places = std::mem::take(&mut self.weld.places);
        self.weld.widen(positions, &mut places);
        let Weld { matrix: nodes, goals, particle, .. } = &mut *self.weld;
        nodes.clear();
        self.world.stiffness(&places, kind, nodes);
        for (block, goal) in nodes.blocks().iter().zip(&*goals) {
            let slot = goal.slot as usize;
            if goal.turned || goal.twice {
                matrix.add_block(slot, &transposed(block));
            }
            if !goal.turned {
                matrix.add_block(slot, block);
            }
        }
        for (row, column, block) in nodes.beyond() {
            let [row, column] = [row, column].map(|node| particle[node] as usize);
            matrix.couple(row, column, block);
            if row == column {
                matrix.couple(row, column, &transposed(block));
            }
        }
        if nodes.stray().is_some() {
            // No particle has such a number: the step ends with an error.
            matrix.add(usize::MAX, usize::MAX, &[0.0; 9]);
        }
        self.weld.places = places;
    }

    fn pattern(&self) -> Pattern {
        self.weld.pattern.clone()
    }

    fn is_straight(&self, start: f64, end: f64) -> bool {
        self.world.is_straight(start, end)
    }

    fn guards(&self) -> bool {
        self.world.guards()
    }

    fn allow(&mut self, way: Way<'_>) -> bool {
        let mut steps = std::mem::take(&mut self.weld.others);
        self.weld.widen(way.step, &mut steps);
        let Way { from, step, progress, advance } = way;
        let whole = self.at(from, |world, places| {
            world.allow(Way { from: places, step: &mut steps, progress, advance })
        });
        // Any part of a way that is allowed is allowed too: the shortest is all nodes'.
        if !whole {
            let length = |way: &[f64]| way.iter().map(|x| x * x).sum::<f64>();
            for (&particle, left) in self.weld.particle.iter().zip(steps.chunks_exact(3)) {
                let own = &mut step[3 * particle as usize..][..3];
                if length(left) < length(own) {
                    own.copy_from_slice(left);
                }
            }
        }
        self.weld.others = steps;
        whole
    }

    fn arrive(&mut self, progress: f64) {
        self.world.arrive(progress);
    }

    fn certify(&mut self, positions: &[f64]) -> bool {
        self.at(positions, World::certify)
    }

    fn accept(&mut self, positions: &[f64], velocities: &[f64], dt: f64) {
        let mut speeds = std::mem::take(&mut self.weld.others);
        self.weld.widen(velocities, &mut speeds);
        self.at(positions, |world, places| world.accept(places, &speeds, dt));
        self.weld.others = speeds;
    }
}

/// Moves the nodes of pairs to the middle of all that they are sewn to, weighed with the masses of the nodes.
pub(crate) fn join(pairs: &[[u32; 2]], masses: &[f64], values: &mut [f64]) {
    let particle = particles(masses.len(), pairs);
    let whole = masses_of(&particle, masses);
    let mut means = vec![[0.0; 3]; whole.len()];
    for ((&particle, mass), value) in particle.iter().zip(masses).zip(values.chunks_exact(3)) {
        let part = mass / whole[particle as usize];
        (0..3).for_each(|axis| means[particle as usize][axis] += part * value[axis]);
    }
    for (&particle, value) in particle.iter().zip(values.chunks_exact_mut(3)) {
        value.copy_from_slice(&means[particle as usize]);
    }
}

/// Masses of the particles from those of their nodes.
fn masses_of(particle: &[u32], nodes: &[f64]) -> Vec<f64> {
    let count = particle.iter().max().map_or(0, |last| *last as usize + 1);
    let mut masses = vec![0.0; count];
    for (&particle, mass) in particle.iter().zip(nodes) {
        masses[particle as usize] += mass;
    }
    masses
}

/// A particle for each node, numbered in the order of their first nodes; those of a pair have the same.
fn particles(nodes: usize, pairs: &[[u32; 2]]) -> Vec<u32> {
    let first = classes(nodes, pairs);
    let mut count = 0;
    let mut particle = vec![0; nodes];
    for node in 0..nodes {
        let own = first[node] as usize;
        if own == node {
            particle[node] = count;
            count += 1;
        } else {
            particle[node] = particle[own];
        }
    }
    particle
}

fn transposed(block: &[f64; 9]) -> [f64; 9] {
    std::array::from_fn(|k| block[3 * (k % 3) + k / 3])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_in_pairs_are_one_particle_through_any_chain() {
        assert_eq!(particles(6, &[[4, 1], [5, 4], [2, 2]]), [0, 1, 2, 3, 1, 1]);
        assert_eq!(particles(3, &[]), [0, 1, 2]);
    }
}
