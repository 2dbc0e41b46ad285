use std::ops::Range;
use std::path::Path;

use drape_cloth::{Allowance, Grain, Lattice, Mesh, Tie};
use drape_input::Diagnostic;
use drape_pattern::{Cut, CutPattern, Cutter, Error, NodeId, Pattern, Placement};

use crate::allowance::allowances;
use crate::file::{GarmentFile, GarmentPanelFile, SceneFile};
use crate::layers::worn_at;
use crate::material::Material;
use crate::noise::Noise;
use crate::panel::{Laid, Panel, SPACING};
use crate::reader::Reader;
use crate::stitching::Stitching;

/// A line along which two edges are sewn together.
#[derive(Debug, Clone, PartialEq)]
pub struct Seam {
    /// Its name in the pattern.
    pub name: String,
    /// The particles of both sides, in the order in which it runs; those of a pair are one at the tip of a dart.
    pub stitching: Stitching,
    /// Angle by which its sides are turned towards their right sides at rest, in rad.
    pub angle: f64,
}

/// A garment as its panels and how they are sewn.
pub(crate) struct Garment {
    /// Its own, or else that of the file of its pattern.
    pub(crate) name: String,
    pub(crate) panels: Vec<Laid>,
    pub(crate) seams: Vec<Seam>,
    /// What the user should know about its pattern.
    pub(crate) notes: Vec<String>,
}

/// A panel of a cut pattern.
struct Piece<'a> {
    pattern: &'a Pattern,
    cut: &'a CutPattern,
    /// Which of its panels it is.
    index: usize,
    /// The number of each of its nodes in its lattice.
    number: &'a [u32],
    /// The number of its first particle in the scene.
    first: usize,
    /// The layer of its garment.
    layer: u32,
}

impl Garment {
    /// Which particles of the scene are its own, if it has some.
    pub(crate) fn particles(&self) -> Option<Range<usize>> {
        let [first, last] = [self.panels.first()?, self.panels.last()?];
        Some(first.panel.first..last.panel.first + last.positions.len() / 3)
    }
}

