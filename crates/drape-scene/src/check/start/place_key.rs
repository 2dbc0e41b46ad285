//! Keys of places: where the spec says where a panel starts.

use drape_input::toml_key;

use crate::check::checker::Checker;
use crate::scene::Scene;
use crate::scene::panel::Panel;

/// Returns the key that places `panel` of `scene` in the spec of `checker`: the key of its `center`
/// where the spec has one, otherwise the key of its table.
pub(crate) fn place_key(checker: &Checker<'_>, scene: &Scene, panel: &Panel) -> String {
    let spec = checker.spec;
    if let Some(garment) = scene.garment_of(panel) {
        let name = panel.name.rsplit_once('.').map_or(panel.name.as_str(), |(_, name)| name);
        let entry = spec.garment.get(garment);
        let garment_key = format!("garment[{garment}]");
        return match entry.and_then(|entry| entry.panel.get(name)) {
            Some(panel) => {
                let key = format!("{garment_key}.panel.{}", toml_key(name));
                with_center(key, panel.center.is_some())
            }
            None => with_center(garment_key, entry.is_some_and(|entry| entry.center != [0.0; 3])),
        };
    }

    // The panels of a stack are called after the first of them.
    let named = spec.panel.iter().position(|entry| entry.name == panel.name);
    let index = named.or_else(|| {
        spec.panel.iter().position(|entry| panel.name.starts_with(&format!("{} ", entry.name)))
    });
    let index = index.unwrap_or_default();
    let is_placed = spec.panel.get(index).is_some_and(|entry| entry.center != [0.0; 3]);
    with_center(format!("panel[{index}]"), is_placed)
}

/// Returns the key of the `center` of the table `key` if it `has_center`, otherwise `key`.
fn with_center(key: String, has_center: bool) -> String {
    if has_center { format!("{key}.center") } else { key }
}
