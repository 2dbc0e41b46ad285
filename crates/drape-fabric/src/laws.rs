//! The laws of a fabric, one connector at a time: load against deformation, with memory.
//!
//! A law is an elastic backbone plus a friction that depends on the path,
//!
//! ```math
//! T(s) = T_e(s) + T_{fr},\qquad T_{fr}\ \text{advanced exactly along the path of } s
//! ```
//!
//! in SI units, per width of cloth. Traction depends on the strain, bending on the signed curvature,
//! shear on the sine of the shear angle. `law` defines the interface and the memory, `traction`,
//! `bending` and `shear` the three laws, `piecewise` and `varying` backbones that two of them share, `path`
//! the pieces of a path along which the weight of the friction is linear. The laws know nothing of
//! particles; a trial never changes a memory.

pub(crate) mod bending;
pub(crate) mod law;
pub(crate) mod path;
pub(crate) mod piecewise;
pub(crate) mod shear;
pub(crate) mod traction;
pub(crate) mod varying;
