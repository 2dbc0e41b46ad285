//! The laws of a fabric, one connector at a time: load against deformation, with memory.
//!
//! A law is the sum of an elastic backbone and a friction that depends on the path,
//!
//! ```math
//! T(s) = T_e(s) + T_{fr},\qquad T_{fr}\ \text{advanced exactly along the path of } s
//! ```
//!
//! in SI units, per width of cloth. Traction depends on the strain, bending on the signed
//! curvature, and shear on the sine of the shear angle. `law` defines the interface and the memory.
//! `traction`, `bending` and `shear` are the three laws. `piecewise` and `varying` are backbones of
//! bending and shear. `path` divides a path into pieces with a linear weight of the friction. The
//! laws do not depend on particles. A trial never changes a memory.

pub(crate) mod bending;
pub(crate) mod law;
pub(crate) mod path;
pub(crate) mod piecewise;
pub(crate) mod shear;
pub(crate) mod traction;
pub(crate) mod varying;
