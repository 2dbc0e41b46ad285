//! Options of pictures, which several commands have.

use std::str::FromStr;

use clap::{Args, ValueEnum};
use drape::export::Field;
use drape::frames::Recording;
use drape::render::Colour;

use crate::failure::Failure;
use crate::pages::picture::{ELEVATION, SIDES, SIZE, UPRIGHT};
use crate::pages::run_picture::{Direction, PictureSettings, WIDTH_MIN};

/// Largest number of pixels of a picture.
const PIXELS_MAX: u64 = 64_000_000;

#[derive(Args, Debug, Default)]
#[command(next_help_heading = "Options of pictures")]
pub(crate) struct LookArguments {
    /// Views, side by side: front, right, back, left, above, below, or AZIMUTH:ELEVATION in degrees
    /// [default: front,right,back of a garment, 30:28 of a cloth].
    #[arg(
        long = "view",
        value_name = "VIEW,...",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    views: Vec<Side>,
    /// Colour map of a field, with a legend: strain-warp, strain-weft, shear, curvature, pressure,
    /// distance, seam-gap or speed; of svg too [default of svg: strain-warp].
    #[arg(long, value_name = "FIELD")]
    map: Option<Field>,
    /// Ends of the colour map [default: the range of nearly all values].
    #[arg(long, value_name = "LOW,HIGH", requires = "map", allow_hyphen_values = true)]
    range: Option<Range>,
    /// Width and height, in pixels [default: 1200x900, of several views 600x1000 for each].
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,
    /// Colour of the cloth, and of its back.
    #[arg(long, value_name = "#RRGGBB[,#RRGGBB]", conflicts_with = "map")]
    fabric_colour: Option<FabricColour>,
    /// Leaves something out.
    #[arg(long, value_enum, value_name = "WHAT")]
    without: Option<OmittedPart>,
}

/// Part of a picture that can be left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum OmittedPart {
    /// Bodies: the cloth alone.
    Bodies,
}

impl LookArguments {
    /// Returns the [`Field`] of `--map`.
    pub(crate) fn map(&self) -> Option<Field> {
        self.map
    }

    /// Returns the names of the options that the user gave, such as `--map`.
    pub(crate) fn given(&self) -> impl Iterator<Item = &'static str> {
        let given = [
            ("--view", !self.views.is_empty()),
            ("--map", self.map.is_some()),
            ("--range", self.range.is_some()),
            ("--size", self.size.is_some()),
            ("--fabric-colour", self.fabric_colour.is_some()),
            ("--without", self.without.is_some()),
        ];
        given.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name)
    }

    /// Returns the settings for pictures of `recording`. `size` is the default width and height, in
    /// pixels.
    pub(crate) fn settings(
        &self,
        recording: &Recording,
        size: Option<[u32; 2]>,
    ) -> Result<PictureSettings, Failure> {
        let is_garment = !recording.manifest().seam_pairs.is_empty();
        let views: Vec<Direction> = match (&self.views[..], is_garment) {
            ([], true) => SIDES.map(level).into(),
            ([], false) => vec![Direction { azimuth: 30.0, elevation: 28.0 }],
            (views, _) => views.iter().map(|view| view.0).collect(),
        };
        let columns = views.len() as u32;
        let default_size = if columns == 1 { SIZE } else { [columns * UPRIGHT[0], UPRIGHT[1]] };
        let settings = PictureSettings {
            views,
            columns,
            size: self.size.map(|size| size.0).or(size).unwrap_or(default_size),
            map: self.map,
            range: self.range.map(|range| range.0),
            colours: self.fabric_colour.map(|colours| colours.0),
            bodies: self.without.is_none(),
        };
        settings.check("one frame")?;
        Ok(settings)
    }
}

/// Returns the direction of a view from `azimuth`, in degrees, at the elevation of pictures of
/// garments.
fn level(azimuth: f64) -> Direction {
    Direction { azimuth, elevation: ELEVATION }
}

/// Direction of a view, parsed from the name of a side or from azimuth and elevation.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Side(Direction);

impl FromStr for Side {
    type Err = String;

    fn from_str(text: &str) -> Result<Side, String> {
        Ok(Side(match text.trim() {
            "front" => level(0.0),
            "right" | "side" => level(90.0),
            "back" => level(180.0),
            "left" => level(-90.0),
            "above" => Direction { azimuth: 0.0, elevation: 90.0 },
            "below" => Direction { azimuth: 0.0, elevation: -90.0 },
            text => {
                let numbers = text.split_once(':').and_then(|(azimuth, elevation)| {
                    Some([azimuth.parse().ok()?, elevation.parse().ok()?])
                });

                // A camera beyond these angles repeats another direction.
                match numbers {
                    Some([azimuth, elevation])
                        if f64::abs(azimuth) <= 360.0 && f64::abs(elevation) <= 90.0 =>
                    {
                        Direction { azimuth, elevation }
                    }
                    _ => {
                        return Err(format!(
                            "`{text}` is no view; give front, right, back, left, above, below, or an azimuth up to 360 and an elevation up to 90 degrees, such as 30:28"
                        ));
                    }
                }
            }
        }))
    }
}

