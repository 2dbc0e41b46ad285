use std::ops::Range;
use std::path::{Path, PathBuf};

use drape_cloth::{Breen, Cloth, Lattice};
use drape_collide::{Body, ParticleContact, Shape};
use drape_fabric::Fabric;
use drape_input::{Diagnostic, Diagnostics, Document};

use crate::clock::Clock;
use crate::collider::Moving;
use crate::contact::ContactSettings;
use crate::cost::cost;
use crate::course::Course;
use crate::error::Error;
use crate::file::SceneFile;
use crate::material::{FabricRequest, Material, read_fabric};
use crate::model::Model;
use crate::panel::{Laid, Panel};
use crate::pin::Pin;
use crate::reader::{FabricReader, Reader};
use crate::settle::Settle;
use crate::sewing::Sewing;
use crate::solver::SolverSettings;
use crate::surfaces::StartSurfaces;
use crate::tangle::Tangle;

/// Density of air at 20 °C and sea level, in kg/m³.
const AIR_DENSITY: f64 = 1.2;

/// Drag coefficient of a flat plate across the flow.
const AIR_DRAG: f64 = 1.28;

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
    /// The same in the model of Breen, if the scene asks for it: then the laws of the cloth have no friction.
    pub breen: Option<Breen>,
    /// Positions of the particles at the start, three numbers each, in m.
    pub positions: Vec<f64>,
    /// Their velocities, likewise, in m/s.
    pub velocities: Vec<f64>,
    /// Particles that are held.
    pub held: Vec<bool>,
    /// What each pin holds, and how that moves, in the order of the file.
    pub pins: Vec<Pin>,
    /// The bodies, in the order of the file.
    pub bodies: Vec<MovingBody>,
    /// How cloth and bodies touch.
    pub contact: ContactSettings,
    /// Acceleration of gravity, in m/s².
    pub gravity: [f64; 3],
    /// Half the air's density times the drag coefficient, in kg/m³.
    pub air: f64,
    /// Steps and their end.
    pub clock: Clock,
    /// Where the simulation is to come to rest: how it gets there, and when it is.
    pub settle: Option<Settle>,
    /// How long bodies and pins move when the cloth has come to rest, in s; they move from the start if there is none.
    pub motion_seconds: Option<f64>,
    /// How the steps are solved.
    pub solver: SolverSettings,
    /// Names of the garments, their own or after their patterns, and which particles are theirs.
    pub garments: Vec<(String, Range<usize>)>,
    /// How the seams are sewn, if there are some.
    pub sewing: Option<Sewing>,
    /// What the user should know about the patterns.
    pub notes: Vec<String>,
    /// Whether the energies are accounted for.
    pub energy: bool,
    /// Folder for the results that the scene asks for.
    pub folder: Option<PathBuf>,
    /// From where the picture is taken, azimuth and elevation in degrees, where the scene says so.
    pub view: [Option<f64>; 2],
    /// Hash of the scene and of all files it names.
    pub hash: String,
}

/// A body and how it moves.
#[derive(Debug, Clone)]
pub struct MovingBody {
    /// Its form, and its place at the start.
    pub body: Body,
    /// Its way; none if it stays.
    pub course: Option<Course>,
}

impl Scene {
    /// Reads a scene and everything it names, without simulating. Its fabrics are in files of fabrics.
    ///
    /// # Errors
    /// All mistakes that could be found, each with file, line, value and remedy; with them the triangles that cross at
    /// the start, if some do.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::read_with(path, &read_fabric)
    }

    /// The same with another reader of fabrics, which may make them of other files.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn read_with(path: impl AsRef<Path>, fabric: FabricReader<'_>) -> Result<Self, Error> {
        let document = Document::read(path)?;
        let file: SceneFile = document.decode()?;
        Reader::new(&document, &[], fabric).scene(file)
    }

    /// Contact of the particles with the bodies at the start.
    ///
    /// # Errors
    /// Settings or bodies that are none.
    pub fn particle_contact(&self) -> Result<ParticleContact, drape_collide::Error> {
        let bodies = self.bodies.iter().map(|moving| moving.body.clone()).collect();
        ParticleContact::new(bodies, self.contact.particles, self.cloth.areas().to_vec())
    }

    /// The same for a scene in memory. A fabric whose path, seen from the scene's folder, is that of
    /// one of the documents is taken from there.
    ///
    /// # Errors
    /// As for [`Scene::read`].
    pub fn from_documents(scene: &Document, fabrics: &[Document]) -> Result<Self, Error> {
        let file: SceneFile = scene.decode()?;
        Reader::new(scene, fabrics, &read_fabric).scene(file)
    }
}

