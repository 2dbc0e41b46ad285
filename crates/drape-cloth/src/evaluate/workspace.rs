//! Workspace: evaluates a cloth many times on all threads, without allocating memory. Solvers call
//! it.

use pulp::Arch;

use crate::cloth::Cloth;
use crate::error::{Error, check_length};
use crate::evaluate::dispatch::{
    AddForces, AddRimForces, AddRimStiffness, AddStiffness, Commit, CommitRim, Potential,
    RimPotential,
};
use crate::evaluate::parallel::{BufferPool, Parts, for_each};
use crate::kernel::buffers::{StripBuffers, StripTrial};
use crate::kernel::energy::{self, StripCommit, StripShape};
use crate::kernel::memories::GridTail;
use crate::layout::strip::Strip;
use crate::rim;
use crate::rim::connectors::{Rim, RimShape};
use crate::rim::stiffness::RimStiffness;
use crate::state::State;
use crate::threads::thread_count;

/// Buffers for evaluating one cloth many times. Memory is allocated only by [`Cloth::workspace`].
///
/// The methods correspond to methods of [`Cloth`]. They use the threads of the pool in which the
/// workspace was made, and the widest vector instructions of the machine. The numbers depend on
/// neither: the cloth is cut into the same strips for any number of threads, and the sums of the
/// strips are added in their order.
#[derive(Debug, Clone)]
pub struct Workspace {
    pool: BufferPool,
    /// Sums of each strip, then of each rim.
    sums: Vec<f64>,
    arch: Arch,
    /// Fingerprint of the cloth.
    fingerprint: u64,
}

/// Trial positions at which a cloth is evaluated, and the state whose memory its laws start from.
///
/// [`Cloth::trial`] checks the lists and returns a trial.
#[derive(Debug, Clone, Copy)]
pub struct Trial<'a> {
    pub(crate) cloth: &'a Cloth,
    pub(crate) state: &'a State,
    pub(crate) positions: &'a [f64],
}

