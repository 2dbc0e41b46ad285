//! Cases of dynamics: strips in motion against exact solutions.
//!
//! Modes of hanging strips, the period of a pendulum, the fall and the rotation of a free strip,
//! the decrement of a strip with friction, and a measured experiment in a vacuum. `history` records
//! a figure step by step and reads periods from it.

mod decrement;
mod free;
mod hanging;
mod history;
mod pendulum;
mod vacuum;

pub(crate) use decrement::decrement;
pub(crate) use free::{free_fall, rotation};
pub(crate) use hanging::{hanging_chain, hanging_strip};
pub(crate) use pendulum::pendulum;
pub(crate) use vacuum::vacuum;
