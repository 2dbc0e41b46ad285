use std::fmt;

use drape_input::Diagnostics;

/// A length in mm, short enough to read.
pub(crate) struct Millimetres(pub f64);

impl fmt::Display for Millimetres {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = 1000.0 * self.0;
        match value.abs() {
            100.0.. => write!(f, "{value:.0} mm"),
            0.05.. => write!(f, "{value:.1} mm"),
            _ => write!(f, "{value:.3} mm"),
        }
    }
}

/// What is wrong with a pattern, or with cutting it at a spacing. Lengths are in m.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "the names and the messages say what the fields are")]
pub enum Mistake {
    /// Write finite numbers, and arcs of less than a full turn.
    #[error("panel {panel}: edge {edge} has a number that is not finite, or turns full circle")]
    NotFinite { panel: String, edge: String },
    /// Check the unit.
    #[error("panel {panel}: edge {edge} reaches {reach:.3e} m from the origin")]
    Far { panel: String, edge: String, reach: f64 },
    /// Add edges.
    #[error("panel {panel} has {edges} edges")]
    FewEdges { panel: String, edges: usize },
    /// Give each edge its own name.
    #[error("panel {panel} has two edges named {edge}")]
    SameEdge { panel: String, edge: String },
    /// Remove the edge.
    #[error("panel {panel}: edge {edge} has the length {}", Millimetres(*length))]
    EmptyEdge { panel: String, edge: String, length: f64 },
    /// Close the outline.
    #[error(
        "panel {panel}: {} gap between the end of edge {from} and the start of edge {to}",
        Millimetres(*gap)
    )]
    Open { panel: String, from: String, to: String, gap: f64 },
    /// Let the outline run once round.
    #[error(
        "panel {panel}: edges {first} and {second} cross or touch at ({:.1}, {:.1}) mm",
        1000.0 * at[0], 1000.0 * at[1]
    )]
    Crossing { panel: String, first: String, second: String, at: [f64; 2] },
    /// Give the panel area.
    #[error("panel {panel} has an area of {area:.3e} m²")]
    NoArea { panel: String, area: f64 },
    /// Correct the unit of the file.
    #[error("panel {panel} is {size:.4} m wide or high")]
    Size { panel: String, size: f64 },
    /// Give each panel its own name.
    #[error("there are two panels named {panel}")]
    SamePanel { panel: String },
    /// Correct the path.
    #[error("panel {panel}: command {command} of its path cannot be read")]
    PathSyntax { panel: String, command: usize },
    /// Give each outline its own panel.
    #[error("panel {panel}: at command {command} of its path a second outline begins, or none has")]
    PathParts { panel: String, command: usize },
    /// Write a finite angle or place.
    #[error("panel {panel}: its {value} is not finite")]
    Placed { panel: String, value: &'static str },
    /// Name an edge that exists.
    #[error("stitch {stitch} names edge {edge} of panel {panel}, which there is not")]
    NoEdge { stitch: String, panel: usize, edge: usize },
    /// Name edges on both sides.
    #[error("stitch {stitch} has a side without edges")]
    EmptySide { stitch: String },
    /// Split the edge or join a chain.
    #[error("edge {edge} of panel {panel} is sewn twice, in stitches {first} and {second}")]
    SewnTwice { panel: String, edge: String, first: String, second: String },
    /// Keep the limit within what can be cut.
    #[error("stitch {stitch}: max_ease is {max_ease}")]
    MaxEase { stitch: String, max_ease: f64 },
    /// Correct the edges or allow more fullness.
    #[error(
        "stitch {stitch}: {long} {} and {short} {}: ratio {ratio:.3} is above max_ease {max_ease}",
        Millimetres(lengths[0]), Millimetres(lengths[1])
    )]
    Ease {
        stitch: String,
        long: String,
        short: String,
        lengths: [f64; 2],
        ratio: f64,
        max_ease: f64,
    },
    /// Choose a length.
    #[error("the spacing is {spacing} m")]
    Spacing { spacing: f64 },
    /// Choose a smaller spacing.
    #[error(
        "panel {panel}: edge {edge} is {}, under half the spacing ({})",
        Millimetres(*length), Millimetres(*spacing)
    )]
    ShortEdge { panel: String, edge: String, length: f64, spacing: f64 },
    /// Choose a smaller spacing.
    #[error(
        "panel {panel} is too narrow near ({:.1}, {:.1}) mm to be cut at a spacing of {}",
        1000.0 * at[0], 1000.0 * at[1], Millimetres(*spacing)
    )]
    Narrow { panel: String, at: [f64; 2], spacing: f64 },
    /// Choose a larger spacing.
    #[error("panel {panel} would have {nodes:.2e} nodes at a spacing of {}", Millimetres(*spacing))]
    TooMany { panel: String, nodes: f64, spacing: f64 },
    /// Report it: it is a fault of the cutter.
    #[error("panel {panel}: the rim could not be triangulated at a spacing of {}", Millimetres(*spacing))]
    Rim { panel: String, spacing: f64 },
}

