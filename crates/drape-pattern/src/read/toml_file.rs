//! Reader of the project's format, in TOML.
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
//! With `from`, the file adds to a pattern of another format. Its panels change the panels with
//! their names. Its seams are added, or replace the seams with their names. `keys` mirrors the
//! file, `panels` makes the panels and `darts` their darts, [`seams`](super::seams) the seams.

mod darts;
pub(crate) mod keys;
mod panels;

use std::collections::{BTreeMap, BTreeSet};

use drape_input::{
    Diagnostic, Diagnostics, Document, Faults, closest, excerpt, similar_file, toml_key,
    toml_string,
};

use self::keys::{PanelKeys, PatternKeys};
use self::panels::{Reader, key};
use super::request::Request;
use super::seams::{KnownPanels, in_seam_order, merged, seam_diagnostic, seams};
use super::size::Doubt;
use super::unit::Unit;
use crate::note::PatternNote;
use crate::panel::Panel;
use crate::pattern::Pattern;
use crate::pattern::seam::{EdgeId, Seam};
use crate::sketch::Sketch;

/// Pattern of a document in the project's format. It may name another file, which is still to be
/// read.
pub(crate) struct PatternFile<'a> {
    document: &'a Document,
    keys: PatternKeys,
    /// Mistakes of spelling and type.
    faults: Faults,
}

/// Decodes `document`. The pattern reports mistakes of spelling and type.
pub(crate) fn decode(document: &Document) -> Result<PatternFile<'_>, Diagnostics> {
    let (keys, faults) = document.decode_with_faults()?;
    Ok(PatternFile { document, keys, faults })
}

impl PatternFile<'_> {
    /// Returns the request for the file that this file adds to, if it names one.
    ///
    /// # Errors
    /// A mistake of the table `from`; none if its spelling or type is wrong, which is reported
    /// later.
    pub(crate) fn base_request(&self) -> Result<Option<Request>, Diagnostics> {
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
        if !self.document.access().has_file(&path) {
            let message = format!("there is no file {}", path.display());
            let near = similar_file(&path).map(|name| {
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

        let unit = match &from.unit {
            None => None,
            Some(word) => match Unit::parse(word) {
                Some(unit) => Some(unit),
                None => {
                    let message = format!("\"{}\" is not a unit", excerpt(word));
                    return Err(self.document.at("from.unit", message).help(Unit::HELP).into());
                }
            },
        };
        let (size, access) = (from.size.clone(), self.document.access().clone());
        Ok(Some(Request { path, unit, size, from: Some(self.document.clone()), access }))
    }

    /// Removes keys that do not fit `pattern`, whose drawing was changed: panels and edges that it
    /// no longer has, and seams of such edges. Returns the names of these seams.
    pub(crate) fn remove_unknown(&mut self, pattern: &Pattern) -> Vec<String> {
        let panels = pattern.panels();
        let named: BTreeMap<&str, &Panel> =
            panels.iter().map(|panel| (panel.name(), panel)).collect();
        self.keys.panel.retain(|name, keys| {
            let Some(panel) = named.get(name.as_str()) else { return false };
            keys.hems.retain(|edge, _| panel.outline().iter().any(|known| known.name == *edge));
            true
        });

        let words: BTreeSet<String> = panels
            .iter()
            .flat_map(|p| p.edges().map(move |e| format!("{}.{}", p.name(), e.name)))
            .collect();
        let mut removed = Vec::new();
        self.keys.seam.retain(|name, seam| {
            let fits = seam.sides.iter().flatten().all(|word| words.contains(word));
            if !fits {
                removed.push(name.clone());
            }
            fits
        });
        removed
    }

    /// Returns the pattern: panels and seams of this file, and those that it adds to in `base`.
    /// Adds the lines to `sketch`.
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
            return Err(reader.mistakes_without_unit(keys, base.as_ref()));
        }
        let entries = entries(keys, base.as_ref());
        let panels = reader.panels(&entries, base.as_ref());
        reader.pattern(keys, base.as_ref(), &panels)
    }

    /// Returns `mistakes` of the pattern that this file adds to, with the mistakes of this file
    /// that do not depend on it.
    pub(crate) fn without_base(&self, mistakes: Diagnostics) -> Diagnostics {
        let mut sketch = Sketch::default();
        let mut reader = Reader::new(self.document, &self.faults, &mut sketch);
        reader.read_unit(&self.keys);
        reader.mistakes.extend(mistakes.0);
        self.keys.panel.iter().for_each(|(name, keys)| reader.check_without_outline(name, keys));
        reader.finish()
    }
}

/// Panel of the pattern: its name, and its keys if this file has some.
struct Entry<'a> {
    name: &'a str,
    keys: Option<&'a PanelKeys>,
}

/// Returns the panels in their order: panels of `base`, then further panels of `keys`.
fn entries<'a>(keys: &'a PatternKeys, base: Option<&'a Pattern>) -> Vec<Entry<'a>> {
    let mut names: Vec<&str> =
        base.map_or(&[][..], Pattern::panels).iter().map(Panel::name).collect();
    let of_base: BTreeSet<&str> = names.iter().copied().collect();
    names.extend(keys.panel.keys().map(String::as_str).filter(|name| !of_base.contains(name)));
    names.into_iter().map(|name| Entry { name, keys: keys.panel.get(name) }).collect()
}

