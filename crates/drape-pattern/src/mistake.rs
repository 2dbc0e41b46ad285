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
    #[error("panel {panel}: edge {edge} reaches {reach:.3e} m from the origin")]
    Far {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// Its farthest coordinate, in m.
        reach: f64,
    },
    /// An outline has fewer than two edges: add some.
    #[error("panel {panel} has {edges} edges")]
    FewEdges {
        /// The panel.
        panel: String,
        /// How many edges it has.
        edges: usize,
    },
    /// Two edges of a panel have one name: give each its own.
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
        /// One of the two.
        first: String,
        /// The other.
        second: String,
        /// Where, in the panel's frame, in m.
        at: [f64; 2],
    },
    /// An outline encloses nothing: give the panel area.
    #[error("panel {panel} has an area of {area:.3e} m²")]
    NoArea {
        /// The panel.
        panel: String,
        /// Its area, in m².
        area: f64,
    },
    /// A panel has a size that no garment's has: correct the unit of the file.
    #[error("panel {panel} is {size:.4} m wide or high")]
    Size {
        /// The panel.
        panel: String,
        /// Its larger side, in m.
        size: f64,
    },
    /// Two panels have one name: give each its own.
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
    /// The grain or the place of a panel is not finite: correct it.
    #[error("panel {panel}: its {value} is not finite")]
    Placed {
        /// The panel.
        panel: String,
        /// What of it.
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
    /// A stitch names an edge that there is not: name another.
    #[error("stitch {stitch} names edge {edge} of panel {panel}, which there is not")]
    NoEdge {
        /// The stitch.
        stitch: String,
        /// Number of the panel, from 0.
        panel: usize,
        /// Number of the edge, from 0.
        edge: usize,
    },
    /// A side of a stitch has no edges: name some.
    #[error("stitch {stitch} has a side without edges")]
    EmptySide {
        /// The stitch.
        stitch: String,
    },
    /// An edge is sewn twice: split it, or join both seams in one chain.
    #[error("edge {edge} of panel {panel} is sewn twice, in stitches {first} and {second}")]
    SewnTwice {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// One of the two.
        first: String,
        /// The other.
        second: String,
    },
    /// An edge is hemmed and sewn: leave out the hem.
    #[error("edge {edge} of panel {panel} has a hem, and is sewn in stitch {stitch}")]
    SewnHem {
        /// The panel.
        panel: String,
        /// The edge.
        edge: String,
        /// The stitch.
        stitch: String,
    },
    /// The ease of a stitch is none that can be cut: choose another.
    #[error("stitch {stitch}: max_ease is {max_ease}")]
    MaxEase {
        /// The stitch.
        stitch: String,
        /// The limit.
        max_ease: f64,
    },
    /// The sides of a stitch differ too much: correct the edges, or allow more fullness.
    #[error(
        "stitch {stitch}: {long} {} and {short} {}: ratio {ratio:.3} is above max_ease {max_ease}",
        Millimetres(lengths[0]), Millimetres(lengths[1])
    )]
    Ease {
        /// The stitch.
        stitch: String,
        /// The edges of the longer side.
        long: String,
        /// The edges of the shorter side.
        short: String,
        /// Lengths of the longer and the shorter side, in m.
        lengths: [f64; 2],
        /// The ratio of the lengths.
        ratio: f64,
        /// The limit.
        max_ease: f64,
    },
    /// The spacing is no length: choose one.
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
        /// Where, in the panel's frame, in m.
        at: [f64; 2],
        /// The spacing, in m.
        spacing: f64,
    },
    /// A panel would have too many nodes: choose a larger spacing.
    #[error("panel {panel} would have {nodes:.2e} nodes at a spacing of {}", Millimetres(*spacing))]
    TooMany {
        /// The panel.
        panel: String,
        /// About how many.
        nodes: f64,
        /// The spacing, in m.
        spacing: f64,
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
            Self::Wrap { width, .. } => {
                let least = Millimetres(width / std::f64::consts::TAU);
                format!("wrap it to more than {least}, or leave wrap out for a flat panel")
            }
            Self::NoEdge { .. } => "name panels and edges that there are".into(),
            Self::EmptySide { .. } => "name one edge or more on each side".into(),
            Self::SewnTwice { .. } => "split the edge, or join both in one chain".into(),
            Self::SewnHem { .. } => "leave out the hem, and give the seam an allowance".into(),
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
            | Self::Wrap { panel, .. }
            | Self::ShortEdge { panel, .. }
            | Self::Narrow { panel, .. }
            | Self::TooMany { panel, .. }
            | Self::Rim { panel, .. } => Subject::Panel(panel),
            Self::NoEdge { stitch, .. }
            | Self::EmptySide { stitch }
            | Self::SewnHem { stitch, .. }
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
