//! Arguments of `drape fit`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use drape::fit::{FitSettings, FrictionOrder, Intervals, LoopModel, TractionModel};
use drape::input::Setting;

#[derive(Args)]
pub(crate) struct FitArguments {
    /// Sheets, TOML files, or folders: one with a sheet.toml, or one with such folders inside; -
    /// for standard input. Or tables, of which a sheet is drafted first: workbooks (.xlsx, .xls,
    /// .xlsm, .ods), .csv and other tables, a .zip, or a folder of exports without a sheet.
    #[arg(required = true, value_name = "SHEET")]
    pub(crate) sheets: Vec<PathBuf>,
    /// The fabric to write, - for stdout, or the folder for several [default: fabric.toml beside
    /// each sheet, NAME.toml for tables NAME]. The sheet that is drafted of tables is
    /// NAME.sheet.toml beside the fabric NAME.toml, and sheet.toml in a folder of exports.
    #[arg(short, long, value_name = "FABRIC.toml")]
    pub(crate) output: Option<PathBuf>,
    /// The fabric to take of tables that hold several.
    #[arg(long, value_name = "NAME")]
    pub(crate) fabric: Option<String>,
    /// Folder for a report with plots, one HTML page per sheet.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) report: Option<PathBuf>,
    /// Sets a key of the sheet in place of its value there, such as thickness=0.4; may be given
    /// several times. The key is a path of names and numbers, the value one of TOML.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<Setting>,
    /// Replaces fabrics, and sheets drafted of tables, that are there already.
    #[arg(long)]
    pub(crate) force: bool,
    /// Prints the fit as JSON, in SI.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) laws: LawArguments,
}

/// Laws that replace the laws which the curves support best.
#[derive(Args, Clone, Copy)]
pub(crate) struct LawArguments {
    /// Traction laws.
    #[arg(long, value_enum, value_name = "LAW")]
    traction: Option<Traction>,
    /// Bending laws.
    #[arg(long, value_enum, value_name = "LAW")]
    bending: Option<Loop>,
    /// Shear law.
    #[arg(long, value_enum, value_name = "LAW")]
    shear: Option<Loop>,
    /// Intervals from the profile of the residuals, for nonlinear laws and parameters at bounds;
    /// slower.
    #[arg(long)]
    profile: bool,
}

/// Traction laws.
#[derive(Clone, Copy, ValueEnum)]
enum Traction {
    /// An exponential toe that runs into its tangent, with friction that grows with the tension.
    Exponential,
    /// A priming zone that runs into a line (Ngo Ngoc & Boivin 2004).
    Primed,
    /// An even polynomial (Tagawa et al. 2003).
    Polynomial,
}

/// Laws of bending or shear, whose curves are loops.
#[derive(Clone, Copy, ValueEnum)]
enum Loop {
    /// A line with one friction element.
    FirstOrder,
    /// A line with two friction elements side by side: nested loops that grow.
    Parallel,
    /// A line with friction of second order (Bliman & Sorine 1995).
    SecondOrder,
    /// A stiffness that changes along the test, with one friction element.
    Varying,
    /// A quadratic and a line without friction (Breen et al. 1994).
    #[value(name = "breen-1994")]
    Breen,
}

impl Loop {
    /// Returns the [`LoopModel`] of the law.
    fn model(self) -> LoopModel {
        match self {
            Self::FirstOrder => LoopModel::Linear(FrictionOrder::First),
            Self::Parallel => LoopModel::Linear(FrictionOrder::Parallel),
            Self::SecondOrder => LoopModel::Linear(FrictionOrder::Second),
            Self::Varying => LoopModel::Varying,
            Self::Breen => LoopModel::Piecewise,
        }
    }
}

impl LawArguments {
    /// Returns the [`FitSettings`] that the arguments name.
    pub(crate) fn settings(self) -> FitSettings {
        FitSettings {
            traction: self.traction.map(|traction| match traction {
                Traction::Exponential => TractionModel::Exponential,
                Traction::Primed => TractionModel::Primed,
                Traction::Polynomial => TractionModel::Polynomial,
            }),
            bending: self.bending.map(Loop::model),
            shear: self.shear.map(Loop::model),
            intervals: if self.profile { Intervals::Profile } else { Intervals::Wald },
            ..FitSettings::default()
        }
    }
}
