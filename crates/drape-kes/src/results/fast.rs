//! Values of CSIRO's FAST (Fabric Assurance by Simple Testing) made into values of a sheet
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
//! since a load `$F$` per width on the bias shears by `$\gamma = F/(2G)$` and extends by half of
//! `$\gamma$`: 123 is a quarter of 5 gf/cm in N/m, in percent.

use crate::results::item::Item;
use crate::results::sheet_value::{Converted, SheetValue, Sourced, Values, computed, why};
use crate::test::Direction;
use drape_input::figure;

/// Loads of the extensions, in gf/cm.
const LOADS: [u32; 3] = [5, 20, 100];
/// G times EB5, in N/m times percent.
const SHEAR: f64 = 123.0;
/// Values of the tensile test of KES, which measures more of the curve.
const OF_KES: [Item; 4] = [Item::Key("EM"), Item::Key("LT"), Item::Key("WT"), Item::Key("RT")];

/// Adds the values of FAST that a sheet has keys for.
pub(crate) fn convert(values: &Values, converted: &mut Converted) {
    thickness(values, converted);
    shear(values, converted);
    let has_kes = OF_KES.iter().any(|item| values.has(*item));
    let mut has_curve = false;
    for direction in [Some(Direction::Warp), Some(Direction::Weft), None] {
        let points: Vec<(u32, &Sourced)> = LOADS
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
            converted.unused.push(format!("{}: {reason}", listed(&points)));
            continue;
        }
        has_curve = true;
        extension(direction, &points, converted);
    }
    if has_curve {
        converted.values.push(SheetValue {
            key: "FM",
            direction: None,
            number: f64::from(LOADS[2]),
            deviation: None,
            unit: Some("gf/cm"),
            why: "largest load of FAST-3".to_owned(),
        });
    }
}

/// Adds EM and LT of a loading curve through the extensions.
fn extension(direction: Option<Direction>, points: &[(u32, &Sourced)], converted: &mut Converted) {
    let Some((largest, last)) = points.last() else { return };
    let unit = last.value.unit.map(|unit| unit.spelling);
    converted.values.push(SheetValue {
        key: "EM",
        direction,
        number: last.value.number,
        deviation: last.value.deviation,
        unit,
        why: format!("E{largest}, {}", why(last)),
    });
    let curve: Vec<[f64; 2]> = std::iter::once([0.0, 0.0])
        .chain(points.iter().map(|(load, one)| [one.value.number, f64::from(*load)]))
        .collect();
    let rises = curve.windows(2).all(|pair| pair[0][0] < pair[1][0]);
    if curve.len() < 3 || !rises {
        return;
    }
    let work = work(&curve);
    let linearity = 2.0 * work / (last.value.number * f64::from(*largest));
    converted.values.push(SheetValue {
        key: "LT",
        direction,
        number: (1e3 * linearity).round() / 1e3,
        deviation: None,
        unit: None,
        why: format!("by the area below {}", listed(points)),
    });
}

/// Returns the area below the monotone cubic curve through points whose abscissae rise \[FC80\].
///
/// The slope at an inner point is the harmonic mean of the slopes on both sides, so that the curve
/// rises where the points do.
fn work(points: &[[f64; 2]]) -> f64 {
    let slopes: Vec<f64> = points
        .windows(2)
        .map(|pair| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]))
        .collect();
    let width = |i: usize| points[i + 1][0] - points[i][0];
    let inner = |i: usize| {
        let (left, right) = (slopes[i - 1], slopes[i]);
        let weights = [2.0 * width(i) + width(i - 1), width(i) + 2.0 * width(i - 1)];
        (weights[0] + weights[1]) / (weights[0] / left + weights[1] / right)
    };
    // At an end the slope is that of the parabola through three points, between none and three
    // times the chord.
    let end = |near: usize, far: usize| {
        let [a, b] = [near, far].map(width);
        let slope = ((2.0 * a + b) * slopes[near] - a * slopes[far]) / (a + b);
        slope.clamp(0.0, 3.0 * slopes[near])
    };
    let last = slopes.len() - 1;
    let slope = |i: usize| match i {
        0 => end(0, 1),
        i if i > last => end(last, last - 1),
        i => inner(i),
    };
    (0..=last)
        .map(|i| {
            let mean = 0.5 * (points[i][1] + points[i + 1][1]);
            width(i) * mean + width(i).powi(2) * (slope(i) - slope(i + 1)) / 12.0
        })
        .sum()
}

