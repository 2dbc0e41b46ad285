use std::ops::Range;

use drape_cloth::{Grain, Lattice};
use drape_input::Diagnostic;

use crate::file::{FoldFile, PanelFile, SceneFile};
use crate::material::Material;
use crate::placement::Placement;
use crate::reader::Reader;

/// Distance between particles when the scene gives none, in m.
pub(crate) const SPACING: f64 = 0.01;

/// Most particles of a stack of panels.
const PARTICLES_MAX: usize = 4_000_000;

/// A panel of a scene.
#[derive(Debug, Clone)]
pub struct Panel {
    /// Name in the scene.
    pub name: String,
    /// Index of its fabric.
    pub material: usize,
    /// Its particles before deformation.
    pub lattice: Lattice,
    /// Number of its first particle.
    pub first: usize,
    /// The named edges of a panel of a garment, with the numbers of their particles in the panel.
    pub edges: Vec<(String, Vec<u32>)>,
    /// How far out it is worn: what is of a higher layer starts outside of what is of a lower one.
    pub layer: u32,
}

impl Panel {
    /// The numbers of its particles.
    #[must_use]
    pub fn particles(&self) -> Range<usize> {
        self.first..self.first + self.lattice.coordinates.len()
    }
}

/// A panel at its place.
pub(crate) struct Laid {
    pub(crate) panel: Panel,
    /// Three numbers per particle, in m and m/s.
    pub(crate) positions: Vec<f64>,
    pub(crate) velocities: Vec<f64>,
}

