//! Reader of the axes of a study.

use std::collections::{BTreeMap, BTreeSet};

use drape_input::{
    Advice, Diagnostic, Document, Setting, SettingError, excerpt, missing_file_help, toml_key,
    toml_string,
};

use crate::axes::covariance::{Covariance, CovarianceError};
use crate::axes::design::Method;
use crate::axes::range::Range;
use crate::axes::{Axis, AxisKind, Group};
use crate::base::Base;
use crate::file::{CovarianceFile, SampleFile, StudyFile};
use crate::point::POINTS_MAX;

/// Reader of the axes of a study, which collects mistakes.
pub(crate) struct Reader<'a> {
    /// Study.
    pub(crate) document: &'a Document,
    pub(crate) base: Base,
    /// File of the base, with the settings that the study gives to all points.
    pub(crate) base_document: &'a Document,
    /// Mistakes so far.
    pub(crate) mistakes: Vec<Diagnostic>,
}

impl Reader<'_> {
    /// Records a mistake at the key path `key` of the study.
    pub(crate) fn fail(&mut self, key: &str, message: impl Into<String>, help: impl Into<Advice>) {
        self.mistakes.push(self.document.at(key, message).help(help));
    }

    /// Returns the axes of the study `file`, in groups of axes that go in step.
    pub(crate) fn groups(&mut self, file: &StudyFile) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for (index, axis) in file.axis.iter().enumerate() {
            let place = format!("axis[{index}]");
            let Some(levels) = self.levels(&place, axis) else { continue };
            let name = axis.together.clone();
            let kind = axis.starts.map_or(AxisKind::Levels, |_| AxisKind::Starts);
            let axis = Axis {
                name: axis.name.clone().unwrap_or_else(|| axis.key.clone()),
                key: axis.key.clone(),
                levels,
                kind,
            };

            let group = groups.iter_mut().find(|group| name.is_some() && group.name == name);
            match group {
                None => groups.push(Group { name, axes: vec![axis] }),
                Some(group) if group.level_count() == axis.levels.len() => group.axes.push(axis),
                Some(group) => {
                    let (count, group_count) = (axis.levels.len(), group.level_count());
                    let first = &group.axes[0].name;
                    let message = format!("{count} levels in step with {group_count} of {first}");
                    let help = "give axes that go together as many levels each";
                    self.fail(&format!("{place}.together"), message, help);
                }
            }
        }

        // The numbers of a sample always go in step.
        for (index, sample) in file.sample.iter().enumerate() {
            let axes = self.sample(&format!("sample[{index}]"), sample);
            groups.extend((!axes.is_empty()).then_some(Group { name: None, axes }));
        }
        for (index, covariance) in file.covariance.iter().enumerate() {
            let axes = self.covariance(&format!("covariance[{index}]"), covariance);
            groups.extend((!axes.is_empty()).then_some(Group { name: None, axes }));
        }

        self.check_names(&groups);
        let count = groups.iter().map(Group::level_count).try_fold(1_usize, usize::checked_mul);
        if file.axis.is_empty() && file.sample.is_empty() && file.covariance.is_empty() {
            let help =
                "add an [[axis]] with a key and its values, a [[sample]] or a [[covariance]]";
            let mistake = Diagnostic::new(self.document.path(), "the study has no axis");
            self.mistakes.push(mistake.help(help));
        } else if count.is_none_or(|count| count > POINTS_MAX) {
            let message = format!("the study has more than {POINTS_MAX} points");
            let help = "take fewer levels, or a [[sample]] in place of axes";
            self.mistakes.push(Diagnostic::new(self.document.path(), message).help(help));
        }
        groups
    }

    /// Checks that the key `key` of the base can be set to `level`.
    pub(super) fn check_key(&mut self, place: &str, key: &str, level: &str) {
        let result =
            Setting::new(key, level).and_then(|setting| self.base_document.accepts(&setting));
        if let Err(SettingError { message, help }) = result {
            self.fail(&format!("{place}.key"), message, help);
        }
    }

    /// Returns the axes of `sample`, which is at the key path `place` of the study.
    fn sample(&mut self, place: &str, sample: &SampleFile) -> Vec<Axis> {
        let method = match sample.method.as_str() {
            "sobol" => Method::Sobol,
            "latin-hypercube" => Method::LatinHypercube,
            unknown => {
                let message = format!("there is no method \"{}\"", excerpt(unknown));
                let help = "write \"sobol\" or \"latin-hypercube\"";
                self.fail(&format!("{place}.method"), message, help);
                return Vec::new();
            }
        };

        let count_max = method.points_max().min(POINTS_MAX as u32);
        if !(1..=count_max).contains(&sample.count) {
            let message = format!("a sample of {}", sample.count);
            self.fail(&format!("{place}.count"), message, format!("write 1 to {count_max}"));
            return Vec::new();
        }
        let dimensions = sample.range.len();
        if !(1..=method.dimensions_max()).contains(&dimensions) {
            let message = format!("a sample of {dimensions} ranges");
            let help = format!("give 1 to {} [[sample.range]]", method.dimensions_max());
            self.fail(place, message, help);
            return Vec::new();
        }

        let coordinates = method.coordinates(dimensions, sample.count, sample.seed);
        let mut axes = Vec::new();
        for (index, (file, coordinates)) in sample.range.iter().zip(coordinates).enumerate() {
            let place = format!("{place}.range[{index}]");
            let ends = [file.start, file.end];
            let range = Range::new(ends, file.scale.as_deref(), |key, message, help| {
                self.document.at(&format!("{place}.{key}"), message).help(help)
            });
            match range {
                Ok(range) => {
                    let levels: Vec<String> =
                        coordinates.into_iter().map(|x| range.at(x)).collect();
                    self.check_key(&place, &file.key, &levels[0]);
                    let key = file.key.clone();
                    let name = file.name.clone().unwrap_or_else(|| key.clone());
                    axes.push(Axis { name, key, levels, kind: AxisKind::Sample });
                }
                Err(mistakes) => self.mistakes.extend(mistakes.0),
            }
        }
        axes
    }

    /// Returns the axes of a sample of the numbers of the fitted fabric that `file` names. `file`
    /// is at the key path `place` of the study.
    fn covariance(&mut self, place: &str, file: &CovarianceFile) -> Vec<Axis> {
        if !(1..=POINTS_MAX as u32).contains(&file.count) {
            let message = format!("a sample of {}", file.count);
            self.fail(&format!("{place}.count"), message, format!("write 1 to {POINTS_MAX}"));
            return Vec::new();
        }
        if self.base != Base::Scene {
            let help = "take a scene as the base, or a [[sample]] of keys of the fabric";
            self.fail(place, format!("the base is a {}", self.base.key()), help);
            return Vec::new();
        }

        let scene = self.base_document.decode::<SceneFabrics>();
        let fabrics = scene.map(|scene| scene.fabric).unwrap_or_default();
        if !fabrics.contains_key(&file.fabric) {
            let names: Vec<&str> = fabrics.keys().map(String::as_str).collect();
            let message = format!("the scene has no fabric \"{}\"", excerpt(&file.fabric));
            let help = format!("its fabrics are: {}", names.join(", "));
            self.fail(&format!("{place}.fabric"), message, help);
            return Vec::new();
        }

        let fabric_and_covariance = self.read_fabric(&file.file).and_then(|fabric| {
            let covariance = Covariance::read(&fabric, file.keys.as_deref())?;
            Ok((fabric, covariance))
        });
        let (fabric, covariance) = match fabric_and_covariance {
            Ok(pair) => pair,
            Err(CovarianceError { message, help }) => {
                self.fail(&format!("{place}.file"), message, help);
                return Vec::new();
            }
        };

        // Where the scene names another file, an axis with a single value replaces this file.
        let fabric_key = format!("fabric.{}", toml_key(&file.fabric));
        let Some(level) = self.relative_to_base(fabric.path()) else { return Vec::new() };
        let scene_file =
            fabrics[&file.fabric].get("file").and_then(|file| file.as_str()).map(toml_string);
        let mut axes = Vec::new();
        if scene_file.as_ref() != Some(&level) {
            let levels = vec![level; file.count as usize];
            let key = format!("{fabric_key}.file");
            axes.push(Axis { name: key.clone(), key, levels, kind: AxisKind::Follower });
        }
        for sampled in covariance.sample(file.count, file.seed) {
            let kind = if sampled.is_follower { AxisKind::Follower } else { AxisKind::Sample };
            axes.push(Axis {
                name: format!("{} {}", file.fabric, sampled.key),
                key: format!("{fabric_key}.set.\"{}\"", sampled.key),
                levels: sampled.values,
                kind,
            });
        }
        axes
    }

    /// Reads the fabric in the file `name`, which the study names.
    fn read_fabric(&self, name: &str) -> Result<Document, CovarianceError> {
        let path = self.document.beside(name).map_err(|forbidden| CovarianceError {
            message: forbidden.to_string(),
            help: forbidden.help(),
        })?;
        if !path.is_file() {
            return Err(CovarianceError {
                message: format!("there is no {}", path.display()),
                help: missing_file_help(&path).into(),
            });
        }
        Document::read_with(&path, self.document.access()).map_err(|mistakes| {
            let remedy = mistakes.0.iter().find_map(|mistake| mistake.remedy.clone());
            let messages: Vec<String> =
                mistakes.0.into_iter().map(|mistake| mistake.message).collect();
            CovarianceError {
                message: format!("{}: {}", path.display(), messages.join("; ")),
                help: Advice { text: "name a fabric.toml".into(), remedy },
            }
        })
    }

    /// Checks that no two axes of `groups` have one key or one name.
    fn check_names(&mut self, groups: &[Group]) {
        let (mut keys, mut names) = (BTreeSet::new(), BTreeSet::new());
        for axis in groups.iter().flat_map(|group| &group.axes) {
            let message = match (keys.insert(&axis.key), names.insert(&axis.name)) {
                (false, _) => format!("the key \"{}\" is set by two axes", excerpt(&axis.key)),
                (_, false) => format!("two axes have the name \"{}\"", excerpt(&axis.name)),
                _ => continue,
            };
            let help = "give each axis its own key and its own name";
            self.mistakes.push(Diagnostic::new(self.document.path(), message).help(help));
        }
    }
}

/// Fabrics of a scene, by their names.
#[derive(serde::Deserialize)]
struct SceneFabrics {
    #[serde(default)]
    fabric: BTreeMap<String, toml::Value>,
}
