//! Remedies in the words of Python: what the libraries advise, as calls and arguments.

use std::path::Path;

use drape::input::{FilePurpose, Remedy};

/// Returns `remedy` as calls and arguments of Python that carry it out.
pub(crate) fn in_words(remedy: &Remedy) -> String {
    match remedy {
        Remedy::StateUnit { file, units } => say_unit("say it", file, units),
        Remedy::CorrectUnit { file, units } => {
            say_unit("if the unit is wrong, say it", file, units)
        }
        Remedy::ConfirmUnit { file, likely, taken } => format!(
            "say the unit: drape.convert({}, unit=\"{likely}\"), or unit=\"{taken}\" if the size is meant; or unit = \
             \"{likely}\" in the [from] of a pattern",
            text(file)
        ),
        Remedy::ChooseSize { file, size } => {
            format!("choose one: drape.convert({}, size={size:?})", text(file))
        }
        Remedy::ChooseFabric { names } => {
            let names: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
            format!("name one of {} by fabric=", names.join(", "))
        }
        Remedy::FitSheet { sheet } => format!(
            "if it is a sheet of measurements, fit it with drape.fit({}), and give the .fabric of the fit here",
            text(sheet)
        ),
        Remedy::FitWithErrors { .. } => "write it with drape.fit(SHEET).to_toml(), from a sheet with \
                                         curves or with standard deviations"
            .into(),
        Remedy::RepairMesh { named, .. } => format!(
            "mend it where it was made, such as with trimesh.repair.fill_holes; then give file = {}",
            text(named)
        ),
        Remedy::ListCrossings { .. } => "a program for meshes, such as trimesh, lists them".into(),
        Remedy::ThinMesh { spacing, .. } => format!(
            "thin them in a program for meshes to edges of about {} mm",
            1e3 * spacing
        ),
        Remedy::ShowStart { .. } => {
            "drape.Simulation(scene).positions are the positions at the start".into()
        }
        Remedy::RunWithoutGrading => {
            "run the scene without [grading] first, at a larger spacing and with a folder of its own: \
             drape.Scene.read(SCENE).run(FOLDER)"
                .into()
        }
        Remedy::AllowPath { place } => {
            format!("move it there, or allow it with allow=[{}]", text(place))
        }
        Remedy::RaiseLimits { factor } => format!(
            "make the file smaller, or read it with the command drape and its option --raise-limits {factor}"
        ),
        Remedy::RunAnew => "or run the scene anew with replace=True".into(),
        Remedy::UseFile { path, named, purpose } => use_file(path, named, *purpose),
    }
}

/// Returns the calls that take the file or folder at `path`, which a scene names as `named`.
fn use_file(path: &Path, named: &Path, purpose: FilePurpose) -> String {
    let (path, named) = (text(path), text(named));
    match purpose {
        FilePurpose::Scene => format!("drape.Scene.read({path}).run() simulates it"),
        FilePurpose::Fabric => {
            format!(
                "drape.Fabric.read({path}) reads it; a scene names it: fabric.NAME.file = {named}"
            )
        }
        FilePurpose::Sheet => format!(
            "drape.fit({path}) fits a fabric to it; a scene names it: fabric.NAME.file = {named}"
        ),
        FilePurpose::Pattern => format!("a scene sews it: [[garment]] pattern = {named}"),
        FilePurpose::Study => "the command drape runs a study, with drape sweep run".into(),
        FilePurpose::Drawing => {
            format!("drape.convert({path}, \"pattern.toml\") makes a pattern of it")
        }
        FilePurpose::Body => format!("a scene names it: [[collider.mesh]] file = {named}"),
        FilePurpose::Table => format!("drape.fit({path}) fits a fabric to it"),
        FilePurpose::Run => format!("drape.open({path}) reads it"),
    }
}

/// Returns the advice to state one of `units` for the pattern `file`. The advice begins with the
/// words `start`.
fn say_unit(start: &str, file: &Path, units: &[&str]) -> String {
    let (first, others) = units.split_first().unwrap_or((&"mm", &[]));
    format!(
        "{start}: drape.convert({}, unit=\"{first}\") (or {}), or unit = \"{first}\" in the [from] of a pattern",
        text(file),
        others.join(", ")
    )
}

/// Returns `path` as a text of Python.
fn text(path: &Path) -> String {
    format!("{:?}", path.display().to_string())
}
