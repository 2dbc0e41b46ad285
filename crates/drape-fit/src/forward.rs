//! Forward models: the loads that a law predicts along a measured history of deformations.
//!
//! The regression evaluates the models some thousand times for each curve. Therefore each file
//! computes the load of one kind of test in one pass over the history, and agrees with the laws of
//! drape-fabric to rounding. The tests compare both.
//!
//! ```math
//! F(q) = F_e(q) + F_r(q), \qquad \frac{dF_r}{dq} = \frac{F_c\,\mathrm{sgn}\,\dot q - F_r}{x_f}
//! ```
//!
//! with the elastic load `$F_e$` of the backbone and the friction `$F_r$` of one or two Dahl
//! elements of plateau `$F_c$` and length `$x_f$` \[Dahl68, BS95\]. The chapter uses the laws and
//! no curve: histories are numbers in SI.
//!
//! * `loop_drive`: a bending or shear law along a hysteresis loop.
//! * `strip_drive`: a traction law along a strip that may hang slack.
//! * `friction_path`: a friction element of given length for all points at once, with derivatives.
//! * `arch`, `elliptic`: the clamped elastica of a loop-bending strip.

pub(crate) mod arch;
pub(crate) mod elliptic;
pub(crate) mod friction_path;
pub(crate) mod loop_drive;
pub(crate) mod strip_drive;
