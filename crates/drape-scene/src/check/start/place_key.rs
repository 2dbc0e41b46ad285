//! Keys of places: where the file says where a panel starts.

use drape_input::toml_key;

use crate::check::checker::Checker;
use crate::scene::Scene;
use crate::scene::panel::Panel;

/// Returns the key of `scene`'s file that places `panel`.
pub(crate) fn place_key(checker: &Checker<'_>, scene: &Scene, panel: &Panel) -> String {
    let file = checker.file;
    let key = match scene.garment_of(panel) {
        Some(garment) => {
            let name = panel.name.rsplit_once('.').map_or(panel.name.as_str(), |(_, name)| name);
            let garment_key = format!("garment[{garment}]");
            let panel_key = format!("{garment_key}.panel.{}", toml_key(name));
            if checker.document().has(&panel_key) { panel_key } else { garment_key }
        }
        None => {
            // The panels of a stack are called after the first of them.
            let mut entries = file.panel.iter();
            let index = entries.position(|entry| entry.name == panel.name).or_else(|| {
                let mut entries = file.panel.iter();
                entries.position(|entry| panel.name.starts_with(&format!("{} ", entry.name)))
            });
            format!("panel[{}]", index.unwrap_or_default())
        }
    };
    let center = format!("{key}.center");
    if checker.document().has(&center) { center } else { key }
}
