//! Cases of statics: strips and sheets at rest against exact solutions.
//!
//! A strip moves without inertia until it rests, and its shape, load or energy is compared. The
//! references are the heavy elastica, the end-loaded cantilever, the catenary, the critical weight
//! of a column, the stiffness of bias strips, and the energy of a bent sheet.

mod bias_strip;
mod cantilever;
mod column;
mod cylinder;
mod end_load;
mod hanging;

pub(crate) use bias_strip::bias_strip;
pub(crate) use cantilever::heavy_cantilever;
pub(crate) use column::column;
pub(crate) use cylinder::cylinder;
pub(crate) use end_load::end_loaded_cantilever;
pub(crate) use hanging::{catenary, self_stretch};

/// Tables of a scene whose strip goes to rest without inertia. The tolerances are a hundredth of
/// the usual tolerances of a scene.
const REST: &str = "[time]\nstep = 0.002\nend = 10000\n[settle]\nresidual = 1e-5\nspeed = 1e-5\n\
                    [solver]\ntolerance = 1e-7\n[output]\nenergy = false\n";
