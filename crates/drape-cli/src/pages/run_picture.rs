//! Pictures of the stored frames of a run: from several sides, with a colour map, all in one scale.

use drape::export::{FabricPalette, Field, Fields};
use drape::frames::{Frame, Recording, SurfacePart};
use drape::report::{
    Camera, Colour, ColourScale, Extent, Ground, Legend, LitShapes, Picture, Scene, Surface,
    Swatches, View,
};

use super::picture::{FLOOR, line_spacing};
use crate::failure::Failure;

/// Largest number of triangles of a plane, which has no end and is not drawn: the floor is.
const PLANE: usize = 2;

/// Direction of a view: azimuth and elevation of the camera, in degrees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Direction {
    pub(crate) azimuth: f64,
    pub(crate) elevation: f64,
}

/// What pictures show, and how.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Look {
    /// Directions, from the left to the right.
    pub(crate) views: Vec<Direction>,
    /// Number of views that are side by side.
    pub(crate) columns: u32,
    /// Width and height of a picture with them, in pixels.
    pub(crate) size: [u32; 2],
    /// Field that is mapped.
    pub(crate) map: Option<Field>,
    /// Range of the map.
    pub(crate) range: Option<[f64; 2]>,
    /// Colours of the front and the back of the cloth; without them those of pictures of runs.
    pub(crate) colours: Option<[Colour; 2]>,
    /// Whether bodies are drawn.
    pub(crate) bodies: bool,
}

/// Least width of a view, in pixels.
pub(crate) const WIDTH_MIN: u32 = 64;

impl Look {
    /// Refuses views below the least width; `within` says in words what they are views of.
    pub(crate) fn check(&self, within: &str) -> Result<(), Failure> {
        let Look { size: [width, height], columns, .. } = *self;
        if width / columns.max(1) >= WIDTH_MIN {
            return Ok(());
        }
        Err(Failure::Usage(format!(
            "--size: {width}x{height} pixels for {columns} views of {within} leave less than {WIDTH_MIN} for each; give a larger width"
        )))
    }
}

/// Legend of the map, or of the fabrics where there are several and no map.
#[derive(Debug, Clone)]
pub(crate) struct RunLegend {
    map: Option<Legend>,
    fabrics: Swatches,
}

impl RunLegend {
    /// Returns a picture with the legend below it.
    pub(crate) fn below(&self, picture: Picture) -> Picture {
        match &self.map {
            Some(legend) => legend.below(&picture, Ground::GREY.bottom),
            None => self.fabrics.below(&picture, Ground::GREY.bottom),
        }
    }
}

/// Pictures of frames of a run, which share their cameras and their scale of colours.
pub(crate) struct RunPictures<'a> {
    recording: &'a Recording,
    look: &'a Look,
    fields: Fields<'a>,
    legend: RunLegend,
    /// Colours of the front and the back of each triangle, where fabrics have their own.
    sides: Option<Vec<[Colour; 2]>>,
    cameras: Vec<Camera>,
    /// Smallest distance of particles at rest, in m.
    spacing: f64,
    /// Material coordinates, two per particle, in m.
    coordinates: Vec<f64>,
}

/// Shapes of a frame.
struct Shown {
    positions: Vec<f64>,
    bodies: Vec<(Vec<f64>, Vec<[u32; 3]>)>,
    /// Height of the floor, in m.
    floor: f64,
    values: Option<Vec<f64>>,
}

