//! Spacings that a scene names, with their keys.

use drape_input::{Setting, figure};

use crate::spec::SceneSpec;

/// Key of the coarser grids.
pub(crate) const REFINE: &str = "refine.spacings";

/// Distance between particles that a scene names.
#[derive(Debug, Clone, PartialEq)]
pub struct Spacing {
    /// Key in the file: `spacing`, `panel.0.spacing`, `garment.0.spacing`, `refine.spacings.0`.
    pub key: String,
    /// Value, in m.
    pub value: f64,
}

impl Spacing {
    /// Setting of the key to a multiple of the spacing.
    ///
    /// # Panics
    /// Never: its key is one of a scene.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Setting {
        Setting::new(&self.key, &self.scaled_value(factor)).expect("a key and a text of TOML")
    }

    /// TOML value of a multiple of the spacing, such as `"20 mm"`, quotes included.
    #[must_use]
    pub fn scaled_value(&self, factor: f64) -> String {
        format!("\"{} mm\"", figure(1e3 * factor * self.value))
    }
}

impl SceneSpec {
    /// Returns the spacing of the scene, then the spacings that panels and garments name.
    ///
    /// The spacing of the scene is left out if it is the usual one and every panel and garment
    /// names a spacing.
    #[must_use]
    pub fn spacings(&self) -> Vec<Spacing> {
        let panels = self.panel.iter().map(|panel| panel.spacing).enumerate();
        let garments = self.garment.iter().map(|garment| garment.spacing).enumerate();
        let panels = panels.map(|(index, spacing)| (format!("panel.{index}.spacing"), spacing));
        let garments =
            garments.map(|(index, spacing)| (format!("garment.{index}.spacing"), spacing));
        let parts: Vec<(String, Option<f64>)> = panels.chain(garments).collect();

        let is_used = self.spacing != Self::default().spacing
            || parts.iter().any(|(_, spacing)| spacing.is_none())
            || parts.is_empty();
        let common = is_used.then(|| Spacing { key: "spacing".into(), value: self.spacing });
        let named = parts
            .into_iter()
            .filter_map(|(key, spacing)| spacing.map(|value| Spacing { key, value }));
        common.into_iter().chain(named).collect()
    }

    /// Returns the spacings of the coarser grids, the coarsest first.
    #[must_use]
    pub fn coarser_spacings(&self) -> Vec<Spacing> {
        let grids = self.refine.iter().flat_map(|refine| &refine.spacings).enumerate();
        grids.map(|(index, &value)| Spacing { key: format!("{REFINE}.{index}"), value }).collect()
    }

    /// Returns the spec on a coarser grid, on which all spacings are `factor` times as large. It
    /// has no coarser grids itself and is not graded.
    #[must_use]
    pub fn coarsened(&self, factor: f64) -> Self {
        let mut spec = self.clone();
        spec.refine = None;
        spec.grading = None;
        spec.spacing = rounded(factor * spec.spacing);
        let panels = spec.panel.iter_mut().map(|panel| &mut panel.spacing);
        let garments = spec.garment.iter_mut().map(|garment| &mut garment.spacing);
        for spacing in panels.chain(garments).flatten() {
            *spacing = rounded(factor * *spacing);
        }
        spec
    }
}

/// Returns `spacing`, in m, as a person would write it in millimetres.
fn rounded(spacing: f64) -> f64 {
    figure(1e3 * spacing).parse().map_or(spacing, |millimetres: f64| millimetres * 0.001)
}

#[cfg(test)]
mod tests {
    use drape_input::Document;

    use super::*;

    #[test]
    fn all_spacings_are_found_in_metres() {
        let text = "length = \"mm\"\nspacing = 20\n[[panel]]\nname = \"a\"\nfabric = \"f\"\n\
                    [[panel]]\nname = \"b\"\nfabric = \"f\"\nspacing = \"0.5 cm\"\n\
                    [[garment]]\npattern = \"p.toml\"\nfabric = \"f\"\nspacing = 8\n\
                    [time]\nstep = 0.005\nend = 1\n";
        let spacings = |text: &str| {
            let spec = SceneSpec::from_document(&Document::new("scene.toml", text));
            spec.expect("a scene").spacings()
        };
        let pairs: Vec<(String, f64)> =
            spacings(text).into_iter().map(|spacing| (spacing.key, spacing.value)).collect();
        let expected =
            [("spacing", 0.02), ("panel.1.spacing", 0.005), ("garment.0.spacing", 0.008)];
        assert_eq!(pairs, expected.map(|(key, value)| (key.to_owned(), value)));
        let named = text.replace("spacing = 20\n[[panel]]\nname = \"a\"\nfabric = \"f\"\n", "");
        assert_eq!(spacings(&named)[0].key, "panel.0.spacing");
        assert_eq!(spacings("[time]\nstep = 0.005\nend = 1\n")[0].value, 0.01);
    }
}