impl Reader<'_> {
    /// The garments of a scene, whose particles are numbered from `first` on.
    pub(crate) fn garments(
        &mut self,
        (file, folder): (&SceneFile, &Path),
        materials: &[Option<Material>],
        (first, unit): (usize, f64),
    ) -> Vec<Garment> {
        let mut first = first;
        let mut garments = Vec::new();
        for (index, entry) in file.garment.iter().enumerate() {
            let key = format!("garment[{index}]");
            let Some(pattern) = self.pattern(&key, &folder.join(&entry.pattern)) else { continue };
            let spacing = entry.spacing.or(file.spacing).map_or(SPACING, |s| s * unit);
            let Some(parts) = self.cut(&key, (file, entry), (&pattern, spacing), (first, unit))
            else {
                continue;
            };
            for laid in &parts.panels {
                if let Some(Some(material)) = materials.get(laid.panel.material) {
                    self.thick_enough(&key, &laid.panel.lattice, material);
                }
            }
            first += parts.panels.iter().map(|laid| laid.positions.len() / 3).sum::<usize>();
            garments.push(parts);
        }
        garments
    }

    fn pattern(&mut self, key: &str, path: &Path) -> Option<Pattern> {
        let given = self.fabrics.iter().find(|given| given.path() == path);
        if given.is_none() && !path.exists() {
            let message = format!("there is no file {}", path.display());
            self.fail(
                &format!("{key}.pattern"),
                message,
                "the path is relative to the scene's folder",
            );
            return None;
        }
        let read = match given {
            Some(document) => Pattern::parse(document).map_err(Error::from),
            None => Pattern::read(path),
        };
        match read {
            Ok(pattern) => Some(pattern),
            Err(Error::Input(mistakes)) => {
                self.mistakes.extend(mistakes.0);
                None
            }
            Err(error) => {
                self.mistakes.push(Diagnostic::new(path, error.to_string()));
                None
            }
        }
    }

    /// A pattern cut at a spacing, in m, with each panel at its place.
    fn cut(
        &mut self,
        key: &str,
        (file, entry): (&SceneFile, &GarmentFile),
        (pattern, spacing): (&Pattern, f64),
        (first, unit): (usize, f64),
    ) -> Option<Garment> {
        let names: Vec<&str> = pattern.panels().iter().map(drape_pattern::Panel::name).collect();
        for name in entry.panel.keys().filter(|name| !names.contains(&name.as_str())) {
            let message = format!("the pattern has no panel \"{name}\"");
            let key = format!("{key}.panel.{name}");
            self.unknown(&key, message, (name, &names), "panels of the pattern");
        }
        let cut = self.pieces(key, Cutter::new(spacing).cut(pattern))?;
        let layer = self.layer(&format!("{key}.layer"), entry.layer, file).unwrap_or(0);
        let mut noise = self.noise(&format!("{key}.noise"), entry.noise.as_ref(), unit);
        let (mut panels, mut numbers, mut next) = (Vec::new(), Vec::new(), first);
        for (index, own) in cut.panels.iter().enumerate() {
            let number = numbering(own);
            let piece = Piece { pattern, cut: &cut, index, number: &number, first: next, layer };
            panels.extend(self.lay((key, file, entry), &piece, (&mut noise, unit)));
            numbers.push((next, number));
            next += own.positions.len();
        }
        let node = |id: NodeId| {
            let (first, number) = &numbers[id.panel];
            *first as u32 + number[id.node as usize]
        };
        let seams = pattern.seams().iter().zip(&cut.seams).map(|(stitch, nodes)| {
            let tie = |tie: &drape_pattern::Tie| Tie {
                particle: node(tie.node),
                ends: nodes.ends(tie).map(node),
                fraction: tie.fraction,
            };
            let pairs = nodes.pairs.iter().map(|pair| pair.map(node)).collect();
            let stitching = Stitching { pairs, ties: nodes.ties.iter().map(tie).collect() };
            Seam { name: stitch.name.clone(), angle: stitch.angle, stitching }
        });
        let notes = pattern.notes().iter().chain(&cut.notes).map(ToString::to_string).collect();
        let name = match &entry.name {
            Some(name) => name.clone(),
            None => {
                let name = Path::new(&entry.pattern).file_stem().unwrap_or_default();
                name.to_string_lossy().into_owned()
            }
        };
        let whole = panels.len() == names.len();
        whole.then(|| Garment { name, panels, seams: seams.collect(), notes })
    }

    /// The cut of a pattern, if it could be made.
    fn pieces(&mut self, key: &str, cut: Result<CutPattern, Error>) -> Option<CutPattern> {
        let key = format!("{key}.pattern");
        match cut {
            Ok(cut) => return Some(cut),
            Err(Error::Pattern(mistakes)) => {
                for mistake in mistakes {
                    self.fail(&key, mistake.to_string(), &mistake.help());
                }
            }
            Err(error) => self.fail(&key, error.to_string(), "correct the pattern"),
        }
        None
    }

    /// A panel of a cut pattern at its place.
    fn lay(
        &mut self,
        (key, file, entry): (&str, &SceneFile, &GarmentFile),
        piece: &Piece<'_>,
        (noise, unit): (&mut Option<Noise>, f64),
    ) -> Option<Laid> {
        let &Piece { pattern, cut, index, number, first, layer } = piece;
        let panel = &pattern.panels()[index];
        let parts = allowances((pattern, cut), index);
        let cut = &cut.panels[index];
        let own = entry.panel.get(panel.name());
        let placement = self.place((key, panel.name()), (entry, own), panel.placement(), unit);
        let layer_key = format!("{key}.panel.{}.layer", panel.name());
        let layer = self.layer(&layer_key, own.and_then(|own| own.layer), file).unwrap_or(layer);
        let (fabric_key, fabric) = match own.and_then(|own| own.fabric.as_ref()) {
            Some(fabric) => (format!("{key}.panel.{}.fabric", panel.name()), fabric),
            None => (format!("{key}.fabric"), &entry.fabric),
        };
        let material = self.material_of(&fabric_key, fabric, file);
        let lattice = lattice(cut, (panel.grain(), number), &parts);
        let lattice = lattice.map_err(|error| {
            let message = format!("panel \"{}\": {error}", panel.name());
            let help = "choose another spacing, and report the pattern";
            self.fail(&format!("{key}.pattern"), message, help);
        });
        let folds = panel.folds().iter().map(|fold| (fold.ends, fold.angle));
        let lattice = self.folded((key, panel.name()), lattice.ok()?, folds)?;
        let (placement, material) = (worn_at(placement?, layer), material?);
        let mut positions = vec![0.0; 3 * cut.positions.len()];
        for (&node, &place) in number.iter().zip(&cut.positions) {
            let height = noise.as_mut().map_or(0.0, |noise| noise.height(place));
            let point = placement.point(place);
            for axis in 0..3 {
                positions[3 * node as usize + axis] =
                    point[axis] + height * placement.rotation[axis][2];
            }
        }
        let edges = panel.outline().iter().zip(&cut.edges).map(|(edge, nodes)| {
            (edge.name.clone(), nodes.iter().map(|&node| number[node as usize]).collect())
        });
        let edges = edges.collect();
        let name = match &entry.name {
            Some(garment) => format!("{garment}.{}", panel.name()),
            None => panel.name().to_owned(),
        };
        let panel = Panel { name, material, lattice, first, edges, layer };
        let velocities = vec![0.0; positions.len()];
        Some(Laid { panel, positions, velocities })
    }

    /// Where a panel begins: where the scene says, or else the pattern; shifted with the garment.
    fn place(
        &mut self,
        (key, name): (&str, &str),
        (entry, own): (&GarmentFile, Option<&GarmentPanelFile>),
        given: Option<&Placement>,
        unit: f64,
    ) -> Option<Placement> {
        let written = own.filter(|own| own.center.is_some() || own.turn.is_some());
        let mut placement = match (written, given) {
            (Some(own), _) => {
                let center = own.center.unwrap_or_default().map(|x| x * unit);
                Placement::new(own.turn.unwrap_or_default().map(f64::to_radians), center)
            }
            (None, Some(given)) => *given,
            (None, None) => {
                let help = format!(
                    "add center = [x, y, z] and turn = [x, y, z] to [{}], or origin and turn to the pattern",
                    format_args!("garment.panel.{name}")
                );
                let message = format!("panel \"{name}\" has no place in space");
                self.fail(key, message, &help);
                return None;
            }
        };
        if let Some(radius) = own.and_then(|own| own.wrap) {
            placement.wrap = Some(radius * unit);
        }
        let numbers = placement
            .rotation
            .iter()
            .flatten()
            .chain(&placement.translation)
            .chain(&placement.wrap);
        if numbers.chain(&entry.center).any(|x| !x.is_finite()) {
            self.fail(&format!("{key}.center"), "is not finite".into(), "in the file's unit");
        }
        (0..3).for_each(|axis| placement.translation[axis] += entry.center[axis] * unit);
        Some(placement)
    }
}

