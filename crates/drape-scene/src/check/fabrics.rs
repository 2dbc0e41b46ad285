//! Fabrics of a scene.

use std::path::PathBuf;

use drape_cloth::Lattice;
use drape_fabric::Fabric;
use drape_input::{
    Diagnostic, Diagnostics, Document, Setting, SettingError, excerpt, figure, toml_key,
};

use crate::check::checker::{Checker, UnknownName};
use crate::scene::material::{FabricReader, FabricRequest, Material};
use crate::scene::model::Model;
use crate::spec::FabricSpec;
use crate::spec::file_or::FileOr;

/// Reads the fabrics in the order of their names; none where a fabric has mistakes.
pub(crate) fn materials(
    checker: &mut Checker<'_>,
    reader: FabricReader<'_>,
    model: Model,
) -> Vec<Option<Material>> {
    let spec = checker.spec;
    if spec.fabric.is_empty() {
        let help = "add [fabric.NAME] with file = \"…\", a fabric.toml or a sheet.toml";
        checker.fail_file("the scene has no fabric", help);
    }
    let read = |(name, entry): (&String, &FabricSpec)| {
        let key = format!("fabric.{}.file", toml_key(name));
        let named = match &entry.file {
            FileOr::File(named) => named,
            FileOr::Value(fabric) => {
                let fabric = changed(checker, name, Fabric::clone(fabric))?;
                let (file, colour) = (PathBuf::new(), colour(checker, name)?);
                return Some(Material { name: name.clone(), file, fabric, colour });
            }
        };
        let path = checker.locate(&key, named)?;
        let (file, fabric) = if let Some(document) = checker.given(&path) {
            (path, Fabric::from_document(document))
        } else if path.is_dir() || checker.document().access().has_file(&path) {
            let file = if path.is_dir() {
                checker.locate(&key, &format!("{named}/sheet.toml"))?
            } else {
                path
            };
            let access = checker.document().access();
            let fabric = reader(FabricRequest { file: &file, model, access });
            (file, fabric)
        } else {
            checker.no_file(&key, named, &path);
            return None;
        };
        let fabric = fabric.map_err(|mistakes| checker.extend(mistakes)).ok()?;
        let fabric = changed(checker, name, fabric)?;
        let colour = colour(checker, name)?;
        Some(Material { name: name.clone(), file, fabric, colour })
    };
    spec.fabric.iter().map(read).collect()
}

/// Returns the colour that the scene states for a fabric, if any; nothing where it is no colour.
fn colour(checker: &mut Checker<'_>, name: &str) -> Option<Option<[u8; 3]>> {
    let Some(text) = &checker.spec.fabric[name].colour else { return Some(None) };
    let digits = text.strip_prefix('#').unwrap_or_default();
    let is_hexadecimal = digits.len() == 6 && digits.bytes().all(|digit| digit.is_ascii_hexdigit());
    if let (true, Ok(number)) = (is_hexadecimal, u32::from_str_radix(digits, 16)) {
        let [_, red, green, blue] = number.to_be_bytes();
        return Some(Some([red, green, blue]));
    }
    let key = format!("fabric.{}.colour", toml_key(name));
    let message = format!("\"{}\" is no colour", excerpt(text));
    checker.fail(&key, message, "write it as #RRGGBB, such as colour = \"#b03a2e\"");
    None
}

/// Returns a fabric with the numbers of its `set` table in the scene in place of its own.
fn changed(checker: &mut Checker<'_>, name: &str, fabric: Fabric) -> Option<Fabric> {
    let numbers = &checker.spec.fabric[name].set;
    if numbers.is_empty() {
        return Some(fabric);
    }
    let place = |key: &str| format!("fabric.{}.set.\"{key}\"", toml_key(name));
    let (mut settings, mut is_sound) = (Vec::new(), true);
    for (key, number) in numbers {
        match Setting::new(key, &format!("{number:?}")) {
            Ok(setting) => settings.push(setting.with_origin(&format!("set by [fabric.{name}]"))),
            Err(SettingError { message, help }) => {
                checker.fail(&place(key), message, &help);
                is_sound = false;
            }
        }
    }
    let document = Document::new(checker.document().path(), fabric.to_toml());
    let fabric = document.with_settings(&settings);
    let fabric = fabric.and_then(|document| Fabric::from_document(&document));
    // The lines are in a text that nobody sees.
    let unplaced = |mistake| Diagnostic { line: None, column: None, span: None, ..mistake };
    let fabric = fabric.map_err(|Diagnostics(mistakes)| {
        checker.extend(Diagnostics(mistakes.into_iter().map(unplaced).collect()));
    });
    fabric.ok().filter(|_| is_sound)
}

/// Returns the number of the fabric of a name.
pub(crate) fn material_index(checker: &mut Checker<'_>, key: &str, name: &str) -> Option<usize> {
    let known: Vec<&str> = checker.spec.fabric.keys().map(String::as_str).collect();
    let material = known.iter().position(|known| *known == name);
    if material.is_none() {
        let message = format!("there is no fabric \"{}\"", excerpt(name));
        let unknown = UnknownName { name, known: &known, kind: "fabrics of this scene" };
        checker.unknown(key, message, unknown);
    }
    material
}

/// Checks that the particles of a panel are farther apart than its fabric is thick.
pub(crate) fn check_thickness(
    checker: &mut Checker<'_>,
    key: &str,
    lattice: &Lattice,
    material: &Material,
) {
    let spacing = lattice.spacing()[0].min(lattice.spacing()[1]);
    let thickness = material.fabric.thickness;
    if spacing < thickness {
        let message = format!(
            "the spacing of {} m is less than the thickness {} m of fabric \"{}\"",
            figure(spacing),
            figure(thickness),
            excerpt(&material.name)
        );
        checker.fail(&format!("{key}.spacing"), message, "use a larger spacing");
    }
}
