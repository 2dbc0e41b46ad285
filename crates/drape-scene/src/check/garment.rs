//! Garments of a scene: patterns that are cut at the spacing, with each panel at its place.

mod allowances;
pub(crate) mod cost;
pub(crate) mod distance;
mod layer;
mod placed_panel;
mod seam_order;
pub(crate) mod sewing;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;

use drape_cloth::Tie;
use drape_input::{Diagnostic, Diagnostics, Document, excerpt, figure_below, toml_key};
use drape_pattern::{CutPattern, Cutter, EdgeId, Error, NodeId, Pattern, PatternTable, Request};

use crate::check::checker::{Checker, UnknownName};
use crate::check::fabrics::check_thickness;
use crate::check::panel::PlacedPanel;
use crate::check::panel::noise::Noise;
use crate::grading::Grading;
use crate::scene::material::Material;
use crate::scene::seam::{Seam, SeamPairs};
use crate::spec::file_or::FileOr;
use crate::spec::garment::GarmentSpec;

use self::allowances::allowances;
use self::layer::check_layer;
use self::placed_panel::{Piece, placed_panel};
use self::seam_order::{PlacedSeam, SeamHome};

/// Largest height at which a garment is measured, in m.
const HEIGHT_MAX: f64 = 10.0;

/// Garment as its panels and its seams.
pub(crate) struct CutGarment {
    /// Name, or the name of the file of the pattern.
    pub(crate) name: String,
    pub(crate) panels: Vec<PlacedPanel>,
    pub(crate) seams: Vec<Seam>,
    /// Notes on its pattern.
    pub(crate) notes: Vec<String>,
    /// Heights at which it is measured, in m, by their names.
    pub(crate) measured_heights: BTreeMap<String, f64>,
}

impl CutGarment {
    /// Its particles in the scene, if it has some.
    pub(crate) fn particles(&self) -> Option<Range<usize>> {
        let [first, last] = [self.panels.first()?, self.panels.last()?];
        Some(first.panel.first..last.panel.first + last.positions.len() / 3)
    }
}

/// Checks the garments of a scene, whose particles are numbered from `first` on.
pub(crate) fn garments(
    checker: &mut Checker<'_>,
    materials: &[Option<Material>],
    first: usize,
    grading: Option<&Grading>,
) -> Vec<CutGarment> {
    let spec = checker.spec;
    let mut first = first;
    let mut garments = Vec::new();
    for (index, entry) in spec.garment.iter().enumerate() {
        let key = format!("garment[{index}]");
        let named = format!("{key}.pattern");
        let pattern = match &entry.pattern {
            FileOr::Value(pattern) => Some(Pattern::clone(pattern)),
            FileOr::File(name) => {
                let path = checker.locate(&named, name);
                path.and_then(|path| pattern(checker, (&named, name), &path))
            }
        };
        let Some(pattern) = pattern else { continue };
        let Some(pattern) = changed(checker, &key, entry, pattern) else { continue };
        let uncut = UncutPattern { pattern: &pattern, first, grading };
        let Some(garment) = cut(checker, &key, entry, uncut) else { continue };
        for placed in &garment.panels {
            if let Some(Some(material)) = materials.get(placed.panel.material) {
                check_thickness(checker, &key, &placed.panel.lattice, material);
            }
        }
        first += garment.panels.iter().map(|placed| placed.positions.len() / 3).sum::<usize>();
        if first > checker.particles_max {
            let message = format!(
                "the scene has {first} particles with it, and there is memory for {}",
                checker.particles_max
            );
            checker.fail(&format!("{key}.pattern"), message, "write a larger spacing");
        }
        garments.push(garment);
    }
    let seams = garments.iter().flat_map(|garment| &garment.seams);
    let known: Vec<&str> = seams.map(|seam| seam.name.as_str()).collect();
    let names: BTreeSet<&str> = known.iter().copied().collect();
    for (index, name) in spec.sew.twisted.iter().enumerate() {
        if !names.contains(name.as_str()) {
            let unknown = UnknownName { name, known: &known, kind: "seams" };
            let key = format!("sew.twisted[{index}]");
            checker.unknown(&key, format!("there is no seam \"{name}\""), unknown);
        }
    }
    garments
}

