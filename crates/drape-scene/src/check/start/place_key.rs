//! Keys of places: where the spec says where a panel starts.

use drape_input::toml_key;

use crate::check::checker::Checker;
use crate::scene::Scene;
use crate::scene::panel::Panel;

/// Returns the key of the `center` that places `panel` of `scene` in the spec of `checker`.
pub(crate) fn place_key(checker: &Checker<'_>, scene: &Scene, panel: &Panel) -> String {
    let spec = checker.spec;
    if let Some(garment) = scene.garment_of(panel) {
        let name = panel.name.rsplit_once('.').map_or(panel.name.as_str(), |(_, name)| name);
        let has_keys =
            spec.garment.get(garment).is_some_and(|entry| entry.panel.contains_key(name));
        let of_panel = if has_keys { format!("panel.{}.", toml_key(name)) } else { String::new() };
        return format!("garment[{garment}].{of_panel}center");
    }

    // The panels of a stack are called after the first of them.
    let named = spec.panel.iter().position(|entry| entry.name == panel.name);
    let index = named.or_else(|| {
        spec.panel.iter().position(|entry| panel.name.starts_with(&format!("{} ", entry.name)))
    });
    format!("panel[{}].center", index.unwrap_or_default())
}
