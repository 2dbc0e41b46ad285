//! Reasons why a fabric cannot be written for another program.

use drape_input::figure;

/// Reason why a fabric cannot be written for another program.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Load outside the admissible range: choose a load from 0.1 to 10 000 N/m.
    #[error(
        "a stiffness cannot be read at a load of {} N/m; choose one from 0.1 to 10000 N/m, such as 20",
        figure(*load)
    )]
    Load {
        /// Load, in N/m.
        load: f64,
    },
    /// Load that the fabric does not carry at any strain: choose a smaller load.
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
    /// Value that the simulated tests do not find: check the fabric.
    #[error("the laws of the {direction} give no {value}; check the fabric")]
    Missing {
        /// Direction, in words.
        direction: &'static str,
        /// Name of the value.
        value: &'static str,
    },
}