impl<'a> RunPictures<'a> {
    /// Prepares the pictures of some frames.
    pub(crate) fn new(
        recording: &'a Recording,
        look: &'a Look,
        numbers: &[usize],
    ) -> Result<RunPictures<'a>, Failure> {
        let topology = recording.topology();
        let palette = FabricPalette::of_runs([recording]);
        let has_fabrics = palette.is_needed() && look.map.is_none() && look.colours.is_none();
        let shown = palette.legend().filter(|_| has_fabrics);
        let entries = shown.map(|(name, colour)| (name.to_owned(), colour)).collect();
        let mut pictures = RunPictures {
            recording,
            look,
            fields: Fields::new(recording),
            legend: RunLegend { map: None, fabrics: Swatches::new(entries, look.size) },
            sides: has_fabrics.then(|| sides(recording, &palette)),
            cameras: Vec::new(),
            spacing: spacing(recording),
            coordinates: topology.material.iter().flatten().copied().collect(),
        };
        let (mut extent, mut values) = (Extent::default(), Vec::new());
        let mut numbers = numbers.to_vec();
        numbers.dedup();
        for number in &numbers {
            let mut shown = pictures.shown(&recording.frame(*number)?)?;
            values.extend(shown.values.take());
            extent = extent.with(&pictures.scene(&shown, None));
            if let ([_], [direction]) = (&numbers[..], &look.views[..]) {
                // Alone, the picture is filled.
                let view = pictures.view(*direction, 0);
                let camera = view.camera(&pictures.scene(&shown, None));
                pictures.cameras = vec![camera.map_err(Failure::of_picture)?];
            }
        }
        if pictures.cameras.is_empty() {
            let views = look.views.iter().zip(0..);
            let views: Vec<View> = views.map(|(view, k)| pictures.view(*view, k)).collect();
            pictures.cameras = View::cameras(&views, &extent).map_err(Failure::of_picture)?;
        }
        if let Some(field) = look.map {
            let range = look.range.unwrap_or_else(|| field.range(&values));
            let scale = ColourScale::new(range, field.is_signed()).map_err(Failure::of_picture)?;
            let (name, unit) = (field.label().to_owned(), field.unit().to_owned());
            pictures.legend.map = Some(Legend { name, unit, scale });
        }
        Ok(pictures)
    }

    /// Draws a frame from all sides, with its legend.
    pub(crate) fn draw(&mut self, number: usize) -> Result<Picture, Failure> {
        let views = self.draw_views(number)?;
        Ok(self.legend().below(views))
    }

    /// Draws a frame from all sides, without a legend.
    pub(crate) fn draw_views(&mut self, number: usize) -> Result<Picture, Failure> {
        let mut views = Vec::new();
        self.draw_each(number, |picture| {
            views.push(picture);
            Ok(())
        })?;
        Ok(Picture::sheet(&views, views.len()))
    }

    /// Draws a frame from one side after the other; each picture is handed on without its legend.
    pub(crate) fn draw_each(
        &mut self,
        number: usize,
        mut take: impl FnMut(Picture) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let shown = self.shown(&self.recording.frame(number)?)?;
        let tints: Option<Vec<Colour>> = match (&shown.values, &self.legend.map) {
            (Some(values), Some(Legend { scale, .. })) => {
                Some(values.iter().map(|value| scale.colour(*value)).collect())
            }
            _ => None,
        };
        let scene = self.scene(&shown, tints.as_deref());
        let shapes = LitShapes::new(&scene).map_err(Failure::of_picture)?;
        self.cameras
            .iter()
            .try_for_each(|camera| take(shapes.draw(&scene, camera).map_err(Failure::of_picture)?))
    }

    /// Returns the legend of the pictures.
    pub(crate) fn legend(&self) -> RunLegend {
        self.legend.clone()
    }

    /// Returns the time of a frame as a caption.
    pub(crate) fn caption(&self, number: usize) -> Result<String, Failure> {
        let time = self.recording.read_time(number)?;
        Ok(time.map_or_else(|| format!("frame {number}"), |time| format!("{time:.2} s")))
    }

    /// Returns a view with its place among those side by side.
    fn view(&self, direction: Direction, place: u32) -> View {
        let ([width, height], count) = (self.look.size, self.look.columns.max(1));
        let place = place % count;
        let of_fabrics = self.legend.fabrics.height();
        let legend = self.look.map.map_or(of_fabrics, |_| Legend::height(height));
        let end = |place: u32| u64::from(width) * u64::from(place) / u64::from(count);
        View {
            azimuth_deg: direction.azimuth,
            elevation_deg: direction.elevation,
            width: (end(place + 1) - end(place)) as u32,
            height: height.saturating_sub(legend),
            ..View::default()
        }
    }

    /// Returns the shapes of a frame, with the values of the map.
    fn shown(&mut self, frame: &Frame) -> Result<Shown, Failure> {
        let values = self.look.map.map(|field| self.values(field, frame)).transpose()?;
        let mut bodies = Vec::new();
        let mut triangles = self.recording.topology().bodies.iter();
        let (mut first, mut lowest) = (0, f64::INFINITY);
        for part in &self.recording.manifest().bodies {
            let own = triangles.by_ref().take(part.triangles);
            let own = own.map(|corners| corners.map(|corner| corner - first as u32)).collect();
            let positions = frame.bodies[first..first + part.vertices].as_flattened();
            first += part.vertices;
            if part.triangles > PLANE {
                lowest = positions.iter().skip(1).step_by(3).copied().fold(lowest, f64::min);
                bodies.push((positions.to_vec(), own));
            }
        }
        let positions = frame.cloth.as_flattened().to_vec();
        lowest = positions.iter().skip(1).step_by(3).copied().fold(lowest, f64::min);
        if !self.look.bodies {
            bodies.clear();
        }
        Ok(Shown { positions, bodies, floor: lowest - FLOOR, values })
    }

    /// Returns the values of a field at a frame.
    fn values(&mut self, field: Field, frame: &Frame) -> Result<Vec<f64>, Failure> {
        let before = frame.number.checked_sub(1).map(|number| self.recording.frame(number));
        let before = before.transpose()?;
        if let Some(values) = self.fields.values(field, frame, before.as_ref()) {
            return Ok(values);
        }
        let known = |field: &&Field| self.fields.has(**field);
        Err(Failure::Usage(match self.fields.has(field) {
            true => format!(
                "--map {}: the run has it, but not at frame {}; draw another frame",
                field.key(),
                frame.number
            ),
            false => {
                let known = Field::ALL.iter().filter(known).map(|field| field.key());
                let known: Vec<&str> = known.collect();
                format!("--map {}: the run has none; it has {}", field.key(), known.join(", "))
            }
        }))
    }

    /// Returns the scene of shapes, with yarn lines or in a colour per particle.
    fn scene<'s>(&'s self, shown: &'s Shown, tints: Option<&'s [Colour]>) -> Scene<'s> {
        let mut cloth = Surface::cloth(&shown.positions, &self.recording.topology().cloth);
        cloth = match tints {
            Some(tints) => cloth.with_tints(tints),
            None => cloth.with_lines(&self.coordinates, line_spacing(&self.coordinates)),
        };
        cloth.sides = self.sides.as_deref();
        if let Some([front, back]) = self.look.colours {
            cloth = Surface { front, back, ..cloth };
        }
        let body = |(positions, triangles): &'s (Vec<f64>, Vec<[u32; 3]>)| {
            Surface::body(positions, triangles)
        };
        Scene {
            cloths: vec![cloth],
            bodies: shown.bodies.iter().map(body).collect(),
            floor: Some(shown.floor),
            ground: Ground::GREY,
            body_depth_bias: self.spacing.min(1.0),
        }
    }
}

/// Returns the colours of the front and the back of each triangle of the cloth.
fn sides(recording: &Recording, palette: &FabricPalette) -> Vec<[Colour; 2]> {
    let panels = recording.manifest().panels.iter();
    let of_panel = |panel: &SurfacePart| vec![palette.sides(&panel.fabric); panel.triangles];
    panels.flat_map(of_panel).collect()
}

/// Returns the shortest edge of the cloth at rest, in m.
fn spacing(recording: &Recording) -> f64 {
    let topology = recording.topology();
    let edges = topology.cloth.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]);
    let length = |ends: [u32; 2]| {
        let [a, b] = ends.map(|end| topology.material[end as usize]);
        (a[0] - b[0]).hypot(a[1] - b[1])
    };
    edges.map(length).fold(f64::INFINITY, f64::min)
}
