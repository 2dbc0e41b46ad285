//! Seams as files and scenes state them: edges by name, added to a pattern or in place of its own.

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

/// Place of a table with seams and panels in a file.
#[derive(Debug, Clone, Copy)]
pub struct PatternTable<'a> {
    /// File that states them.
    pub document: &'a Document,
    /// Key of the table, with a dot at its end; empty at the top of the file.
    pub prefix: &'a str,
    /// Unit of its lengths, in m; NaN if it is not known.
    pub unit: f64,
}

impl PatternTable<'_> {
    /// Returns a mistake at a key of the table.
    pub(crate) fn at(&self, key: &str, message: impl Into<String>, help: &str) -> Diagnostic {
        self.document.at(&format!("{}{key}", self.prefix), message).help(help)
    }

    /// Returns the mistake of an angle of a fold or a seam, in degrees.
    pub(crate) fn angle(&self, key: &str, angle: Given<Angle>) -> Option<Diagnostic> {
        let angle = angle.value();
        let message = || format!("{} is not between -140 and 140", figure(angle));
        let help = "degrees towards the right side of the cloth; 0 is flat";
        (!(angle.abs() <= ANGLE_MAX)).then(|| self.at(key, message(), help))
    }

    /// Returns the change of a value of the table, in TOML, or its removal.
    pub(crate) fn edit(&self, key: &str, new: Option<&str>) -> Option<Edit> {
        self.document.edit(&format!("{}{key}", self.prefix), new)
    }

    /// Returns the mistake of the width of an allowance or a hem.
    pub(crate) fn width(&self, key: &str, width: Given<Length>) -> Option<Diagnostic> {
        let metres = width * self.unit;
        // Without a unit nothing can be said.
        let right = (0.0..=WIDTH_MAX).contains(&metres)
            || self.unit.is_nan() && metres.is_nan() && !width.number().is_nan();
        let message = || format!("{} is not between 0 and 300 mm", Millimetres(metres));
        let help = "is the unit right? 0 is none";
        (!right).then(|| self.at(key, message(), help))
    }
}

/// Panels that seams can name; `None` for those with mistakes.
pub(crate) type Known<'a> = Vec<(&'a str, Option<&'a Panel>)>;

/// Returns the seams that a file states, or all mistakes of their keys.
pub(crate) fn seams(
    place: &PatternTable<'_>,
    keys: &BTreeMap<String, SeamKeys>,
    known: &Known<'_>,
) -> Result<Vec<Seam>, Vec<Diagnostic>> {
    let mut mistakes = Vec::new();
    let mut seams = Vec::new();
    for (name, seam) in keys {
        let key = format!("seam.{}", toml_key(name));
        let sides = [0, 1].map(|side| {
            let mut ids = Vec::new();
            for (number, word) in seam.sides[side].iter().enumerate() {
                let key = format!("{key}.sides[{side}][{number}]");
                match edges(word, known) {
                    // Against the outline, the parts of an edge that darts divide come the other way.
                    Ok(mut parts) => {
                        if side == 1 && !seam.reversed {
                            parts.reverse();
                        }
                        ids.extend(parts);
                    }
                    Err(WrongWord { message, help, meant }) => {
                        let edit =
                            meant.and_then(|meant| place.edit(&key, Some(&toml_string(&meant))));
                        mistakes.push(place.at(&key, message, &help).with_edits(edit));
                    }
                }
            }
            ids
        });
        mistakes.extend(place.angle(&format!("{key}.angle"), seam.angle));
        mistakes.extend(place.width(&format!("{key}.allowance"), seam.allowance));
        seams.push(Seam {
            name: name.clone(),
            sides,
            reversed: seam.reversed,
            max_ease: seam.max_ease.unwrap_or(DEFAULT_EASE),
            angle: seam.angle.value().to_radians(),
            allowance: seam.allowance * place.unit,
        });
    }
    if mistakes.is_empty() { Ok(seams) } else { Err(mistakes) }
}

/// Word of a seam that names no edge.
struct WrongWord {
    message: String,
    help: String,
    /// Word that was probably meant.
    meant: Option<String>,
}

