//! Instruments: the KES tests, answered by the laws alone and by simulated specimens.
//!
//! `cycle` has the deformations of each test. `ideal` and `bias` answer with the laws of the
//! fabric, as if the fabric deformed evenly. `specimen` is a panel in two clamps at its true size.
//! `measurement` drives the specimen and reads the load of the moving clamp, as the instrument
//! does. `comparison` compares the two curves. Tests of fabrics and the cases of loops
//! call this chapter.

mod bias;
mod comparison;
mod cycle;
mod ideal;
mod measurement;
mod placement;
mod specimen;
mod yarn;

pub(crate) use bias::on_the_bias_along;
pub use bias::{on_the_bias, on_the_bias_in_cells};
pub use comparison::Comparison;
pub(crate) use cycle::LARGEST_CURVATURE;
pub use cycle::{LARGEST_TENSION, SHEAR_TENSION, cycle};
pub use ideal::ideal;
pub use measurement::{Resolution, bend_on_the_bias, bias_spacing, measure};
pub(crate) use placement::{Rows, bending_placement, lever_arm, pivot_moment};
pub(crate) use yarn::laws;
