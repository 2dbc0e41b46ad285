//! `drape view`: shows runs on one page, which turns, plays and measures them.

use std::path::PathBuf;

use clap::Args;
use drape::frames::Recording;
use drape::run::reports::{VIEWER_SIZE_MAX, ViewerPage};

use crate::console::note;
use crate::failure::Failure;
use crate::input;
use crate::say::say_written;
use drape::run::file;

#[derive(Args)]
pub(crate) struct ViewArguments {
    /// Folders of runs; several are shown side by side.
    #[arg(required = true, value_name = "RUN")]
    runs: Vec<PathBuf>,
    /// File of the page [default: view.html in the folder of the first run].
    #[arg(short, long, value_name = "HTML")]
    output: Option<PathBuf>,
    /// Largest size of the page, in megabytes: frames are left out evenly until it fits.
    #[arg(long, default_value_t = VIEWER_SIZE_MAX, value_name = "MB")]
    size: f64,
}

/// Executes `drape view`.
pub(crate) fn view(arguments: &ViewArguments) -> Result<(), Failure> {
    if !(arguments.size >= 0.0) {
        return Err(Failure::Usage(format!(
            "--size {}: give megabytes, such as 20",
            arguments.size
        )));
    }
    arguments.runs.iter().try_for_each(|run| input::expect_run(run))?;
    let recordings =
        arguments.runs.iter().map(Recording::open).collect::<Result<Vec<Recording>, _>>()?;
    let path = arguments.output.clone().unwrap_or_else(|| arguments.runs[0].join("view.html"));
    let page = ViewerPage::new(&recordings, arguments.size)?;
    page.thinned.iter().for_each(note);
    file::write(&path, page.html)?;
    say_written(format_args!("page in {}", path.display()))
}
