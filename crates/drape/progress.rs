use std::time::Duration;

use drape::dynamics::{Error, Frame, Progress, Recorder, Step};
use indicatif::{ProgressBar, ProgressStyle};

/// A bar of some length on stderr, which stays silent where stderr is not a terminal, with what is told beside it as
/// indicatif's template.
pub(crate) fn bar(length: u64, told: &str) -> ProgressBar {
    let style = format!("{{elapsed_precise}} {{bar:32}} {told}");
    let style = ProgressStyle::with_template(&style).expect("the template is right");
    ProgressBar::new(length).with_style(style)
}

/// Shows a run on a terminal and stores its frames.
pub(crate) struct Screen<'a> {
    bar: ProgressBar,
    recorder: Recorder<'a>,
    pub(crate) last: Option<Frame>,
}

impl<'a> Screen<'a> {
    /// A bar of so many steps.
    pub(crate) fn new(steps: usize, recorder: Recorder<'a>) -> Self {
        let bar = bar(steps as u64, "{pos}/{len} steps, {per_sec}, {eta} left  {msg}");
        bar.enable_steady_tick(Duration::from_millis(250));
        Self { bar, recorder, last: None }
    }

    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Progress for Screen<'_> {
    fn step(&mut self, step: &Step, ticks: usize) {
        self.bar.set_message(format!(
            "t {:.3} s, fastest {:.1} mm/s, {} iterations",
            step.time,
            1e3 * step.speed_max,
            step.report.iterations
        ));
        self.bar.set_position(ticks as u64);
    }

    fn frame(&mut self, frame: &Frame) -> Result<(), Error> {
        self.recorder.frame(frame)?;
        self.last = Some(frame.clone());
        Ok(())
    }
}
