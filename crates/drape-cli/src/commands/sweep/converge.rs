//! `drape converge`: runs one scene on several grids and estimates the error that the spacing
//! leaves in its measures.
//!
//! The runs are points of a study whose axis is the spacing. They are stored, distributed and
//! resumed like the points of `drape sweep`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use drape::input::{Document, Setting, figure, toml_string};
use drape::run::file::{self, FileKind};
use drape::run::reports::VERSION;
use drape::scene::SceneSpec;
use drape::sweep::{Point, Study, Table};

use super::run::{SweepEnd, run_points};
use crate::failure::Failure;
use crate::input;
use crate::pages::sweep::converge::{Converged, page};
use crate::say::{say, say_json, say_written};

#[derive(Args)]
pub(crate) struct ConvergeArguments {
    /// Scene, a TOML file.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Spacings in mm, two or more, each at least a tenth larger than the next, such as 20,14,10.
    /// Panels and garments with a spacing of their own keep its ratio to the spacing of the scene,
    /// and each grid begins on the coarser ones of `[refine]` that are a tenth coarser or more.
    #[arg(long, value_name = "MM,MM", value_delimiter = ',', required = true)]
    spacings: Vec<f64>,
    /// Measure to print, a key of summary.json such as measures.lowest; may be given several times
    /// [default: heights, lengths and eases of a garment's openings; energies and strains of other
    /// cloth]. The page has all of them.
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

/// Smallest ratio of neighbouring spacings. Below it, the positions where grid lines meet the
/// outlines change the results more than the spacing does.
const RATIO_MIN: f64 = 1.1;

/// Ends of the names of the measures that are printed by default. Measures of edges are excluded,
/// because edges are parts of openings.
const PRINTED: [&str; 5] = ["height_mean", "length", "ease", "lowest", "coefficient"];

/// Beginning of the names of the measures of edges. There are too many of them to print.
const EDGES: &str = "measures.free_edges.";

/// Executes `drape converge`.
pub(crate) fn converge(arguments: &ConvergeArguments) -> Result<(), Failure> {
    let spacings = sorted(&arguments.spacings)?;
    input::set_values(&arguments.set);
    let (study, points) = plan(arguments, &spacings)?;

    // Every scene is checked before the first run begins.
    for point in &points {
        let document = Document::read_with(&point.file, input::access())?;
        drape::run::scene_of(&document.with_settings(&point.settings)?)?;
    }

    // The finest grid takes the longest, so it starts first.
    let finest_first: Vec<&Point> = points.iter().rev().collect();
    let SweepEnd { counts, failure } =
        run_points(&study, &finest_first, arguments.jobs, &continuing_command(arguments))?;
    if !arguments.json {
        say_written(counts)?;
    }
    failure.map_or(Ok(()), Err)?;

    let table = Table::collect(&study, &points);
    let folder = study.output();
    file::write(&folder.join("table.csv"), table.to_csv()?)?;
    let converged = Converged::new(&table, &spacings, &arguments.measure);
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

/// Returns `spacings`, given in mm, in m, from the coarsest to the finest. Refuses spacings that
/// are no lengths or too close.
fn sorted(spacings: &[f64]) -> Result<Vec<f64>, Failure> {
    if let Some(wrong) = spacings.iter().find(|spacing| !(0.001..=1e5).contains(*spacing)) {
        return Err(Failure::Usage(format!(
            "--spacings: {wrong} is no spacing in mm; write such as 20,14,10"
        )));
    }
    if spacings.len() < 2 {
        return Err(Failure::Usage(
            "--spacings: one spacing says nothing on the next; write such as 20,14,10".into(),
        ));
    }

    let mut sorted = spacings.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    if let Some(pair) = sorted.windows(2).find(|pair| pair[0] < (1.0 - 1e-9) * RATIO_MIN * pair[1])
    {
        return Err(Failure::Usage(format!(
            "--spacings: {} and {} mm are too close, their differences would come from the edges of the grids; take \
             {} mm or more in place of {0}",
            figure(pair[0]),
            figure(pair[1]),
            figure((10.0 * RATIO_MIN * pair[1]).ceil() / 10.0),
        )));
    }
    Ok(sorted.iter().map(|spacing| 1e-3 * spacing).collect())
}

/// Builds the study of a scene on grids with these `spacings`, in m, and returns it with its
/// points.
fn plan(arguments: &ConvergeArguments, spacings: &[f64]) -> Result<(Study, Vec<Point>), Failure> {
    let scene = &arguments.scene;
    if input::is_standard(scene) {
        return Err(Failure::Usage("-: name a file, which every run reads".into()));
    }
    let document = input::document_of_kind(scene, &[FileKind::Scene])?;
    let text = study_text(scene, &arguments.set, &spacing_axes(&document, spacings)?);
    let study = Study::from_document(&Document::new(scene, text).with_access(input::access()))?;
    let study = study.with_output(folder(arguments));
    let points = study.points(VERSION, None)?;
    Ok((study, points))
}

/// Returns each key of a spacing in `document` with its TOML value for each grid. `grids` has the
/// spacings of the grids, in m. Each grid keeps the coarser grids of the scene that are coarse
/// enough for it.
fn spacing_axes(document: &Document, grids: &[f64]) -> Result<Vec<(String, Vec<String>)>, Failure> {
    let spec = SceneSpec::from_document(document)?;
    let spacings = spec.spacings();
    let scene_spacing = spacings[0].value;
    let mut axes: Vec<(String, Vec<String>)> = spacings
        .iter()
        .map(|spacing| {
            let scaled = grids.iter().map(|grid| spacing.scaled_value(grid / scene_spacing));
            (spacing.key.clone(), scaled.collect())
        })
        .collect();

    let coarser = spec.coarser_spacings();
    if !coarser.is_empty() {
        let lists = grids.iter().map(|grid| {
            let kept: Vec<String> = coarser
                .iter()
                .filter(|spacing| spacing.value >= (1.0 - 1e-9) * RATIO_MIN * grid)
                .map(|spacing| spacing.scaled_value(1.0))
                .collect();
            format!("[{}]", kept.join(", "))
        });
        axes.push(("refine.spacings".into(), lists.collect()));
    }
    Ok(axes)
}

/// Returns the text of a study of `scene`. All axes in `spacings` change together.
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

/// Returns the folder of `--results`, by default `out/NAME-convergence`.
fn folder(arguments: &ConvergeArguments) -> PathBuf {
    arguments.results.clone().unwrap_or_else(|| {
        let mut name = arguments.scene.file_stem().unwrap_or_default().to_owned();
        name.push("-convergence");
        Path::new("out").join(name)
    })
}

/// Returns the command that continues an interrupted study.
fn continuing_command(arguments: &ConvergeArguments) -> String {
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

/// Prints the measures in `named`, by default the usual measures of a garment's shape.
fn print(converged: &Converged, named: &[String]) -> Result<(), Failure> {
    let measures = &converged.measures;
    let unknown = named.iter().find(|name| measures.iter().all(|measure| measure.key != **name));
    if let Some(unknown) = unknown {
        let message =
            format!("--measure {unknown}: no such number in the summaries of two runs or more");
        return Err(Failure::Usage(message));
    }

    // Cloth that is no garment has none of the usual measures, so all are printed.
    let has_usual = measures.iter().any(|measure| is_usual(&measure.key));
    for measure in measures {
        let is_printed = if named.is_empty() {
            !has_usual || is_usual(&measure.key)
        } else {
            named.contains(&measure.key)
        };
        if is_printed {
            say(measure.line())?;
        }
    }
    Ok(())
}

/// Returns whether the measure called `key` describes the shape of a garment.
fn is_usual(key: &str) -> bool {
    let is_measure = key.starts_with("measures.") && !key.starts_with(EDGES);
    is_measure && PRINTED.iter().any(|end| key.ends_with(end))
}
