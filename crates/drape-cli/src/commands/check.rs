//! `drape check`: reads scenes, fabrics, sheets and patterns without simulating, and verifies the
//! frames of runs.
//!
//! [`mod@describe`] prints the contents of a file in SI, [`pattern`] cuts a pattern, and [`start`]
//! draws a garment at its start. [`body`] inspects a mesh and repairs it. [`frames`] reads the
//! folders of runs by `drape::verify`, which shares no code with the simulation. [`pace`] estimates
//! the duration of a run, and [`proposal`] tries the positions that mistakes propose.

mod body;
mod describe;
mod frames;
mod pace;
mod pattern;
pub(crate) mod proposal;
mod start;
mod values;

use std::path::{Path, PathBuf};

use clap::Args;
use drape::input::{Diagnostic, Diagnostics, Edit, Setting, Subject};
use serde_json::{Map, Value, json};

use self::body::{BodyDescription, BodySettings};
use self::describe::describe;
use self::pattern::{CheckedPattern, RefusedPattern};
use self::start::Drawn;
use crate::failure::Failure;
use crate::input;
use crate::remedy;
use crate::say::{say, say_json};
use drape::run::file::{self, FileKind};

#[derive(Args)]
pub(crate) struct CheckArguments {
    /// Scenes, fabrics, sheets, patterns, bodies (OBJ, STL, PLY), or folders of runs; - for
    /// standard input. Or tables of a laboratory: a workbook, a .csv, a .zip, or a folder of
    /// exports.
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Draws the cut panels of a pattern (SVG), or a scene at its start (SVG or PNG): both sides of
    /// a seam in one colour, with a dot at the first stitch and an arrowhead in its direction.
    /// Where the check fails, what is wrong is red.
    #[arg(long, value_name = "SVG|PNG")]
    pub(crate) figure: Option<PathBuf>,
    /// Sets a key in place of its value in the files, as for `drape run`; may be given several
    /// times.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<Setting>,
    /// Distance between the particles of a cut pattern, or of the cloth on a body, in mm.
    #[arg(long, value_name = "MM", default_value_t = 10.0)]
    pub(crate) spacing: f64,
    /// Length of a unit of a body's file, in m [default: guessed from the size, taken as a
    /// person's].
    #[arg(long, value_name = "M")]
    pub(crate) scale: Option<f64>,
    /// Repairs a body as far as that is safe, and writes it as an OBJ file: merges vertices, drops
    /// triangles without area, turns all outside, closes holes up to 12 spacings long, and thins
    /// fine triangles.
    #[arg(long, value_name = "OBJ")]
    pub(crate) repair: Option<PathBuf>,
    /// Replaces a repaired body that is there already.
    #[arg(long)]
    pub(crate) force: bool,
    /// Makes the first steps of scenes, for two seconds, and says how long a run takes at their
    /// pace.
    #[arg(long)]
    pub(crate) time: bool,
    /// Proposes no other place for a garment that is not about its body. Without it a place is
    /// looked for, and tried by a sewing at 30 mm of at most 10 s before it is printed.
    #[arg(long)]
    pub(crate) quick: bool,
    /// Prints what was found as JSON: of each file its mistakes, of each run its frames.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Executes `drape check`: reads all files, reports all mistakes together, and then verifies the
/// frames of runs.
pub(crate) fn check(arguments: &CheckArguments) -> Result<(), Failure> {
    input::set_values(&arguments.set);
    let (runs, files): (Vec<&PathBuf>, Vec<&PathBuf>) =
        arguments.files.iter().partition(|file| frames::is_run(file));
    let spacing = 1e-3 * arguments.spacing;
    let mut report = CheckReport { json: arguments.json, ..CheckReport::default() };
    let settings = BodySettings { scale: arguments.scale, spacing };
    if !(spacing > 0.0 && spacing < 1e3) || arguments.scale.is_some_and(|scale| !(scale > 0.0)) {
        return Err(Failure::Usage("--spacing (mm) and --scale (m) are above 0".into()));
    }

    if let Some(to) = &arguments.repair {
        let [mesh] = &files[..] else {
            return Err(Failure::Usage("--repair is for one body at a time".into()));
        };
        input::expect(mesh, &[FileKind::Body])?;
        file::refuse_existing(to, arguments.force, "replace it with --force")?;
        return say(body::repair_file(mesh, settings, to)?.trim_end());
    }

    match (&arguments.figure, &files[..]) {
        (Some(figure), [scene]) if describe::is_scene(scene) => {
            let outcome = match start::draw(scene, figure)? {
                Drawn::Sound { text } => Ok(text),
                Drawn::Refused { mistakes } => {
                    Err(proposal::with_trials(scene, mistakes, arguments.quick))
                }
            };
            report.add(scene, outcome)?;
        }
        (Some(figure), [pattern]) => {
            input::expect(pattern, &[FileKind::Pattern, FileKind::Drawing, FileKind::Scene])?;
            let outcome = match CheckedPattern::read_or_sketch(pattern, spacing) {
                Ok(checked) => {
                    start::write_flat(figure, Some(checked.figure()))?;
                    Ok(checked.describe())
                }
                // The figure of a refused pattern marks the faults.
                Err(RefusedPattern { mistakes, figure: drawing }) => {
                    start::write_flat(figure, drawing)?;
                    Err(mistakes)
                }
            };
            report.add(pattern, outcome)?;
        }
        (Some(_), _) => {
            return Err(Failure::Usage("--figure is for one pattern or scene at a time".into()));
        }
        (None, files) => {
            for file in files {
                if body::is_mesh(file) {
                    report.add_body(file, body::describe(file, settings))?;
                    continue;
                }
                let outcome = describe(file, spacing)
                    .map_err(|mistakes| proposal::with_trials(file, mistakes, arguments.quick));
                let has_no_mistakes = outcome.is_ok();
                report.add(file, outcome)?;
                if arguments.time && has_no_mistakes && describe::is_scene(file) {
                    report.add_time(pace::describe(file)?)?;
                }
            }
        }
    }

    // Runs are verified last, and JSON is printed before the command fails.
    if !arguments.json {
        Diagnostics::check(report.mistakes)?;
        return frames::verify(&runs, false)?.outcome();
    }
    let verified = frames::verify(&runs, true)?;
    report.entries.extend(verified.entries.iter().cloned());
    say_json(&report.entries)?;
    Diagnostics::check(report.mistakes)?;
    verified.outcome()
}

/// Contents and mistakes of the files that were checked.
#[derive(Default)]
struct CheckReport {
    json: bool,
    /// An entry for each file and each run, as JSON.
    entries: Vec<Value>,
    mistakes: Vec<Diagnostic>,
}

impl CheckReport {
    /// Adds the description of `file`, or its mistakes, and prints the description.
    fn add(&mut self, file: &Path, outcome: Result<String, Diagnostics>) -> Result<(), Failure> {
        match outcome {
            Ok(text) => self.add_entry(file, Some(text), Vec::new()),
            Err(mistakes) => self.add_entry(file, None, mistakes.0),
        }
    }

