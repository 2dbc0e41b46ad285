//! Notes on a pattern or its cut that do not prevent its use.

use crate::length::{Extents, Millimetres};

/// Note on a pattern or its cut: a fact that its user should know, and that prevents nothing.
/// Lengths are in m.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PatternNote {
    /// The outline was given clockwise.
    #[error("panel {panel}: its outline ran clockwise and was reversed")]
    Reversed {
        /// The panel.
        panel: String,
    },
    /// The outline was given clockwise, with a place in space: the panel was turned over.
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
    /// The format has no seams.
    #[error(
        "no seams: {format} does not say which edges are sewn; add [seam.NAME] with sides = \
         [[\"PANEL.EDGE\"], [\"PANEL.EDGE\"]]"
    )]
    NoSeams {
        /// The format.
        format: &'static str,
    },
    /// A part of the file is no panel.
    #[error("left out, {part}: {reason}")]
    LeftOut {
        /// The part.
        part: String,
        /// Why it is no panel.
        reason: String,
    },
    /// Seams of the file name edges that the pattern no longer has.
    #[error("seams of edges that are left out or split are left out too: {}", seams.join(", "))]
    SeamsLeftOut {
        /// The seams.
        seams: Vec<String>,
    },
    /// A reader has chosen a value that the file does not state.
    #[error("{taken}: {reason}")]
    Taken {
        /// The choice.
        taken: String,
        /// Reason of the choice.
        reason: String,
    },
    /// A panel is half of a symmetric panel, and the file says so.
    #[error("panel {panel} is cut on the fold: it was unfolded along edge {edge}")]
    Unfolded {
        /// The panel.
        panel: String,
        /// The edge on the fold.
        edge: String,
    },
    /// A text of the file says that a panel is half of a symmetric panel, and no edge is known to
    /// be the fold.
    #[error(
        "panel {panel} is one half, as its text \"{text}\" says, and is taken as it is: no edge is marked as the fold; \
         mirror it in the program that wrote it"
    )]
    Half {
        /// The panel.
        panel: String,
        /// The text.
        text: String,
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
    /// The ends of a short edge are one node, and so are the ends of the edge that it is sewn to.
    #[error(
        "panel {panel}: edge {edge} is {}, under half the spacing ({}); its ends are one particle",
        Millimetres(*length), Millimetres(*spacing)
    )]
    Merged {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// Its length, in m.
        length: f64,
        /// The spacing, in m.
        spacing: f64,
    },
    /// Ends of short edges in smooth runs, as in digitised outlines, are no nodes.
    #[error(
        "panel {panel}: {ends} ends of edges in smooth runs of edges under half the spacing ({}) are no nodes",
        Millimetres(*spacing)
    )]
    Dissolved {
        /// The panel.
        panel: String,
        /// Number of ends.
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
        /// Width at that point, in m.
        width: f64,
        /// Point in the panel's frame, in m.
        at: [f64; 2],
        /// The spacing, in m.
        spacing: f64,
    },
    /// The largest panel of a pattern is of a size that no garment has.
    #[error(
        "panel {panel} is {}, and no panel is larger: no garment has this size; if a unit of the file is 1 {likely}, \
         the panel is {}",
        Extents(*size), Extents(*meant)
    )]
    Size {
        /// The panel.
        panel: String,
        /// Its width and its height, in m.
        size: [f64; 2],
        /// Unit in which the size would be usual.
        likely: &'static str,
        /// Width and height in that unit, in m.
        meant: [f64; 2],
    },
    /// In space, the ends of a seam lie closer together in the opposite sense.
    #[error(
        "seam {seam} may run in the wrong sense: its ends are {} apart as given and {} if reversed",
        Millimetres(*given), Millimetres(*reversed)
    )]
    Twisted {
        /// The seam.
        seam: String,
        /// Distance of the ends as given, in m.
        given: f64,
        /// Distance of the ends if reversed, in m.
        reversed: f64,
    },
}
