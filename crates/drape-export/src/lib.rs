#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! A [`Clip`] has the frames of a recording that are written, with their times. Each format has a
//! function that writes a clip, or a frame of it.
//!
//! Layers, lowest first: `error`, `name`, `colour`, `palette`, `scale`; `normal`; `clip` chooses
//! frames; `mesh` divides them into panels and bodies; `field` computes numbers at their vertices;
//! `format` and `view` write them.

mod error;

mod colour;
mod name;
mod normal;
mod palette;
mod scale;

mod clip;
mod mesh;

mod field;
mod format;
mod view;

#[cfg(test)]
mod example;

pub use clip::Clip;
pub use error::Error;
pub use field::{Field, Fields};
pub use format::glb::{GLB_FRAMES_MAX, write_glb};
pub use format::mdd::write_mdd;
pub use format::npz::write_npz;
pub use format::obj::{write_obj, write_rest_obj};
pub use format::pc2::write_pc2;
pub use format::svg::{PatternMap, write_svg};
pub use format::table::write_csv;
pub use format::usda::write_usda;
pub use format::vtk::{CollectionFile, PolyData, Surface, write_pvd, write_vtp};
pub use palette::{FabricPalette, Rgb};
pub use scale::rounded_up;
pub use view::{Named, View};
