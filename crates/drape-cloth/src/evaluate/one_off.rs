//! Evaluation of a cloth by a single call, and the first state of a cloth. A solver uses a
//! `Workspace` instead.

use crate::cloth::Cloth;
use crate::error::Error;
use crate::evaluate::workspace::{Trial, Workspace};
use crate::kernel::memories::GridMemories;
use crate::rim::memories::RimMemories;
use crate::state::State;

impl Cloth {
    /// Returns the state of the cloth at rest at `positions`, in m, without friction in any
    /// connector.
    ///
    /// # Errors
    /// There are not three numbers for every particle.
    pub fn state(&self, positions: Vec<f64>) -> Result<State, Error> {
        self.check_vectors("positions", &positions)?;
        let mut state = State {
            velocities: vec![0.0; positions.len()],
            normals: vec![0.0; positions.len()],
            grid: GridMemories::new(&self.panels),
            rim: RimMemories::new(&self.rims, &self.panels),
            fingerprint: self.fingerprint(),
            positions,
        };
        self.update_normals(&mut state);
        self.workspace().start(self, &mut state);
        Ok(state)
    }

    /// Returns trial `positions` of this cloth from `state`, for a [`Workspace`].
    ///
    /// # Errors
    /// The state belongs to another cloth, or there are not three numbers for every particle.
    pub fn trial<'a>(&'a self, state: &'a State, positions: &'a [f64]) -> Result<Trial<'a>, Error> {
        self.check_state(state)?;
        self.check_vectors("trial positions", positions)?;
        Ok(Trial { cloth: self, state, positions })
    }

    /// Returns a [`Workspace`], which evaluates this cloth many times without allocating memory.
    #[must_use]
    pub fn workspace(&self) -> Workspace {
        Workspace::new(self)
    }

    /// Adds the forces of all connectors at the positions `trial` to `forces`, in N. `trial` and
    /// `forces` have three numbers for each particle. The weight is not among the forces. For many
    /// evaluations use a [`Workspace`].
    ///
    /// # Errors
    /// The state belongs to another cloth, or a list does not have three numbers for every
    /// particle.
    pub fn add_forces(
        &self,
        state: &State,
        trial: &[f64],
        forces: &mut [f64],
    ) -> Result<(), Error> {
        self.workspace().add_forces(self.trial(state, trial)?, forces)
    }

    /// Returns the potential of the connectors within a step at the positions `trial`, in J. Its
    /// negative derivative with respect to `trial` is [`Cloth::add_forces`]. Only differences at
    /// one `state` are meaningful.
    ///
    /// # Errors
    /// As [`Cloth::trial`].
    pub fn potential(&self, state: &State, trial: &[f64]) -> Result<f64, Error> {
        self.workspace().potential(self.trial(state, trial)?)
    }

    /// Adds the negative derivative of the forces with respect to `trial`, in N/m, to `values`:
    /// nine numbers for each block of [`Cloth::sparsity`], in its order.
    ///
    /// With `definite`, parts that make the matrix indefinite are left out: compression across a
    /// segment, negative tangents, and the second derivatives of the sine of shear.
    ///
    /// # Errors
    /// As [`Cloth::trial`], or there are not nine values for every block.
    pub fn add_stiffness(
        &self,
        state: &State,
        trial: &[f64],
        definite: bool,
        values: &mut [f64],
    ) -> Result<(), Error> {
        self.workspace().add_stiffness(self.trial(state, trial)?, definite, values)
    }

    /// Accepts a step that ends at `positions`, in m, with `velocities`, in m/s, three numbers for
    /// each particle: advances the positions, velocities and all memories of `state`. Only this
    /// method and [`Workspace::commit`] write memories. Returns the energy dissipated by the
    /// fabric's friction, in J.
    ///
    /// # Errors
    /// The state belongs to another cloth, or a list does not have three numbers for every
    /// particle. The state is then unchanged.
    pub fn commit(
        &self,
        state: &mut State,
        positions: &[f64],
        velocities: &[f64],
    ) -> Result<f64, Error> {
        self.workspace().commit(self, state, positions, velocities)
    }

    /// Returns the energy that the connectors can return at `state`, in J.
    ///
    /// # Errors
    /// The state belongs to another cloth.
    pub fn stored(&self, state: &State) -> Result<f64, Error> {
        self.workspace().stored(self, state)
    }
}
