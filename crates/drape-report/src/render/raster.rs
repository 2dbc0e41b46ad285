//! Rasterizer: horizontal bands of the picture with a depth buffer of samples.

use std::ops::Range;

use super::colour::encode;
use super::screen::{SAMPLES, ScreenFacet};
use super::shade::Shader;

/// Number of rows of pixels that are drawn at a time, which bounds the memory of the samples.
pub(crate) const BAND: usize = 32;

/// Mark of a sample that shows no facet.
const NONE: u32 = u32::MAX;

/// Facet that a pixel shows.
#[derive(Clone, Copy)]
struct Fragment {
    /// Number of the facet on the screen.
    item: u32,
    /// Number of samples that show it.
    count: usize,
    /// Mean position of these samples in the pixel, 0 to 1.
    x: f64,
    y: f64,
}

/// Buffers of the samples of a band.
pub(crate) struct Band {
    /// Number of samples in a row.
    width: usize,
    /// Inverse depth of each sample, in 1/m.
    depths: Vec<f32>,
    /// Facet of each sample.
    items: Vec<u32>,
    /// Facets of one pixel.
    fragments: Vec<Fragment>,
}

impl Band {
    /// Returns the buffers of a band of a picture with some columns of pixels.
    pub(crate) fn new(columns: usize) -> Band {
        let size = columns * BAND * SAMPLES * SAMPLES;
        Band {
            width: columns * SAMPLES,
            depths: vec![0.0; size],
            items: vec![NONE; size],
            fragments: Vec::new(),
        }
    }

    /// Returns the pixels of some rows, three bytes each.
    pub(crate) fn paint(
        &mut self,
        facets: &[ScreenFacet],
        shader: &Shader,
        rows: Range<usize>,
    ) -> Vec<u8> {
        self.resolve_visibility(facets, rows.start * SAMPLES..rows.end * SAMPLES);
        let columns = self.width / SAMPLES;
        let mut pixels = Vec::with_capacity(3 * columns * rows.len());
        for row in 0..rows.len() {
            for column in 0..columns {
                let mut colour = [0.0; 3];
                for &Fragment { item, count, x, y } in self.fragments(row, column) {
                    let share = count as f64 / (SAMPLES * SAMPLES) as f64;
                    let part = if item == NONE {
                        [1.0; 3]
                    } else {
                        let [x, y] = [column as f64 + x, (rows.start + row) as f64 + y];
                        shader.colour(&facets[item as usize], x, y)
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

    /// Finds the facet closest to the camera at each sample of some rows of samples.
    fn resolve_visibility(&mut self, facets: &[ScreenFacet], rows: Range<usize>) {
        self.depths.fill(0.0);
        self.items.fill(NONE);
        for (item, facet) in facets.iter().enumerate() {
            let covered = facet.samples.rows(rows.end);
            let covered = covered.start.max(rows.start)..covered.end;
            if covered.is_empty() {
                continue;
            }
            let depths = facet.biased_depths;
            let width = self.width;
            facet.samples.rasterize(width, covered, |x, y, coordinates| {
                let depth = (0..3).map(|k| coordinates[k] * depths[k]).sum::<f64>() as f32;
                let sample = (y - rows.start) * width + x;
                if depth > self.depths[sample] {
                    self.depths[sample] = depth;
                    self.items[sample] = item as u32;
                }
            });
        }
    }

    /// Returns the facets that a pixel shows.
    fn fragments(&mut self, row: usize, column: usize) -> &[Fragment] {
        self.fragments.clear();
        for j in 0..SAMPLES {
            for i in 0..SAMPLES {
                let item = self.items[(row * SAMPLES + j) * self.width + column * SAMPLES + i];
                let (x, y) = ((i as f64 + 0.5) / SAMPLES as f64, (j as f64 + 0.5) / SAMPLES as f64);
                match self.fragments.iter_mut().find(|fragment| fragment.item == item) {
                    Some(fragment) => {
                        fragment.count += 1;
                        fragment.x += x;
                        fragment.y += y;
                    }
                    None => self.fragments.push(Fragment { item, count: 1, x, y }),
                }
            }
        }
        for fragment in &mut self.fragments {
            fragment.x /= fragment.count as f64;
            fragment.y /= fragment.count as f64;
        }
        &self.fragments
    }
}
