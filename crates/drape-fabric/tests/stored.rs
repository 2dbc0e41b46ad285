//! Fabrics and laws in JSON have the keys and the checks of the TOML file, and keep every bit.

use drape_fabric::{BendingLaw, Fabric, ShearLaw, TractionLaw, samples};
use drape_input::Document;
use serde_json::{Value, json};

/// Fabric with every law and every table of the format between warp, weft and shear.
const EVERY_LAW: &str = r#"
name = "every law"
source = "made for this test"
density = 0.18
thickness = 0.0004
pressed_thickness = 0.0003
compression_linearity = 0.31
surface_friction = 0.17
[warp.traction]
exponential = { base_stiffness = 10.0, stiffness = 3000.1, steepness = 2.1, toe_strain = 0.0613, toe_strain_after = 0.07 }
proportional_friction = { ratio = 0.21, plateau = 0.3, length = 0.004 }
buckling = { strain = 0.031, stiffness = 12.0 }
[warp.bending]
varying = { initial_stiffness = 2.1e-5, final_stiffness = 1.1e-5, transition = 30.0 }
rest_curvature = 3.3
friction = [{ plateau = 9e-4, length = 3.0 }, { plateau = -2e-4, length = 20.0 }]
[weft.traction]
polynomial = { quadratic = 8.4e4, quartic = 1.2e7 }
[weft.bending]
piecewise = { slope = 2e-5, intercept = 4e-4, knot = 40.0 }
[shear]
stiffness = 40.1
growth = 6.0
friction = [{ plateau = 0.6, length = 0.006 }]
locking = { onset = 0.139, limit = 0.867 }
[provenance]
sheet = "sheet.toml"
digest = "abc"
fitted_by = "drape"
assumed = ["thickness: taken"]
standard_errors = { "warp.bending.varying.length" = 0.25 }
correlations = { "a.b" = { "c.d" = -0.5 } }
unused = { "warp.MMD" = 0.02 }
reach = { "warp.traction" = 0.05 }
"#;

/// Returns fabrics that have every law.
fn fabrics() -> Vec<Fabric> {
    let texts =
        [EVERY_LAW, samples::PLAIN_WEAVE, samples::PLAIN_WEAVE_WITH_FRICTION, samples::HEAVY_WEAVE];
    let read = |text| Fabric::from_document(&Document::new("sample.toml", text));
    texts.into_iter().map(|text| read(text).unwrap_or_else(|m| panic!("{m}"))).collect()
}

#[test]
fn fabrics_and_their_laws_come_back_from_json_to_the_last_bit() {
    for fabric in fabrics() {
        let name = &fabric.name;
        let text = serde_json::to_string(&fabric).expect("it has a JSON form");
        let again: Fabric = serde_json::from_str(&text).expect("what was written is right");
        assert_eq!(fabric, again, "{name}");
        // JSON and TOML have the same keys.
        let json: toml::Table = serde_json::from_str(&text).expect("a table");
        let file: toml::Table = fabric.to_toml().parse().expect("TOML");
        assert_eq!(json, file, "{name}");

        for laws in [&fabric.warp, &fabric.weft] {
            let [traction, bending] = [json!(laws.traction), json!(laws.bending)];
            let traction: TractionLaw = serde_json::from_value(traction).expect("it is right");
            let bending: BendingLaw = serde_json::from_value(bending).expect("it is right");
            assert_eq!((laws.traction, laws.bending), (traction, bending), "{name}");
        }
        let shear: ShearLaw = serde_json::from_value(json!(fabric.shear)).expect("it is right");
        assert_eq!(fabric.shear, shear, "{name}");
    }
}

#[test]
fn wrong_laws_are_refused_with_key_and_remedy() {
    fn refusal<T: serde::de::DeserializeOwned>(value: Value) -> String {
        serde_json::from_value::<T>(value).err().expect("it is wrong").to_string()
    }
    let said = refusal::<BendingLaw>(json!({ "rigidity": -1.0 }));
    assert!(said.contains("bending.rigidity") && said.contains("-1"), "{said}");
    let said = refusal::<BendingLaw>(json!({}));
    assert!(said.contains("bending: the bending curve must be given once; give one of"), "{said}");
    let said = refusal::<ShearLaw>(json!({ "stiffness": 30.0, "rise": 1.0 }));
    assert!(said.contains("rise"), "{said}");
    let said = refusal::<TractionLaw>(json!({
        "primed": { "stiffness": -5.0, "toe_ratio": 0.1, "toe_strain": 0.01, "toe_strain_after": 0.02 },
    }));
    assert!(said.contains("traction.primed.stiffness") && said.contains("toe_ratio"), "{said}");

    let mut value = json!(samples::plain_weave());
    value["density"] = json!(120.0);
    let said = refusal::<Fabric>(value);
    assert!(said.contains("density: 120") && said.contains("did you mean"), "{said}");
}
