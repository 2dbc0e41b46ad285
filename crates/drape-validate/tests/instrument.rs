//! Simulated instruments answer as the laws do, and notice when they do not.

use drape_fabric::Fabric;
use drape_input::Document;
use drape_kes::{Direction, Test};
use drape_validate::instrument::{Comparison, Resolution, ideal, measure};

fn cotton() -> Fabric {
    let text = include_str!("../fabrics/matsudaira-a.toml");
    Fabric::from_document(&Document::new("fabric.toml", text)).expect("a shipped fabric")
}

#[test]
fn a_specimen_of_another_fabric_is_told_apart() {
    let fabric = cotton();
    let mut other = fabric.clone();
    other.shear.friction.elements[0].plateau *= 3.0;
    let measured =
        measure(&other, Test::Shear, Direction::Warp, Resolution { spacing: 0.01, points: 20 })
            .expect("a curve");
    let ideal = ideal(&fabric, Test::Shear, Direction::Warp, 20).expect("a curve");
    assert!(Comparison { measured, ideal }.distance() > 0.04);
}

#[test]
fn warp_and_weft_are_not_exchanged() {
    let mut fabric = cotton();
    fabric.warp.bending.friction.elements[0].plateau = 0.0;
    let area = |direction| {
        let curve =
            measure(&fabric, Test::Bending, direction, Resolution { spacing: 0.005, points: 20 })
                .expect("a curve");
        curve.loop_width(100.0).expect("a loop")
    };
    let (warp, weft) = (area(Direction::Warp), area(Direction::Weft));
    assert!(warp.abs() < 1e-3 * weft, "{warp} {weft}");
}
