//! The commands: one module each, with its arguments and what it does with them.
//!
//! A command reads its input through the library (`drape::kes`, `drape::fabric`, `drape::scene` …),
//! has it computed there, and writes the result through [`say`](crate::say), [`file`](drape::run::file)
//! and the pages of [`pages`](crate::pages). No command computes physics, and only `main` turns a
//! [`Failure`](crate::failure::Failure) into an exit code.
//!
//! [`sheets`] is shared by the commands that read sheets. Of the commands, [`test`] reads its
//! fabric through [`fabric`], which stores its page through [`fit`], [`export`] has the options of
//! pictures of [`show`], the report of [`fabric`] takes the drapes of [`test`], and [`run`] has places tried as
//! [`check`] does; no other knows another.

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
