//! Palette: colours that distinguish the fabrics of runs.
//!
//! Pictures, the viewer and files for other programs use this palette, so that a fabric has one
//! colour in all of them.

use std::collections::BTreeMap;

use drape_frames::Recording;

/// Colour in sRGB: red, green, blue.
pub type Rgb = [u8; 3];

/// Colours of the front of fabrics for which the scene states none.
///
/// Any two colours differ by at least 12 in CIELAB, with usual sight and without the cones for
/// long, medium or short waves (simulation of Machado et al. 2009). The colours are light or warm,
/// since shadows show folds on light cloth.
const COLOURS: [Rgb; 8] = [
    [0x96, 0xb6, 0xd6],
    [0xcc, 0x6b, 0x42],
    [0xf2, 0xe6, 0xa0],
    [0x3f, 0xae, 0x90],
    [0x3f, 0x6f, 0xa8],
    [0xe0, 0xa0, 0x30],
    [0x75, 0x62, 0x4a],
    [0xe8, 0xe4, 0xf0],
];

/// Colour of the back of a fabric that is alone and for which the scene states no colour: sand.
const SAND: Rgb = [0xe2, 0xc4, 0x96];

/// Distance in sRGB below which a colour counts as one that the scene states.
const NEAR: f64 = 60.0;

/// Part by which the back is nearer to white than the front, and nearer to black where the front is
/// already light.
const PALER: f64 = 0.45;
const DARKER: f64 = 0.22;

/// Smallest mean of the three channels of a light colour.
const LIGHT: u16 = 190;

/// Part of a colour that is left after the colours of the palette are used up, for each time.
const AGAIN: f64 = 0.7;

/// Colours of the fabrics of one or several runs.
///
/// A fabric is known by its name. A colour that the scene states is kept. The other fabrics have
/// colours in the order of their names, so that the same names give the same colours.
///
/// ```
/// use drape_export::FabricPalette;
///
/// let palette = FabricPalette::new([("wool", None), ("cotton", None), ("wool", None)]);
/// assert_eq!(palette.legend().map(|(name, _)| name).collect::<Vec<_>>(), ["cotton", "wool"]);
/// assert_ne!(palette.sides("cotton"), palette.sides("wool"));
/// // A fabric that is alone needs no legend.
/// assert_eq!(FabricPalette::new([("wool", None)]).legend().count(), 0);
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FabricPalette {
    /// Colours of the front and the back, by the names of fabrics.
    sides: BTreeMap<String, [Rgb; 2]>,
    is_stated: bool,
}

impl FabricPalette {
    /// Returns the colours of `fabrics`: pairs of a name and the colour that the scene states. A
    /// fabric may occur several times. Its first stated colour counts.
    pub fn new<'a>(fabrics: impl IntoIterator<Item = (&'a str, Option<Rgb>)>) -> FabricPalette {
        let mut stated: BTreeMap<&str, Option<Rgb>> = BTreeMap::new();
        for (name, colour) in fabrics {
            let known = stated.entry(name).or_default();
            *known = known.or(colour);
        }
        let is_stated = stated.values().any(Option::is_some);
        let is_alone = stated.len() == 1 && !is_stated;
        let taken: Vec<Rgb> = stated.values().flatten().copied().collect();
        let is_free = |colour: &Rgb| taken.iter().all(|other| distance(*colour, *other) > NEAR);
        let mut free = (0..=u8::MAX).map(shade).filter(is_free);
        let mut sides_of = |colour: Option<Rgb>| {
            // After hundreds of fabrics no shade is left that can be told from the others.
            let front = colour.or_else(|| free.next()).unwrap_or(COLOURS[0]);
            [front, if is_alone { SAND } else { back(front) }]
        };
        let sides =
            stated.iter().map(|(name, colour)| ((*name).to_owned(), sides_of(*colour))).collect();
        FabricPalette { sides, is_stated }
    }

    /// Returns the colours of the fabrics of `runs`, which are shown together.
    pub fn of_runs<'a>(runs: impl IntoIterator<Item = &'a Recording>) -> FabricPalette {
        let panels = runs.into_iter().flat_map(|run| &run.manifest().panels);
        FabricPalette::new(panels.map(|panel| (&panel.fabric[..], panel.fabric_colour)))
    }

    /// Returns the colours of the front and the back of the fabric with the name `fabric`.
    #[must_use]
    pub fn sides(&self, fabric: &str) -> [Rgb; 2] {
        self.sides.get(fabric).copied().unwrap_or([COLOURS[0], SAND])
    }

    /// Returns whether there are several fabrics, or the scene states a colour.
    #[must_use]
    pub fn is_needed(&self) -> bool {
        self.is_stated || self.sides.len() > 1
    }

    /// Returns the name and the colour of the front of each fabric if there are several fabrics,
    /// and nothing if there is a single fabric.
    pub fn legend(&self) -> impl Iterator<Item = (&str, Rgb)> {
        let several = self.sides.iter().filter(|_| self.sides.len() > 1);
        several.map(|(name, [front, _])| (&name[..], *front))
    }
}

