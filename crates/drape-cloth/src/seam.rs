//! Bending across and along seams. It is added to the bending of the panels, whose connectors end
//! at their outlines.
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
//! the yarn by `$\kappa\cos^2\vartheta$`, as on a cylinder.
//!
//! `description` says which nodes are sewn, `builder` makes connectors from it, `connector` is one
//! connector, `bending` all of them. Seams are scalar, because a garment has some hundred segments.
//! They use `measure::bending`, keep separate memories under the rules of a step, and pass on their
//! blocks, because particles that are sewn become one.

pub(crate) mod bending;
pub(crate) mod builder;
pub(crate) mod connector;
pub(crate) mod description;
