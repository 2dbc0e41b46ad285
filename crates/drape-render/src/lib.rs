#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`render`] draws a [`Scene`] of [`Surface`]s for a [`View`] and returns a [`Picture`].
//! [`LitShapes`] draw the same shapes several times, for [`Camera`]s that share one scale. A
//! [`Legend`] or [`Swatches`] add a strip below a picture that explains the colours. A
//! [`ColourScale`] gives the colours of values. An [`Animation`] writes pictures to one file.
//!
//! Chapters, lowest first: `error`; `picture`; `render`.

mod error;
mod picture;
mod render;

pub use error::Error;
pub use picture::{Animation, Colour, ColourScale, Legend, Picture, Swatches, diverging};
pub use render::{Camera, Extent, Ground, LitShapes, Scene, ScreenPoint, Surface, View, render};
