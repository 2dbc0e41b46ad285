use pulp::{Arch, Simd, WithSimd};

use crate::field::Field;
use crate::panel::{Panel, Strip};
use crate::rim::{Course, Rim, RimTrial};
use crate::scratch::{Scratch, StripTrial};
use crate::share::{Scratches, share};
use crate::state::Moving;
use crate::{Cloth, State, energy, force, rim, stiffness};

/// Room for evaluating one cloth again and again: after it has been made, nothing allocates.
///
/// The methods are those of [`Cloth`]. They use the threads of the pool that the workspace was made
/// in and the widest vector instructions of the machine; the numbers depend on neither, because the
/// cloth is cut into the same strips for any number of threads and what the strips sum up is added in
/// their order.
#[derive(Debug, Clone)]
pub struct Workspace {
    /// One for each thread that can be of use.
    scratches: Scratches,
    /// What each strip and then each rim has summed up.
    sums: Vec<f64>,
    arch: Arch,
}

/// Trial positions at which a cloth is evaluated, and the state whose memory its laws start from.
#[derive(Debug, Clone, Copy)]
pub struct Trial<'a> {
    /// The cloth.
    pub cloth: &'a Cloth,
    /// State at the start of the step.
    pub state: &'a State,
    /// Trial positions, three numbers for each particle, in m.
    pub positions: &'a [f64],
}

impl Workspace {
    pub(crate) fn new(cloth: &Cloth) -> Self {
        let margin = |strip: &Strip| cloth.panels[strip.panel].margin;
        let reach = cloth.strips.iter().map(|strip| strip.reach(margin(strip)));
        let scratch = Scratch::new(reach.max().unwrap_or(0));
        let threads = rayon::current_num_threads().min(cloth.strips.len());
        Self {
            scratches: Scratches::new(&scratch, threads),
            sums: vec![0.0; cloth.strips.len() + cloth.rims.len()],
            arch: Arch::new(),
        }
    }

    /// See [`Cloth::add_forces`].
    pub fn add_forces(&mut self, trial: Trial<'_>, forces: &mut [f64]) {
        let Trial { cloth, state, positions } = trial;
        let arch = self.arch;
        share(
            (&cloth.strips, &self.scratches),
            &mut *forces,
            &|forces, from, to| {
                forces.split_at_mut(3 * (to.particles.start - from.particles.start))
            },
            &|strip, scratch, forces| {
                let trial = StripTrial::new(cloth, state, (strip, positions));
                arch.dispatch(AddForces(scratch, trial, forces));
            },
        );
        let Some(first) = cloth.rims.first() else { return };
        share(
            (&cloth.rims, &self.scratches),
            &mut forces[3 * first.particles.start..],
            &|forces, from, to| {
                forces.split_at_mut(3 * (to.particles.start - from.particles.start))
            },
            &|rim, _, forces| {
                arch.dispatch(AddRimForces(RimTrial::new(cloth, state, (rim, positions)), forces));
            },
        );
    }

    /// See [`Cloth::potential`].
    #[must_use]
    pub fn potential(&mut self, trial: Trial<'_>) -> f64 {
        let Trial { cloth, state, positions } = trial;
        let arch = self.arch;
        let (sums, rim_sums) = self.sums.split_at_mut(cloth.strips.len());
        share(
            (&cloth.strips, &self.scratches),
            sums,
            &|sums, from, to| sums.split_at_mut(to.index - from.index),
            &|strip, scratch, sums| {
                let trial = StripTrial::new(cloth, state, (strip, positions));
                sums[0] = arch.dispatch(Potential(scratch, trial));
            },
        );
        share(
            (&cloth.rims, &self.scratches),
            rim_sums,
            &|sums, from, to| sums.split_at_mut(to.index - from.index),
            &|rim, _, sums| {
                sums[0] =
                    arch.dispatch(RimPotential(RimTrial::new(cloth, state, (rim, positions))));
            },
        );
        self.sums.iter().sum()
    }

    /// See [`Cloth::add_stiffness`].
    pub fn add_stiffness(&mut self, trial: Trial<'_>, definite: bool, values: &mut [f64]) {
        let Trial { cloth, state, positions } = trial;
        let arch = self.arch;
        share(
            (&cloth.strips, &self.scratches),
            &mut *values,
            &|values, from, to| values.split_at_mut(9 * (to.blocks.start - from.blocks.start)),
            &|strip, scratch, values| {
                let trial = StripTrial::new(cloth, state, (strip, positions));
                arch.dispatch(AddStiffness(scratch, trial, definite, values));
            },
        );
        let Some(first) = cloth.rims.first() else { return };
        share(
            (&cloth.rims, &self.scratches),
            &mut values[9 * first.blocks.start..],
            &|values, from, to| values.split_at_mut(9 * (to.blocks.start - from.blocks.start)),
            &|rim, _, values| {
                let trial = RimTrial::new(cloth, state, (rim, positions));
                arch.dispatch(AddRimStiffness(trial, definite, values));
            },
        );
    }

