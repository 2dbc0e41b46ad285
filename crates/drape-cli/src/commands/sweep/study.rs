//! Study that a command names, with its points.

use std::path::PathBuf;

use clap::Args;
use drape::run::file::FileKind;
use drape::sweep::{Point, Shard, Study};

use crate::failure::Failure;
use crate::input;
use drape::run::reports::VERSION;

#[derive(Args)]
pub(crate) struct StudyArguments {
    /// Study, a TOML file.
    #[arg(value_name = "STUDY")]
    pub(crate) study: PathBuf,
    /// Folder for the results [default: the folder that the study names].
    #[arg(long, value_name = "FOLDER", overrides_with = "results")]
    pub(crate) results: Option<PathBuf>,
}

impl StudyArguments {
    /// Reads the study and its points, or only the points of `shard`.
    pub(super) fn read(&self, shard: Option<Shard>) -> Result<(Study, Vec<Point>), Failure> {
        let study = self.study()?;
        let points = study.points(VERSION, shard)?;
        Ok((study, points))
    }

    /// Reads the study without its points, and sets the folder of `--results`.
    pub(super) fn study(&self) -> Result<Study, Failure> {
        input::expect(&self.study, &[FileKind::Study])?;
        let study = Study::read(&self.study, input::access())?;
        Ok(match &self.results {
            Some(folder) => study.with_output(folder.clone()),
            None => study,
        })
    }
}
