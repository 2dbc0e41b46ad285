//! TOML form of a study.
//!
//! `StudyFile` mirrors the text of a study key by key. Nothing here is checked beyond its type.

use drape_input::TextOr;
use serde::Deserialize;

/// Study: many runs of one scene, fits of one sheet or tests of one fabric.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct StudyFile {
    /// Scene that is simulated, relative to the folder of the study.
    pub(crate) scene: Option<String>,
    /// Sheet of which a fabric is fitted, in place of a scene.
    pub(crate) fit: Option<String>,
    /// Fabric or sheet of which specimens are tested, in place of a scene.
    pub(crate) test: Option<String>,
    /// Options of `drape fit` or `drape test`, such as `["--drape", "--starts", "5"]`.
    #[serde(default)]
    pub(crate) options: Vec<String>,
    /// Folder for the results, relative to the folder of the study; in the current folder `out/`
    /// and the name of the study's file, if missing.
    pub(crate) output: Option<String>,
    /// Files of a finished run that are kept: `all`; `last`, the summary and the last state of the
    /// cloth as OBJ, or the fabric; or `measures`, the summary.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "all")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["all", "last", "measures"])))]
    pub(crate) keep: Option<String>,
    /// Keys that are set to one value after another. The levels of all axes and samples are
    /// combined. The levels of the last axis change first.
    #[serde(default)]
    pub(crate) axis: Vec<AxisFile>,
    /// Samples of ranges of several keys.
    #[serde(default)]
    pub(crate) sample: Vec<SampleFile>,
    /// Samples of the numbers of fitted fabrics, by the errors and correlations of their fits.
    #[serde(default)]
    pub(crate) covariance: Vec<CovarianceFile>,
    /// Keys of the base that are set to one value at all points, written as in the base.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(with = "serde_json::Map<String, serde_json::Value>"))]
    pub(crate) set: toml::Table,
    /// Values of the summaries that have columns in the table, and sections on the page; all of
    /// them if missing.
    #[serde(default)]
    pub(crate) measure: Vec<MeasureFile>,
}

/// Key of the base that is set to one value after another, by one of `values`, `range`, `files`
/// and `starts`.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct AxisFile {
    /// Key of the base, a path of names and numbers such as `panel.0.rectangle`; or `scene`, `fit`
    /// or `test`, the base itself, with `files`.
    pub(crate) key: String,
    /// Name of the column in the table; the key if missing.
    pub(crate) name: Option<String>,
    /// Values of the key, of any kind.
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<serde_json::Value>>"))]
    pub(crate) values: Option<Vec<toml::Value>>,
    /// Numbers at equal distances or ratios.
    pub(crate) range: Option<RangeFile>,
    /// Files, as a list or as a pattern such as `fabrics/*/sheet.toml`, relative to the folder of
    /// the study.
    pub(crate) files: Option<TextOr<Vec<String>>>,
    /// Number of random starts: values from 1 to this one for the `seed` of a panel's `noise`.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(1.0)))]
    pub(crate) starts: Option<u32>,
    /// Name of a group. Axes of one group go in step: their levels are paired and not combined.
    pub(crate) together: Option<String>,
}

/// Numbers at equal distances or ratios.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RangeFile {
    /// First number.
    pub(crate) start: f64,
    /// Last number.
    pub(crate) end: f64,
    /// Number of numbers.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(2.0)))]
    pub(crate) count: u32,
    /// Whether distances are equal, `linear`, or ratios, `log`.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "linear")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["linear", "log"])))]
    pub(crate) scale: Option<String>,
}

/// Sample of ranges of several keys.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SampleFile {
    /// Method: `sobol`, a scrambled Sobol sequence, or `latin-hypercube`.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["sobol", "latin-hypercube"])))]
    pub(crate) method: String,
    /// Number of points.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(1.0)))]
    pub(crate) count: u32,
    /// Number that chooses the sample.
    #[serde(default)]
    pub(crate) seed: u32,
    /// Ranges, one of each key.
    pub(crate) range: Vec<SampleRangeFile>,
}

/// Range of a key in a sample.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SampleRangeFile {
    /// Key of the base, as for an axis.
    pub(crate) key: String,
    /// Name of the column in the table; the key if missing.
    pub(crate) name: Option<String>,
    /// Lower end.
    pub(crate) start: f64,
    /// Upper end.
    pub(crate) end: f64,
    /// Whether numbers, `linear`, or their logarithms, `log`, are spread evenly.
    #[cfg_attr(feature = "schema", schemars(extend("default" = "linear")))]
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["linear", "log"])))]
    pub(crate) scale: Option<String>,
}

/// Sample of the fitted numbers of a fabric, all of them together.
///
/// Numbers above 0 are sampled on the logarithmic scale, so that they stay above 0.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct CovarianceFile {
    /// Name of the fabric in the scene.
    pub(crate) fabric: String,
    /// Fitted fabric, a `fabric.toml` with standard errors, relative to the folder of the study. It
    /// replaces the fabric of the scene.
    pub(crate) file: String,
    /// Number of samples.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(1.0)))]
    pub(crate) count: u32,
    /// Number that chooses the sample.
    #[serde(default)]
    pub(crate) seed: u32,
    /// Keys of the numbers, such as `warp.bending.rigidity`; all that have a standard error if
    /// missing. The others keep their values.
    pub(crate) keys: Option<Vec<String>>,
}

/// Value of the summaries of all runs.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct MeasureFile {
    /// Key in `summary.json`, such as `measures.openings.0.ease`.
    pub(crate) key: String,
    /// Name of the column in the table; the key if missing.
    pub(crate) name: Option<String>,
    /// Unit, such as `mm`, which is put behind the name; the number of the summary, in SI, if
    /// missing.
    pub(crate) unit: Option<String>,
}

/// Returns the JSON Schema of studies.
#[cfg(feature = "schema")]
#[must_use]
pub fn study_schema() -> serde_json::Value {
    let about = "Study of drape: many runs of one scene, fits of one sheet or tests of one fabric, \
                 with values of keys from lists, ranges, files and samples.";
    drape_input::schema_of::<StudyFile>("Study of drape", about, serde_json::Map::new())
}
