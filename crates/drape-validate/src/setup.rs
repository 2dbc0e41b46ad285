//! Setup of the simulations: fabrics, strips and scenes in memory.
//!
//! A case writes its scene as TOML, as a person would, so that the scene passes through all checks
//! of scenes. [`Strip`] writes the scene of a rectangular strip with linear laws. `fabrics` has the
//! shipped fabrics. `scene` reads the text, and [`finish`] runs a simulation to its end.
//! Instruments, drapemeters and cases use this chapter.

pub(crate) mod fabrics;
mod scene;
mod strip;

pub use scene::finish;
pub(crate) use scene::{ALONE, finish_with, scene, simulation};
pub use strip::{Friction, GRAVITY, Hold, LinePoint, Strip};
