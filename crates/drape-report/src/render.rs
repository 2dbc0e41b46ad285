use crate::camera::Camera;
use crate::error::ReportError;
use crate::facets::{Facet, Part, Stage};
use crate::picture::Picture;
use crate::scene::Scene;
use crate::shade::{Shader, encode};
use crate::triangle::Flat;
use crate::view::View;
use rayon::prelude::*;

/// Samples along each side of a pixel.
///
/// Sixteen samples a pixel give edges sixteen steps, about what the eye tells apart; colours are
/// found only once per pixel and facet.
const SAMPLES: usize = 4;

/// Rows of pixels that are drawn at a time, which bounds the memory for samples.
const BAND: usize = 32;

/// Mark of a sample that shows nothing.
const NOTHING: u32 = u32::MAX;

/// A facet on the screen.
pub(crate) struct Projected<'a> {
    pub(crate) facet: &'a Facet,
    pub(crate) index: usize,
    /// In pixels.
    pub(crate) flat: Flat,
    /// In samples.
    fine: Flat,
    /// Inverse depths of the corners, in 1/m.
    pub(crate) nearness: [f64; 3],
    /// The same, as used to decide what hides what.
    order: [f64; 3],
}

/// Draws a scene.
///
/// Cloth is lit from both sides by an even sky and one main light with soft shadows; its front and
/// its back, its warp lines (blue), its weft lines (red) and its hem differ in colour. The same
/// input gives the same bytes, with any number of threads.
///
/// The rasteriser is of this crate's own making: no maintained one that works without a graphics
/// card was to be found.
pub fn render(scene: &Scene, view: &View) -> Result<Picture, ReportError> {
    let camera = view.camera(scene)?;
    let stage = Stage::new(scene, view.body_setback);
    let shader = Shader::new(scene, &stage, &camera, view);
    let places = 0..stage.facets.len();
    let projected: Vec<Projected> =
        places.filter_map(|index| project(&stage, index, &camera)).collect();

    let height = view.height as usize;
    let tops: Vec<usize> = (0..height).step_by(BAND).collect();
    let bands: Vec<Vec<u8>> = tops
        .into_par_iter()
        .map_init(
            || Band::new(view.width as usize),
            |band, top| band.paint(&projected, &shader, (top, BAND.min(height - top))),
        )
        .collect();
    Ok(Picture::new(view.width, view.height, bands.concat()))
}

fn project<'a>(stage: &'a Stage, index: usize, camera: &Camera) -> Option<Projected<'a>> {
    let facet = &stage.facets[index];
    let places = facet.corners.map(|corner| camera.project(corner.position));
    // The eye is outside of everything that matters; what is behind it is left out whole.
    if places.iter().any(|place| place[2] <= 1e-6) {
        return None;
    }
    if facet.part == Part::Floor && camera.eye()[1] < facet.corners[0].position[1] {
        // From below the floor would hide all.
        return None;
    }
    let setback = stage.setback(facet.part);
    Some(Projected {
        facet,
        index,
        flat: Flat::new(places.map(|[x, y, _]| [x, y]))?,
        fine: Flat::new(places.map(|[x, y, _]| [x * SAMPLES as f64, y * SAMPLES as f64]))?,
        nearness: places.map(|[_, _, depth]| 1.0 / depth),
        order: places.map(|[_, _, depth]| 1.0 / (depth + setback)),
    })
}

/// What one pixel shows: facet, number of samples, and their mean place in the pixel.
type Seen = (u32, usize, f64, f64);

/// The samples of some rows.
struct Band {
    /// Samples in a row.
    width: usize,
    nearness: Vec<f32>,
    items: Vec<u32>,
    seen: Vec<Seen>,
}

impl Band {
    fn new(columns: usize) -> Band {
        let size = columns * BAND * SAMPLES * SAMPLES;
        Band {
            width: columns * SAMPLES,
            nearness: vec![0.0; size],
            items: vec![NOTHING; size],
            seen: Vec::new(),
        }
    }

    /// The pixels of some rows, from the top row on.
    fn paint(
        &mut self,
        projected: &[Projected],
        shader: &Shader,
        (top, rows): (usize, usize),
    ) -> Vec<u8> {
        self.draw(projected, (top * SAMPLES, rows * SAMPLES));
        let columns = self.width / SAMPLES;
        let mut pixels = Vec::with_capacity(3 * columns * rows);
        for row in 0..rows {
            for column in 0..columns {
                let mut colour = [0.0; 3];
                for &(item, count, x, y) in self.seen(row, column) {
                    let share = count as f64 / (SAMPLES * SAMPLES) as f64;
                    let part = if item == NOTHING {
                        [1.0; 3]
                    } else {
                        let [x, y] = [column as f64 + x, (top + row) as f64 + y];
                        shader.colour(&projected[item as usize], x, y)
                    };
                    for k in 0..3 {
                        colour[k] += share * part[k];
                    }
                }
                pixels.extend(colour.map(encode));
            }
        }
        pixels
    }

    /// Finds the nearest facet of each sample of some rows of samples, from the top row on.
    fn draw(&mut self, projected: &[Projected], (top, rows): (usize, usize)) {
        self.nearness.fill(0.0);
        self.items.fill(NOTHING);
        for (item, facet) in projected.iter().enumerate() {
            let (first, last) = facet.fine.rows(top + rows);
            let first = first.max(top);
            if first >= last {
                continue;
            }
            let order = facet.order;
            let width = self.width;
            facet.fine.cover_rows(width, (first, last), |x, y, shares| {
                let near = (0..3).map(|k| shares[k] * order[k]).sum::<f64>() as f32;
                let cell = (y - top) * width + x;
                if near > self.nearness[cell] {
                    self.nearness[cell] = near;
                    self.items[cell] = item as u32;
                }
            });
        }
    }

    fn seen(&mut self, row: usize, column: usize) -> &[Seen] {
        self.seen.clear();
        for j in 0..SAMPLES {
            for i in 0..SAMPLES {
                let item = self.items[(row * SAMPLES + j) * self.width + column * SAMPLES + i];
                let (x, y) = ((i as f64 + 0.5) / SAMPLES as f64, (j as f64 + 0.5) / SAMPLES as f64);
                match self.seen.iter_mut().find(|seen| seen.0 == item) {
                    Some((_, count, sum_x, sum_y)) => {
                        *count += 1;
                        *sum_x += x;
                        *sum_y += y;
                    }
                    None => self.seen.push((item, 1, x, y)),
                }
            }
        }
        for (_, count, x, y) in &mut self.seen {
            *x /= *count as f64;
            *y /= *count as f64;
        }
        &self.seen
    }
}
