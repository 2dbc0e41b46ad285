use crate::error::ReportError;
use crate::scene::Colour;
use std::path::Path;

/// A finished picture: rows of pixels from the top, in sRGB.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<u8>,
}

impl Picture {
    pub(crate) fn new(width: u32, height: u32, pixels: Vec<u8>) -> Picture {
        Picture { width, height, pixels }
    }

    /// Width, in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height, in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Three bytes per pixel, row by row from the top.
    pub fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// One pixel, counted from the top left; none outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Option<Colour> {
        let (pixels, _) = self.pixels.as_chunks::<3>();
        let row = pixels.chunks(self.width as usize).nth(y as usize)?;
        row.get(x as usize).copied()
    }

    /// The picture as a PNG file.
    pub fn png(&self) -> Result<Vec<u8>, ReportError> {
        let failed =
            |error: png::EncodingError| ReportError::Encoding { reason: error.to_string() };
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
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), ReportError> {
        let path = path.as_ref();
        std::fs::write(path, self.png()?).map_err(|error| ReportError::Unwritable {
            path: path.to_path_buf(),
            reason: error.to_string(),
        })
    }
}
