//! `drape converge`: one scene on several grids, and what the spacing leaves in its measures.
//!
//! The runs are those of a study whose axis is the spacing, so that they are kept, shared and resumed as
//! those of `drape sweep`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use drape::input::{Document, Setting, figure, toml_string};
use drape::run::file::{self, FileKind};
use drape::run::reports::VERSION;
use drape::scene::{Spacing, coarser_spacings, spacings};
use drape::sweep::{Point, Study, Table};

use super::run::{Ran, run_points};
use crate::failure::Failure;
use crate::input;
use crate::pages::sweep::converge::{Converged, page};
use crate::say::{say, say_json, say_written};

#[derive(Args)]
pub(crate) struct ConvergeArguments {
    /// Scene, a TOML file.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Spacings in mm, two or more, each at least a tenth larger than the next, such as 20,14,10. Panels
    /// and garments with a spacing of their own keep its ratio to that of the scene, and each grid begins on
    /// the coarser ones of [refine] that are a tenth coarser or more.
    #[arg(long, value_name = "MM,MM", value_delimiter = ',', required = true)]
    spacings: Vec<f64>,
    /// Measure to print, a key of summary.json such as measures.lowest; may be given several times
    /// [default: heights, lengths and eases of a garment's openings; energies and strains of other cloth]. The page has all of them.
    #[arg(long, value_name = "KEY")]
    measure: Vec<String>,
    /// Sets a key of the scene, as for `drape run`; may be given several times.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<Setting>,
    /// Folder for the results [default: out/NAME-convergence].
    #[arg(long, value_name = "FOLDER")]
    results: Option<PathBuf>,
    /// Number of runs at once, which share the threads [default: one for each thread].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Prints the result as JSON.
    #[arg(long)]
    json: bool,
}

/// Smallest ratio of neighbouring spacings. Below it, results differ more by where grid lines meet the
/// outlines than by the spacing.
const RATIO_MIN: f64 = 1.1;

/// Ends of the names of the measures that are printed where none is named, but of edges, which are parts
/// of openings.
const PRINTED: [&str; 5] = ["height_mean", "length", "ease", "lowest", "coefficient"];

/// Measures of which there are too many to print.
const EDGES: &str = "measures.free_edges.";

/// Executes `drape converge`.
pub(crate) fn converge(arguments: &ConvergeArguments) -> Result<(), Failure> {
    let spacings = sorted(&arguments.spacings)?;
    input::set_values(&arguments.set);
    let (study, points) = plan(arguments, &spacings)?;
    // Whatever a run would refuse is said before any has begun.
    for point in &points {
        let document = Document::read(&point.file)?.allowing(input::allowed());
        drape::run::scene_of(&document.with_settings(&point.settings)?)?;
    }
    // The finest takes the longest.
    let finest_first: Vec<&Point> = points.iter().rev().collect();
    let Ran { counts, failure } =
        run_points(&study, &finest_first, arguments.jobs, &again(arguments))?;
    if !arguments.json {
        say_written(counts)?;
    }
    failure.map_or(Ok(()), Err)?;
    let table = Table::collect(&study, &points);
    let folder = study.output();
    file::write(&folder.join("table.csv"), table.to_csv()?)?;
    let converged = Converged::of(&table, &spacings, &arguments.measure);
    let html = page(&study, &table, &converged)?;
    let path = folder.join("index.html");
    file::write(&path, html)?;
    if arguments.json {
        say_json(&converged)?;
    } else {
        print(&converged, &arguments.measure)?;
        say_written(format_args!("page written to {}", path.display()))?;
    }
    let ended = converged.spacings.len();
    if ended < spacings.len() {
        let message = format!(
            "{ended} of {} runs came to their end; {} says why",
            spacings.len(),
            path.display()
        );
        return Err(Failure::Solver(message));
    }
    Ok(())
}

/// Returns the spacings in m, coarsest first.
fn sorted(spacings: &[f64]) -> Result<Vec<f64>, Failure> {
    let refused = |message: String| Failure::Usage(format!("--spacings: {message}"));
    if let Some(wrong) = spacings.iter().find(|own| !(0.001..=1e5).contains(*own)) {
        return Err(refused(format!("{wrong} is no spacing in mm; write such as 20,14,10")));
    }
    let mut sorted = spacings.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    if sorted.len() < 2 {
        return Err(refused("one spacing says nothing on the next; write such as 20,14,10".into()));
    }
    if let Some(pair) = sorted.windows(2).find(|pair| pair[0] < (1.0 - 1e-9) * RATIO_MIN * pair[1])
    {
        return Err(refused(format!(
            "{} and {} mm are too close, differences would be those of the grids' edges; take {} mm or \
             more in place of {0}",
            figure(pair[0]),
            figure(pair[1]),
            figure((10.0 * RATIO_MIN * pair[1]).ceil() / 10.0),
        )));
    }
    Ok(sorted.iter().map(|own| 1e-3 * own).collect())
}

