use std::collections::BTreeMap;

use drape_cloth::TriangleStrain;
use drape_scene::Material;
use serde_json::{Map, Value, json};

use crate::Simulation;

/// Part of the cloth that may be deformed more than its fabric was when it was measured, without a word.
const STRAY: f64 = 1e-3;

/// A measured law, what is compared with its reach, and how that is written.
struct Limit {
    key: &'static str,
    what: &'static str,
    deformation: fn(&TriangleStrain) -> f64,
    written: fn(f64) -> String,
}

const LIMITS: [Limit; 3] = [
    Limit {
        key: "warp.traction",
        what: "stretch along the warp",
        deformation: |strain| strain.warp,
        written: percent,
    },
    Limit {
        key: "weft.traction",
        what: "stretch along the weft",
        deformation: |strain| strain.weft,
        written: percent,
    },
    Limit {
        key: "shear",
        what: "shear",
        deformation: |strain| strain.shear.sin().abs(),
        written: |sine| format!("{:.1}°", sine.asin().to_degrees()),
    },
];

fn percent(strain: f64) -> String {
    format!("{:.1} %", 100.0 * strain)
}

impl Simulation {
    /// How the cloth is stretched and sheared, triangle by triangle.
    #[must_use]
    pub fn strains(&self) -> Vec<TriangleStrain> {
        self.world.cloth.triangle_strains(&self.world.state.positions)
    }

    /// Strains over the area of the cloth: what a hundredth of it is below, half of it, 99 hundredths, and the extremes.
    pub(crate) fn strain_measures(&self) -> Value {
        let strains = self.strains();
        let spread = |deformation: fn(&TriangleStrain) -> f64| {
            let mut values: Vec<(f64, f64)> =
                strains.iter().map(|strain| (deformation(strain), strain.area)).collect();
            values.sort_by(|a, b| a.0.total_cmp(&b.0));
            let whole: f64 = values.iter().map(|(_, area)| area).sum();
            let mut below = 0.0;
            let sums: Vec<f64> = values
                .iter()
                .map(|(_, area)| {
                    below += area;
                    below / whole
                })
                .collect();
            let at = |part: f64| {
                let place = sums.partition_point(|sum| *sum < part);
                values.get(place).or(values.last()).map(|(value, _)| *value)
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

    /// What the user should know about cloth that is deformed more than its fabric was when it was measured.
    pub(crate) fn extrapolated(&self) -> Vec<String> {
        let strains = self.strains();
        let mut found = Vec::new();
        for (fabric, reach) in &self.reaches {
            let own = |triangle: usize| {
                let first = self.triangles()[triangle][0] as usize;
                let mut panels = self.panels.iter();
                panels.any(|panel| panel.fabric == *fabric && panel.particles.contains(&first))
            };
            let own: Vec<&TriangleStrain> =
                strains.iter().enumerate().filter(|(t, _)| own(*t)).map(|(_, s)| s).collect();
            let whole: f64 = own.iter().map(|strain| strain.area).sum();
            for Limit { key, what, deformation, written } in &LIMITS {
                let Some(limit) = reach.get(*key) else { continue };
                let most = own.iter().map(|strain| deformation(strain)).fold(0.0, f64::max);
                let beyond = own.iter().filter(|strain| deformation(strain) > *limit);
                let part = beyond.map(|strain| strain.area).sum::<f64>() / whole;
                if part > STRAY {
                    found.push(format!(
                        "fabric \"{fabric}\": {what} reaches {}, and was measured up to {}: {:.1} % of the cloth go by what \
                         the law says beyond",
                        written(most),
                        written(*limit),
                        100.0 * part
                    ));
                }
            }
        }
        found
    }
}

/// How far each fabric of a scene was measured, as its file tells; where one direction of the yarns stands for the other,
/// it does so here.
pub(crate) fn reaches(materials: &[Material]) -> BTreeMap<String, BTreeMap<String, f64>> {
    let reach = |material: &Material| {
        let mut reach = material.fabric.provenance.as_ref()?.measured_range.clone();
        for [one, other] in [["warp.traction", "weft.traction"], ["weft.traction", "warp.traction"]]
        {
            if let Some(strain) = reach.get(one).copied() {
                reach.entry(other.into()).or_insert(strain);
            }
        }
        Some((material.name.clone(), reach))
    };
    materials.iter().filter_map(reach).collect()
}
