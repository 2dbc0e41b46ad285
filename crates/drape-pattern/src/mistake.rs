//! Mistakes of a pattern, each with its values, its remedy and its subject.

use std::path::Path;

use drape_input::{Diagnostic, Subject};

use crate::ease::MAX_EASE;
use crate::length::{Extents, Millimetres};

/// Largest spacing for an edge, over its length. Half a spacing would do. A slightly smaller value
/// leaves room for rounding.
const MOST_SPACING: f64 = 1.99;

/// Mistake of a pattern, or of cutting it at a spacing. Lengths are in m.
///
/// Each variant names the mistake and, after the colon, the remedy.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Mistake {
    /// A number of an edge is not finite, or an arc turns full circle: correct it.
    #[error("panel {panel}: edge {edge} has a number that is not finite, or turns full circle")]
    NotFinite {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
    },
    /// An edge lies farther out than any cloth: check the unit.
    #[error("panel {panel}: edge {edge} has a point {distance:.3e} m from the origin")]
    Far {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// Largest coordinate, in m.
        distance: f64,
    },
    /// An outline has fewer than two edges: add some.
    #[error("panel {panel} has {edges} edges")]
    FewEdges {
        /// The panel.
        panel: String,
        /// Number of its edges.
        edges: usize,
    },
    /// Two edges of a panel have the same name: give each another name.
    #[error("panel {panel} has two edges named {edge}")]
    SameEdge {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
    },
    /// An edge is a point: remove it.
    #[error("panel {panel}: edge {edge} has the length {}", Millimetres(*length))]
    EmptyEdge {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// Its length, in m.
        length: f64,
    },
    /// An edge does not begin where the one before it ends: close the outline.
    #[error(
        "panel {panel}: {} gap between the end of edge {from} and the start of edge {to}",
        Millimetres(*gap)
    )]
    Open {
        /// The panel.
        panel: String,
        /// The edge before the gap.
        from: String,
        /// The edge after the gap.
        to: String,
        /// Width of the gap, in m.
        gap: f64,
    },
    /// An outline meets itself: let it run once round.
    #[error(
        "panel {panel}: edges {first} and {second} cross or touch at ({:.1}, {:.1}) mm",
        1000.0 * at[0], 1000.0 * at[1]
    )]
    Crossing {
        /// The panel.
        panel: String,
        /// One of the two edges.
        first: String,
        /// The other edge.
        second: String,
        /// Point where they meet, in the panel's frame, in m.
        at: [f64; 2],
    },
    /// A closed dart meets the outline or another dart: move it inside.
    #[error(
        "panel {panel}: dart {dart} meets edge {edge} near ({:.1}, {:.1}) mm",
        1000.0 * at[0], 1000.0 * at[1]
    )]
    DartMeets {
        /// The panel.
        panel: String,
        /// The dart.
        dart: String,
        /// The edge.
        edge: String,
        /// Point near which they meet, in the panel's frame, in m.
        at: [f64; 2],
    },
    /// A closed dart is outside of its panel, or in another dart: move it inside.
    #[error("panel {panel}: dart {dart} is not in the cloth of the panel")]
    DartOutside {
        /// The panel.
        panel: String,
        /// The dart.
        dart: String,
    },
    /// The mouth of an open dart is not on its edge: move it there.
    #[error(
        "panel {panel}: the mouth of dart {dart} is from {} to {} along edge {edge}, which is {} long",
        Millimetres(mouth[0]), Millimetres(mouth[1]), Millimetres(*length)
    )]
    Mouth {
        /// The panel.
        panel: String,
        /// The dart.
        dart: String,
        /// The edge.
        edge: String,
        /// Distances of the ends of the mouth from the start of the edge, in m.
        mouth: [f64; 2],
        /// Length of the edge, in m.
        length: f64,
    },
    /// An outline encloses nothing: let it enclose cloth.
    #[error("panel {panel} has an area of {area:.3e} m²")]
    NoArea {
        /// The panel.
        panel: String,
        /// Its area, in m².
        area: f64,
    },
    /// A panel is larger or smaller than any garment panel: correct the unit of the file.
    #[error("panel {panel} is {}", Extents(*size))]
    Size {
        /// The panel.
        panel: String,
        /// Its width and its height, in m.
        size: [f64; 2],
    },
    /// Two panels have the same name: give each another name.
    #[error("there are two panels named {panel}")]
    SamePanel {
        /// The panel.
        panel: String,
    },
    /// A command of an SVG path cannot be read: correct the path.
    #[error("panel {panel}: command {command} of its path cannot be read")]
    PathSyntax {
        /// The panel.
        panel: String,
        /// The command, from 1.
        command: usize,
    },
    /// An SVG path is more than one outline: give each its own panel.
    #[error("panel {panel}: at command {command} of its path a second outline begins, or none has")]
    PathParts {
        /// The panel.
        panel: String,
        /// The command, from 1.
        command: usize,
    },
    /// The grain, a fold or the place of a panel is not finite: correct it.
    #[error("panel {panel}: its {value} is not finite")]
    Placed {
        /// The panel.
        panel: String,
        /// The quantity, in words.
        value: &'static str,
    },
    /// A panel that is wrapped would meet itself: wrap it to a larger radius.
    #[error(
        "panel {panel} is {} wide and meets itself when wrapped to a radius of {}",
        Millimetres(*width), Millimetres(*wrap)
    )]
    Wrap {
        /// The panel.
        panel: String,
        /// The radius, in m.
        wrap: f64,
        /// Its width, in m.
        width: f64,
    },
    /// A seam names an edge that does not exist: name another.
    #[error("seam {seam} names edge {edge} of panel {panel}, which does not exist")]
    NoEdge {
        /// The seam.
        seam: String,
        /// Number of the panel, from 0.
        panel: usize,
        /// Number of the edge, from 0.
        edge: usize,
    },
    /// A side of a seam has no edges: name some.
    #[error("seam {seam} has a side without edges")]
    EmptySide {
        /// The seam.
        seam: String,
    },
    /// An edge is sewn twice: split it, or join both seams in one chain.
    #[error("edge {edge} of panel {panel} is sewn twice, in seams {first} and {second}")]
    SewnTwice {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// Seam that names it first.
        first: String,
        /// Seam that names it again.
        second: String,
    },
    /// An edge is hemmed and sewn: leave out the hem.
    #[error("edge {edge} of panel {panel} has a hem, and is sewn in seam {seam}")]
    SewnHem {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// The seam.
        seam: String,
    },
    /// The largest ease of a seam is out of range: choose another.
    #[error("seam {seam}: max_ease is {max_ease}")]
    MaxEase {
        /// The seam.
        seam: String,
        /// Largest ease that is allowed.
        max_ease: f64,
    },
    /// The sides of a seam differ too much in length: correct the edges, or allow more fullness.
    #[error(
        "seam {seam}: {long} {} and {short} {}: ratio {ratio:.3} is above max_ease {max_ease}",
        Millimetres(lengths[0]), Millimetres(lengths[1])
    )]
    Ease {
        /// The seam.
        seam: String,
        /// The edges of the longer side.
        long: String,
        /// The edges of the shorter side.
        short: String,
        /// Lengths of the longer and the shorter side, in m.
        lengths: [f64; 2],
        /// The ratio of the lengths.
        ratio: f64,
        /// Largest ease that is allowed.
        max_ease: f64,
    },
    /// The spacing is out of range: choose another.
    #[error("the spacing is {spacing} m")]
    Spacing {
        /// The spacing, in m.
        spacing: f64,
    },
    /// An edge is too short for the spacing: choose a smaller spacing.
    #[error(
        "panel {panel}: edge {edge} is {}, under half the spacing ({})",
        Millimetres(*length), Millimetres(*spacing)
    )]
    ShortEdge {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// Its length, in m.
        length: f64,
        /// The spacing, in m.
        spacing: f64,
    },
    /// A sampled outline meets itself: choose a smaller spacing.
    #[error(
        "panel {panel} is too narrow near ({:.1}, {:.1}) mm to be cut at a spacing of {}",
        1000.0 * at[0], 1000.0 * at[1], Millimetres(*spacing)
    )]
    Narrow {
        /// The panel.
        panel: String,
        /// Point in the panel's frame, in m.
        at: [f64; 2],
        /// The spacing, in m.
        spacing: f64,
    },
    /// A panel would have too many nodes: choose a larger spacing.
    #[error("panel {panel} would have {nodes:.2e} nodes at a spacing of {}", Millimetres(*spacing))]
    TooMany {
        /// The panel.
        panel: String,
        /// Approximate number.
        nodes: f64,
        /// The spacing, in m.
        spacing: f64,
    },
    /// An outline has too many edges: simplify it.
    #[error("panel {panel}: its outline has {edges} edges, more than {most}")]
    TooManyEdges {
        /// The panel.
        panel: String,
        /// Number of edges.
        edges: usize,
        /// Largest number of edges of an outline.
        most: usize,
    },
    /// The rim could not be triangulated, a fault of the cutter: report the pattern.
    #[error("panel {panel}: the rim could not be triangulated at a spacing of {}", Millimetres(*spacing))]
    Rim {
        /// The panel.
        panel: String,
        /// The spacing, in m.
        spacing: f64,
    },
}

