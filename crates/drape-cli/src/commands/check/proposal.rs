//! Proposals: places of garments that mistakes of a scene advise. Each is tried by a short sewing before
//! it is printed.
//!
//! `drape check` and `drape run` hand on what a scene is refused for, and print what comes back.

use std::path::Path;
use std::time::{Duration, Instant};

use drape::dynamics::{PhaseName, Progress, Simulation, Status, Step};
use drape::input::{Diagnostic, Diagnostics, Document, Edit, Setting};
use drape::scene::{Error, Scene, spacings};
use indicatif::ProgressBar;

use crate::console::progress::bar;
use crate::console::signal;
use crate::input;

/// Spacing of the cloth of a trial, in m: the sewing of a shirt takes some seconds.
const SPACING: f64 = 0.03;

/// Longest duration of a trial.
const LIMIT: Duration = Duration::from_secs(10);

/// Outcome of a trial.
enum Outcome {
    /// All seams were closed.
    Sewn,
    /// The scene is refused there as well, or it is not sewn.
    Failed(String),
    /// The sewing was not over in time, or it cannot be tried.
    Open(String),
}

/// Returns the mistakes of a scene with the places that they advise tried; or without these, to be quick.
pub(crate) fn tried(scene: &Path, mistakes: Diagnostics, quick: bool) -> Diagnostics {
    let places: Vec<Edit> = mistakes.0.iter().filter_map(place).cloned().collect();
    if places.is_empty() {
        return mistakes;
    }
    let outcome = (!quick).then(|| try_out(scene, &places));
    let told = mistakes.0.into_iter().map(|mistake| match place(&mistake).cloned() {
        Some(edit) => tell(mistake, &edit, outcome.as_ref()),
        None => mistake,
    });
    Diagnostics(told.collect())
}

/// Returns the place of a garment that a mistake advises.
fn place(mistake: &Diagnostic) -> Option<&Edit> {
    let is_place = |edit: &&Edit| edit.key.starts_with("garment[") && edit.key.ends_with(".center");
    mistake.edits.iter().find(is_place)
}

/// Tells of the outcome of a trial, if there was one; a place that failed is no remedy.
fn tell(mistake: Diagnostic, edit: &Edit, outcome: Option<&Outcome>) -> Diagnostic {
    let center = edit.new.as_deref().unwrap_or_default();
    let known = mistake.help.clone().unwrap_or_default();
    let help = match outcome {
        None => {
            "give its [[garment]] a center about the body; without --quick a place is looked for \
                 and tried"
                .into()
        }
        Some(Outcome::Sewn) => format!("{known}, and a short sewing at 30 mm closes its seams"),
        Some(Outcome::Open(reason)) => format!("{known}; {reason}"),
        Some(Outcome::Failed(reason)) => format!(
            "no place was found at which it is sewn: at center = {center} a short sewing at 30 mm fails \
             ({reason}); does the pattern fit the body? turn or move its panels"
        ),
    };
    let holds = matches!(outcome, Some(Outcome::Sewn | Outcome::Open(_)));
    let edits = if holds { mistake.edits } else { Vec::new() };
    Diagnostic { help: Some(help), edits, ..mistake }
}

/// Sews a scene at the spacing of a trial, with its garments at some places.
fn try_out(path: &Path, places: &[Edit]) -> Outcome {
    let begin = Instant::now();
    let read = input::document(path).and_then(|document| placed(document, places));
    let document = match read {
        Ok(document) => document,
        Err(mistakes) => return Outcome::Open(format!("not tried: {}", first(&mistakes))),
    };
    if let Err(mistakes) = scene(&document) {
        return Outcome::Failed(first(&mistakes));
    }
    match coarse(&document).and_then(|document| scene(&document)) {
        Ok(scene) => sew(scene, begin),
        Err(mistakes) => Outcome::Open(format!("not tried at 30 mm: {}", first(&mistakes))),
    }
}

/// Returns the document of a scene with its garments at some places.
fn placed(document: Document, places: &[Edit]) -> Result<Document, Diagnostics> {
    let setting = |edit: &Edit| {
        let key = edit.key.replace('[', ".").replace(']', "");
        Setting::new(&key, edit.new.as_deref()?).ok()
    };
    document.with_settings(&places.iter().filter_map(setting).collect::<Vec<_>>())
}

/// Returns the document of a scene at the spacing of a trial, if its own is finer.
fn coarse(document: &Document) -> Result<Document, Diagnostics> {
    let all = spacings(document)?;
    let finest = all.iter().map(|own| own.value).fold(f64::INFINITY, f64::min);
    let factor = (SPACING / finest).max(1.0);
    let settings: Vec<Setting> = all.iter().map(|own| own.scaled(factor)).collect();
    document.clone().with_settings(&settings)
}

/// Makes a scene, without coarser grids.
fn scene(document: &Document) -> Result<Scene, Diagnostics> {
    let scene = drape::run::scene_of(document).map_err(|error| match error {
        Error::Input(mistakes) => mistakes,
        Error::Tangled(tangle) => tangle.mistakes,
        other => Diagnostic::new(document.path(), other.to_string()).into(),
    })?;
    Ok(Scene { coarser: Vec::new(), ..scene })
}

/// Sews a scene, until its seams are closed or the time is over.
fn sew(scene: Scene, begin: Instant) -> Outcome {
    let bar = bar(LIMIT.as_millis() as u64, "trying another place by a short sewing");
    let mut sewing = Sewing { begin, bar, is_sewn: false };
    let ended = Simulation::new(scene).and_then(|mut simulation| simulation.run(&mut sewing));
    sewing.bar.finish_and_clear();
    match ended {
        _ if sewing.is_sewn => Outcome::Sewn,
        Err(error) => Outcome::Failed(error.to_string()),
        Ok(summary) if sewing.is_interrupted() || summary.status == Status::Ok => {
            let seconds = sewing.begin.elapsed().as_secs_f64();
            Outcome::Open(format!("a sewing at 30 mm was not over there after {seconds:.0} s"))
        }
        Ok(summary) => Outcome::Failed(summary.reason.unwrap_or_else(|| "it ends early".into())),
    }
}

/// Progress of a sewing.
struct Sewing {
    begin: Instant,
    bar: ProgressBar,
    is_sewn: bool,
}

impl Progress for Sewing {
    fn step(&mut self, step: &Step, _: usize) {
        self.is_sewn |= step.phase != PhaseName::Sew;
        self.bar.set_position(self.begin.elapsed().as_millis() as u64);
    }

    fn is_interrupted(&self) -> bool {
        self.is_sewn || self.begin.elapsed() >= LIMIT || signal::received().is_some()
    }
}

/// Returns the message of the first mistake.
fn first(mistakes: &Diagnostics) -> String {
    mistakes.0.first().map_or_else(String::new, |mistake| mistake.message.clone())
}
