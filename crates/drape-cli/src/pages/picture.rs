//! Pictures of cloth and bodies, with yarn lines or in a colour per particle.

use drape::dynamics::Snapshot;
use drape::export::FabricPalette;
use drape::render::{
    Camera, Colour, Extent, Ground, LitShapes, Picture, Scene, Surface, Swatches, View,
};

use crate::failure::Failure;

/// Distance between the yarn lines of a cloth of 1 m, in m.
const LINE_SPACING: f64 = 0.05;

/// Depth of the floor below the lowest point of cloth and bodies, in m.
pub(crate) const FLOOR: f64 = 0.002;

/// Azimuths of the pictures of a garment: front, side and back, in degrees.
pub(crate) const SIDES: [f64; 3] = [0.0, 90.0, 180.0];

/// Elevation of the pictures of a garment, in degrees.
pub(crate) const ELEVATION: f64 = 6.0;

/// Width and height of each picture of a garment, in pixels.
pub(crate) const UPRIGHT: [u32; 2] = [600, 1000];

/// Width and height of a picture that stands alone, in pixels.
pub(crate) const SIZE: [u32; 2] = [1200, 900];

/// Radius around a point within which a detail picture shows the cloth, in m.
const DETAIL_RADIUS: f64 = 0.12;

/// Returns a copy of `snapshot` with only the triangles near `place`, in m.
pub(crate) fn detail(snapshot: &Snapshot, place: [f64; 3]) -> Snapshot {
    let mut detail = snapshot.clone();
    let fabrics = std::mem::take(&mut detail.triangle_fabrics);
    let is_kept = keep_near(&mut detail.positions, &mut detail.triangles, place);
    let kept = fabrics.into_iter().zip(is_kept).filter(|(_, is_kept)| *is_kept);
    detail.triangle_fabrics = kept.map(|(fabric, _)| fabric).collect();
    for body in &mut detail.bodies {
        keep_near(&mut body.positions, &mut body.triangles, place);
    }
    detail
}

/// Keeps the `triangles` with a corner near `place`, and returns for each triangle whether it is
/// kept. Corners of no kept triangle are moved to `place`, so that they do not widen the view of
/// the picture.
fn keep_near(positions: &mut [f64], triangles: &mut Vec<[u32; 3]>, place: [f64; 3]) -> Vec<bool> {
    let is_kept: Vec<bool> = triangles
        .iter()
        .map(|triangle| triangle.iter().any(|&corner| is_near(positions, corner, place)))
        .collect();
    triangles.retain(|triangle| triangle.iter().any(|&corner| is_near(positions, corner, place)));

    let mut is_used = vec![false; positions.len() / 3];
    triangles.iter().flatten().for_each(|&corner| is_used[corner as usize] = true);
    let corners = positions.chunks_exact_mut(3).zip(is_used);
    corners.filter(|(_, is_used)| !is_used).for_each(|(corner, _)| corner.copy_from_slice(&place));
    is_kept
}

/// Returns whether particle `corner` is within [`DETAIL_RADIUS`] of `place`.
fn is_near(positions: &[f64], corner: u32, place: [f64; 3]) -> bool {
    let squares =
        (0..3).map(|axis: usize| (positions[3 * corner as usize + axis] - place[axis]).powi(2));
    squares.sum::<f64>() < DETAIL_RADIUS * DETAIL_RADIUS
}

/// Pictures of one snapshot. The light is computed once for all of them.
pub(crate) struct SnapshotPictures<'a> {
    snapshot: &'a Snapshot,
    /// Material coordinates, two per particle, in m.
    coordinates: Vec<f64>,
    shapes: LitShapes,
    palette: FabricPalette,
    /// Colours of the front and the back of each triangle, if the garment has several fabrics.
    sides: Option<Vec<[Colour; 2]>>,
    /// Marks beside the cloth, such as seams.
    marks: Option<Surface<'a>>,
}

impl<'a> SnapshotPictures<'a> {
    /// Prepares the pictures of `snapshot`.
    pub(crate) fn new(snapshot: &'a Snapshot) -> Result<Self, Failure> {
        Self::with_marks(snapshot, None)
    }

    /// Prepares the pictures of `snapshot` with `marks` beside its cloth.
    pub(crate) fn with_marks(
        snapshot: &'a Snapshot,
        marks: Option<Surface<'a>>,
    ) -> Result<Self, Failure> {
        let Snapshot { positions, triangles, coordinates, fabrics, triangle_fabrics, .. } =
            snapshot;
        let mut scene = scene(snapshot, Surface::cloth(positions, triangles));
        scene.cloths.extend(marks);

        let palette =
            FabricPalette::new(fabrics.iter().map(|fabric| (&fabric.name[..], fabric.colour)));
        let sides: Vec<[Colour; 2]> =
            fabrics.iter().map(|fabric| palette.sides(&fabric.name)).collect();

        Ok(Self {
            // Marks have colours that stand out from the usual colour of cloth.
            sides: (palette.is_needed() && marks.is_none())
                .then(|| triangle_fabrics.iter().map(|fabric| sides[*fabric]).collect()),
            palette,
            snapshot,
            coordinates: coordinates.iter().flatten().copied().collect(),
            shapes: LitShapes::new(&scene).map_err(Failure::from_picture)?,
            marks,
        })
    }