/// Range of a colour map, parsed from `LOW,HIGH`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Range([f64; 2]);

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Range, String> {
        let ends = text
            .split_once(',')
            .and_then(|(low, high)| Some([low.trim().parse().ok()?, high.trim().parse().ok()?]));
        let range =
            ends.filter(|[low, high]: &[f64; 2]| low.is_finite() && high.is_finite() && low < high);
        range.map(Range).ok_or_else(|| {
            format!("`{text}` is no range; give a lower and a higher number, such as -2,2")
        })
    }
}

/// Width and height in pixels, parsed from `WxH`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Size([u32; 2]);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Size, String> {
        let sides = text.split_once(['x', 'X']).and_then(|(width, height)| {
            Some([width.trim().parse().ok()?, height.trim().parse().ok()?])
        });
        let size = sides.filter(|[width, height]: &[u32; 2]| {
            let pixels = u64::from(*width) * u64::from(*height);
            (WIDTH_MIN..=16384).contains(width)
                && (2 * WIDTH_MIN..=16384).contains(height)
                && pixels <= PIXELS_MAX
        });
        size.map(Size).ok_or_else(|| {
            format!(
                "`{text}` is no size; give width and height from 128 to 16384 pixels, at most 64 million together, such as 1600x1200"
            )
        })
    }
}

/// Colours of the front and the back, parsed from `#RRGGBB[,#RRGGBB]`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct FabricColour([Colour; 2]);

impl FromStr for FabricColour {
    type Err = String;

    fn from_str(text: &str) -> Result<FabricColour, String> {
        let (front, back) = text.split_once(',').unwrap_or((text, text));
        let colours = colour(front).zip(colour(back));
        colours.map(|(front, back)| FabricColour([front, back])).ok_or_else(|| {
            format!("`{text}` is no colour; give six hexadecimal digits, such as #c8d6e5, and a second for the back after a comma")
        })
    }
}

/// Parses six hexadecimal digits as red, green and blue.
fn colour(text: &str) -> Option<Colour> {
    let digits = text.trim().trim_start_matches('#');
    let is_hexadecimal = digits.len() == 6 && digits.bytes().all(|d| d.is_ascii_hexdigit());
    let number = u32::from_str_radix(digits, 16).ok().filter(|_| is_hexadecimal)?;
    let [_, red, green, blue] = number.to_be_bytes();
    Some([red, green, blue])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_colours_sizes_and_ranges_are_read() {
        let view = |text: &str| text.parse().map(|Side(direction)| direction);
        assert_eq!(view("side"), view("right"));
        assert_eq!(view("-30:12.5"), Ok(Direction { azimuth: -30.0, elevation: 12.5 }));
        let colours = |text: &str| text.parse().map(|FabricColour(colours)| colours);
        assert_eq!(colours("#0a0B0c"), Ok([[10, 11, 12]; 2]));
        assert_eq!(colours("ffffff, #000000"), Ok([[255; 3], [0; 3]]));
        assert_eq!("1600x1200".parse(), Ok(Size([1600, 1200])));
        assert_eq!("-2,2.5".parse(), Ok(Range([-2.0, 2.5])));
        assert_eq!("shear".parse().ok(), Some(Field::Shear));
    }

    #[test]
    fn mistakes_name_a_remedy_that_is_taken() {
        for wrong in ["top", "30", "30:91", "nan:3", "400:0", ""] {
            let error = wrong.parse::<Side>().expect_err("no view");
            assert!(error.contains("30:28") && "30:28".parse::<Side>().is_ok(), "{error}");
        }
        for wrong in ["red", "#12345", "#12345g", "#+12345", "#123456,", "äääääé"] {
            let error = wrong.parse::<FabricColour>().expect_err("no colour");
            assert!(
                error.contains("#c8d6e5") && "#c8d6e5".parse::<FabricColour>().is_ok(),
                "{error}"
            );
        }
        for wrong in ["1200", "0x100", "100000x100", "16000x16000", "-5x100", "12.5x100"] {
            let error = wrong.parse::<Size>().expect_err("no size");
            assert!(error.contains("1600x1200") && "1600x1200".parse::<Size>().is_ok(), "{error}");
        }
        for wrong in ["2", "2,1", "1,1", "nan,1", "0,inf", ","] {
            let error = wrong.parse::<Range>().expect_err("no range");
            assert!(error.contains("-2,2") && "-2,2".parse::<Range>().is_ok(), "{error}");
        }
        let error = "strain".parse::<Field>().expect_err("no field").to_string();
        assert!(error.contains("strain-warp, strain-weft"), "{error}");
    }
}
