//! Pictures of cloth: a software rasterizer with soft shadows.
//!
//! [`render`] draws a [`Scene`] for a [`View`]. [`LitShapes`] draw several pictures of the same
//! shapes, each for a [`Camera`]:
//! 1. `tessellation` subdivides the surfaces of the scene into facets with smooth normals
//!    (`smooth`). `rim` adds a band along each hem.
//! 2. `sky` is the light of a uniform sky on the facets and on the floor (`floor`).
//! 3. `camera` frames the scene, alone or as pictures that can be compared.
//! 4. `shade` prepares the key light, with a shadow map (`shadow_map`).
//! 5. `screen` projects the facets. `raster` resolves visibility with a depth buffer of 4 × 4
//!    samples a pixel, band by band in parallel, and shades each visible facet once per pixel.
//!
//! `triangle` and `vector` are the arithmetic of all of them. The chapter knows nothing of plots or
//! pages. Its result does not depend on the number of threads.

mod camera;
mod floor;
mod raster;
mod rim;
mod scene;
mod screen;
mod shade;
mod shadow_map;
mod sky;
mod smooth;
mod tessellation;
mod triangle;
mod vector;

pub use camera::{Camera, Extent, ScreenPoint, View};
pub use scene::{Ground, Scene, Surface};

use rayon::prelude::*;

use crate::error::Error;
use crate::picture::Picture;
use floor::Floor;
use raster::{BAND, Band, Bands};
use screen::ScreenFacet;
use shade::{Lit, Shader};
use sky::SkyLight;
use tessellation::Tessellation;

/// Draws a `scene` for a `view` so that the scene fills the picture.
///
/// Cloth is lit on both sides by a uniform sky and one key light with soft shadows. Front, back,
/// warp lines (blue), weft lines (red), hem and seams differ in colour. Equal input gives equal
/// bytes, with any number of threads.
///
/// The rasterizer is part of this crate, because no maintained rasterizer was found that works
/// without a graphics card.
///
/// # Errors
/// A scene without triangles, bad lists or coordinates, or a number of the view out of range.
pub fn render(scene: &Scene, view: &View) -> Result<Picture, Error> {
    let camera = view.camera(scene)?;
    LitShapes::new(scene)?.draw(scene, &camera)
}

/// Shapes of a scene with the light of the sky on them, from which any number of pictures is drawn.
///
/// The light does not depend on the view or on colours, and takes most of the time of a picture.
///
/// ```
/// use drape_render::{Extent, LitShapes, Scene, Surface, View};
///
/// let corners = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
/// let scene = Scene { cloths: vec![Surface::cloth(&corners, &[[0, 1, 2]])], ..Scene::default() };
/// let shapes = LitShapes::new(&scene)?;
/// // Front and side in one scale.
/// let view = |azimuth_deg| View { azimuth_deg, width: 90, height: 120, ..View::default() };
/// for camera in View::cameras(&[view(0.0), view(90.0)], &Extent::of(&scene))? {
///     assert_eq!(shapes.draw(&scene, &camera)?.width(), 90);
/// }
/// # Ok::<(), drape_render::Error>(())
/// ```
pub struct LitShapes {
    tessellation: Tessellation,
    floor: Option<Floor>,
    sky: SkyLight,
    /// Numbers of vertices and triangles of each cloth and then of each body.
    counts: Vec<[usize; 2]>,
}

impl LitShapes {
    /// Computes the light on the shapes of a `scene`.
    ///
    /// # Errors
    /// A scene without triangles, or bad lists or coordinates.
    pub fn new(scene: &Scene) -> Result<LitShapes, Error> {
        scene.check()?;
        let mut tessellation = Tessellation::new(scene);
        rim::add(scene, &mut tessellation);
        let floor = scene.floor.map(|height| Floor::new(height, tessellation.bounds));
        let sky = SkyLight::on(&tessellation, floor.as_ref());
        Ok(LitShapes { tessellation, floor, sky, counts: counts(scene) })
    }

    /// Draws the shapes in the colours of a `scene` with the same shapes.
    ///
    /// # Errors
    /// A scene that cannot be drawn, or that has other shapes.
    pub fn draw(&self, scene: &Scene, camera: &Camera) -> Result<Picture, Error> {
        scene.check()?;
        if counts(scene) != self.counts {
            return Err(Error::OtherShapes);
        }
        let (tessellation, sky, floor) = (&self.tessellation, &self.sky, self.floor.as_ref());
        let shader = Shader::new(&Lit { tessellation, sky, floor }, scene, camera);
        let (width, height) = (camera.width() as usize, camera.height() as usize);
        let bands = Bands::new(ScreenFacet::all(tessellation, camera), height);
        let mut pixels = vec![0; 3 * width * height];
        pixels.par_chunks_mut(3 * width * BAND).enumerate().for_each_init(
            || Band::new(width),
            |band, (number, pixels)| band.paint(&bands, &shader, number, pixels),
        );
        Ok(Picture::new(camera.width(), camera.height(), pixels))
    }
}

/// Returns the numbers of coordinates and triangles of the surfaces of a `scene`.
fn counts(scene: &Scene) -> Vec<[usize; 2]> {
    let surfaces = scene.cloths.iter().chain(&scene.bodies);
    surfaces.map(|surface| [surface.positions.len(), surface.triangles.len()]).collect()
}
