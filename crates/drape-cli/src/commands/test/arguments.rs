//! Arguments of `drape test`.

use std::path::PathBuf;

use clap::Args;
use drape::input::Setting;

use super::drapes::DrapeArguments;

#[derive(Args)]
pub(crate) struct TestArguments {
    /// A fabric, or a sheet, which is fitted first.
    pub(crate) fabric: PathBuf,
    /// Spacing of the particles [default: 5; on a drapemeter what the fabric requires, at most 5].
    #[arg(long, value_name = "MM")]
    pub(crate) spacing: Option<f64>,
    /// Puts the fabric on a drapemeter instead: drape coefficient, nodes, harmonics.
    #[arg(long)]
    pub(crate) drape: bool,
    #[command(flatten)]
    pub(crate) drapes: DrapeArguments,
    /// Sets a key of the fabric or sheet in place of its value there, such as density=0.12; may be
    /// given several times. The key is a path of names and numbers, the value one of TOML.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<Setting>,
    /// Folder for a page with the loops overlaid; with --drape for the results as JSON, a picture
    /// and the shadow of a specimen, from which drape report takes them.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) report: Option<PathBuf>,
    /// Prints the loops and values as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}
