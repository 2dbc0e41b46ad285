//! Panels of a scene that it describes itself: rectangles and discs.

pub(crate) mod cut_lattice;
mod disc;
pub(crate) mod folds;
pub(crate) mod graded;
pub(crate) mod noise;
mod placement;

use std::collections::BTreeSet;

use drape_cloth::{Grain, Lattice};
use drape_input::{Subject, excerpt, figure, figure_below, tidy};

use crate::check::checker::Checker;
use crate::check::fabrics::{check_thickness, material_index};
use crate::check::memory::PARTICLES_MAX;
use crate::grading::Grading;
use crate::scene::material::Material;
use crate::scene::panel::Panel;
use crate::spec::panel::{FoldSpec, PanelSpec};

use self::folds::{FoldLine, UnfoldedPanel, folded};
use self::graded::graded;
use self::placement::Placement;

/// Largest speed of cloth at the start, in m/s: a tenth of the speed of a bullet. Steps are not
/// smaller at this speed.
const SPEED_MAX: f64 = 100.0;

/// Panel at its place.
pub(crate) struct PlacedPanel {
    pub(crate) panel: Panel,
    /// Positions of its particles, three numbers each, in m.
    pub(crate) positions: Vec<f64>,
    /// Their velocities, in m/s.
    pub(crate) velocities: Vec<f64>,
}

/// Checks the panels of a scene.
pub(crate) fn panels(
    checker: &mut Checker<'_>,
    materials: &[Option<Material>],
    grading: Option<&Grading>,
) -> Vec<PlacedPanel> {
    let spec = checker.spec;
    if spec.panel.is_empty() && spec.garment.is_empty() {
        let help =
            "add [[panel]] with name, fabric and rectangle or disc, or [[garment]] with a pattern";
        checker.fail_file("the scene has no panel", help);
    }
    let mut panels: Vec<PlacedPanel> = Vec::new();
    let mut first = 0;
    let names: Vec<&str> = spec.panel.iter().map(|panel| panel.name.as_str()).collect();
    let mut known = BTreeSet::new();
    for (index, entry) in spec.panel.iter().enumerate() {
        let key = format!("panel[{index}]");
        if !known.insert(names[index]) {
            let message = format!("there are two panels \"{}\"", excerpt(&entry.name));
            checker.fail(&format!("{key}.name"), message, "give each its own name");
        }
        let material = material_index(checker, &format!("{key}.fabric"), &entry.fabric);
        let lattice = lattice(checker, &key, entry, first);
        let lattice = lattice.and_then(|lattice| fold(checker, &key, entry, lattice));
        let lattice = match grading {
            Some(grading) => lattice
                .and_then(|lattice| graded(checker, &entry.name, &lattice, grading))
                .map(|graded| graded.lattice),
            None => lattice,
        };
        let placement = Placement::check(checker, &key, entry);
        let (Some(material), Some(lattice)) = (material, lattice) else { continue };
        if let Some(Some(material)) = materials.get(material) {
            check_thickness(checker, &key, &lattice, material);
        }
        let particles = lattice.coordinates().len();
        for copy in 0..copies(checker, &key, entry, particles) {
            let name = match copy {
                0 => entry.name.clone(),
                _ => format!("{} {}", entry.name, copy + 1),
            };
            let lattice = lattice.clone();
            let placement = placement.copied(copy, entry.stack.as_ref());
            let positions = placement.positions(&lattice);
            let velocities = placement.velocities(&positions);
            if copy == 0 {
                check_speed(checker, &key, entry, &velocities);
            }
            let edges = Vec::new();
            let panel = Panel { name, material, lattice, first, edges, layer: 0 };
            panels.push(PlacedPanel { panel, positions, velocities });
            first += particles;
        }
    }
    panels
}

/// Folds a panel along its lines.
fn fold(
    checker: &mut Checker<'_>,
    key: &str,
    entry: &PanelSpec,
    lattice: Lattice,
) -> Option<Lattice> {
    let lines = entry.fold.iter().map(|fold: &FoldSpec| FoldLine {
        ends: [fold.from, fold.to],
        angle: fold.angle.to_radians(),
    });
    folded(checker, &format!("{key}.fold"), &entry.name, UnfoldedPanel { lattice, lines })
}

/// Checks the number of panels that an entry stands for.
fn copies(checker: &mut Checker<'_>, key: &str, entry: &PanelSpec, particles: usize) -> usize {
    let Some(stack) = &entry.stack else { return 1 };
    let limit = checker.particles_max;
    let most = (limit / particles.max(1)).max(1);
    if (1..=most).contains(&stack.count) {
        return stack.count;
    }
    let message = format!("{} panels of {particles} particles", stack.count);
    let help = format!("from 1 panel to {most}, for {limit} particles in all");
    checker.fail(&format!("{key}.stack.count"), message, &help);
    1
}

/// Checks that no particle of a panel begins faster than cloth moves.
fn check_speed(checker: &mut Checker<'_>, key: &str, entry: &PanelSpec, velocities: &[f64]) {
    let (velocities, _) = velocities.as_chunks::<3>();
    let square = velocities.iter().map(|v| v.iter().map(|x| x * x).sum::<f64>());
    let speed = square.fold(0.0, f64::max).sqrt();
    if speed > SPEED_MAX {
        let spins = entry.velocity.iter().all(|v| *v == 0.0);
        let key = format!("{key}.{}", if spins { "spin" } else { "velocity" });
        let message = format!("the panel begins with up to {} m/s", figure(speed.round()));
        let help = "cloth moves at up to 100 m/s; spin is in degrees per second";
        checker.fail(&key, message, help);
    }
}