impl<'a> Trial<'a> {
    /// Returns the cloth that is evaluated.
    #[must_use]
    pub fn cloth(&self) -> &'a Cloth {
        self.cloth
    }

    /// Returns the state at the start of the step.
    #[must_use]
    pub fn state(&self) -> &'a State {
        self.state
    }

    /// Returns the trial positions, three numbers for each particle, in m.
    #[must_use]
    pub fn positions(&self) -> &'a [f64] {
        self.positions
    }

    fn strip(self, strip: &'a Strip) -> StripTrial<'a> {
        let Self { cloth, state, positions } = self;
        let panel = &cloth.panels[strip.panel];
        StripTrial { panel, strip, memories: &state.grid, positions }
    }

    fn rim(self, rim: &'a Rim) -> RimShape<'a> {
        let Self { cloth, state, positions } = self;
        RimShape { rim, panel: &cloth.panels[rim.panel], normals: &state.normals, positions }
    }
}

impl Workspace {
    pub(crate) fn new(cloth: &Cloth) -> Self {
        let lengths =
            cloth.strips.iter().map(|strip| strip.buffer_length(cloth.panels[strip.panel].margin));
        let buffers = StripBuffers::new(lengths.max().unwrap_or(0));
        let threads = thread_count().min(cloth.strips.len());
        Self {
            pool: BufferPool::new(&buffers, threads),
            sums: vec![0.0; cloth.strips.len() + cloth.rims.len()],
            arch: Arch::new(),
            fingerprint: cloth.fingerprint(),
        }
    }

    /// Checks that this workspace belongs to `cloth`.
    fn check(&self, cloth: &Cloth) -> Result<(), Error> {
        let is_own = self.fingerprint == cloth.fingerprint();
        if is_own { Ok(()) } else { Err(Error::OtherCloth { what: "workspace" }) }
    }

    /// Adds the forces to `forces`, in N, like [`Cloth::add_forces`].
    ///
    /// # Errors
    /// The trial is of another cloth, or `forces` does not have three numbers for every
    /// particle.
    pub fn add_forces(&mut self, trial: Trial<'_>, forces: &mut [f64]) -> Result<(), Error> {
        let Trial { cloth, state, .. } = trial;
        self.check(cloth)?;
        cloth.check_vectors("forces", forces)?;
        let (arch, pool) = (self.arch, &self.pool);

        // Strips write to the particles of the grids, rims to all particles of their panel.
        for_each(
            Parts { parts: &cloth.strips, pool },
            &mut *forces,
            &|forces, from, to| {
                forces.split_at_mut(3 * (to.particles.start - from.particles.start))
            },
            &|strip, buffers, forces| {
                arch.dispatch(AddForces { buffers, trial: trial.strip(strip), forces });
            },
        );

        let Some(first) = cloth.rims.first() else { return Ok(()) };
        for_each(
            Parts { parts: &cloth.rims, pool },
            &mut forces[3 * first.particles.start..],
            &|forces, from, to| {
                forces.split_at_mut(3 * (to.particles.start - from.particles.start))
            },
            &|rim, _, forces| {
                let (shape, memories) = (trial.rim(rim), &state.rim);
                arch.dispatch(AddRimForces { shape, memories, forces });
            },
        );
        Ok(())
    }

    /// Returns the potential, in J, like [`Cloth::potential`].
    ///
    /// # Errors
    /// The trial is of another cloth.
    pub fn potential(&mut self, trial: Trial<'_>) -> Result<f64, Error> {
        let Trial { cloth, state, .. } = trial;
        self.check(cloth)?;
        let (arch, pool) = (self.arch, &self.pool);
        let (sums, rim_sums) = self.sums.split_at_mut(cloth.strips.len());

        for_each(
            Parts { parts: &cloth.strips, pool },
            sums,
            &|sums, from, to| sums.split_at_mut(to.index - from.index),
            &|strip, buffers, sums| {
                sums[0] = arch.dispatch(Potential { buffers, trial: trial.strip(strip) });
            },
        );

        for_each(
            Parts { parts: &cloth.rims, pool },
            rim_sums,
            &|sums, from, to| sums.split_at_mut(to.index - from.index),
            &|rim, _, sums| {
                let (shape, memories) = (trial.rim(rim), &state.rim);
                sums[0] = arch.dispatch(RimPotential { shape, memories });
            },
        );

        Ok(self.sums.iter().sum())
    }

    /// Adds the stiffness to `values`, in N/m, like [`Cloth::add_stiffness`].
    ///
    /// # Errors
    /// The trial is of another cloth, or `values` does not have nine numbers for every
    /// block.
    pub fn add_stiffness(
        &mut self,
        trial: Trial<'_>,
        definite: bool,
        values: &mut [f64],
    ) -> Result<(), Error> {
        let Trial { cloth, state, .. } = trial;
        self.check(cloth)?;
        check_length("stiffness values", 9 * cloth.sparsity().block_count(), values.len())?;
        let (arch, pool) = (self.arch, &self.pool);

        for_each(
            Parts { parts: &cloth.strips, pool },
            &mut *values,
            &|values, from, to| values.split_at_mut(9 * (to.blocks.start - from.blocks.start)),
            &|strip, buffers, values| {
                let trial = trial.strip(strip);
                arch.dispatch(AddStiffness { buffers, trial, definite, values });
            },
        );

        let Some(first) = cloth.rims.first() else { return Ok(()) };
        for_each(
            Parts { parts: &cloth.rims, pool },
            &mut values[9 * first.blocks.start..],
            &|values, from, to| values.split_at_mut(9 * (to.blocks.start - from.blocks.start)),
            &|rim, _, values| {
                let stiffness =
                    RimStiffness { shape: trial.rim(rim), memories: &state.rim, definite };
                arch.dispatch(AddRimStiffness { stiffness, values });
            },
        );
        Ok(())
    }

    /// Accepts a step and returns the energy dissipated, in J, like [`Cloth::commit`].
    ///
    /// # Errors
    /// As [`Cloth::commit`], or this workspace belongs to another cloth.
    pub fn commit(
        &mut self,
        cloth: &Cloth,
        state: &mut State,
        positions: &[f64],
        velocities: &[f64],
    ) -> Result<f64, Error> {
        self.check(cloth)?;
        cloth.check_state(state)?;
        cloth.check_vectors("positions", positions)?;
        cloth.check_vectors("velocities", velocities)?;
        state.positions.copy_from_slice(positions);
        state.velocities.copy_from_slice(velocities);
        cloth.update_normals(state);

        // Strips write the memories of the grids from the first strip on.
        let State { normals: flat_normals, grid, rim: rim_memories, .. } = state;
        let GridTail { memories, normals } = grid.tail_mut(first_index(cloth, &cloth.strips[0]));
        let (arch, pool) = (self.arch, &self.pool);
        let (sums, rim_sums) = self.sums.split_at_mut(cloth.strips.len());
        for_each(
            Parts { parts: &cloth.strips, pool },
            (memories, sums),
            &|(memories, sums), from, to| {
                let length = first_index(cloth, to) - first_index(cloth, from);
                let [memories, later_memories] = memories.split(length);
                let (sums, later_sums) = sums.split_at_mut(to.index - from.index);
                ((memories, sums), (later_memories, later_sums))
            },
            &|strip, buffers, (memories, sums)| {
                let panel = &cloth.panels[strip.panel];
                let commit = StripCommit { panel, strip, memories, normals, positions };
                sums[0] = arch.dispatch(Commit { buffers, commit });
            },
        );

        // Rims write the memories of the rims.
        let flat_normals = flat_normals.as_slice();
        for_each(
            Parts { parts: &cloth.rims, pool },
            (rim_memories.all_mut(), rim_sums),
            &|(memories, sums), from, to| {
                let [memories, later_memories] = memories.split(from, to);
                let (sums, later_sums) = sums.split_at_mut(to.index - from.index);
                ((memories, sums), (later_memories, later_sums))
            },
            &|rim, _, (memories, sums)| {
                let panel = &cloth.panels[rim.panel];
                let shape = RimShape { rim, panel, normals: flat_normals, positions };
                sums[0] = arch.dispatch(CommitRim { shape, memories });
            },
        );
        Ok(self.sums.iter().sum())
    }

    /// Returns the energy that the connectors of `cloth` can return at `state`, in J.
    ///
    /// # Errors
    /// The state or this workspace belongs to another cloth.
    pub fn stored(&mut self, cloth: &Cloth, state: &State) -> Result<f64, Error> {
        self.check(cloth)?;
        cloth.check_state(state)?;
        let trial = Trial { cloth, state, positions: &state.positions };
        let buffers = self.pool.exclusive();
        let strips = cloth.strips.iter();
        let strips: f64 = strips.map(|strip| energy::stored(buffers, &trial.strip(strip))).sum();
        let rims = cloth.rims.iter();
        let rims = rims.map(|rim| rim::energy::stored(&trial.rim(rim), &state.rim));
        Ok(strips + rims.sum::<f64>())
    }

    /// Writes the memories of `state` for a `cloth` that starts at its positions without friction.
    pub(crate) fn start(&mut self, cloth: &Cloth, state: &mut State) {
        let State { positions, normals, grid, rim: rim_memories, .. } = state;
        let buffers = self.pool.exclusive();
        for strip in &cloth.strips {
            let panel = &cloth.panels[strip.panel];
            energy::start(buffers, StripShape { panel, strip, positions }, grid);
        }
        for rim in &cloth.rims {
            let panel = &cloth.panels[rim.panel];
            let shape = RimShape { rim, panel, normals, positions };
            rim::energy::start(&shape, rim_memories);
        }
    }
}

/// Returns the index of the first point of `strip` in the columns of `cloth`.
fn first_index(cloth: &Cloth, strip: &Strip) -> usize {
    strip.offset + cloth.panels[strip.panel].margin
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use drape_fabric::Fabric;
    use drape_input::Document;

    use super::*;
    use crate::panel::lattice::Lattice;

    #[test]
    fn the_vector_instructions_change_no_bit() {
        let text = r#"
            name = "plain weave"
            density = 0.12
            thickness = 0.0003
            [shear]
            stiffness = 35.0
            growth = 6.0
            friction = [{ plateau = 0.5, length = 0.004 }]
            locking = { onset = 0.139, limit = 0.867 }
            [warp]
            traction.friction = [{ plateau = 3.0, length = 0.001 }]
            traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
            bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4 }] }
            [weft]
            traction.polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
            bending.piecewise = { slope = 2e-5, intercept = 4e-4, knot = 40.0 }
        "#;
        let fabric = Fabric::from_document(&Document::new("plain.toml", text)).expect("right");
        let lattice = Lattice::disc(0.2, 0.01).expect("a disc");
        let cloth = Cloth::new(&[(&lattice, &fabric)]).expect("a cloth");
        let place = |time: f64| -> Vec<f64> {
            let wave = |&[u, v]: &[f64; 2]| {
                let height = 0.02 * (30.0 * u + 17.0 * v + time).sin();
                [u * (1.0 + 0.02 * time), v + 0.1 * time * u * u, height]
            };
            cloth.coordinates().iter().flat_map(wave).collect()
        };
        let run = |arch: Arch| {
            let mut workspace = Workspace { arch, ..cloth.workspace() };
            let mut state = cloth.state(place(0.0)).expect("it fits");
            let zeros = vec![0.0; 3 * cloth.particle_count()];
            let lost = workspace.commit(&cloth, &mut state, &place(0.5), &zeros);
            let (mut forces, trial) = (zeros, place(0.3));
            let trial = cloth.trial(&state, &trial).expect("it fits");
            workspace.add_forces(trial, &mut forces).expect("it fits");
            let mut values = vec![0.0; 9 * cloth.sparsity().block_count()];
            workspace.add_stiffness(trial, false, &mut values).expect("it fits");
            let potential = workspace.potential(trial);
            (state, lost, forces, values, potential)
        };
        let (wide, narrow) = (run(Arch::new()), run(Arch::Scalar));
        assert!(wide == narrow, "on a machine with {:?}", Arch::new());
    }
}
