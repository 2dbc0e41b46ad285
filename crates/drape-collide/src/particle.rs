//! Contact of particles with rigid bodies: a barrier and Coulomb friction.
//!
//! Each particle `$i$` within the activation distance of a body has the energy
//!
//! ```math
//! E_i = k_A A_i\, b(d_i) + F_i f_0(|u_i|)
//! ```
//!
//! of the [barrier](crate::barrier) of its signed distance and of friction. The friction is lagged:
//! normal force and tangent plane are taken at the start of the step \[Li20, eqs. 11–12 and 17\].
//!
//! The solver calls [`ParticleContact`] in each step: `begin`, then forces, potential and stiffness
//! at trial positions. This chapter uses [`body`](crate::body) and the barrier, and does not use
//! surfaces.

mod contact;
mod detection;
mod friction;
mod settings;
mod summary;

pub use contact::ParticleContact;
pub use settings::ParticleSettings;
pub use summary::{NearestParticle, ParticleSummary};
