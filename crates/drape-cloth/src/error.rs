/// Why a cloth cannot be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A length that must be greater than 0 is not.
    #[error("{what} is {value} m; it must be greater than 0")]
    Length {
        /// Name of the length.
        what: &'static str,
        /// Its value, in m.
        value: f64,
    },
    /// The particles are too far apart for the panel.
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
    /// More particles than the indices can count.
    #[error("a spacing of {spacing} m makes {particles:.3e} particles, more than {limit:.0e}")]
    TooMany {
        /// Distance between particles, in m.
        spacing: f64,
        /// Particles it makes.
        particles: f64,
        /// Largest number of particles.
        limit: f64,
    },
    /// The parts of a panel that was cut elsewhere do not fit together.
    #[error("{part} {index} of the panel {what}")]
    Mesh {
        /// What kind of part: node, cell or triangle.
        part: &'static str,
        /// Which of them, counted from 0.
        index: usize,
        /// What is wrong with it.
        what: &'static str,
    },
    /// A seam does not fit the panels.
    #[error("seam {seam}, pair {pair}: {what}")]
    Seam {
        /// Which seam, counted from 0.
        seam: usize,
        /// Which of its pairs, counted from 0.
        pair: usize,
        /// What is wrong with it.
        what: &'static str,
    },
    /// An allowance has no width.
    #[error("an allowance is {width} m wide; give 0 or more")]
    Width {
        /// The width, in m.
        width: f64,
    },
    /// A fold does not fit its panel.
    #[error("fold {fold} {what}")]
    Fold {
        /// Which fold of the panel, counted from 0.
        fold: usize,
        /// What is wrong with it.
        what: &'static str,
    },
    /// The model knows no panels with a rim of triangles.
    #[error(
        "the model of Breen, House & Wozny knows no rims: cut the panel as a rectangle or a disc"
    )]
    Rim,
    /// The positions given do not fit the cloth.
    #[error("{found} numbers were given for the positions of {particles} particles; give 3 each")]
    Positions {
        /// How many numbers were given.
        found: usize,
        /// How many particles the cloth has.
        particles: usize,
    },
}
