//! Clip: the frames of a run that are written, with their times.

use std::ops::RangeInclusive;

use drape_frames::{Frame, Recording};

use crate::error::Error;

/// Largest frame rate, in frames per second.
const RATE_MAX: f64 = 1e5;

/// Frame rate of a single frame, in frames per second: the rate of films.
const RATE_OF_ONE: f64 = 24.0;

/// Fraction of the distance between two frames by which a frame may come early or late and still
/// counts as on time. No eye sees it, and times that are multiples of a step need it.
const JITTER: f64 = 0.25;

/// Frames of a run that are written, in the order of their times.
#[derive(Debug, Clone)]
pub struct Clip<'a> {
    recording: &'a Recording,
    frames: Vec<usize>,
    times: Vec<f64>,
    rate: f64,
}

impl<'a> Clip<'a> {
    /// Returns the clip of the frames of `recording` with `numbers`, from 0: all frames are
    /// `0..=recording.frame_count() - 1`. `rate` is its frame rate in frames per second. Without it
    /// the rate comes from the times of the frames. Of frames at one time the last is taken.
    ///
    /// # Errors
    /// The first of `numbers` is above the last, a frame is missing, or `rate` is out of range.
    pub fn new(
        recording: &'a Recording,
        numbers: RangeInclusive<usize>,
        rate: Option<f64>,
    ) -> Result<Clip<'a>, Error> {
        if let Some(rate) = rate.filter(|rate| !(*rate > 0.0 && *rate <= RATE_MAX)) {
            return Err(Error::BadRate { rate, limit: RATE_MAX });
        }
        let (first, last) = (*numbers.start(), *numbers.end());
        if first > last {
            return Err(Error::NoFrames { first, last });
        }

        let (mut frames, mut times) = (Vec::new(), Vec::new());
        for number in numbers {
            let time = recording.time(number)?;
            if times.last().is_some_and(|last| *last >= time) {
                frames.pop();
                times.pop();
            }
            frames.push(number);
            times.push(time);
        }
        let rate = rate.unwrap_or_else(|| rate_of(&times));
        Ok(Clip { recording, frames, times, rate })
    }

    /// Returns the run that the frames belong to.
    #[must_use]
    pub fn recording(&self) -> &'a Recording {
        self.recording
    }

    /// Returns the numbers of the frames.
    #[must_use]
    pub fn frames(&self) -> &[usize] {
        &self.frames
    }

    /// Returns the times of the frames, in s, each later than the time before.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns the frame rate, in frames per second.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Returns the number of frames, at least 1.
    #[must_use]
    pub fn frame_count(&self) -> usize {
        self.frames.len()
    }

    /// Returns the times of the frames since the first frame, in s.
    #[must_use]
    pub fn seconds(&self) -> Vec<f64> {
        self.times.iter().map(|time| time - self.times[0]).collect()
    }

    /// Returns whether the frames follow each other at the frame rate.
    #[must_use]
    pub fn is_even(&self) -> bool {
        let mut seconds = self.seconds().into_iter().enumerate();
        seconds.all(|(index, seconds)| (seconds * self.rate - index as f64).abs() <= JITTER)
    }

    /// Returns the frames that are nearest to the instants of the frame rate, for formats without
    /// times. A frame may come more than once.
    #[must_use]
    pub fn resampled(&self) -> Clip<'a> {
        if self.is_even() {
            return self.clone();
        }
        let seconds = self.seconds();
        let instants = (seconds[seconds.len() - 1] * self.rate).round() as usize;
        let (mut frames, mut times) = (Vec::new(), Vec::new());
        for instant in 0..=instants {
            let at = instant as f64 / self.rate;
            let after = seconds.partition_point(|time| *time < at).min(seconds.len() - 1);
            let before = after.saturating_sub(1);
            let is_before_nearer = at - seconds[before] < seconds[after] - at;
            frames.push(self.frames[if is_before_nearer { before } else { after }]);
            times.push(self.times[0] + at);
        }
        Clip { frames, times, ..self.clone() }
    }

    /// Returns at most `most` of the frames, with the first and the last, evenly by number.
    #[must_use]
    pub fn thinned(&self, most: usize) -> Clip<'a> {
        let count = self.frame_count();
        if count <= most {
            return self.clone();
        }
        let steps = most.max(2) - 1;
        let indices = (0..=steps).map(|step| (step * (count - 1) + steps / 2) / steps);
        let frames = indices.clone().map(|index| self.frames[index]).collect();
        let times = indices.map(|index| self.times[index]).collect();
        Clip { frames, times, ..self.clone() }
    }

    /// Reads the frame with the index `index` in the clip.
    ///
    /// # Errors
    /// The frame cannot be read.
    pub(crate) fn read(&self, index: usize) -> Result<Frame, Error> {
        Ok(self.recording.frame(self.frames[index])?)
    }
}

