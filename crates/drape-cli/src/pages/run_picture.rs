//! Pictures of the stored frames of a run: from several sides, with a colour map, all in one scale.

use drape::export::{FabricPalette, Field, Fields};
use drape::frames::{Frame, Recording};
use drape::input::figure_in_range;
use drape::render::{
    Camera, Colour, ColourScale, Extent, Ground, Legend, LitShapes, Picture, Scene, Surface,
    Swatches, View,
};

use super::picture::{FLOOR, line_spacing};
use crate::failure::Failure;

/// A body with at most this number of triangles is an infinite plane. The plane is not drawn,
/// because the floor of the picture is.
const PLANE_TRIANGLES_MAX: usize = 2;

/// Direction of a view: azimuth and elevation of the camera, in degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Direction {
    pub(crate) azimuth: f64,
    pub(crate) elevation: f64,
}

/// Content and style of pictures.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PictureSettings {
    /// Directions of the views, from the left to the right.
    pub(crate) views: Vec<Direction>,
    /// Number of views side by side.
    pub(crate) columns: u32,
    /// Width and height of a picture with all its columns, in pixels.
    pub(crate) size: [u32; 2],
    /// Field that is shown as a colour map.
    pub(crate) map: Option<Field>,
    /// Range of the map, in the unit of the field. `None` takes the range of the values.
    pub(crate) range: Option<[f64; 2]>,
    /// Colours of the front and the back of the cloth. `None` takes the default colours.
    pub(crate) colours: Option<[Colour; 2]>,
    /// Whether bodies are drawn.
    pub(crate) bodies: bool,
}

/// Least width of a view, in pixels.
pub(crate) const WIDTH_MIN: u32 = 64;

impl PictureSettings {
    /// Refuses views narrower than [`WIDTH_MIN`]. `within` names the picture in the message.
    pub(crate) fn check(&self, within: &str) -> Result<(), Failure> {
        let PictureSettings { size: [width, height], columns, .. } = *self;
        if width / columns.max(1) >= WIDTH_MIN {
            return Ok(());
        }
        Err(Failure::Usage(format!(
            "--size: {width}x{height} pixels for {columns} views of {within} leave less than {WIDTH_MIN} for each; give a larger width"
        )))
    }
}

/// Legend of a picture: the scale of the map, or without a map the colours of several fabrics.
#[derive(Debug, Clone)]
pub(crate) struct RunLegend {
    map: Option<Legend>,
    fabrics: Swatches,
}

impl RunLegend {
    /// Returns `picture` with this legend below it.
    pub(crate) fn below(&self, picture: Picture) -> Picture {
        match &self.map {
            Some(legend) => legend.below(&picture, Ground::GREY.bottom),
            None => self.fabrics.below(&picture, Ground::GREY.bottom),
        }
    }
}

/// Pictures of frames of a run, with common cameras and a common colour scale.
pub(crate) struct RunPictures<'a> {
    recording: &'a Recording,
    settings: &'a PictureSettings,
    fields: Fields<'a>,
    legend: RunLegend,
    /// Colours of the front and the back of each triangle, if the garment has several fabrics.
    sides: Option<Vec<[Colour; 2]>>,
    cameras: Vec<Camera>,
    /// Shortest edge of the cloth at rest, in m.
    spacing: f64,
    /// Material coordinates, two per particle, in m.
    coordinates: Vec<f64>,
}

/// Shapes and map values of one frame.
struct FrameShapes {
    positions: Vec<f64>,
    /// Vertices, three coordinates each in m, and triangles of each body that is drawn.
    bodies: Vec<(Vec<f64>, Vec<[u32; 3]>)>,
    /// Height of the floor, in m.
    floor: f64,
    /// Value of the map at each particle.
    values: Option<Vec<f64>>,
}

impl<'a> RunPictures<'a> {
    /// Prepares the pictures of the frames `numbers` of `recording`. All frames are read once, for
    /// the extent of the views and the range of the map.
    pub(crate) fn new(
        recording: &'a Recording,
        settings: &'a PictureSettings,
        numbers: &[usize],
    ) -> Result<RunPictures<'a>, Failure> {
        let topology = recording.topology();
        let palette = FabricPalette::of_runs([recording]);
        let has_fabrics =
            palette.is_needed() && settings.map.is_none() && settings.colours.is_none();
        let fabrics = palette.legend().filter(|_| has_fabrics);
        let entries = fabrics.map(|(name, colour)| (name.to_owned(), colour)).collect();
        let mut pictures = RunPictures {
            recording,
            settings,
            fields: Fields::new(recording),
            legend: RunLegend { map: None, fabrics: Swatches::new(entries, settings.size) },
            sides: has_fabrics.then(|| sides(recording, &palette)),
            cameras: Vec::new(),
            spacing: spacing(recording),
            coordinates: topology.material.iter().flatten().copied().collect(),
        };

