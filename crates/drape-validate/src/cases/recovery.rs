//! Cases of recovery: the angle or curvature to which a bent or folded strip comes when it is let
//! go.
//!
//! The curvature that friction holds is known in closed form. A strip that is folded at rest
//! returns to the angle of its fold.

mod crease;
mod fold;

pub(crate) use crease::{crease, permanent_set};
pub(crate) use fold::fold;
