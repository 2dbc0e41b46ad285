//! Pixels: a picture in sRGB, and its PNG file.

use std::path::Path;

use crate::error::Error;
use crate::picture::Colour;

/// Largest width and largest height, in pixels, of a picture that the reader accepts.
const SIDE_MAX: u32 = 8192;

/// Picture: rows of pixels from the top, in sRGB.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

impl Picture {
    /// Returns the picture of a `size`, width and height, with `pixels` of three bytes each, row by
    /// row from the top.
    ///
    /// ```
    /// use drape_render::Picture;
    ///
    /// let grey = Picture::from_pixels([4, 2], vec![128; 24])?;
    /// assert_eq!(grey.pixel(3, 1), Some([128; 3]));
    /// assert!(Picture::from_pixels([4, 2], vec![128; 23]).is_err());
    /// # Ok::<(), drape_render::Error>(())
    /// ```
    ///
    /// # Errors
    /// The number of bytes does not fit the `size`.
    pub fn from_pixels(size: [u32; 2], pixels: Vec<u8>) -> Result<Picture, Error> {
        let [width, height] = size;
        let needed = u64::from(width).checked_mul(u64::from(height)).and_then(|n| n.checked_mul(3));
        if needed != Some(pixels.len() as u64) {
            return Err(Error::BadPixels { size, bytes: pixels.len() });
        }
        Ok(Picture { width, height, pixels })
    }

    /// Returns a picture of `pixels`, whose number fits `width` and `height`.
    pub(crate) fn new(width: u32, height: u32, pixels: Vec<u8>) -> Picture {
        Picture { width, height, pixels }
    }

    /// Returns `pictures` side by side on white, in rows of `columns` columns. Each column is as
    /// wide as its widest picture, and each row is as high as its highest picture.
    #[must_use]
    pub fn sheet(pictures: &[Picture], columns: usize) -> Picture {
        let columns = columns.clamp(1, pictures.len().max(1));
        let rows = pictures.len().div_ceil(columns);
        let (mut widths, mut heights) = (vec![0; columns], vec![0; rows]);

        for (number, picture) in pictures.iter().enumerate() {
            let (column, row) = (&mut widths[number % columns], &mut heights[number / columns]);
            *column = picture.width.max(*column);
            *row = picture.height.max(*row);
        }

        let [width, height] = [&widths, &heights].map(|sizes| sizes.iter().sum::<u32>());
        let mut pixels = vec![u8::MAX; 3 * width as usize * height as usize];
        for (number, picture) in pictures.iter().enumerate() {
            let left: u32 = widths[..number % columns].iter().sum();
            let top: u32 = heights[..number / columns].iter().sum();
            let lines = picture.pixels.chunks(3 * picture.width.max(1) as usize);
            for (line, data) in lines.enumerate() {
                let start = 3 * ((top as usize + line) * width as usize + left as usize);
                pixels[start..start + data.len()].copy_from_slice(data);
            }
        }
        Picture { width, height, pixels }
    }

