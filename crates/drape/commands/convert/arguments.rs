//! Arguments of `drape convert`.

use std::path::PathBuf;

use clap::Args;

#[derive(Args)]
pub(crate) struct ConvertArguments {
    /// Pattern: *.json of GarmentCode or FreeSewing, *.svg, *.dxf (AAMA, ASTM), or *.toml; or a
    /// folder with the exports of a laboratory's instruments.
    #[arg(required = true, value_name = "FROM")]
    pub(crate) from: Vec<PathBuf>,
    /// File to write: *.toml, or *.svg for a drawing at true scale; for exports a sheet.toml, or its
    /// folder; without it, TOML on stdout.
    #[arg(short, long, value_name = "TO")]
    pub(crate) output: Option<PathBuf>,
    /// Unit of the lengths of a drawing that does not state it.
    #[arg(long, value_name = "mm|cm|m|in|pt|px")]
    pub(crate) unit: Option<String>,
    /// Size to take from a graded DXF.
    #[arg(long, value_name = "SIZE")]
    pub(crate) size: Option<String>,
    /// Paper of a printer: the drawing becomes one SVG a page, TO-A1.svg and so on.
    #[arg(long, value_name = "a4|a3|letter|WxH")]
    pub(crate) paper: Option<String>,
    /// Largest width of the drawing, such as that of a plotter's roll, in mm.
    #[arg(long, value_name = "MM", conflicts_with = "paper")]
    pub(crate) width: Option<f64>,
    /// Replaces files that exist.
    #[arg(long)]
    pub(crate) force: bool,
}
