//! Pages and pictures of the results that the library computes.
//!
//! Each module fills in a type of `drape::report` or `drape::export`, and that type draws itself.
//! The numbers come from `drape::fit`, `drape::validate` and `drape::scene` and are not computed
//! again here. The commands call these modules and store the files. Nothing here reads or writes a
//! file.

pub(crate) mod picture;
pub(crate) mod run_picture;
pub(crate) mod start;
pub(crate) mod strain_map;
pub(crate) mod sweep;
pub(crate) mod validation;
