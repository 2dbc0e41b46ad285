//! `drape check`: reads scenes, fabrics, sheets and patterns without simulating, and verifies the
//! frames of runs.
//!
//! [`describe`] says in SI what a file holds, [`pattern`] how a pattern is cut, [`start`] draws where
//! a garment starts, [`body`] says what a mesh is and how it is repaired; [`frames`] reads the
//! folders of runs by `drape::verify`, which shares no code with the simulation; [`pace`] says how long a run takes,
//! [`proposal`] tries the places that mistakes advise.

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

use self::body::Measure;
use self::describe::describe;
use self::pattern::{CutOut, Refused};
use crate::failure::Failure;
use crate::input;
use crate::say::{say, say_json};
use drape::run::file::{self, FileKind};

#[derive(Args)]
pub(crate) struct CheckArguments {
    /// Scenes, fabrics, sheets, patterns, bodies (OBJ, STL, PLY), or folders of runs; - for standard
    /// input. Or tables of a laboratory: a workbook, a .csv, a .zip, or a folder of exports.
    #[arg(required = true, value_name = "FILE")]
    pub(crate) files: Vec<PathBuf>,
    /// Draws the cut panels of a pattern (SVG), or a scene at its start (SVG or PNG): both sides of a
    /// seam in one colour, with a dot at the first stitch and an arrowhead in its direction. Where the
    /// check fails, what is wrong is red.
    #[arg(long, value_name = "SVG|PNG")]
    pub(crate) figure: Option<PathBuf>,
    /// Sets a key in place of its value in the files, as for `drape run`; may be given several times.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<Setting>,
    /// Distance between the particles of a cut pattern, or of the cloth on a body, in mm.
    #[arg(long, value_name = "MM", default_value_t = 10.0)]
    pub(crate) spacing: f64,
    /// Length of a unit of a body's file, in m [default: by its size, that of a person].
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
    /// Makes the first steps of scenes, for two seconds, and says how long a run takes at their pace.
    #[arg(long)]
    pub(crate) time: bool,
    /// Proposes no other place for a garment that is not about its body. Without it a place is looked for,
    /// and tried by a sewing at 30 mm of at most 10 s before it is printed.
    #[arg(long)]
    pub(crate) quick: bool,
    /// Prints what was found as JSON: of each file its mistakes, of each run its frames.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Executes `drape check`: reads all files, reports all mistakes together, then verifies the frames
/// of runs.
pub(crate) fn check(arguments: &CheckArguments) -> Result<(), Failure> {
    input::set_values(&arguments.set);
    let (runs, files): (Vec<&PathBuf>, Vec<&PathBuf>) =
        arguments.files.iter().partition(|file| frames::is_run(file));
    let spacing = 1e-3 * arguments.spacing;
    let mut checked = Checked { json: arguments.json, ..Checked::default() };
    let measure = Measure { scale: arguments.scale, spacing };
    if !(spacing > 0.0 && spacing < 1e3) || arguments.scale.is_some_and(|scale| !(scale > 0.0)) {
        return Err(Failure::Usage("--spacing (mm) and --scale (m) are above 0".into()));
    }
    if let Some(to) = &arguments.repair {
        let [mesh] = &files[..] else {
            return Err(Failure::Usage("--repair is for one body at a time".into()));
        };
        input::expect(mesh, &[FileKind::Body])?;
        file::refuse_existing(to, arguments.force, "replace it with --force")?;
        return say(body::mend(mesh, measure, to)?.trim_end());
    }
    match (&arguments.figure, &files[..]) {
        (Some(figure), [scene]) if describe::is_scene(scene) => {
            let found = start::draw(scene, figure)?;
            let found = found.map_err(|mistakes| proposal::tried(scene, mistakes, arguments.quick));
            checked.add(scene, found)?;
        }
        (Some(figure), [pattern]) => {
            input::expect(pattern, &[FileKind::Pattern, FileKind::Drawing, FileKind::Scene])?;
            let found = match CutOut::read_or_sketch(pattern, spacing) {
                Ok(cut) => {
                    start::write_flat(figure, Some(cut.figure()))?;
                    Ok(cut.describe())
                }
                // What is wrong is drawn as well.
                Err(Refused { mistakes, figure: drawn }) => {
                    start::write_flat(figure, drawn)?;
                    Err(mistakes)
                }
            };
            checked.add(pattern, found)?;
        }
        (Some(_), _) => {
            return Err(Failure::Usage("--figure is for one pattern or scene at a time".into()));
        }
        (None, files) => {
            for file in files {
                if body::is_mesh(file) {
                    checked.add_body(file, body::describe(file, measure))?;
                    continue;
                }
                let found = describe(file, spacing);
                let found =
                    found.map_err(|mistakes| proposal::tried(file, mistakes, arguments.quick));
                let is_right = found.is_ok();
                checked.add(file, found)?;
                if arguments.time && is_right && describe::is_scene(file) {
                    checked.add_time(pace::describe(file)?)?;
                }
            }
        }
    }
    if !arguments.json {
        Diagnostics::check(checked.mistakes)?;
        return frames::verify(&runs, false)?.outcome();
    }
    let verified = frames::verify(&runs, true)?;
    checked.found.extend(verified.found.iter().cloned());
    say_json(&checked.found)?;
    Diagnostics::check(checked.mistakes)?;
    verified.outcome()
}

/// Files that were checked.
#[derive(Default)]
struct Checked {
    json: bool,
    /// What was found, as JSON.
    found: Vec<Value>,
    mistakes: Vec<Diagnostic>,
}

impl Checked {
    /// Adds what was found in a file, and says it.
    fn add(&mut self, file: &Path, found: Result<String, Diagnostics>) -> Result<(), Failure> {
        match found {
            Ok(text) => self.add_found(file, Some(text), Vec::new()),
            Err(mistakes) => self.add_found(file, None, mistakes.0),
        }
    }

