//! Samples: the frames of a run that a page may show, with their fields.

use drape_frames::{Error, Frame, Recording};

use crate::field::{Field, Fields};
use crate::scale;

/// Largest number of frames that are shown of a run.
const FRAMES_MAX: usize = 600;

/// Frames of a run, evenly chosen, with their fields; they are computed once, however many of them
/// the page has room for.
pub(super) struct Samples {
    pub(super) frames: Vec<Frame>,
    fields: Vec<Known>,
}

/// Field with its range and its values in the frames where it is known.
struct Known {
    field: Field,
    range: [f64; 2],
    values: Vec<Option<Vec<f32>>>,
}

/// Some of the samples.
pub(super) struct Chosen<'a> {
    pub(super) frames: Vec<&'a Frame>,
    pub(super) fields: Vec<Shown<'a>>,
}

/// Field with its range and its values: in all chosen frames, or in the last one alone.
pub(super) struct Shown<'a> {
    pub(super) field: Field,
    pub(super) range: [f64; 2],
    pub(super) values: Vec<&'a [f32]>,
}

impl Samples {
    /// Reads evenly chosen frames, the first and the last among them, with at most `vertices_max`
    /// vertices in all.
    pub(super) fn new(recording: &Recording, vertices_max: usize) -> Result<Samples, Error> {
        let last = recording.frame_count() - 1;
        let most = vertices_max / recording.topology().material.len().max(1);
        let stride = last.div_ceil(most.clamp(1, FRAMES_MAX)).max(1);
        let mut numbers: Vec<usize> = (0..last).step_by(stride).collect();
        numbers.push(last);
        let mut all = Fields::new(recording);
        let fields = Field::ALL.into_iter().filter(|field| all.has(*field));
        let known = |field| Known { field, range: [0.0; 2], values: Vec::new() };
        let mut fields: Vec<Known> = fields.map(known).collect();
        let mut frames: Vec<Frame> = Vec::new();
        for number in numbers {
            let read;
            let before = match (number.checked_sub(1), frames.last()) {
                (Some(before), Some(own)) if own.number == before => Some(own),
                (Some(before), _) => {
                    read = recording.frame(before)?;
                    Some(&read)
                }
                (None, _) => None,
            };
            let frame = recording.frame(number)?;
            for Known { field, values, .. } in &mut fields {
                let own = all.values(*field, &frame, before);
                values.push(own.map(|own| own.iter().map(|value| *value as f32).collect()));
            }
            frames.push(frame);
        }
        for Known { field, range, values } in &mut fields {
            let values = values.iter().flatten().flatten().map(|value| f64::from(*value));
            *range = scale::range(values, field.is_signed());
        }
        Ok(Samples { frames, fields })
    }

    /// Returns the samples of some indices.
    pub(super) fn chosen(&self, indices: &[usize]) -> Chosen<'_> {
        Chosen {
            frames: indices.iter().map(|index| &self.frames[*index]).collect(),
            fields: self.fields.iter().filter_map(|known| known.shown(indices)).collect(),
        }
    }
}

impl Known {
    /// Returns the field at the samples of some indices, if it is known in the last one.
    fn shown(&self, indices: &[usize]) -> Option<Shown<'_>> {
        let of = |index: &usize| self.values[*index].as_deref();
        let all: Option<Vec<&[f32]>> = indices.iter().map(of).collect();
        let last = || indices.last().and_then(of).map(|values| vec![values]);
        let Known { field, range, .. } = *self;
        Some(Shown { field, range, values: all.or_else(last)? })
    }
}
