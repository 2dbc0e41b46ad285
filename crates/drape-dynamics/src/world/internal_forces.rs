//! Internal forces of the cloth: connectors of the yarns or Breen's particles, and bending across
//! seams.
//!
//! The matrix of the solver has a block for each pair of particles that act on each other. Where
//! seams or closing springs couple more pairs than the connectors do, the connectors' stiffness is
//! assembled in a matrix of its own and then scattered.

use drape_cloth::{Breen, Cloth, SeamBending, SeamBendingState, State, Trial, Workspace};
use drape_implicit::{BlockMatrix, Sparsity};
use serde::{Deserialize, Serialize};

/// Internal forces of a cloth.
#[derive(Debug)]
pub(crate) struct InternalForces {
    /// Connectors of the cloth. In Breen's model they only account for strains.
    workspace: Workspace,
    breen: Option<Breen>,
    /// Bending across the seams, once they are closed.
    seams: Option<BentSeams>,
    /// Pairs of Breen's particles that have blocks in `sparsity`.
    close: Vec<[u32; 2]>,
    /// Pairs of particles that act on each other.
    sparsity: Sparsity,
    /// Number of times that `sparsity` has changed.
    version: u64,
    /// Matrix of the connectors alone, if `sparsity` has further pairs.
    scatter: Option<Scatter>,
}

/// Memory of the internal forces between two steps, apart from the state of the cloth.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SavedForces {
    seams: Option<SeamBendingState>,
    breen: Option<SavedPairs>,
}

/// Pairs of Breen's particles that were near each other. The order of the solver's sums depends on
/// the pairs.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct SavedPairs {
    /// Positions at which the pairs were listed, in m.
    listed: Vec<f64>,
    /// Pairs that have blocks in the sparsity.
    close: Vec<[u32; 2]>,
}

/// Bending across seams, and its memory.
#[derive(Debug)]
struct BentSeams {
    bending: SeamBending,
    state: SeamBendingState,
}

/// Matrix of the connectors, and the slot of each of its blocks in the matrix of the solver.
#[derive(Debug)]
struct Scatter {
    values: Vec<f64>,
    slots: Vec<usize>,
}

impl Scatter {
    fn new(connectors: &drape_cloth::Sparsity, whole: &Sparsity) -> Self {
        let slots = blocks(connectors).filter_map(|[row, column]| whole.slot(row, column));
        Self { values: vec![0.0; 9 * connectors.block_count()], slots: slots.collect() }
    }
}

/// Returns the row and the column of each block of `connectors`.
fn blocks(connectors: &drape_cloth::Sparsity) -> impl Iterator<Item = [usize; 2]> {
    let rows = connectors.rows().enumerate();
    rows.flat_map(|(row, columns)| columns.iter().map(move |&column| [row, column]))
}

/// Returns the sparsity of `connectors` and of the further pairs `added`.
fn sparsity(connectors: &drape_cloth::Sparsity, added: &[[u32; 2]]) -> Sparsity {
    let added = added.iter().map(|pair| pair.map(|particle| particle as usize));
    let particles = connectors.offsets.len() - 1;
    let pairs = blocks(connectors).chain(added);
    Sparsity::from_pairs(particles, pairs).expect("pairs are of the cloth's particles")
}

impl InternalForces {
    /// Returns the internal forces of `cloth` at `positions`, in Breen's model if `breen` is given.
    /// The sparsity has room for springs between the pairs `springs`.
    pub(crate) fn new(
        cloth: &Cloth,
        breen: Option<Breen>,
        springs: &[[u32; 2]],
        positions: &[f64],
    ) -> Result<Self, drape_cloth::Error> {
        let sparsity = sparsity(cloth.sparsity(), springs);
        let mut forces = Self {
            workspace: cloth.workspace(),
            breen,
            seams: None,
            close: Vec::new(),
            scatter: (!springs.is_empty()).then(|| Scatter::new(cloth.sparsity(), &sparsity)),
            sparsity,
            version: 0,
        };
        forces.update_sparsity(cloth, positions)?;
        Ok(forces)
    }

    /// Returns the pairs of particles that act on each other.
    pub(crate) fn sparsity(&self) -> &Sparsity {
        &self.sparsity
    }

    /// Returns the number of times that the sparsity has changed.
    pub(crate) fn sparsity_version(&self) -> u64 {
        self.version
    }

    /// Adds bending across the seams of `cloth`, which has been sewn at `positions`, in m. The
    /// closing springs need no blocks from now on.
    pub(crate) fn sew(
        &mut self,
        cloth: &Cloth,
        bending: SeamBending,
        positions: &[f64],
    ) -> Result<(), drape_cloth::Error> {
        let state = bending.state(positions)?;
        self.workspace = cloth.workspace();
        let pairs: Vec<[u32; 2]> = bending.pairs().collect();
        self.sparsity = sparsity(cloth.sparsity(), &pairs);
        self.scatter = Some(Scatter::new(cloth.sparsity(), &self.sparsity));
        self.version += 1;
        self.seams = Some(BentSeams { bending, state });
        Ok(())
    }

