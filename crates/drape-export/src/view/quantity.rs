//! Quantity: the plain name and the unit of a number of `summary.json`, by its key.

use drape_input::brief;

/// Quantity of a summary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Quantity {
    /// Name that a person reads.
    pub(super) name: &'static str,
    pub(super) unit: Unit,
}

/// Unit in which a quantity is shown; the summary has SI, ratios and radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Unit {
    /// Number without a unit.
    None,
    /// Length in m, shown in mm.
    Length,
    /// Ratio, shown in %.
    Percent,
    /// Angle in rad, shown in °.
    Angle,
    /// Unit that the value already has.
    Plain(&'static str),
    /// Speed in m/s, shown in mm/s.
    Speed,
    /// Energy in J, shown in the largest of J, mJ, µJ and nJ that leaves a digit before the point.
    Energy,
}

use Unit::{Angle, Energy, Length, None as Bare, Percent, Plain, Speed};

/// Key, or end of a path of keys, with its name and unit. The first entry that fits counts.
const QUANTITIES: &[(&str, &str, Unit)] = &[
    // The run.
    ("status", "status", Bare),
    ("settled", "at rest", Bare),
    ("simulated_seconds", "simulated time", Plain("s")),
    ("particles", "particles", Bare),
    ("speed_max", "fastest particle", Speed),
    ("imbalance", "imbalance of the forces", Plain("g")),
    // Strain at the end.
    ("traction_max", "largest strain of a yarn", Percent),
    ("traction_p99", "99 of 100 yarn segments below", Percent),
    ("shear_max", "largest shear angle", Angle),
    ("curvature_p99", "99 of 100 curvatures below", Plain("1/m")),
    // Contact.
    ("min_distance", "smallest distance", Length),
    ("pairs_max", "most pairs in contact", Bare),
    ("intersections", "intersections at the end", Bare),
    ("crossings_found", "intersections taken back", Bare),
    ("exempt_intersections_max", "most intersections of closing seams", Bare),
    ("exempt_intersections", "intersections of closing seams at the end", Bare),
    ("exempt_penetration_max", "deepest intersection of closing seams", Length),
    ("thinned_max", "most particles that were pinched", Bare),
    ("released_max", "most particles that were released", Bare),
    ("grown_from", "minimum separation at the start", Percent),
    ("grown", "minimum separation at the end", Percent),
    // Balance of the energy.
    ("energy.kinetic", "kinetic", Energy),
    ("energy.elastic", "elastic", Energy),
    ("energy.gravity", "gravity", Energy),
    ("energy.contact", "contact", Energy),
    ("friction_dissipated", "lost in the fabric", Energy),
    ("body_dissipated", "lost on bodies", Energy),
    ("cloth_dissipated", "lost of cloth on cloth", Energy),
    ("air_dissipated", "lost to the air", Energy),
    ("pinch_released", "set free where bodies pinched cloth", Energy),
    ("numerical_dissipated", "taken by the integration", Energy),
    ("relaxation_dissipated", "of which relaxation took on purpose", Energy),
    ("turning_dissipated", "cost of the rotation of the cloth", Energy),
    ("work_in", "work of bodies, pins and forces", Energy),
    ("remainder", "unaccounted for", Energy),
    ("unproved", "exchanged in unproved steps", Energy),
    ("exchanged", "exchanged in all steps", Energy),
    ("proved", "exchanged in proved steps", Energy),
    // Garments.
    ("seam_gap_max", "widest gap of a seam", Length),
    ("lowest", "lowest point", Length),
    ("height_mean", "mean height", Length),
    ("height_min", "lowest height", Length),
    ("height_max", "highest height", Length),
    ("length", "length", Length),
    ("relaxed", "length before deformation", Length),
    ("body", "girth of the body", Length),
    ("folds", "folds", Bare),
    ("ease", "ease", Length),
    ("pressure.area", "area in contact", Plain("m²")),
    ("pressure.mean", "mean", Plain("Pa")),
    ("pressure.p99", "99 of 100 places below", Plain("Pa")),
    ("pressure.max", "largest", Plain("Pa")),
    ("warp.min", "smallest", Percent),
    ("warp.p01", "1 of 100 below", Percent),
    ("warp.median", "median", Percent),
    ("warp.p99", "99 of 100 below", Percent),
    ("warp.max", "largest", Percent),
    ("weft.min", "smallest", Percent),
    ("weft.p01", "1 of 100 below", Percent),
    ("weft.median", "median", Percent),
    ("weft.p99", "99 of 100 below", Percent),
    ("weft.max", "largest", Percent),
    ("shear.min", "smallest", Angle),
    ("shear.p01", "1 of 100 below", Angle),
    ("shear.median", "median", Angle),
    ("shear.p99", "99 of 100 below", Angle),
    ("shear.max", "largest", Angle),
];

