use crate::mistake::Millimetres;

/// Something about a pattern or its cut that its user should know, and that hinders nothing. Lengths are
/// in m.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the names and the messages say what the fields are")]
pub enum Note {
    /// The outline was given clockwise.
    #[error("panel {panel}: its outline ran clockwise and was reversed")]
    Reversed { panel: String },
    /// The outline was given clockwise, with a place in space.
    #[error("panel {panel}: its outline ran clockwise, so its right side faces the other way")]
    TurnedOver { panel: String },
    /// No grain was given.
    #[error(
        "no grainline: {}; warp along the pattern's y axis is assumed; set grain",
        panels.join(", ")
    )]
    NoGrain { panels: Vec<String> },
    /// A panel is half of a symmetric one, and the file says so.
    #[error("panel {panel} is cut on the fold: it was unfolded along edge {edge}")]
    Unfolded { panel: String, edge: String },
    /// A short edge has no node at one of its ends.
    #[error(
        "panel {panel}: edge {edge} is {}, under half the spacing ({}); joined with edge {with}",
        Millimetres(*length), Millimetres(*spacing)
    )]
    Joined { panel: String, edge: String, with: String, length: f64, spacing: f64 },
    /// Cloth with fewer than three particles across bends wrongly.
    #[error(
        "panel {panel} is {} wide near ({:.1}, {:.1}) mm: fewer than 3 particles across at a spacing of {}; bending across it will be wrong; use {}",
        Millimetres(*width), 1000.0 * at[0], 1000.0 * at[1], Millimetres(*spacing), Millimetres(0.5 * width)
    )]
    Thin { panel: String, width: f64, at: [f64; 2], spacing: f64 },
    /// The placed panels suggest the other sense.
    #[error(
        "stitch {stitch} may run the wrong way: its ends are {} apart as given and {} if reversed",
        Millimetres(*given), Millimetres(*reversed)
    )]
    Twisted { stitch: String, given: f64, reversed: f64 },
}