/// Makes the study of a scene on several grids, and its points.
fn plan(arguments: &ConvergeArguments, spacings: &[f64]) -> Result<(Study, Vec<Point>), Failure> {
    let scene = &arguments.scene;
    if input::is_standard(scene) {
        return Err(Failure::Usage("-: name a file, which every run reads".into()));
    }
    let document = input::document_of_kind(scene, &[FileKind::Scene])?;
    let text = study_text(scene, &arguments.set, &own_spacings(&document, spacings)?);
    let study = Study::from_document(&Document::new(scene, text).allowing(input::allowed()))?;
    let study = study.with_output(folder(arguments));
    let points = study.points(VERSION, None)?;
    Ok((study, points))
}

/// Returns each key of a spacing with its TOML values for grids, given by their spacings, in m. Of the
/// coarser grids of the scene, each grid keeps those that are coarse enough for it.
fn own_spacings(document: &Document, grids: &[f64]) -> Result<Vec<(String, Vec<String>)>, Failure> {
    let own = spacings(document)?;
    let common = own[0].value;
    let values = |own: &Spacing| grids.iter().map(|grid| own.scaled_value(grid / common)).collect();
    let mut keys: Vec<_> = own.iter().map(|own| (own.key.clone(), values(own))).collect();
    let coarser = coarser_spacings(document)?;
    if !coarser.is_empty() {
        let kept = |grid: &f64| {
            let kept = coarser.iter().filter(|own| own.value >= (1.0 - 1e-9) * RATIO_MIN * grid);
            let kept: Vec<String> = kept.map(|own| own.scaled_value(1.0)).collect();
            format!("[{}]", kept.join(", "))
        };
        keys.push(("refine.spacings".into(), grids.iter().map(kept).collect()));
    }
    Ok(keys)
}

/// Returns the text of a study whose axis is the spacing.
fn study_text(scene: &Path, set: &[Setting], spacings: &[(String, Vec<String>)]) -> String {
    let name = scene.file_name().unwrap_or_default().to_string_lossy();
    let mut text = format!("scene = {}\nkeep = \"last\"\n", toml_string(&name));
    if !set.is_empty() {
        let lines: Vec<String> = set.iter().map(ToString::to_string).collect();
        let _ = write!(text, "[set]\n{}\n", lines.join("\n"));
    }
    for (key, values) in spacings {
        let _ = write!(
            text,
            "[[axis]]\nkey = \"{key}\"\nvalues = [{}]\ntogether = \"spacing\"\n",
            values.join(", ")
        );
    }
    text
}

/// Returns the folder for the results.
fn folder(arguments: &ConvergeArguments) -> PathBuf {
    arguments.results.clone().unwrap_or_else(|| {
        let mut name = arguments.scene.file_stem().unwrap_or_default().to_owned();
        name.push("-convergence");
        Path::new("out").join(name)
    })
}

/// Returns the command that goes on.
fn again(arguments: &ConvergeArguments) -> String {
    let spacings: Vec<String> = arguments.spacings.iter().map(f64::to_string).collect();
    let mut command =
        format!("drape converge {} --spacings {}", arguments.scene.display(), spacings.join(","));
    for setting in &arguments.set {
        let _ = write!(command, " --set '{setting}'");
    }
    if let Some(folder) = &arguments.results {
        let _ = write!(command, " --results {}", folder.display());
    }
    command
}

/// Prints the convergence of the measures that are named, or of those of a garment's shape.
fn print(converged: &Converged, named: &[String]) -> Result<(), Failure> {
    let known = |name: &&String| converged.measures.iter().all(|own| own.key != **name);
    if let Some(unknown) = named.iter().find(known) {
        let message =
            format!("--measure {unknown}: no such number in the summaries of two runs or more");
        return Err(Failure::Usage(message));
    }
    let is_usual = |key: &String| {
        let is_measure = key.starts_with("measures.") && !key.starts_with(EDGES);
        is_measure && PRINTED.iter().any(|end| key.ends_with(end))
    };
    let measures = &converged.measures;
    let has_usual = measures.iter().any(|measure| is_usual(&measure.key));
    let is_printed = |key: &String| match named {
        [] => !has_usual || is_usual(key),
        named => named.contains(key),
    };
    for measure in measures.iter().filter(|measure| is_printed(&measure.key)) {
        say(measure.line())?;
    }
    Ok(())
}
