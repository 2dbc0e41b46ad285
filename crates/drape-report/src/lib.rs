#![doc = include_str!("../README.md")]

mod base64;
mod camera;
mod check;
mod compare_page;
mod error;
mod facets;
mod fit_html;
mod fit_page;
mod fit_text;
mod law_report;
mod light;
mod number;
mod parameter;
mod picture;
pub mod plot;
mod render;
mod scene;
mod shade;
mod shown;
mod symbol;
mod table;
mod triangle;
mod validation_page;
mod vector;
mod view;

pub use camera::Camera;
pub use compare_page::{ComparePage, ComparedValue, FabricName};
pub use error::ReportError;
pub use fit_page::{FitPage, KesValue, Quantity};
pub use law_report::{LawReport, Limits, ModelScore, Statistics, Trust, Verdict};
pub use parameter::{Interval, Parameter, Unit, Units};
pub use picture::Picture;
pub use render::render;
pub use scene::{Colour, Scene, Surface};
pub use validation_page::{ValidationCase, ValidationPage, ValidationRow};
pub use view::View;
