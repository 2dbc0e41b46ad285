#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! The functions of [`plot`] draw SVG figures of measured and fitted curves. [`FitPage`],
//! [`ComparePage`], [`CustomerPage`], [`ValidationPage`] and [`StudyPage`] are reports that become
//! HTML pages and text. A [`Parameter`] is a number with its [`Units`] and its [`Interval`].
//! Pages show pictures of the crate `drape-render`.
//!
//! Layers, lowest first: `error`, `check`, `text`, `parameter`; the chapter `plot`; `page`.

// Checks and texts.
mod check;
mod error;
mod parameter;
mod text;

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
