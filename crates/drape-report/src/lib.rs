#![doc = include_str!("../README.md")]

mod camera;
mod error;
mod facets;
mod light;
mod picture;
mod render;
mod scene;
mod shade;
mod triangle;
mod vector;
mod view;

pub use camera::Camera;
pub use error::ReportError;
pub use picture::Picture;
pub use render::render;
pub use scene::{Colour, Scene, Surface};
pub use view::View;
