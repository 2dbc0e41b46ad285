//! Panels of a cut pattern at their places.

use drape_cloth::{Grain, Lattice};
use drape_input::{Subject, toml_key};
use drape_pattern::{CutPattern, Pattern, Placement};

use crate::check::checker::Checker;
use crate::check::fabrics::material_index;
use crate::check::garment::allowances::AllowanceLine;
use crate::check::garment::layer::{check_layer, worn_at};
use crate::check::panel::PlacedPanel;
use crate::check::panel::cut_lattice::{cut_lattice, node_numbers};
use crate::check::panel::folds::{FoldLine, UnfoldedPanel, folded};
use crate::check::panel::graded::graded;
use crate::check::panel::noise::Noise;
use crate::grading::Grading;
use crate::scene::panel::{Panel, PanelEdge};
use crate::spec::garment::{GarmentPanelSpec, GarmentSpec};

/// Panel of a cut pattern, and the garment that it is of.
pub(crate) struct Piece<'a> {
    /// Key of the garment.
    pub(crate) key: &'a str,
    pub(crate) entry: &'a GarmentSpec,
    pub(crate) pattern: &'a Pattern,
    pub(crate) cut: &'a CutPattern,
    /// Allowances of the panel.
    pub(crate) allowances: &'a [AllowanceLine],
    /// Index of the panel.
    pub(crate) index: usize,
    /// Number of its first particle in the scene.
    pub(crate) first: usize,
    pub(crate) grading: Option<&'a Grading>,
}

/// Panel of a garment at its place, with the numbers of the nodes of its cut.
pub(crate) struct PlacedPiece {
    pub(crate) panel: PlacedPanel,
    /// Number of each node of the cut in the lattice; none where a graded panel has no particle.
    numbers: Vec<Option<u32>>,
}

impl PlacedPiece {
    /// Returns the number in the lattice of the node `node` of an edge.
    fn lattice_node(&self, node: u32) -> u32 {
        self.numbers[node as usize].expect("it has all nodes of edges")
    }

    /// Returns the particle in the scene that a node of an edge is.
    pub(crate) fn particle(&self, node: u32) -> u32 {
        self.panel.panel.first as u32 + self.lattice_node(node)
    }

    /// Returns the position of a node of an edge, in m.
    pub(crate) fn position(&self, node: u32) -> [f64; 3] {
        let first = 3 * self.lattice_node(node) as usize;
        [0, 1, 2].map(|axis| self.panel.positions[first + axis])
    }
}

impl<'a> Piece<'a> {
    fn panel(&self) -> &'a drape_pattern::Panel {
        &self.pattern.panels()[self.index]
    }

    /// Keys of the panel in the scene.
    fn entry_of_panel(&self) -> Option<&'a GarmentPanelSpec> {
        self.entry.panel.get(self.panel().name())
    }
}

/// Makes a panel of a garment of some layer.
pub(crate) fn placed_panel(
    checker: &mut Checker<'_>,
    piece: &Piece<'_>,
    layer_of_garment: u32,
    noise: &mut Option<Noise>,
) -> Option<PlacedPiece> {
    let &Piece { key, entry, cut, index, first, .. } = piece;
    let (panel, panel_entry) = (piece.panel(), piece.entry_of_panel());
    let cut = &cut.panels[index];
    let placement = placement(checker, piece);
    let layer_key = format!("{key}.panel.{}.layer", toml_key(panel.name()));
    let layer = panel_entry.and_then(|entry| entry.layer);
    let layer = layer.map(|layer| check_layer(checker, &layer_key, layer));
    let layer = layer.unwrap_or(layer_of_garment);
    let (fabric_key, fabric) = match panel_entry.and_then(|entry| entry.fabric.as_ref()) {
        Some(fabric) => (format!("{key}.panel.{}.fabric", toml_key(panel.name())), fabric),
        None => (format!("{key}.fabric"), &entry.fabric),
    };
    // A panel may have a fabric of its own in the pattern, by the name that the scene gives it.
    let given = panel.fabric().filter(|_| panel_entry.is_none_or(|entry| entry.fabric.is_none()));
    let material = match given {
        Some(name) if !checker.spec.fabric.contains_key(name) => {
            let message =
                format!("panel \"{}\" of the pattern is of fabric \"{name}\"", panel.name());
            let help = format!(
                "add [fabric.{}], or panel.{}.fabric to the garment",
                toml_key(name),
                toml_key(panel.name())
            );
            checker.fail(&format!("{key}.pattern"), message, &help);
            None
        }
        Some(name) => material_index(checker, &fabric_key, name),
        None => material_index(checker, &fabric_key, fabric),
    };
    let name = match &entry.name {
        Some(garment) => format!("{garment}.{}", panel.name()),
        None => panel.name().to_owned(),
    };
    let NumberedLattice { lattice, numbers } = lattice(checker, piece, &name)?;
    let (placement, material) = (worn_at(placement?, layer), material?);
    let mut positions = vec![0.0; 3 * lattice.coordinates().len()];
    for (number, &place) in numbers.iter().zip(&cut.positions) {
        let height = noise.as_mut().map_or(0.0, |noise| noise.height(place));
        let Some(number) = number else { continue };
        let point = placement.point(place);
        for axis in 0..3 {
            positions[3 * *number as usize + axis] =
                point[axis] + height * placement.rotation[axis][2];
        }
    }
    let edges = panel.edges().zip(&cut.edges).map(|(edge, nodes)| PanelEdge {
        name: edge.name.clone(),
        nodes: nodes.iter().filter_map(|&node| numbers[node as usize]).collect(),
    });
    let edges = edges.collect();
    let panel = Panel { name, material, lattice, first, edges, layer };
    let velocities = vec![0.0; positions.len()];
    Some(PlacedPiece { panel: PlacedPanel { panel, positions, velocities }, numbers })
}

