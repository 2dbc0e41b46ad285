//! Frames of runs, read and verified pair by pair.

use std::path::{Path, PathBuf};

use drape::frames::{Recording, SurfacePart};
use drape::input::counted;
use drape::run::RunVerdict;
use drape::verify::{ClosePair, PartNumber, Verdict, Verifier};
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::input;
use crate::say::say;

/// Returns whether the folder `path` was written by a run, complete or not.
pub(crate) fn is_run(path: &Path) -> bool {
    let files = ["frame-00000.npy", "summary.json"];
    Recording::exists(path) || files.iter().any(|name| path.join(name).exists())
}

/// Verdicts on the frames of runs.
pub(crate) struct VerifiedRuns {
    /// An entry for each run, as JSON.
    pub(crate) entries: Vec<Value>,
    /// Files of the frames with intersections or pairs that are too close.
    broken: Vec<PathBuf>,
    /// The first run that failed, with its folder.
    failed: Option<(PathBuf, RunVerdict)>,
}

impl VerifiedRuns {
    /// Fails if a frame has intersections or pairs that are too close, with
    /// [`Failure::Intersecting`], or if a run failed, as the run did.
    pub(crate) fn outcome(&self) -> Result<(), Failure> {
        if let Some(first) = self.broken.first() {
            return Err(Failure::Intersecting(format!(
                "surfaces intersect or are too close in {}, first in {}",
                counted(self.broken.len(), "frame", "frames"),
                first.display()
            )));
        }
        let Some((folder, verdict)) = &self.failed else { return Ok(()) };
        let message = format!("{}: {}", folder.display(), describe_end(verdict));
        Err(if verdict.is_intersecting() {
            Failure::Intersecting(message)
        } else {
            Failure::Solver(message)
        })
    }
}

/// Verifies every frame in `folders`. With `json` the verdicts are only collected, otherwise each
/// is printed.
pub(crate) fn verify(folders: &[&PathBuf], json: bool) -> Result<VerifiedRuns, Failure> {
    let mut broken = Vec::new();
    let mut failed = None;
    let mut entries = Vec::new();
    for folder in folders {
        input::tell_lost_process(folder);
        let verifier = Verifier::open(folder)?;
        let recording = verifier.recording();
        // A damaged table of energies is told, although nothing of it is judged here.
        recording.energy()?;
        if !json {
            say(headline(folder, recording))?;
        }

        let mut verdicts = Vec::new();
        for number in 0..recording.frame_count() {
            let verdict = verifier.verify(number)?;
            if !json {
                say(describe(recording, &verdict))?;
            }
            if !verdict.holds() {
                broken.extend(verdict.file.clone());
            }
            verdicts.push(verdict);
        }

        let holds = verdicts.iter().all(Verdict::holds);
        let end = RunVerdict::read(folder);
        for warning in end.iter().flat_map(|end| &end.warnings).filter(|_| !json) {
            say(format_args!("warning: {warning}"))?;
        }
        let (guarded, ended) = (recording.manifest().surface_contact, recording.ended());
        entries.push(json!({
            "folder": folder, "holds": holds, "guarded": guarded, "ended": ended,
            "status": end.as_ref().map(|end| &end.status),
            "reason": end.as_ref().and_then(|end| end.reason.as_ref()),
            "warnings": end.as_ref().map(|end| &end.warnings),
            "panels": part_names(&recording.manifest().panels),
            "bodies": part_names(&recording.manifest().bodies),
            "frames": verdicts,
        }));
        let failed_end = end.filter(|end| !end.is_ok() && !end.is_interrupted());
        failed = failed.or(failed_end.map(|end| (folder.to_path_buf(), end)));
    }
    Ok(VerifiedRuns { entries, broken, failed })
}

/// Describes how a failed run ended.
fn describe_end(verdict: &RunVerdict) -> String {
    let reason = verdict.reason.as_ref().map_or(String::new(), |reason| format!(": {reason}"));
    format!("the run ended with the status \"{}\"{reason}", verdict.status)
}

