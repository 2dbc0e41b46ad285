use std::path::{Path, PathBuf};

use drape_cloth::{Cloth, Lattice};
use drape_collide::{Body, Contact, Mesh, Pose, Settings as ContactSettings, Shape};
use drape_implicit::{Initial, Integrator, LinearSolver, Method, Settings};
use drape_input::{Diagnostic, Diagnostics, Document, closest};

use crate::file::{PanelFile, PinFile, SceneFile};
use crate::material::Material;
use crate::placement::{Placement, turned};

/// Distance between particles when the scene gives none, in m.
const SPACING: f64 = 0.01;

/// Density of air at 20 °C and sea level, in kg/m³.
const AIR_DENSITY: f64 = 1.2;

/// Drag coefficient of a flat plate across the flow.
const AIR_DRAG: f64 = 1.28;

/// Seconds between frames when the scene does not say.
const FRAME_INTERVAL: f64 = 0.04;

/// A scene that has been read and checked: everything a simulation needs, in SI units.
#[derive(Debug)]
pub struct Scene {
    /// Name, for people.
    pub name: String,
    /// The file it was read from.
    pub file: PathBuf,
    /// Fabrics, in the order of their names.
    pub materials: Vec<Material>,
    /// Panels, in the order of the file.
    pub panels: Vec<Panel>,
    /// All panels as one cloth.
    pub cloth: Cloth,
    /// Positions of the particles at the start, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Particles that are held where they start.
    pub held: Vec<bool>,
    /// Contact of the cloth with the bodies.
    pub contact: Contact,
    /// Acceleration of gravity, in m/s².
    pub gravity: [f64; 3],
    /// Half the air's density times the drag coefficient, in kg/m³.
    pub air: f64,
    /// Steps and their end.
    pub clock: Clock,
    /// How the steps are solved.
    pub solver: Settings,
    /// Folder for the results that the scene asks for.
    pub folder: Option<PathBuf>,
    /// From where the picture is taken, azimuth and elevation in degrees, where the scene says so.
    pub view: [Option<f64>; 2],
    /// Hash of the scene and of all files it names.
    pub hash: String,
}

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
}

/// Steps of a simulation; time is counted in units of the shortest step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Shortest length of a step, in s; the unit in which time is counted.
    pub step: f64,
    /// Length to which steps grow while the cloth is slow, in s.
    pub step_max: f64,
    /// When the simulation ends at the latest, in s.
    pub end: f64,
    /// Speed below which the cloth is at rest and the simulation ends, in m/s.
    pub rest_speed: Option<f64>,
    /// Units of time between frames.
    pub ticks_per_frame: usize,
}

impl Scene {
    /// Reads a scene and everything it names, without simulating.
    ///
    /// # Errors
    /// All mistakes that could be found, each with file, line, value and remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Diagnostics> {
        let document = Document::read(path)?;
        let file: SceneFile = document.decode()?;
        Reader { document: &document, mistakes: Vec::new() }.scene(file)
    }
}

/// Turns a file into a scene, collecting mistakes.
struct Reader<'a> {
    document: &'a Document,
    mistakes: Vec<Diagnostic>,
}