impl Mistake {
    /// Returns the remedy, in words.
    #[must_use]
    pub fn help(&self) -> String {
        // Grouped as the variants are: edges and outlines, darts, seams, cutting.
        match self {
            Self::NotFinite { .. } | Self::Placed { .. } => {
                "write finite numbers; an arc turns through less than 360 degrees".into()
            }
            Self::Far { .. } | Self::Size { .. } => {
                "is the unit right? a garment panel is 1 mm to 50 m long, and up to 5 m wide".into()
            }
            Self::FewEdges { .. } => "an outline needs two edges or more".into(),
            Self::SameEdge { .. } => "give each edge of a panel its own name".into(),
            Self::EmptyEdge { .. } => "remove it, or move one of its ends".into(),
            Self::Open { .. } => "let each edge begin where the one before it ends".into(),
            Self::Crossing { .. } => "let the outline run once round without meeting itself".into(),
            Self::NoArea { .. } => "let the outline run round some cloth".into(),
            Self::DartMeets { .. } => {
                "keep the dart inside the panel, clear of its edges and of other darts; one that \
                                       opens at an edge is written with edge, at, width and depth"
                    .into()
            }
            Self::DartOutside { .. } => {
                "give its tips in the frame of the panel, inside the outline".into()
            }
            Self::Mouth { length, .. } => format!(
                "at is the middle of the mouth and width its width: both ends lie on the edge, between 0 and {}, \
                 clear of other darts",
                Millimetres(*length)
            ),
            Self::PathSyntax { .. } => "a path is SVG's: M, L, H, V, C, S, Q, T, A and Z".into(),
            Self::PathParts { .. } => "begin with M, end with Z, and draw one outline".into(),
            Self::SamePanel { .. } => "give each panel its own name".into(),
            Self::Wrap { width, .. } => {
                let least = Millimetres(width / std::f64::consts::TAU);
                format!("wrap it to more than {least}, or leave wrap out for a flat panel")
            }
            Self::NoEdge { .. } => "name panels and edges that exist".into(),
            Self::EmptySide { .. } => "name one edge or more on each side".into(),
            Self::SewnTwice { .. } => "split the edge, or join both in one chain".into(),
            Self::SewnHem { .. } => "leave out the hem, and give the seam an allowance".into(),
            Self::MaxEase { .. } => {
                format!("from 1 to {}: gathers beyond are not cut", MAX_EASE)
            }
            Self::Ease { .. } => match self.enough_ease() {
                Some(enough) => {
                    format!(
                        "write max_ease = {enough} if the fullness is meant, or correct the edges"
                    )
                }
                None => format!(
                    "gathers above {MAX_EASE} are not cut: shorten the longer side, or sew it to several edges"
                ),
            },
            Self::Spacing { .. } => "choose a length, such as 0.01 m".into(),
            Self::ShortEdge { length, .. } => {
                let most = Millimetres(MOST_SPACING * length);
                format!("use a spacing of {most} or less, or join it to a neighbour")
            }
            Self::Narrow { spacing, .. } => {
                format!("use a spacing under {}", Millimetres(0.5 * spacing))
            }
            Self::TooMany { .. } => "use a larger spacing; or is the unit right?".into(),
            Self::TooManyEdges { .. } => "simplify the outline: a curve is one edge".into(),
            Self::Rim { .. } => "use another spacing, and report the pattern".into(),
        }
    }

