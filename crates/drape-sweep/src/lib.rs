#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! * The study. `file`: the TOML form of a study. `study`: [`Study`], a study that has been read
//!   and checked. `base`: [`Base`], the kind of run of all points. `axes`: [`Axis`] and its levels,
//!   samples of ranges, and samples of the errors of fitted fabrics. `measure`: [`Measure`], a
//!   value of all summaries, and [`Convergence`], the limit of a value as the spacing goes to 0.
//! * Points. `point`: [`Point`], one run of a study. `key`: digests of the files that a run reads.
//!   `storage`: [`PointStorage`], the folder, lock and [`Record`] of a point. `manifest`: the list
//!   of all points.
//! * Results. `table`: [`Table`], inputs, measures and records of all points. `effects`: means over
//!   levels.
//! * `engine`: files with which Slurm, HyperQueue and Dask run a study.
#![cfg_attr(docsrs, feature(doc_cfg))]

mod axes;
mod base;
mod effects;
mod engine;
mod error;
mod file;
mod key;
mod manifest;
mod measure;
mod point;
mod storage;
mod study;
mod table;

pub use axes::{Axis, AxisKind};
pub use base::Base;
pub use effects::{Interaction, MainEffect, Mean, interaction, main_effect};
pub use engine::{Batch, Engine};
pub use error::Error;
#[cfg(feature = "schema")]
pub use file::study_schema;
pub use manifest::manifest;
pub use measure::Measure;
pub use measure::convergence::{Approach, Convergence, GRID_ORDER, GridValue};
pub use point::{Point, Shard};
pub use storage::{Outcome, PointLock, PointStorage, Record};
pub use study::{Keep, Study};
pub use table::{Column, Table};
