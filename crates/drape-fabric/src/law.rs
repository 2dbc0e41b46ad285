/// What a connector remembers of its deformation path: the state of its hysteresis.
///
/// The unit of the deformation is the law's (a ratio for traction and shearing, 1/m for bending).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// Deformation when the memory was last written, in the unit of the deformation.
    pub position: f64,
    /// Loads of the two friction elements, in the unit of the load.
    pub friction: [f64; 2],
    /// Largest deformation ever reached, in the unit of the deformation.
    pub peak: f64,
}

/// Load of a law at a trial deformation and its slope there.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Response {
    /// Load per width, in N/m for traction and shearing, in N for bending.
    pub load: f64,
    /// Derivative of the load with respect to the deformation, in load per deformation.
    pub tangent: f64,
}

/// A one-dimensional load–deformation law with memory, as a KES instrument measures it.
///
/// A trial deformation never changes the memory; only [`Law::commit`] makes a new one. Between two
/// commits the load is a single-valued function of the trial deformation, so it has a potential,
/// [`Law::work`], however the friction behaves.
pub trait Law {
    /// Memory of a fabric that was never deformed.
    fn virgin(&self) -> Memory {
        Memory::default()
    }

    /// Load and tangent at a trial deformation.
    fn respond(&self, memory: &Memory, deformation: f64) -> Response;

    /// Work per area from the committed to a trial deformation, in J/m².
    fn work(&self, memory: &Memory, deformation: f64) -> f64;

    /// Memory after the deformation has been reached along a straight path.
    #[must_use]
    fn commit(&self, memory: &Memory, deformation: f64) -> Memory;

    /// Energy per area that the fabric can give back in the remembered state, in J/m².
    fn stored(&self, memory: &Memory) -> f64;
}

/// Drives a law along a deformation history and returns the load at every point, in the unit of the
/// load.
///
/// The history starts from the given memory; each point is reached along a straight path.
pub fn drive(law: &impl Law, memory: Memory, history: &[f64]) -> Vec<f64> {
    let mut memory = memory;
    history
        .iter()
        .map(|&deformation| {
            let load = law.respond(&memory, deformation).load;
            memory = law.commit(&memory, deformation);
            load
        })
        .collect()
}
