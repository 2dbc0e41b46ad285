/// A straight way that the solver is about to go, of all particles and of what moves by prescription.
#[derive(Debug)]
pub struct Way<'a> {
    /// Where the particles are, in m: where the solver may be.
    pub from: &'a [f64],
    /// How far they are to go, in m.
    pub step: &'a mut [f64],
    /// Part of the prescribed motions of this (sub)step that is done, from 0 to 1.
    pub progress: f64,
    /// Part of them that is to be done on this way.
    pub advance: &'a mut f64,
}