/// Ends of the names of keys that say the unit of a value.
const ENDS: [(&str, &str); 5] =
    [("_seconds", "s"), ("_percent", "%"), ("_deg", "°"), ("_mm", "mm"), ("_newton", "N")];

impl Quantity {
    /// Returns the quantity of `path`, which has keys from the outermost to the innermost.
    pub(super) fn of(path: &[&str]) -> Option<Quantity> {
        let (_, name, unit) = *QUANTITIES.get(Quantity::rank(path))?;
        Some(Quantity { name, unit })
    }

    /// Returns the position in a table of the value at `path`. Paths without a quantity come last.
    pub(super) fn rank(path: &[&str]) -> usize {
        let fits = |(key, ..): &(&str, &str, Unit)| {
            let keys: Vec<&str> = key.split('.').collect();
            path.ends_with(&keys)
        };
        QUANTITIES.iter().position(fits).unwrap_or(QUANTITIES.len())
    }
}

impl Unit {
    /// Returns the unit that the end of the unknown `key` states, and the key without this end.
    pub(super) fn of_unknown(key: &str) -> (Unit, &str) {
        let end = ENDS.iter().find_map(|(end, unit)| Some((Plain(unit), key.strip_suffix(end)?)));
        end.filter(|(_, rest)| !rest.is_empty()).unwrap_or((Bare, key))
    }

    /// Returns `value` in the unit, as text.
    pub(super) fn written(self, value: f64) -> String {
        let (factor, unit) = match self {
            Bare => (1.0, ""),
            Length => (1e3, "mm"),
            Percent => (100.0, "%"),
            Angle => (1.0_f64.to_degrees(), "°"),
            Plain(unit) => (1.0, unit),
            Speed => (1e3, "mm/s"),
            Energy => {
                let units = [(1.0, "J"), (1e3, "mJ"), (1e6, "µJ"), (1e9, "nJ")];
                let fits = |(factor, _): &(f64, &str)| factor * value.abs() >= 1.0;
                // What is below a nanojoule is nothing beside the energy of any cloth.
                units.into_iter().find(fits).unwrap_or((1.0, "J"))
            }
        };
        let number = brief(factor * value, 3).replace('-', "−");
        match unit {
            "" => number,
            "°" => format!("{number}°"),
            unit => format!("{number} {unit}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_their_unit_and_the_digits_that_matter() {
        let cases = [
            (Length, 0.000_213_44, "0.213 mm"),
            (Length, 1.087_51, "1088 mm"),
            (Percent, 0.125_876, "12.6 %"),
            (Percent, 1.0, "100 %"),
            (Angle, -0.408_94, "−23.4°"),
            (Speed, 8.88e-7, "0.000888 mm/s"),
            (Plain("Pa"), 5655.3, "5655 Pa"),
            (Plain("m²"), 0.165_749, "0.166 m²"),
            (Energy, -1.823_9e-5, "−18.2 µJ"),
            (Energy, 0.036_9, "36.9 mJ"),
            (Energy, -1.36e-16, "−1.36e−16 J"),
            (Energy, 0.0, "0 J"),
            (Bare, 924.0, "924"),
            (Bare, 7.0, "7"),
            (Bare, 123_456.0, "123456"),
            (Bare, 3.14e9, "3.14e9"),
        ];
        for (unit, value, text) in cases {
            assert_eq!(unit.written(value), text, "{value}");
        }
    }

    #[test]
    fn the_longest_path_that_fits_decides_on_the_unit() {
        let of = |path: &[&str]| Quantity::of(path).expect("a quantity");
        assert_eq!(of(&["strain", "shear", "max"]).unit, Angle);
        assert_eq!(of(&["pressure", "max"]).unit, Plain("Pa"));
        assert_eq!(of(&["openings", "length"]).unit, Length);
        assert_eq!(of(&["energy", "contact"]).unit, Energy);
        assert_eq!(Quantity::of(&["openings", "max"]), None);
        assert_eq!(Unit::of_unknown("cooling_seconds"), (Plain("s"), "cooling"));
        assert_eq!(Unit::of_unknown("_seconds"), (Bare, "_seconds"));
    }
}