/// Panels with their names; `None` for a panel with mistakes.
type NamedPanels<'a> = Vec<(&'a str, Option<Panel>)>;

impl Reader<'_> {
    /// Reads the unit of lengths.
    fn read_unit(&mut self, keys: &PatternKeys) {
        let help =
            "\"mm\", \"cm\", \"m\" or \"in\", the unit of all lengths that have none of their own";
        match &keys.length {
            Some(word) => match Unit::parse(word).filter(Unit::measures_cloth) {
                Some(unit) => self.metres = unit.metres(),
                None => {
                    let message = format!("\"{}\" is not a unit of patterns", excerpt(word));
                    self.fail("length", message, format!("write {help}"));
                }
            },
            None => self.fail("length", "is missing", format!("add length = {help}")),
        }
    }

    /// Returns the mistakes of a file whose unit is not known, which adds to `base`.
    fn mistakes_without_unit(mut self, keys: &PatternKeys, base: Option<&Pattern>) -> Diagnostics {
        keys.panel.iter().for_each(|(name, keys)| self.check_without_outline(name, keys));
        let base_names = base.map_or(&[][..], Pattern::panels).iter().map(Panel::name);
        let names = base_names.chain(keys.panel.keys().map(String::as_str));
        let known = names.map(|name| (name, None)).collect();
        self.seams(keys, &known);
        self.finish()
    }

    /// Returns the seams of `keys`; none if one has a mistake. Seams whose keys could not be
    /// decoded are left out.
    fn seams(&mut self, keys: &PatternKeys, known: &KnownPanels<'_>) -> Vec<Seam> {
        let mut decoded = keys.seam.clone();
        decoded.retain(|name, _| !self.faults.cover(&format!("seam.{}", toml_key(name))));
        for (name, seam) in &decoded {
            self.sketch.add_seam(name, seam.sides.concat());
        }
        match seams(&self.table(), &decoded, known) {
            Ok(seams) => seams,
            Err(mistakes) => {
                self.mistakes.extend(mistakes);
                Vec::new()
            }
        }
    }

    /// Returns all mistakes in the order of the text.
    fn finish(self) -> Diagnostics {
        let mut mistakes = self.mistakes;
        mistakes.extend(self.faults.clone().into_mistakes());
        sorted(mistakes)
    }

    /// Returns the panels of `entries`, without panels that are left out.
    fn panels<'e>(&mut self, entries: &[Entry<'e>], base: Option<&Pattern>) -> NamedPanels<'e> {
        let mut panels: NamedPanels<'e> = Vec::new();
        let mut grainless = Vec::new();
        for entry in entries {
            let name = entry.name;
            let base_panel =
                base.and_then(|base| base.panels().iter().find(|panel| panel.name() == name));
            let Some(keys) = entry.keys else {
                panels.push((name, base_panel.cloned()));
                continue;
            };
            if self.is_shapeless(name, keys) {
                self.check_without_outline(name, keys);
                panels.push((name, None));
                continue;
            }
            if keys.omit {
                self.sketch.remove(name);
            }
            let is_copy = keys.copy_of.is_some() && !keys.has_shape();
            if keys.omit || is_copy {
                continue;
            }

            let panel = match base_panel {
                Some(panel) if !keys.has_shape() => self.changed(panel.clone(), keys),
                None if !keys.has_shape() && base.is_some() => {
                    let known: Vec<&str> = entries.iter().map(|e| e.name).collect();
                    self.fail_unknown_panel(name, &known);
                    None
                }
                _ => {
                    if keys.grain.is_none() {
                        grainless.push(name.to_owned());
                    }
                    self.shaped(name, keys)
                }
            };
            panels.push((name, panel));
        }
        if !grainless.is_empty() {
            self.notes.push(PatternNote::NoGrain { panels: grainless });
        }

        self.add_copies(entries, &mut panels);
        panels
    }

    /// Adds the mistake that the base has no panel `name`, for which this file gives no shape.
    /// `known` are the names of all panels.
    fn fail_unknown_panel(&mut self, name: &str, known: &[&str]) {
        let others = known.iter().copied().filter(|other| *other != name);
        let similar = closest(name, others.clone());
        let help = match similar {
            Some(similar) => format!("did you mean \"{similar}\"?"),
            None => format!(
                "the panels are: {}; a new one needs a shape or copy_of",
                others.collect::<Vec<_>>().join(", ")
            ),
        };
        // A key that exists cannot be the new name of another key.
        let free = similar.map(key).filter(|similar| !self.document.has(similar));
        let edits = free.map(|similar| self.document.renamed(&key(name), &similar));
        let message = "the other file has no such panel";
        self.fail_with(&key(name), message, help, edits.unwrap_or_default());
    }

    /// Adds the panels of `entries` that are copies to `panels`, in which they may name any panel
    /// before them.
    fn add_copies<'e>(&mut self, entries: &[Entry<'e>], panels: &mut NamedPanels<'e>) {
        for entry in entries {
            let Some(keys) = entry.keys else { continue };
            let Some(source) = &keys.copy_of else { continue };
            if keys.has_shape() {
                let help = "give either a shape or the panel that it is a copy of";
                self.fail(&format!("{}.copy_of", key(entry.name)), "the panel has a shape", help);
            } else if !keys.omit && !self.is_shapeless(entry.name, keys) {
                let panel = self.copy(entry.name, keys, (source, panels));
                panels.push((entry.name, panel));
            }
        }
    }

    /// Returns the panel `name` as a copy of the panel `source`, one of `panels`.
    fn copy(
        &mut self,
        name: &str,
        keys: &PanelKeys,
        (source, panels): (&str, &NamedPanels<'_>),
    ) -> Option<Panel> {
        let Some((_, panel)) = panels.iter().find(|(known, _)| *known == source) else {
            let known = panels.iter().map(|(name, _)| *name);
            let similar = closest(source, known.clone()).filter(|similar| *similar != source);
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
            let message = format!("there is no panel \"{source}\"");
            self.fail_with(&key, message, help, edit.into_iter().collect());
            return None;
        };
        let panel = panel.clone()?.renamed(name);
        self.changed(if keys.mirrored { panel.mirrored() } else { panel }, keys)
    }

    /// Returns the pattern of `panels`, with the seams of this file and of `base`.
    fn pattern(
        mut self,
        keys: &PatternKeys,
        base: Option<&Pattern>,
        panels: &NamedPanels<'_>,
    ) -> Result<Pattern, Diagnostics> {
        let known: KnownPanels<'_> =
            panels.iter().map(|(name, panel)| (*name, panel.as_ref())).collect();
        let added = self.seams(keys, &known);
        let base_seams = base.map(|base| self.base_seams(base, panels)).unwrap_or_default();
        if let Some(base) = base {
            self.add_base_notes(base, keys);
        }
        if !(self.mistakes.is_empty() && self.faults.is_empty()) {
            return Err(self.finish());
        }

        let panels: Vec<Panel> = panels.iter().filter_map(|(_, panel)| panel.clone()).collect();
        if base.is_none() {
            let doubt = Doubt::for_file(&panels, self.metres);
            self.notes.extend(doubt.map(|doubt| doubt.note()));
        }
        match Pattern::new(panels, merged(base_seams, added)) {
            Ok(pattern) => Ok(pattern.with_notes(self.notes)),
            Err(all) => {
                let table = self.table();
                let mistakes = all.iter().map(|m| seam_diagnostic(&table, m, &keys.seam));
                Err(sorted(mistakes.collect()))
            }
        }
    }

    /// Adds the notes of `base`. A panel whose grain `keys` give has no note on a missing grain.
    fn add_base_notes(&mut self, base: &Pattern, keys: &PatternKeys) {
        for note in base.file_notes() {
            match note {
                PatternNote::NoGrain { mut panels } => {
                    panels.retain(|name| {
                        keys.panel.get(name).is_none_or(|k| k.grain.is_none() && !k.omit)
                    });
                    if !panels.is_empty() {
                        self.notes.push(PatternNote::NoGrain { panels });
                    }
                }
                note => self.notes.push(note),
            }
        }
    }

    /// Returns the seams of `base` whose edges `panels` still have. Adds a note on the others.
    fn base_seams(&mut self, base: &Pattern, panels: &NamedPanels<'_>) -> Vec<Seam> {
        let mut seams = Vec::new();
        let mut lost = BTreeSet::new();
        for seam in base.seams() {
            let sides = [0, 1].map(|side| {
                let mut ids = Vec::new();
                for &id in &seam.sides[side] {
                    let parts = edge_in(panels, base, id)?;
                    ids.extend(in_seam_order(parts, side, seam.reversed));
                }
                Some(ids)
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

/// Returns the edges of `panels` that are the edge `id` of `base`: the edge itself, or its parts.
/// Returns `None` if the panel has mistakes, is left out or has no such edge.
fn edge_in(panels: &NamedPanels<'_>, base: &Pattern, id: EdgeId) -> Option<Vec<EdgeId>> {
    let panel_name = base.panels()[id.panel].name();
    let panel = panels.iter().position(|(name, _)| *name == panel_name)?;
    // A panel with another shape, or with edges that were split, may not have it.
    let edges = panels[panel].1.as_ref()?.edges_named(&base.edge(id).name);
    let parts: Vec<EdgeId> = edges.into_iter().map(|edge| EdgeId { panel, edge }).collect();
    (!parts.is_empty()).then_some(parts)
}

/// Returns `mistakes` in the order of the text.
fn sorted(mistakes: Vec<Diagnostic>) -> Diagnostics {
    match Diagnostics::check(mistakes) {
        Err(all) => all,
        Ok(()) => Diagnostics(Vec::new()),
    }
}
