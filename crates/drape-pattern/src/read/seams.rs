//! Seams as files and scenes state them: edges by name. They are added to a pattern, or replace its
//! seams.

use std::collections::BTreeMap;

use drape_input::{
    Angle, Diagnostic, Diagnostics, Document, Edit, Given, Length, Subject, closest, figure,
    toml_key, toml_string,
};
use serde::Deserialize;

use crate::ease::DEFAULT_EASE;
#[cfg(feature = "schema")]
use crate::ease::MAX_EASE;
use crate::length::Millimetres;
use crate::mistake::Mistake;
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::pattern::seam::{EdgeId, Seam};

/// Largest angle of a fold or a seam, in degrees; beyond it the bending of yarns is not exact.
const ANGLE_MAX: f64 = 140.0;

/// Widest allowance or hem, in m; beyond it a length in the wrong unit is far more likely.
const WIDTH_MAX: f64 = 0.3;

/// Seam as a file states it, with edges by their names.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SeamKeys {
    /// Edges of both sides, as `panel.edge`, in the order in which the seam runs.
    pub sides: [Vec<String>; 2],
    /// Whether the seam joins a right side to a wrong side.
    #[serde(default)]
    pub reversed: bool,
    /// Largest ratio of the lengths of the sides that is meant; 1.1 if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(1.0, MAX_EASE)))]
    pub max_ease: Option<f64>,
    /// Angle between the sides of the sewn seam, towards their right sides, in degrees.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(-ANGLE_MAX, ANGLE_MAX)))]
    #[serde(default)]
    pub angle: Given<Angle>,
    /// Width of the seam allowance on each side, in the unit of the file.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(0.0)))]
    #[serde(default)]
    pub allowance: Given<Length>,
}

/// Table of a file that states seams and panels.
#[derive(Debug, Clone, Copy)]
pub struct PatternTable<'a> {
    /// File with the table.
    pub document: &'a Document,
    /// Key of the table, with a dot at its end; empty at the top of the file.
    pub prefix: &'a str,
    /// Unit of lengths in the table, in m; NaN if it is not known.
    pub unit: f64,
}

impl PatternTable<'_> {
    /// Returns the mistake `message`, with the remedy `help`, at `key` of the table.
    pub(crate) fn at(&self, key: &str, message: impl Into<String>, help: &str) -> Diagnostic {
        self.document.at(&format!("{}{key}", self.prefix), message).help(help)
    }

    /// Returns the mistake of `angle`, the angle of a fold or a seam at `key`, if it is out of
    /// range.
    pub(crate) fn angle_mistake(&self, key: &str, angle: Given<Angle>) -> Option<Diagnostic> {
        let angle = angle.value();
        if angle.abs() <= ANGLE_MAX {
            return None;
        }
        let message = format!("{} is not between -140 and 140", figure(angle));
        Some(self.at(key, message, "degrees towards the right side of the cloth; 0 is flat"))
    }

    /// Returns the edit that sets `key` of the table to `value`, in TOML, or removes it.
    pub(crate) fn edit(&self, key: &str, value: Option<&str>) -> Option<Edit> {
        self.document.edit(&format!("{}{key}", self.prefix), value)
    }

    /// Returns the mistake of `width`, the width of an allowance or a hem at `key`, if it is out of
    /// range.
    pub(crate) fn width_mistake(&self, key: &str, width: Given<Length>) -> Option<Diagnostic> {
        let metres = width * self.unit;
        // Without a unit, a finite width cannot be judged.
        let is_right = (0.0..=WIDTH_MAX).contains(&metres)
            || self.unit.is_nan() && metres.is_nan() && !width.number().is_nan();
        if is_right {
            return None;
        }
        let message = format!("{} is not between 0 and 300 mm", Millimetres(metres));
        Some(self.at(key, message, "is the unit right? 0 is none"))
    }
}

/// Panels that seams can name; `None` for panels with mistakes.
pub(crate) type KnownPanels<'a> = Vec<(&'a str, Option<&'a Panel>)>;

/// Returns the seams that `keys` state in `table`, between panels of `known`.
///
/// # Errors
/// All mistakes of `keys`.
pub(crate) fn seams(
    table: &PatternTable<'_>,
    keys: &BTreeMap<String, SeamKeys>,
    known: &KnownPanels<'_>,
) -> Result<Vec<Seam>, Vec<Diagnostic>> {
    let numbers: BTreeMap<&str, usize> =
        known.iter().enumerate().map(|(number, (name, _))| (*name, number)).collect();
    let mut mistakes = Vec::new();
    let mut seams = Vec::new();
    for (name, seam) in keys {
        let key = format!("seam.{}", toml_key(name));
        let sides = [0, 1].map(|side| {
            let mut ids = Vec::new();
            for (number, word) in seam.sides[side].iter().enumerate() {
                let key = format!("{key}.sides[{side}][{number}]");
                match named_edges(word, known, &numbers) {
                    Ok(parts) => ids.extend(in_seam_order(parts, side, seam.reversed)),
                    Err(UnknownEdge { message, help, meant }) => {
                        let edit =
                            meant.and_then(|meant| table.edit(&key, Some(&toml_string(&meant))));
                        mistakes.push(table.at(&key, message, &help).with_edits(edit));
                    }
                }
            }
            ids
        });

        mistakes.extend(table.angle_mistake(&format!("{key}.angle"), seam.angle));
        mistakes.extend(table.width_mistake(&format!("{key}.allowance"), seam.allowance));
        seams.push(Seam {
            name: name.clone(),
            sides,
            reversed: seam.reversed,
            max_ease: seam.max_ease.unwrap_or(DEFAULT_EASE),
            angle: seam.angle.value().to_radians(),
            allowance: seam.allowance * table.unit,
        });
    }
    if mistakes.is_empty() { Ok(seams) } else { Err(mistakes) }
}