    /// Adds a body, which has a description even if a scene refuses the body, and prints the
    /// description.
    fn add_body(
        &mut self,
        file: &Path,
        outcome: Result<BodyDescription, Diagnostics>,
    ) -> Result<(), Failure> {
        match outcome {
            Ok(BodyDescription { text, mistakes }) => self.add_entry(file, Some(text), mistakes),
            Err(mistakes) => self.add_entry(file, None, mistakes.0),
        }
    }

    /// Adds the description `text` of `file` and its mistakes, and prints the description.
    fn add_entry(
        &mut self,
        file: &Path,
        text: Option<String>,
        mistakes: Vec<Diagnostic>,
    ) -> Result<(), Failure> {
        let file = input::message_path(file);
        if self.json {
            let values = describe::sheet_values_of(file);
            let holds = text.is_some() && mistakes.is_empty();
            let mistakes: Vec<Value> = mistakes.iter().map(as_json).collect();
            let mut entry =
                json!({ "file": file, "holds": holds, "text": text, "mistakes": mistakes });
            if let Some(values) = values {
                entry["values"] = json!(values);
            }
            self.entries.push(entry);
        } else if let Some(text) = text {
            say(format_args!("{}: {}", file.display(), text.trim_end()))?;
        }

        self.mistakes.extend(mistakes);
        Ok(())
    }

    /// Adds the estimated time of a run of the last scene that was added, and prints it.
    fn add_time(&mut self, time: String) -> Result<(), Failure> {
        if let Some(entry) = self.entries.last_mut() {
            entry["time"] = time.trim_start().into();
            return Ok(());
        }
        say(time)
    }
}

/// Returns `mistake` as JSON, for editors.
fn as_json(mistake: &Diagnostic) -> Value {
    let mistake = mistake.clone().in_words(remedy::in_words);
    let Diagnostic { file, key, line, column, message, help, subject, edits, .. } = &mistake;
    let key = key.as_ref().map(ToString::to_string);
    let subject = subject.iter().flat_map(Subject::names);
    let subject: Map<String, Value> =
        subject.map(|(kind, name)| (kind.to_owned(), name.into())).collect();
    let edits: Vec<Value> = edits
        .iter()
        .map(|Edit { file, key, old, new }| {
            json!({ "file": file, "key": key, "old": old, "new": new })
        })
        .collect();
    json!({
        "file": file, "key": key, "line": line, "column": column, "message": message,
        "help": help, "subject": subject, "edits": edits,
    })
}
