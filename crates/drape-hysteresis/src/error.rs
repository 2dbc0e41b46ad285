//! Errors of friction elements, with the values that are out of range.

use std::fmt;

/// Reason why numbers are no friction.
///
/// A friction with such numbers could create energy, or its load would not be a number.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// The plateau of an element, in the unit of the load, is negative or not finite.
    Plateau(f64),
    /// The friction length of an element, in the unit of the deformation, is not positive or not
    /// finite.
    Length(f64),
    /// The slow element of a second-order model has a larger plateau than the fast element.
    SlowPlateau {
        /// Plateau of the fast element, in the unit of the load.
        fast: f64,
        /// Size of the plateau of the slow element, in the unit of the load.
        slow: f64,
    },
    /// The slow element of a second-order model is not longer than the fast element.
    SlowLength {
        /// Friction length of the fast element, in the unit of the deformation.
        fast: f64,
        /// Friction length of the slow element, in the unit of the deformation.
        slow: f64,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Plateau(plateau) => {
                write!(formatter, "the plateau {plateau} must be finite and at least 0")
            }
            Self::Length(length) => {
                write!(formatter, "the friction length {length} must be finite and greater than 0")
            }
            Self::SlowPlateau { fast, slow } => write!(
                formatter,
                "the slow plateau {slow} must be at least 0 and not larger than the fast plateau \
                 {fast}"
            ),
            Self::SlowLength { fast, slow } => write!(
                formatter,
                "the slow element's length {slow} must be larger than the fast element's length \
                 {fast}"
            ),
        }
    }
}

impl std::error::Error for Error {}
