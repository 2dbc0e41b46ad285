//! Spacings that a scene names, with their keys.

use drape_input::{Diagnostics, Document, Given, Length, Setting, figure};

use crate::check::panel::SPACING;
use crate::file::SceneFile;

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

/// Returns the spacing of the scene `document`, then the spacings that panels and garments name.
///
/// The spacing of the scene is the usual one if the scene names none. It is left out if every panel
/// and garment names a spacing.
///
/// # Errors
/// Mistakes of the grammar, of spelling and of types.
pub fn spacings(document: &Document) -> Result<Vec<Spacing>, Diagnostics> {
    let file: SceneFile = document.decode()?;
    let unit = file.unit();
    let panels = file.panel.iter().map(|panel| panel.spacing).enumerate();
    let garments = file.garment.iter().map(|garment| garment.spacing).enumerate();
    let panels = panels.map(|(index, spacing)| (format!("panel.{index}.spacing"), spacing));
    let garments = garments.map(|(index, spacing)| (format!("garment.{index}.spacing"), spacing));
    let parts: Vec<(String, Option<Given<Length>>)> = panels.chain(garments).collect();

    let is_used = file.spacing.is_some()
        || parts.iter().any(|(_, spacing)| spacing.is_none())
        || parts.is_empty();
    let value = file.spacing.map_or(SPACING, |spacing| spacing * unit);
    let common = is_used.then(|| Spacing { key: "spacing".into(), value });
    let named = parts
        .into_iter()
        .filter_map(|(key, spacing)| Some(Spacing { key, value: spacing? * unit }));
    Ok(common.into_iter().chain(named).collect())
}

/// Returns the spacings of the coarser grids of the scene `document`, the coarsest first.
///
/// # Errors
/// Mistakes of the grammar, of spelling and of types.
pub fn coarser_spacings(document: &Document) -> Result<Vec<Spacing>, Diagnostics> {
    let file: SceneFile = document.decode()?;
    let grids = file.refine.iter().flat_map(|refine| &refine.spacings).enumerate();
    let spacings = grids.map(|(index, &spacing)| Spacing {
        key: format!("{REFINE}.{index}"),
        value: spacing * file.unit(),
    });
    Ok(spacings.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_spacings_are_found_in_metres() {
        let text = "length = \"mm\"\nspacing = 20\n[[panel]]\nname = \"a\"\nfabric = \"f\"\n\
                    [[panel]]\nname = \"b\"\nfabric = \"f\"\nspacing = \"0.5 cm\"\n\
                    [[garment]]\npattern = \"p.toml\"\nfabric = \"f\"\nspacing = 8\n\
                    [time]\nstep = 0.005\nend = 1\n";
        let found = spacings(&Document::new("scene.toml", text)).expect("a scene");
        let found: Vec<(&str, f64)> =
            found.iter().map(|own| (own.key.as_str(), (1e6 * own.value).round() / 1e6)).collect();
        let expected =
            [("spacing", 0.02), ("panel.1.spacing", 0.005), ("garment.0.spacing", 0.008)];
        assert_eq!(found, expected);
        let own = text.replace("spacing = 20\n[[panel]]\nname = \"a\"\nfabric = \"f\"\n", "");
        let found = spacings(&Document::new("scene.toml", own)).expect("a scene");
        assert_eq!(found[0].key, "panel.0.spacing");
        let usual = spacings(&Document::new("scene.toml", "[time]\nstep = 0.005\nend = 1\n"));
        assert_eq!(usual.expect("a scene")[0].value, SPACING);
    }
}
