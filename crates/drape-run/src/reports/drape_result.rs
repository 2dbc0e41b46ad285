//! Results of specimens on a drapemeter, which are stored as a file and shown by a report.

use serde::{Deserialize, Serialize};

use drape_fabric::Fabric;
use drape_render::Picture;
use drape_report::ReportedDrape;
use drape_report::plot::ShadowPlot;
use drape_validate::drapemeter::{Drape, Study};

/// Half width of the interval of nineteen specimens in twenty, in standard deviations.
const SPECIMENS_95: f64 = 1.96;

/// Specimens of one fabric on a drapemeter. Lengths are in m, coefficients are ratios.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DrapeResult {
    /// Program that simulated the specimens.
    pub version: String,
    /// Name of the fabric.
    pub fabric: String,
    /// Digest of the laws of the fabric, by [`laws_digest`].
    pub laws: String,
    /// Instrument in words.
    pub meter: String,
    /// Radius of the disc.
    pub disc: f64,
    /// Radius of the flat specimen.
    pub specimen: f64,
    /// Distance of the particles.
    pub spacing: f64,
    /// Largest distance at which the coefficient is near the coefficients of finer grids.
    pub spacing_bound: f64,
    /// Interval of the coefficient over the parameters that the sheet leaves open. Both ends are
    /// equal if no parameter is open.
    pub interval: [f64; 2],
    /// The fabric with its friction first, then its variants.
    pub evaluations: Vec<DrapeEvaluation>,
    /// Index of the start of the first evaluation that the picture and the shadow show.
    pub shown: usize,
    /// File of the picture, beside the file of the result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub picture: Option<String>,
}

/// Drapes of one variant of a fabric from several starts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DrapeEvaluation {
    /// Variant in words.
    pub of: String,
    /// Mean drape coefficient.
    pub coefficient: f64,
    /// Standard deviation over the starts.
    pub deviation: f64,
    /// The starts.
    pub starts: Vec<DrapeStart>,
}

/// Drape of one specimen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DrapeStart {
    /// Drape coefficient.
    pub coefficient: f64,
    /// Number of nodes.
    pub nodes: usize,
    /// Amplitudes of the harmonics 1, 2, … of the shadow's edge.
    pub amplitudes: Vec<f64>,
    /// Radius of the shadow's edge at even angles from the weft.
    pub edge: Vec<f64>,
    /// Speed of the fastest particle at the end, in m/s.
    pub speed: f64,
}

impl DrapeEvaluation {
    /// Returns the evaluation of the variant `of` by its `study`.
    #[must_use]
    pub fn new(of: &str, study: &Study) -> Self {
        let start = |drape: &Drape| DrapeStart {
            coefficient: drape.coefficient,
            nodes: drape.nodes,
            amplitudes: drape.amplitudes.clone(),
            edge: drape.edge.clone(),
            speed: drape.speed,
        };
        Self {
            of: of.into(),
            coefficient: study.mean(),
            deviation: study.deviation(),
            starts: study.drapes.iter().map(start).collect(),
        }
    }
}

impl DrapeResult {
    /// Returns the result as a report shows it, with the `picture` of its start. Returns `None` for
    /// a result without starts.
    #[must_use]
    pub fn reported(&self, picture: Option<Picture>) -> Option<ReportedDrape> {
        let fitted = self.evaluations.first()?;
        let shown = fitted.starts.get(self.shown).or(fitted.starts.first())?;
        let [low, high] = self.interval;

        let is_open = low < high;
        let half = SPECIMENS_95 * fitted.deviation;
        let mut meaning = if is_open {
            "Interval: nine of ten fabrics with the same sheet, which leaves parameters open (their ends are assumed \
             ranges); the scatter of the specimens is not in it."
        } else {
            "Interval: 19 of 20 specimens, the mean ± 1.96 standard deviations."
        }
        .to_owned();
        if self.spacing > 1.05 * self.spacing_bound {
            meaning += &format!(
                " Coarse: the fabric requires particles at {:.1} mm or less, so the coefficient is not reliable.",
                1e3 * self.spacing_bound
            );
        }

        let mut nodes: Vec<usize> = fitted.starts.iter().map(|start| start.nodes).collect();
        nodes.sort_unstable();
        let counts = nodes.chunk_by(|a, b| a == b);

        Some(ReportedDrape {
            meter: self.meter.clone(),
            computed: format!(
                "Simulated by {}: {} specimens, particles at {:.1} mm.",
                self.version,
                fitted.starts.len(),
                1e3 * self.spacing
            ),
            coefficient: fitted.coefficient,
            deviation: fitted.deviation,
            interval: if is_open {
                self.interval
            } else {
                [(fitted.coefficient - half).max(0.0), (fitted.coefficient + half).min(1.0)]
            },
            meaning,
            nodes: counts.map(|alike| (alike[0], alike.len())).collect(),
            shadow: self.shadow(shown),
            picture,
        })
    }

    /// Returns the shadow of a `start`.
    fn shadow(&self, start: &DrapeStart) -> ShadowPlot {
        ShadowPlot {
            title: format!("shadow of {} from above", self.fabric),
            disc: self.disc,
            specimen: self.specimen,
            edge: start.edge.clone(),
        }
    }

    /// Returns the shadow of the start `shown`, if there is one.
    #[must_use]
    pub fn shown_shadow(&self) -> Option<ShadowPlot> {
        Some(self.shadow(self.evaluations.first()?.starts.get(self.shown)?))
    }
}

/// Returns a digest of the laws of a `fabric`. Names, sources and the provenance of numbers do not
/// count.
#[must_use]
pub fn laws_digest(fabric: &Fabric) -> String {
    let laws =
        Fabric { name: "laws".into(), source: String::new(), provenance: None, ..fabric.clone() };
    blake3::hash(laws.to_toml().as_bytes()).to_hex().to_string()
}