/// Reads the pattern of a garment, which a key names.
fn pattern(checker: &mut Checker<'_>, (key, name): (&str, &str), path: &Path) -> Option<Pattern> {
    let given = checker.given(path);
    if given.is_none() && !checker.document().access().has_file(path) {
        checker.no_file(key, name, path);
        return None;
    }
    let read = match given {
        Some(document) => Pattern::parse(document).map_err(Error::from),
        None => {
            let access = checker.document().access().clone();
            Pattern::read_as(&Request { access, ..Request::new(path) })
        }
    };
    match read {
        Ok(pattern) => Some(pattern),
        Err(Error::Input(mistakes)) => {
            checker.extend(mistakes);
            None
        }
        Err(error) => {
            checker.extend(Diagnostics::from(Diagnostic::new(path, error.to_string())));
            None
        }
    }
}

/// Returns a pattern with the grain and the seams that a scene gives it.
fn changed(
    checker: &mut Checker<'_>,
    key: &str,
    entry: &GarmentSpec,
    pattern: Pattern,
) -> Option<Pattern> {
    let mut pattern = pattern;
    for number in 0..pattern.panels().len() {
        let name = pattern.panels()[number].name().to_owned();
        let Some(grain) = entry.panel.get(&name).and_then(|panel| panel.grain) else { continue };
        let key = format!("{key}.panel.{}.grain", toml_key(&name));
        if checker.is_sound(&key) {
            pattern = pattern.with_grain(number, grain.to_radians()).ok()?;
        }
    }
    if entry.seam.is_empty() {
        return Some(pattern);
    }
    if !checker.is_sound(&format!("{key}.seam")) {
        return None;
    }
    let prefix = format!("{key}.");
    let place = PatternTable { document: checker.document(), prefix: &prefix, unit: 1.0 };
    let seams = entry.seam.iter().map(|(name, seam)| (name.clone(), seam.keys()));
    match pattern.with_seams(&seams.collect(), &place) {
        Ok(pattern) => Some(pattern),
        Err(mistakes) => {
            checker.extend(mistakes);
            None
        }
    }
}

/// Pattern whose particles are numbered from a number on.
struct UncutPattern<'a> {
    pattern: &'a Pattern,
    first: usize,
    grading: Option<&'a Grading>,
}

/// Cuts a pattern at the spacing of a garment and puts each panel at its place.
fn cut(
    checker: &mut Checker<'_>,
    key: &str,
    entry: &GarmentSpec,
    uncut: UncutPattern<'_>,
) -> Option<CutGarment> {
    let UncutPattern { pattern, first, grading } = uncut;
    let known: Vec<&str> = pattern.panels().iter().map(drape_pattern::Panel::name).collect();
    let names: BTreeSet<&str> = known.iter().copied().collect();
    for name in entry.panel.keys().filter(|name| !names.contains(name.as_str())) {
        let message = format!("the pattern has no panel \"{}\"", excerpt(name));
        let unknown = UnknownName { name, known: &known, kind: "panels of the pattern" };
        checker.unknown(&format!("{key}.panel.{}", toml_key(name)), message, unknown);
    }
    if !checker.is_sound(&format!("{key}.spacing")) || !checker.is_sound("spacing") {
        return None;
    }
    let spacing = entry.spacing.unwrap_or(checker.spec.spacing);
    let spacing_key = match entry.spacing {
        Some(_) => format!("{key}.spacing"),
        None => "spacing".into(),
    };
    let cut = pieces(checker, (key, &spacing_key), Cutter::new(spacing).cut(pattern))?;
    let layer = check_layer(checker, &format!("{key}.layer"), entry.layer);
    let mut noise = entry.noise.as_ref().map(Noise::new);
    let allowances = allowances(pattern, &cut);
    let (mut pieces, mut next) = (Vec::new(), first);
    for (index, panel) in cut.panels.iter().enumerate() {
        let allowances = &allowances[index];
        let piece =
            Piece { key, entry, pattern, cut: &cut, allowances, index, first: next, grading };
        let placed = placed_panel(checker, &piece, layer, &mut noise);
        next += placed
            .as_ref()
            .map_or(panel.positions.len(), |placed| placed.panel.positions.len() / 3);
        pieces.extend(placed);
    }
    if pieces.len() < known.len() {
        return None;
    }
    check_seam_order(checker, (key, entry), pattern, |EdgeId { panel, edge }| {
        let nodes = cut.panels[panel].edges[edge].iter();
        nodes.map(|&node| pieces[panel].position(node)).collect()
    });
    let node = |id: NodeId| pieces[id.panel].particle(id.node);
    let seams = pattern.seams().iter().zip(&cut.seams).map(|(seam, nodes)| {
        let tie = |tie: &drape_pattern::Tie| Tie {
            particle: node(tie.node),
            ends: nodes.ends(tie).map(node),
            fraction: tie.fraction,
        };
        let pairs = nodes.pairs.iter().map(|pair| pair.map(node)).collect();
        let pairs = SeamPairs { pairs, ties: nodes.ties.iter().map(tie).collect() };
        let (name, breaks) = (seam.name.clone(), nodes.breaks.clone());
        Seam { name, rest_angle: seam.angle, pairs, breaks }
    });
    let notes = pattern.notes().iter().chain(&cut.notes).map(ToString::to_string).collect();
    let name = match &entry.name {
        Some(name) => name.clone(),
        None => {
            let file = entry.pattern.file().unwrap_or("garment");
            let name = Path::new(file).file_stem().unwrap_or_default();
            name.to_string_lossy().into_owned()
        }
    };
    let seams = seams.collect();
    let panels = pieces.into_iter().map(|piece| piece.panel).collect();
    let measured_heights = measured_heights(checker, key, entry);
    Some(CutGarment { name, panels, seams, notes, measured_heights })
}

