//! Result of a run in words: a summary, and the failure with its remedy.

use std::path::Path;

use drape::dynamics::{Contacts, Energy, PhaseName, Status, Summary};
use drape::input::counted;
use serde_json::Value;

use crate::console::signal;
use crate::failure::Failure;

/// Describes `summary` in a few lines.
pub(crate) fn describe(summary: &Summary) -> String {
    let Summary { energy, strain, contact, .. } = summary;
    let relaxes = summary.phases.last().is_some_and(|phase| phase.name == PhaseName::Relax);
    let rest = if !summary.settled {
        "moving"
    } else if relaxes {
        "at rest"
    } else {
        "moving again after rest"
    };

    let cpu = summary.cpu_seconds.map_or(String::new(), |cpu| format!(", {cpu:.1} s of processor"));
    let smallest =
        contact.min_distance.map_or("none near".into(), |d| format!("{:.3} mm", 1e3 * d));
    format!(
        "{} particles, {} steps, {:.3} s simulated in {:.1} s{cpu}\n\
         {rest}, fastest particle {:.2} mm/s\n\
         strain: largest {:.2} %, 99 of 100 below {:.2} %; shear up to {:.1}°; \
         99 of 100 curvatures below {:.0} 1/m\n\
         contact: smallest distance {smallest}, {} or particles inside{}{}{}{}{}",
        summary.particles,
        summary.steps,
        summary.simulated_seconds,
        summary.wall_seconds,
        1e3 * summary.speed_max,
        100.0 * strain.traction_max,
        100.0 * strain.traction_p99,
        strain.shear_max.to_degrees(),
        strain.curvature_p99,
        counted(contact.intersections, "intersection", "intersections"),
        exempt(contact),
        pinched(contact),
        grown(contact),
        energy.as_ref().map_or(String::new(), balance),
        girths(summary),
    )
}

/// Describes the girth and ease of each garment, in mm, from the top to the bottom.
fn girths(summary: &Summary) -> String {
    let garments = summary.measures.get("girths").and_then(Value::as_object);
    let lines = garments.into_iter().flatten().map(|(name, rows)| {
        let mut rows: Vec<_> = rows.as_object().into_iter().flatten().collect();
        rows.sort_by(|a, b| {
            let [first, second] = [a, b].map(|row| row.1["height"].as_f64().unwrap_or_default());
            second.total_cmp(&first)
        });
        let girths: Vec<String> = rows.into_iter().map(|(place, row)| girth(place, row)).collect();
        format!("\nease of \"{name}\": {}", girths.join(", "))
    });
    lines.collect()
}

/// Describes the girth at `place`, in mm, from its `row` in the summary.
fn girth(place: &str, row: &Value) -> String {
    if let Some(reason) = row["not_measured"].as_str() {
        return format!("{place} not measured ({reason})");
    }
    // The ease is the difference of the rounded girths, so that the printed numbers agree.
    let [garment, body] = [&row["garment"], &row["body"]]
        .map(|value| (1e3 * value.as_f64().unwrap_or_default()).round());
    format!("{place} {} mm (garment {garment}, body {body})", garment - body)
}

/// Describes the intersections of closing seams, which `contact` exempts.
fn exempt(contact: &Contacts) -> String {
    if contact.exempt_max == 0 {
        return String::new();
    }
    format!(
        "; while seams closed, up to {} of their sides, at most {:.4} mm deep, and {} at the end",
        counted(contact.exempt_max, "intersection", "intersections"),
        1e3 * contact.exempt_penetration_max,
        contact.exempt
    )
}

/// Describes cloth that was pinched by bodies, from `contact`.
fn pinched(contact: &Contacts) -> String {
    let thinned = match contact.thinned_max {
        0 => String::new(),
        count => format!(
            "; up to {count} particles were pinched, with a tenth of their minimum separation \
             from bodies"
        ),
    };
    match contact.released_max {
        0 => thinned,
        count => format!(
            "{thinned}; up to {count} particles were pinched and released, where cloth and bodies \
             may intersect"
        ),
    }
}

/// Describes minimum separations that were smaller at the start of the run, from `contact`.
fn grown(contact: &Contacts) -> String {
    if contact.start_growth_fraction == 1.0 {
        return String::new();
    }
    let [from, to] =
        [contact.start_growth_fraction, contact.growth_fraction].map(|fraction| 100.0 * fraction);
    format!("; minimum separations were {from:.2} % at the start and {to:.2} % at the end")
}

