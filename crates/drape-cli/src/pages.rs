//! Pages and pictures: what a person is shown of results that the library gives.
//!
//! Each module fills in a type of `drape::report` or `drape::export`, which draws it; the numbers come from
//! `drape::fit`, `drape::validate` and `drape::scene` and are not computed again here. [`quantity`]
//! has the name, the symbol and the units of every number, [`kes_value`] those of KES values. The
//! commands call these modules and store the files; nothing here reads or writes one.

pub(crate) mod picture;
pub(crate) mod run_picture;
pub(crate) mod start;
pub(crate) mod strain_map;
pub(crate) mod sweep;
pub(crate) mod validation;
