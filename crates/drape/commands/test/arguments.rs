//! Arguments of `drape test`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use drape::input::Setting;

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
    /// The drapemeter.
    #[arg(long, value_enum, default_value = "frl", requires = "drape")]
    pub(crate) meter: Meter,
    /// Shakes the specimen after it has been lowered.
    #[arg(long, value_enum, requires = "drape")]
    pub(crate) shake: Option<ShakeName>,
    /// Specimens to drape, each from another start.
    #[arg(long, value_name = "N", default_value_t = 10, requires = "drape")]
    pub(crate) starts: u64,
    /// Sets a key of the fabric or sheet in place of its value there, such as density=0.12; may be
    /// given several times. The key is a path of names and numbers, the value one of TOML.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<Setting>,
    /// Folder for a page with the loops overlaid.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) report: Option<PathBuf>,
    /// Prints the loops and values as JSON.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Drapemeters, by the diameters of specimen and disc.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Meter {
    /// 254 mm on 127 mm.
    Frl,
    /// Cusick's, 24 cm on 18 cm.
    #[value(name = "cusick-24")]
    Cusick24,
    /// Cusick's, 30 cm on 18 cm.
    #[value(name = "cusick-30")]
    Cusick30,
    /// Cusick's, 36 cm on 18 cm.
    #[value(name = "cusick-36")]
    Cusick36,
}

/// Motions that shake a draped specimen.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum ShakeName {
    /// The disc moves up and down three times by ±10 mm, twice a second.
    Bounce,
}