/// Describes the balance of `energy`, in J.
fn balance(energy: &Energy) -> String {
    let relaxation = if energy.relaxation_dissipated == 0.0 {
        String::new()
    } else {
        format!(
            ", to the relaxation, which brings cloth to rest without swinging, {:.4} J",
            energy.relaxation_dissipated
        )
    };
    let released = if energy.pinch_released == 0.0 {
        String::new()
    } else {
        format!(", from pinched cloth {:.4} J", energy.pinch_released)
    };
    let share = if energy.exchanged > 0.0 {
        format!(
            ", {:.2} % of what was exchanged",
            100.0 * energy.integration_loss() / energy.exchanged
        )
    } else {
        String::new()
    };
    let unaccounted = if energy.proved > 0.0 {
        format!(
            "unaccounted for {:.0e} J, {:.0e} of what was measured",
            energy.residual,
            energy.unaccounted_fraction()
        )
    } else {
        "the balance was not measured, because no step was in the sample".to_owned()
    };
    format!(
        "\nenergy: gravity gave {:.4} J; elastic {:+.4} J, kinetic {:.1e} J; lost in the fabric \
         {:.4} J, on bodies {:.4} J, of cloth on cloth {:.4} J, to the air {:.4} J{released}{relaxation}, \
         in the integration {:.4} J{share}; {unaccounted}",
        -energy.gravity,
        energy.elastic + energy.contact,
        energy.kinetic,
        energy.friction_dissipated,
        energy.body_dissipated,
        energy.cloth_dissipated,
        energy.air_dissipated,
        energy.integration_loss(),
    )
}

/// Returns the failure with which a run ended, and its remedy. `folder` is the folder of the
/// results.
pub(crate) fn outcome(summary: Summary, folder: &Path) -> Result<(), Failure> {
    let run_folder = folder.display();
    let picture_hint =
        if folder.join("place.png").is_file() { ", and place.png shows the seam" } else { "" };

    match summary.status {
        Status::Ok => Ok(()),
        Status::DidNotSettle if summary.reason.is_some() => Err(Failure::Solver(format!(
            "the cloth did not come to rest in {} s: {}, and nothing holds it there; pin it, take it in, or raise the \
             friction of the body",
            summary.simulated_seconds,
            summary.reason.unwrap_or_default()
        ))),
        Status::DidNotSettle => Err(Failure::Solver(format!(
            "the cloth did not come to rest in {} s: its fastest particle moves at {:.1} mm/s, and \
             its forces are {:.1e} g out of balance; give it more time (time.end), or accept more \
             (settle.speed, settle.residual)",
            summary.simulated_seconds,
            1e3 * summary.speed_max,
            summary.imbalance
        ))),
        Status::SeamsOpen => Err(Failure::Solver(format!(
            "{}; something keeps its sides apart, or sew.seconds is too short; the last state was \
             written{picture_hint}",
            summary.reason.unwrap_or_default()
        ))),
        Status::FellOff => Err(Failure::Solver(format!(
            "{}; pin it, take it in, put a body below it, or raise the friction of the body; the last state was \
             written",
            summary.reason.unwrap_or_default()
        ))),
        Status::HeldTogether => Err(Failure::Solver(format!(
            "{}; something presses them together, or contact.grow is too short; the last state \
             was written",
            summary.reason.unwrap_or_default()
        ))),
        Status::Unbalanced => Err(Failure::Solver(format!(
            "{}; the frames were written. This is a mistake of the program unless forces come from elsewhere; \
             please report it with the scene",
            summary.reason.unwrap_or_default()
        ))),
        Status::Intersecting if summary.contact.intersections_max > 0 => {
            Err(Failure::Intersecting(format!(
                "{}; the frames were written",
                summary.reason.unwrap_or_default()
            )))
        }
        Status::Intersecting => Err(Failure::Intersecting(format!(
            "the step after {} s makes surfaces intersect, even at its shortest length; the last \
             good state was written",
            summary.simulated_seconds
        ))),
        Status::Interrupted if summary.reason.is_some() => Err(Failure::Stopped(format!(
            "ended at {:.4} s by {}; go on with `drape resume {run_folder}`",
            summary.simulated_seconds,
            summary.reason.unwrap_or_default()
        ))),
        Status::Interrupted => Err(Failure::Interrupted {
            signal: signal::received().unwrap_or_default(),
            message: format!(
                "interrupted at {:.4} s; go on with `drape resume {run_folder}`",
                summary.simulated_seconds
            ),
        }),
        Status::SolverFailed => Err(Failure::Solver(format!(
            "the step after {} s could not be solved; the last good state was written{picture_hint}: {}",
            summary.simulated_seconds,
            summary.reason.unwrap_or_default()
        ))),
    }
}