impl Reader<'_> {
    pub(crate) fn panels(
        &mut self,
        file: &SceneFile,
        materials: &[Option<Material>],
        unit: f64,
    ) -> Vec<Laid> {
        if file.panel.is_empty() && file.garment.is_empty() {
            let help = "add [[panel]] with name, fabric and rectangle or disc, or [[garment]] with a pattern";
            self.mistakes
                .push(Diagnostic::new(self.document.path(), "the scene has no panel").help(help));
        }
        let mut panels: Vec<Laid> = Vec::new();
        let mut first = 0;
        for (index, entry) in file.panel.iter().enumerate() {
            let key = format!("panel[{index}]");
            if file.panel[..index].iter().any(|p| p.name == entry.name) {
                let message = format!("there are two panels \"{}\"", entry.name);
                self.fail(&format!("{key}.name"), message, "give each its own name");
            }
            let material = self.material_of(&format!("{key}.fabric"), &entry.fabric, file);
            let lattice = self.lattice(&key, entry, file.spacing, unit);
            let lattice = lattice.and_then(|lattice| {
                let ends = |fold: &FoldFile| [fold.from, fold.to].map(|end| end.map(|x| x * unit));
                let folds = entry.fold.iter().map(|fold| (ends(fold), fold.angle.to_radians()));
                self.folded((&format!("{key}.fold"), &entry.name), lattice, folds)
            });
            let noise = self.noise(&format!("{key}.noise"), entry.noise.as_ref(), unit);
            let placement = Placement::new(entry, noise, unit);
            let bad = entry.center.iter().chain(&entry.turn).any(|x| !x.is_finite());
            if entry.velocity.iter().chain(&entry.spin).any(|x| !x.is_finite()) {
                let help = "velocity in the file's unit per second, spin in degrees per second";
                self.fail(&format!("{key}.velocity"), "is not finite".into(), help);
            }
            if bad {
                self.fail(&format!("{key}.center"), "is not finite".into(), "in the file's unit");
            }
            if let (Some(material), Some(lattice)) = (material, lattice) {
                if let Some(Some(material)) = materials.get(material) {
                    self.thick_enough(&key, &lattice, material);
                }
                let particles = lattice.coordinates.len();
                for copy in 0..self.copies(&key, entry, particles) {
                    let name = match copy {
                        0 => entry.name.clone(),
                        _ => format!("{} {}", entry.name, copy + 1),
                    };
                    let lattice = lattice.clone();
                    let placement = placement.copied(copy, (entry.stack.as_ref(), unit));
                    let positions = placement.positions(&lattice);
                    let velocities = placement.velocities(&positions);
                    let edges = Vec::new();
                    let panel = Panel { name, material, lattice, first, edges, layer: 0 };
                    panels.push(Laid { panel, positions, velocities });
                    first += particles;
                }
            }
        }
        panels
    }

    /// The number of the fabric of a name.
    pub(crate) fn material_of(&mut self, key: &str, name: &str, file: &SceneFile) -> Option<usize> {
        let names: Vec<&str> = file.fabric.keys().map(String::as_str).collect();
        let material = names.iter().position(|known| *known == name);
        if material.is_none() {
            let message = format!("there is no fabric \"{name}\"");
            self.unknown(key, message, (name, &names), "fabrics of this scene");
        }
        material
    }

    /// How many panels an entry stands for.
    fn copies(&mut self, key: &str, entry: &PanelFile, particles: usize) -> usize {
        let Some(stack) = &entry.stack else { return 1 };
        if stack.step.iter().chain(&stack.turn).any(|x| !x.is_finite()) {
            self.fail(
                &format!("{key}.stack"),
                "is not finite".into(),
                "step is in the file's unit",
            );
        }
        let most = PARTICLES_MAX / particles;
        if (1..=most).contains(&stack.count) {
            return stack.count;
        }
        let message = format!("{} panels of {particles} particles", stack.count);
        let help = format!("from 1 panel to {most}, for {PARTICLES_MAX} particles in all");
        self.fail(&format!("{key}.stack.count"), message, &help);
        1
    }

    /// The particles of a panel before it is deformed.
    fn lattice(
        &mut self,
        key: &str,
        entry: &PanelFile,
        spacing: Option<f64>,
        unit: f64,
    ) -> Option<Lattice> {
        let own = entry.spacing.is_some();
        let spacing = entry.spacing.or(spacing).map_or(SPACING, |s| s * unit);
        let grid = entry.grid.unwrap_or_default().map(|place| place * unit);
        let grain = self.grain(key, entry)?;
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
                self.fail(&format!("{key}.hole"), message, "a hole is in the middle of a disc");
                return None;
            }
            _ => {
                let help = "give one of rectangle = [width, height] and disc = diameter";
                self.fail(key, format!("panel \"{}\" has no single shape", entry.name), help);
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
            self.fail(&place, format!("panel \"{}\": {error}", entry.name), help);
        };
        lattice.map_err(report).ok()
    }

    /// How the yarns lie in a panel; a grid that its place has no meaning for is refused.
    fn grain(&mut self, key: &str, entry: &PanelFile) -> Option<Grain> {
        let help = "degrees from the panel's height to its warp, anticlockwise; 45 is the bias";
        if !self.within(&format!("{key}.grain"), entry.grain, (-180.0, 180.0), help) {
            return None;
        }
        if entry.grid.is_some() && entry.rectangle.is_some() && entry.grain % 90.0 == 0.0 {
            let message = format!("the yarns of panel \"{}\" follow its sides", entry.name);
            self.fail(
                &format!("{key}.grid"),
                message,
                "its grid begins at a corner; leave grid out",
            );
        }
        Some(Grain::from_degrees(entry.grain))
    }

    /// The particles must be farther apart than the cloth is thick.
    pub(crate) fn thick_enough(&mut self, key: &str, lattice: &Lattice, material: &Material) {
        let spacing = lattice.spacing[0].min(lattice.spacing[1]);
        let thickness = material.fabric.thickness;
        if spacing < thickness {
            let message = format!(
                "the spacing of {spacing} m is less than the thickness {thickness} m of fabric \"{}\"",
                material.name
            );
            self.fail(&format!("{key}.spacing"), message, "use a larger spacing");
        }
    }
}
