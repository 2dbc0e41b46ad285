/// Where the particles are and how they move, with all that the next step needs to know of the past.
///
/// A motion written to disk and read back continues as if nothing had happened, to the last bit: a
/// [`Stepper`](crate::Stepper) has no memory of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegratorState {
    /// Time, in s.
    ///
    /// Each call of [`Stepper::advance`](crate::Stepper::advance) adds the step's length. A caller that makes many
    /// equal steps sets it to their number times the length, so that rounding errors do not add up.
    pub time: f64,
    /// Positions, three per particle, in m.
    pub positions: Vec<f64>,
    /// Velocities, three per particle, in m/s.
    pub velocities: Vec<f64>,
    /// The state before the last accepted sub-step, for second-order steps.
    pub previous: Option<PreviousState>,
}

/// The state one sub-step earlier.
#[derive(Clone, Debug, PartialEq)]
pub struct PreviousState {
    /// Length of the sub-step since, in s.
    pub dt: f64,
    /// Positions before it, in m.
    pub positions: Vec<f64>,
    /// Velocities before it, in m/s.
    pub velocities: Vec<f64>,
}

impl IntegratorState {
    /// A motion that starts at time 0 with given positions (m) and velocities (m/s).
    pub fn new(positions: Vec<f64>, velocities: Vec<f64>) -> Self {
        Self { time: 0.0, positions, velocities, previous: None }
    }

    /// A motion that starts at time 0 from rest at given positions (m).
    pub fn at_rest(positions: Vec<f64>) -> Self {
        let velocities = vec![0.0; positions.len()];
        Self::new(positions, velocities)
    }

    /// Forgets the past: the next step is of first order. To be called after changing positions or velocities by
    /// hand, or when the forces have jumped.
    pub fn restart(&mut self) {
        self.previous = None;
    }
}