    /// Draws a garment from the front, the side and the back, as one [`Picture`].
    pub(crate) fn draw_garment(&self) -> Result<Picture, Failure> {
        self.draw_sides(&SIDES, None)
    }

    /// Draws a garment from the azimuths in `sides`, in degrees, in one scale. `tints` is a colour
    /// per particle; without it the yarn lines are drawn.
    pub(crate) fn draw_sides(
        &self,
        sides: &[f64],
        tints: Option<&[Colour]>,
    ) -> Result<Picture, Failure> {
        let scene = match tints {
            Some(tints) => self.scene(self.cloth().with_tints(tints)),
            None => self.scene_with_lines(),
        };

        // All views share one scale.
        let [width, height] = UPRIGHT;
        let views: Vec<View> = sides
            .iter()
            .map(|azimuth| View {
                azimuth_deg: *azimuth,
                elevation_deg: ELEVATION,
                width,
                height,
                ..View::default()
            })
            .collect();
        let cameras = View::cameras(&views, &Extent::of(&scene)).map_err(Failure::from_picture)?;
        let pictures: Result<Vec<Picture>, Failure> =
            cameras.iter().map(|camera| self.draw_scene(&scene, camera)).collect();
        let sheet = Picture::sheet(&pictures?, sides.len());

        // Fabrics are not visible under tints, so only yarn lines have a legend.
        Ok(match tints {
            Some(_) => sheet,
            None => {
                let legend = self.legend([sheet.width(), sheet.height()]);
                legend.below(&sheet, Ground::GREY.bottom)
            }
        })
    }

    /// Draws the snapshot with its legend. `view` is an azimuth and an elevation in degrees, where
    /// `None` is the default of [`View`]; `size` is the width and height in pixels.
    pub(crate) fn draw(&self, view: [Option<f64>; 2], size: [u32; 2]) -> Result<Picture, Failure> {
        let ([azimuth, elevation], [width, height]) = (view, size);
        let default = View::default();
        let legend = self.legend(size);
        let view = View {
            azimuth_deg: azimuth.unwrap_or(default.azimuth_deg),
            elevation_deg: elevation.unwrap_or(default.elevation_deg),
            width,
            height: height - legend.height(),
            ..default
        };

        let scene = self.scene_with_lines();
        let picture =
            self.draw_scene(&scene, &view.camera(&scene).map_err(Failure::from_picture)?)?;
        Ok(legend.below(&picture, Ground::GREY.bottom))
    }

    /// Returns the legend of the fabrics for a picture of `size` pixels. The legend is empty if
    /// there is only one fabric.
    fn legend(&self, size: [u32; 2]) -> Swatches {
        let entries = self.palette.legend().filter(|_| self.sides.is_some());
        Swatches::new(entries.map(|(name, colour)| (name.to_owned(), colour)).collect(), size)
    }

    fn cloth(&self) -> Surface<'_> {
        let cloth = Surface::cloth(&self.snapshot.positions, &self.snapshot.triangles);
        Surface { sides: self.sides.as_deref(), ..cloth }
    }

    fn scene_with_lines(&self) -> Scene<'_> {
        let spacing = line_spacing(&self.coordinates);
        self.scene(self.cloth().with_lines(&self.coordinates, spacing))
    }

    fn scene<'s>(&'s self, cloth: Surface<'s>) -> Scene<'s> {
        let mut scene = scene(self.snapshot, cloth);
        scene.cloths.extend(self.marks);
        scene
    }

    fn draw_scene(&self, scene: &Scene<'_>, camera: &Camera) -> Result<Picture, Failure> {
        self.shapes.draw(scene, camera).map_err(Failure::from_picture)
    }
}

/// Returns the distance between yarn lines, in m, for a cloth with the material `coordinates`, in
/// m.
pub(crate) fn line_spacing(coordinates: &[f64]) -> f64 {
    let extent = coordinates.iter().fold(0.0, |size: f64, c| size.max(c.abs()));
    LINE_SPACING * extent.max(0.1)
}

/// Returns the scene of `snapshot`: the surface `cloth`, the bodies, and a floor below them.
fn scene<'a>(snapshot: &'a Snapshot, cloth: Surface<'a>) -> Scene<'a> {
    let Snapshot { positions, bodies, spacing, .. } = snapshot;
    let body_positions = bodies.iter().flat_map(|body| &body.positions[..]);
    let heights = positions.iter().chain(body_positions).skip(1).step_by(3);
    let lowest = heights.copied().fold(f64::INFINITY, f64::min);
    Scene {
        cloths: vec![cloth],
        bodies: bodies.iter().map(|body| Surface::body(&body.positions, &body.triangles)).collect(),
        floor: Some(lowest - FLOOR),
        ground: Ground::GREY,
        body_depth_bias: *spacing,
    }
}
