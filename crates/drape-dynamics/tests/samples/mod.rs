//! Samples for the tests.

/// Plain weave with friction in every law.
pub const FABRIC: &str = r#"name = "plain"
density = 0.15
thickness = 0.0003
shear = { stiffness = 35.0, growth = 4.0, friction = [{ plateau = 0.5, length = 0.004 }] }
[warp]
traction = { friction = [{ plateau = 4.0, length = 0.001 }], primed = { stiffness = 5000.0, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 } }
bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4.0 }] }
[weft]
traction = { friction = [{ plateau = 3.0, length = 0.001 }], primed = { stiffness = 4000.0, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 } }
bending = { rigidity = 0.8e-5, friction = [{ plateau = 4e-4, length = 4.0 }] }
"#;
