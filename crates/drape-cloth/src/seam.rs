//! Bending across and along seams, in addition to that of the panels, whose connectors end at their
//! outlines.
//!
//! ```text
//!      panel 1      │      panel 2         across a segment a–b: from the two
//!    ───────┬───── a ┬───── ───┬───        triangles (c, d) beside it
//!           │  c  ╱│╲  d       │           along the seam: three nodes in a row
//!    ───────┴───── b ┴─────────┴───        on each side
//!                  │ seam
//! ```
//!
//! Across, the second difference is `$(\hat p + \hat q)/w$` with the directions in which the
//! triangles leave the segment and their mean height `$w$`: a curvature `$\theta/w$` for an angle
//! `$\theta$` between the panels. A curvature `$\kappa$` at an angle `$\vartheta$` to a yarn bends
//! it by `$\kappa\cos^2\vartheta$`, as on a cylinder.
//!
//! `description` says which nodes are sewn, `builder` makes connectors of it, `connector` is one of
//! them, `bending` is all of them. Seams are scalar (a garment has some hundred segments): they
//! call `measure::bending`, keep their own memories under the rules of a step, and hand on their
//! blocks, because particles that are sewn become one.

pub(crate) mod bending;
pub(crate) mod builder;
pub(crate) mod connector;
pub(crate) mod description;
