//! Rasterizer: horizontal bands of the picture with a depth buffer of samples.

use std::ops::Range;

use super::screen::{SAMPLES, ScreenFacet};
use super::shade::Shader;
use crate::picture::encode;

/// Number of rows of pixels that are drawn at a time, which bounds the memory of the samples.
pub(crate) const BAND: usize = 16;

/// Mark of a sample that shows no facet.
const NONE: u32 = u32::MAX;

/// Facet that a pixel shows.
#[derive(Clone, Copy)]
struct Fragment {
    /// Number of the facet on the screen.
    item: u32,
    /// Number of samples that show it.
    count: usize,
    x: f64,
    /// Mean vertical position of these samples in the pixel, 0 to 1.
    y: f64,
}

/// Facets on the screen, with the list of facets of each band.
pub(crate) struct Bands {
    facets: Vec<ScreenFacet>,
    /// Numbers of the facets that each band may show.
    of_band: Vec<Vec<u32>>,
}

impl Bands {
    /// Divides `facets` among the bands of a picture with `rows` rows of pixels.
    pub(crate) fn new(facets: Vec<ScreenFacet>, rows: usize) -> Bands {
        let mut of_band = vec![Vec::new(); rows.div_ceil(BAND)];
        for (facet, number) in facets.iter().zip(0..) {
            let Some(samples) = facet.samples() else { continue };
            let covered = samples.rows(rows * SAMPLES);
            if !covered.is_empty() {
                let height = BAND * SAMPLES;
                let bands = covered.start / height..=(covered.end - 1) / height;
                of_band[bands].iter_mut().for_each(|band: &mut Vec<u32>| band.push(number));
            }
        }
        Bands { facets, of_band }
    }
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
    /// Returns the buffers of a band of a picture with `columns` columns of pixels.
    pub(crate) fn new(columns: usize) -> Band {
        let size = columns * BAND * SAMPLES * SAMPLES;
        Band {
            width: columns * SAMPLES,
            depths: vec![0.0; size],
            items: vec![NONE; size],
            fragments: Vec::new(),
        }
    }

    /// Paints the `pixels` of the band `number`, three bytes each.
    pub(crate) fn paint(
        &mut self,
        bands: &Bands,
        shader: &Shader,
        number: usize,
        pixels: &mut [u8],
    ) {
        let columns = self.width / SAMPLES;
        let top = number * BAND;
        let rows = pixels.len() / (3 * columns);
        self.resolve_visibility(bands, number, top * SAMPLES..(top + rows) * SAMPLES);
        for (row, line) in pixels.chunks_exact_mut(3 * columns).enumerate() {
            for (column, pixel) in line.as_chunks_mut::<3>().0.iter_mut().enumerate() {
                let mut colour = [0.0; 3];
                for &Fragment { item, count, x, y } in self.fragments(row, column) {
                    let share = count as f64 / (SAMPLES * SAMPLES) as f64;
                    let at = [column as f64 + x, (top + row) as f64 + y];
                    let part = match item {
                        NONE => shader.ground(at),
                        _ => shader.colour(&bands.facets[item as usize], at),
                    };
                    for k in 0..3 {
                        colour[k] += share * part[k];
                    }
                }
                *pixel = colour.map(encode);
            }
        }
    }

    /// Finds the facet closest to the camera at each sample of `rows` of samples of the band
    /// `number`.
    fn resolve_visibility(&mut self, bands: &Bands, number: usize, rows: Range<usize>) {
        self.depths.fill(0.0);
        self.items.fill(NONE);
        let width = self.width;

        for &item in &bands.of_band[number] {
            let facet = &bands.facets[item as usize];
            let Some(samples) = facet.samples() else { continue };
            let covered = samples.rows(rows.end);
            let depths = facet.biased_depths();
            let slope = samples.slope(depths) as f32;
            samples.spans(width, covered.start.max(rows.start)..covered.end, |span| {
                let start = span.start(depths) as f32;
                let first = (span.row - rows.start) * width;
                let range = first + span.columns.start..first + span.columns.end;
                let (depths, holders) = (&mut self.depths[range.clone()], &mut self.items[range]);
                // A counter of 32 bits can be converted for several samples at a time.
                for (offset, (depth, holder)) in (0_i32..).zip(depths.iter_mut().zip(holders)) {
                    let inverse_depth = start + offset as f32 * slope;
                    let is_closer = inverse_depth > *depth;
                    *depth = if is_closer { inverse_depth } else { *depth };
                    *holder = if is_closer { item } else { *holder };
                }
            });
        }
    }

    /// Returns the facets that the pixel at `row` and `column` of the band shows.
    fn fragments(&mut self, row: usize, column: usize) -> &[Fragment] {
        self.fragments.clear();
        let line = |j: usize| {
            let first = (row * SAMPLES + j) * self.width + column * SAMPLES;
            &self.items[first..first + SAMPLES]
        };

        // Most pixels show a single facet.
        let item = line(0)[0];
        if (0..SAMPLES).all(|j| line(j) == [item; SAMPLES]) {
            self.fragments.push(Fragment { item, count: SAMPLES * SAMPLES, x: 0.5, y: 0.5 });
            return &self.fragments;
        }

        for j in 0..SAMPLES {
            for (i, &item) in line(j).iter().enumerate() {
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
