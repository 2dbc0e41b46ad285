//! Strains of the cloth, and warnings where they go beyond what its fabric was measured to.

use drape_cloth::TriangleStrain;
use serde_json::{Map, Value, json};

use crate::measure::garment_parts::GarmentParts;
use crate::world::World;

/// Fraction of the area of a cloth that may be deformed beyond the measurements of its fabric without a warning.
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
    world.cloth.triangle_strains(&world.state.positions)
}

/// Deformation of a triangle.
struct Deformed {
    value: f64,
    /// Area of the triangle, in m².
    area: f64,
}

/// Quantiles of the strains over the area of the cloth: minimum, 1 %, median, 99 % and maximum.
pub(crate) fn measures(world: &World) -> Value {
    let strains = strains(world);
    let spread = |deformation: fn(&TriangleStrain) -> f64| {
        let value = |strain| Deformed { value: deformation(strain), area: strain.area };
        let mut values: Vec<Deformed> = strains.iter().map(value).collect();
        values.sort_by(|a, b| a.value.total_cmp(&b.value));
        let whole: f64 = values.iter().map(|own| own.area).sum();
        let mut below = 0.0;
        let sums: Vec<f64> = values
            .iter()
            .map(|own| {
                below += own.area;
                below / whole
            })
            .collect();
        let at = |part: f64| {
            let place = sums.partition_point(|sum| *sum < part);
            values.get(place).or(values.last()).map(|own| own.value)
        };
        json!({
            "min": at(0.0), "p01": at(0.01), "median": at(0.5), "p99": at(0.99), "max": at(1.0),
        })
    };
    let mut measures = Map::new();
    measures.insert("warp".into(), spread(|strain| strain.warp));
    measures.insert("weft".into(), spread(|strain| strain.weft));
    measures.insert("shear".into(), spread(|strain| strain.shear));
    Value::Object(measures)
}

/// Warnings about cloth that is deformed beyond the measurements of its fabric.
pub(crate) fn extrapolated(parts: &GarmentParts, world: &World) -> Vec<String> {
    let strains = strains(world);
    let mut found = Vec::new();
    for (fabric, ranges) in &parts.measured_ranges {
        let own = |triangle: usize| {
            let first = world.cloth.triangles()[triangle][0] as usize;
            let mut panels = parts.panels.iter();
            panels.any(|panel| panel.fabric == *fabric && panel.particles.contains(&first))
        };
        let own: Vec<&TriangleStrain> =
            strains.iter().enumerate().filter(|(t, _)| own(*t)).map(|(_, s)| s).collect();
        let whole: f64 = own.iter().map(|strain| strain.area).sum();
        for MeasuredLaw { key, name, deformation, written } in &LAWS {
            let Some(limit) = ranges.get(*key) else { continue };
            let most = own.iter().map(|strain| deformation(strain)).fold(0.0, f64::max);
            let beyond = own.iter().filter(|strain| deformation(strain) > *limit);
            let fraction = beyond.map(|strain| strain.area).sum::<f64>() / whole;
            if fraction > UNMEASURED {
                found.push(format!(
                    "fabric \"{fabric}\": {name} reaches {}, and was measured up to {}: {:.1} % of the cloth go by what \
                     the law says beyond",
                    written(most),
                    written(*limit),
                    100.0 * fraction
                ));
            }
        }
    }
    found
}
