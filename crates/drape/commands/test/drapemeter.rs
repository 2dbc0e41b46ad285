//! Specimens of a fabric on a simulated drapemeter: `drape test --drape`.

use drape::fabric::Fabric;
use drape::validate::ValidationError;
use drape::validate::drapemeter::{Drapemeter, Prediction, Sampling, Shake, Study, spacing_bound};
use serde_json::json;

use super::arguments::{Meter, ShakeName, TestArguments};
use crate::console::progress;
use crate::failure::Failure;
use crate::say::{say, say_json};

/// Largest default spacing, in m.
const SPACING_MAX: f64 = 0.005;
/// Number of harmonics that are printed.
const SHOWN: usize = 10;

/// Drapes of one fabric from several starts.
struct Evaluation {
    /// Name of the fabric's variant.
    of: String,
    study: Study,
}

/// Drapes the fabric as it is, without friction, and at the ends of what its sheet leaves open.
pub(crate) fn drape(fabric: &Fabric, arguments: &TestArguments) -> Result<(), Failure> {
    let mut meter = match arguments.meter {
        Meter::Frl => Drapemeter::frl(),
        Meter::Cusick24 => Drapemeter::cusick(0.24),
        Meter::Cusick30 => Drapemeter::cusick(0.3),
        Meter::Cusick36 => Drapemeter::cusick(0.36),
    };
    meter.protocol.shake = arguments.shake.map(|ShakeName::Bounce| Shake::BOUNCE);
    if arguments.starts < 2 {
        let message = "--starts below 2 have no standard deviation; take 2 or more";
        return Err(Failure::Usage(message.into()));
    }
    let bound = spacing_bound(fabric);
    let spacing = arguments.spacing.map_or(bound.min(SPACING_MAX), |mm| 1e-3 * mm);
    if !arguments.json {
        say(format_args!(
            "{}: {} starts, particles at {:.2} mm",
            fabric.name,
            arguments.starts,
            1e3 * spacing
        ))?;
        if spacing > 1.05 * bound {
            say(format_args!("warning: the fabric requires {:.2} mm or less", 1e3 * bound))?;
        }
    }
    let specimens = arguments.starts * (1 + Prediction::studies(fabric));
    let bar = progress::bar(specimens, "{pos}/{len} specimens, {eta} left");
    let sampling = Sampling { spacing, starts: arguments.starts };
    let done = || bar.inc(1);
    let failed = |error: ValidationError| Failure::Solver(error.to_string());
    let prediction = Prediction::of(&meter, fabric, sampling, &done).map_err(failed)?;
    let elastic = meter.study(&fabric.without_friction(), sampling, &done).map_err(failed)?;
    bar.finish_and_clear();
    let interval = prediction.interval();
    let open = !prediction.ends.is_empty();
    let mut found = vec![
        Evaluation { of: "with its friction".into(), study: prediction.fitted },
        Evaluation { of: "elastic".into(), study: elastic },
    ];
    for (parameter, [low, high]) in prediction.ends {
        let of = |end: &str| format!("{}, {end} end", parameter.name());
        found.push(Evaluation { of: of("limp"), study: low });
        found.push(Evaluation { of: of("stiff"), study: high });
    }
    if arguments.json {
        let rows: Vec<serde_json::Value> = found.iter().map(row).collect();
        let page = json!({
            "spacing": spacing, "spacing_bound": bound, "interval": interval, "evaluations": rows
        });
        return say_json(&page);
    }
    found.iter().try_for_each(|Evaluation { of, study }| say(line(of, study)))?;
    if open {
        let [low, high] = interval.map(|part| 100.0 * part);
        say(format_args!(
            "the sheet leaves parameters open: nine of ten fabrics with the same sheet drape to \
             {low:.1} to {high:.1} %, if one in twenty lies beyond each of the ends above"
        ))?;
    }
    Ok(())
}

fn line(of: &str, study: &Study) -> String {
    let nodes = study.nodes().into_iter().map(|(nodes, times)| format!("{nodes} (×{times})"));
    let amplitudes = study
        .amplitudes()
        .into_iter()
        .take(SHOWN)
        .map(|amplitude| format!("{:.1}", 1e3 * amplitude));
    format!(
        "{of:<52} drape coefficient {:.1} ± {:.1} %, nodes {}, harmonics 1 to {SHOWN} of the edge \
         {} mm",
        100.0 * study.mean(),
        100.0 * study.deviation(),
        nodes.collect::<Vec<_>>().join(", "),
        amplitudes.collect::<Vec<_>>().join(" ")
    )
}

/// Entry of the JSON output for an evaluation.
fn row(evaluation: &Evaluation) -> serde_json::Value {
    let Evaluation { of, study } = evaluation;
    let starts = study.drapes.iter().map(|drape| {
        json!({
            "coefficient": drape.coefficient,
            "nodes": drape.nodes,
            "amplitudes": drape.amplitudes,
            "edge": drape.edge,
            "speed": drape.speed,
        })
    });
    json!({
        "of": of,
        "coefficient": study.mean(),
        "deviation": study.deviation(),
        "starts": starts.collect::<Vec<_>>(),
    })
}
