//! Specimens of a fabric on a simulated drapemeter: `drape test --drape`.

use drape::fabric::Fabric;
use drape::run::reports::DrapeEvaluation;

use super::arguments::TestArguments;
use super::drapes::stored::{Written, store};
use crate::commands::sheets;
use crate::console::note;
use crate::failure::Failure;
use crate::say::{say, say_json, say_written};

/// Number of harmonics that are printed.
const SHOWN: usize = 10;

/// Drapes the fabric as it is, without friction, and at the ends of what its sheet leaves open; prints and
/// stores what came out.
pub(crate) fn drape(fabric: &Fabric, arguments: &TestArguments) -> Result<(), Failure> {
    let request = arguments.drapes.request(arguments.spacing)?;
    let specimens = request.of(fabric, arguments.report.is_some());
    if !arguments.json {
        say(format_args!(
            "{}: {} starts, particles at {:.2} mm",
            fabric.name,
            request.starts,
            1e3 * specimens.spacing
        ))?;
        if let Some(warning) = specimens.warning() {
            say(format_args!("warning: {warning}"))?;
        }
        note(specimens.expected()?);
    }
    let draped = specimens.drape()?;
    let name = sheets::stem(&arguments.fabric);
    let written = arguments.report.as_deref().map(|folder| store(&draped, folder, &name));
    let written = written.transpose()?;
    let result = &draped.result;
    if arguments.json {
        return say_json(result);
    }
    result.evaluations.iter().try_for_each(|evaluation| say(line(evaluation)))?;
    let [low, high] = result.interval.map(|part| 100.0 * part);
    if low < high {
        say(format_args!(
            "the sheet leaves parameters open: nine of ten fabrics with the same sheet drape to \
             {low:.1} to {high:.1} %, if one in twenty lies beyond each of the ends above"
        ))?;
    }
    if let Some(Written { result, picture, shadow }) = written {
        say_written(format_args!("results written to {}", result.display()))?;
        say_written(format_args!("picture written to {}", picture.display()))?;
        say_written(format_args!("shadow written to {}", shadow.display()))?;
    }
    Ok(())
}

fn line(evaluation: &DrapeEvaluation) -> String {
    let DrapeEvaluation { of, coefficient, deviation, starts } = evaluation;
    let mut nodes: Vec<usize> = starts.iter().map(|start| start.nodes).collect();
    nodes.sort_unstable();
    let counts = nodes.chunk_by(|a, b| a == b);
    let nodes = counts.map(|alike| format!("{} (×{})", alike[0], alike.len()));
    let mean = |harmonic: usize| {
        let amplitudes = starts.iter().filter_map(|start| start.amplitudes.get(harmonic));
        amplitudes.sum::<f64>() / starts.len() as f64
    };
    let amplitudes = (0..SHOWN).map(|harmonic| format!("{:.1}", 1e3 * mean(harmonic)));
    format!(
        "{of:<52} drape coefficient {:.1} ± {:.1} %, nodes {}, harmonics 1 to {SHOWN} of the edge \
         {} mm",
        100.0 * coefficient,
        100.0 * deviation,
        nodes.collect::<Vec<_>>().join(", "),
        amplitudes.collect::<Vec<_>>().join(" ")
    )
}