        let (mut extent, mut values) = (Extent::default(), Vec::new());
        let mut numbers = numbers.to_vec();
        numbers.dedup();
        for number in &numbers {
            let mut shapes = pictures.shapes(&recording.frame(*number)?)?;
            values.extend(shapes.values.take());
            extent = extent.with(&pictures.scene(&shapes, None));
            if let ([_], [direction]) = (&numbers[..], &settings.views[..]) {
                // A single view of a single frame fills the picture.
                let view = pictures.view(*direction, 0);
                let camera = view.camera(&pictures.scene(&shapes, None));
                pictures.cameras = vec![camera.map_err(Failure::from_picture)?];
            }
        }
        if pictures.cameras.is_empty() {
            let views: Vec<View> = settings
                .views
                .iter()
                .zip(0..)
                .map(|(direction, index)| pictures.view(*direction, index))
                .collect();
            pictures.cameras = View::cameras(&views, &extent).map_err(Failure::from_picture)?;
        }

        if let Some(field) = settings.map {
            let range = settings.range.unwrap_or_else(|| field.range(&values));
            let scale =
                ColourScale::new(range, field.is_signed()).map_err(Failure::from_picture)?;
            let (name, unit) = (field.label().to_owned(), field.unit().to_owned());
            let [low, high] = range;
            let labels = [low, 0.5 * (low + high), high];
            let labels = labels.map(|value| figure_in_range(value, high - low));
            pictures.legend.map = Some(Legend { name, unit, scale, labels });
        }
        Ok(pictures)
    }

    /// Draws frame `number` from all sides, with its legend.
    pub(crate) fn draw(&mut self, number: usize) -> Result<Picture, Failure> {
        let views = self.draw_views(number)?;
        Ok(self.legend().below(views))
    }

    /// Draws frame `number` from all sides, without a legend.
    pub(crate) fn draw_views(&mut self, number: usize) -> Result<Picture, Failure> {
        let mut views = Vec::new();
        self.draw_each(number, |picture| {
            views.push(picture);
            Ok(())
        })?;
        Ok(Picture::sheet(&views, views.len()))
    }

    /// Draws frame `number` from one side after the other. Each picture is passed to `take` without
    /// a legend.
    pub(crate) fn draw_each(
        &mut self,
        number: usize,
        mut take: impl FnMut(Picture) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let frame_shapes = self.shapes(&self.recording.frame(number)?)?;
        let tints: Option<Vec<Colour>> = match (&frame_shapes.values, &self.legend.map) {
            (Some(values), Some(Legend { scale, .. })) => {
                Some(values.iter().map(|value| scale.colour(*value)).collect())
            }
            _ => None,
        };
        let scene = self.scene(&frame_shapes, tints.as_deref());
        let lit_shapes = LitShapes::new(&scene).map_err(Failure::from_picture)?;
        self.cameras.iter().try_for_each(|camera| {
            take(lit_shapes.draw(&scene, camera).map_err(Failure::from_picture)?)
        })
    }

    /// Returns the legend of the pictures.
    pub(crate) fn legend(&self) -> RunLegend {
        self.legend.clone()
    }

    /// Returns the time of frame `number` as a caption.
    pub(crate) fn caption(&self, number: usize) -> Result<String, Failure> {
        Ok(format!("{:.2} s", self.recording.time(number)?))
    }

    /// Returns the view in `direction` at position `index` of the views. The widths of all columns
    /// sum to the width of the picture.
    fn view(&self, direction: Direction, index: u32) -> View {
        let ([width, height], count) = (self.settings.size, self.settings.columns.max(1));
        let fabrics_height = self.legend.fabrics.height();
        let legend_height = self.settings.map.map_or(fabrics_height, |_| Legend::height(height));
        let column = index % count;
        let [left, right] = [column, column + 1]
            .map(|column| u64::from(width) * u64::from(column) / u64::from(count));
        View {
            azimuth_deg: direction.azimuth,
            elevation_deg: direction.elevation,
            width: (right - left) as u32,
            height: height.saturating_sub(legend_height),
            ..View::default()
        }
    }

    /// Returns the shapes of `frame`, with the values of the map.
    fn shapes(&mut self, frame: &Frame) -> Result<FrameShapes, Failure> {
        let values = self.settings.map.map(|field| self.values(field, frame)).transpose()?;
        let mut bodies = Vec::new();
        let mut triangles = self.recording.topology().bodies.iter();
        let (mut first, mut lowest) = (0, f64::INFINITY);
        for part in &self.recording.manifest().bodies {
            // The recording numbers the vertices of all bodies in one sequence.
            let part_triangles = triangles
                .by_ref()
                .take(part.triangles)
                .map(|corners| corners.map(|corner| corner - first as u32))
                .collect();
            let positions = frame.bodies[first..first + part.vertices].as_flattened();
            first += part.vertices;
            if part.triangles > PLANE_TRIANGLES_MAX {
                lowest = positions.iter().skip(1).step_by(3).copied().fold(lowest, f64::min);
                bodies.push((positions.to_vec(), part_triangles));
            }
        }

        // The floor lies below the bodies even where these are not drawn.
        let positions = frame.cloth.as_flattened().to_vec();
        lowest = positions.iter().skip(1).step_by(3).copied().fold(lowest, f64::min);
        if !self.settings.bodies {
            bodies.clear();
        }
        Ok(FrameShapes { positions, bodies, floor: lowest - FLOOR, values })
    }

    /// Returns the values of `field` at `frame`. Errors name the fields that the run has.
    fn values(&mut self, field: Field, frame: &Frame) -> Result<Vec<f64>, Failure> {
        let earlier = frame.number.checked_sub(1).map(|number| self.recording.frame(number));
        let earlier = earlier.transpose()?;
        if let Some(values) = self.fields.values(field, frame, earlier.as_ref()) {
            return Ok(values);
        }

        Err(Failure::Usage(if self.fields.has(field) {
            format!(
                "--map {}: the run has it, but not at frame {}; draw another frame",
                field.key(),
                frame.number
            )
        } else {
            let known = Field::ALL.iter().filter(|field| self.fields.has(**field));
            let known: Vec<&str> = known.map(|field| field.key()).collect();
            format!("--map {}: the run has none; it has {}", field.key(), known.join(", "))
        }))
    }

    /// Returns the scene of `shapes`. `tints` is a colour per particle; without it the yarn lines
    /// are drawn.
    fn scene<'s>(&'s self, shapes: &'s FrameShapes, tints: Option<&'s [Colour]>) -> Scene<'s> {
        let mut cloth = Surface::cloth(&shapes.positions, &self.recording.topology().cloth);
        cloth = match tints {
            Some(tints) => cloth.with_tints(tints),
            None => cloth.with_lines(&self.coordinates, line_spacing(&self.coordinates)),
        };
        cloth.sides = self.sides.as_deref();
        if let Some([front, back]) = self.settings.colours {
            cloth = Surface { front, back, ..cloth };
        }

        let bodies = shapes.bodies.iter();
        Scene {
            cloths: vec![cloth],
            bodies: bodies
                .map(|(positions, triangles)| Surface::body(positions, triangles))
                .collect(),
            floor: Some(shapes.floor),
            ground: Ground::GREY,
            body_depth_bias: self.spacing.min(1.0),
        }
    }
}

/// Returns the colours of the front and the back of each triangle of the cloth, from the `palette`.
fn sides(recording: &Recording, palette: &FabricPalette) -> Vec<[Colour; 2]> {
    let panels = recording.manifest().panels.iter();
    panels.flat_map(|panel| vec![palette.sides(&panel.fabric); panel.triangles]).collect()
}

/// Returns the shortest edge of the cloth of `recording` at rest, in m.
fn spacing(recording: &Recording) -> f64 {
    let topology = recording.topology();
    let edges = topology.cloth.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let lengths = edges.map(|ends| {
        let [a, b] = ends.map(|end| topology.material[end as usize]);
        (a[0] - b[0]).hypot(a[1] - b[1])
    });
    lengths.fold(f64::INFINITY, f64::min)
}
