use std::fmt::Write;
use std::path::{Path, PathBuf};

use drape::fit::{Fit, identify, lm::Stop};
use drape::input::{Diagnostic, Diagnostics};
use drape::kes::Sheet;

use crate::command::FitArguments;
use crate::failure::Failure;

/// `drape fit`.
#[expect(clippy::print_stdout, reason = "the result of the command goes to stdout")]
#[expect(clippy::print_stderr, reason = "messages of the program go to stderr")]
pub(crate) fn fit(arguments: &FitArguments) -> Result<(), Failure> {
    let sheet = Sheet::read(&arguments.sheet).map_err(|e| input(&arguments.sheet, e))?;
    let fit = identify(&sheet)
        .map_err(|error| Diagnostics::from(Diagnostic::new(&arguments.sheet, error.to_string())))?;
    sheet.warnings().iter().for_each(|warning| eprintln!("warning: {warning}"));
    let path = arguments.output.clone().unwrap_or_else(|| beside(&arguments.sheet));
    if path.exists() && arguments.output.is_none() && !arguments.force {
        let message = format!("{} exists; give -o, or replace it with --force", path.display());
        return Err(Failure::Usage(message));
    }
    write(&path, &fit.fabric.to_toml())?;
    if arguments.json {
        println!("{}", json(&fit));
    } else {
        print!("{}", report(&sheet, &fit));
        println!("fabric written to {}", path.display());
    }
    Ok(())
}

/// A sheet's mistakes with their places.
pub(crate) fn input(file: &Path, error: drape::kes::Error) -> Diagnostics {
    match error {
        drape::kes::Error::Input(diagnostics) => diagnostics,
        other => Diagnostic::new(file, other.to_string()).into(),
    }
}

/// Where the fabric of a sheet goes when nothing is said: `fabric.toml` in the sheet's folder.
fn beside(sheet: &Path) -> PathBuf {
    let folder = if sheet.is_dir() { sheet } else { sheet.parent().unwrap_or(Path::new("")) };
    folder.join("fabric.toml")
}

/// Writes to a temporary file first, so that a reader never sees half of a fabric.
fn write(path: &Path, text: &str) -> Result<(), Failure> {
    let temporary = path.with_extension("part");
    let written = std::fs::write(&temporary, text).and_then(|()| std::fs::rename(&temporary, path));
    written.map_err(|error| Failure::Output(format!("cannot write {}: {error}", path.display())))
}

fn report(sheet: &Sheet, fit: &Fit) -> String {
    let mut text = format!("{}\n", sheet.name);
    for curve in &fit.curves {
        let _ = writeln!(
            text,
            "  {}: residual {:.2} % of the range, {} iterations, {}",
            curve.name,
            100.0 * curve.misfit,
            curve.iterations,
            stop(curve.stop)
        );
        for estimate in &curve.parameters {
            let _ = writeln!(text, "    {:<28} {:>13.5e}", estimate.name, estimate.value);
        }
    }
    for assumed in &fit.assumed {
        let _ = writeln!(text, "  assumed: {assumed}");
    }
    text
}

/// Why a search ended, in words.
fn stop(stop: Stop) -> &'static str {
    match stop {
        Stop::Reduction => "the residual no longer falls",
        Stop::Step => "the parameters no longer move",
        Stop::Gradient => "no change of the parameters helps",
        Stop::Exact => "no residual is left",
        Stop::Stalled => "no step helps",
        Stop::Iterations => "the limit on iterations was reached",
        Stop::NotFinite => "the starting values give no finite load",
        Stop::Empty => "there is nothing to fit",
    }
}

fn json(fit: &Fit) -> String {
    let curve = |curve: &drape::fit::CurveFit| {
        let parameters = curve
            .parameters
            .iter()
            .map(|estimate| (estimate.name.to_owned(), serde_json::Value::from(estimate.value)));
        serde_json::json!({
            "name": curve.name,
            "test": curve.test.name(),
            "direction": curve.direction.name(),
            "misfit": curve.misfit,
            "iterations": curve.iterations,
            "evaluations": curve.evaluations,
            "stop": stop(curve.stop),
            "parameters": parameters.collect::<serde_json::Map<_, _>>(),
        })
    };
    let curves: Vec<_> = fit.curves.iter().map(curve).collect();
    let value = serde_json::json!({
        "fabric": fit.fabric.name,
        "curves": curves,
        "assumed": fit.assumed,
    });
    serde_json::to_string_pretty(&value).expect("numbers and strings have a JSON form")
}