/// Returns the colour with `number` in the palette. After the last colour, the colours come again
/// darker.
fn shade(number: u8) -> Rgb {
    let rounds = number as usize / COLOURS.len();
    let left = AGAIN.powi(rounds as i32);
    COLOURS[number as usize % COLOURS.len()]
        .map(|channel| (left * f64::from(channel)).round() as u8)
}

/// Returns a colour of the back of a fabric that differs visibly from `front`.
fn back(front: Rgb) -> Rgb {
    let mean = front.iter().map(|channel| u16::from(*channel)).sum::<u16>() / 3;
    let (part, to) = if mean < LIGHT { (PALER, 255.0) } else { (DARKER, 0.0) };
    front.map(|channel| (f64::from(channel) + part * (to - f64::from(channel))).round() as u8)
}

/// Returns the distance of the colours `a` and `b` in sRGB.
fn distance(a: Rgb, b: Rgb) -> f64 {
    (0..3).map(|k| (f64::from(a[k]) - f64::from(b[k])).powi(2)).sum::<f64>().sqrt()
}

/// Returns the colour (`red`, `green`, `blue`) as hexadecimal text of CSS, such as `#96b6d6`.
pub(crate) fn hex([red, green, blue]: Rgb) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Returns the linear light of `colour`, 0 to 1 \[IEC61966\].
pub(crate) fn light(colour: Rgb) -> [f64; 3] {
    colour.map(|channel| {
        let value = f64::from(channel) / 255.0;
        let light =
            if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) };
        // Three digits are more than a screen shows.
        (1000.0 * light).round() / 1000.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Linear light as somebody sees it without the cones for long, medium and short waves:
    /// matrices of Machado, Oliveira and Fernandes 2009, "A physiologically-based model for
    /// simulation of color vision deficiency", at full severity.
    const SIGHTS: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152_286, 1.052_583, -0.204_868],
            [0.114_503, 0.786_281, 0.099_216],
            [-0.003_882, -0.048_116, 1.051_998],
        ],
        [
            [0.367_322, 0.860_646, -0.227_968],
            [0.280_085, 0.672_501, 0.047_413],
            [-0.011_820, 0.042_940, 0.968_881],
        ],
        [
            [1.255_528, -0.076_749, -0.178_779],
            [-0.078_411, 0.930_809, 0.147_602],
            [0.004_733, 0.691_367, 0.303_900],
        ],
    ];

    fn times(matrix: &[[f64; 3]; 3], vector: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| (0..3).map(|k| row[k] * vector[k]).sum())
    }

    /// Returns the place of linear light in CIELAB, for the white of sRGB.
    fn lab(light: [f64; 3]) -> [f64; 3] {
        let to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
        let white = [0.9505, 1.0, 1.089];
        let xyz = times(&to_xyz, light);
        let [x, y, z] = [0, 1, 2].map(|k| {
            let part = xyz[k] / white[k];
            if part > 0.008_856 { part.cbrt() } else { 7.787 * part + 16.0 / 116.0 }
        });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// Returns the smallest difference in CIELAB of two colours among all kinds of sight.
    fn difference(one: Rgb, other: Rgb) -> f64 {
        let seen = |sight, colour| lab(times(sight, light(colour)).map(|l| l.clamp(0.0, 1.0)));
        let seen_difference = |sight| {
            let [a, b] = [one, other].map(|colour| seen(sight, colour));
            (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
        };
        SIGHTS.iter().map(seen_difference).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn colours_are_told_apart_with_every_kind_of_sight() {
        for (number, one) in COLOURS.iter().enumerate() {
            for other in &COLOURS[..number] {
                let apart = difference(*one, *other);
                assert!(apart > 12.0, "{one:?} and {other:?} differ by {apart:.1}");
            }
            let apart = difference(*one, back(*one));
            assert!(apart > 8.0, "{one:?} and its back differ by {apart:.1}");
        }
    }

    #[test]
    fn a_stated_colour_is_kept_and_no_other_fabric_has_one_like_it() {
        let red = [0xd0, 0x6a, 0x40];
        let palette = FabricPalette::new([("b", None), ("a", None), ("c", Some(red))]);
        assert_eq!(palette.sides("c")[0], red);
        assert_eq!([palette.sides("a")[0], palette.sides("b")[0]], [COLOURS[0], COLOURS[2]]);
        let alone = FabricPalette::new([("c", Some(red)), ("c", None)]);
        assert!(alone.is_needed() && alone.legend().count() == 0);
        assert!(!FabricPalette::new([("c", None)]).is_needed());
    }

    #[test]
    fn thirty_fabrics_have_thirty_colours_in_the_order_of_their_names() {
        let names: Vec<String> = (0..30).map(|number| format!("fabric {number:02}")).collect();
        let fabrics = || names.iter().map(|name| (&name[..], None));
        let palette = FabricPalette::new(fabrics());
        assert_eq!(palette, FabricPalette::new(fabrics().rev()));
        let mut colours: Vec<Rgb> = palette.legend().map(|(_, colour)| colour).collect();
        assert_eq!(colours[..8], COLOURS);
        colours.sort_unstable();
        colours.dedup();
        assert_eq!(colours.len(), 30);
    }
}
