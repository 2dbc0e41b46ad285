use crate::mistake::Millimetres;

/// Something about a pattern or its cut that its user should know, and that hinders nothing. Lengths are
/// in m.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Note {
    /// The outline was given clockwise.
    #[error("panel {panel}: its outline ran clockwise and was reversed")]
    Reversed {
        /// The panel.
        panel: String,
    },
    /// The outline was given clockwise, with a place in space.
    #[error("panel {panel}: its outline ran clockwise, so its right side faces the other way")]
    TurnedOver {
        /// The panel.
        panel: String,
    },
    /// No grain was given.
    #[error(
        "no grainline: {}; warp along the pattern's y axis is assumed; set grain",
        panels.join(", ")
    )]
    NoGrain {
        /// The panels.
        panels: Vec<String>,
    },
    /// A panel is half of a symmetric one, and the file says so.
    #[error("panel {panel} is cut on the fold: it was unfolded along edge {edge}")]
    Unfolded {
        /// The panel.
        panel: String,
        /// The edge on the fold.
        edge: String,
    },
    /// A short edge has no node at one of its ends.
    #[error(
        "panel {panel}: edge {edge} is {}, under half the spacing ({}); joined with edge {with}",
        Millimetres(*length), Millimetres(*spacing)
    )]
    Joined {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// The edge that it was joined with.
        with: String,
        /// Its length, in m.
        length: f64,
        /// The spacing, in m.
        spacing: f64,
    },
    /// Ends of short edges in smooth runs, as digitised outlines have, are no nodes.
    #[error(
        "panel {panel}: {ends} ends of edges in smooth runs of edges under half the spacing ({}) are no nodes",
        Millimetres(*spacing)
    )]
    Dissolved {
        /// The panel.
        panel: String,
        /// How many.
        ends: usize,
        /// The spacing, in m.
        spacing: f64,
    },
    /// Cloth with fewer than three particles across bends wrongly.
    #[error(
        "panel {panel} is {} wide near ({:.1}, {:.1}) mm: fewer than 3 particles across at a spacing of {}; bending across it will be wrong; use {}",
        Millimetres(*width), 1000.0 * at[0], 1000.0 * at[1], Millimetres(*spacing), Millimetres(0.5 * width)
    )]
    Thin {
        /// The panel.
        panel: String,
        /// Width there, in m.
        width: f64,
        /// Where, in the panel's frame, in m.
        at: [f64; 2],
        /// The spacing, in m.
        spacing: f64,
    },
    /// The placed panels suggest the other sense.
    #[error(
        "stitch {stitch} may run the wrong way: its ends are {} apart as given and {} if reversed",
        Millimetres(*given), Millimetres(*reversed)
    )]
    Twisted {
        /// The stitch.
        stitch: String,
        /// How far the ends lie apart as given, in m.
        given: f64,
        /// How far they would lie apart, in m.
        reversed: f64,
    },
}
