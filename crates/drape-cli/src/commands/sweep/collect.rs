//! `drape sweep collect`: the table of all points, or of parts of them, and its page.

use std::path::PathBuf;

use clap::Args;
use drape::input::counted;
use drape::run::file;
use drape::sweep::{Error, Shard, Study, Table};

use super::study::StudyArguments;
use crate::failure::Failure;
use crate::pages::sweep::page;
use crate::say::{say, say_written};

#[derive(Args)]
pub(crate) struct SweepCollectArguments {
    #[command(flatten)]
    study: StudyArguments,
    /// Collects part i of n of the points, such as 1/4, in a table of its own, and makes no page.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Makes the table and the page of the tables of the parts, without reading the points.
    #[arg(long, conflicts_with = "shard")]
    join: bool,
}

/// Executes `drape sweep collect`.
pub(crate) fn collect(arguments: &SweepCollectArguments) -> Result<(), Failure> {
    let StudyArguments { study: study_path, .. } = &arguments.study;
    if arguments.join {
        let study = arguments.study.study()?;
        let (table, missing) = joined(&study)?;
        if missing > 0 {
            say(format_args!(
                "{} in no part: drape sweep collect {} --shard I/N",
                counted(missing, "point is", "points are"),
                study_path.display()
            ))?;
        }
        return write(&study, &table, study_path.display());
    }

    let (study, points) = arguments.study.read(arguments.shard)?;
    let table = Table::collect(&study, &points);
    let Some(shard) = arguments.shard else {
        return write(&study, &table, study_path.display());
    };
    let path =
        tables_folder(&study).join(format!("{}.csv", shard.to_string().replace('/', "-of-")));
    file::write(&path, table.to_csv()?)?;
    let points = counted(points.len(), "point", "points");
    say_written(format_args!("{points} in {}", path.display()))
}

/// Returns the folder for the tables of parts of `study`.
fn tables_folder(study: &Study) -> PathBuf {
    study.output().join("tables")
}

/// Reads the tables of parts and joins them. Returns the table with the number of points that are
/// in no part.
fn joined(study: &Study) -> Result<(Table, usize), Failure> {
    let folder = tables_folder(study);

    let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "csv"));
    paths.sort();
    if paths.is_empty() {
        let message = format!(
            "--join: there is no table in {}; make some with `drape sweep collect {} --shard I/N`",
            folder.display(),
            study.file().display()
        );
        return Err(Failure::Usage(message));
    }

    let mut tables = Vec::new();
    for path in &paths {
        let text = std::fs::read(path).map_err(|source| Error::Io {
            what: "read",
            path: path.clone(),
            source,
        })?;
        tables.push(Table::from_csv(study, path, &text)?);
    }
    Ok(Table::join(study, &tables))
}

/// Writes the table and the page of `study`. `name` is the path of the study in messages.
fn write(study: &Study, table: &Table, name: impl std::fmt::Display) -> Result<(), Failure> {
    let path = study.output().join("table.csv");
    file::write(&path, table.to_csv()?)?;
    #[cfg(feature = "parquet")]
    file::write(&study.output().join("table.parquet"), table.to_parquet()?)?;
    let outcomes = &table.records[0].cells;
    say_written(format_args!(
        "{} in {}",
        counted(outcomes.len(), "point", "points"),
        path.display()
    ))?;
    let not_run = outcomes.iter().filter(|cell| *cell == "not run").count();
    if not_run > 0 {
        let points = counted(not_run, "point has", "points have");
        say(format_args!("{points} no result yet: drape sweep run {name}"))?;
    }
    let path = study.output().join("index.html");
    file::write(&path, page(study, table)?)?;
    say_written(format_args!("effects in {}", path.display()))
}