impl Reader<'_> {
    fn scene(mut self, file: SceneFile) -> Result<Scene, Diagnostics> {
        let unit = self.unit(file.length.as_deref());
        let folder = self.document.path().parent().unwrap_or(Path::new("")).to_owned();
        let materials = self.materials(&file, &folder);
        let panels = self.panels(&file, &materials, unit);
        let clock = self.clock(&file);
        let solver = self.solver(&file);
        let air = self.air(&file);
        let gravity = file.gravity.unwrap_or([0.0, -9.81, 0.0]);
        if gravity.iter().any(|g| !g.is_finite()) {
            self.fail("gravity", format!("{gravity:?} is not finite"), "in m/s², [0, -9.81, 0]");
        }
        let bodies = self.bodies(&file, &folder, unit);
        let contact_settings = self.contact_settings(&file, unit);
        // What follows needs sound panels.
        Diagnostics::check(std::mem::take(&mut self.mistakes))?;

        let pairs: Vec<_> = panels
            .iter()
            .map(|(panel, _)| {
                let material = materials[panel.material].as_ref();
                (&panel.lattice, &material.expect("mistakes were reported").fabric)
            })
            .collect();
        let cloth = Cloth::new(&pairs);
        let materials: Vec<Material> = materials.into_iter().flatten().collect();
        let positions: Vec<f64> =
            panels.iter().flat_map(|(panel, place)| place.positions(&panel.lattice)).collect();
        let panels: Vec<Panel> = panels.into_iter().map(|(panel, _)| panel).collect();
        let mut held = vec![false; cloth.particles()];
        for (index, pin) in file.pin.iter().enumerate() {
            self.pin(index, pin, (&panels, unit), &mut held);
        }
        let fallback = materials.iter().map(|m| m.fabric.surface_friction).fold(0.0, f64::max);
        let bodies = bodies
            .into_iter()
            .map(|(body, friction)| body.with_friction(friction.unwrap_or(fallback)))
            .collect();
        let contact = Contact::new(bodies, contact_settings, cloth.areas().to_vec());
        let contact = contact.map_err(|error| self.document.at("collider", error.to_string()))?;
        self.start_is_free(&contact, &positions);
        Diagnostics::check(self.mistakes)?;
        Ok(Scene {
            name: file.name.unwrap_or_else(|| "unnamed".into()),
            file: self.document.path().to_owned(),
            hash: hash(self.document, &materials),
            materials,
            panels,
            cloth,
            positions,
            held,
            contact,
            gravity,
            air,
            clock,
            solver,
            folder: file.output.folder.map(|f| folder.join(f)),
            view: [file.output.azimuth, file.output.elevation],
        })
    }

    fn fail(&mut self, key: &str, message: String, help: &str) {
        self.mistakes.push(self.document.at(key, message).help(help));
    }

    /// Whether a number is within its inclusive bounds; if not, that is reported.
    fn within(&mut self, key: &str, value: f64, (low, high): (f64, f64), help: &str) -> bool {
        let sound = value >= low && value <= high;
        if !sound {
            self.fail(key, format!("{value} is not between {low} and {high}"), help);
        }
        sound
    }

    /// One of several words, or the first of them when none is given.
    fn choice<T: Copy>(&mut self, key: &str, word: Option<&str>, choices: &[(&str, T)]) -> T {
        let found = choices.iter().find(|(name, _)| word.is_none_or(|word| word == *name));
        if let (None, Some(word)) = (found, word) {
            let names: Vec<&str> = choices.iter().map(|c| c.0).collect();
            let help = format!("one of {}", names.join(", "));
            self.fail(key, format!("there is no \"{word}\""), &help);
        }
        found.unwrap_or(&choices[0]).1
    }

    fn unit(&mut self, word: Option<&str>) -> f64 {
        self.choice("length", word, &[("m", 1.0), ("cm", 0.01), ("mm", 0.001)])
    }

    fn materials(&mut self, file: &SceneFile, folder: &Path) -> Vec<Option<Material>> {
        if file.fabric.is_empty() {
            let help = "add [fabric.NAME] with file = \"…\", a fabric.toml or a sheet.toml";
            self.mistakes
                .push(Diagnostic::new(self.document.path(), "the scene has no fabric").help(help));
        }
        let read = |(name, entry): (&String, &crate::file::FabricFile)| {
            let path = folder.join(&entry.file);
            if !path.exists() {
                let message = format!("there is no file {}", path.display());
                let help = "the path is relative to the scene's folder";
                self.fail(&format!("fabric.{name}.file"), message, help);
                return None;
            }
            Material::read(name, &path).map_err(|e| self.mistakes.extend(e.0)).ok()
        };
        file.fabric.iter().map(read).collect()
    }

    fn panels(
        &mut self,
        file: &SceneFile,
        materials: &[Option<Material>],
        unit: f64,
    ) -> Vec<(Panel, Placement)> {
        if file.panel.is_empty() {
            let help = "add [[panel]] with name, fabric and rectangle or disc";
            self.mistakes
                .push(Diagnostic::new(self.document.path(), "the scene has no panel").help(help));
        }
        let mut panels: Vec<(Panel, Placement)> = Vec::new();
        let mut first = 0;
        for (index, entry) in file.panel.iter().enumerate() {
            let key = format!("panel[{index}]");
            if file.panel[..index].iter().any(|p| p.name == entry.name) {
                let message = format!("there are two panels \"{}\"", entry.name);
                self.fail(&format!("{key}.name"), message, "give each its own name");
            }
            let names: Vec<&str> = file.fabric.keys().map(String::as_str).collect();
            let material = names.iter().position(|name| *name == entry.fabric);
            if material.is_none() {
                let message = format!("there is no fabric \"{}\"", entry.fabric);
                let help = match closest(&entry.fabric, names.iter().copied()) {
                    Some(name) => format!("did you mean \"{name}\"?"),
                    None => format!("the fabrics of this scene are: {}", names.join(", ")),
                };
                self.fail(&format!("{key}.fabric"), message, &help);
            }
            let lattice = self.lattice(&key, entry, file.spacing, unit);
            let placement = Placement::new(entry, unit);
            let bad = entry.center.iter().chain(&entry.turn).any(|x| !x.is_finite());
            if bad {
                self.fail(&format!("{key}.center"), "is not finite".into(), "in the file's unit");
            }
            if let (Some(material), Some(lattice)) = (material, lattice) {
                if let Some(Some(material)) = materials.get(material) {
                    self.thick_enough(&key, &lattice, material);
                }
                let particles = lattice.coordinates.len();
                panels.push((
                    Panel { name: entry.name.clone(), material, lattice, first },
                    placement,
                ));
                first += particles;
            }
        }
        panels
    }

    fn lattice(
        &mut self,
        key: &str,
        entry: &PanelFile,
        spacing: Option<f64>,
        unit: f64,
    ) -> Option<Lattice> {
        let own = entry.spacing.is_some();
        let spacing = entry.spacing.or(spacing).map_or(SPACING, |s| s * unit);
        let lattice = match (entry.rectangle, entry.disc) {
            (Some([width, height]), None) => {
                Lattice::rectangle(width * unit, height * unit, spacing)
            }
            (None, Some(diameter)) => Lattice::disc(0.5 * diameter * unit, spacing),
            _ => {
                let help = "give one of rectangle = [weft, warp] and disc = diameter";
                self.fail(key, format!("panel \"{}\" has no single shape", entry.name), help);
                return None;
            }
        };
        let place = match &lattice {
            Err(
                drape_cloth::ClothError::Spacing { .. } | drape_cloth::ClothError::TooMany { .. },
            ) if own => {
                format!("{key}.spacing")
            }
            Err(
                drape_cloth::ClothError::Spacing { .. } | drape_cloth::ClothError::TooMany { .. },
            ) => "spacing".into(),
            _ if entry.disc.is_some() => format!("{key}.disc"),
            _ => format!("{key}.rectangle"),
        };
        let report = |error: drape_cloth::ClothError| {
            let help = "lengths are in the file's unit, set by length = \"m\", \"cm\" or \"mm\"";
            self.fail(&place, format!("panel \"{}\": {error}", entry.name), help);
        };
        lattice.map_err(report).ok()
    }

    /// The particles must be farther apart than the cloth is thick.
    fn thick_enough(&mut self, key: &str, lattice: &Lattice, material: &Material) {
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

    fn clock(&mut self, file: &SceneFile) -> Clock {
        let time = &file.time;
        let sound = self.within("time.step", time.step, (1e-7, 0.1), "in s; 0.005 is usual");
        // A wrong step would make the other times wrong too.
        let shortest = if sound { time.step } else { 0.0 };
        self.within("time.end", time.end, (shortest, 1e5), "in s, at least one step");
        if let Some(speed) = time.rest_speed {
            self.within("time.rest_speed", speed, (1e-6, 10.0), "in m/s; 0.002 is usual");
        }
        if let Some(longest) = time.step_max {
            self.within("time.step_max", longest, (shortest, 10.0), "in s, at least one step");
        }
        let interval = file.output.every.unwrap_or(FRAME_INTERVAL.max(shortest));
        self.within("output.every", interval, (shortest, 1e5), "in s, at least one step");
        Clock {
            step: time.step,
            step_max: time.step_max.unwrap_or(time.step),
            end: time.end,
            rest_speed: time.rest_speed,
            ticks_per_frame: (interval / time.step).round().max(1.0) as usize,
        }
    }

    fn solver(&mut self, file: &SceneFile) -> Settings {
        let solver = &file.solver;
        let mut settings = Settings::default();
        let integrators =
            [("bdf2", Integrator::Bdf2), ("backward-euler", Integrator::BackwardEuler)];
        let methods = [
            ("broyden", Method::Broyden),
            ("newton", Method::Newton),
            ("textbook-mass", Method::Textbook { initial: Initial::Mass }),
            ("textbook-diagonal", Method::Textbook { initial: Initial::Diagonal }),
        ];
        let linear = [
            ("conjugate-gradient", LinearSolver::ConjugateGradient),
            ("cholesky", LinearSolver::Cholesky),
        ];
        let word = solver.integrator.as_deref();
        settings.integrator = self.choice("solver.integrator", word, &integrators);
        settings.method = self.choice("solver.method", solver.method.as_deref(), &methods);
        settings.linear_solver = self.choice("solver.linear", solver.linear.as_deref(), &linear);
        if let Some(tolerance) = solver.tolerance {
            let help = "rms acceleration error over g; 1e-4 is usual";
            self.within("solver.tolerance", tolerance, (1e-10, 0.1), help);
            settings.tolerance = tolerance;
        }
        settings
    }

    fn air(&mut self, file: &SceneFile) -> f64 {
        let air = file.air.as_ref();
        let density = air.and_then(|a| a.density).unwrap_or(AIR_DENSITY);
        let drag = air.and_then(|a| a.drag).unwrap_or(AIR_DRAG);
        self.within("air.density", density, (0.0, 100.0), "in kg/m³; 1.2 is usual, 0 a vacuum");
        self.within("air.drag", drag, (0.0, 10.0), "1.28 for a plate");
        0.5 * density * drag
    }

    fn contact_settings(&mut self, file: &SceneFile, unit: f64) -> ContactSettings {
        let mut settings = ContactSettings::default();
        if let Some(offset) = file.contact.offset {
            settings.offset = offset * unit;
            let help = "the distance at which contact begins; 1 mm is usual";
            self.within("contact.offset", settings.offset, (1e-5, 0.1), help);
        }
        if let Some(stiffness) = file.contact.stiffness {
            settings.stiffness = stiffness;
            self.within("contact.stiffness", stiffness, (1.0, 1e12), "in N/m³");
        }
        if let Some(speed) = file.contact.slip_speed {
            settings.slip_speed = speed;
            self.within("contact.slip_speed", speed, (1e-9, 1.0), "in m/s; 0.001 is usual");
        }
        settings
    }

    fn bodies(&mut self, file: &SceneFile, folder: &Path, unit: f64) -> Vec<(Body, Option<f64>)> {
        let colliders = &file.collider;
        let mut bodies = Vec::new();
        let mut add = |kind: &str, index: usize, parts: Parts<'_>| {
            let name = parts.name.cloned().unwrap_or_else(|| format!("{kind} {}", index + 1));
            let pose = pose(parts.center.map(|x| x * unit), parts.turn);
            bodies.push((Body::new(name, parts.shape, pose), parts.friction));
        };
        for (index, s) in colliders.sphere.iter().enumerate() {
            let shape = Shape::Sphere { radius: s.radius * unit };
            let (name, friction) = (s.name.as_ref(), s.friction);
            add("sphere", index, Parts { name, shape, center: s.center, turn: [0.0; 3], friction });
        }
        for (index, b) in colliders.boxes.iter().enumerate() {
            let half_extents = b.size.map(|side| 0.5 * side * unit);
            let shape = Shape::Box { half_extents, edge_radius: b.edge_radius * unit };
            let (name, friction) = (b.name.as_ref(), b.friction);
            add("box", index, Parts { name, shape, center: b.center, turn: b.turn, friction });
        }
        for (index, c) in colliders.cylinder.iter().enumerate() {
            let shape = Shape::Cylinder {
                radius: c.radius * unit,
                half_height: 0.5 * c.height * unit,
                edge_radius: c.edge_radius * unit,
            };
            let (name, friction) = (c.name.as_ref(), c.friction);
            add("cylinder", index, Parts { name, shape, center: c.center, turn: c.turn, friction });
        }
        for (index, p) in colliders.plane.iter().enumerate() {
            let (name, shape, friction) = (p.name.as_ref(), Shape::Plane, p.friction);
            add("plane", index, Parts { name, shape, center: p.center, turn: p.turn, friction });
        }
        for (index, m) in colliders.mesh.iter().enumerate() {
            match Mesh::load(folder.join(&m.file), m.scale.unwrap_or(unit)) {
                Ok(mesh) => {
                    let (name, shape) = (m.name.as_ref(), Shape::Mesh(mesh));
                    let friction = m.friction;
                    add(
                        "mesh",
                        index,
                        Parts { name, shape, center: m.center, turn: m.turn, friction },
                    );
                }
                Err(error) => {
                    let key = format!("collider.mesh[{index}].file");
                    self.mistakes.push(self.document.at(&key, error.to_string()));
                }
            }
        }
        bodies
    }

    fn pin(
        &mut self,
        index: usize,
        pin: &PinFile,
        (panels, unit): (&[Panel], f64),
        held: &mut [bool],
    ) {
        let key = format!("pin[{index}]");
        let names: Vec<&str> = panels.iter().map(|p| p.name.as_str()).collect();
        let Some(panel) = panels.iter().find(|p| p.name == pin.panel) else {
            let help = format!("the panels of this scene are: {}", names.join(", "));
            self.fail(
                &format!("{key}.panel"),
                format!("there is no panel \"{}\"", pin.panel),
                &help,
            );
            return;
        };
        let coordinates = &panel.lattice.coordinates;
        let [across, along] = panel.lattice.spacing;
        for (number, point) in pin.points.iter().enumerate() {
            let [u, v] = point.map(|x| x * unit);
            let distance = |c: &[f64; 2]| (c[0] - u).hypot(c[1] - v);
            let by_distance = |a: &usize, b: &usize| {
                distance(&coordinates[*a]).total_cmp(&distance(&coordinates[*b]))
            };
            let nearest = (0..coordinates.len()).min_by(by_distance);
            match nearest {
                Some(nearest) if distance(&coordinates[nearest]) <= across.hypot(along) => {
                    held[panel.first + nearest] = true;
                }
                _ => {
                    let message = format!("{point:?} is not on panel \"{}\"", panel.name);
                    let help = "places are weft × warp from the lower left corner of a rectangle, \
                                from the middle of a disc";
                    self.fail(&format!("{key}.points[{number}]"), message, help);
                }
            }
        }
        if let Some(edge) = pin.edge.as_deref() {
            let edges = [
                ("top", (1, 1.0)),
                ("bottom", (1, -1.0)),
                ("left", (0, -1.0)),
                ("right", (0, 1.0)),
            ];
            let (axis, sign) = self.choice(&format!("{key}.edge"), Some(edge), &edges);
            let extreme = coordinates.iter().map(|c| sign * c[axis]).fold(f64::MIN, f64::max);
            for (particle, c) in coordinates.iter().enumerate() {
                if sign * c[axis] > extreme - 0.5 * panel.lattice.spacing[axis] {
                    held[panel.first + particle] = true;
                }
            }
        }
        if pin.points.is_empty() && pin.edge.is_none() {
            let help = "give points = [[u, v], …] or edge = \"top\"";
            self.fail(&key, "the pin holds nothing".into(), help);
        }
    }

    fn start_is_free(&mut self, contact: &Contact, positions: &[f64]) {
        let survey = contact.survey(positions);
        if survey.inside > 0 {
            let body = survey.nearest.map_or("", |(_, body)| &contact.bodies()[body].name);
            let message = format!(
                "{} particles start inside a body (deepest {:.4} m, in {body})",
                survey.inside, -survey.min_distance
            );
            self.fail("panel", message, "move or turn the panel so that it starts outside");
        }
    }
}

/// What all bodies have in common.
struct Parts<'a> {
    name: Option<&'a String>,
    shape: Shape,
    center: [f64; 3],
    turn: [f64; 3],
    friction: Option<f64>,
}

/// The pose that turns as a panel does.
fn pose(center: [f64; 3], turn: [f64; 3]) -> Pose {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let turns = axes.into_iter().zip(turn).filter(|(_, angle)| *angle != 0.0);
    let pose =
        turns.fold(Pose::new(center), |pose, (axis, angle)| pose.turned(axis, angle.to_radians()));
    debug_assert!(turned([0.0; 3], turn) == [0.0; 3]);
    pose
}

fn hash(document: &Document, materials: &[Material]) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(document.text().as_bytes());
    for material in materials {
        hasher.update(material.fabric.to_toml().as_bytes());
    }
    hasher.finalize().to_hex().to_string()
}
