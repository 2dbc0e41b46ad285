//! Garments of a report: girths and ease from the summaries of runs.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape::frames::Recording;
use drape::input::Diagnostic;
use drape::report::{ReportedGarment, ReportedGirth};
use serde_json::Value;

use crate::failure::Failure;

/// File of a run that has the measures.
const SUMMARY: &str = "summary.json";

/// Largest summary that is read, in bytes: one with a hash for each of many steps is large.
const SUMMARY_MAX: u64 = 64 << 20;

/// Reads the garments of runs that have ended well.
pub(super) fn read(runs: &[PathBuf]) -> Result<Vec<ReportedGarment>, Failure> {
    let garments: Result<Vec<_>, Failure> = runs.iter().map(|run| of_run(run)).collect();
    Ok(garments?.concat())
}

/// Reads the garments of a run.
fn of_run(folder: &Path) -> Result<Vec<ReportedGarment>, Failure> {
    let recording = Recording::open(folder)?;
    let path = folder.join(SUMMARY);
    let refuse = |message: String, help: &str| {
        Failure::Input(Diagnostic::new(&path, message).help(help).into())
    };
    let size = std::fs::metadata(&path).map_or(0, |found| found.len());
    if size > SUMMARY_MAX {
        return Err(refuse(
            format!("has {size} bytes, too many for a summary"),
            "run the scene again",
        ));
    }
    let text = std::fs::read_to_string(&path)
        .map_err(|error| refuse(error.to_string(), "let the run end: drape resume FOLDER"))?;
    let summary: Value = serde_json::from_str(&text)
        .map_err(|error| refuse(format!("is no summary: {error}"), "run the scene again"))?;
    let status = summary["status"].as_str().unwrap_or_default();
    if status != "ok" {
        let help = "report a run that has ended well";
        return Err(refuse(format!("the run ended with \"{status}\""), help));
    }
    if summary["preview"] == Value::Bool(true) {
        return Err(refuse("the run is a preview".into(), "run the scene without --preview"));
    }
    let Some(garments) = summary["measures"]["girths"].as_object().filter(|own| !own.is_empty())
    else {
        let help = "a garment that is sewn on a body has some; run the scene again if it was run by an earlier version, \
                    or name heights in it: [garment.measure] waist = 1.08";
        return Err(refuse("has no girths of garments".into(), help));
    };
    let fabrics: BTreeSet<&str> =
        recording.manifest().panels.iter().map(|panel| panel.fabric.as_str()).collect();
    let named: Vec<String> = fabrics.iter().map(|name| format!("\"{name}\"")).collect();
    let source = format!(
        "Run {}, in the fabric {} of its scene; whether that is a fabric of this report is not checked.",
        folder.display(),
        named.join(", ")
    );
    let garment = |(name, places): (&String, &Value)| {
        let places = places.as_object().into_iter().flatten();
        let mut girths: Vec<ReportedGirth> =
            places.filter_map(|(place, row)| girth(place, row)).collect();
        girths.sort_by(|a, b| b.height.total_cmp(&a.height));
        ReportedGarment { name: name.clone(), source: source.clone(), girths }
    };
    Ok(garments.iter().map(garment).collect())
}

/// Returns the girths at a place, from its row in a summary.
fn girth(place: &str, row: &Value) -> Option<ReportedGirth> {
    let number = |key: &str| row[key].as_f64();
    let by_stature = (row["found_by"] == "stature").then(|| "height by the stature".to_owned());
    let reason = row["not_measured"].as_str().map(|reason| format!("no girth: {reason}"));
    let remarks: Vec<String> = by_stature.into_iter().chain(reason).collect();
    Some(ReportedGirth {
        place: place.to_owned(),
        height: number("height")?,
        garment_height: number("garment_height"),
        body: number("body")?,
        garment: number("garment"),
        pattern: number("pattern"),
        remark: remarks.join("; "),
    })
}
