//! Errors of panels, seams and states, with the values that do not fit.

/// Reason why a cloth, or a part of it, cannot be made.
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
    /// The number of coordinates does not fit the cloth.
    #[error("{found} numbers were given for the positions of {particles} particles; give 3 each")]
    Positions {
        /// Number of coordinates given.
        found: usize,
        /// Number of particles of the cloth.
        particles: usize,
    },
}