/// What a mistake is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject<'a> {
    /// The panel of this name.
    Panel(&'a str),
    /// The stitch of this name.
    Stitch(&'a str),
    /// The spacing.
    Spacing,
}

impl Mistake {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::NotFinite { .. } | Self::Placed { .. } => {
                "write finite numbers; an arc turns through less than 360 degrees".into()
            }
            Self::Far { .. } | Self::Size { .. } => {
                "is the unit right? a garment panel is 0.02 to 3 m".into()
            }
            Self::FewEdges { .. } => "an outline needs two edges or more".into(),
            Self::SameEdge { .. } => "give each edge of a panel its own name".into(),
            Self::EmptyEdge { .. } => "remove it, or move one of its ends".into(),
            Self::Open { .. } => "let each edge begin where the one before it ends".into(),
            Self::Crossing { .. } => "let the outline run once round without meeting itself".into(),
            Self::NoArea { .. } => "let the outline run round some cloth".into(),
            Self::PathSyntax { .. } => "a path is SVG's: M, L, H, V, C, S, Q, T, A and Z".into(),
            Self::PathParts { .. } => "begin with M, end with Z, and draw one outline".into(),
            Self::SamePanel { .. } => "give each panel its own name".into(),
            Self::NoEdge { .. } => "name panels and edges that there are".into(),
            Self::EmptySide { .. } => "name one edge or more on each side".into(),
            Self::SewnTwice { .. } => "split the edge, or join both in one chain".into(),
            Self::MaxEase { .. } => {
                format!("from 1 to {}: gathers beyond are not cut", crate::MAX_EASE)
            }
            Self::Ease { ratio, .. } if *ratio <= crate::MAX_EASE => {
                "raise max_ease if the fullness is meant".into()
            }
            Self::Ease { .. } => format!(
                "gathers above {} are not cut: shorten the longer side, or sew it to several edges",
                crate::MAX_EASE
            ),
            Self::Spacing { .. } => "choose a length, such as 0.01 m".into(),
            // Half a spacing is enough; a little less is a round number.
            Self::ShortEdge { length, .. } => {
                format!(
                    "use a spacing of {} or less, or join it to a neighbour",
                    Millimetres(1.99 * length)
                )
            }
            Self::Narrow { spacing, .. } => {
                format!("use a spacing under {}", Millimetres(0.5 * spacing))
            }
            Self::TooMany { .. } => "use a larger spacing; or is the unit right?".into(),
            Self::Rim { .. } => "use another spacing, and report the pattern".into(),
        }
    }

    /// What it is about.
    #[must_use]
    pub fn subject(&self) -> Subject<'_> {
        match self {
            Self::NotFinite { panel, .. }
            | Self::Far { panel, .. }
            | Self::FewEdges { panel, .. }
            | Self::SameEdge { panel, .. }
            | Self::EmptyEdge { panel, .. }
            | Self::Open { panel, .. }
            | Self::Crossing { panel, .. }
            | Self::NoArea { panel, .. }
            | Self::Size { panel, .. }
            | Self::SamePanel { panel }
            | Self::PathSyntax { panel, .. }
            | Self::PathParts { panel, .. }
            | Self::Placed { panel, .. }
            | Self::ShortEdge { panel, .. }
            | Self::Narrow { panel, .. }
            | Self::TooMany { panel, .. }
            | Self::Rim { panel, .. } => Subject::Panel(panel),
            Self::NoEdge { stitch, .. }
            | Self::EmptySide { stitch }
            | Self::MaxEase { stitch, .. }
            | Self::Ease { stitch, .. }
            | Self::SewnTwice { second: stitch, .. } => Subject::Stitch(stitch),
            Self::Spacing { .. } => Subject::Spacing,
        }
    }
}

/// Why a pattern could not be read, made or cut.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file has mistakes: correct them; all that were found are listed.
    #[error(transparent)]
    Input(#[from] Diagnostics),
    /// The pattern has mistakes, or cannot be cut at the spacing: all that were found are listed.
    #[error("{}", list(.0))]
    Pattern(Vec<Mistake>),
}

fn list(mistakes: &[Mistake]) -> String {
    let lines: Vec<String> =
        mistakes.iter().map(|mistake| format!("{mistake}\n  help: {}", mistake.help())).collect();
    lines.join("\n")
}
