//! Measures: scalars of a few particles on which the laws depend, with their derivatives.
//!
//! | connector | measure `$s$` | law `$T(s)$` |
//! |---|---|---|
//! | segment of a yarn | strain `$\varepsilon = \lvert x_b - x_a\rvert/h - 1$` | traction, N/m |
//! | corner of a cell | sine `$\hat e_{warp}\cdot\hat e_{weft}$` of the shear angle | shear, N/m |
//! | triple of a yarn | curvature `$\kappa$` about the normal | bending, N |
//!
//! The sine has one sign for all four corners. The curvature comes from the second difference
//! `$b = (x_a - 2x_c + x_b)/h^2$`.
//!
//! A connector of area `$W$` has the energy `$W\int T\,\mathrm{d}s$` and the forces
//! `$f_i = -W\,T\,\partial s/\partial x_i$`, which conserve linear and angular momentum and do not
//! depend on the spacing. The forces of \[NB04, eqs. 4–5\] agree to first order if their lever arm
//! is the segment `$h$`. In the second derivative of bending, the normal is the one at the start of
//! the step: its rotation within the step is neglected.
//!
//! `vector`, `block` and `half` hold the algebra. `turning_angle` is the curvature of a second
//! difference, `bending` a bending connector in scalar form (used by `reference` and `seam`),
//! `yarn_tangent` the normals, `triangle_strain` the reported strains. This chapter does not use
//! the cloth.

pub(crate) mod bending;
pub(crate) mod block;
pub(crate) mod half;
pub(crate) mod triangle_strain;
pub(crate) mod turning_angle;
pub(crate) mod vector;
pub(crate) mod yarn_tangent;