/// Returns extensions with their source, for comments.
fn listed(points: &[(u32, &Sourced)]) -> String {
    let one = |(load, one): &(u32, &Sourced)| {
        let unit = one.value.unit.map_or("", |unit| unit.spelling);
        format!("E{load} = {} {unit}", figure(one.value.number)).trim_end().to_owned()
    };
    let all: Vec<String> = points.iter().map(one).collect();
    let source = points.first().map_or("", |(_, one)| one.source.as_str());
    format!("{} ({source})", all.join(", "))
}

/// Adds G by EB5, where no G is given.
fn shear(values: &Values, converted: &mut Converted) {
    let Some(one) = values.get(Item::BiasExtension, None) else { return };
    let percent = one.value.si().map_or(one.value.number, |ratio| 100.0 * ratio);
    let stiffness = SHEAR / percent;
    if values.has(Item::Key("G")) {
        converted.unused.push(format!(
            "EB5 = {} %, {}, gives G = {} N/m: the G of the files is taken",
            figure(percent),
            one.source,
            computed(stiffness)
        ));
        return;
    }
    let variation = one.value.deviation.map(|deviation| deviation / one.value.number);
    converted.values.push(SheetValue {
        key: "G",
        direction: None,
        number: computed(stiffness),
        deviation: variation.map(|variation| computed(stiffness * variation)),
        unit: Some("N/m"),
        why: format!("123/EB5, EB5 = {} %, {}", figure(percent), why(one)),
    });
}

/// Adds T by the thickness at 2 gf/cm², and TM by that at 100 gf/cm², where they are not given.
fn thickness(values: &Values, converted: &mut Converted) {
    for (pressure, key, others) in [(2, "T", &["T", "T0"][..]), (100, "TM", &["TM"][..])] {
        let Some(one) = values.get(Item::Thickness(pressure), None) else { continue };
        let unit = one.value.unit.map(|unit| unit.spelling);
        if others.iter().any(|other| values.has(Item::Key(other))) {
            converted.unused.push(format!(
                "thickness {} {} at {pressure} gf/cm2, {}: {} of the files is taken",
                figure(one.value.number),
                unit.unwrap_or_default(),
                one.source,
                others.join(" or ")
            ));
            continue;
        }
        let remark = if key == "TM" {
            "at 100 gf/cm2, where TM is at 50: a little too thin"
        } else {
            "at 2 gf/cm2"
        };
        converted.values.push(SheetValue {
            key,
            direction: None,
            number: one.value.number,
            deviation: one.value.deviation,
            unit,
            why: format!("{}, {remark}", why(one)),
        });
        if key == "TM" {
            converted
                .notes
                .push(format!("ASSUMED: TM is the thickness at 100 gf/cm2, {}", one.source));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_below_a_curve_of_few_points_is_that_of_the_curve() {
        // A line has its triangle.
        let line = work(&[[0.0, 0.0], [1.0, 5.0], [4.0, 20.0], [20.0, 100.0]]);
        assert!((line / 1000.0 - 1.0).abs() < 1e-12, "{line}");
        // F = k e^n through 5, 20 and 100, whose linearity is 2/(n + 1).
        for exponent in [1.2, 1.5, 2.0] {
            let extension = |load: f64| 4.0 * (load / 100.0_f64).powf(1.0 / exponent);
            let mut points = vec![[0.0, 0.0]];
            points.extend([5.0, 20.0, 100.0].map(|load| [extension(load), load]));
            let linearity = 2.0 * work(&points) / 400.0;
            let wanted = 2.0 / (exponent + 1.0);
            assert!(
                (linearity / wanted - 1.0).abs() < 0.02,
                "{exponent}: {linearity}, not {wanted}"
            );
        }
    }
}