fn part_names(parts: &[SurfacePart]) -> Vec<&str> {
    parts.iter().map(|part| part.name.as_str()).collect()
}

fn headline(folder: &Path, recording: &Recording) -> String {
    let manifest = recording.manifest();
    let promise = if manifest.surface_contact {
        "the run kept surfaces apart"
    } else {
        "contact was of particles only, so surfaces may intersect (contact.surfaces = false)"
    };
    let end = if recording.ended() { "" } else { "; the run is incomplete" };
    format!(
        "{}: {} of {} and {}, {} triangles; {promise}{end}",
        folder.display(),
        counted(recording.frame_count(), "frame", "frames"),
        counted(manifest.panels.len(), "panel", "panels"),
        counted(manifest.bodies.len(), "body", "bodies"),
        recording.topology().cloth.len() + recording.topology().bodies.len()
    )
}

/// Returns `distance`, in m, as millimetres.
fn millimetres(distance: f64) -> String {
    format!("{:.4} mm", 1e3 * distance)
}

/// Describes `verdict` on a frame of `recording`, with the worst pairs.
fn describe(recording: &Recording, verdict: &Verdict) -> String {
    let manifest = recording.manifest();
    let mut text = format!(
        "frame {:>5} at {:.4} s: {} triangles, {}, {}, smallest distance {}",
        verdict.number,
        verdict.time,
        verdict.triangles,
        counted(verdict.pairs, "pair", "pairs"),
        counted(verdict.intersections, "intersection", "intersections"),
        verdict.min_distance.map_or("beyond the activation distance".to_owned(), millimetres),
    );
    if verdict.exempt > 0 {
        text += &format!(
            ", {} at most {} deep within the gap of a seam that closes",
            counted(verdict.exempt, "intersection", "intersections"),
            millimetres(verdict.exempt_penetration)
        );
    }
    if verdict.growth < 1.0 {
        text += &format!(", minimum separations grown to {:.2} %", 100.0 * verdict.growth);
    }
    if verdict.too_near > 0 {
        let pairs = counted(verdict.too_near, "pair", "pairs");
        text += &format!(", {pairs} closer than the minimum separation");
    }
    if verdict.degenerate > 0 {
        let triangles = counted(verdict.degenerate, "triangle", "triangles");
        text += &format!(", {triangles} without area");
    }

    // A frame without faults shows its closest pair only.
    for piece in &verdict.enclosed {
        let [panel, body] = [&manifest.panels[piece.panel].name, &manifest.bodies[piece.body].name];
        let [x, y, z] = piece.point;
        text += &format!("\n  \"{panel}\" lies inside \"{body}\" near ({x:.5}, {y:.5}, {z:.5}) m");
    }
    let pair_count = if verdict.holds() { 1 } else { verdict.worst.len() };
    for pair in verdict.worst.iter().take(pair_count) {
        text += &format!("\n  {}", describe_pair(recording, pair));
    }
    text
}

fn describe_pair(recording: &Recording, pair: &ClosePair) -> String {
    let manifest = recording.manifest();
    let [x, y, z] = pair.point;
    let [first, second] = [0, 1].map(|k| {
        let name = match pair.parts[k] {
            PartNumber::Panel(number) => &manifest.panels[number].name,
            PartNumber::Body(number) => &manifest.bodies[number].name,
        };
        format!("triangle {} of \"{name}\"", pair.triangles[k])
    });
    let relation = match pair.distance {
        0.0 => "intersect".to_owned(),
        distance => format!(
            "are {:.4} mm apart, where {:.4} mm is the minimum,",
            1e3 * distance,
            1e3 * pair.min_separation
        ),
    };
    format!("{first} and {second} {relation} near ({x:.5}, {y:.5}, {z:.5}) m")
}
