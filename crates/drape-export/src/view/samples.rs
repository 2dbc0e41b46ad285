//! Samples: frames of a run that a page may show, with their fields.

use drape_frames::{Error, Frame, Recording};

use crate::field::{Field, Fields};
use crate::scale;

/// Largest number of frames of a run that are shown.
const FRAMES_MAX: usize = 600;

/// Frames of a run, evenly chosen, with their fields. They are computed once, also if the page has
/// room for fewer of them.
pub(super) struct Samples {
    pub(super) frames: Vec<Frame>,
    fields: Vec<SampledField>,
}

/// Field with its range and its values in the samples; `None` in samples where it is not known.
struct SampledField {
    field: Field,
    range: [f64; 2],
    values: Vec<Option<Vec<f32>>>,
}

/// Samples that are shown.
pub(super) struct ShownSamples<'a> {
    pub(super) frames: Vec<&'a Frame>,
    pub(super) fields: Vec<ShownField<'a>>,
}

/// Field with its range and its values: in all samples that are shown, or in the last sample only.
pub(super) struct ShownField<'a> {
    pub(super) field: Field,
    pub(super) range: [f64; 2],
    pub(super) values: Vec<&'a [f32]>,
}

impl Samples {
    /// Reads evenly chosen frames of `recording`, with the first and the last, that have at most
    /// `vertices_max` vertices in all.
    pub(super) fn new(recording: &Recording, vertices_max: usize) -> Result<Samples, Error> {
        let last = recording.frame_count() - 1;
        let most = vertices_max / recording.topology().material.len().max(1);
        let stride = last.div_ceil(most.clamp(1, FRAMES_MAX)).max(1);
        let mut numbers: Vec<usize> = (0..last).step_by(stride).collect();
        numbers.push(last);

        let mut computed = Fields::new(recording);
        let known = Field::ALL.into_iter().filter(|field| computed.has(*field));
        let mut fields: Vec<SampledField> = known
            .map(|field| SampledField { field, range: [0.0; 2], values: Vec::new() })
            .collect();

        // Speeds are measured from the frame before, which may be no sample.
        let mut frames: Vec<Frame> = Vec::new();
        for number in numbers {
            let read;
            let before = match (number.checked_sub(1), frames.last()) {
                (Some(before), Some(sample)) if sample.number == before => Some(sample),
                (Some(before), _) => {
                    read = recording.frame(before)?;
                    Some(&read)
                }
                (None, _) => None,
            };
            let frame = recording.frame(number)?;
            for SampledField { field, values, .. } in &mut fields {
                let single = computed
                    .values(*field, &frame, before)
                    .map(|values| values.iter().map(|value| *value as f32).collect());
                values.push(single);
            }
            frames.push(frame);
        }

        for SampledField { field, range, values } in &mut fields {
            let values = values.iter().flatten().flatten().map(|value| f64::from(*value));
            *range = scale::range(values, field.is_signed());
        }
        Ok(Samples { frames, fields })
    }

    /// Returns the samples with `indices`.
    pub(super) fn shown(&self, indices: &[usize]) -> ShownSamples<'_> {
        ShownSamples {
            frames: indices.iter().map(|index| &self.frames[*index]).collect(),
            fields: self.fields.iter().filter_map(|field| field.shown(indices)).collect(),
        }
    }
}

impl SampledField {
    /// Returns the field at the samples with `indices`, if it is known in the last one.
    fn shown(&self, indices: &[usize]) -> Option<ShownField<'_>> {
        let mut values: Vec<Option<&[f32]>> =
            indices.iter().map(|index| self.values[*index].as_deref()).collect();
        if values.contains(&None) {
            values.drain(..values.len() - 1);
        }
        let values: Option<Vec<&[f32]>> = values.into_iter().collect();
        Some(ShownField { field: self.field, range: self.range, values: values? })
    }
}
