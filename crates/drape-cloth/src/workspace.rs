use pulp::{Arch, Simd, WithSimd};

use crate::cloth::Committed;
use crate::panel::{Panel, Strip};
use crate::scratch::{Scratch, Trial};
use crate::state::PanelState;
use crate::{Cloth, State, energy, force, stiffness};

/// Room for evaluating one cloth again and again: after it has been made, nothing allocates.
///
/// The methods are those of [`Cloth`]. They use the widest vector instructions of the machine; the
/// numbers do not depend on them.
#[derive(Debug, Clone)]
pub struct Workspace {
    scratch: Scratch,
    arch: Arch,
}

struct AddForces<'a>(&'a mut Scratch, Trial<'a>, &'a mut [f64]);

impl WithSimd for AddForces<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        force::add_forces(self.0, &self.1, self.2);
    }
}

struct AddStiffness<'a>(&'a mut Scratch, Trial<'a>, bool, &'a mut [f64]);

impl WithSimd for AddStiffness<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        stiffness::add_stiffness(self.0, &self.1, self.2, self.3);
    }
}

struct Potential<'a>(&'a mut Scratch, Trial<'a>);

impl WithSimd for Potential<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        energy::potential(self.0, &self.1)
    }
}

struct Commit<'a>(
    &'a mut Scratch,
    (&'a Panel, &'a Strip),
    &'a mut PanelState,
    &'a [f64],
);

impl WithSimd for Commit<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        energy::commit(self.0, self.1, self.2, self.3)
    }
}

impl Workspace {
    pub(crate) fn new(cloth: &Cloth) -> Self {
        let reach = cloth.panels.iter().map(|panel| panel.reach()).max();
        Self {
            scratch: Scratch::new(reach.unwrap_or(0)),
            arch: Arch::new(),
        }
    }

    /// See [`Cloth::add_forces`].
    pub fn add_forces(&mut self, cloth: &Cloth, state: &State, trial: &[f64], forces: &mut [f64]) {
        for trial in trials(cloth, state, trial) {
            let own = 3 * trial.strip.particles.start..3 * trial.strip.particles.end;
            self.arch
                .dispatch(AddForces(&mut self.scratch, trial, &mut forces[own]));
        }
    }

    /// See [`Cloth::potential`].
    #[must_use]
    pub fn potential(&mut self, cloth: &Cloth, state: &State, trial: &[f64]) -> f64 {
        trials(cloth, state, trial)
            .map(|trial| self.arch.dispatch(Potential(&mut self.scratch, trial)))
            .sum()
    }

    /// See [`Cloth::commit`]; positions and velocities come together.
    pub fn commit(
        &mut self,
        cloth: &Cloth,
        state: &mut State,
        (positions, velocities): (&[f64], &[f64]),
    ) -> Committed {
        state.positions.copy_from_slice(positions);
        state.velocities.copy_from_slice(velocities);
        cloth.turn_normals(state);
        let mut dissipated = 0.0;
        for (panel, state) in cloth.panels.iter().zip(&mut state.panels) {
            for strip in &panel.strips {
                let commit = Commit(&mut self.scratch, (panel, strip), state, positions);
                dissipated += self.arch.dispatch(commit);
            }
        }
        Committed { dissipated }
    }

    /// See [`Cloth::stored`].
    #[must_use]
    pub fn stored(&mut self, cloth: &Cloth, state: &State) -> f64 {
        trials(cloth, state, &state.positions)
            .map(|trial| energy::stored(&mut self.scratch, &trial))
            .sum()
    }

    /// Memories of a cloth that starts in the shape of the state without friction.
    pub(crate) fn start(&mut self, cloth: &Cloth, state: &mut State) {
        for (panel, memories) in cloth.panels.iter().zip(&mut state.panels) {
            for strip in &panel.strips {
                energy::start(
                    &mut self.scratch,
                    (panel, strip),
                    memories,
                    &state.positions,
                );
            }
        }
    }

    /// See [`Cloth::add_stiffness`].
    pub fn add_stiffness(
        &mut self,
        cloth: &Cloth,
        state: &State,
        (trial, definite): (&[f64], bool),
        values: &mut [f64],
    ) {
        for trial in trials(cloth, state, trial) {
            let own = 9 * trial.strip.blocks.start..9 * trial.strip.blocks.end;
            let values = &mut values[own];
            self.arch
                .dispatch(AddStiffness(&mut self.scratch, trial, definite, values));
        }
    }
}

/// The strips of a cloth, each with its state and the positions that are tried.
fn trials<'a>(
    cloth: &'a Cloth,
    state: &'a State,
    positions: &'a [f64],
) -> impl Iterator<Item = Trial<'a>> {
    let panels = cloth.panels.iter().zip(&state.panels);
    panels.flat_map(move |(panel, state)| {
        panel.strips.iter().map(move |strip| Trial {
            panel,
            state,
            strip,
            positions,
        })
    })
}