/// Returns the edges that a word such as `front.side` names: one, the parts of one that darts divide,
/// or none if its panel has mistakes.
fn edges(word: &str, known: &Known<'_>) -> Result<Vec<EdgeId>, WrongWord> {
    // Names of panels and edges may have dots: the longest panel counts that the word begins with.
    let rest = |name: &str| word.strip_prefix(name).and_then(|rest| rest.strip_prefix('.'));
    let panels =
        known.iter().enumerate().filter_map(|(k, (name, _))| Some((k, *name, rest(name)?)));
    let Some((panel, name, edge)) = panels.max_by_key(|(_, name, _)| name.len()) else {
        let (panel, edge) = word.rsplit_once('.').unwrap_or((word, ""));
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        let similar = closest(panel, names.iter().copied()).filter(|similar| *similar != panel);
        let meant = similar.map(|similar| format!("{similar}.{edge}"));
        let help = match &meant {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => format!("write panel.edge; the panels are: {}", names.join(", ")),
        };
        let message = format!("\"{word}\": there is no panel \"{panel}\"");
        return Err(WrongWord { message, help, meant });
    };
    let Some(own) = known[panel].1 else { return Ok(Vec::new()) };
    let numbers = own.edges_named(edge);
    if !numbers.is_empty() {
        return Ok(numbers.into_iter().map(|edge| EdgeId { panel, edge }).collect());
    }
    let edges: Vec<&str> = own.edges().map(|own| own.name.as_str()).collect();
    let similar = closest(edge, edges.iter().copied());
    let meant = similar.map(|similar| format!("{name}.{similar}"));
    let help = match &meant {
        Some(meant) => format!("did you mean \"{meant}\"?"),
        None => format!("its edges are: {}", edges.join(", ")),
    };
    let message = format!("panel {name} has no edge \"{edge}\"");
    Err(WrongWord { message, help, meant })
}

/// Returns the seams of a pattern with those of a file added, or in place of those of the same
/// name.
pub(crate) fn merged(mut own: Vec<Seam>, added: Vec<Seam>) -> Vec<Seam> {
    for seam in added {
        match own.iter_mut().find(|other| other.name == seam.name) {
            Some(other) => *other = seam,
            None => own.push(seam),
        }
    }
    own
}

/// Returns the answer to a mistake of a pattern whose seams or panels a file states.
pub(crate) fn located(place: &PatternTable<'_>, mistake: &Mistake) -> Diagnostic {
    let subject = mistake.subject();
    let key = match &subject {
        Some(Subject::Edge { panel, .. } | Subject::Panel(panel)) => {
            format!("panel.{}.outline", toml_key(panel))
        }
        Some(Subject::Seam(seam)) => format!("seam.{}.sides", toml_key(seam)),
        _ => String::new(),
    };
    let located = place.at(&key, mistake.to_string(), &mistake.help());
    let ease = mistake.enough_ease().zip(key.strip_suffix(".sides"));
    let edit = ease.and_then(|(enough, seam)| {
        place.edit(&format!("{seam}.max_ease"), Some(&enough.to_string()))
    });
    Diagnostic { subject, ..located }.with_edits(edit)
}

/// Returns the answer to a mistake of a pattern to which a file adds seams.
pub(crate) fn answer(
    place: &PatternTable<'_>,
    mistake: &Mistake,
    seams: &BTreeMap<String, SeamKeys>,
) -> Diagnostic {
    let located = located(place, mistake);
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
    /// Returns the pattern with the seams that a table of a file states; one with the name of a
    /// seam of the pattern takes its place.
    ///
    /// # Errors
    /// All mistakes of the seams, each with its place and a remedy.
    pub fn with_seams(
        self,
        seams: &BTreeMap<String, SeamKeys>,
        place: &PatternTable<'_>,
    ) -> Result<Self, Diagnostics> {
        let known = self.panels().iter().map(|panel| (panel.name(), Some(panel)));
        let added = self::seams(place, seams, &known.collect()).map_err(Diagnostics)?;
        let all = merged(self.seams().to_vec(), added);
        let notes = self.reader_notes();
        match Self::new(self.panels().to_vec(), all) {
            Ok(pattern) => Ok(pattern.with_notes(notes)),
            Err(mistakes) => {
                let mistakes = mistakes.iter().map(|mistake| answer(place, mistake, seams));
                Err(Diagnostics(mistakes.collect()))
            }
        }
    }
}
