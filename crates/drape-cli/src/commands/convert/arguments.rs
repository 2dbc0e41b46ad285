//! Arguments of `drape convert`.

use std::path::PathBuf;

use clap::Args;

#[derive(Args)]
pub(crate) struct ConvertArguments {
    /// Pattern: *.json of GarmentCode or FreeSewing, *.svg, *.dxf (AAMA, ASTM), or *.toml, - for
    /// standard input; or what a laboratory measured: a workbook (.xlsx, .xls, .xlsm, .ods), a .csv
    /// or another table, a .zip, or a folder with the exports of instruments.
    #[arg(required = true, value_name = "FROM")]
    pub(crate) from: Vec<PathBuf>,
    /// File to write: *.toml, *.svg for a drawing at true scale, or *.dxf for a program of pattern
    /// makers; for measurements a sheet.toml, or its folder, and a folder where they are of several
    /// fabrics; without it, or with -, TOML on stdout.
    #[arg(short, long, value_name = "TO")]
    pub(crate) output: Option<PathBuf>,
    /// The fabric to take of tables that hold several.
    #[arg(long, value_name = "NAME")]
    pub(crate) fabric: Option<String>,
    /// Unit of the lengths of a drawing that does not state it.
    #[arg(long, value_name = "mm|cm|m|in|pt|px")]
    pub(crate) unit: Option<String>,
    /// Size to take from a graded DXF.
    #[arg(long, value_name = "SIZE")]
    pub(crate) size: Option<String>,
    /// Paper of a printer: the drawing becomes one SVG a page, TO-A1.svg and so on.
    #[arg(long, value_name = "a4|a3|letter|WxH")]
    pub(crate) paper: Option<String>,
    /// Largest width of the drawing, such as the width of a plotter's roll, in mm.
    #[arg(long, value_name = "MM", conflicts_with = "paper")]
    pub(crate) width: Option<f64>,
    /// Replaces files that exist.
    #[arg(long)]
    pub(crate) force: bool,
}
