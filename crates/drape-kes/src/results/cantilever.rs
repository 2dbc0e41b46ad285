//! Bending rigidity by the cantilever: a strip that bends under its weight by 41.5°.
//!
//! The bending length `$c$` is half of the overhang, and with the mass per area `$W$` \[Pei30\]
//!
//! ```math
//! B = W g c^3, \qquad
//! B[\mathrm{\mu N\,m}] = 9.81 \times 10^{-6}\, W[\mathrm{g/m^2}]\, c[\mathrm{mm}]^3
//! ```
//!
//! in the units that FAST prints \[DT94\]. ASTM D1388 \[ASTM14\] has a constant of 1.421e-5 in
//! place of 9.81e-6, which gives a rigidity 1.45 times as large. Strips of known rigidity
//! contradict the constant of ASTM D1388 \[LKL14\].

use drape_input::Quantity;

use crate::results::average::AveragedValue;
use crate::results::item::Item;
use crate::results::sheet_value::{ConvertedValues, DraftValue, FabricValues, computed, source_of};
use crate::test::Direction;

/// Acceleration of gravity in FAST, in m/s².
const GRAVITY: f64 = 9.81;
/// Constant of ASTM D1388 over the constant of Peirce.
const ASTM_RATIO: f64 = 1.421 / 0.981;
/// Bending length over the overhang at 45°, the angle of JIS L 1096. There `$wL^3/B$` of a heavy
/// elastica is 9.2539, and at 41.5° it is 8.0042.
const AT_45: f64 = 0.476_3;
/// Relative difference of a stated rigidity and the rigidity of the bending length up to which the
/// two agree. Printed lengths are rounded.
const ALIKE: f64 = 0.05;
/// Relative difference of the two rigidities above which a note is added.
const NOTED: f64 = 0.2;

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

/// Converts the bending lengths among `values` to bending rigidities, and adds them to `converted`.
pub(crate) fn convert_lengths(values: &mut FabricValues, converted: &mut ConvertedValues) {
    let mass = mass_of(values);
    for direction in [Some(Direction::Warp), Some(Direction::Weft), None] {
        let Some(length) = bending_length(values, direction) else { continue };
        let Some(mass) = mass else {
            let millimetres = computed(1e3 * length.length);
            converted.unused.push(format!(
                "bending length {millimetres} mm{}, {}: the bending rigidity needs W, the mass per area, too",
                of_direction(direction),
                length.why
            ));
            continue;
        };

        let rigidity = mass.density * GRAVITY * length.length.powi(3);
        if keep_given(values, direction, rigidity, converted) {
            continue;
        }
        let variation = length
            .deviation
            .map(|deviation| (3.0 * deviation / length.length).hypot(mass.variation));
        converted.values.push(DraftValue {
            key: "B",
            direction,
            number: computed(1e6 * rigidity),
            deviation: variation.map(|variation| computed(1e6 * rigidity * variation)),
            unit: Some("uN.m"),
            why: format!("W·g·c³, c = {} mm, {}", computed(1e3 * length.length), length.why),
        });
    }
}

/// Returns the mass per area among `values`, if it is given.
fn mass_of(values: &FabricValues) -> Option<Mass> {
    let AveragedValue { number, deviation, .. } = values.get(Item::Key("W"), None)?.value;
    let value = &values.get(Item::Key("W"), None)?.value;
    let density = value.si().unwrap_or(number * Quantity::MassPerArea.laboratory().factor);
    Some(Mass { density, variation: deviation.map_or(0.0, |deviation| deviation / number) })
}

/// Returns the bending length of `direction`: the given length, or a part of the overhang.
fn bending_length(values: &FabricValues, direction: Option<Direction>) -> Option<Length> {
    let parts = [(Item::BendingLength, 1.0), (Item::Overhang, 0.5), (Item::SteepOverhang, AT_45)];
    let (sourced, part) =
        parts.into_iter().find_map(|(item, part)| Some((values.get(item, direction)?, part)))?;
    let factor = part * sourced.value.unit?.factor;
    let deviation = sourced.value.deviation.map(|deviation| factor * deviation);
    Some(Length { length: factor * sourced.value.number, deviation, why: source_of(sourced) })
}

/// Returns whether the table's rigidity B is kept: it was measured in another test, or computed by
/// the same formula. A rigidity by the constant of ASTM D1388 is removed from `values`, in favour
/// of `rigidity`.
fn keep_given(
    values: &mut FabricValues,
    direction: Option<Direction>,
    rigidity: f64,
    converted: &mut ConvertedValues,
) -> bool {
    let Some(given) = values.get(Item::Key("B"), direction) else { return false };
    let bare = Quantity::BendingRigidity.laboratory().factor;
    let ratio = given.value.si().unwrap_or(given.value.number * bare) / rigidity;
    let (of, source) = (of_direction(direction), &given.source);
    if (ratio / ASTM_RATIO - 1.0).abs() < ALIKE {
        converted.notes.push(format!(
            "{source}: the flexural rigidity{of} is {ratio:.2} times W·g·c³, by the constant of ASTM D1388; W·g·c³ is taken"
        ));
        values.remove(Item::Key("B"), direction);
        return false;
    }
    if (ratio - 1.0).abs() > NOTED {
        converted.notes.push(format!(
            "{source}: B{of} is {ratio:.2} times W·g·c³ of the bending length; B is taken"
        ));
    }
    true
}

/// Returns `direction` as the end of a name; empty for no direction.
fn of_direction(direction: Option<Direction>) -> String {
    direction.map_or(String::new(), |direction| format!(" of the {}", direction.name()))
}
