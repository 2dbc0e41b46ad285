//! Error of a picture that cannot be drawn, read or written.

use std::path::PathBuf;

/// Reason why a picture cannot be drawn, read or written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The scene has no triangle.
    #[error("the scene has no triangles; give it a cloth or a body")]
    EmptyScene,

    /// The light was computed for other shapes.
    #[error("the scene has other shapes than the light was computed for; compute its own")]
    OtherShapes,

    /// A list of a surface has a wrong length.
    #[error("{surface}: {what} has {length} numbers, not {expected}")]
    BadLength {
        /// The surface, as in "cloth 0".
        surface: String,
        /// The list, in words.
        what: &'static str,
        /// Length of the list.
        length: usize,
        /// Expected length, in words.
        expected: String,
    },

    /// A triangle refers to a vertex that does not exist.
    #[error("{surface}: triangle {triangle} refers to vertex {index} of {vertices}")]
    NoSuchVertex {
        /// The surface, as in "cloth 0".
        surface: String,
        /// Number of the triangle, from 0.
        triangle: usize,
        /// Number of the vertex.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },

    /// A coordinate is not finite, or too large.
    #[error(
        "{surface}: {what} of vertex {vertex} has the coordinate {value}; did the simulation fail?"
    )]
    BadCoordinate {
        /// The surface, as in "cloth 0".
        surface: String,
        /// The list, in words.
        what: &'static str,
        /// Number of the vertex, from 0.
        vertex: usize,
        /// The coordinate.
        value: f64,
    },

    /// A number is out of its range.
    #[error("{what} is {value}, but it must be {range}")]
    OutOfRange {
        /// The quantity, in words.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
        /// The range, in words.
        range: &'static str,
    },

    /// A scale of colours has no range.
    #[error("the range from {low} to {high} has no width; give a lower end and a higher one")]
    NoRange {
        /// Lower end of the range.
        low: f64,
        /// Upper end of the range.
        high: f64,
    },

    /// Pixels do not fill a picture.
    #[error("a picture of {} x {} pixels needs 3 bytes for each, not {bytes} bytes in all", size[0], size[1])]
    BadPixels {
        /// Width and height of the picture, in pixels.
        size: [u32; 2],
        /// Number of bytes of the pixels.
        bytes: usize,
    },

    /// Bytes are no picture that can be shown.
    #[error("not a PNG picture that can be shown: {reason}")]
    NoPicture {
        /// Reason, in words.
        reason: String,
    },

    /// An animation has no picture, or a picture with another size than the animation.
    #[error("an animation of {frames} pictures of {} x {} pixels got one of {} x {}", size[0], size[1], found[0], found[1])]
    BadAnimation {
        /// Number of pictures of the animation.
        frames: u32,
        /// Width and height of the animation, in pixels.
        size: [u32; 2],
        /// Width and height of the picture that does not fit, in pixels.
        found: [u32; 2],
    },

    /// A picture cannot be encoded.
    #[error("the picture cannot be encoded as PNG: {reason}")]
    Encoding {
        /// Message of the encoder.
        reason: String,
    },

    /// A file cannot be written.
    #[error("{}: {reason}; check that the folder exists and can be written", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// Answer of the operating system.
        reason: String,
    },
}
