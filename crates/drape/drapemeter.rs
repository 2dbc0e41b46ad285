//! `drape test --drape`: specimens of a fabric in a simulated drapemeter.

use drape::fabric::Fabric;
use drape::validate::drapemeter::{Drapemeter, Prior, Study, spacing_bound};
use indicatif::{ProgressBar, ProgressStyle};
use serde_json::json;

use crate::command::{Meter, TestArguments};
use crate::failure::Failure;
use crate::say::say;

/// The coarsest spacing that is taken without being asked for, in m.
const SPACING_MAX: f64 = 0.005;
/// Harmonics that are printed.
const SHOWN: usize = 10;

/// One evaluation, and what it is of.
struct Evaluation {
    of: String,
    study: Study,
}

pub(crate) fn drape(fabric: &Fabric, arguments: &TestArguments) -> Result<(), Failure> {
    let meter = match arguments.meter {
        Meter::Frl => Drapemeter::FRL,
        Meter::Cusick24 => Drapemeter::CUSICK_24,
        Meter::Cusick30 => Drapemeter::CUSICK_30,
        Meter::Cusick36 => Drapemeter::CUSICK_36,
    };
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
            let message = "the fabric asks for";
            say(format_args!("warning: {message} {:.2} mm or less", 1e3 * bound))?;
        }
    }
    let mut wanted = vec![
        ("with its friction".to_owned(), fabric.clone()),
        ("elastic".into(), fabric.elastic()),
    ];
    let ends = [("limp end of the prior", Prior::LIMP), ("stiff end", Prior::STIFF)];
    wanted.extend(ends.into_iter().filter_map(|(of, prior)| Some((of.into(), prior.of(fabric)?))));
    let bar = ProgressBar::new(arguments.starts * wanted.len() as u64);
    let style = "{elapsed_precise} {bar:32} {pos}/{len} specimens, {eta} left";
    bar.set_style(ProgressStyle::with_template(style).expect("the template is right"));
    let mut found = Vec::new();
    for (of, fabric) in wanted {
        let study = meter
            .study(&fabric, (spacing, arguments.starts), &|| bar.inc(1))
            .map_err(|error| Failure::Solver(format!("{of}: {error}")))?;
        if !arguments.json {
            bar.suspend(|| say(line(&of, &study)))?;
        }
        found.push(Evaluation { of, study });
    }
    bar.finish_and_clear();
    if arguments.json {
        let rows: Vec<serde_json::Value> = found.iter().map(row).collect();
        let page = json!({ "spacing": spacing, "spacing_bound": bound, "evaluations": rows });
        return say(serde_json::to_string_pretty(&page).expect("numbers have a JSON form"));
    }
    if let [_, _, low, high] = found.as_slice() {
        let [low, high] = [low, high].map(|evaluation| 100.0 * evaluation.study.mean());
        say(format_args!(
            "the sheet does not say everything: over G 0.3 to 1 gf/(cm·deg), 2HG 0.2 to 2 gf/cm and a bending \
             friction that builds up over 0.2 to 0.02 1/cm, where assumed, the drape coefficient is {:.1} to {:.1} %",
            low.min(high),
            low.max(high)
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
        "{of:<22} drape coefficient {:.1} ± {:.1} %, nodes {}, harmonics 1 to {SHOWN} of the edge {} mm",
        100.0 * study.mean(),
        100.0 * study.deviation(),
        nodes.collect::<Vec<_>>().join(", "),
        amplitudes.collect::<Vec<_>>().join(" ")
    )
}

/// An evaluation as scripts read it.
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
