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

use drape_scene::{SceneSpec, TimeSpec};

use crate::setup::{alone, settle, tolerance};

/// Returns the rest of a scene whose strip goes to rest without inertia. The tolerances are a
/// hundredth of the usual tolerances of a scene.
fn rest() -> SceneSpec {
    SceneSpec {
        time: TimeSpec { step: 0.002, end: 1e4, ..TimeSpec::default() },
        settle: settle(1e-5, 1e-5),
        solver: tolerance(1e-7),
        ..alone()
    }
}
