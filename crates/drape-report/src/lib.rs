#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`render`] draws a [`Scene`] of [`Surface`]s for a [`View`] and returns a [`Picture`].
//! [`LitShapes`] draw the same shapes several times. The functions of [`plot`] draw SVG figures of
//! measured and fitted curves. [`FitPage`], [`ComparePage`], [`CustomerPage`], [`ValidationPage`]
//! and [`StudyPage`] are reports that become HTML pages and text. A [`Parameter`] is a number with
//! its [`Units`] and its [`Interval`].
//!
//! Layers, lowest first: `error`, `check`, `text`, `parameter`, `picture`; the chapters `render`
//! and `plot`; `page`.

// Checks and texts.
mod check;
mod error;
mod parameter;
mod text;

// Pictures of cloth.
mod picture;
mod render;

// Figures.
pub mod plot;

// Reports.
mod page;

pub use error::Error;
pub use page::{
    CaptionedPicture, ComparePage, Compared, ComparedNumber, ComparedValue, CustomerPage,
    Difference, EffectTable, Evidence, FabricName, FitPage, KesValue, LawReport, LawValue, Limits,
    MeasureEffects, ModelScore, Quantity, ReportedDrape, ReportedFabric, ReportedGarment,
    ReportedGirth, ReportedLoop, ReportedNote, ReportedValue, Statistics, StudyPage, Trust,
    ValidationCase, ValidationPage, ValidationRow, Verdict,
};
pub use parameter::{Interval, Parameter, Unit, Units};
pub use picture::{Animation, Colour, ColourScale, Legend, Picture, Swatches, diverging};
pub use render::{Camera, Extent, Ground, LitShapes, Scene, ScreenPoint, Surface, View, render};
