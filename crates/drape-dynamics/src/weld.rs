mod share;
mod system;

use drape_implicit::{BlockMatrix, Error, IntegratorState, Report, Sparsity, System};
use drape_scene::Stitching;

use crate::scheme::{Integration, Scheme};
use crate::weld::share::{Share, chains, couples, interpolate, masses_of, places_of};
use crate::world::World;

pub(crate) use share::join;

/// Which nodes of a sewn cloth are one particle of the system that is solved.
///
/// The cloth, its contact and its frames know the nodes of the panels; nodes that are sewn to each other have one place
/// and one velocity, and a tied node has those of a place between two particles. With the map `$S$` from particles to
/// nodes the forces are `$S^Tf(Sx)$` and the stiffness is `$S^TKS$`. Tied nodes have no mass of their own.
#[derive(Debug)]
pub(crate) struct Weld {
    /// The particles of each node.
    places_of: Vec<Share>,
    masses: Vec<f64>,
    held: Vec<bool>,
    /// Particles that tied nodes join, directly or through others, in groups.
    chains: Vec<Vec<u32>>,
    /// Room for places, ways and forces of the nodes.
    places: Vec<f64>,
    others: Vec<f64>,
    /// The stiffness of the nodes, and where each of its blocks goes.
    matrix: BlockMatrix,
    goals: Vec<Goal>,
    sparsity: Sparsity,
}

/// Where a block of the nodes' matrix goes in that of the particles.
#[derive(Debug, Clone, Copy)]
struct Goal {
    /// The block.
    from: u32,
    slot: u32,
    /// Whether it is turned round.
    turned: bool,
    /// Whether it couples two nodes of one particle, and so goes there both ways.
    twice: bool,
    /// How much of it.
    weight: f64,
}

/// A world whose sewn nodes are one particle each.
pub(crate) struct Sewn<'a> {
    pub(crate) world: &'a mut World,
    pub(crate) weld: &'a mut Weld,
}

impl Weld {
    /// Joins the nodes of a world that are sewn together.
    ///
    /// # Errors
    /// Nodes that are not there.
    pub(crate) fn new(world: &World, sewn: &Stitching) -> Result<Self, Error> {
        let places_of = places_of(world.particles(), sewn);
        let masses = masses_of(&places_of, world.masses());
        let count = masses.len();
        let nodes = world.sparsity();
        // The first block of a row of nodes is that of a node with itself.
        let blocks = (0..nodes.particles()).flat_map(|row| {
            let start = nodes.row(row).start;
            nodes.row(row).map(move |slot| (slot, row, slot == start))
        });
        let mut goals = Vec::with_capacity(nodes.blocks());
        for (slot, row, diagonal) in blocks {
            let ends = [row, nodes.columns()[slot] as usize].map(|node| &places_of[node]);
            for ([a, b], weight) in couples(ends, diagonal) {
                let twice = a == b && !diagonal;
                let goal = Goal { from: slot as u32, slot: 0, turned: a > b, twice, weight };
                goals.push(([a, b], goal));
            }
        }
        let sparsity = Sparsity::from_pairs(count, goals.iter().map(|&(pair, _)| pair))?;
        let goals = goals.into_iter().map(|([a, b], goal)| {
            let slot = sparsity.slot(a, b).unwrap_or_default() as u32;
            Goal { slot, ..goal }
        });
        let numbers = 3 * places_of.len();
        Ok(Self {
            chains: chains(&places_of, count),
            goals: goals.collect(),
            places_of,
            masses,
            held: vec![false; count],
            places: vec![0.0; numbers],
            others: vec![0.0; numbers],
            matrix: BlockMatrix::zeros(nodes),
            sparsity,
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
        motion: &mut IntegratorState,
        dt: f64,
    ) -> Result<Report, Error> {
        let previous = motion.previous.as_ref().map(|previous| drape_implicit::PreviousState {
            dt: previous.dt,
            positions: self.narrow(&previous.positions),
            velocities: self.narrow(&previous.velocities),
        });
        let mut own = IntegratorState {
            time: motion.time,
            positions: self.narrow(&motion.positions),
            velocities: self.narrow(&motion.velocities),
            previous,
        };
        let filtered = world.surfaces.is_some();
        let mut sewn = Sewn { world, weld: self };
        let report = match filtered {
            true => integration.advance_filtered(&mut sewn, &mut own, dt),
            false => integration.advance(&mut sewn, &mut own, dt),
        };
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
            drape_implicit::PreviousState {
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
        let nodes = self.places_of.iter().zip(values.chunks_exact(3));
        for (place, value) in nodes.filter(|(place, _)| !place.is_tied()) {
            own[3 * place.particles[0] as usize..][..3].copy_from_slice(value);
        }
        own
    }

    /// Gives every node the values of its place.
    pub(crate) fn widen(&self, values: &[f64], nodes: &mut [f64]) {
        for (place, node) in self.places_of.iter().zip(nodes.chunks_exact_mut(3)) {
            interpolate(place, values, node);
        }
    }

    /// Shortens the ways of the particles to what is left of those of their nodes.
    fn shorten(&self, left: &[f64], ways: &mut [f64]) {
        let length = |way: &[f64]| way.iter().map(|x| x * x).sum::<f64>();
        let nodes = || self.places_of.iter().zip(left.chunks_exact(3));
        // A tied node goes a part of its way if both its ends go the same part of theirs.
        let mut parts = vec![1.0; self.masses.len()];
        if !self.chains.is_empty() {
            for (place, left) in nodes() {
                let mut whole = [0.0; 3];
                interpolate(place, ways, &mut whole);
                let (left, whole) = (length(left), length(&whole));
                let part = if left < whole { (left / whole).sqrt() } else { 1.0 };
                for (particle, _) in place.parts() {
                    parts[particle] = part.min(parts[particle]);
                }
            }
        }
        for chain in &self.chains {
            let part = chain.iter().map(|&particle| parts[particle as usize]).fold(1.0, f64::min);
            for &particle in chain {
                let own = &mut ways[3 * particle as usize..][..3];
                own.iter_mut().for_each(|way| *way *= part);
            }
        }
        for (place, left) in nodes().filter(|(place, _)| !place.is_tied()) {
            let own = &mut ways[3 * place.particles[0] as usize..][..3];
            if length(left) < length(own) {
                own.copy_from_slice(left);
            }
        }
    }
}
