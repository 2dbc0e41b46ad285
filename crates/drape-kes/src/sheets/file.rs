//! The TOML form of a sheet: structs with the keys of the file. Units of values are resolved while
//! the values are decoded.
//!
//! `forms` has the values that may have several forms, and `stated` the numbers with their standard
//! deviations. Other spellings of the keys are known to `spelling`.

pub(crate) mod forms;
pub(crate) mod stated;

use drape_input::{
    BendingRigidity, ForcePerWidth, Length, MassPerArea, MomentPerWidth, Ratio, Roughness,
    ShearStiffness, WorkPerArea,
};
use serde::Deserialize;

use crate::sheets::file::forms::{ColumnOrLength, Columns, FileNames, LineCount, RecordText, Zero};
use crate::sheets::file::stated::Stated;
use crate::sheets::model::Model;
use crate::tables::grid::Separator;
use crate::tables::layout::{Column, Take};
use crate::tables::number::Decimal;
use crate::test::{Direction, Test};

/// Sheet of a laboratory.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SheetFile {
    pub(crate) name: String,
    #[serde(default)]
    pub(crate) source: String,
    pub(crate) customer: Option<RecordText>,
    pub(crate) article: Option<RecordText>,
    pub(crate) laboratory: Option<RecordText>,
    pub(crate) date: Option<RecordText>,
    pub(crate) specimens: Option<RecordText>,
    pub(crate) model: Option<Model>,
    #[serde(rename = "W")]
    pub(crate) w: Option<Stated<MassPerArea>>,
    #[serde(rename = "T")]
    pub(crate) t: Option<Stated<Length>>,
    #[serde(rename = "T0")]
    pub(crate) t0: Option<Stated<Length>>,
    #[serde(rename = "TM")]
    pub(crate) tm: Option<Stated<Length>>,
    #[serde(rename = "LC")]
    pub(crate) lc: Option<Stated<Ratio>>,
    #[serde(rename = "WC")]
    pub(crate) wc: Option<Stated<WorkPerArea>>,
    #[serde(rename = "RC")]
    pub(crate) rc: Option<Stated<Ratio>>,
    #[serde(rename = "FM")]
    pub(crate) fm: Option<Stated<ForcePerWidth>>,
    // Values for both directions.
    #[serde(rename = "B")]
    b: Option<Stated<BendingRigidity>>,
    #[serde(rename = "2HB")]
    two_hb: Option<Stated<MomentPerWidth>>,
    #[serde(rename = "G")]
    g: Option<Stated<ShearStiffness>>,
    #[serde(rename = "2HG")]
    two_hg: Option<Stated<ForcePerWidth>>,
    #[serde(rename = "2HG5")]
    two_hg5: Option<Stated<ForcePerWidth>>,
    #[serde(rename = "LT")]
    lt: Option<Stated<Ratio>>,
    #[serde(rename = "WT")]
    wt: Option<Stated<WorkPerArea>>,
    #[serde(rename = "RT")]
    rt: Option<Stated<Ratio>>,
    #[serde(rename = "EM")]
    em: Option<Stated<Ratio>>,
    #[serde(rename = "MIU")]
    miu: Option<Stated<Ratio>>,
    #[serde(rename = "MMD")]
    mmd: Option<Stated<Ratio>>,
    #[serde(rename = "SMD")]
    smd: Option<Stated<Roughness>>,
    /// Values along the warp.
    #[serde(default)]
    pub(crate) warp: ValuesFile,
    /// Values along the weft.
    #[serde(default)]
    pub(crate) weft: ValuesFile,
    /// Another place of the values for both directions, which `spelling` empties.
    #[serde(default, rename = "mean")]
    _mean: ValuesFile,
    #[serde(default)]
    pub(crate) curve: Vec<CurveFile>,
}

/// Values of one direction, or of both.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "UPPERCASE")]
pub(crate) struct ValuesFile {
    pub(crate) b: Option<Stated<BendingRigidity>>,
    #[serde(rename = "2HB")]
    pub(crate) two_hb: Option<Stated<MomentPerWidth>>,
    pub(crate) g: Option<Stated<ShearStiffness>>,
    #[serde(rename = "2HG")]
    pub(crate) two_hg: Option<Stated<ForcePerWidth>>,
    #[serde(rename = "2HG5")]
    pub(crate) two_hg5: Option<Stated<ForcePerWidth>>,
    pub(crate) lt: Option<Stated<Ratio>>,
    pub(crate) wt: Option<Stated<WorkPerArea>>,
    pub(crate) rt: Option<Stated<Ratio>>,
    pub(crate) em: Option<Stated<Ratio>>,
    pub(crate) miu: Option<Stated<Ratio>>,
    pub(crate) mmd: Option<Stated<Ratio>>,
    pub(crate) smd: Option<Stated<Roughness>>,
}

impl SheetFile {
    /// Returns the values for both directions, and leaves none.
    pub(crate) fn take_shared(&mut self) -> ValuesFile {
        ValuesFile {
            b: self.b.take(),
            two_hb: self.two_hb.take(),
            g: self.g.take(),
            two_hg: self.two_hg.take(),
            two_hg5: self.two_hg5.take(),
            lt: self.lt.take(),
            wt: self.wt.take(),
            rt: self.rt.take(),
            em: self.em.take(),
            miu: self.miu.take(),
            mmd: self.mmd.take(),
            smd: self.smd.take(),
        }
    }
}

/// Measured curve, in a table file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CurveFile {
    pub(crate) name: Option<String>,
    pub(crate) test: Test,
    pub(crate) direction: Direction,
    pub(crate) file: FileNames,
    #[serde(default)]
    pub(crate) deformation: DeformationFile,
    #[serde(default)]
    pub(crate) load: LoadFile,
    #[serde(default)]
    pub(crate) slack: bool,
    pub(crate) zero_strain: Option<Stated<Ratio>>,
    pub(crate) encoding: Option<String>,
    pub(crate) separator: Option<Separator>,
    pub(crate) decimal: Option<Decimal>,
    pub(crate) header: Option<LineCount>,
    pub(crate) skip: Option<LineCount>,
    pub(crate) sheet: Option<Column>,
    #[serde(default)]
    pub(crate) table: Take,
    #[serde(default)]
    pub(crate) specimen: Take,
    #[serde(default)]
    pub(crate) cycle: Take,
}

/// Axis of the deformation.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct DeformationFile {
    pub(crate) column: Columns,
    pub(crate) unit: Option<String>,
    pub(crate) gauge: Option<ColumnOrLength>,
    pub(crate) zero: Option<Zero>,
    pub(crate) reversed: Option<bool>,
}

/// Axis of the load.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct LoadFile {
    pub(crate) column: Columns,
    pub(crate) unit: Option<String>,
    pub(crate) width: Option<ColumnOrLength>,
    pub(crate) reversed: Option<bool>,
}
