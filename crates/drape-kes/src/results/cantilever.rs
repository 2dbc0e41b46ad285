//! Bending rigidity by the cantilever: a strip that bends under its weight by 41.5°.
//!
//! The bending length `$c$` is half of the overhang, and with the mass per area `$W$` \[Pei30\]
//!
//! ```math
//! B = W g c^3, \qquad B[\mathrm{\mu N\,m}] = 9.81 \times 10^{-6}\, W[\mathrm{g/m^2}]\, c[\mathrm{mm}]^3
//! ```
//!
//! as FAST prints it \[DT94\]. ASTM D1388 \[ASTM14\] has a constant of 1.421e-5 in place of
//! 9.81e-6, which gives 1.45 times as much; measured against strips of known rigidity it is the one
//! that is off \[LKL14\].

use drape_input::Quantity;

use crate::results::average::Averaged;
use crate::results::item::Item;
use crate::results::sheet_value::{Converted, SheetValue, Values, computed, why};
use crate::test::Direction;

/// Acceleration of gravity as FAST has it, in m/s².
const GRAVITY: f64 = 9.81;
/// Constant of ASTM D1388 over that of Peirce.
const OF_ASTM: f64 = 1.421 / 0.981;
/// Bending length over the overhang at 45°, the angle of JIS L 1096: there `$wL^3/B$` is 9.2539 for
/// a heavy elastica, where it is 8.0042 at 41.5°.
const AT_45: f64 = 0.476_3;
/// Part by which a rigidity of a table may differ from that of its bending length: lengths are
/// rounded.
const ALIKE: f64 = 0.05;
/// Part from which on the two are told to differ.
const APART: f64 = 0.2;

/// Bending length in metres, with its standard deviation and its source.
struct Length {
    length: f64,
    deviation: Option<f64>,
    why: String,
}

/// Mass per area in kg/m², and its coefficient of variation.
#[derive(Clone, Copy)]
struct Mass {
    density: f64,
    variation: f64,
}

/// Converts bending lengths to bending rigidities.
pub(crate) fn rigidities(values: &mut Values, converted: &mut Converted) {
    let mass = mass(values);
    for direction in [Some(Direction::Warp), Some(Direction::Weft), None] {
        let Some(length) = length(values, direction) else { continue };
        let Some(mass) = mass else {
            let millimetres = computed(1e3 * length.length);
            converted.unused.push(format!(
                "bending length {millimetres} mm{}, {}: the bending rigidity needs W, the mass per area, too",
                of(direction),
                length.why
            ));
            continue;
        };
        let rigidity = mass.density * GRAVITY * length.length.powi(3);
        if keeps_given(values, direction, rigidity, converted) {
            continue;
        }
        let variation = length
            .deviation
            .map(|deviation| (3.0 * deviation / length.length).hypot(mass.variation));
        converted.values.push(SheetValue {
            key: "B",
            direction,
            number: computed(1e6 * rigidity),
            deviation: variation.map(|variation| computed(1e6 * rigidity * variation)),
            unit: Some("uN.m"),
            why: format!("W·g·c³, c = {} mm, {}", computed(1e3 * length.length), length.why),
        });
    }
}

fn mass(values: &Values) -> Option<Mass> {
    let Averaged { number, deviation, .. } = values.get(Item::Key("W"), None)?.value;
    let bare = Quantity::MassPerArea.laboratory().factor;
    let density = values.get(Item::Key("W"), None)?.value.si().unwrap_or(number * bare);
    Some(Mass { density, variation: deviation.map_or(0.0, |deviation| deviation / number) })
}

/// Returns the bending length: as it is given, or as a part of the overhang.
fn length(values: &Values, direction: Option<Direction>) -> Option<Length> {
    let parts = [(Item::BendingLength, 1.0), (Item::Overhang, 0.5), (Item::SteepOverhang, AT_45)];
    let mut found =
        parts.into_iter().filter_map(|(item, part)| Some((values.get(item, direction)?, part)));
    let (one, part) = found.next()?;
    let factor = part * one.value.unit?.factor;
    let deviation = one.value.deviation.map(|deviation| factor * deviation);
    Some(Length { length: factor * one.value.number, deviation, why: why(one) })
}

/// Returns whether the rigidity of the table is kept: it was measured otherwise, or by the same
/// formula. That of ASTM D1388 is removed.
fn keeps_given(
    values: &mut Values,
    direction: Option<Direction>,
    rigidity: f64,
    converted: &mut Converted,
) -> bool {
    let Some(given) = values.get(Item::Key("B"), direction) else { return false };
    let bare = Quantity::BendingRigidity.laboratory().factor;
    let ratio = given.value.si().unwrap_or(given.value.number * bare) / rigidity;
    let (of, source) = (of(direction), &given.source);
    if (ratio / OF_ASTM - 1.0).abs() < ALIKE {
        converted.notes.push(format!(
            "{source}: the flexural rigidity{of} is {ratio:.2} times W·g·c³, by the constant of ASTM D1388; W·g·c³ is taken"
        ));
        values.remove(Item::Key("B"), direction);
        return false;
    }
    if (ratio - 1.0).abs() > APART {
        converted.notes.push(format!(
            "{source}: B{of} is {ratio:.2} times W·g·c³ of the bending length; B is taken"
        ));
    }
    true
}

fn of(direction: Option<Direction>) -> String {
    direction.map_or(String::new(), |direction| format!(" of the {}", direction.name()))
}