/// Returns `parts`, the parts of an edge that darts divide, in the order in which a seam runs on
/// `side`, 0 or 1. The second side of a seam that is not `reversed` runs against the outline.
pub(crate) fn in_seam_order(mut parts: Vec<EdgeId>, side: usize, reversed: bool) -> Vec<EdgeId> {
    if side == 1 && !reversed {
        parts.reverse();
    }
    parts
}

/// Mistake of a word that names no edge.
struct UnknownEdge {
    message: String,
    help: String,
    /// Word that was probably meant.
    meant: Option<String>,
}

/// Returns the edges that `word` names, such as `front.side`: one edge, or the parts of an edge
/// that darts divide, or none if the panel has mistakes. `numbers` holds the numbers of the panels
/// in `known`, by their names.
fn named_edges(
    word: &str,
    known: &KnownPanels<'_>,
    numbers: &BTreeMap<&str, usize>,
) -> Result<Vec<EdgeId>, UnknownEdge> {
    // Names of panels and edges may have dots: the longest panel counts that the word begins with.
    let mut parts = word.rmatch_indices('.').map(|(dot, _)| (&word[..dot], &word[dot + 1..]));
    let found = parts.find_map(|(name, edge)| Some((*numbers.get(name)?, name, edge)));
    let Some((panel, name, edge)) = found else {
        let (panel, edge) = word.rsplit_once('.').unwrap_or((word, ""));
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        let similar = closest(panel, names.iter().copied()).filter(|similar| *similar != panel);
        let meant = similar.map(|similar| format!("{similar}.{edge}"));
        let help = match &meant {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => format!("write panel.edge; the panels are: {}", names.join(", ")),
        };
        let message = format!("\"{word}\": there is no panel \"{panel}\"");
        return Err(UnknownEdge { message, help, meant });
    };
    let Some(known_panel) = known[panel].1 else { return Ok(Vec::new()) };
    let numbers = known_panel.edges_named(edge);
    if !numbers.is_empty() {
        return Ok(numbers.into_iter().map(|edge| EdgeId { panel, edge }).collect());
    }

    let edges: Vec<&str> = known_panel.edges().map(|edge| edge.name.as_str()).collect();
    let similar = closest(edge, edges.iter().copied());
    let meant = similar.map(|similar| format!("{name}.{similar}"));
    let help = match &meant {
        Some(meant) => format!("did you mean \"{meant}\"?"),
        None => format!("its edges are: {}", edges.join(", ")),
    };
    let message = format!("panel {name} has no edge \"{edge}\"");
    Err(UnknownEdge { message, help, meant })
}

/// Returns `base` with the seams `added`. An added seam replaces a seam with its name.
pub(crate) fn merged(base: Vec<Seam>, added: Vec<Seam>) -> Vec<Seam> {
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    for (number, seam) in base.iter().enumerate() {
        numbers.entry(seam.name.clone()).or_insert(number);
    }

    let mut merged = base;
    for seam in added {
        match numbers.get(&seam.name) {
            Some(&number) => merged[number] = seam,
            None => {
                numbers.insert(seam.name.clone(), merged.len());
                merged.push(seam);
            }
        }
    }
    merged
}

/// Returns `mistake` at the key of `table` that states its subject.
pub(crate) fn located(table: &PatternTable<'_>, mistake: &Mistake) -> Diagnostic {
    let subject = mistake.subject();
    let key = match &subject {
        Some(Subject::Edge { panel, .. } | Subject::Panel(panel)) => {
            format!("panel.{}.outline", toml_key(panel))
        }
        Some(Subject::Seam(seam)) => format!("seam.{}.sides", toml_key(seam)),
        _ => String::new(),
    };
    let located = table.at(&key, mistake.to_string(), &mistake.help());
    let ease = mistake.enough_ease().zip(key.strip_suffix(".sides"));
    let edit = ease.and_then(|(enough, seam)| {
        table.edit(&format!("{seam}.max_ease"), Some(&enough.to_string()))
    });
    Diagnostic { subject, ..located }.with_edits(edit)
}

/// Returns `mistake` of a pattern to which `table` adds `seams`, at the key of its subject.
pub(crate) fn seam_diagnostic(
    table: &PatternTable<'_>,
    mistake: &Mistake,
    seams: &BTreeMap<String, SeamKeys>,
) -> Diagnostic {
    let located = located(table, mistake);
    match mistake {
        Mistake::SewnTwice { first, .. } if !seams.contains_key(first) => {
            let key = toml_key(first);
            located.help(format!(
                "the pattern sews it in seam {first}: name yours [seam.{key}] to take its place, or sew \
                 other edges"
            ))
        }
        _ => located,
    }
}

impl Pattern {
    /// Returns the pattern with the seams `seams`, which `table` of a file states. A seam with the
    /// name of a seam of the pattern replaces it.
    ///
    /// # Errors
    /// All mistakes of `seams`, each with its place and a remedy.
    pub fn with_seams(
        self,
        seams: &BTreeMap<String, SeamKeys>,
        table: &PatternTable<'_>,
    ) -> Result<Self, Diagnostics> {
        let known = self.panels().iter().map(|panel| (panel.name(), Some(panel)));
        let added = self::seams(table, seams, &known.collect()).map_err(Diagnostics)?;
        let all = merged(self.seams().to_vec(), added);
        let notes = self.file_notes();
        match Self::new(self.panels().to_vec(), all) {
            Ok(pattern) => Ok(pattern.with_notes(notes)),
            Err(mistakes) => {
                let mistakes =
                    mistakes.iter().map(|mistake| seam_diagnostic(table, mistake, seams));
                Err(Diagnostics(mistakes.collect()))
            }
        }
    }
}
