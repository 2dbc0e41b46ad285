//! Reader of the project's own format, in TOML.
//!
//! ```toml
//! length = "cm"
//!
//! [panel.front]
//! grain = 0
//! start = [0, 0]
//! outline = [
//!     { name = "hem", to = [20, 0] },
//!     { name = "side", to = [18, 30], quadratic = [17, 15] },
//!     { name = "waist", to = [0, 30], cubic = [[12, 29], [6, 29]] },
//!     { name = "centre", to = [0, 0] },
//! ]
//!
//! [seam.side]
//! sides = [["front.side"], ["back.side"]]
//! ```
//!
//! With `from`, the file adds to a pattern of another format: its panels change those of the same
//! name, its seams are added or take the place of those of the same name. `keys` mirrors the file,
//! `panels` makes the panels and `darts` their darts, [`seams`](super::seams) the seams.

mod darts;
pub(crate) mod keys;
mod panels;

use std::collections::BTreeSet;

use drape_input::{
    Diagnostic, Diagnostics, Document, Faults, closest, excerpt, near_file, toml_key, toml_string,
};

use self::keys::{PanelKeys, PatternKeys};
use self::panels::{Reader, key};
use super::request::Request;
use super::seams::{Known, answer, merged, seams};
use super::size::Doubt;
use super::unit::Unit;
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::pattern::seam::{EdgeId, Seam};
use crate::sketch::Sketch;

/// Pattern of a document in the project's own format that names another file, which is still to be
/// read.
pub(crate) struct File<'a> {
    document: &'a Document,
    keys: PatternKeys,
    /// Mistakes of spelling and type.
    faults: Faults,
}

/// Decodes a document in spite of mistakes of spelling and type, which the pattern answers for.
pub(crate) fn decode(document: &Document) -> Result<File<'_>, Diagnostics> {
    let (keys, faults) = document.decode_with_faults()?;
    Ok(File { document, keys, faults })
}

impl File<'_> {
    /// Returns the file that it adds to, if it names one, and how that is to be read.
    pub(crate) fn from(&self) -> Result<Option<Request>, Diagnostics> {
        let Some(from) = &self.keys.from else { return Ok(None) };
        if self.faults.cover("from") {
            return Err(Diagnostics(Vec::new()));
        }
        let folder = self.document.path().parent().unwrap_or(std::path::Path::new(""));
        let path = folder.join(&from.file);
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
            let help = "add to that file itself; `from` is for patterns of other formats";
            return Err(self.document.at("from.file", "is a *.toml").help(help).into());
        }
        if !path.is_file() {
            let message = format!("there is no file {}", path.display());
            let near = near_file(&path).map(|name| {
                let near = std::path::Path::new(&from.file).with_file_name(name);
                toml_string(&near.to_string_lossy())
            });
            let help = match &near {
                Some(near) => {
                    format!("did you mean {near}? the path is relative to the folder of this file")
                }
                None => "the path is relative to the folder of this file".into(),
            };
            let edit = near.and_then(|near| self.document.edit("from.file", Some(&near)));
            return Err(self.document.at("from.file", message).help(help).with_edits(edit).into());
        }
        let unit = match from.unit.as_deref().map(Unit::parse) {
            None => None,
            Some(Some(unit)) => Some(unit),
            Some(None) => {
                let unit = excerpt(from.unit.as_deref().unwrap_or_default());
                let message = format!("\"{unit}\" is not a unit");
                return Err(self.document.at("from.unit", message).help(Unit::HELP).into());
            }
        };
        let (size, from) = (from.size.clone(), Some(self.document.clone()));
        Ok(Some(Request { path, unit, size, from }))
    }

    /// Removes what does not fit a pattern, whose drawing was changed: panels and edges that it has
    /// no more, and seams of them, whose names are returned.
    pub(crate) fn fit(&mut self, pattern: &Pattern) -> Vec<String> {
        let panels = pattern.panels();
        self.keys.panel.retain(|name, keys| {
            let panel = panels.iter().find(|panel| panel.name() == name);
            let has =
                |edge: &str| panel.is_some_and(|p| p.outline().iter().any(|e| e.name == edge));
            keys.hems.retain(|edge, _| has(edge));
            panel.is_some()
        });
        let words: BTreeSet<String> = panels
            .iter()
            .flat_map(|p| p.edges().map(move |e| format!("{}.{}", p.name(), e.name)))
            .collect();
        let mut lost = Vec::new();
        self.keys.seam.retain(|name, seam| {
            let fits = seam.sides.iter().flatten().all(|word| words.contains(word));
            if !fits {
                lost.push(name.clone());
            }
            fits
        });
        lost
    }

    /// Returns the pattern: its own panels and seams, and those of the pattern that it adds to.
    pub(crate) fn pattern(
        &self,
        base: Option<Pattern>,
        sketch: &mut Sketch,
    ) -> Result<Pattern, Diagnostics> {
        let Self { document, keys, faults } = self;
        let mut reader = Reader::new(document, faults, sketch);
        reader.read_unit(keys);
        if keys.panel.is_empty() && base.is_none() && !faults.cover("panel") {
            let help = "add [panel.front] with start and outline, rectangle, or path";
            let message = "the pattern has no panel";
            reader.mistakes.push(Diagnostic::new(document.path(), message).help(help));
        }
        // Without a unit the sizes cannot be checked.
        if reader.metres.is_nan() {
            return Err(reader.loose(keys, base.as_ref()));
        }
        let entries = entries(keys, base.as_ref());
        let panels = reader.all(&entries, base.as_ref());
        reader.pattern(keys, base.as_ref(), &panels)
    }

    /// Returns the mistakes of the file that do not depend on the pattern that it adds to, which has
    /// mistakes itself.
    pub(crate) fn without_base(&self, mistakes: Diagnostics) -> Diagnostics {
        let mut sketch = Sketch::default();
        let mut reader = Reader::new(self.document, &self.faults, &mut sketch);
        reader.read_unit(&self.keys);
        reader.mistakes.extend(mistakes.0);
        self.keys.panel.iter().for_each(|(name, keys)| reader.check_loose(name, keys));
        reader.finish()
    }
}

