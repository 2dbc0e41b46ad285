//! Keys of places: where the file says where a panel starts.

use drape_input::toml_key;

use crate::check::checker::Checker;
use crate::scene::Scene;
use crate::scene::panel::Panel;

/// Returns the key of the place of a panel.
pub(crate) fn place_key(checker: &Checker<'_>, scene: &Scene, panel: &Panel) -> String {
    let file = checker.file;
    let key = match scene.garment_of(panel) {
        Some(garment) => {
            let own = panel.name.rsplit_once('.').map_or(panel.name.as_str(), |(_, own)| own);
            let garment = format!("garment[{garment}]");
            let own = format!("{garment}.panel.{}", toml_key(own));
            if checker.document().has(&own) { own } else { garment }
        }
        None => {
            // The panels of a stack are called after the first of them.
            let of = |name: &str| panel.name == name || panel.name.starts_with(&format!("{name} "));
            let exact = file.panel.iter().position(|own| own.name == panel.name);
            let index = exact.or_else(|| file.panel.iter().position(|own| of(&own.name)));
            format!("panel[{}]", index.unwrap_or_default())
        }
    };
    let center = format!("{key}.center");
    if checker.document().has(&center) { center } else { key }
}