/// Makes the particles of a panel before it is deformed. They come after the particles made before.
fn lattice(
    checker: &mut Checker<'_>,
    key: &str,
    entry: &PanelSpec,
    before: usize,
) -> Option<Lattice> {
    let has_spacing = entry.spacing.is_some();
    let spacing_key = if has_spacing { format!("{key}.spacing") } else { "spacing".into() };
    if !checker.is_sound(&format!("{key}.spacing")) || !checker.is_sound("spacing") {
        return None;
    }
    let spacing = entry.spacing.unwrap_or(checker.spec.spacing);
    let (shape, sides) = match (entry.rectangle, entry.disc) {
        (Some(size), _) => ("rectangle", size),
        (None, Some(disc)) => ("disc", [disc; 2]),
        (None, None) => ("rectangle", [1.0; 2]),
    };
    if !checker.is_sound(&format!("{key}.{shape}")) {
        return None;
    }
    let count: f64 = sides.iter().map(|side| side / spacing + 1.0).product();
    let limit = checker.particles_max as f64;
    if before as f64 + count > limit {
        let message = format!(
            "a spacing of {} m makes {:.1e} particles with panel \"{}\", more than {:.0e}{}",
            figure(spacing),
            before as f64 + count,
            excerpt(&entry.name),
            limit,
            if limit < PARTICLES_MAX as f64 { ", for which there is memory" } else { "" }
        );
        let least = (sides[0] * sides[1] / (0.9 * (limit - before as f64))).sqrt();
        let help = if least.is_finite() {
            format!("write spacing = \"{:.2} mm\" or more; is the unit right?", 1e3 * least)
        } else {
            "give the panels before it a larger spacing".into()
        };
        let mistake = checker.fail(&spacing_key, message, &help);
        checker.about(mistake, Subject::Panel(entry.name.clone()));
        return None;
    }
    let grid = entry.grid.unwrap_or_default();
    let grain = grain(checker, key, entry)?;
    let lattice = match (entry.rectangle, entry.disc, entry.hole) {
        (Some(size), None, None) => Lattice::rectangle_at(grain, grid, size, spacing),
        (None, Some(diameter), hole) => {
            let round = match hole {
                None => {
                    let rimmed = has_rim(checker, entry);
                    let rimmed = rimmed.then(|| disc::disc(0.5 * diameter, spacing)).flatten();
                    rimmed.map_or_else(|| Lattice::disc_on(grid, 0.5 * diameter, spacing), Ok)
                }
                Some(hole) => Lattice::ring_on(grid, [0.5 * hole, 0.5 * diameter], spacing),
            };
            round.map(|round| round.with_grain(grain))
        }
        (Some(_), None, Some(_)) => {
            let message = format!("panel \"{}\" has a hole in a rectangle", entry.name);
            checker.fail(&format!("{key}.hole"), message, "a hole is in the middle of a disc");
            return None;
        }
        _ => {
            let help = "give one of rectangle = [width, height] and disc = diameter";
            checker.fail(key, format!("panel \"{}\" has no single shape", entry.name), help);
            return None;
        }
    };
    let place = match &lattice {
        Err(drape_cloth::Error::Spacing { .. } | drape_cloth::Error::TooMany { .. }) => spacing_key,
        _ if entry.disc.is_some() => format!("{key}.disc"),
        _ => format!("{key}.rectangle"),
    };
    let report = |error: drape_cloth::Error| {
        let unit = "lengths are in the file's unit, set by length = \"m\", \"cm\" or \"mm\"";
        let (error, help, meant) = match error {
            drape_cloth::Error::Spacing { spacing, size } => (
                format!(
                    "a spacing of {} m leaves fewer than 3 particles across {} m",
                    figure(spacing),
                    figure(size)
                ),
                format!("{}{unit}", spacing_help(spacing, size)),
                Some(format!("\"{} mm\"", figure_below(500.0 * size))),
            ),
            error => (tidy(&error.to_string()), unit.to_owned(), None),
        };
        let message = format!("panel \"{}\": {error}", excerpt(&entry.name));
        let mistake = checker.fail(&place, message, &help);
        checker.about(mistake, Subject::Panel(entry.name.clone()));
        if let Some(spacing) = meant {
            checker.remedy(mistake, &place, Some(&spacing));
        }
    };
    lattice.map_err(report).ok()
}

/// Returns whether a disc may have a rim of triangles: not with a `grid`, and not in Breen's model.
fn has_rim(checker: &Checker<'_>, entry: &PanelSpec) -> bool {
    entry.grid.is_none() && !checker.spec.is_breen()
}

/// Says which spacing suits a panel of a size, in m, in place of a spacing, in m.
fn spacing_help(spacing: f64, size: f64) -> String {
    let most = 500.0 * size;
    let meant = if (1.0..most).contains(&spacing) {
        format!("did you mean \"{} mm\"? ", figure(spacing))
    } else {
        String::new()
    };
    format!("write spacing = \"{} mm\" or less; {meant}", figure_below(most))
}

/// Checks the direction of the yarns in a panel; a grid whose place has no meaning is refused.
fn grain(checker: &mut Checker<'_>, key: &str, entry: &PanelSpec) -> Option<Grain> {
    if !checker.is_sound(&format!("{key}.grain")) {
        return None;
    }
    if entry.grid.is_some() && entry.rectangle.is_some() && entry.grain % 90.0 == 0.0 {
        let message = format!("the yarns of panel \"{}\" follow its sides", entry.name);
        checker.fail(
            &format!("{key}.grid"),
            message,
            "its grid begins at a corner; leave grid out",
        );
    }
    Some(Grain::from_degrees(entry.grain))
}
