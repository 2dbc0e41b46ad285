//! The commands: one module each, with its arguments and the function that carries it out.
//!
//! A command reads its input through the library (`drape::kes`, `drape::fabric`, `drape::scene` …),
//! calls the library to compute, and writes the result through [`say`](crate::say),
//! [`file`](drape::run::file) and [`pages`](crate::pages). No command computes physics. Only `main`
//! turns a [`Failure`](crate::failure::Failure) into an exit code.
//!
//! [`sheets`] is shared by the commands that read sheets. A few commands use another command's
//! module: [`mod@test`] reads its fabric through [`fabric`], [`fabric`] stores its page through
//! [`fit`], [`export`] has the picture options of [`show`], the report of [`fabric`] takes the
//! drapes of [`mod@test`], and [`run`] tries proposed positions as [`check`] does.

pub(crate) mod bench;
pub(crate) mod check;
pub(crate) mod convert;
pub(crate) mod export;
pub(crate) mod fabric;
pub(crate) mod fit;
pub(crate) mod run;
pub(crate) mod schema;
pub(crate) mod shell;
pub(crate) mod show;
pub(crate) mod sweep;
pub(crate) mod test;
pub(crate) mod validate;

mod sheets;