impl Reader<'_> {
    fn scene(mut self, file: SceneFile) -> Result<Scene, Error> {
        let unit = self.unit(file.length.as_deref());
        let folder = self.document.path().parent().unwrap_or(Path::new("")).to_owned();
        let model = self.model(&file);
        let materials = self.materials(&file, &folder, model);
        let mut laid = self.panels(&file, &materials, unit);
        let count = laid.iter().map(|laid| laid.positions.len() / 3).sum();
        let garments = self.garments((&file, &folder), &materials, (count, unit));
        let (mut seams, mut notes, mut costs) = (Vec::new(), Vec::new(), None);
        let plain = laid.len();
        let mut worn = Vec::new();
        for garment in garments {
            worn.extend(garment.particles().map(|own| (garment.name, own)));
            laid.extend(garment.panels);
            seams.extend(garment.seams);
            notes.extend(garment.notes);
        }
        self.names_differ(&file, &laid);
        let clock = self.clock(&file, unit);
        let spacings = laid.iter().flat_map(|laid| laid.panel.lattice.spacing);
        let spacing = spacings.fold(f64::INFINITY, f64::min);
        let settle = self.settle(&file, (spacing.min(1.0), unit));
        let motion_seconds = self.motion_phase(&file);
        let solver = self.solver(&file);
        let air = self.air(&file);
        let gravity = file.gravity.unwrap_or([0.0, -9.81, 0.0]);
        if gravity.iter().any(|g| !g.is_finite()) {
            self.fail("gravity", format!("{gravity:?} is not finite"), "in m/s², [0, -9.81, 0]");
        }
        let bodies = self.bodies(&file, &folder, unit);
        self.near_a_body(&laid[plain..], &bodies);
        if file.keeps_apart() {
            self.speeds(&bodies, (clock.step, spacing));
        }
        let contact = self.contact(&file, (unit, spacing), (clock.step, clock.end));
        // What follows needs sound panels.
        Diagnostics::check(std::mem::take(&mut self.mistakes))?;

        let pairs: Vec<_> = laid
            .iter()
            .map(|Laid { panel, .. }| {
                let material = materials[panel.material].as_ref();
                (&panel.lattice, &material.expect("mistakes were reported").fabric)
            })
            .collect();
        let sewing = self.sewing(&file, seams, &pairs);
        let breen = (model == Model::Breen1994).then(|| Breen::new(&pairs)).transpose();
        if let Err(error) = &breen {
            Diagnostics::check(vec![self.document.at("model", error.to_string())])?;
        }
        let breen = breen.ok().flatten();
        let cloth = match model {
            Model::Kes => Cloth::new(&pairs),
            Model::Breen1994 => without_friction(&pairs),
        };
        let ties = sewing.iter().flat_map(|sewing| &sewing.stitching.ties);
        let cloth = cloth.with_ties(ties);
        let materials: Vec<Material> = materials.into_iter().flatten().collect();
        let positions: Vec<f64> = laid.iter().flat_map(|laid| &laid.positions).copied().collect();
        let mut velocities: Vec<f64> =
            laid.iter().flat_map(|laid| &laid.velocities).copied().collect();
        let panels: Vec<Panel> = laid.into_iter().map(|laid| laid.panel).collect();
        let pins = file.pin.iter().enumerate();
        let pins: Vec<Pin> = pins
            .filter_map(|(index, pin)| self.pin(index, pin, (&panels, unit), &positions))
            .collect();
        self.pins_let_go(&file);
        let mut held = vec![false; cloth.particles()];
        let whole = pins.iter().filter(|pin| pin.is_whole());
        whole.flat_map(|pin| &pin.particles).for_each(|&particle| held[particle] = true);
        for particle in (0..held.len()).filter(|&particle| held[particle]) {
            velocities[3 * particle..3 * particle + 3].fill(0.0);
        }
        let fallback = materials.iter().map(|m| m.fabric.surface_friction).fold(0.0, f64::max);
        let with_friction = |Moving { body, friction, course }| MovingBody {
            body: body.with_friction(friction.unwrap_or(fallback)),
            course,
        };
        let bodies: Vec<MovingBody> = bodies.into_iter().map(with_friction).collect();
        if !worn.is_empty() && settle.is_some() {
            costs = cost(cloth.particles(), spacing);
        }
        let scene = Scene {
            name: file.name.unwrap_or_else(|| "unnamed".into()),
            file: self.document.path().to_owned(),
            hash: hash(
                self.document,
                (&materials, &positions),
                &bodies,
                (&panels, sewing.as_ref()),
            ),
            materials,
            panels,
            cloth,
            breen,
            positions,
            velocities,
            held,
            pins,
            bodies,
            contact,
            gravity,
            air,
            clock,
            settle,
            motion_seconds,
            solver,
            garments: worn,
            sewing,
            notes,
            energy: file.output.energy.unwrap_or(true),
            folder: file.output.folder.map(|f| folder.join(f)),
            view: [file.output.azimuth, file.output.elevation],
        };
        self.started(scene, costs)
    }

    /// A scene whose start has been looked at, with what is left to say of it.
    fn started(mut self, mut scene: Scene, costs: Option<String>) -> Result<Scene, Error> {
        let surfaces = scene.contact.surfaces.then(|| StartSurfaces::new(&scene)).transpose();
        let surfaces =
            surfaces.map_err(|error| self.document.at("contact.surfaces", error.to_string()));
        let mut surfaces = surfaces.map_err(Diagnostics::from)?;
        let tangle = surfaces.as_mut().and_then(|surfaces| self.tangle(surfaces, &scene));
        let contact = scene.particle_contact();
        let contact = contact.map_err(|error| self.document.at("collider", error.to_string()));
        let contact = contact.map_err(Diagnostics::from)?;
        match (&surfaces, scene.contact.inflation) {
            (Some(surfaces), Some(_)) => self.start_is_outside(&surfaces.contact, &scene),
            _ => self.start_is_free(&contact, &scene.positions),
        }
        if tangle.is_none() {
            let notes = self.layers_are_in_order(&scene);
            scene.notes.extend(notes);
        }
        scene.notes.extend(costs);
        let Err(mistakes) = Diagnostics::check(self.mistakes) else { return Ok(scene) };
        Err(match tangle {
            Some((overlaps, total)) => {
                let folder = scene.folder;
                Error::Tangled(Box::new(Tangle { mistakes, folder, overlaps, total }))
            }
            None => Error::Input(mistakes),
        })
    }

    fn materials(
        &mut self,
        file: &SceneFile,
        folder: &Path,
        model: Model,
    ) -> Vec<Option<Material>> {
        if file.fabric.is_empty() {
            let help = "add [fabric.NAME] with file = \"…\", a fabric.toml or a sheet.toml";
            self.mistakes
                .push(Diagnostic::new(self.document.path(), "the scene has no fabric").help(help));
        }
        let read = |(name, entry): (&String, &crate::file::FabricFile)| {
            let path = folder.join(&entry.file);
            if let Some(document) = self.fabrics.iter().find(|given| given.path() == path) {
                let material = Material::from_document(name, document);
                return material.map_err(|e| self.mistakes.extend(e.0)).ok();
            }
            if !path.exists() {
                let message = format!("there is no file {}", path.display());
                let help = "the path is relative to the scene's folder";
                self.fail(&format!("fabric.{name}.file"), message, help);
                return None;
            }
            let file = if path.is_dir() { path.join("sheet.toml") } else { path };
            let fabric = (self.fabric)(FabricRequest { file: &file, model });
            let fabric = fabric.map_err(|e| self.mistakes.extend(e.0)).ok()?;
            Some(Material { name: name.clone(), file, fabric })
        };
        file.fabric.iter().map(read).collect()
    }

    fn air(&mut self, file: &SceneFile) -> f64 {
        let air = file.air.as_ref();
        let density = air.and_then(|a| a.density).unwrap_or(AIR_DENSITY);
        let drag = air.and_then(|a| a.drag).unwrap_or(AIR_DRAG);
        self.within("air.density", density, (0.0, 100.0), "in kg/m³; 1.2 is usual, 0 a vacuum");
        self.within("air.drag", drag, (0.0, 10.0), "1.28 for a plate");
        0.5 * density * drag
    }
}

