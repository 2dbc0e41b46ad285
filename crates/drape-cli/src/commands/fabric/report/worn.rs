//! Garments of a report: girths and ease, read from the summaries of runs.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape::frames::Recording;
use drape::input::Diagnostic;
use drape::report::{ReportedGarment, ReportedGirth};
use serde_json::{Map, Value};

use crate::failure::Failure;
use crate::input;

/// File of a run that holds the measures.
const SUMMARY: &str = "summary.json";

/// Largest summary that is read, in bytes. A summary with a hash for each of many steps is large.
const SUMMARY_MAX: u64 = 64 << 20;

/// Reads the garments of `runs` that have ended well.
pub(super) fn read(runs: &[PathBuf]) -> Result<Vec<ReportedGarment>, Failure> {
    let garments: Result<Vec<_>, Failure> = runs.iter().map(|run| garments_of(run)).collect();
    Ok(garments?.concat())
}

/// Reads the garments of the run in `folder`.
fn garments_of(folder: &Path) -> Result<Vec<ReportedGarment>, Failure> {
    input::tell_lost_process(folder);
    let recording = Recording::open(folder)?;
    let girths = read_girths(&folder.join(SUMMARY))?;

    // The report cannot know whether the run has one of its fabrics, so it names the run's fabrics.
    let fabrics: BTreeSet<&str> =
        recording.manifest().panels.iter().map(|panel| panel.fabric.as_str()).collect();
    let named: Vec<String> = fabrics.iter().map(|name| format!("\"{name}\"")).collect();
    let source = format!(
        "Run {}, in the fabric {} of its scene; whether that is a fabric of this report is not checked.",
        folder.display(),
        named.join(", ")
    );
    let garments = girths.into_iter().map(|(name, rows)| {
        let rows = rows.as_object().into_iter().flatten();
        let mut girths: Vec<ReportedGirth> =
            rows.filter_map(|(place, row)| girth(place, row)).collect();
        girths.sort_by(|a, b| b.height.total_cmp(&a.height));
        ReportedGarment { name, source: source.clone(), girths }
    });
    Ok(garments.collect())
}

/// Reads the girths of each garment from the summary at `path`, which must be of a complete run.
fn read_girths(path: &Path) -> Result<Map<String, Value>, Failure> {
    let size = std::fs::metadata(path).map_or(0, |metadata| metadata.len());
    if size > SUMMARY_MAX {
        let message = format!("has {size} bytes, too many for a summary");
        return Err(refusal(path, message, "run the scene again"));
    }
    let text = std::fs::read_to_string(path).map_err(|error| {
        refusal(path, error.to_string(), "let the run end: drape resume FOLDER")
    })?;
    let mut summary: Value = serde_json::from_str(&text)
        .map_err(|error| refusal(path, format!("is no summary: {error}"), "run the scene again"))?;

    let status = summary["status"].as_str().unwrap_or_default();
    if status != "ok" {
        let help = "report a run that has ended well";
        return Err(refusal(path, format!("the run ended with \"{status}\""), help));
    }
    if summary["preview"] == Value::Bool(true) {
        let help = "run the scene without --preview";
        return Err(refusal(path, "the run is a preview".into(), help));
    }

    let measures = summary.get_mut("measures");
    match measures.and_then(|measures| measures.get_mut("girths")).map(Value::take) {
        Some(Value::Object(girths)) if !girths.is_empty() => Ok(girths),
        _ => {
            let help = "a garment that is sewn on a body has some; run the scene again if it was run by an earlier version, \
                        or name heights in it: [garment.measure] waist = 1.08";
            Err(refusal(path, "has no girths of garments".into(), help))
        }
    }
}

/// Returns the failure for a summary that the report cannot use.
fn refusal(path: &Path, message: String, help: &str) -> Failure {
    Failure::Input(Diagnostic::new(path, message).help(help).into())
}

/// Returns the girths at `place` from its `row` in a summary, or `None` if the row has no height or
/// no girth of the body.
fn girth(place: &str, row: &Value) -> Option<ReportedGirth> {
    let [height, garment_height, body, garment, pattern] =
        ["height", "garment_height", "body", "garment", "pattern"].map(|key| row[key].as_f64());
    let by_stature = (row["found_by"] == "stature").then(|| "height by the stature".to_owned());
    let reason = row["not_measured"].as_str().map(|reason| format!("no girth: {reason}"));
    let remarks: Vec<String> = by_stature.into_iter().chain(reason).collect();
    Some(ReportedGirth {
        place: place.to_owned(),
        height: height?,
        garment_height,
        body: body?,
        garment,
        pattern,
        remark: remarks.join("; "),
    })
}