/// The number of each node of a cut in its lattice: those of the grid come first, row by row, then those of the outline.
fn numbering(cut: &Cut) -> Vec<u32> {
    let inner = cut.lattice.iter().flatten().count() as u32;
    let (mut grid, mut outline) = (0..inner, inner..);
    let number = |place: &Option<[u32; 2]>| match place {
        Some(_) => grid.next(),
        None => outline.next(),
    };
    cut.lattice.iter().map(number).map(Option::unwrap_or_default).collect()
}

/// A cut as the cloth knows it.
fn lattice(
    cut: &Cut,
    (grain, number): (f64, &[u32]),
    allowances: &[(Vec<u32>, f64)],
) -> Result<Lattice, drape_cloth::Error> {
    let mut coordinates = vec![[0.0; 2]; number.len()];
    let mut places = vec![None; number.len()];
    for (node, &own) in number.iter().enumerate() {
        coordinates[own as usize] = cut.yarns[node];
        places[own as usize] = cut.lattice[node];
    }
    let places: Vec<[u32; 2]> = places.into_iter().flatten().collect();
    let mesh = Mesh {
        spacing: cut.spacing,
        coordinates,
        grid: places,
        cells: cut.quads.iter().map(|quad| quad.map(|node| number[node as usize])).collect(),
        triangles: cut.triangles.iter().map(|t| t.map(|node| number[node as usize])).collect(),
    };
    let own = |(line, width): &(Vec<u32>, f64)| Allowance {
        line: line.iter().map(|&node| number[node as usize]).collect(),
        width: *width,
    };
    let allowances: Vec<Allowance> = allowances.iter().map(own).collect();
    Lattice::from_mesh(mesh, Grain::from_degrees(grain.to_degrees()))?.with_allowances(&allowances)
}
