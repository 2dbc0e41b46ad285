//! Result of a run in words: what came out, and what failed with its remedy.

use std::path::Path;

use drape::dynamics::{Contacts, Energy, PhaseName, Status, Summary};
use serde_json::Value;

use crate::console::signal;
use crate::failure::Failure;

/// Describes a run in a few lines.
pub(crate) fn describe(summary: &Summary) -> String {
    let Summary { energy, strain, contact, .. } = summary;
    let relaxes = summary.phases.last().is_some_and(|phase| phase.name == PhaseName::Relax);
    let rest = match (summary.settled, relaxes) {
        (true, true) => "at rest",
        (true, false) => "moving again after rest",
        (false, _) => "moving",
    };
    let cpu = summary.cpu_seconds.map_or(String::new(), |cpu| format!(", {cpu:.1} s of processor"));
    let smallest =
        contact.min_distance.map_or("none near".into(), |d| format!("{:.3} mm", 1e3 * d));
    format!(
        "{} particles, {} steps, {:.3} s simulated in {:.1} s{cpu}\n\
         {rest}, fastest particle {:.2} mm/s\n\
         strain: largest {:.2} %, 99 of 100 below {:.2} %; shear up to {:.1}°; \
         99 of 100 curvatures below {:.0} 1/m\n\
         contact: smallest distance {smallest}, {} intersections or particles inside{}{}{}{}{}",
        summary.particles,
        summary.steps,
        summary.simulated_seconds,
        summary.wall_seconds,
        1e3 * summary.speed_max,
        100.0 * strain.traction_max,
        100.0 * strain.traction_p99,
        strain.shear_max.to_degrees(),
        strain.curvature_p99,
        contact.intersections,
        exempt(contact),
        pinched(contact),
        grown(contact),
        energy.as_ref().map_or(String::new(), balance),
        girths(summary),
    )
}

/// Describes girth and ease of each garment, in mm.
fn girths(summary: &Summary) -> String {
    let garments = summary.measures.get("girths").and_then(Value::as_object);
    let whole = |value: &Value| (1e3 * value.as_f64().unwrap_or_default()).round();
    let place = |(name, row): (&String, &Value)| match row["not_measured"].as_str() {
        Some(reason) => format!("{name} not measured ({reason})"),
        // The ease is the difference of the girths that are shown.
        None => {
            let [garment, body] = [&row["garment"], &row["body"]].map(whole);
            format!("{name} {} mm (garment {garment}, body {body})", garment - body)
        }
    };
    let line = |(name, places): (&String, &Value)| {
        let mut places: Vec<_> = places.as_object().into_iter().flatten().collect();
        let height = |row: &Value| row["height"].as_f64().unwrap_or_default();
        places.sort_by(|a, b| height(b.1).total_cmp(&height(a.1)));
        let places: Vec<String> = places.into_iter().map(place).collect();
        format!("\nease of \"{name}\": {}", places.join(", "))
    };
    garments.into_iter().flatten().map(line).collect()
}

/// Describes intersections of closing seams.
fn exempt(contact: &Contacts) -> String {
    if contact.exempt_max == 0 {
        return String::new();
    }
    format!(
        "; while seams closed, up to {} intersections of their sides, at most {:.4} mm deep, and {} \
         at the end",
        contact.exempt_max,
        1e3 * contact.exempt_depth_max,
        contact.exempt
    )
}

/// Describes cloth that bodies pinched.
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

/// Describes minimum separations that have grown.
fn grown(contact: &Contacts) -> String {
    if contact.start_growth_fraction == 1.0 {
        return String::new();
    }
    let [from, to] =
        [contact.start_growth_fraction, contact.growth_fraction].map(|part| 100.0 * part);
    format!("; minimum separations were {from:.2} % at the start and {to:.2} % at the end")
}

/// Describes the balance of the energy.
fn balance(energy: &Energy) -> String {
    let integration = energy.numerical_dissipated + energy.rotation_dissipated;
    let given = (-energy.gravity).max(0.0) + energy.work_in.max(0.0);
    let share = match given > 0.0 {
        true => format!(", {:.1} % of what came in", 100.0 * integration / given),
        false => String::new(),
    };
    format!(
        "\nenergy: gravity gave {:.4} J; elastic {:+.4} J, kinetic {:.1e} J; lost in the fabric \
         {:.4} J, on bodies {:.4} J, of cloth on cloth {:.4} J, to the air {:.4} J, in the integration {:.4} J{share}; \
         unaccounted for {:.0e} J",
        -energy.gravity,
        energy.elastic + energy.contact,
        energy.kinetic,
        energy.friction_dissipated,
        energy.body_dissipated,
        energy.cloth_dissipated,
        energy.air_dissipated,
        integration,
        energy.residual,
    )
}

/// Returns the failure that a run ended with, if any, and its remedy.
pub(crate) fn outcome(summary: Summary, folder: &Path) -> Result<(), Failure> {
    let place = folder.display();
    let shown = match folder.join("place.png").is_file() {
        true => ", and place.png shows the seam",
        false => "",
    };
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
             written{shown}",
            summary.reason.unwrap_or_default()
        ))),
        Status::FellOff => Err(Failure::Solver(format!(
            "{}; pin it, take it in, or raise the friction of the body; the last state was \
             written",
            summary.reason.unwrap_or_default()
        ))),
        Status::HeldTogether => Err(Failure::Solver(format!(
            "{}; something presses them together, or contact.grow is too short; the last state \
             was written",
            summary.reason.unwrap_or_default()
        ))),
        Status::Intersecting => Err(Failure::Intersecting(format!(
            "the step after {} s makes surfaces intersect, even at its shortest length; the last \
             good state was written",
            summary.simulated_seconds
        ))),
        Status::Interrupted if summary.reason.is_some() => Err(Failure::Stopped(format!(
            "ended at {:.4} s by {}; go on with `drape resume {place}`",
            summary.simulated_seconds,
            summary.reason.unwrap_or_default()
        ))),
        Status::Interrupted => Err(Failure::Interrupted {
            signal: signal::received().unwrap_or_default(),
            message: format!(
                "interrupted at {:.4} s; go on with `drape resume {place}`",
                summary.simulated_seconds
            ),
        }),
        Status::SolverFailed => Err(Failure::Solver(format!(
            "the step after {} s could not be solved; the last good state was written{shown}: {}",
            summary.simulated_seconds,
            summary.reason.unwrap_or_default()
        ))),
    }
}