    /// Resets the memory of the seams to `positions`, in m.
    pub(crate) fn forget(&mut self, positions: &[f64]) -> Result<(), drape_cloth::Error> {
        if let Some(BentSeams { bending, state }) = &mut self.seams {
            *state = bending.state(positions)?;
        }
        Ok(())
    }

    /// Returns the memory of the seams.
    pub(crate) fn seam_state(&self) -> Option<&SeamBendingState> {
        self.seams.as_ref().map(|seams| &seams.state)
    }

    /// Restores the memory of the seams to `state`.
    pub(crate) fn restore_seams(&mut self, state: Option<SeamBendingState>) {
        if let (Some(seams), Some(state)) = (&mut self.seams, state) {
            seams.state = state;
        }
    }

    /// Returns the memory of the forces between two steps.
    pub(crate) fn saved(&self) -> SavedForces {
        let breen = self.breen.as_ref().map(|breen| SavedPairs {
            listed: breen.listed_positions().to_vec(),
            close: self.close.clone(),
        });
        SavedForces { seams: self.seam_state().cloned(), breen }
    }

    /// Restores the memory `saved` for the connectors of `cloth`. Returns `false` if it was saved
    /// from other forces.
    pub(crate) fn resume(&mut self, cloth: &Cloth, saved: SavedForces) -> bool {
        match (&mut self.seams, saved.seams) {
            (None, None) => {}
            (Some(seams), Some(state)) if state.may_follow(&seams.state) => seams.state = state,
            _ => return false,
        }

        match (&mut self.breen, saved.breen) {
            (None, None) => true,
            (Some(breen), Some(SavedPairs { listed, close })) => {
                let particles = cloth.particle_count();
                let is_finite = listed.iter().all(|x| x.is_finite());
                let is_known = close.as_flattened().iter().all(|&p| (p as usize) < particles);
                if listed.len() != 3 * particles || !is_finite || !is_known {
                    return false;
                }

                // The sums of the solver follow the order of the saved pairs.
                if breen.list_pairs(&listed).is_err() {
                    return false;
                }
                self.sparsity = sparsity(cloth.sparsity(), &close);
                self.close = close;
                self.version += 1;
                true
            }
            _ => false,
        }
    }

    /// Adds the pairs of Breen's particles that are near each other at `positions` to the sparsity.
    /// Pairs that have parted stay until pairs are added.
    fn update_sparsity(
        &mut self,
        cloth: &Cloth,
        positions: &[f64],
    ) -> Result<(), drape_cloth::Error> {
        let Some(breen) = &mut self.breen else { return Ok(()) };
        let near = breen.close_pairs(positions)?;
        if near.iter().any(|&[a, b]| self.sparsity.slot(a as usize, b as usize).is_none()) {
            self.close = near.to_vec();
            self.sparsity = sparsity(cloth.sparsity(), near);
            self.version += 1;
        }
        Ok(())
    }

    /// Adds the internal forces at `trial` to `forces`, in N.
    pub(crate) fn add_forces(
        &mut self,
        trial: Trial<'_>,
        forces: &mut [f64],
    ) -> Result<(), drape_cloth::Error> {
        match &mut self.breen {
            Some(breen) => breen.add_forces(trial.positions(), forces)?,
            None => self.workspace.add_forces(trial, forces)?,
        }
        if let Some(BentSeams { bending, state }) = &self.seams {
            bending.add_forces(state, trial.positions(), forces)?;
        }
        Ok(())
    }

    /// Returns the potential of the internal forces at `trial`, in J.
    pub(crate) fn potential(&mut self, trial: Trial<'_>) -> Result<f64, drape_cloth::Error> {
        let seam_energy = match &self.seams {
            Some(BentSeams { bending, state }) => bending.potential(state, trial.positions())?,
            None => 0.0,
        };
        let panel_energy = match &mut self.breen {
            Some(breen) => breen.energy(trial.positions())?,
            None => self.workspace.potential(trial)?,
        };
        Ok(seam_energy + panel_energy)
    }

    /// Adds the stiffness at `trial` to `matrix`, positive semi-definite if `definite`.
    ///
    /// A pair of Breen's particles that came near each other after `matrix` was laid out has no
    /// block in it. Twice the block of the pair is then added to the diagonal block of each
    /// particle, negated, which is at least as stiff as the block of the pair.
    pub(crate) fn add_stiffness(
        &mut self,
        trial: Trial<'_>,
        definite: bool,
        matrix: &mut BlockMatrix,
    ) -> Result<(), drape_cloth::Error> {
        let Some(breen) = &mut self.breen else {
            // Without further pairs the connectors have the layout of `matrix`.
            let Some(Scatter { values, slots }) = &mut self.scatter else {
                return self.workspace.add_stiffness(trial, definite, matrix.values_mut());
            };

            values.fill(0.0);
            self.workspace.add_stiffness(trial, definite, values)?;
            for (block, &slot) in values.as_chunks::<9>().0.iter().zip(&*slots) {
                matrix.add_block(slot, block);
            }
            if let Some(BentSeams { bending, state }) = &self.seams {
                bending.add_stiffness(
                    state,
                    trial.positions(),
                    definite,
                    |row, column, block| {
                        matrix.add(row as usize, column as usize, &block);
                    },
                )?;
            }
            return Ok(());
        };

        breen.add_stiffness(trial.positions(), definite, &mut |[a, b], block| {
            let (row, column) = (a as usize, b as usize);
            match matrix.sparsity().slot(row, column) {
                Some(slot) => matrix.add_block(slot, block),
                None => {
                    let against = block.map(|entry| -entry);
                    matrix.add(row, row, &against);
                    matrix.add(column, column, &against);
                }
            }
        })
    }