/// Returns the heights at which a garment is measured, in m, by their names.
fn measured_heights(
    checker: &mut Checker<'_>,
    key: &str,
    entry: &GarmentSpec,
) -> BTreeMap<String, f64> {
    let help = "the height above y = 0, in the file's unit, or with a unit: \"1080 mm\"";
    for (name, height) in &entry.measure {
        let key = format!("{key}.measure.{}", toml_key(name));
        checker.within(&key, *height, -HEIGHT_MAX..=HEIGHT_MAX, help);
    }
    entry.measure.clone()
}

/// Checks the order and the sense of the seams of a garment, whose edges have their places from a
/// function.
fn check_seam_order(
    checker: &mut Checker<'_>,
    (key, entry): (&str, &GarmentSpec),
    pattern: &Pattern,
    places: impl Fn(EdgeId) -> Vec<[f64; 3]>,
) {
    let meant: BTreeSet<&String> = checker.spec.sew.twisted.iter().collect();
    let twisted = pattern.seams().iter().filter(|seam| !meant.contains(&seam.name));
    let file = entry.pattern.file().map(|name| checker.folder.join(name)).map(|path| {
        let given = checker.given(&path).cloned();
        given
            .or_else(|| Document::read_with(&path, checker.document().access()).ok())
            .unwrap_or_else(|| Document::new(&path, ""))
    });
    let of_pattern = file.as_ref().filter(|file| !Pattern::is_drawing_text(file));
    let of_pattern = of_pattern.map(|document| SeamHome { document, key: "seam".into() });
    let of_scene = SeamHome { document: checker.document(), key: format!("{key}.seam") };
    let mistake = |seam: &drape_pattern::Seam| {
        let of_pattern = of_pattern.as_ref().filter(|_| !entry.seam.contains_key(&seam.name));
        let home = of_pattern.unwrap_or(&of_scene);
        PlacedSeam::new(pattern, seam, &places).mistake(home)
    };
    let mistakes: Vec<Diagnostic> = twisted.filter_map(mistake).collect();
    checker.extend_late(mistakes);
}

/// Takes the cut of a pattern, or its mistakes.
fn pieces(
    checker: &mut Checker<'_>,
    (key, spacing_key): (&str, &str),
    cut: Result<CutPattern, Error>,
) -> Option<CutPattern> {
    let key = format!("{key}.pattern");
    match cut {
        Ok(cut) => return Some(cut),
        Err(Error::Pattern(mistakes)) => {
            for mistake in mistakes {
                let index = checker.fail(&key, mistake.to_string(), mistake.help());
                mistake.subject().into_iter().for_each(|subject| checker.about(index, subject));
                if let Some(spacing) = mistake.most_spacing() {
                    let spacing = format!("\"{} mm\"", figure_below(1e3 * spacing));
                    checker.remedy(index, spacing_key, Some(&spacing));
                }
            }
        }
        Err(error) => {
            checker.fail(&key, error.to_string(), "correct the pattern");
        }
    }
    None
}
