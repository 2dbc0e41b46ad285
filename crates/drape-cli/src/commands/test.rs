//! `drape test`: specimens of a fabric in simulated KES instruments, or on a drapemeter.
//!
//! [`instruments`] tests specimens in traction, bending and shear and compares the loops with the
//! laws of the fabric. [`drapemeter`] drapes specimens and evaluates their shadows.
//! `drape::validate` computes both.

mod arguments;
mod drapemeter;
pub(crate) mod drapes;
mod instruments;

pub(crate) use arguments::TestArguments;

use self::drapes::check_spacing;
use crate::commands::fabric;
use crate::failure::Failure;
use crate::input;

/// Executes `drape test`.
pub(crate) fn test(arguments: &TestArguments) -> Result<(), Failure> {
    input::set_values(&arguments.set);
    let fabric = fabric::read(&arguments.fabric)?;
    check_spacing(arguments.spacing)?;
    if arguments.drape {
        drapemeter::drape(&fabric, arguments)
    } else {
        instruments::compare(&fabric, arguments)
    }
}