    /// Returns the panel, edge or seam that the mistake is about; `None` for [`Mistake::Spacing`].
    #[must_use]
    pub fn subject(&self) -> Option<Subject> {
        // A seam with two wrong edges is shown as a whole.
        Some(match self {
            Self::NotFinite { panel, edge }
            | Self::Far { panel, edge, .. }
            | Self::SameEdge { panel, edge }
            | Self::EmptyEdge { panel, edge, .. }
            | Self::Open { panel, to: edge, .. }
            | Self::Crossing { panel, first: edge, .. }
            | Self::DartMeets { panel, edge, .. }
            | Self::Mouth { panel, edge, .. }
            | Self::ShortEdge { panel, edge, .. } => {
                Subject::Edge { panel: panel.clone(), edge: edge.clone() }
            }
            Self::FewEdges { panel, .. }
            | Self::NoArea { panel, .. }
            | Self::DartOutside { panel, .. }
            | Self::Size { panel, .. }
            | Self::SamePanel { panel }
            | Self::PathSyntax { panel, .. }
            | Self::PathParts { panel, .. }
            | Self::Placed { panel, .. }
            | Self::Wrap { panel, .. }
            | Self::Narrow { panel, .. }
            | Self::TooMany { panel, .. }
            | Self::TooManyEdges { panel, .. }
            | Self::Rim { panel, .. } => Subject::Panel(panel.clone()),
            Self::NoEdge { seam, .. }
            | Self::EmptySide { seam }
            | Self::SewnHem { seam, .. }
            | Self::MaxEase { seam, .. }
            | Self::Ease { seam, .. }
            | Self::SewnTwice { second: seam, .. } => Subject::Seam(seam.clone()),
            Self::Spacing { .. } => return None,
        })
    }

