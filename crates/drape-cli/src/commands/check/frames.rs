//! Frames of runs, read and verified pair by pair.

use std::path::{Path, PathBuf};

use drape::frames::{Recording, SurfacePart};
use drape::verify::{ClosePair, PartNumber, Verdict, Verifier};
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::say::say;

/// Returns whether a folder was written by a run, complete or not.
pub(crate) fn is_run(path: &Path) -> bool {
    let has = |name: &str| path.join(name).exists();
    Recording::exists(path)
        || has("frame-00000.obj")
        || has("frame-00000.npy")
        || has("summary.json")
}

/// Runs that were verified.
pub(crate) struct Verified {
    /// What was found, as JSON, one entry a run.
    pub(crate) found: Vec<Value>,
    /// Files of the frames that do not hold.
    broken: Vec<PathBuf>,
}

impl Verified {
    /// Fails if a frame does not hold.
    pub(crate) fn outcome(&self) -> Result<(), Failure> {
        match self.broken.first() {
            None => Ok(()),
            Some(first) => Err(Failure::Intersecting(format!(
                "surfaces intersect or are too close in {} frames, first in {}",
                self.broken.len(),
                first.display()
            ))),
        }
    }
}

/// Verifies every frame of the folders, and says what it finds unless that is printed as JSON.
pub(crate) fn verify(folders: &[&PathBuf], json: bool) -> Result<Verified, Failure> {
    let mut broken = Vec::new();
    let mut found = Vec::new();
    for folder in folders {
        let verifier = Verifier::open(folder)?;
        let recording = verifier.recording();
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
                broken.push(verdict.file.clone());
            }
            verdicts.push(verdict);
        }
        let holds = verdicts.iter().all(Verdict::holds);
        let (guarded, ended) = (recording.manifest().surface_contact, recording.ended());
        let names = |part: &SurfacePart| part.name.clone();
        found.push(json!({
            "folder": folder, "holds": holds, "guarded": guarded, "ended": ended,
            "panels": recording.manifest().panels.iter().map(names).collect::<Vec<_>>(),
            "bodies": recording.manifest().bodies.iter().map(names).collect::<Vec<_>>(),
            "frames": verdicts,
        }));
    }
    Ok(Verified { found, broken })
}

fn headline(folder: &Path, recording: &Recording) -> String {
    let manifest = recording.manifest();
    let promise = match manifest.surface_contact {
        true => "the run kept surfaces apart",
        false => {
            "contact was of particles only, so surfaces may intersect (contact.surfaces = false)"
        }
    };
    let end = if recording.ended() { "" } else { "; the run is incomplete" };
    format!(
        "{}: {} frames of {} panels and {} bodies, {} triangles; {promise}{end}",
        folder.display(),
        recording.frame_count(),
        manifest.panels.len(),
        manifest.bodies.len(),
        recording.topology().cloth.len() + recording.topology().bodies.len()
    )
}

fn describe(recording: &Recording, verdict: &Verdict) -> String {
    let manifest = recording.manifest();
    let millimetres = |distance: f64| format!("{:.4} mm", 1e3 * distance);
    let mut text = format!(
        "frame {:>5}{}: {} triangles, {} pairs, {} intersections, smallest distance {}",
        verdict.number,
        verdict.time.map_or(String::new(), |time| format!(" at {time:.4} s")),
        verdict.triangles,
        verdict.pairs,
        verdict.intersections,
        verdict.min_distance.map_or("beyond the activation distance".to_owned(), millimetres),
    );
    if verdict.exempt > 0 {
        text += &format!(
            ", {} intersections at most {} deep within the gap of a seam that closes",
            verdict.exempt,
            millimetres(verdict.exempt_depth)
        );
    }
    if verdict.growth < 1.0 {
        text += &format!(", minimum separations grown to {:.2} %", 100.0 * verdict.growth);
    }
    for (count, what) in [
        (verdict.too_near, "pairs closer than the minimum separation"),
        (verdict.degenerate, "triangles without area"),
    ] {
        if count > 0 {
            text += &format!(", {count} {what}");
        }
    }
    for piece in &verdict.enclosed {
        let [panel, body] = [&manifest.panels[piece.panel].name, &manifest.bodies[piece.body].name];
        let [x, y, z] = piece.point;
        text += &format!("\n  \"{panel}\" lies inside \"{body}\" near ({x:.5}, {y:.5}, {z:.5}) m");
    }
    let shown = if verdict.holds() { 1 } else { verdict.worst.len() };
    for place in verdict.worst.iter().take(shown) {
        text += &format!("\n  {}", describe_place(recording, place));
    }
    text
}

fn describe_place(recording: &Recording, place: &ClosePair) -> String {
    let manifest = recording.manifest();
    let name = |part: PartNumber| match part {
        PartNumber::Panel(number) => &manifest.panels[number].name,
        PartNumber::Body(number) => &manifest.bodies[number].name,
    };
    let [x, y, z] = place.point;
    let [one, other] =
        [0, 1].map(|k| format!("triangle {} of \"{}\"", place.triangles[k], name(place.parts[k])));
    let how = match place.distance {
        0.0 => "intersect".to_owned(),
        distance => format!(
            "are {:.4} mm apart, where {:.4} mm is the minimum,",
            1e3 * distance,
            1e3 * place.min_separation
        ),
    };
    format!("{one} and {other} {how} near ({x:.5}, {y:.5}, {z:.5}) m")
}