    /// Returns the `width`, in pixels.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Returns the `height`, in pixels.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns the `pixels`, three bytes each, row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// Returns the pixel in column `x` and row `y`, counted from the top left. Returns `None`
    /// outside the picture.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<Colour> {
        let (pixels, _) = self.pixels.as_chunks::<3>();
        let row = pixels.chunks(self.width as usize).nth(y as usize)?;
        row.get(x as usize).copied()
    }

    /// Returns the pixel in column `x` and row `y` mutably. Returns `None` outside the picture.
    pub(crate) fn pixel_mut(&mut self, x: u32, y: u32) -> Option<&mut Colour> {
        let (width, pixels) = (self.width, self.pixels.as_chunks_mut::<3>().0);
        let is_inside = x < width && y < self.height;
        is_inside.then(|| &mut pixels[y as usize * width as usize + x as usize])
    }

    /// Returns the picture with further `rows` below, filled with a `colour`.
    pub(crate) fn extended(&self, rows: u32, colour: Colour) -> Picture {
        let added = self.width as usize * rows as usize;
        let pixels = [&self.pixels[..], &colour.repeat(added)].concat();
        Picture { width: self.width, height: self.height + rows, pixels }
    }

    /// Returns the smallest rectangle that contains all differences from `other`, a picture of
    /// equal size: the column and the row of its corner, its width and its height.
    pub(crate) fn difference(&self, other: &Picture) -> Option<[u32; 4]> {
        let [pixels, other_pixels] = [self, other].map(|picture| picture.pixels.as_chunks::<3>().0);
        let width = self.width as usize;
        let differs = |k: &usize| pixels[*k] != other_pixels[*k];
        let first = (0..pixels.len()).find(differs)?;
        let last = (0..pixels.len()).rev().find(differs)?;

        // Only rows between the first and the last difference can widen the rectangle.
        let rows = first / width..=last / width;
        let (mut left, mut right) = (width, 0);
        for row in rows.clone() {
            let line = row * width..(row + 1) * width;
            if let Some(column) = line.clone().find(differs) {
                left = left.min(column % width);
            }
            if let Some(column) = line.rev().find(differs) {
                right = right.max(column % width);
            }
        }

        let size = [right + 1 - left, rows.end() + 1 - rows.start()];
        Some([left, *rows.start(), size[0], size[1]].map(|number| number as u32))
    }

    /// Returns the pixels of a rectangle, given by the column `left` and the row `top` of its
    /// corner, `width` and `height`.
    pub(crate) fn part(&self, [left, top, width, height]: [u32; 4]) -> Vec<u8> {
        let lines = self.pixels.chunks_exact(3 * self.width.max(1) as usize);
        let columns = 3 * left as usize..3 * (left + width) as usize;
        let lines = lines.skip(top as usize).take(height as usize);
        lines.flat_map(|line| &line[columns.clone()]).copied().collect()
    }

    /// Returns the picture as a PNG file, [`Picture::from_png`] reads it.
    ///
    /// # Errors
    /// A picture that cannot be encoded, such as one without pixels.
    pub fn png(&self) -> Result<Vec<u8>, Error> {
        let failed = |error: png::EncodingError| Error::Encoding { reason: error.to_string() };
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header().map_err(failed)?;
        writer.write_image_data(&self.pixels).map_err(failed)?;
        writer.finish().map_err(failed)?;
        Ok(bytes)
    }

    /// Returns the picture in the `bytes` of a PNG file without transparency, with eight bits a
    /// colour, as [`Picture::png`] writes it.
    ///
    /// # Errors
    /// The bytes are no such file, or the picture is larger than 8192 pixels.
    pub fn from_png(bytes: &[u8]) -> Result<Picture, Error> {
        let failed = |reason: String| Error::NoPicture { reason };
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().map_err(|error| failed(error.to_string()))?;
        let kind = reader.output_color_type();
        if kind != (png::ColorType::Rgb, png::BitDepth::Eight) {
            return Err(failed("its pixels are not three bytes each".to_owned()));
        }
        let (width, height) = (reader.info().width, reader.info().height);
        if width.max(height) > SIDE_MAX {
            return Err(failed(format!("it has {width} × {height} pixels")));
        }
        let mut pixels = vec![0; 3 * width as usize * height as usize];
        reader.next_frame(&mut pixels).map_err(|error| failed(error.to_string()))?;
        Ok(Picture { width, height, pixels })
    }

    /// Writes the picture to a PNG file at `path`.
    ///
    /// # Errors
    /// A picture that cannot be encoded, or a file that cannot be written.
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        std::fs::write(path, self.png()?).map_err(|error| Error::Unwritable {
            path: path.to_path_buf(),
            reason: error.to_string(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_comes_back_from_its_file_and_other_bytes_do_not() {
        let picture = Picture::new(3, 2, (0..18).collect());
        let mut file = picture.png().expect("it has pixels");
        assert_eq!(Picture::from_png(&file), Ok(picture));
        file.truncate(file.len() - 20);
        assert!(matches!(Picture::from_png(&file), Err(Error::NoPicture { .. })));
        assert!(matches!(Picture::from_png(b"GIF89a"), Err(Error::NoPicture { .. })));
    }

    #[test]
    fn a_sheet_shows_every_picture_in_its_column_and_row() {
        let plain = |width: u32, height: u32, shade: u8| {
            Picture::new(width, height, vec![shade; 3 * (width * height) as usize])
        };
        let sheet = Picture::sheet(&[plain(3, 2, 10), plain(2, 2, 20), plain(3, 1, 30)], 2);
        assert_eq!((sheet.width(), sheet.height()), (5, 3));
        let shade = |x, y| sheet.pixel(x, y).map(|[shade, ..]| shade);
        assert_eq!([shade(2, 1), shade(3, 0), shade(4, 1)], [10, 20, 20].map(Some));
        assert_eq!([shade(0, 2), shade(4, 2)], [30, 255].map(Some));
        assert_eq!(Picture::sheet(&[], 3).width(), 0);
    }
}