    /// Returns the point of the mistake in the frame of its panel, in m, if it has one.
    #[must_use]
    pub fn place(&self) -> Option<[f64; 2]> {
        match self {
            Self::Crossing { at, .. } | Self::DartMeets { at, .. } | Self::Narrow { at, .. } => {
                Some(*at)
            }
            _ => None,
        }
    }

    /// Returns the mistake as a diagnostic of `file`, without a line.
    #[must_use]
    pub fn diagnostic(&self, file: &Path) -> Diagnostic {
        let diagnostic = Diagnostic::new(file, self.to_string()).help(self.help());
        Diagnostic { subject: self.subject(), ..diagnostic }
    }

    /// Returns the largest spacing at which a [`Mistake::ShortEdge`] goes away, in m.
    #[must_use]
    pub fn most_spacing(&self) -> Option<f64> {
        match self {
            Self::ShortEdge { length, .. } => Some(MOST_SPACING * length),
            _ => None,
        }
    }

    /// Returns the `max_ease` that is enough for the fullness of a [`Mistake::Ease`], if the seam
    /// can be cut.
    pub(crate) fn enough_ease(&self) -> Option<f64> {
        match self {
            // Two digits, rounded up.
            Self::Ease { ratio, .. } if *ratio <= MAX_EASE => {
                Some(((100.0 * ratio).ceil() / 100.0).min(MAX_EASE))
            }
            _ => None,
        }
    }
}
