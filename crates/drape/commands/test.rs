//! `drape test`: specimens of a fabric in simulated KES instruments, or on a drapemeter.
//!
//! [`instruments`] tests specimens in traction, bending and shear and compares the loops with the
//! laws of the fabric; [`drapemeter`] drapes specimens and reads their shadows. Both are computed
//! by `drape::validate`.

mod arguments;
mod drapemeter;
mod instruments;

pub(crate) use arguments::TestArguments;

use crate::commands::fabric;
use crate::failure::Failure;
use crate::input;

/// Executes `drape test`.
pub(crate) fn test(arguments: &TestArguments) -> Result<(), Failure> {
    input::set(&arguments.set);
    let fabric = fabric::read(&arguments.fabric)?;
    if let Some(spacing) = arguments.spacing.filter(|mm| !(*mm >= 0.5 && *mm <= 50.0)) {
        let message = format!("--spacing {spacing} is not between 0.5 and 50 (mm)");
        return Err(Failure::Usage(message));
    }
    if arguments.drape {
        drapemeter::drape(&fabric, arguments)
    } else {
        instruments::compare(&fabric, arguments)
    }
}