/// Lattice of a panel, with the number of each node of its cut in it.
struct NumberedLattice {
    lattice: Lattice,
    numbers: Vec<Option<u32>>,
}

/// Makes the lattice of a panel, which has a name in the scene.
fn lattice(checker: &mut Checker<'_>, piece: &Piece<'_>, name: &str) -> Option<NumberedLattice> {
    let &Piece { key, cut, allowances, index, grading, .. } = piece;
    let panel = piece.panel();
    let numbers = node_numbers(&cut.panels[index]);
    let allowances: Vec<_> =
        allowances.iter().map(|allowance| allowance.numbered(&numbers)).collect();
    let grain = Grain::from_degrees(panel.grain().to_degrees());
    let lattice = cut_lattice(&cut.panels[index], &numbers, grain);
    let lattice =
        lattice.and_then(|lattice| lattice.with_allowances(&allowances)).map_err(|error| {
            let message = format!("panel \"{}\": {error}", panel.name());
            let help = "choose another spacing, and report the pattern";
            checker.fail(&format!("{key}.pattern"), message, help);
        });
    let lines = panel.folds().iter().map(|fold| FoldLine { ends: fold.ends, angle: fold.angle });
    let unfolded = UnfoldedPanel { lattice: lattice.ok()?, lines };
    let lattice = folded(checker, key, panel.name(), unfolded)?;
    let Some(grading) = grading else {
        return Some(NumberedLattice { lattice, numbers: numbers.into_iter().map(Some).collect() });
    };
    let graded = graded(checker, name, &lattice, grading)?;
    let numbers: Vec<_> = numbers.iter().map(|&number| graded.numbers[number as usize]).collect();
    if cut.panels[index].edges.iter().flatten().any(|&node| numbers[node as usize].is_none()) {
        let message = format!("panel \"{}\" has an edge that is not its outline", panel.name());
        checker.fail("grading", message, "leave [grading] out, and report the pattern");
        return None;
    }
    Some(NumberedLattice { lattice: graded.lattice, numbers })
}

/// Checks the placement of the panel `piece`. The placement of the scene comes before the placement
/// of the pattern, and both are shifted with the garment.
fn placement(checker: &mut Checker<'_>, piece: &Piece<'_>) -> Option<Placement> {
    let &Piece { key, entry, .. } = piece;
    let panel_entry = piece.entry_of_panel();
    let center = panel_entry.and_then(|entry| entry.center);
    let turn = panel_entry.and_then(|entry| entry.turn);
    let turn = turn.map(|turn| turn.map(f64::to_radians));
    let mut placement = match (center, turn, piece.panel().placement()) {
        // Of a place in the pattern each of both stays that the scene does not give.
        (center, None, Some(given)) => {
            Placement { translation: center.unwrap_or(given.translation), ..*given }
        }
        (center, Some(turn), Some(given)) => {
            Placement::new(turn, center.unwrap_or(given.translation)).with_wrap(given.wrap)
        }
        (Some(_), _, None) | (_, Some(_), None) => {
            Placement::new(turn.unwrap_or_default(), center.unwrap_or_default())
        }
        (None, None, None) => {
            let name = piece.panel().name();
            let help = format!(
                "add center = [x, y, z] and turn = [x, y, z] to [garment.panel.{}], or origin and turn to the pattern",
                toml_key(name)
            );
            let mistake =
                checker.fail(key, format!("panel \"{name}\" has no place in space"), &help);
            checker.about(mistake, Subject::Panel(name.into()));
            return None;
        }
    };
    if let Some(radius) = panel_entry.and_then(|entry| entry.wrap) {
        placement.wrap = Some(radius);
    }
    (0..3).for_each(|axis| placement.translation[axis] += entry.center[axis]);
    Some(placement)
}
