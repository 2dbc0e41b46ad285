//! Reasons why a fabric cannot be written for another program.

use drape_input::figure;

/// Reason why a fabric cannot be written for another program.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Load at which no secant can be read: choose one from 0.1 to 10 000 N/m.
    #[error(
        "a stiffness cannot be read at a load of {} N/m; choose one from 0.1 to 10000 N/m, such as 20",
        figure(*load)
    )]
    Load {
        /// Load, in N/m.
        load: f64,
    },
    /// Load that the fabric never carries: choose a smaller one.
    #[error(
        "the {direction} does not carry {} N/m, however far it is stretched; read the stiffness at a \
         smaller load",
        figure(*load)
    )]
    NoStretch {
        /// Direction, in words.
        direction: &'static str,
        /// Load, in N/m.
        load: f64,
    },
    /// Value that the laws do not give: check the fabric.
    #[error("the laws of the {direction} give no {value}; check the fabric with `drape check`")]
    Missing {
        /// Direction, in words.
        direction: &'static str,
        /// Name of the value.
        value: &'static str,
    },
}
