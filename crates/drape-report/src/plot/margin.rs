//! Margins of a plot: the pixels across, which frame and legend share.

/// Width of a plot, in px.
pub(crate) const WIDTH: f64 = 720.0;

/// Room for the labels left of a frame, in px.
pub(crate) const LEFT: f64 = 68.0;

/// Room right of a frame, in px.
pub(crate) const RIGHT: f64 = 14.0;

/// First and last pixel across a frame.
pub(crate) const ACROSS: [f64; 2] = [LEFT, WIDTH - RIGHT];
