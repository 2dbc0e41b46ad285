//! Garments of a scene: patterns that are cut at the spacing, with each panel at its place.

mod allowances;
pub(crate) mod cost;
pub(crate) mod distance;
mod layer;
mod placed_panel;
mod seam_order;
pub(crate) mod sewing;

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

use drape_cloth::Tie;
use drape_input::{Diagnostic, Diagnostics, Document, excerpt, figure_below, toml_key};
use drape_pattern::{CutPattern, Cutter, EdgeId, Error, NodeId, Pattern, PatternTable};

use crate::check::checker::{Checker, UnknownName};
use crate::check::fabrics::check_thickness;
use crate::check::panel::noise::noise;
use crate::check::panel::{PlacedPanel, SPACING, check_spacing};
use crate::file::garment::GarmentFile;
use crate::grading::Grading;
use crate::scene::material::Material;
use crate::scene::seam::{Seam, SeamPairs};

use self::layer::layer;
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
    let file = checker.file;
    let mut first = first;
    let mut garments = Vec::new();
    for (index, entry) in file.garment.iter().enumerate() {
        let key = format!("garment[{index}]");
        let named = format!("{key}.pattern");
        let Some(path) = checker.locate(&named, &entry.pattern) else { continue };
        let Some(pattern) = pattern(checker, (&named, &entry.pattern), &path) else { continue };
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
    for (index, name) in file.sew.twisted.iter().enumerate() {
        if !known.contains(&name.as_str()) {
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
    if given.is_none() && !path.exists() {
        checker.no_file(key, name, path);
        return None;
    }
    let read = match given {
        Some(document) => Pattern::parse(document).map_err(Error::from),
        None => Pattern::read(path),
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
    entry: &GarmentFile,
    pattern: Pattern,
) -> Option<Pattern> {
    let mut pattern = pattern;
    for number in 0..pattern.panels().len() {
        let name = pattern.panels()[number].name().to_owned();
        let Some(grain) = entry.panel.get(&name).and_then(|panel| panel.grain) else { continue };
        let key = format!("{key}.panel.{}.grain", toml_key(&name));
        let help = "degrees from the panel's y axis to its warp, anticlockwise";
        let grain = grain.value();
        if checker.within(&key, grain, -180.0..=180.0, help) {
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
    let place = PatternTable { document: checker.document(), prefix: &prefix, unit: checker.unit };
    match pattern.with_seams(&entry.seam, &place) {
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
    entry: &GarmentFile,
    uncut: UncutPattern<'_>,
) -> Option<CutGarment> {
    let UncutPattern { pattern, first, grading } = uncut;
    let unit = checker.unit;
    let known: Vec<&str> = pattern.panels().iter().map(drape_pattern::Panel::name).collect();
    for name in entry.panel.keys().filter(|name| !known.contains(&name.as_str())) {
        let message = format!("the pattern has no panel \"{}\"", excerpt(name));
        let unknown = UnknownName { name, known: &known, kind: "panels of the pattern" };
        checker.unknown(&format!("{key}.panel.{}", toml_key(name)), message, unknown);
    }
    let sound = check_spacing(checker, &format!("{key}.spacing"), entry.spacing);
    if !sound || !checker.is_sound("spacing") {
        return None;
    }
    let spacing = entry.spacing.or(checker.file.spacing).map_or(SPACING, |s| s * unit);
    let spacing_key = match entry.spacing {
        Some(_) => format!("{key}.spacing"),
        None => "spacing".into(),
    };
    let cut = pieces(checker, (key, &spacing_key), Cutter::new(spacing).cut(pattern))?;
    let layer = layer(checker, &format!("{key}.layer"), entry.layer).unwrap_or(0);
    let mut noise = noise(checker, &format!("{key}.noise"), entry.noise.as_ref());
    let (mut pieces, mut next) = (Vec::new(), first);
    for (index, panel) in cut.panels.iter().enumerate() {
        let piece = Piece { key, entry, pattern, cut: &cut, index, first: next, grading };
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
            let name = Path::new(&entry.pattern).file_stem().unwrap_or_default();
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
    entry: &GarmentFile,
) -> BTreeMap<String, f64> {
    let unit = checker.unit;
    let heights = entry.measure.iter().map(|(name, height)| (name.clone(), *height * unit));
    let heights: BTreeMap<String, f64> = heights.collect();
    let help = "the height above y = 0, in the file's unit, or with a unit: \"1080 mm\"";
    for (name, height) in &heights {
        let key = format!("{key}.measure.{}", toml_key(name));
        checker.within(&key, height / unit, -HEIGHT_MAX / unit..=HEIGHT_MAX / unit, help);
    }
    heights
}

/// Checks the order and the sense of the seams of a garment, whose edges have their places from a
/// function.
fn check_seam_order(
    checker: &mut Checker<'_>,
    (key, entry): (&str, &GarmentFile),
    pattern: &Pattern,
    places: impl Fn(EdgeId) -> Vec<[f64; 3]>,
) {
    let path = checker.folder.join(&entry.pattern);
    let meant = &checker.file.sew.twisted;
    let twisted = pattern.seams().iter().filter(|seam| !meant.contains(&seam.name));
    let file = match checker.given(&path) {
        Some(document) => document.clone(),
        None => Document::read(&path).unwrap_or_else(|_| Document::new(&path, "")),
    };
    let of_pattern = SeamHome { document: &file, key: "seam".into() };
    let of_scene = SeamHome { document: checker.document(), key: format!("{key}.seam") };
    let is_toml = !Pattern::is_drawing_text(&file);
    let mistake = |seam: &drape_pattern::Seam| {
        let is_own = is_toml && !entry.seam.contains_key(&seam.name);
        let home = if is_own { &of_pattern } else { &of_scene };
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
                let index = checker.fail(&key, mistake.to_string(), &mistake.help());
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
