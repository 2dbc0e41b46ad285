//! Reader of the axes of a study, with the mistakes found so far.

use std::collections::{BTreeMap, BTreeSet};

use drape_input::{
    Diagnostic, Document, Setting, SettingError, excerpt, missing_file_help, toml_key, toml_string,
};

use crate::axes::covariance::{Covariance, CovarianceError};
use crate::axes::design::Method;
use crate::axes::range::Range;
use crate::axes::{Axis, AxisKind, Group};
use crate::base::Base;
use crate::file::{CovarianceFile, SampleFile, StudyFile};
use crate::point::POINTS_MAX;

/// Reader of the axes of a study.
pub(crate) struct Reader<'a> {
    pub(crate) document: &'a Document,
    pub(crate) base: Base,
    /// File of the base, with the settings of the study that hold at all points.
    pub(crate) own: &'a Document,
    pub(crate) mistakes: Vec<Diagnostic>,
}

impl Reader<'_> {
    pub(crate) fn fail(&mut self, key: &str, message: impl Into<String>, help: impl Into<String>) {
        self.mistakes.push(self.document.at(key, message).help(help));
    }

    /// Returns the axes in groups that go in step.
    pub(crate) fn groups(&mut self, file: &StudyFile) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        for (index, axis) in file.axis.iter().enumerate() {
            let place = format!("axis[{index}]");
            let Some(levels) = self.levels(&place, axis) else { continue };
            let name = axis.together.clone();
            let kind = axis.starts.map_or(AxisKind::Levels, |_| AxisKind::Starts);
            let own = Axis {
                name: axis.name.clone().unwrap_or_else(|| axis.key.clone()),
                key: axis.key.clone(),
                levels,
                kind,
            };
            let group = groups.iter_mut().find(|group| name.is_some() && group.name == name);
            match group {
                None => groups.push(Group { name, axes: vec![own] }),
                Some(group) if group.len() == own.levels.len() => group.axes.push(own),
                Some(group) => {
                    let (first, count) = (&group.axes[0], own.levels.len());
                    let message =
                        format!("{count} levels in step with {} of {}", group.len(), first.name);
                    let help = "give axes that go together as many levels each";
                    self.fail(&format!("{place}.together"), message, help);
                }
            }
        }
        for (index, sample) in file.sample.iter().enumerate() {
            let axes = self.sample(&format!("sample[{index}]"), sample);
            groups.extend((!axes.is_empty()).then_some(Group { name: None, axes }));
        }
        for (index, covariance) in file.covariance.iter().enumerate() {
            let axes = self.covariance(&format!("covariance[{index}]"), covariance);
            groups.extend((!axes.is_empty()).then_some(Group { name: None, axes }));
        }
        self.check_names(&groups);
        let count = groups.iter().map(Group::len).try_fold(1_usize, usize::checked_mul);
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

    /// Checks a key of the base with a level.
    pub(super) fn check_key(&mut self, place: &str, key: &str, level: &str) {
        let set = Setting::new(key, level).and_then(|setting| self.own.accepts(&setting));
        if let Err(SettingError { message, help }) = set {
            self.fail(&format!("{place}.key"), message, help);
        }
    }

    /// Returns the axes of a sample.
    fn sample(&mut self, place: &str, sample: &SampleFile) -> Vec<Axis> {
        let method = match sample.method.as_str() {
            "sobol" => Method::Sobol,
            "latin-hypercube" => Method::LatinHypercube,
            other => {
                let message = format!("there is no method \"{}\"", excerpt(other));
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
        for (index, (own, coordinates)) in sample.range.iter().zip(coordinates).enumerate() {
            let place = format!("{place}.range[{index}]");
            let document = self.document;
            let fail = |own: &str, message: String, help: &str| {
                document.at(&format!("{place}.{own}"), message).help(help)
            };
            match Range::new([own.start, own.end], own.scale.as_deref(), fail) {
                Ok(range) => {
                    let levels: Vec<String> =
                        coordinates.into_iter().map(|x| range.at(x)).collect();
                    self.check_key(&place, &own.key, &levels[0]);
                    let name = own.name.clone().unwrap_or_else(|| own.key.clone());
                    axes.push(Axis { name, key: own.key.clone(), levels, kind: AxisKind::Sample });
                }
                Err(found) => self.mistakes.extend(found.0),
            }
        }
        axes
    }

    /// Returns the axes of a sample of the numbers of a fitted fabric.
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
        let known: BTreeMap<String, toml::Value> =
            self.own.decode::<Fabrics>().map(|scene| scene.fabric).unwrap_or_default();
        if !known.contains_key(&file.fabric) {
            let names: Vec<&str> = known.keys().map(String::as_str).collect();
            let message = format!("the scene has no fabric \"{}\"", excerpt(&file.fabric));
            let help = format!("its fabrics are: {}", names.join(", "));
            self.fail(&format!("{place}.fabric"), message, help);
            return Vec::new();
        }
        let fabric = self.document.beside(&file.file).map_err(|misplaced| CovarianceError {
            message: misplaced.to_string(),
            help: misplaced.help(),
        });
        let fabric = fabric.and_then(|path| match path.is_file() {
            true => Document::read(&path).map_err(|mistakes| CovarianceError {
                message: mistakes.to_string(),
                help: "name a fabric.toml".into(),
            }),
            false => Err(CovarianceError {
                message: format!("there is no {}", path.display()),
                help: missing_file_help(&path),
            }),
        });
        let sampled = fabric.and_then(|fabric| {
            Covariance::read(&fabric, file.keys.as_deref()).map(|c| (fabric, c))
        });
        let (fabric, covariance) = match sampled {
            Ok(found) => found,
            Err(CovarianceError { message, help }) => {
                self.fail(&format!("{place}.file"), message, help);
                return Vec::new();
            }
        };
        let of_scene = format!("fabric.{}", toml_key(&file.fabric));
        let Some(level) = self.seen_from_base(fabric.path()) else { return Vec::new() };
        let own = known[&file.fabric].get("file").and_then(|file| file.as_str()).map(toml_string);
        let mut axes = Vec::new();
        if own.as_ref() != Some(&level) {
            let levels = vec![level; file.count as usize];
            let key = format!("{of_scene}.file");
            axes.push(Axis { name: key.clone(), key, levels, kind: AxisKind::Follower });
        }
        for sampled in covariance.sample(file.count, file.seed) {
            let kind = if sampled.is_follower { AxisKind::Follower } else { AxisKind::Sample };
            axes.push(Axis {
                name: format!("{} {}", file.fabric, sampled.key),
                key: format!("{of_scene}.set.\"{}\"", sampled.key),
                levels: sampled.values,
                kind,
            });
        }
        axes
    }

    /// Checks that each key and each name is there once.
    fn check_names(&mut self, groups: &[Group]) {
        let (mut keys, mut names) = (BTreeSet::new(), BTreeSet::new());
        for axis in groups.iter().flat_map(|group| &group.axes) {
            let what = match (keys.insert(&axis.key), names.insert(&axis.name)) {
                (false, _) => format!("the key \"{}\" is set by two axes", excerpt(&axis.key)),
                (_, false) => format!("two axes have the name \"{}\"", excerpt(&axis.name)),
                _ => continue,
            };
            let help = "give each axis its own key and its own name";
            self.mistakes.push(Diagnostic::new(self.document.path(), what).help(help));
        }
    }
}

/// Fabrics of a scene.
#[derive(serde::Deserialize)]
struct Fabrics {
    #[serde(default)]
    fabric: BTreeMap<String, toml::Value>,
}