    /// See [`Cloth::commit`].
    pub fn commit(
        &mut self,
        cloth: &Cloth,
        state: &mut State,
        positions: &[f64],
        velocities: &[f64],
    ) -> f64 {
        state.positions.copy_from_slice(positions);
        state.velocities.copy_from_slice(velocities);
        cloth.turn_normals(state);
        let place = |strip: &Strip| strip.offset + cloth.panels[strip.panel].margin;
        let (moving, normals) = state.history.moving(place(&cloth.strips[0]));
        let arch = self.arch;
        let (sums, rim_sums) = self.sums.split_at_mut(cloth.strips.len());
        share(
            (&cloth.strips, &self.scratches),
            (moving, sums),
            &|(moving, sums), from, to| {
                let (moving, others) = moving.split(place(to) - place(from));
                let (sums, more) = sums.split_at_mut(to.index - from.index);
                ((moving, sums), (others, more))
            },
            &|strip, scratch, (moving, sums)| {
                let panel = &cloth.panels[strip.panel];
                let shape = (positions, normals);
                sums[0] = arch.dispatch(Commit(scratch, (panel, strip), moving, shape));
            },
        );
        share(
            (&cloth.rims, &self.scratches),
            (state.history.rim.course(), rim_sums),
            &|(course, sums), from, to| {
                let (course, others) = course.split(from, to);
                let (sums, more) = sums.split_at_mut(to.index - from.index);
                ((course, sums), (others, more))
            },
            &|rim, _, (course, sums)| {
                let shape = (positions, state.normals.as_slice());
                let own = (rim, &cloth.panels[rim.panel]);
                sums[0] = arch.dispatch(CommitRim(own, course, shape));
            },
        );
        self.sums.iter().sum()
    }

    /// See [`Cloth::stored`].
    #[must_use]
    pub fn stored(&mut self, cloth: &Cloth, state: &State) -> f64 {
        let trial = |strip| StripTrial::new(cloth, state, (strip, &state.positions));
        let scratch = self.scratches.any();
        let strips = cloth.strips.iter();
        let strips: f64 = strips.map(|strip| energy::stored(scratch, &trial(strip))).sum();
        let rims = cloth.rims.iter();
        let trial = |rim| RimTrial::new(cloth, state, (rim, &state.positions));
        strips + rims.map(|rim| rim::stored(&trial(rim))).sum::<f64>()
    }

    /// Memories of a cloth that starts in the shape of the state without friction.
    pub(crate) fn start(&mut self, cloth: &Cloth, state: &mut State) {
        for strip in &cloth.strips {
            let own = (&cloth.panels[strip.panel], strip);
            let scratch = self.scratches.any();
            energy::start(scratch, own, &mut state.history, &state.positions);
        }
        for rim in &cloth.rims {
            let shape = (state.positions.as_slice(), state.normals.as_slice());
            rim::start((rim, &cloth.panels[rim.panel]), &mut state.history.rim, shape);
        }
    }
}

// What is dispatched to the machine's vector instructions: everything below is inlined into it.

struct AddForces<'a>(&'a mut Scratch, StripTrial<'a>, &'a mut [f64]);

impl WithSimd for AddForces<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        force::add_forces(self.0, &self.1, self.2);
    }
}

struct Potential<'a>(&'a mut Scratch, StripTrial<'a>);

impl WithSimd for Potential<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        energy::potential(self.0, &self.1)
    }
}

struct AddStiffness<'a>(&'a mut Scratch, StripTrial<'a>, bool, &'a mut [f64]);

impl WithSimd for AddStiffness<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        stiffness::add_stiffness(self.0, &self.1, self.2, self.3);
    }
}

struct Commit<'a>(&'a mut Scratch, (&'a Panel, &'a Strip), Moving<'a>, (&'a [f64], &'a Field));

impl WithSimd for Commit<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        energy::commit(self.0, self.1, self.2, self.3)
    }
}

struct AddRimForces<'a>(RimTrial<'a>, &'a mut [f64]);

impl WithSimd for AddRimForces<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        rim::add_forces(&self.0, self.1);
    }
}

struct RimPotential<'a>(RimTrial<'a>);

impl WithSimd for RimPotential<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        rim::potential(&self.0)
    }
}

struct AddRimStiffness<'a>(RimTrial<'a>, bool, &'a mut [f64]);

impl WithSimd for AddRimStiffness<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        rim::add_stiffness(&self.0, self.1, self.2);
    }
}

struct CommitRim<'a>((&'a Rim, &'a Panel), Course<'a>, (&'a [f64], &'a [f64]));

impl WithSimd for CommitRim<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        rim::commit(self.0, self.1, self.2)
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use drape_fabric::Fabric;
    use drape_input::Document;

    use super::*;
    use crate::Lattice;

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
        let cloth = Cloth::new(&[(&lattice, &fabric)]);
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
            let zeros = vec![0.0; 3 * cloth.particles()];
            let lost = workspace.commit(&cloth, &mut state, &place(0.5), &zeros);
            let (mut forces, trial) = (zeros, place(0.3));
            workspace.add_forces(cloth.trial(&state, &trial), &mut forces);
            let mut values = vec![0.0; 9 * cloth.sparsity().blocks()];
            workspace.add_stiffness(cloth.trial(&state, &trial), false, &mut values);
            let potential = workspace.potential(cloth.trial(&state, &trial));
            (state, lost, forces, values, potential)
        };
        let (wide, narrow) = (run(Arch::new()), run(Arch::Scalar));
        assert!(wide == narrow, "on a machine with {:?}", Arch::new());
    }
}