/// Returns the frame rate of frames at `times`, in s: a whole number if it is near, or if the times
/// are irregular.
fn rate_of(times: &[f64]) -> f64 {
    let mut gaps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    if gaps.is_empty() {
        return RATE_OF_ONE;
    }
    gaps.sort_by(f64::total_cmp);
    let median = gaps[gaps.len() / 2];
    // Times that are multiples of a step jump about their mean. A run that ends early has one gap
    // that differs.
    let near = gaps.iter().filter(|gap| (**gap - median).abs() <= JITTER * median);
    let (sum, count) = near.fold((0.0, 0), |(sum, n), gap| (sum + gap, n + 1));
    let rate = f64::from(count) / sum;
    let (whole, irregular) = (rate.round(), (count as usize) + 1 < gaps.len());
    let is_near = (rate - whole).abs() <= 0.01 * rate;
    let rate = if is_near || irregular && whole >= 1.0 { whole } else { rate };
    rate.clamp(1.0 / RATE_MAX, RATE_MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn the_rate_is_that_of_the_times() {
        assert_eq!(rate_of(&[0.0, 0.04, 0.08, 0.12]), 25.0);
        // Multiples of a step of 5 ms, and a run that ends early.
        assert_eq!(rate_of(&[0.0, 0.035, 0.065, 0.1, 0.135, 0.165, 0.2, 0.205]), 30.0);
        assert_eq!(rate_of(&[0.0, 1.5]), 1.0 / 1.5);
        assert_eq!(rate_of(&[0.0, 0.4, 0.8, 1.2]), 2.5);
        assert_eq!(rate_of(&[0.0, 0.08, 0.16, 0.5, 0.59, 0.9]), 12.0, "no whole number is near");
        assert_eq!(rate_of(&[3.0]), 24.0);
        let slow = rate_of(&[0.0, 3.0, 6.1, 20.0, 35.0, 60.0]);
        assert!((1.0 / 15.0..1.0 / 13.0).contains(&slow), "{slow}: less than a frame a second");
    }

    #[test]
    fn irregular_times_are_resampled_to_the_nearest_frame() {
        let folder = example::folder(&[0.0, 0.1, 0.2, 0.5, 0.5, 0.6]);
        let recording = Recording::open(folder.path()).unwrap();
        let clip = Clip::new(&recording, 0..=5, None).unwrap();
        assert_eq!(clip.frames(), [0, 1, 2, 4, 5], "of two frames at 0.5 s the later");
        assert_eq!(clip.rate(), 10.0);
        assert!(!clip.is_even());
        let even = clip.resampled();
        assert_eq!(even.frames(), [0, 1, 2, 2, 4, 4, 5]);
        assert!(even.is_even());
        assert_eq!(clip.thinned(3).frames(), [0, 2, 5]);
    }

    #[test]
    fn what_there_is_not_is_refused() {
        let folder = example::folder(&[0.0, 0.1]);
        let recording = Recording::open(folder.path()).unwrap();
        let clip = |range, rate| Clip::new(&recording, range, rate).map(|clip| clip.frame_count());
        assert!(matches!(clip(0..=2, None), Err(Error::Frames(_))));
        assert!(matches!(clip(0..=1, Some(0.0)), Err(Error::BadRate { .. })));
        assert!(matches!(clip(0..=1, Some(f64::NAN)), Err(Error::BadRate { .. })));
        let backwards = RangeInclusive::new(1, 0);
        assert!(matches!(clip(backwards, None), Err(Error::NoFrames { first: 1, last: 0 })));
    }
}