/// A cloth that keeps the account of its strains and of nothing else.
pub(crate) fn without_friction(panels: &[(&Lattice, &Fabric)]) -> Cloth {
    let fabrics: Vec<Fabric> = panels.iter().map(|(_, fabric)| fabric.without_friction()).collect();
    let lattices = panels.iter().map(|(lattice, _)| *lattice);
    Cloth::new(&lattices.zip(&fabrics).collect::<Vec<_>>())
}

fn hash(
    document: &Document,
    (materials, positions): (&[Material], &[f64]),
    bodies: &[MovingBody],
    (panels, sewing): (&[Panel], Option<&Sewing>),
) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(document.text().as_bytes());
    for material in materials {
        hasher.update(material.fabric.to_toml().as_bytes());
    }
    let mut number = |value: f64| _ = hasher.update(&value.to_le_bytes());
    positions.iter().for_each(|&x| number(x));
    for MovingBody { body, course } in bodies {
        if let Shape::Mesh(mesh) = &body.shape {
            mesh.vertices().iter().flatten().for_each(|&x| number(x));
            mesh.triangles().iter().flatten().for_each(|&corner| number(f64::from(corner)));
        }
        if let Some(Course::Shapes(shapes)) = course {
            shapes.numbers().for_each(&mut number);
        }
    }
    for fold in panels.iter().flat_map(|panel| panel.lattice.folds()) {
        fold.ends.iter().flatten().chain([&fold.angle]).for_each(|&x| number(x));
    }
    let seams = sewing.iter().flat_map(|sewing| &sewing.seams);
    seams.filter(|seam| seam.angle != 0.0).for_each(|seam| number(seam.angle));
    hasher.finalize().to_hex().to_string()
}
