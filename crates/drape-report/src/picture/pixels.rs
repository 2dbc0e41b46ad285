//! Pixels: a picture in sRGB, and its PNG file.

use std::path::Path;

use crate::error::Error;
use crate::picture::Colour;

/// Picture: rows of pixels from the top, in sRGB.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

impl Picture {
    /// Returns a picture of pixels with three bytes each.
    pub(crate) fn new(width: u32, height: u32, pixels: Vec<u8>) -> Picture {
        Picture { width, height, pixels }
    }

    /// Returns pictures side by side on white, in rows of some columns, each in a field of the
    /// largest size.
    #[must_use]
    pub fn sheet(pictures: &[Picture], columns: usize) -> Picture {
        let columns = columns.clamp(1, pictures.len().max(1));
        let largest = |size: fn(&Picture) -> u32| pictures.iter().map(size).max().unwrap_or(0);
        let (field, rows) =
            ([largest(Picture::width), largest(Picture::height)], pictures.len().div_ceil(columns));
        let (width, height) = (field[0] * columns as u32, field[1] * rows as u32);
        let mut pixels = vec![u8::MAX; 3 * width as usize * height as usize];
        for (number, picture) in pictures.iter().enumerate() {
            let (column, row) = (number % columns, number / columns);
            let left = column * field[0] as usize;
            let lines = picture.pixels.chunks(3 * picture.width.max(1) as usize);
            for (line, data) in lines.enumerate() {
                let above = row * field[1] as usize + line;
                let start = 3 * (above * width as usize + left);
                pixels[start..start + data.len()].copy_from_slice(data);
            }
        }
        Picture { width, height, pixels }
    }

    /// Width, in pixels.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height, in pixels.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Pixels, three bytes each, row by row from the top.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// Returns a pixel, counted from the top left; `None` outside the picture.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<Colour> {
        let (pixels, _) = self.pixels.as_chunks::<3>();
        let row = pixels.chunks(self.width as usize).nth(y as usize)?;
        row.get(x as usize).copied()
    }

    /// Returns the picture as a PNG file.
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

    /// Writes the picture to a PNG file.
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
    fn a_sheet_shows_every_picture_in_its_field() {
        let plain = |width: u32, height: u32, shade: u8| {
            Picture::new(width, height, vec![shade; 3 * (width * height) as usize])
        };
        let sheet = Picture::sheet(&[plain(3, 2, 10), plain(2, 2, 20), plain(3, 1, 30)], 2);
        assert_eq!((sheet.width(), sheet.height()), (6, 4));
        let shade = |x, y| sheet.pixel(x, y).map(|[shade, ..]| shade);
        assert_eq!([shade(2, 1), shade(3, 0), shade(4, 1)], [10, 20, 20].map(Some));
        assert_eq!([shade(0, 2), shade(0, 3), shade(5, 0)], [30, 255, 255].map(Some));
        assert_eq!(Picture::sheet(&[], 3).width(), 0);
    }
}
