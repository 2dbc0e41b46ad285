//! Converts values of CSIRO's FAST (Fabric Assurance by Simple Testing) to values of a sheet
//! \[DT94\].
//!
//! * FAST-1 measures the thickness under 2 and 100 gf/cm².
//! * FAST-2 is a cantilever ([`cantilever`](crate::results::cantilever)).
//! * FAST-3 measures the extension E5, E20, E100 at 5, 20 and 100 gf/cm: three points of a loading
//!   curve, whose work and largest extension are values of a sheet. EB5, the extension on the bias
//!   at 5 gf/cm, gives the shear stiffness
//!
//! ```math
//! G[\mathrm{N/m}] = \frac{123}{EB5[\%]}
//! ```
//!
//! because a load `$F$` per width on the bias shears by `$\gamma = F/(2G)$` and extends by half of
//! `$\gamma$`. The constant 123 is a quarter of 5 gf/cm in N/m, in percent.

use crate::results::item::Item;
use crate::results::sheet_value::{
    ConvertedValues, DraftValue, FabricValues, SourcedValue, computed, source_of,
};
use crate::test::Direction;
use drape_input::figure;

/// Loads of the extensions of FAST-3, in gf/cm.
const LOADS: [u32; 3] = [5, 20, 100];
/// G times EB5, in N/m times percent.
const SHEAR_CONSTANT: f64 = 123.0;
/// Values of the tensile test of KES, which measures more of the curve than FAST.
const KES_TENSILE: [Item; 4] = [Item::Key("EM"), Item::Key("LT"), Item::Key("WT"), Item::Key("RT")];

/// Adds the FAST values among `values` to `converted`, if a sheet has keys for them.
pub(crate) fn convert(values: &FabricValues, converted: &mut ConvertedValues) {
    add_thickness(values, converted);
    add_shear(values, converted);

    let has_kes = KES_TENSILE.iter().any(|item| values.has(*item));
    let mut has_curve = false;
    for direction in [Some(Direction::Warp), Some(Direction::Weft), None] {
        let points: Vec<(u32, &SourcedValue)> = LOADS
            .iter()
            .filter_map(|&load| Some((load, values.get(Item::Extension(load), direction)?)))
            .collect();
        if points.is_empty() {
            continue;
        }

        if has_kes || points.last().is_none_or(|(load, _)| *load != LOADS[2]) {
            let reason = if has_kes {
                "the tensile values of KES, which go to a larger load, are taken"
            } else {
                "E100, the extension at 100 gf/cm, is needed"
            };
            converted.unused.push(format!("{}: {reason}", list_extensions(&points)));
            continue;
        }
        has_curve = true;
        add_extension(direction, &points, converted);
    }
    if has_curve {
        converted.values.push(DraftValue {
            key: "FM",
            direction: None,
            number: f64::from(LOADS[2]),
            deviation: None,
            unit: Some("gf/cm"),
            why: "largest load of FAST-3".to_owned(),
        });
    }
}

/// Adds EM and LT of the loading curve through the extensions `points`.
fn add_extension(
    direction: Option<Direction>,
    points: &[(u32, &SourcedValue)],
    converted: &mut ConvertedValues,
) {
    let Some((largest, last)) = points.last() else { return };
    let unit = last.value.unit.map(|unit| unit.spelling);
    converted.values.push(DraftValue {
        key: "EM",
        direction,
        number: last.value.number,
        deviation: last.value.deviation,
        unit,
        why: format!("E{largest}, {}", source_of(last)),
    });

    let curve: Vec<[f64; 2]> = std::iter::once([0.0, 0.0])
        .chain(points.iter().map(|(load, sourced)| [sourced.value.number, f64::from(*load)]))
        .collect();
    let rises = curve.windows(2).all(|pair| pair[0][0] < pair[1][0]);
    if curve.len() < 3 || !rises {
        return;
    }
    let area = area_below(&curve);
    let linearity = 2.0 * area / (last.value.number * f64::from(*largest));
    converted.values.push(DraftValue {
        key: "LT",
        direction,
        number: (1e3 * linearity).round() / 1e3,
        deviation: None,
        unit: None,
        why: format!("by the area below {}", list_extensions(points)),
    });
}

/// Returns the area below the monotone cubic curve through `points` whose abscissae rise \[FC80\].
///
/// The slope at an inner point is the harmonic mean of the slopes on both sides, so that the curve
/// rises with the points.
fn area_below(points: &[[f64; 2]]) -> f64 {
    let chords: Vec<f64> = points
        .windows(2)
        .map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]))
        .collect();
    let widths: Vec<f64> = points.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
    let last = chords.len() - 1;
    let mut slopes = vec![end_slope([widths[0], widths[1]], [chords[0], chords[1]])];
    for i in 1..=last {
        let weights = [2.0 * widths[i] + widths[i - 1], widths[i] + 2.0 * widths[i - 1]];
        slopes.push(
            (weights[0] + weights[1]) / (weights[0] / chords[i - 1] + weights[1] / chords[i]),
        );
    }
    slopes.push(end_slope([widths[last], widths[last - 1]], [chords[last], chords[last - 1]]));

    (0..=last)
        .map(|i| {
            let mean = 0.5 * (points[i][1] + points[i + 1][1]);
            widths[i] * mean + widths[i].powi(2) * (slopes[i] - slopes[i + 1]) / 12.0
        })
        .sum()
}

