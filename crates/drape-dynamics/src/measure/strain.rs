//! Strains of the cloth, and warnings where they exceed the measured range of the fabric.

use drape_cloth::TriangleStrain;
use serde_json::{Map, Value, json};

use crate::measure::garment_parts::GarmentParts;
use crate::world::{ALL_PARTICLES, World};

/// Fraction of the area of a cloth that may be deformed beyond the measured range of its fabric
/// without a warning.
const UNMEASURED: f64 = 1e-3;

/// Measured law, and the deformation that is compared with its measured range.
struct MeasuredLaw {
    key: &'static str,
    name: &'static str,
    deformation: fn(&TriangleStrain) -> f64,
    written: fn(f64) -> String,
}

const LAWS: [MeasuredLaw; 3] = [
    MeasuredLaw {
        key: "warp.traction",
        name: "stretch along the warp",
        deformation: |strain| strain.warp,
        written: percent,
    },
    MeasuredLaw {
        key: "weft.traction",
        name: "stretch along the weft",
        deformation: |strain| strain.weft,
        written: percent,
    },
    MeasuredLaw {
        key: "shear",
        name: "shear",
        deformation: |strain| strain.shear.sin().abs(),
        written: |sine| format!("{:.1}°", sine.asin().to_degrees()),
    },
];

fn percent(strain: f64) -> String {
    format!("{:.1} %", 100.0 * strain)
}

fn strains(world: &World) -> Vec<TriangleStrain> {
    world.cloth.triangle_strains(&world.state.positions).expect(ALL_PARTICLES)
}

/// Deformation of a triangle.
struct Deformed {
    value: f64,
    /// Area of the triangle, in m².
    area: f64,
}

/// Returns quantiles of the strains over the area of the cloth of `world`: minimum, 1 %, median, 99
/// % and maximum.
pub(crate) fn measures(world: &World) -> Value {
    let strains = strains(world);
    let mut measures = Map::new();
    measures.insert("warp".into(), quantiles(&strains, |strain| strain.warp));
    measures.insert("weft".into(), quantiles(&strains, |strain| strain.weft));
    measures.insert("shear".into(), quantiles(&strains, |strain| strain.shear));
    Value::Object(measures)
}

/// Returns the quantiles of `deformation` over the area of the triangles `strains`.
fn quantiles(strains: &[TriangleStrain], deformation: fn(&TriangleStrain) -> f64) -> Value {
    let values =
        strains.iter().map(|strain| Deformed { value: deformation(strain), area: strain.area });
    let mut values: Vec<Deformed> = values.collect();
    values.sort_by(|a, b| a.value.total_cmp(&b.value));

    // Fraction of the area up to each triangle, in ascending order of the deformation.
    let total: f64 = values.iter().map(|deformed| deformed.area).sum();
    let mut sum = 0.0;
    let mut fractions = Vec::with_capacity(values.len());
    for deformed in &values {
        sum += deformed.area;
        fractions.push(sum / total);
    }

    let [min, p01, median, p99, max] = [0.0, 0.01, 0.5, 0.99, 1.0].map(|part| {
        let index = fractions.partition_point(|fraction| *fraction < part);
        values.get(index).or(values.last()).map(|deformed| deformed.value)
    });
    json!({ "min": min, "p01": p01, "median": median, "p99": p99, "max": max })
}

/// Returns a warning for each law of a fabric of `parts` whose cloth in `world` is deformed beyond
/// the measured range.
pub(crate) fn extrapolated(parts: &GarmentParts, world: &World) -> Vec<String> {
    let strains = strains(world);
    let mut warnings = Vec::new();
    for (fabric, ranges) in &parts.measured_ranges {
        let of_fabric = world.cloth.triangles().iter().zip(&strains).filter(|(corners, _)| {
            let first = corners[0] as usize;
            let mut panels = parts.panels.iter();
            panels.any(|panel| panel.fabric == *fabric && panel.particles.contains(&first))
        });
        let fabric_strains: Vec<&TriangleStrain> = of_fabric.map(|(_, strain)| strain).collect();
        let total: f64 = fabric_strains.iter().map(|strain| strain.area).sum();

        for MeasuredLaw { key, name, deformation, written } in &LAWS {
            let Some(limit) = ranges.get(*key) else { continue };
            let deformations = fabric_strains.iter().map(|strain| deformation(strain));
            let largest = deformations.fold(0.0, f64::max);
            let beyond = fabric_strains.iter().filter(|strain| deformation(strain) > *limit);
            let fraction = beyond.map(|strain| strain.area).sum::<f64>() / total;
            if fraction > UNMEASURED {
                warnings.push(format!(
                    "fabric \"{fabric}\": {name} reaches {}, and was measured up to {}: {:.1} % of the cloth go by what \
                     the law says beyond",
                    written(largest),
                    written(*limit),
                    100.0 * fraction
                ));
            }
        }
    }
    warnings
}
