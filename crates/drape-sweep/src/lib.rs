#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! * `file`: TOML form of a study; `study`: [`Study`], read and checked; `base`: [`Base`], what its
//!   points are runs of; `axes`: [`Axis`] and its levels, samples of ranges and of the errors of
//!   fitted fabrics; `measure`: [`Measure`], a value of all summaries, and
//!   [`Convergence`], its limit as the spacing goes to 0.
//! * `point`: [`Point`], one run of a study; `key`: digests of what it reads.
//! * `place`: [`PointStorage`], where a point has its results, its lock and its record:
//!   [`Record`], what came of it; `manifest`: the list of all points.
//! * `table`: [`Table`], inputs, measures and records of all points; `effects`: means over levels.
//! * `engine`: files by which others run a study: Slurm, HyperQueue, Dask.

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
