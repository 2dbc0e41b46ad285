use drape_cloth::{Breen, Cloth, SeamBending, SeamState, Sparsity, State, Workspace};
use drape_implicit::{BlockMatrix, Sparsity as Coupling};

/// What holds the particles of a cloth together.
#[derive(Debug)]
pub(crate) struct Bonds {
    /// The connectors of the cloth. In Breen's model they keep the account of strains alone.
    workspace: Workspace,
    breen: Option<Breen>,
    /// How the seams bend, once they are sewn.
    seams: Option<(SeamBending, SeamState)>,
    /// Which particles act on each other.
    coupling: Coupling,
    /// How often that has changed.
    version: u64,
    /// Where the coupling has room for more: a matrix of the connectors alone, and where its blocks go.
    spread: Option<(Vec<f64>, Vec<usize>)>,
}

/// Row and column of each block of a cloth's connectors.
fn blocks(pattern: &Sparsity) -> impl Iterator<Item = [usize; 2]> {
    (0..pattern.offsets.len() - 1).flat_map(|row| {
        let columns = &pattern.columns[pattern.offsets[row]..pattern.offsets[row + 1]];
        columns.iter().map(move |&column| [row, column])
    })
}

/// The coupling of a cloth's connectors and of some more pairs.
fn coupling(pattern: &Sparsity, more: &[[u32; 2]]) -> Coupling {
    let more = more.iter().map(|pair| pair.map(|particle| particle as usize));
    let particles = pattern.offsets.len() - 1;
    let pairs = blocks(pattern).chain(more);
    Coupling::from_pairs(particles, pairs).expect("pairs are of the cloth's particles")
}

/// Room for a matrix of the connectors alone, and where its blocks go in a coupling that has more.
fn spread(pattern: &Sparsity, coupling: &Coupling) -> (Vec<f64>, Vec<usize>) {
    let slots = blocks(pattern).filter_map(|[row, column]| coupling.slot(row, column));
    (vec![0.0; 9 * pattern.blocks()], slots.collect())
}

impl Bonds {
    /// The bonds of a cloth, in Breen's model if there is one, with room for threads between pairs of its particles.
    pub(crate) fn new(
        cloth: &Cloth,
        breen: Option<Breen>,
        (threads, positions): (&[[u32; 2]], &[f64]),
    ) -> Self {
        let coupling = coupling(cloth.sparsity(), threads);
        let mut bonds = Self {
            workspace: cloth.workspace(),
            breen,
            seams: None,
            spread: (!threads.is_empty()).then(|| spread(cloth.sparsity(), &coupling)),
            coupling,
            version: 0,
        };
        bonds.couple(cloth, positions);
        bonds
    }

    pub(crate) fn coupling(&self) -> &Coupling {
        &self.coupling
    }

    pub(crate) fn version(&self) -> u64 {
        self.version
    }

    /// The seams of a finished cloth bend from now on, and threads need no room any more.
    pub(crate) fn sew(&mut self, cloth: &Cloth, bending: SeamBending, positions: &[f64]) {
        self.workspace = cloth.workspace();
        let pairs: Vec<[u32; 2]> = bending.pairs().collect();
        self.coupling = coupling(cloth.sparsity(), &pairs);
        self.spread = Some(spread(cloth.sparsity(), &self.coupling));
        self.version += 1;
        let state = bending.state(positions).expect("a place for every particle");
        self.seams = Some((bending, state));
    }

    /// What the seams remember.
    pub(crate) fn seams(&self) -> Option<&SeamState> {
        self.seams.as_ref().map(|(_, state)| state)
    }

    /// Takes back what the seams have learnt since.
    pub(crate) fn restore(&mut self, state: Option<SeamState>) {
        if let (Some((_, own)), Some(state)) = (&mut self.seams, state) {
            *own = state;
        }
    }

    /// Takes the pairs that have come near each other into the coupling. Those that have left stay until then.
    fn couple(&mut self, cloth: &Cloth, positions: &[f64]) {
        let Some(breen) = &mut self.breen else { return };
        let near = breen.close_pairs(positions);
        let known = |&[a, b]: &[u32; 2]| self.coupling.slot(a as usize, b as usize).is_some();
        if !near.iter().all(known) {
            self.coupling = coupling(cloth.sparsity(), near);
            self.version += 1;
        }
    }

    pub(crate) fn add_forces(
        &mut self,
        cloth: &Cloth,
        state: &State,
        positions: &[f64],
        forces: &mut [f64],
    ) {
        match &mut self.breen {
            Some(breen) => breen.add_forces(positions, forces),
            None => self.workspace.add_forces(cloth.trial(state, positions), forces),
        }
        if let Some((seams, state)) = &self.seams {
            seams.add_forces(state, positions, forces);
        }
    }

    pub(crate) fn potential(&mut self, cloth: &Cloth, state: &State, positions: &[f64]) -> f64 {
        let seams = self.seams.as_ref();
        let seams = seams.map_or(0.0, |(seams, state)| seams.potential(state, positions));
        seams
            + match &mut self.breen {
                Some(breen) => breen.energy(positions),
                None => self.workspace.potential(cloth.trial(state, positions)),
            }
    }

