//! Animation: successive pictures as an animated PNG file that loops.
//!
//! The file stores each picture as the rectangle in which it differs from the picture before.

use std::io::Write;

use png::{BitDepth, BlendOp, ColorType, DisposeOp, Encoder, EncodingError, Writer};

use super::pixels::Picture;
use crate::error::Error;

/// Longest time of a picture, in s. The format has 16 bits for its milliseconds.
const LONGEST: f64 = 65.0;

/// Animated PNG file that is being written, picture by picture.
pub struct Animation<W: Write> {
    writer: Writer<W>,
    /// Number of pictures of the file.
    frames: u32,
    /// Width and height of the pictures, in pixels.
    size: [u32; 2],
    /// Last picture that was written.
    before: Option<Picture>,
    /// Time at which the next picture begins, in s.
    time: f64,
    /// Sum of the times in the file, in s. It differs from `time` by rounding.
    written: f64,
}

impl<W: Write> Animation<W> {
    /// Begins a file `to` with `frames` pictures whose width and height are `size`, in pixels.
    ///
    /// # Errors
    /// There are no pictures, or the file cannot be written.
    pub fn new(to: W, frames: u32, size: [u32; 2]) -> Result<Animation<W>, Error> {
        let mut encoder = Encoder::new(to, size[0], size[1]);
        encoder.set_color(ColorType::Rgb);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_animated(frames, 0).map_err(failed)?;
        encoder.set_blend_op(BlendOp::Source).map_err(failed)?;
        encoder.set_dispose_op(DisposeOp::None).map_err(failed)?;
        let writer = encoder.write_header().map_err(failed)?;
        Ok(Animation { writer, frames, size, before: None, time: 0.0, written: 0.0 })
    }

    /// Adds a `picture` that is shown for `seconds`.
    ///
    /// # Errors
    /// The picture has another size, or the file cannot be written.
    pub fn add(&mut self, picture: Picture, seconds: f64) -> Result<(), Error> {
        let found = [picture.width(), picture.height()];
        if found != self.size {
            let (frames, size) = (self.frames, self.size);
            return Err(Error::BadAnimation { frames, size, found });
        }

        let [left, top, width, height] = match &self.before {
            None => [0, 0, self.size[0], self.size[1]],
            Some(before) => picture.difference(before).unwrap_or([0, 0, 1, 1]),
        };
        // Times are rounded to whole milliseconds. The rounding errors must not add up.
        self.time += seconds.clamp(0.0, LONGEST);
        let milliseconds = (1e3 * (self.time - self.written)).round();
        self.written += 1e-3 * milliseconds;
        self.writer.set_frame_delay(milliseconds as u16, 1000).map_err(failed)?;

        if self.before.is_some() {
            self.writer.reset_frame_position().map_err(failed)?;
            self.writer.set_frame_dimension(width, height).map_err(failed)?;
            self.writer.set_frame_position(left, top).map_err(failed)?;
        }
        let pixels = picture.part([left, top, width, height]);
        self.writer.write_image_data(&pixels).map_err(failed)?;
        self.before = Some(picture);
        Ok(())
    }

    /// Ends the file.
    ///
    /// # Errors
    /// Pictures are missing, or the file cannot be written.
    pub fn finish(self) -> Result<(), Error> {
        self.writer.finish().map_err(failed)
    }
}

/// Returns the error of the encoder as [`Error`].
fn failed(error: EncodingError) -> Error {
    Error::Encoding { reason: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use png::Decoder;

    fn plain(shade: u8) -> Picture {
        Picture::new(6, 4, vec![shade; 72])
    }

    fn with_dot(shade: u8, at: [u32; 2]) -> Picture {
        let mut picture = plain(shade);
        *picture.pixel_mut(at[0], at[1]).expect("inside") = [255, 0, 0];
        picture
    }

    #[test]
    fn pictures_and_their_times_come_back() {
        let pictures =
            [plain(10), with_dot(10, [2, 1]), with_dot(10, [5, 3]), with_dot(10, [5, 3])];
        let mut bytes = Vec::new();
        let mut animation = Animation::new(&mut bytes, 4, [6, 4]).expect("it begins");
        for picture in &pictures {
            animation.add(picture.clone(), 1.0 / 30.0).expect("it fits");
        }
        animation.finish().expect("it ends");
        let mut reader =
            Decoder::new(std::io::Cursor::new(&bytes)).read_info().expect("a PNG file");
        let control = *reader.info().animation_control().expect("animated");
        assert_eq!((control.num_frames, control.num_plays), (4, 0), "it loops");
        let (mut canvas, mut delays) = (vec![0; 72], Vec::new());
        for picture in &pictures {
            let mut buffer = vec![0; reader.output_buffer_size().expect("a size")];
            reader.next_frame(&mut buffer).expect("a picture");
            let part = *reader.info().frame_control().expect("a part");
            for row in 0..part.height as usize {
                let to = 3 * ((part.y_offset as usize + row) * 6 + part.x_offset as usize);
                let from = 3 * row * part.width as usize;
                let width = 3 * part.width as usize;
                canvas[to..to + width].copy_from_slice(&buffer[from..from + width]);
            }
            assert_eq!(canvas, picture.pixels());
            delays.push((part.delay_num, part.delay_den));
        }
        // A thirtieth of a second is no whole number of milliseconds; their sum is right.
        assert_eq!(delays, [(33, 1000), (34, 1000), (33, 1000), (33, 1000)]);
    }

    #[test]
    fn a_picture_of_another_size_is_refused_and_so_is_no_picture() {
        let mut animation = Animation::new(Vec::new(), 2, [6, 5]).expect("it begins");
        let refused = animation.add(plain(1), 0.1).expect_err("another size");
        assert!(refused.to_string().contains("6 x 5 pixels got one of 6 x 4"), "{refused}");
        assert!(Animation::new(Vec::new(), 0, [6, 4]).is_err());
    }
}
