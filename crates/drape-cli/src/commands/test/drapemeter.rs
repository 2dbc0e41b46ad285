//! Specimens of a fabric on a simulated drapemeter: `drape test --drape`.

use drape::fabric::Fabric;
use drape::run::reports::DrapeEvaluation;

use super::arguments::TestArguments;
use super::drapes::stored::{DrapeFiles, store};
use crate::commands::sheets;
use crate::console::note;
use crate::failure::Failure;
use crate::say::{say, say_json, say_written};

/// Number of harmonics that are printed.
const HARMONIC_COUNT: usize = 10;

/// Drapes `fabric` with and without friction, and at the ends of the parameters that its sheet
/// leaves open. Prints and stores the results.
pub(crate) fn drape(fabric: &Fabric, arguments: &TestArguments) -> Result<(), Failure> {
    let request = arguments.drapes.request(arguments.spacing)?;
    let specimens = request.specimens(fabric, arguments.report.is_some());
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
    let [low, high] = result.interval.map(|coefficient| 100.0 * coefficient);
    if low < high {
        say(format_args!(
            "the sheet leaves parameters open: nine of ten fabrics with the same sheet drape to \
             {low:.1} to {high:.1} %, if one in twenty lies beyond each of the ends above"
        ))?;
    }
    if let Some(DrapeFiles { result, picture, shadow }) = written {
        say_written(format_args!("results written to {}", result.display()))?;
        say_written(format_args!("picture written to {}", picture.display()))?;
        say_written(format_args!("shadow written to {}", shadow.display()))?;
    }
    Ok(())
}

/// Describes `evaluation` in a line.
fn line(evaluation: &DrapeEvaluation) -> String {
    let DrapeEvaluation { of, coefficient, deviation, starts } = evaluation;
    let mut nodes: Vec<usize> = starts.iter().map(|start| start.nodes).collect();
    nodes.sort_unstable();
    let counts = nodes.chunk_by(|a, b| a == b);
    let nodes = counts.map(|equal| format!("{} (×{})", equal[0], equal.len()));

    let amplitudes = (0..HARMONIC_COUNT).map(|harmonic| {
        let amplitudes = starts.iter().filter_map(|start| start.amplitudes.get(harmonic));
        let mean = amplitudes.sum::<f64>() / starts.len() as f64;
        format!("{:.1}", 1e3 * mean)
    });
    format!(
        "{of:<52} drape coefficient {:.1} ± {:.1} %, nodes {}, harmonics 1 to {HARMONIC_COUNT} of the edge \
         {} mm",
        100.0 * coefficient,
        100.0 * deviation,
        nodes.collect::<Vec<_>>().join(", "),
        amplitudes.collect::<Vec<_>>().join(" ")
    )
}
