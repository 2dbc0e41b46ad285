//! Proposals: positions of garments that mistakes of a scene propose. Each position is tried by a
//! short sewing before it is printed.
//!
//! `drape check` and `drape run` pass the mistakes of a refused scene to [`with_trials`] and print
//! the returned mistakes.

use std::path::Path;
use std::time::{Duration, Instant};

use drape::dynamics::{PhaseName, Progress, Simulation, Status, Step};
use drape::input::{Diagnostic, Diagnostics, Document, Edit, Setting};
use drape::scene::{Error, Scene, SceneSpec};
use indicatif::ProgressBar;

use crate::console::progress::bar;
use crate::console::signal;
use crate::input;
use crate::remedy;

/// Spacing of the cloth of a trial, in m. At this spacing a shirt is sewn in some seconds.
const SPACING: f64 = 0.03;

/// Longest duration of a trial.
const LIMIT: Duration = Duration::from_secs(10);

/// Outcome of a trial.
enum TrialOutcome {
    /// All seams were closed.
    Sewn,
    /// The scene has mistakes at the proposed position as well, or its seams stay open. The text is
    /// the reason.
    Failed(String),
    /// The sewing did not end in time, or could not be tried. The text is the reason.
    Open(String),
}

/// Returns the mistakes of `scene` with the result of a trial of the proposed positions. With
/// `quick` there is no trial and no proposal.
pub(crate) fn with_trials(scene: &Path, mistakes: Diagnostics, quick: bool) -> Diagnostics {
    let centers: Vec<Edit> = mistakes.0.iter().filter_map(proposed_center).cloned().collect();
    if centers.is_empty() {
        return mistakes;
    }

    let outcome = (!quick).then(|| try_centers(scene, &centers));
    let judged = mistakes.0.into_iter().map(|mistake| match proposed_center(&mistake).cloned() {
        Some(edit) => with_outcome(mistake, &edit, outcome.as_ref()),
        None => mistake,
    });
    Diagnostics(judged.collect())
}

/// Returns the edit of a garment's center that `mistake` proposes.
fn proposed_center(mistake: &Diagnostic) -> Option<&Edit> {
    let mut edits = mistake.edits.iter();
    edits.find(|edit| edit.key.starts_with("garment[") && edit.key.ends_with(".center"))
}

/// Adds the `outcome` of the trial to the help of `mistake`. The edit of a position that failed is
/// removed, because it is no remedy.
fn with_outcome(mistake: Diagnostic, edit: &Edit, outcome: Option<&TrialOutcome>) -> Diagnostic {
    let center = edit.new.as_deref().unwrap_or_default();
    let mistake = mistake.in_words(remedy::in_words);
    let proposal = mistake.help.clone().unwrap_or_default();
    let help = match outcome {
        None => {
            "give its [[garment]] a center about the body; without --quick a place is looked for \
                 and tried"
                .into()
        }
        Some(TrialOutcome::Sewn) => {
            format!("{proposal}, and a short sewing at 30 mm closes its seams")
        }
        Some(TrialOutcome::Open(reason)) => format!("{proposal}; {reason}"),
        Some(TrialOutcome::Failed(reason)) => format!(
            "no place was found at which it is sewn: at center = {center} a short sewing at 30 mm fails \
             ({reason}); does the pattern fit the body? turn or move its panels"
        ),
    };

    let is_remedy = matches!(outcome, Some(TrialOutcome::Sewn | TrialOutcome::Open(_)));
    let edits = if is_remedy { mistake.edits } else { Vec::new() };
    Diagnostic { help: Some(help), edits, ..mistake }
}

/// Sews the scene at `path` at the spacing of a trial, with its garments at `centers`.
fn try_centers(path: &Path, centers: &[Edit]) -> TrialOutcome {
    let begin = Instant::now();
    let moved = input::document(path).and_then(|document| with_centers(document, centers));
    let document = match moved {
        Ok(document) => document,
        Err(mistakes) => {
            return TrialOutcome::Open(format!("not tried: {}", first_message(&mistakes)));
        }
    };

    if let Err(mistakes) = scene(&document) {
        return TrialOutcome::Failed(first_message(&mistakes));
    }
    match coarse(&document).and_then(|document| scene(&document)) {
        Ok(scene) => sew(scene, begin),
        Err(mistakes) => {
            TrialOutcome::Open(format!("not tried at 30 mm: {}", first_message(&mistakes)))
        }
    }
}

/// Returns the `document` of a scene with its garments at `centers`.
fn with_centers(document: Document, centers: &[Edit]) -> Result<Document, Diagnostics> {
    let settings = centers.iter().filter_map(|edit| {
        let key = edit.key.replace('[', ".").replace(']', "");
        Setting::new(&key, edit.new.as_deref()?).ok()
    });
    document.with_settings(&settings.collect::<Vec<_>>())
}

/// Returns the `document` of a scene at the spacing of a trial, if the scene is finer.
fn coarse(document: &Document) -> Result<Document, Diagnostics> {
    let spacings = SceneSpec::from_document(document)?.spacings();
    let finest = spacings.iter().map(|spacing| spacing.value).fold(f64::INFINITY, f64::min);
    let factor = (SPACING / finest).max(1.0);
    let settings: Vec<Setting> = spacings.iter().map(|spacing| spacing.scaled(factor)).collect();
    document.clone().with_settings(&settings)
}

/// Builds the scene of `document`, without coarser grids.
fn scene(document: &Document) -> Result<Scene, Diagnostics> {
    let scene = drape::run::scene_of(document).map_err(|error| match error {
        Error::Input(mistakes) => mistakes,
        Error::Tangled(tangle) => tangle.mistakes,
        error => Diagnostic::new(document.path(), error.to_string()).into(),
    })?;
    Ok(Scene { coarser: Vec::new(), ..scene })
}

/// Sews `scene` until its seams are closed or the [`LIMIT`] since `begin` is reached.
fn sew(scene: Scene, begin: Instant) -> TrialOutcome {
    let bar = bar(LIMIT.as_millis() as u64, "trying another place by a short sewing");
    let mut sewing = Sewing { begin, bar, is_sewn: false };
    let ended = Simulation::new(scene).and_then(|mut simulation| simulation.run(&mut sewing));
    sewing.bar.finish_and_clear();
    match ended {
        _ if sewing.is_sewn => TrialOutcome::Sewn,
        Err(error) => TrialOutcome::Failed(error.to_string()),
        Ok(summary) if sewing.is_interrupted() || summary.status == Status::Ok => {
            let seconds = sewing.begin.elapsed().as_secs_f64();
            TrialOutcome::Open(format!("a sewing at 30 mm was not over there after {seconds:.0} s"))
        }
        Ok(summary) => {
            TrialOutcome::Failed(summary.reason.unwrap_or_else(|| "it ends early".into()))
        }
    }
}

/// Progress of the sewing of a trial.
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

/// Returns the message of the first of `mistakes`.
fn first_message(mistakes: &Diagnostics) -> String {
    mistakes.0.first().map_or_else(String::new, |mistake| mistake.message.clone())
}
