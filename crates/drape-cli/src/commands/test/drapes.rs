//! Specimens of a fabric on a simulated drapemeter: draped, stored with a picture and a shadow, and
//! read again.
//!
//! `drape test --drape` and `drape report --drape` drape them by [`run`]. `drape report` reads
//! stored results by [`stored`].

pub(crate) mod run;
pub(crate) mod stored;

use clap::{Args, ValueEnum};
use drape::validate::drapemeter::{Drapemeter, Shake};

use crate::failure::Failure;

/// Largest default spacing, in m.
const SPACING_MAX: f64 = 0.005;

/// Options of specimens on a drapemeter.
#[derive(Args)]
pub(crate) struct DrapeArguments {
    /// The drapemeter.
    #[arg(long, value_enum, default_value = "frl", requires = "drape")]
    meter: Meter,
    /// Shakes the specimen after it has been lowered.
    #[arg(long, value_enum, requires = "drape")]
    shake: Option<ShakeName>,
    /// Specimens to drape, each from another start.
    #[arg(long, value_name = "N", default_value_t = 10, requires = "drape")]
    starts: u64,
}

/// Drapemeters, by the diameters of specimen and disc.
#[derive(Clone, Copy, ValueEnum)]
enum Meter {
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

impl Meter {
    /// Returns the [`Drapemeter`].
    fn drapemeter(self) -> Drapemeter {
        match self {
            Self::Frl => Drapemeter::frl(),
            Self::Cusick24 => Drapemeter::cusick(0.24),
            Self::Cusick30 => Drapemeter::cusick(0.3),
            Self::Cusick36 => Drapemeter::cusick(0.36),
        }
    }

    /// Returns the name and the sizes of the instrument, for people.
    fn description(self) -> &'static str {
        match self {
            Self::Frl => "FRL drapemeter, specimen of 254 mm on a disc of 127 mm",
            Self::Cusick24 => "Cusick's drapemeter, specimen of 24 cm on a disc of 18 cm",
            Self::Cusick30 => "Cusick's drapemeter, specimen of 30 cm on a disc of 18 cm",
            Self::Cusick36 => "Cusick's drapemeter, specimen of 36 cm on a disc of 18 cm",
        }
    }
}

/// Motions that shake a draped specimen.
#[derive(Clone, Copy, ValueEnum)]
enum ShakeName {
    /// The disc moves up and down three times by ±10 mm, twice a second.
    Bounce,
}

/// Drapes that the user requested.
pub(crate) struct DrapeRequest {
    meter: Drapemeter,
    /// Name and sizes of the instrument, and the shaking.
    description: String,
    pub(crate) starts: u64,
    /// Spacing of the particles, in m. `None` takes the spacing that the fabric requires.
    spacing: Option<f64>,
}

impl DrapeArguments {
    /// Returns the request for specimens with this `spacing`, in mm.
    pub(crate) fn request(&self, spacing: Option<f64>) -> Result<DrapeRequest, Failure> {
        check_spacing(spacing)?;
        if self.starts < 2 {
            let message = "--starts below 2 have no standard deviation; take 2 or more";
            return Err(Failure::Usage(message.into()));
        }
        let mut meter = self.meter.drapemeter();
        meter.protocol.shake = self.shake.map(|ShakeName::Bounce| Shake::BOUNCE);
        let shaken = self.shake.map_or("", |ShakeName::Bounce| ", shaken");
        Ok(DrapeRequest {
            meter,
            description: format!("{}{shaken}", self.meter.description()),
            starts: self.starts,
            spacing: spacing.map(|mm| 1e-3 * mm),
        })
    }
}

/// Refuses a `spacing`, in mm, outside the range of specimens.
pub(crate) fn check_spacing(spacing: Option<f64>) -> Result<(), Failure> {
    match spacing.filter(|mm| !(*mm >= 0.5 && *mm <= 50.0)) {
        Some(spacing) => {
            Err(Failure::Usage(format!("--spacing {spacing} is not between 0.5 and 50 (mm)")))
        }
        None => Ok(()),
    }
}