    /// Adds the stiffness. A pair that has come near since the matrix was laid out has no block in it; its particles then
    /// bear it each by itself, twice, which is more than the two of them bear together.
    pub(crate) fn add_stiffness(
        &mut self,
        cloth: &Cloth,
        state: &State,
        (positions, definite): (&[f64], bool),
        matrix: &mut BlockMatrix,
    ) {
        let Some(breen) = &mut self.breen else {
            let trial = cloth.trial(state, positions);
            let Some((values, slots)) = &mut self.spread else {
                self.workspace.add_stiffness(trial, definite, matrix.values_mut());
                return;
            };
            values.fill(0.0);
            self.workspace.add_stiffness(trial, definite, values);
            for (block, &slot) in values.as_chunks::<9>().0.iter().zip(&*slots) {
                matrix.add_block(slot, block);
            }
            if let Some((seams, state)) = &self.seams {
                seams.add_stiffness(state, positions, definite, |row, column, block| {
                    matrix.add(row as usize, column as usize, &block);
                });
            }
            return;
        };
        breen.add_stiffness(positions, definite, &mut |[a, b], block| {
            let (row, column) = (a as usize, b as usize);
            match matrix.sparsity().slot(row, column) {
                Some(slot) => matrix.add_block(slot, block),
                None => {
                    let against = block.map(|entry| -entry);
                    matrix.add(row, row, &against);
                    matrix.add(column, column, &against);
                }
            }
        });
    }

    pub(crate) fn commit(
        &mut self,
        cloth: &Cloth,
        state: &mut State,
        (positions, velocities): (&[f64], &[f64]),
    ) -> f64 {
        let mut dissipated = self.workspace.commit(cloth, state, positions, velocities);
        if let Some((seams, state)) = &mut self.seams {
            dissipated += seams.commit(state, positions);
        }
        self.couple(cloth, positions);
        if self.breen.is_some() { 0.0 } else { dissipated }
    }

    /// Energy that can be had back, in J.
    pub(crate) fn stored(&mut self, cloth: &Cloth, state: &State) -> f64 {
        let seams = self.seams.as_ref();
        let seams = seams.map_or(0.0, |(seams, own)| seams.stored(own, &state.positions));
        seams
            + match &mut self.breen {
                Some(breen) => breen.energy(&state.positions),
                None => self.workspace.stored(cloth, state),
            }
    }
}

#[cfg(test)]
mod tests {
    use drape_cloth::Lattice;
    use drape_fabric::Fabric;
    use drape_input::Document;

    use super::*;

    const FABRIC: &str = r#"name = "plain"
density = 0.12
thickness = 0.0003
shear = { stiffness = 35.0 }
[warp]
traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
bending.rigidity = 1.2e-5
[weft]
traction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 }
bending.rigidity = 0.8e-5
"#;

    #[test]
    fn a_pair_without_a_block_is_borne_by_its_particles_alone_and_more() {
        let fabric = Fabric::from_document(&Document::new("plain.toml", FABRIC)).expect("right");
        let lattice = Lattice::rectangle(0.04, 0.04, 0.01).expect("a sheet");
        let panels = [(&lattice, &fabric), (&lattice, &fabric)];
        let cloth = Cloth::new(&panels);
        let place = |gap: f64| -> Vec<f64> {
            let sheet =
                |height: f64| lattice.coordinates.iter().flat_map(move |&[u, v]| [u, v, height]);
            sheet(0.0).chain(sheet(gap)).collect()
        };
        let state = cloth.state(place(0.05)).expect("it fits");
        let mut bonds = Bonds::new(
            &cloth,
            Some(Breen::new(&panels).expect("no rims")),
            (&[], &state.positions),
        );
        let fill = |bonds: &mut Bonds| {
            let mut matrix = BlockMatrix::zeros(bonds.coupling().clone());
            bonds.add_stiffness(&cloth, &state, (&place(0.008), true), &mut matrix);
            assert_eq!(matrix.outside_sparsity(), None);
            matrix
        };
        let (before, alone) = (bonds.version(), fill(&mut bonds));
        bonds.couple(&cloth, &place(0.008));
        assert_eq!(bonds.version(), before + 1);
        let whole = fill(&mut bonds);
        assert!(whole.sparsity().blocks() > alone.sparsity().blocks());
        // Sheets that near each other by a length of one each: the coupled matrix has them pull four times as much as
        // sheets that move as one, which it does not feel at all.
        let count = cloth.particles();
        let energy = |matrix: &BlockMatrix, lower: f64| {
            let way = |k: usize| if k / 3 < count / 2 { lower } else { 1.0 };
            let way: Vec<f64> =
                (0..3 * count).map(|k| if k % 3 == 2 { way(k) } else { 0.0 }).collect();
            let mut pull = vec![0.0; way.len()];
            matrix.multiply(&way, &mut pull);
            way.iter().zip(&pull).map(|(a, b)| a * b).sum::<f64>()
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
        bonds.couple(&cloth, &place(0.008));
        assert_eq!(bonds.version(), before + 1);
    }
}
