//! U3M: physical properties of a material without its appearance, as JSON or as an archive with the
//! fabric.

mod archive;

use std::time::SystemTime;

use chrono::{DateTime, SecondsFormat, Utc};
use serde_json::{Value, json};

use crate::material::Material;
use crate::number::{one_line, rounded};

/// Name of the material in its archive.
const MATERIAL: &str = "material.u3m";

/// Name of the fabric in the archive.
const FABRIC: &str = "fabric.toml";

impl Material {
    /// Returns the material as U3M 1.1 \[Viz22\], JSON. `modified` is the time of the last change
    /// of the fabric.
    ///
    /// Thickness and weight are in `physics`. U3M defines no other physical numbers, except a file
    /// of Browzwear's instrument FAB, which does not exist for this fabric. All numbers, their
    /// definitions and the `losses` are in `custom.drape`.
    #[must_use]
    pub fn to_u3m(&self, modified: SystemTime) -> String {
        self.u3m(modified, None)
    }

    /// Returns the material as U3M archive (`.u3ma`), which contains the fabric beside the
    /// material. `modified` is the time of the last change of the fabric.
    #[must_use]
    pub fn to_u3ma(&self, modified: SystemTime) -> Vec<u8> {
        let material = self.u3m(modified, Some(FABRIC));
        archive::write(
            &[(MATERIAL, material.as_bytes()), (FABRIC, self.toml.as_bytes())],
            DateTime::<Utc>::from(modified),
        )
    }

    /// Returns the material as JSON. `fabric` is the name of the fabric's file in an archive.
    fn u3m(&self, modified: SystemTime, fabric: Option<&str>) -> String {
        let program = concat!("drape ", env!("CARGO_PKG_VERSION"));
        let name = one_line(&self.name);
        let time = DateTime::<Utc>::from(modified).to_rfc3339_opts(SecondsFormat::Secs, true);
        let description = format!(
            "Numbers of a fabric by {program}: thickness and weight. Stretch, bending and shear, their definitions \
             and what such numbers lose are in custom.drape. The fabric was not measured on a FAB, and has no look."
        );

        let document = json!({
            "schema": "1.1",
            "custom": { "drape": {
                "program": program,
                "fabric": fabric,
                "values": self.u3m_values(),
                "lost": self.losses,
            } },
            "material": {
                "id": self.id(),
                "name": if name.is_empty() { "fabric" } else { name.as_str() },
                "description": description,
                "created": time,
                "modified": time,
                "front": null,
                "back": null,
                "side": null,
                "physics": {
                    "thickness": rounded(1e3 * self.thickness),
                    "weight": rounded(1e3 * self.density),
                    "composition": null,
                    "devices": { "fab": "null" },
                    "material_type": { "type": "Woven", "name": null },
                    "construction": null,
                },
                "metadata": null,
            },
        });
        let text =
            serde_json::to_string_pretty(&document).expect("keys are texts and numbers finite");
        text + "\n"
    }

    /// Returns the numbers as JSON objects with units and definitions.
    fn u3m_values(&self) -> Vec<Value> {
        let load = rounded(self.stretch[0].load);
        let mut rows = vec![
            row("mass per area", None, Quantity { value: self.density, unit: "kg/m²" }, ""),
            row(
                "thickness",
                None,
                Quantity { value: self.thickness, unit: "m" },
                "under 49 Pa (0.5 gf/cm²)",
            ),
            row(
                "surface friction",
                None,
                Quantity { value: self.surface_friction, unit: "" },
                "coefficient of friction",
            ),
            row(
                "shear stiffness",
                None,
                Quantity { value: self.shear, unit: "N/m per rad" },
                "KES G of the law: shear force per width over angle, 0.5° to 2.5°",
            ),
        ];

        for (index, direction) in ["warp", "weft"].into_iter().enumerate() {
            let Self { stretch, compression, bending, .. } = self;
            let secant = format!(
                "tension per width over strain, on the first stretching from rest to {load} N/m"
            );
            let direction = Some(direction);
            rows.extend([
                row(
                    "stretch",
                    direction,
                    Quantity { value: stretch[index].stiffness, unit: "N/m" },
                    &secant,
                ),
                row(
                    "strain",
                    direction,
                    Quantity { value: stretch[index].strain, unit: "" },
                    &format!("at {load} N/m, on the first stretching"),
                ),
                row(
                    "compression",
                    direction,
                    Quantity { value: compression[index], unit: "N/m" },
                    "force per width over strain, from rest to a compression of 1 %",
                ),
                row(
                    "bending rigidity",
                    direction,
                    Quantity { value: bending[index], unit: "N·m" },
                    "KES B of the law: moment per width over curvature, 50 to 150 1/m",
                ),
            ]);
        }
        rows
    }

    /// Returns an identifier in the form of a random UUID (version 4), a function of `toml`.
    fn id(&self) -> String {
        let hash = blake3::hash(self.toml.as_bytes());
        let mut bytes: [u8; 16] = hash.as_bytes()[..16].try_into().expect("a hash has 32 bytes");
        bytes[6] = bytes[6] & 0x0f | 0x40;
        bytes[8] = bytes[8] & 0x3f | 0x80;
        let text: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        [&text[..8], &text[8..12], &text[12..16], &text[16..20], &text[20..]].join("-")
    }
}

/// Number with its unit.
struct Quantity<'a> {
    value: f64,
    unit: &'a str,
}

/// Returns `quantity` with its `name`, `direction` and `definition`.
fn row(name: &str, direction: Option<&str>, quantity: Quantity<'_>, definition: &str) -> Value {
    json!({
        "name": name,
        "direction": direction,
        "value": rounded(quantity.value),
        "unit": quantity.unit,
        "definition": definition,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::tests::linear;

    #[test]
    fn the_identifier_is_of_version_4_and_of_the_fabric() {
        let material = linear();
        let id = material.id();
        assert_eq!(id, material.id());
        assert_eq!(id.split('-').map(str::len).collect::<Vec<_>>(), [8, 4, 4, 4, 12]);
        assert_eq!(id.as_bytes()[14], b'4');
        assert!("89ab".contains(char::from(id.as_bytes()[19])), "{id}");
        let other = Material { toml: material.toml.clone() + "\n", ..material };
        assert_ne!(other.id(), id);
    }

    #[test]
    fn the_document_has_what_the_schema_requires_and_no_key_beyond() {
        let document: Value =
            serde_json::from_str(&linear().to_u3m(SystemTime::UNIX_EPOCH)).expect("JSON");
        let keys = |value: &Value| {
            let mut keys: Vec<String> =
                value.as_object().expect("object").keys().cloned().collect();
            keys.sort();
            keys.join(" ")
        };
        assert_eq!(keys(&document), "custom material schema");
        let material = &document["material"];
        assert_eq!(
            keys(material),
            "back created description front id metadata modified name physics side"
        );
        assert_eq!(
            keys(&material["physics"]),
            "composition construction devices material_type thickness weight"
        );
        assert_eq!(material["created"], "1970-01-01T00:00:00Z");
        assert_eq!(material["physics"]["devices"], json!({ "fab": "null" }));
    }
}
