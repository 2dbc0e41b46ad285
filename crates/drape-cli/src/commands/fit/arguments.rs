//! Arguments of `drape fit`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use drape::fit::{FitSettings, Intervals, LoopModel, TractionModel};
use drape::input::Setting;
use drape::kes::Model;

use crate::console::note;

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
#[derive(Args)]
pub(crate) struct LawArguments {
    /// Traction laws.
    #[arg(long, value_parser = traction_laws(), value_name = "LAW")]
    traction: Option<TractionModel>,
    /// Bending laws.
    #[arg(long, value_parser = loop_laws(), value_name = "LAW")]
    bending: Option<LoopLaw>,
    /// Shear law.
    #[arg(long, value_parser = loop_laws(), value_name = "LAW")]
    shear: Option<LoopLaw>,
    /// Intervals from the profile of the residuals, for nonlinear laws and parameters at bounds;
    /// slower.
    #[arg(long)]
    profile: bool,
}

/// Law of bending or shear, whose curves are loops.
#[derive(Clone)]
struct LoopLaw {
    law: Model,
    /// Note on the name, if the name is a former one.
    note: Option<String>,
}

impl LoopLaw {
    /// Returns the [`LoopModel`] of the law, and prints the note on its name.
    fn model(&self) -> LoopModel {
        self.note.iter().for_each(note);
        self.law.into()
    }
}

/// Returns the parser of the names of traction laws.
fn traction_laws() -> impl TypedValueParser<Value = TractionModel> {
    let laws = TractionModel::ALL.map(|law| possible_value(law.name(), law.description()));
    PossibleValuesParser::new(laws)
        .map(|name| TractionModel::named(&name).expect("the parser accepts only names of laws"))
}

/// Returns the parser of the names of loop laws. Former names are accepted and not listed.
fn loop_laws() -> impl TypedValueParser<Value = LoopLaw> {
    let current = Model::ALL.map(|law| possible_value(law.name(), law.description()));
    let former = Model::FORMER_NAMES.map(|(name, _)| PossibleValue::new(name).hide(true));
    let names = PossibleValuesParser::new(current.into_iter().chain(former));
    names.map(|name| LoopLaw {
        law: Model::named(&name).expect("the parser accepts only names of laws"),
        note: Model::note_on(&name),
    })
}

/// Returns the value `name` with its `description`, which begins with a capital letter in the help.
fn possible_value(name: &'static str, description: &str) -> PossibleValue {
    let mut letters = description.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    let help: String = first.into_iter().chain(letters).collect();
    PossibleValue::new(name).help(help)
}

impl LawArguments {
    /// Returns the [`FitSettings`] that the arguments name, and prints notes on former names.
    pub(crate) fn settings(&self) -> FitSettings {
        FitSettings {
            traction: self.traction,
            bending: self.bending.as_ref().map(LoopLaw::model),
            shear: self.shear.as_ref().map(LoopLaw::model),
            intervals: if self.profile { Intervals::Profile } else { Intervals::Wald },
            ..FitSettings::default()
        }
    }
}