/// Panel of the pattern: its name, and its keys if the file has some.
struct Entry<'a> {
    name: &'a str,
    keys: Option<&'a PanelKeys>,
}

/// Returns the panels in their order: those of the other file, then those of this one.
fn entries<'a>(keys: &'a PatternKeys, base: Option<&'a Pattern>) -> Vec<Entry<'a>> {
    let given = base.map_or(&[][..], Pattern::panels).iter().map(Panel::name);
    let given: Vec<&str> = given.collect();
    let own = keys.panel.keys().map(String::as_str).filter(|name| !given.contains(name));
    let names = given.iter().copied().chain(own);
    names.map(|name| Entry { name, keys: keys.panel.get(name) }).collect()
}

/// Panel with its name; `None` if it has mistakes.
type Made<'a> = Vec<(&'a str, Option<Panel>)>;

impl Reader<'_> {
    /// Reads the unit of lengths.
    fn read_unit(&mut self, keys: &PatternKeys) {
        let help =
            "\"mm\", \"cm\", \"m\" or \"in\", the unit of all lengths that have none of their own";
        match &keys.length {
            Some(word) => match Unit::parse(word).filter(Unit::is_of_files) {
                Some(unit) => self.metres = unit.metres(),
                None => {
                    let message = format!("\"{}\" is not a unit of patterns", excerpt(word));
                    self.fail("length", message, format!("write {help}"));
                }
            },
            None => self.fail("length", "is missing", format!("add length = {help}")),
        }
    }

    /// Returns the mistakes of a file whose unit is not known.
    fn loose(mut self, keys: &PatternKeys, base: Option<&Pattern>) -> Diagnostics {
        keys.panel.iter().for_each(|(name, keys)| self.check_loose(name, keys));
        let given = base.map_or(&[][..], Pattern::panels).iter().map(Panel::name);
        let names = given.chain(keys.panel.keys().map(String::as_str));
        let known = names.map(|name| (name, None)).collect();
        self.seams(keys, &known);
        self.finish()
    }

    /// Returns the seams of the file, without those that could not be read.
    fn seams(&mut self, keys: &PatternKeys, known: &Known<'_>) -> Vec<Seam> {
        let mut own = keys.seam.clone();
        own.retain(|name, _| !self.faults.cover(&format!("seam.{}", toml_key(name))));
        for (name, seam) in &own {
            self.sketch.add_seam(name, seam.sides.concat());
        }
        seams(&self.place(), &own, known).unwrap_or_else(|more| {
            self.mistakes.extend(more);
            Vec::new()
        })
    }

    /// Returns all mistakes in the order of the text.
    fn finish(self) -> Diagnostics {
        let mut mistakes = self.mistakes;
        mistakes.extend(self.faults.clone().into_mistakes());
        sorted(mistakes)
    }

    /// Returns all panels of the pattern but those that are left out.
    fn all<'e>(&mut self, entries: &[Entry<'e>], base: Option<&Pattern>) -> Made<'e> {
        let mut made: Made<'e> = Vec::new();
        let given =
            |name: &str| base.and_then(|base| base.panels().iter().find(|p| p.name() == name));
        let mut grainless = Vec::new();
        for entry in entries {
            let (name, Some(keys)) = (entry.name, entry.keys) else {
                made.push((entry.name, given(entry.name).cloned()));
                continue;
            };
            let copy = keys.copy_of.is_some();
            if self.is_shapeless(name, keys) {
                self.check_loose(name, keys);
                made.push((name, None));
                continue;
            }
            if keys.omit {
                self.sketch.remove(name);
            }
            if keys.omit || (copy && !keys.has_shape()) {
                continue;
            }
            let panel = match given(name) {
                Some(panel) if !keys.has_shape() => self.changed(panel.clone(), keys),
                None if !keys.has_shape() && base.is_some() => {
                    let known: Vec<&str> = entries.iter().map(|e| e.name).collect();
                    let others = known.iter().copied().filter(|other| *other != name);
                    let similar = closest(name, others.clone());
                    let help = match similar {
                        Some(similar) => format!("did you mean \"{similar}\"?"),
                        None => format!(
                            "the panels are: {}; a new one needs a shape or copy_of",
                            others.collect::<Vec<_>>().join(", ")
                        ),
                    };
                    let free = similar.map(key).filter(|similar| !self.document.has(similar));
                    let edits = free.map(|similar| self.document.renamed(&key(name), &similar));
                    let message = "the other file has no such panel";
                    self.fail_with(&key(name), message, help, edits.unwrap_or_default());
                    None
                }
                _ => {
                    if keys.grain.is_none() {
                        grainless.push(name.to_owned());
                    }
                    self.own(name, keys)
                }
            };
            made.push((name, panel));
        }
        if !grainless.is_empty() {
            self.notes.push(PatternNote::NoGrain { panels: grainless });
        }
        for entry in entries {
            if let Some((keys, of)) =
                entry.keys.and_then(|keys| Some((keys, keys.copy_of.as_ref()?)))
                && !keys.omit
                && !keys.has_shape()
                && !self.is_shapeless(entry.name, keys)
            {
                let panel = self.copy(entry.name, keys, (of, &made));
                made.push((entry.name, panel));
            } else if let Some(keys) = entry.keys
                && keys.copy_of.is_some()
                && keys.has_shape()
            {
                let help = "give either a shape or the panel that it is a copy of";
                self.fail(&format!("{}.copy_of", key(entry.name)), "the panel has a shape", help);
            }
        }
        made
    }

    /// Returns a copy of a panel, by its name among those that are made.
    fn copy(
        &mut self,
        name: &str,
        keys: &PanelKeys,
        (of, made): (&str, &Made<'_>),
    ) -> Option<Panel> {
        let Some((_, panel)) = made.iter().find(|(other, _)| *other == of) else {
            let known = made.iter().map(|(name, _)| *name);
            let similar = closest(of, known.clone()).filter(|similar| *similar != of);
            let help = match similar {
                Some(similar) => format!("did you mean \"{similar}\"?"),
                None => format!(
                    "the panels that can be copied are: {}",
                    known.collect::<Vec<_>>().join(", ")
                ),
            };
            let key = format!("{}.copy_of", key(name));
            let edit =
                similar.and_then(|similar| self.document.edit(&key, Some(&toml_string(similar))));
            let message = format!("there is no panel \"{of}\"");
            self.fail_with(&key, message, help, edit.into_iter().collect());
            return None;
        };
        let panel = panel.clone()?.renamed(name);
        self.changed(if keys.mirrored { panel.mirrored() } else { panel }, keys)
    }

    /// Returns the pattern of the panels and the seams of the file and of the one that it adds to.
    fn pattern(
        mut self,
        keys: &PatternKeys,
        base: Option<&Pattern>,
        panels: &Made<'_>,
    ) -> Result<Pattern, Diagnostics> {
        let known: Known<'_> = panels.iter().map(|(name, panel)| (*name, panel.as_ref())).collect();
        let added = self.seams(keys, &known);
        let given = base.map(|base| self.kept(base, panels)).unwrap_or_default();
        if let Some(base) = base {
            let own =
                |name: &String| keys.panel.get(name).is_none_or(|k| k.grain.is_none() && !k.omit);
            for note in base.reader_notes() {
                match note {
                    PatternNote::NoGrain { panels } => {
                        let panels: Vec<String> = panels.into_iter().filter(own).collect();
                        if !panels.is_empty() {
                            self.notes.push(PatternNote::NoGrain { panels });
                        }
                    }
                    note => self.notes.push(note),
                }
            }
        }
        if !(self.mistakes.is_empty() && self.faults.is_empty()) {
            return Err(self.finish());
        }
        let panels: Vec<Panel> = panels.iter().filter_map(|(_, panel)| panel.clone()).collect();
        if base.is_none() {
            let doubt = Doubt::of_file(&panels, self.metres);
            self.notes.extend(doubt.map(|doubt| doubt.note()));
        }
        match Pattern::new(panels, merged(given, added)) {
            Ok(pattern) => Ok(pattern.with_notes(self.notes)),
            Err(all) => {
                let place = self.place();
                Err(sorted(all.iter().map(|mistake| answer(&place, mistake, &keys.seam)).collect()))
            }
        }
    }

    /// Returns the seams of the other pattern between panels that are not left out.
    fn kept(&mut self, base: &Pattern, panels: &Made<'_>) -> Vec<Seam> {
        let mut seams = Vec::new();
        let mut lost = BTreeSet::new();
        let place = |id: &EdgeId| {
            let panel = &base.panels()[id.panel];
            let edge = &base.edge(*id).name;
            let number = panels.iter().position(|(name, _)| *name == panel.name())?;
            // A panel with another shape, or with edges that were split, may not have it.
            let parts = panels[number].1.as_ref()?.edges_named(edge);
            let parts = parts.into_iter().map(|edge| EdgeId { panel: number, edge });
            Some(parts.collect::<Vec<_>>()).filter(|parts| !parts.is_empty())
        };
        for seam in base.seams() {
            let sides = [0, 1].map(|side| {
                let parts: Option<Vec<Vec<EdgeId>>> = seam.sides[side].iter().map(place).collect();
                // Against the outline, the parts of an edge that darts divide come the other way.
                let turned = |mut parts: Vec<EdgeId>| {
                    if side == 1 && !seam.reversed {
                        parts.reverse();
                    }
                    parts
                };
                Some(parts?.into_iter().flat_map(turned).collect())
            });
            match sides {
                [Some(first), Some(second)] => {
                    seams.push(Seam { sides: [first, second], ..seam.clone() });
                }
                _ => _ = lost.insert(seam.name.clone()),
            }
        }
        if !lost.is_empty() {
            self.notes.push(PatternNote::SeamsLeftOut { seams: lost.into_iter().collect() });
        }
        seams
    }
}

/// Returns the mistakes in the order of the text.
fn sorted(mistakes: Vec<Diagnostic>) -> Diagnostics {
    match Diagnostics::check(mistakes) {
        Err(all) => all,
        Ok(()) => Diagnostics(Vec::new()),
    }
}
