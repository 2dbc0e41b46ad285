//! Remedies in the words of the command: what the libraries advise, as commands and options.

use std::path::Path;

use drape::input::{FilePurpose, Remedy};
use drape::run::ReachedLimit;

use crate::input;

/// Returns `remedy` as commands and options that carry it out.
pub(crate) fn in_words(remedy: &Remedy) -> String {
    match remedy {
        Remedy::StateUnit { file, units } => say_unit("say it", file, units),
        Remedy::CorrectUnit { file, units } => {
            say_unit("if the unit is wrong, say it", file, units)
        }
        Remedy::ConfirmUnit { file, likely, taken } => format!(
            "say the unit: drape convert {} --unit {likely}, or --unit {taken} if the size is meant; or unit = \
             \"{likely}\" in the [from] of a pattern",
            word(file)
        ),
        Remedy::ChooseSize { file, size } => {
            format!("choose one: drape convert {} --size {}", word(file), shell_word(size))
        }
        Remedy::ChooseFabric { names } => {
            let names: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
            format!("name one of {} by --fabric", names.join(", "))
        }
        Remedy::FitSheet { .. } => "if it is a sheet of measurements, fit it with `drape fit SHEET -o \
                                    fabric.toml`, and name fabric.toml here"
            .into(),
        Remedy::FitWithErrors { .. } => "write it with `drape fit SHEET -o FABRIC.toml`, from a sheet \
                                         with curves or with standard deviations"
            .into(),
        Remedy::RepairMesh { mesh, repaired, named } => format!(
            "`drape check {0}` shows all faults; `drape check {0} --repair {1}` mends what is safe; then give file = \
             {2:?}",
            word(mesh),
            word(repaired),
            named.display().to_string()
        ),
        Remedy::ListCrossings { mesh } => format!("`drape check {}` lists them", word(mesh)),
        Remedy::ThinMesh { mesh, scale, spacing, thinned } => format!(
            "`drape check {} --scale {scale} --spacing {} --repair {}` thins them",
            word(mesh),
            1e3 * spacing,
            word(thinned)
        ),
        Remedy::ShowStart { scene } => {
            format!("`drape check {} --figure place.png` shows them", word(scene))
        }
        Remedy::RunWithoutGrading => {
            "run the scene without [grading] first, at a larger spacing and with a folder of its own: \
             drape run SCENE --set spacing='\"10 mm\"' -o FOLDER"
                .into()
        }
        Remedy::AllowPath { place } => {
            format!("move it there, or allow it with --allow-path {}", word(place))
        }
        Remedy::RaiseLimits { factor } => format!("--raise-limits {factor} reads it"),
        Remedy::RunAnew => "or run the scene anew with drape run --force".into(),
        Remedy::UseFile { path, named, purpose } => use_file(path, named, *purpose),
    }
}

/// Returns the commands that take the file or folder at `path`, which a scene names as `named`.
fn use_file(path: &Path, named: &Path, purpose: FilePurpose) -> String {
    let file = word(path);
    // Standard input has no name that a scene could state.
    let named = if file == "-" { "FILE".into() } else { named.display().to_string() };

    match purpose {
        FilePurpose::Scene => {
            format!("`drape run {file}` simulates it, `drape check {file}` describes it")
        }
        FilePurpose::Fabric => format!(
            "`drape fabric show {file}` shows it, `drape test {file}` tests specimens of it; a scene names it: \
             fabric.NAME.file = \"{named}\""
        ),
        FilePurpose::Sheet => format!(
            "`drape fit {file}` fits a fabric to it, `drape check {file}` describes it; a scene names it: \
             fabric.NAME.file = \"{named}\""
        ),
        FilePurpose::Pattern => format!(
            "`drape check {file}` says how it is cut; a scene sews it: [[garment]] pattern = \"{named}\""
        ),
        FilePurpose::Study => {
            format!("`drape sweep run {file}` runs it, `drape check {file}` describes it")
        }
        FilePurpose::Drawing => {
            format!("`drape convert {file} -o pattern.toml` makes a pattern of it")
        }
        FilePurpose::Body => format!(
            "`drape check {file}` describes it; a scene names it: [[collider.mesh]] file = \"{named}\""
        ),
        FilePurpose::Table => format!(
            "`drape fit {file}` fits a fabric to it, `drape convert {file} -o sheet.toml` makes a sheet of it"
        ),
        FilePurpose::Run => {
            format!("`drape view {file}` shows it, `drape check {file}` verifies it")
        }
    }
}

/// Returns the advice to state one of `units` for the pattern `file`. The advice begins with the
/// words `start`.
fn say_unit(start: &str, file: &Path, units: &[&str]) -> String {
    let (first, others) = units.split_first().unwrap_or((&"mm", &[]));
    format!(
        "{start}: drape convert {} --unit {first} (or {}), or unit = \"{first}\" in the [from] of a pattern",
        word(file),
        others.join(", ")
    )
}

/// Returns the limit that ended a run, with the option that sets it.
pub(crate) fn limit_in_words(limit: ReachedLimit) -> String {
    match limit {
        ReachedLimit::Wall { taken, limit } => {
            format!("--max-wall: it has taken {taken:.0} s, of {limit} s")
        }
        ReachedLimit::Memory { taken, limit } => {
            format!("--max-memory: it takes {taken:.0} MB, of {limit} MB")
        }
        ReachedLimit::Disk { taken, limit } => {
            format!("--max-disk: its results take {taken:.0} MB, of {limit} MB")
        }
    }
}

/// Returns `path` as a word of a shell. Standard input is typed as a dash.
fn word(path: &Path) -> String {
    let standard = Path::new("-");
    if input::message_path(standard) == path {
        return "-".into();
    }
    shell_word(&path.display().to_string())
}

/// Returns `text` as a word of a shell, in quotes if the shell needs them.
fn shell_word(text: &str) -> String {
    let is_plain = text.chars().all(|letter| letter.is_alphanumeric() || "/._-+,".contains(letter));
    if is_plain && !text.is_empty() {
        return text.to_owned();
    }
    format!("'{}'", text.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_quoted_for_a_shell_where_they_need_that() {
        let quoted = ["/a/b-1.toml", "my files/a", "it's", ""].map(shell_word);
        assert_eq!(quoted, ["/a/b-1.toml", "'my files/a'", r"'it'\''s'", "''"]);
    }
}