    /// Accepts a step of `cloth` that ends at `positions`, in m, with `velocities`, in m/s: updates
    /// `state` and the memory. Returns the energy dissipated, in J.
    pub(crate) fn commit(
        &mut self,
        cloth: &Cloth,
        state: &mut State,
        positions: &[f64],
        velocities: &[f64],
    ) -> Result<f64, drape_cloth::Error> {
        let mut dissipated = self.workspace.commit(cloth, state, positions, velocities)?;
        if let Some(BentSeams { bending, state }) = &mut self.seams {
            dissipated += bending.commit(state, positions)?;
        }
        self.update_sparsity(cloth, positions)?;
        Ok(if self.breen.is_some() { 0.0 } else { dissipated })
    }

    /// Returns the recoverable energy of `state`, in J.
    pub(crate) fn stored(
        &mut self,
        cloth: &Cloth,
        state: &State,
    ) -> Result<f64, drape_cloth::Error> {
        let seam_energy = match &self.seams {
            Some(seams) => seams.bending.stored(&seams.state, &state.positions)?,
            None => 0.0,
        };
        let panel_energy = match &mut self.breen {
            Some(breen) => breen.energy(&state.positions)?,
            None => self.workspace.stored(cloth, state)?,
        };
        Ok(seam_energy + panel_energy)
    }
}

#[cfg(test)]
mod tests {
    use drape_cloth::Lattice;
    use drape_fabric::samples;

    use super::*;

    #[test]
    fn a_pair_without_a_block_is_borne_by_its_particles_alone_and_more() {
        let fabric = samples::plain_weave();
        let lattice = Lattice::rectangle(0.04, 0.04, 0.01).expect("a sheet");
        let panels = [(&lattice, &fabric), (&lattice, &fabric)];
        let cloth = Cloth::new(&panels).expect("a cloth");
        let place = |gap: f64| -> Vec<f64> {
            let sheet =
                |height: f64| lattice.coordinates().iter().flat_map(move |&[u, v]| [u, v, height]);
            sheet(0.0).chain(sheet(gap)).collect()
        };
        let state = cloth.state(place(0.05)).expect("it fits");
        let breen = Breen::new(&panels).expect("no rims");
        let forces = InternalForces::new(&cloth, Some(breen), &[], &state.positions);
        let mut forces = forces.expect("it fits");
        let fill = |forces: &mut InternalForces| {
            let mut matrix = BlockMatrix::zeros(forces.sparsity().clone());
            let near = place(0.008);
            let trial = cloth.trial(&state, &near).expect("it fits");
            forces.add_stiffness(trial, true, &mut matrix).expect("it fits");
            assert_eq!(matrix.outside_sparsity(), None);
            matrix
        };
        let (before, alone) = (forces.sparsity_version(), fill(&mut forces));
        forces.update_sparsity(&cloth, &place(0.008)).expect("it fits");
        assert_eq!(forces.sparsity_version(), before + 1);
        let whole = fill(&mut forces);
        assert!(whole.sparsity().block_count() > alone.sparsity().block_count());
        // Sheets that near each other by a length of one each: the coupled matrix has them pull
        // four times as much as sheets that move as one, which it does not feel at all.
        let count = cloth.particle_count();
        let energy = |matrix: &BlockMatrix, lower: f64| {
            let height = |k: usize| if k / 3 < count / 2 { lower } else { 1.0 };
            let moved: Vec<f64> =
                (0..3 * count).map(|k| if k % 3 == 2 { height(k) } else { 0.0 }).collect();
            let mut forces = vec![0.0; moved.len()];
            matrix.multiply(&moved, &mut forces).expect("three entries per particle");
            moved.iter().zip(&forces).map(|(a, b)| a * b).sum::<f64>()
        };
        let (together, against) = (energy(&whole, 1.0), energy(&whole, -1.0));
        assert!(against > 0.0 && together.abs() < 1e-12 * against, "{together} and {against}");
        for lower in [1.0, -1.0, 0.3] {
            let (alone, whole) = (energy(&alone, lower), energy(&whole, lower));
            assert!(alone >= whole * (1.0 - 1e-12), "{alone} and {whole} for {lower}");
        }
        // Where they go against each other the two are the same.
        assert!((energy(&alone, -1.0) / against - 1.0).abs() < 1e-12);
        // Once more changes nothing.
        forces.update_sparsity(&cloth, &place(0.008)).expect("it fits");
        assert_eq!(forces.sparsity_version(), before + 1);
    }
}
