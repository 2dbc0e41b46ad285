//! Setup of the simulations: fabrics, strips and scenes in memory.
//!
//! A case describes its scene by a `SceneSpec`, which passes through all checks of scenes.
//! [`Strip`] describes the scene of a rectangular strip with linear laws. `fabrics` has the shipped
//! fabrics. `scene` has what such specs have in common, and [`finish`] runs a simulation to its
//! end. Instruments, drapemeters and cases use this chapter.

pub(crate) mod fabrics;
mod scene;
mod strip;

pub use scene::finish;
pub(crate) use scene::{alone, finish_with, settle, simulation, tolerance, with_panel};
pub use strip::{Friction, GRAVITY, Hold, LinePoint, Strip};
