//! Curves of any kind, and what the fits make of them.

use drape::fabric::Fabric;
use drape::fit::{FitSettings, identify_bending, identify_shear, identify_tensile};
use drape::kes::{BendingPoints, Curve, Direction, EvaluationPoints, ShearPoints, Test};

use crate::shapes::Source;

pub fn identify(source: &mut Source<'_>) {
    let count = source.below(24) as usize;
    let test = [Test::Tensile, Test::Shear, Test::Bending][source.below(3) as usize];
    let mut deformation = source.odd_list(count);
    if source.below(2) == 0 {
        // There and back, with a little noise.
        for (k, place) in deformation.iter_mut().enumerate() {
            let part = k as f64 / count.max(1) as f64;
            *place = 0.1 * (1.0 - (2.0 * part - 1.0).abs()) + 1e-4 * *place;
        }
    }
    let load = source.odd_list(deformation.len());
    let Ok(curve) = Curve::new(test, Direction::Warp, deformation, load) else { return };
    let curve = curve.with_time(source.odd_list(count));
    let _ = curve.branches();
    let _ = curve.cycles();
    let _ = curve.thinned(source.length(4));
    let _ = curve.prepared();
    let points = EvaluationPoints {
        maximum_tension: source.odd(),
        bending: BendingPoints::default(),
        shear: ShearPoints::default(),
    };
    let _ = curve.values(&points);
    let settings = FitSettings::default();
    let law = match test {
        Test::Tensile => identify_tensile(&curve, &settings).map(|found| found.law.problems()),
        Test::Shear => identify_shear(&curve, &settings).map(|found| found.law.problems()),
        _ => identify_bending(&curve, &settings).map(|found| found.law.problems()),
    };
    drop(law);

    let fabric = Fabric { density: source.odd(), ..drape::fabric::samples::plain_weave() };
    let again = fabric.to_toml();
    let document = drape::input::Document::new("fabric.toml", again);
    assert_eq!(Fabric::from_document(&document).is_ok(), fabric.problems().is_empty());
}