    /// Adds what was found of a body, which is described even where a scene refuses it, and says it.
    fn add_body(
        &mut self,
        file: &Path,
        found: Result<body::Found, Diagnostics>,
    ) -> Result<(), Failure> {
        match found {
            Ok(body::Found { text, mistakes }) => self.add_found(file, Some(text), mistakes),
            Err(mistakes) => self.add_found(file, None, mistakes.0),
        }
    }

    /// Adds the description of a file and its mistakes, and says the description.
    fn add_found(
        &mut self,
        file: &Path,
        text: Option<String>,
        mistakes: Vec<Diagnostic>,
    ) -> Result<(), Failure> {
        let file = input::message_path(file);
        if self.json {
            let values = describe::values_of(file);
            let holds = text.is_some() && mistakes.is_empty();
            let mistakes: Vec<Value> = mistakes.iter().map(as_json).collect();
            let mut found =
                json!({ "file": file, "holds": holds, "text": text, "mistakes": mistakes });
            if let Some(values) = values {
                found["values"] = json!(values);
            }
            self.found.push(found);
        } else if let Some(text) = text {
            say(format_args!("{}: {}", file.display(), text.trim_end()))?;
        }
        self.mistakes.extend(mistakes);
        Ok(())
    }

    /// Adds the time that a run of the scene takes that was added last, and says it.
    fn add_time(&mut self, time: String) -> Result<(), Failure> {
        if let Some(found) = self.found.last_mut() {
            found["time"] = time.trim_start().into();
            return Ok(());
        }
        say(time)
    }
}

/// Returns a mistake as JSON.
fn as_json(mistake: &Diagnostic) -> Value {
    let Diagnostic { file, line, column, message, help, subject, edits, .. } = mistake;
    let subject = subject.iter().flat_map(Subject::names);
    let subject: Map<String, Value> =
        subject.map(|(kind, name)| (kind.to_owned(), name.into())).collect();
    let edit = |Edit { file, key, old, new }: &Edit| json!({ "file": file, "key": key, "old": old, "new": new });
    json!({
        "file": file, "line": line, "column": column, "message": message, "help": help,
        "subject": subject, "edits": edits.iter().map(edit).collect::<Vec<Value>>(),
    })
}
