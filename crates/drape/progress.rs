//! Progress bars on stderr, and the recording of a run with its bar.

use std::time::Duration;

use drape::dynamics::{Error, Frame, Progress, Recorder, Step};
use indicatif::{ProgressBar, ProgressStyle};

/// Returns a progress bar on stderr, silent where that is no terminal, with a template of indicatif
/// for the text beside it.
pub(crate) fn bar(length: u64, template: &str) -> ProgressBar {
    let style = format!("{{elapsed_precise}} {{bar:32}} {template}");
    let style = ProgressStyle::with_template(&style).expect("the template is right");
    ProgressBar::new(length).with_style(style)
}

/// Progress of a run: its bar, and the recorder of its frames.
pub(crate) struct Screen<'a> {
    bar: ProgressBar,
    recorder: Recorder<'a>,
    /// Latest frame.
    pub(crate) last: Option<Frame>,
}

impl<'a> Screen<'a> {
    /// Starts the bar of a run of so many steps.
    pub(crate) fn new(steps: usize, recorder: Recorder<'a>) -> Self {
        let bar = bar(steps as u64, "{pos}/{len} steps, {per_sec}, {eta} left  {msg}");
        bar.enable_steady_tick(Duration::from_millis(250));
        Self { bar, recorder, last: None }
    }

    /// Prints a warning beside the bar.
    #[expect(clippy::print_stderr, reason = "messages of the program go to stderr")]
    fn tell(&self, event: &str) {
        self.bar.suspend(|| eprintln!("warning: {event}"));
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
        step.events.iter().for_each(|event| self.tell(event));
    }

    fn frame(&mut self, frame: &Frame) -> Result<(), Error> {
        self.recorder.frame(frame)?;
        self.last = Some(frame.clone());
        Ok(())
    }
}
