//! Browzwear: the fields of the physics dialog of VStitcher and Lotta, as a table.

use csv::Writer;

use crate::material::Material;
use crate::number::{number, one_line};

/// Bending rigidity of 1 N·m in dyn·cm.
const DYN_CENTIMETRES: f64 = 1e7;

/// Ratio of the tensile stiffness of a strip on the bias to the shear stiffness. The yarns of a
/// strip that lengthens by `$\varepsilon$` shear by `$2\varepsilon$`, and the force per width is
/// twice the shear force.
const BIAS: f64 = 4.0;

impl Material {
    /// Returns a table (CSV) of the numbers for the physics dialog of Browzwear's VStitcher and
    /// Lotta, in the units of the dialog, with the definition of each number and the `losses`
    /// \[BW25\].
    ///
    /// Length is warp, width is weft. The value of the shear is empty, because the public
    /// description does not say whether the shear of the yarns' angle or of a strip on the bias is
    /// meant. The text gives both.
    #[must_use]
    pub fn to_browzwear(&self) -> String {
        let load = number(self.stretch[0].load);
        let friction = "coefficient of friction of the surface".into();
        let pressure = "under 49 Pa (0.5 gf/cm²)".into();
        let mut rows = vec![
            row(["Mass", ""], number(1e3 * self.density), "g/m²", "mass per area".into()),
            row(["Friction", ""], number(self.surface_friction), "", friction),
            row(["Thickness", ""], number(1e3 * self.thickness), "mm", pressure),
        ];

        for (index, direction) in ["length", "width"].into_iter().enumerate() {
            let rigidity = number(DYN_CENTIMETRES * self.bending[index]);
            let meaning = "KES B of the law: moment per width over curvature, from 0.5 to 1.5 1/cm";
            rows.push(row(["Bend", direction], rigidity, "dyn·cm", meaning.into()));
        }
        for (index, direction) in ["length", "width"].into_iter().enumerate() {
            let stretch = self.stretch[index];
            let meaning = format!(
                "tension per width over strain, from rest to {load} N/m, where the strain is {} %; on the \
                 first stretching",
                number(100.0 * stretch.strain)
            );
            rows.push(row(["Stretch", direction], number(stretch.stiffness), "N/m", meaning));
        }

        rows.push(row(["Shear", ""], String::new(), "N/m", format!(
                "left empty: the public description does not say which shear is meant; KES G of the law is {} N/m \
                 per rad, and a strip on the bias whose yarns do not stretch has {} N/m",
                number(self.shear),
                number(BIAS * self.shear)
            )));

        for loss in &self.losses {
            rows.push(row(["lost", ""], String::new(), "", one_line(loss)));
        }
        let source = format!(
            "{}, by drape {}; length is warp, width is weft",
            one_line(&self.name),
            env!("CARGO_PKG_VERSION")
        );
        rows.push(row(["fabric", ""], String::new(), "", source));
        table(&rows)
    }
}

/// Returns a row of the table: `property` and direction, `value`, `unit` and `meaning`.
fn row(property: [&str; 2], value: String, unit: &str, meaning: String) -> [String; 5] {
    let [property, direction] = property;
    [property.into(), direction.into(), value, unit.into(), meaning]
}

/// Returns `rows` as CSV, below a heading.
fn table(rows: &[[String; 5]]) -> String {
    let mut writer = Writer::from_writer(Vec::new());
    let head = ["property", "direction", "value", "unit", "meaning"];
    let result = writer
        .write_record(head)
        .and_then(|()| rows.iter().try_for_each(|row| writer.write_record(row)));
    result.expect("writing to memory does not fail");
    let bytes = writer.into_inner().expect("writing to memory does not fail");
    String::from_utf8(bytes).expect("the cells are texts")
}
