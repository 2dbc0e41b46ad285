//! Errors of panels, seams and states, with the values that do not fit.

/// Reason why a cloth, or a part of it, cannot be made or evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A length is not greater than 0.
    #[error("{what} is {value} m; it must be greater than 0")]
    Length {
        /// Name of the length.
        what: &'static str,
        /// Value of the length, in m.
        value: f64,
    },
    /// The spacing of the particles is too large for the panel.
    #[error(
        "a spacing of {spacing} m leaves fewer than 3 particles across {size} m; use {} m or less",
        size / 2.0
    )]
    Spacing {
        /// Distance between particles, in m.
        spacing: f64,
        /// Smallest size of the panel, in m.
        size: f64,
    },
    /// The number of particles is beyond the range of the indices.
    #[error("a spacing of {spacing} m makes {particles:.3e} particles, more than {limit:.0e}")]
    TooMany {
        /// Distance between particles, in m.
        spacing: f64,
        /// Number of particles with this spacing.
        particles: f64,
        /// Largest number of particles.
        limit: f64,
    },
    /// A part of a panel that was cut elsewhere is inconsistent.
    #[error("{part} {index} of the panel {what}")]
    Mesh {
        /// Kind of part: node, cell or triangle.
        part: &'static str,
        /// Index of the part, counted from 0.
        index: usize,
        /// Problem with the part.
        what: &'static str,
    },
    /// A seam does not fit the panels.
    #[error("seam {seam}, pair {pair}: {what}")]
    Seam {
        /// Index of the seam, counted from 0.
        seam: usize,
        /// Index of the pair, counted from 0.
        pair: usize,
        /// Problem with the pair.
        what: &'static str,
    },
    /// The width of an allowance is negative or not finite.
    #[error("an allowance is {width} m wide; give 0 or more")]
    Width {
        /// Width of the allowance, in m.
        width: f64,
    },
    /// A fold does not fit its panel.
    #[error("fold {fold} {what}")]
    Fold {
        /// Index of the fold of the panel, counted from 0.
        fold: usize,
        /// Problem with the fold.
        what: &'static str,
    },
    /// A panel cannot be graded, because it is graded already.
    #[error("a panel that is graded already cannot be graded again")]
    Graded,
    /// A panel has a rim of triangles, but the model has none.
    #[error(
        "the model of Breen, House & Wozny has no rims: cut the panel as a rectangle or a disc"
    )]
    Rim,
    /// A cloth has no panels.
    #[error("a cloth needs at least one panel")]
    Empty,
    /// A panel of a cloth has no area, or more than a number can hold.
    #[error("panel {panel} has an area of {area} m²; it must be greater than 0 and finite")]
    Area {
        /// Index of the panel, counted from 0.
        panel: usize,
        /// Area of the panel, in m².
        area: f64,
    },
    /// The fabric of a panel is out of range.
    #[error("the fabric of panel {panel}: {}", problems.join("; "))]
    Fabric {
        /// Index of the panel, counted from 0.
        panel: usize,
        /// Problems of the fabric, each with its key.
        problems: Vec<String>,
    },
    /// A tie of a cloth names a particle that does not exist, or has a fraction outside of 0 to 1.
    #[error("tie {tie} names a particle that does not exist, or has a fraction outside of 0 to 1")]
    Tie {
        /// Index of the tie, counted from 0.
        tie: usize,
    },
    /// A list has another length than the cloth requires.
    #[error("{name}: {found} numbers given for a cloth that needs {expected}")]
    Dimension {
        /// Name of the list.
        name: &'static str,
        /// Length that the cloth requires.
        expected: usize,
        /// Length of the list.
        found: usize,
    },
    /// A state or a workspace belongs to another cloth.
    #[error("the {what} belongs to another cloth")]
    OtherCloth {
        /// Name of the object.
        what: &'static str,
    },
}

/// Checks that the list called `name` has the `expected` length.
pub(crate) fn check_length(name: &'static str, expected: usize, found: usize) -> Result<(), Error> {
    if expected == found { Ok(()) } else { Err(Error::Dimension { name, expected, found }) }
}
