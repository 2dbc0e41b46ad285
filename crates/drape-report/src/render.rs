//! Pictures of cloth: a software rasterizer with soft shadows.
//!
//! [`render`] draws a [`Scene`] for a [`View`]:
//! 1. `camera` frames the scene; `tessellation` subdivides its surfaces into facets with smooth
//!    normals.
//! 2. `shade` prepares the lights: ambient occlusion of a uniform sky (`sky`) and a key light, both
//!    with shadow maps (`shadow_map`).
//! 3. `screen` projects the facets; `raster` resolves visibility with a depth buffer of 4 × 4
//!    samples a pixel, band by band in parallel, and shades each visible facet once per pixel.
//! 4. `picture` holds the pixels and writes PNG.
//!
//! `triangle`, `vector` and `colour` are the arithmetic below. The chapter knows nothing of plots
//! or pages. Its result does not depend on the number of threads.

mod camera;
mod colour;
mod picture;
mod raster;
mod scene;
mod screen;
mod shade;
mod shadow_map;
mod sky;
mod tessellation;
mod triangle;
mod vector;

pub use camera::{Camera, ScreenPoint, View};
pub use colour::{Colour, diverging};
pub use picture::Picture;
pub use scene::{Scene, Surface};
pub use sky::SkyLight;

use rayon::prelude::*;

use crate::error::Error;
use raster::{BAND, Band};
use screen::ScreenFacet;
use shade::{LitScene, Shader};
use tessellation::Tessellation;

/// Draws a scene.
///
/// Cloth is lit on both sides by a uniform sky and one key light with soft shadows. Front, back,
/// warp lines (blue), weft lines (red) and hem differ in colour. The same input gives the same
/// bytes, with any number of threads.
///
/// The rasterizer is part of this crate: no maintained one that works without a graphics card was
/// found.
///
/// # Errors
/// A scene without triangles, bad lists or coordinates, a number of the view out of range.
pub fn render(scene: &Scene, view: &View) -> Result<Picture, Error> {
    let camera = view.camera(scene)?;
    let tessellation = Tessellation::new(scene);
    let sky = SkyLight::on(&tessellation);
    Ok(draw(LitScene { scene, sky: &sky }, &tessellation, &camera, view))
}

/// Draws a scene with the light of the sky that another picture of the same shapes has.
///
/// # Errors
/// Those of [`render`], or light of other shapes.
pub fn render_lit(scene: &Scene, view: &View, sky: &SkyLight) -> Result<Picture, Error> {
    let camera = view.camera(scene)?;
    let tessellation = Tessellation::new(scene);
    let points = tessellation.lit_points.len();
    if sky.len() != points {
        return Err(Error::OtherShapes { points, lit: sky.len() });
    }
    Ok(draw(LitScene { scene, sky }, &tessellation, &camera, view))
}

fn draw(lit: LitScene, tessellation: &Tessellation, camera: &Camera, view: &View) -> Picture {
    let shader = Shader::new(lit, tessellation, camera, view);
    let facets = tessellation.facets.iter();
    let facets: Vec<ScreenFacet> =
        facets.filter_map(|facet| ScreenFacet::project(tessellation, facet, camera)).collect();

    let height = view.height as usize;
    let tops: Vec<usize> = (0..height).step_by(BAND).collect();
    let bands: Vec<Vec<u8>> = tops
        .into_par_iter()
        .map_init(
            || Band::new(view.width as usize),
            |band, top| band.paint(&facets, &shader, top..(top + BAND).min(height)),
        )
        .collect();
    Picture::new(view.width, view.height, bands.concat())
}
