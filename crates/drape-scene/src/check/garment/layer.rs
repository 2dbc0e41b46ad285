//! Layers of garments: how far out a panel starts.

use drape_pattern::Placement;

use crate::check::checker::Checker;

/// Distance by which a panel of a layer starts farther from the body than it would on the layer
/// below, in m.
const STEP: f64 = 0.02;

/// Returns `placement` of a panel moved out by one step for each `layer`. The radius of a panel
/// that is bent to a cylinder grows. A flat panel is moved to its right side.
pub(crate) fn worn_at(placement: Placement, layer: u32) -> Placement {
    let mut placement = placement;
    let distance = STEP * f64::from(layer);
    // The axis of a cylinder with a negative radius is on the right side, and so is the body.
    let inverted = placement.wrap.is_some_and(|radius| radius < 0.0);
    let distance = if inverted { -distance } else { distance };
    if let Some(radius) = &mut placement.wrap {
        *radius += distance;
    }
    for axis in 0..3 {
        placement.translation[axis] += distance * placement.rotation[axis][2];
    }
    placement
}

/// Returns `layer`, the value of `key`, and checks that cloth meets cloth in the scene if the layer
/// is not next to the body. Layers out of their range have been reported.
pub(crate) fn check_layer(checker: &mut Checker<'_>, key: &str, layer: i64) -> u32 {
    if layer > 0 && checker.is_sound(key) && !checker.spec.keeps_surfaces_apart() {
        let help = "leave it out, or keep surfaces apart (contact.surfaces)";
        checker.fail(key, "cloth does not meet cloth in this scene", help);
    }
    u32::try_from(layer).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
        (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
    }

    #[test]
    fn a_layer_lets_the_cylinder_grow_about_its_axis_and_a_flat_panel_stand_off() {
        let flat = Placement::new([0.2, -0.7, 1.1], [0.1, 0.9, 0.2]);
        let [one, three] = [1, 3].map(|layer| worn_at(flat, layer).point([0.13, 0.2]));
        let normal = flat.rotation.map(|row| row[2]);
        let off = |point: [f64; 3]| -> f64 {
            let from = flat.point([0.13, 0.2]);
            (0..3).map(|axis| (point[axis] - from[axis]) * normal[axis]).sum()
        };
        assert!((off(one) - STEP).abs() < 1e-15 && (off(three) - 3.0 * STEP).abs() < 1e-15);
        for radius in [0.15, -0.15] {
            let bent = flat.with_wrap(Some(radius));
            let worn = worn_at(bent, 2);
            let axis = [0, 1, 2].map(|k| flat.point([0.0, 0.2])[k] - radius * normal[k]);
            for x in [-0.2, 0.0, 0.1] {
                let from = apart(worn.point([x, 0.2]), axis);
                assert!((from - 0.15 - 2.0 * STEP).abs() < 1e-14, "{from} m at {radius}");
            }
        }
        assert_eq!(worn_at(flat, 0), flat);
    }
}
