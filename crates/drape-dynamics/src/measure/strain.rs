//! Strains of the cloth, and warnings where they exceed the measured range of the fabric.

use drape_cloth::TriangleStrain;
use drape_frames::curvatures;
use serde_json::{Map, Value, json};

use crate::measure::garment_parts::{GarmentParts, MaterialRanges};
use crate::measure::vector::point_of;
use crate::world::{ALL_PARTICLES, World};

/// Fraction of the area of a cloth that may be deformed beyond the measured range of its fabric
/// without a warning.
const UNMEASURED: f64 = 1e-3;

/// Strain above which a result is doubtful if the traction of the fabric was not measured. The
/// limit is a convention: it was not derived from measurements.
const STRAIN_MAX: f64 = 0.1;

/// Shear angle above which a result is doubtful if the shear of the fabric was not measured, in
/// rad. The limit is a convention: it was not derived from measurements.
const SHEAR_MAX: f64 = std::f64::consts::FRAC_PI_4;

/// Deformation of a triangle of the cloth.
struct Deformation {
    /// Number of the triangle in the cloth.
    triangle: usize,
    strain: TriangleStrain,
    /// Largest curvature of the triangle, in 1/m.
    curvature: f64,
}

/// Law, and the deformation that is compared with the range of the law.
struct RangedLaw {
    /// Keys of the law in the measured ranges of a fabric. The largest range counts.
    keys: &'static [&'static str],
    name: &'static str,
    deformation: fn(&Deformation) -> f64,
    /// Converts a measured range into a limit of the deformation.
    measured: fn(f64) -> f64,
    /// Returns the deformation above which a result is doubtful if the law was not measured.
    plausible: fn(&MaterialRanges) -> f64,
    written: fn(f64) -> String,
}

const LAWS: [RangedLaw; 4] = [
    RangedLaw {
        keys: &["warp.traction"],
        name: "stretch along the warp",
        deformation: |deformation| deformation.strain.warp,
        measured: |strain| strain,
        plausible: |_| STRAIN_MAX,
        written: percent,
    },
    RangedLaw {
        keys: &["weft.traction"],
        name: "stretch along the weft",
        deformation: |deformation| deformation.strain.weft,
        measured: |strain| strain,
        plausible: |_| STRAIN_MAX,
        written: percent,
    },
    RangedLaw {
        keys: &["shear"],
        name: "shear",
        deformation: |deformation| deformation.strain.shear.abs(),
        measured: |sine| sine.clamp(0.0, 1.0).asin(),
        plausible: |_| SHEAR_MAX,
        written: |angle| format!("{:.1}°", angle.to_degrees()),
    },
    RangedLaw {
        keys: &["warp.bending", "weft.bending"],
        name: "curvature",
        deformation: |deformation| deformation.curvature,
        measured: |curvature| curvature,
        plausible: |ranges| 1.0 / ranges.thickness,
        written: |curvature| format!("{curvature:.0} 1/m"),
    },
];

fn percent(strain: f64) -> String {
    format!("{:.1} %", 100.0 * strain)
}

fn strains(world: &World) -> Vec<TriangleStrain> {
    world.cloth.triangle_strains(&world.state.positions).expect(ALL_PARTICLES)
}

/// Value of a triangle.
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
/// the measured range, or beyond what is plausible where nothing was measured.
pub(crate) fn extrapolated(parts: &GarmentParts, world: &World) -> Vec<String> {
    let deformations = deformations(world);
    let triangles = world.cloth.triangles();
    let mut warnings = Vec::new();
    for ranges in &parts.materials {
        let of_fabric = deformations.iter().filter(|deformation| {
            let first = triangles[deformation.triangle][0] as usize;
            let number = parts.panels.partition_point(|panel| panel.particles.end <= first);
            parts.panels.get(number).is_some_and(|panel| panel.fabric == ranges.name)
        });
        let of_fabric: Vec<&Deformation> = of_fabric.collect();
        for law in &LAWS {
            let Some(excess) = Excess::new(law, ranges, &of_fabric) else { continue };
            let corners = triangles[excess.worst.triangle];
            let points = corners.map(|corner| point_of(&world.state.positions, corner));
            let [x, y, z] =
                [0, 1, 2].map(|k| points.iter().map(|point| point[k]).sum::<f64>() / 3.0);
            let panel = parts.panel_of(corners[0] as usize);
            warnings.push(format!(
                "fabric \"{}\": {} reaches {} in \"{panel}\" near ({x:.4}, {y:.4}, {z:.4}) m, {}; {:.2} % of the cloth \
                 are beyond",
                ranges.name,
                law.name,
                (law.written)((law.deformation)(excess.worst)),
                excess.reason,
                100.0 * excess.fraction
            ));
        }
    }
    warnings
}

/// Returns the deformation of each triangle of the cloth of `world`.
fn deformations(world: &World) -> Vec<Deformation> {
    let positions = world.state.positions.as_chunks::<3>().0;
    let curvatures = curvatures(positions, world.cloth.triangles()).expect(ALL_PARTICLES);
    let strains = strains(world).into_iter().zip(curvatures).enumerate();
    let deformations =
        strains.map(|(triangle, (strain, curvature))| Deformation { triangle, strain, curvature });
    deformations.collect()
}

/// Cloth that is deformed beyond the range of a law.
struct Excess<'a> {
    /// Triangle with the largest deformation.
    worst: &'a Deformation,
    /// Fraction of the area that is beyond, 0 to 1.
    fraction: f64,
    /// What the deformation was compared with, in words.
    reason: String,
}

impl<'a> Excess<'a> {
    /// Returns the part of `deformations` that is beyond the range of `law`. Returns `None` if no
    /// part is, or if the part is small and plausible.
    fn new(
        law: &RangedLaw,
        ranges: &MaterialRanges,
        deformations: &[&'a Deformation],
    ) -> Option<Excess<'a>> {
        let value = |deformation: &Deformation| (law.deformation)(deformation);
        let worst =
            *deformations.iter().max_by(|first, second| value(first).total_cmp(&value(second)))?;
        let plausible = (law.plausible)(ranges);
        let measured = law.keys.iter().filter_map(|key| ranges.measured.get(*key).copied());
        let measured = measured.map(law.measured).reduce(f64::max);
        let limit = measured.unwrap_or(plausible);

        let total: f64 = deformations.iter().map(|deformation| deformation.strain.area).sum();
        let beyond = deformations.iter().filter(|deformation| value(deformation) > limit);
        let fraction = beyond.map(|deformation| deformation.strain.area).sum::<f64>() / total;
        let is_large = fraction > UNMEASURED || value(worst) > plausible.max(limit);
        if !(fraction > 0.0 && is_large) {
            return None;
        }

        let written = (law.written)(limit);
        let reason = if measured.is_some() {
            format!("and was measured up to {written}: beyond, the law is a guess")
        } else {
            format!("was not measured, and is doubtful beyond {written}")
        };
        Some(Excess { worst, fraction, reason })
    }
}
