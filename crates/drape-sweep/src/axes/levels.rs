//! Levels of one axis: values, ranges, files, and random starts.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape_input::{TextOr, excerpt, toml_string};

use crate::axes::range::Range;
use crate::axes::reader::Reader;
use crate::file::AxisFile;
use crate::point::POINTS_MAX;

impl Reader<'_> {
    /// Returns the levels of `axis`, which is at the key path `place` of the study. Returns `None`
    /// after a mistake, which is recorded.
    pub(super) fn levels(&mut self, place: &str, axis: &AxisFile) -> Option<Vec<String>> {
        let AxisFile { key, values, range, files, starts, .. } = axis;
        let kinds = [values.is_some(), range.is_some(), files.is_some(), starts.is_some()];
        if kinds.iter().filter(|is_given| **is_given).count() != 1 {
            let help = "give one of values, range, files and starts";
            self.fail(place, format!("\"{}\" has not one kind of levels", excerpt(key)), help);
            return None;
        }

        let levels = if let Some(values) = values {
            values.iter().map(ToString::to_string).collect()
        } else if let Some(file) = range {
            if !(2..=POINTS_MAX as u32).contains(&file.count) {
                let message = format!("{} levels are no range", file.count);
                let help = format!("write 2 to {POINTS_MAX}; one value stands in values = [...]");
                self.fail(&format!("{place}.range.count"), message, help);
                return None;
            }
            let ends = [file.start, file.end];
            let range = Range::new(ends, file.scale.as_deref(), |key, message, help| {
                self.document.at(&format!("{place}.range.{key}"), message).help(help)
            });
            range.map_err(|mistakes| self.mistakes.extend(mistakes.0)).ok()?.levels(file)
        } else if let Some(files) = files {
            self.files(place, key, files)?
        } else {
            self.starts(place, key, starts.unwrap_or_default())?
        };

        let mut known = BTreeSet::new();
        if let Some(duplicate) = levels.iter().find(|level| !known.insert(*level)) {
            let message = format!("{} is there twice", excerpt(duplicate));
            self.fail(place, message, "name each level once");
            return None;
        }
        let Some(first) = levels.first() else {
            self.fail(place, "there are no levels", "give one or more");
            return None;
        };

        // Only a list of files can replace the base itself.
        if key != self.base.key() {
            self.check_key(place, key, first);
        } else if files.is_none() {
            let help = "give its levels as files = [...]";
            self.fail(place, format!("\"{key}\" is the base of the study"), help);
            return None;
        }
        Some(levels)
    }

    /// Returns `count` levels of random starts: seeds for the noise of a panel, at the key `key`.
    fn starts(&mut self, place: &str, key: &str, count: u32) -> Option<Vec<String>> {
        let panel = key.strip_suffix(".noise.seed");
        let has_noise = panel.is_some_and(|panel| {
            let amplitude = format!("{panel}.noise.amplitude");
            self.base_document.has(&with_brackets(&amplitude))
        });
        if !has_noise {
            let help = "give the panel noise = { amplitude = …, length = … } in the scene, and the \
                        axis key = \"panel.0.noise.seed\"";
            let message = format!("\"{}\" is not the seed of a panel's noise", excerpt(key));
            self.fail(&format!("{place}.key"), message, help);
            return None;
        }
        if !(1..=POINTS_MAX as u32).contains(&count) {
            let help = format!("write 1 to {POINTS_MAX}");
            self.fail(&format!("{place}.starts"), format!("{count} starts"), help);
            return None;
        }
        Some((1..=count).map(|seed| seed.to_string()).collect())
    }

    /// Returns `path` relative to the folder of the base, as a TOML value.
    pub(super) fn relative_to_base(&self, path: &Path) -> Option<String> {
        relative_to_file(self.base_document.path(), path)
    }

    /// Returns the levels of an axis of `files` as TOML values.
    ///
    /// The paths are relative to the folder of the base. Files that replace the base are relative
    /// to the folder of the study.
    fn files(
        &mut self,
        place: &str,
        key: &str,
        files: &TextOr<Vec<String>>,
    ) -> Option<Vec<String>> {
        let place = &format!("{place}.files");
        let is_base = key == self.base.key();
        let folder = self.document.path().parent().unwrap_or(Path::new(""));
        let paths = match files {
            TextOr::Other(names) => names.iter().map(|name| folder.join(name)).collect(),
            TextOr::Text(pattern) => {
                let folder = glob::Pattern::escape(&folder.to_string_lossy());
                let full_pattern = Path::new(&folder).join(pattern);
                let matches = match glob::glob(&full_pattern.to_string_lossy()) {
                    Ok(matches) => matches.flatten().collect::<Vec<PathBuf>>(),
                    Err(error) => {
                        let help = "write a pattern such as \"fabrics/*/sheet.toml\"";
                        self.fail(place, format!("this is no pattern: {}", error.msg), help);
                        return None;
                    }
                };
                if matches.is_empty() {
                    let help = "write a pattern that files match, seen from the study's folder";
                    self.fail(place, format!("no file matches \"{}\"", excerpt(pattern)), help);
                    return None;
                }
                matches
            }
        };

        let mut levels = Vec::new();
        for path in paths {
            if !path.exists() {
                let message = format!("there is no {}", path.display());
                self.fail(place, message, drape_input::missing_file_help(&path));
                return None;
            }
            if is_base && let Err(misplaced) = self.document.permit(&path) {
                self.fail(place, misplaced.to_string(), misplaced.help());
                return None;
            }
            levels.push(if is_base {
                relative_to_file(self.document.path(), &path)?
            } else {
                self.relative_to_base(&path)?
            });
        }
        Some(levels)
    }
}

/// Returns `path` relative to the folder of `file`, as a TOML value.
fn relative_to_file(file: &Path, path: &Path) -> Option<String> {
    let file = std::path::absolute(file).ok()?;
    let folder = without_dots(file.parent().unwrap_or(Path::new("")));
    let target = without_dots(&std::path::absolute(path).ok()?);
    let relative = pathdiff::diff_paths(&target, folder).unwrap_or(target);
    Some(toml_string(&relative.to_string_lossy()))
}

/// Returns `key`, such as `panel.0.noise`, with the numbers of elements in brackets, as
/// [`Document::has`](drape_input::Document::has) expects them.
fn with_brackets(key: &str) -> String {
    let mut text = String::new();
    for part in key.split('.') {
        match part.parse::<usize>() {
            Ok(number) if !text.is_empty() => text += &format!("[{number}]"),
            _ if text.is_empty() => text += part,
            _ => text += &format!(".{part}"),
        }
    }
    text
}

/// Returns the absolute `path` without `.` and `..`.
fn without_dots(path: &Path) -> PathBuf {
    let mut result = PathBuf::new();
    for part in path.components() {
        match part {
            std::path::Component::ParentDir => _ = result.pop(),
            std::path::Component::CurDir => {}
            part => result.push(part),
        }
    }
    result
}
