//! Exact solutions that simulations are held against; each is computed or cited, none comes from a simulation.

mod bias;
mod catenary;
mod column;
mod decrement;
mod heavy_elastica;
mod integrate;
mod vibration;

pub use bias::bias_stiffness;
pub use catenary::{catenary_sag, catenary_shape};
pub use column::{END_LOAD_BUCKLING, SELF_WEIGHT_BUCKLING};
pub use decrement::DahlStrip;
pub use heavy_elastica::{Tip, cantilever, cantilever_shape};
pub use vibration::{CHAIN_MODES, pendulum_period, pendulum_swing, strip_modes};
