//! Panels of a scene that it describes itself: rectangles and discs.

pub(crate) mod folds;
pub(crate) mod noise;
mod placement;

use drape_cloth::{Grain, Lattice};

use crate::check::checker::Checker;
use crate::check::fabrics::{check_thickness, material_index};
use crate::file::panel::{FoldFile, PanelFile};
use crate::scene::material::Material;
use crate::scene::panel::Panel;

use self::folds::{FoldLine, UnfoldedPanel, folded};
use self::noise::noise;
use self::placement::Placement;

/// Distance between particles when the scene gives none, in m.
pub(crate) const SPACING: f64 = 0.01;

/// Largest number of particles of a stack of panels.
const PARTICLES_MAX: usize = 4_000_000;

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
) -> Vec<PlacedPanel> {
    let file = checker.file;
    if file.panel.is_empty() && file.garment.is_empty() {
        let help =
            "add [[panel]] with name, fabric and rectangle or disc, or [[garment]] with a pattern";
        checker.fail_file("the scene has no panel", help);
    }
    let mut panels: Vec<PlacedPanel> = Vec::new();
    let mut first = 0;
    for (index, entry) in file.panel.iter().enumerate() {
        let key = format!("panel[{index}]");
        if file.panel[..index].iter().any(|p| p.name == entry.name) {
            let message = format!("there are two panels \"{}\"", entry.name);
            checker.fail(&format!("{key}.name"), message, "give each its own name");
        }
        let material = material_index(checker, &format!("{key}.fabric"), &entry.fabric);
        let lattice = lattice(checker, &key, entry);
        let lattice = lattice.and_then(|lattice| fold(checker, &key, entry, lattice));
        let noise = noise(checker, &format!("{key}.noise"), entry.noise.as_ref());
        let placement = Placement::check(checker, &key, entry, noise);
        let (Some(material), Some(lattice)) = (material, lattice) else { continue };
        if let Some(Some(material)) = materials.get(material) {
            check_thickness(checker, &key, &lattice, material);
        }
        let particles = lattice.coordinates.len();
        for copy in 0..copies(checker, &key, entry, particles) {
            let name = match copy {
                0 => entry.name.clone(),
                _ => format!("{} {}", entry.name, copy + 1),
            };
            let lattice = lattice.clone();
            let placement = placement.copied(copy, entry.stack.as_ref(), checker.unit);
            let positions = placement.positions(&lattice);
            let velocities = placement.velocities(&positions);
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
    entry: &PanelFile,
    lattice: Lattice,
) -> Option<Lattice> {
    let unit = checker.unit;
    let lines = entry.fold.iter().map(|fold: &FoldFile| FoldLine {
        ends: [fold.from, fold.to].map(|end| end.map(|x| x * unit)),
        angle: fold.angle.to_radians(),
    });
    folded(checker, &format!("{key}.fold"), &entry.name, UnfoldedPanel { lattice, lines })
}

/// Checks the number of panels that an entry stands for.
fn copies(checker: &mut Checker<'_>, key: &str, entry: &PanelFile, particles: usize) -> usize {
    let Some(stack) = &entry.stack else { return 1 };
    if stack.step.iter().chain(&stack.turn).any(|x| !x.is_finite()) {
        let help = "step is in the file's unit";
        checker.fail(&format!("{key}.stack"), "is not finite", help);
    }
    let most = PARTICLES_MAX / particles;
    if (1..=most).contains(&stack.count) {
        return stack.count;
    }
    let message = format!("{} panels of {particles} particles", stack.count);
    let help = format!("from 1 panel to {most}, for {PARTICLES_MAX} particles in all");
    checker.fail(&format!("{key}.stack.count"), message, &help);
    1
}

/// Makes the particles of a panel before it is deformed.
fn lattice(checker: &mut Checker<'_>, key: &str, entry: &PanelFile) -> Option<Lattice> {
    let unit = checker.unit;
    let own = entry.spacing.is_some();
    let spacing = entry.spacing.or(checker.file.spacing).map_or(SPACING, |s| s * unit);
    let grid = entry.grid.unwrap_or_default().map(|place| place * unit);
    let grain = grain(checker, key, entry)?;
    let radius = |diameter: f64| 0.5 * diameter * unit;
    let lattice = match (entry.rectangle, entry.disc, entry.hole) {
        (Some(size), None, None) => {
            Lattice::rectangle_at(grain, grid, size.map(|side| side * unit), spacing)
        }
        (None, Some(disc), hole) => {
            let round = match hole {
                None => Lattice::disc_on(grid, radius(disc), spacing),
                Some(hole) => Lattice::ring_on(grid, [hole, disc].map(radius), spacing),
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
        Err(drape_cloth::Error::Spacing { .. } | drape_cloth::Error::TooMany { .. }) if own => {
            format!("{key}.spacing")
        }
        Err(drape_cloth::Error::Spacing { .. } | drape_cloth::Error::TooMany { .. }) => {
            "spacing".into()
        }
        _ if entry.hole.is_some_and(|hole| !(hole > 0.0)) => format!("{key}.hole"),
        _ if entry.disc.is_some() => format!("{key}.disc"),
        _ => format!("{key}.rectangle"),
    };
    let report = |error: drape_cloth::Error| {
        let help = "lengths are in the file's unit, set by length = \"m\", \"cm\" or \"mm\"";
        checker.fail(&place, format!("panel \"{}\": {error}", entry.name), help);
    };
    lattice.map_err(report).ok()
}

/// Checks the direction of the yarns in a panel; a grid whose place has no meaning is refused.
fn grain(checker: &mut Checker<'_>, key: &str, entry: &PanelFile) -> Option<Grain> {
    let help = "degrees from the panel's height to its warp, anticlockwise; 45 is the bias";
    if !checker.within(&format!("{key}.grain"), entry.grain, -180.0..=180.0, help) {
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