/// Returns the slope at an end of the curve: the slope of the parabola through three points,
/// between zero and three times the nearest chord. `widths` and `chords` belong to the nearest
/// and the next interval.
fn end_slope(widths: [f64; 2], chords: [f64; 2]) -> f64 {
    let [a, b] = widths;
    let slope = ((2.0 * a + b) * chords[0] - a * chords[1]) / (a + b);
    slope.clamp(0.0, 3.0 * chords[0])
}

/// Returns the extensions `points` with their source, for comments.
fn list_extensions(points: &[(u32, &SourcedValue)]) -> String {
    let mut extensions = Vec::with_capacity(points.len());
    for (load, sourced) in points {
        let unit = sourced.value.unit.map_or("", |unit| unit.spelling);
        let extension = format!("E{load} = {} {unit}", figure(sourced.value.number));
        extensions.push(extension.trim_end().to_owned());
    }
    let source = points.first().map_or("", |(_, sourced)| sourced.source.as_str());
    format!("{} ({source})", extensions.join(", "))
}

/// Adds G computed from EB5, if no G is given.
fn add_shear(values: &FabricValues, converted: &mut ConvertedValues) {
    let Some(sourced) = values.get(Item::BiasExtension, None) else { return };
    let percent = sourced.value.si().map_or(sourced.value.number, |ratio| 100.0 * ratio);
    let stiffness = SHEAR_CONSTANT / percent;
    if values.has(Item::Key("G")) {
        converted.unused.push(format!(
            "EB5 = {} %, {}, gives G = {} N/m: the G of the files is taken",
            figure(percent),
            sourced.source,
            computed(stiffness)
        ));
        return;
    }

    let variation = sourced.value.deviation.map(|deviation| deviation / sourced.value.number);
    converted.values.push(DraftValue {
        key: "G",
        direction: None,
        number: computed(stiffness),
        deviation: variation.map(|variation| computed(stiffness * variation)),
        unit: Some("N/m"),
        why: format!("123/EB5, EB5 = {} %, {}", figure(percent), source_of(sourced)),
    });
}

/// Adds T, the thickness at 2 gf/cm², and TM, the thickness at 100 gf/cm², if they are not given.
fn add_thickness(values: &FabricValues, converted: &mut ConvertedValues) {
    for (pressure, key, others) in [(2, "T", &["T", "T0"][..]), (100, "TM", &["TM"][..])] {
        let Some(sourced) = values.get(Item::Thickness(pressure), None) else { continue };
        let unit = sourced.value.unit.map(|unit| unit.spelling);
        if others.iter().any(|other| values.has(Item::Key(other))) {
            converted.unused.push(format!(
                "thickness {} {} at {pressure} gf/cm2, {}: {} of the files is taken",
                figure(sourced.value.number),
                unit.unwrap_or_default(),
                sourced.source,
                others.join(" or ")
            ));
            continue;
        }

        let remark = if key == "TM" {
            "at 100 gf/cm2, where TM is at 50: a little too thin"
        } else {
            "at 2 gf/cm2"
        };
        converted.values.push(DraftValue {
            key,
            direction: None,
            number: sourced.value.number,
            deviation: sourced.value.deviation,
            unit,
            why: format!("{}, {remark}", source_of(sourced)),
        });
        if key == "TM" {
            converted
                .notes
                .push(format!("ASSUMED: TM is the thickness at 100 gf/cm2, {}", sourced.source));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_below_a_curve_of_few_points_is_that_of_the_curve() {
        // A line has its triangle.
        let line = area_below(&[[0.0, 0.0], [1.0, 5.0], [4.0, 20.0], [20.0, 100.0]]);
        assert!((line / 1000.0 - 1.0).abs() < 1e-12, "{line}");
        // F = k e^n through 5, 20 and 100, whose linearity is 2/(n + 1).
        for exponent in [1.2, 1.5, 2.0] {
            let extension = |load: f64| 4.0 * (load / 100.0_f64).powf(1.0 / exponent);
            let mut points = vec![[0.0, 0.0]];
            points.extend([5.0, 20.0, 100.0].map(|load| [extension(load), load]));
            let linearity = 2.0 * area_below(&points) / 400.0;
            let wanted = 2.0 / (exponent + 1.0);
            assert!(
                (linearity / wanted - 1.0).abs() < 0.02,
                "{exponent}: {linearity}, not {wanted}"
            );
        }
    }
}
