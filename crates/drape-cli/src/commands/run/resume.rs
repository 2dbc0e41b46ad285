//! `drape resume`: continues an interrupted run from its last checkpoint, or a complete run beyond
//! its end.

use std::path::PathBuf;

use clap::Args;
use drape::run::file::FileKind;
use drape::run::{ResumableRun, end_at};

use crate::commands::run::job::{Job, JobArguments};
use crate::commands::run::limits::positive;
use crate::commands::run::report::outcome;
use crate::console::{print_message, signal};
use crate::failure::Failure;
use crate::input;
use crate::say::say_json;

#[derive(Args)]
pub(crate) struct ResumeArguments {
    /// Folder of the run.
    #[arg(value_name = "RUN")]
    run: PathBuf,
    /// Scene of the run, if it has another place now; - stands for standard input.
    #[arg(long, value_name = "SCENE")]
    scene: Option<PathBuf>,
    /// Goes on for this number of seconds beyond the end of the run.
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    extend: Option<f64>,
    #[command(flatten)]
    options: JobArguments,
}

/// Executes `drape resume`.
pub(crate) fn resume(arguments: &ResumeArguments) -> Result<(), Failure> {
    signal::watch();
    let ResumeArguments { run: folder, extend, options, .. } = arguments;
    input::expect_run(folder)?;
    let mut resumed = ResumableRun::open(folder, *extend)?;
    let request = &mut resumed.request;
    let path = arguments.scene.clone().unwrap_or_else(|| request.scene.clone());
    if input::is_standard(&path) && arguments.scene.is_none() {
        return Err(Failure::Usage(
            "the scene was read from standard input: pipe it again, with --scene -".into(),
        ));
    }

    input::set_values(&request.settings()?);
    let mut scene = drape::run::scene_of(&input::document_of_kind(&path, &[FileKind::Scene])?)?;
    if let Some(end) = request.until {
        end_at(&mut scene, end)?;
    }
    if arguments.scene.is_some() {
        request.move_scene(&path);
    }

    let (run, notes) = resumed.go_on(scene, &options.run_options(true))?;
    notes.iter().for_each(print_message);
    let summary = Job { run, folder, options }.run()?;
    if options.json {
        say_json(&summary)?;
    }
    outcome(summary, folder)
}
