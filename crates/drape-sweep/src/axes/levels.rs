//! Levels of one axis: values, ranges, files, and random starts.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use drape_input::{TextOr, excerpt, toml_string};

use crate::axes::range::Range;
use crate::axes::reader::Reader;
use crate::file::AxisFile;
use crate::point::POINTS_MAX;

impl Reader<'_> {
    /// Returns the levels of an axis.
    pub(super) fn levels(&mut self, place: &str, axis: &AxisFile) -> Option<Vec<String>> {
        let AxisFile { key, values, range, files, starts, .. } = axis;
        let given = [values.is_some(), range.is_some(), files.is_some(), starts.is_some()];
        if given.iter().filter(|given| **given).count() != 1 {
            let help = "give one of values, range, files and starts";
            self.fail(place, format!("\"{}\" has not one kind of levels", excerpt(key)), help);
            return None;
        }
        let levels = if let Some(values) = values {
            values.iter().map(ToString::to_string).collect()
        } else if let Some(file) = range {
            let document = self.document;
            let fail = |own: &str, message: String, help: &str| {
                document.at(&format!("{place}.range.{own}"), message).help(help)
            };
            if !(2..=POINTS_MAX as u32).contains(&file.count) {
                let message = format!("{} levels are no range", file.count);
                let help = format!("write 2 to {POINTS_MAX}; one value stands in values = [...]");
                self.fail(&format!("{place}.range.count"), message, help);
                return None;
            }
            let range = Range::new([file.start, file.end], file.scale.as_deref(), fail);
            range.map_err(|found| self.mistakes.extend(found.0)).ok()?.levels(file)
        } else if let Some(files) = files {
            self.files(place, key, files)?
        } else {
            self.starts(place, key, starts.unwrap_or_default())?
        };
        let mut known = BTreeSet::new();
        if let Some(twice) = levels.iter().find(|level| !known.insert(*level)) {
            let message = format!("{} is there twice", excerpt(twice));
            self.fail(place, message, "name each level once");
            return None;
        }
        let Some(first) = levels.first() else {
            self.fail(place, "there are no levels", "give one or more");
            return None;
        };
        if key != self.base.key() {
            self.check_key(place, key, first);
        } else if files.is_none() {
            let help = "give its levels as files = [...]";
            self.fail(place, format!("\"{key}\" is the base of the study"), help);
            return None;
        }
        Some(levels)
    }

    /// Returns the levels of random starts: seeds of the noise of a panel.
    fn starts(&mut self, place: &str, key: &str, count: u32) -> Option<Vec<String>> {
        let noise = key.strip_suffix(".noise.seed");
        let noise = noise.map(|panel| format!("{panel}.noise.amplitude"));
        let has = noise.is_some_and(|noise| self.own.has(&with_brackets(&noise)));
        if !has {
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

    /// Returns a file as the base names it, a value of TOML.
    pub(super) fn seen_from_base(&self, path: &Path) -> Option<String> {
        seen_from(self.own.path(), path)
    }

    /// Returns the levels of files, as the base names them, seen from its folder; of other bases, as
    /// the study does.
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
                let whole = Path::new(&folder).join(pattern);
                let found = match glob::glob(&whole.to_string_lossy()) {
                    Ok(found) => found.flatten().collect::<Vec<PathBuf>>(),
                    Err(error) => {
                        let help = "write a pattern such as \"fabrics/*/sheet.toml\"";
                        self.fail(place, format!("this is no pattern: {}", error.msg), help);
                        return None;
                    }
                };
                if found.is_empty() {
                    let help = "write a pattern that files match, seen from the study's folder";
                    self.fail(place, format!("no file matches \"{}\"", excerpt(pattern)), help);
                    return None;
                }
                found
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
            let seen_from_study = || seen_from(self.document.path(), &path);
            levels.push(if is_base { seen_from_study()? } else { self.seen_from_base(&path)? });
        }
        Some(levels)
    }
}

/// Returns a path as it is seen from the folder of a file, a value of TOML.
fn seen_from(file: &Path, path: &Path) -> Option<String> {
    let from = std::path::absolute(file).ok()?;
    let from = from.parent().unwrap_or(Path::new(""));
    let whole = plain(&std::path::absolute(path).ok()?);
    let seen = pathdiff::diff_paths(&whole, plain(from)).unwrap_or(whole);
    Some(toml_string(&seen.to_string_lossy()))
}

/// Returns a key with the numbers of elements in brackets, as documents look them up.
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

/// Returns a whole path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            std::path::Component::ParentDir => _ = plain.pop(),
            std::path::Component::CurDir => {}
            part => plain.push(part),
        }
    }
    plain
}
