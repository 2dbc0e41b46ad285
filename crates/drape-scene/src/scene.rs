//! Scene: everything that a simulation needs, checked and in SI units.
//!
//! These are plain values. The chapter `check` makes them of a file and looks at their start;
//! `drape-dynamics` makes a world of them and lets it move. Nothing here reads a file or changes in
//! time.

pub(crate) mod clock;
pub(crate) mod contact;
pub(crate) mod garment;
pub(crate) mod material;
pub(crate) mod model;
pub(crate) mod motion;
pub(crate) mod panel;
pub(crate) mod pin;
pub(crate) mod relaxation;
pub(crate) mod seam;
pub(crate) mod solver;
mod soundness;

use std::path::PathBuf;

use drape_input::Advice;

use drape_cloth::{Breen, Cloth};
use drape_collide::{Body, MeshInspection, ParticleContact};

use self::clock::Clock;
use self::contact::ContactSettings;
use self::garment::{Garment, Sewing};
use self::material::Material;
use self::motion::BodyMotion;
use self::panel::Panel;
use self::pin::Pin;
use self::relaxation::Relaxation;
use self::solver::SolverSettings;

/// Scene that has been read and checked: everything that a simulation needs, in SI units.
///
/// ```
/// use drape_input::Document;
/// use drape_scene::Scene;
///
/// let fabric = Document::new("plain.toml", r#"
///     name = "plain weave"
///     density = 0.12
///     thickness = 0.0003
///     shear.stiffness = 35
///     [warp.traction.primed]
///     stiffness = 5000
///     toe_ratio = 0.7
///     toe_strain = 0.01
///     toe_strain_after = 0.015
///     [warp]
///     bending.rigidity = 1.2e-5
///     [weft.traction.primed]
///     stiffness = 4000
///     toe_ratio = 0.7
///     toe_strain = 0.02
///     toe_strain_after = 0.03
///     [weft]
///     bending.rigidity = 0.8e-5
/// "#);
/// let text = r#"
///     spacing = 0.02
///     fabric.plain.file = "plain.toml"
///     panel = [{ name = "towel", fabric = "plain", rectangle = [0.2, 0.3] }]
///     pin = [{ panel = "towel", edge = "top" }]
///     time = { step = 0.005, end = 2 }
/// "#;
/// let scene = Scene::from_documents(&Document::new("towel.toml", text), &[fabric.clone()])?;
/// assert_eq!((scene.panels.len(), scene.cloth.particle_count()), (1, 11 * 16));
///
/// // A mistake is answered with its file, its line and the value.
/// let text = text.replace("step = 0.005", "step = -1");
/// let mistake = Scene::from_documents(&Document::new("towel.toml", text), &[fabric]);
/// let message = mistake.expect_err("a step is positive").to_string();
/// assert!(message.contains("towel.toml:6") && message.contains("-1 s is not between"));
/// # Ok::<(), drape_scene::Error>(())
/// ```
#[derive(Debug)]
pub struct Scene {
    /// Name, for people.
    pub name: String,
    /// File that it was read from.
    pub source: Source,
    /// Fabrics, in the order of their names.
    pub materials: Vec<Material>,
    /// Panels of the file in its order, then the panels of garments.
    pub panels: Vec<Panel>,
    /// Garments, in the order of the file.
    pub garments: Vec<Garment>,
    /// All panels as one cloth.
    pub cloth: Cloth,
    /// Cloth in the model of Breen, if the scene asks for it: then the laws of `cloth` have no
    /// friction.
    pub breen: Option<Breen>,
    /// Sewing of the garments, if there are seams.
    pub sewing: Option<Sewing>,
    /// State of the particles at the start.
    pub start: Start,
    /// Pins, in the order of the file.
    pub pins: Vec<Pin>,
    /// Bodies by their kind: spheres, boxes, cylinders, planes, rigid meshes, and meshes that
    /// change their shape; within a kind in the order of the file.
    pub bodies: Vec<MovingBody>,
    /// Contact of cloth and bodies.
    pub contact: ContactSettings,
    /// Gravity and air.
    pub environment: Environment,
    /// Times of the simulation.
    pub schedule: Schedule,
    /// Settings of the solver.
    pub solver: SolverSettings,
    /// Results that the scene asks for.
    pub output: Output,
    /// The scene on coarser grids, from the coarsest on, on which the cloth comes to rest first.
    pub coarser: Vec<Scene>,
}

/// Source of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// File that was read.
    pub file: PathBuf,
    /// Hash of the scene and of all files it names.
    pub hash: String,
    /// The same part by part, by which a change is named: the text, each fabric, the cloth at its
    /// start, each body.
    pub parts: Vec<SourcePart>,
    /// Notes for the user: on patterns, bodies, layers, and the cost of the simulation.
    pub notes: Vec<Advice>,
    /// What contact cannot promise on the bodies, a sentence each: where a body passes through its
    /// own surface.
    pub contact_limits: Vec<Advice>,
    /// Folder of the run that panels are graded by, if they are.
    pub graded_by: Option<PathBuf>,
}

impl Source {
    /// Returns the notes in a line each, with remedies in words of the libraries.
    #[must_use]
    pub fn note_lines(&self) -> Vec<String> {
        self.notes.iter().map(Advice::to_string).collect()
    }
}

/// Part of what a scene was read from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourcePart {
    /// What it is, in words.
    pub name: String,
    /// BLAKE3 digest of its content.
    pub digest: [u8; 32],
}

/// State of the particles at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// Positions, three numbers for each particle, in m.
    pub positions: Vec<f64>,
    /// Velocities, three numbers for each particle, in m/s.
    pub velocities: Vec<f64>,
}

/// Body and its motion.
#[derive(Debug, Clone)]
pub struct MovingBody {
    /// Shape, and pose at the start.
    pub body: Body,
    /// Motion; none if it stays.
    pub motion: Option<BodyMotion>,
    /// Where it comes from, if it is a mesh.
    pub source: Option<MeshSource>,
}

/// File of a body that is a mesh, and what was found in it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSource {
    /// File.
    pub file: PathBuf,
    /// Length of a unit of its coordinates, in m.
    pub scale: f64,
    /// The mesh at its place at the start.
    pub inspection: MeshInspection,
}

/// Surroundings of the cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Environment {
    /// Acceleration of gravity, in m/s².
    pub gravity: [f64; 3],
    /// Half the air's density times the drag coefficient, in kg/m³.
    pub air: f64,
}

/// Times of a simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Schedule {
    /// Steps and their end.
    pub clock: Clock,
    /// Relaxation, where the cloth is to come to rest.
    pub relaxation: Option<Relaxation>,
    /// Time for which bodies and pins move once the cloth is at rest, in s; without one they move
    /// from the start.
    pub motion_seconds: Option<f64>,
}

/// Results that a scene asks for.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Folder for them, if the scene names one.
    pub folder: Option<PathBuf>,
    /// View of the picture.
    pub view: View,
}

/// Direction from which a picture is taken, where the scene names one.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct View {
    /// Azimuth, in degrees.
    pub azimuth: Option<f64>,
    /// Elevation, in degrees.
    pub elevation: Option<f64>,
}

impl Scene {
    /// Returns which particles are held in all directions at the start.
    #[must_use]
    pub fn held_particles(&self) -> Vec<bool> {
        let mut held = vec![false; self.cloth.particle_count()];
        let pins = self.pins.iter().filter(|pin| pin.holds_all_axes());
        pins.flat_map(|pin| &pin.particles).for_each(|&particle| held[particle] = true);
        held
    }

    /// Returns the smallest distance of neighbouring particles, in m.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.panels.iter().flat_map(|panel| panel.lattice.spacing()).fold(f64::INFINITY, f64::min)
    }

    /// Returns the index of the garment of a panel.
    pub(crate) fn garment_of(&self, panel: &Panel) -> Option<usize> {
        self.garments.iter().position(|garment| garment.particles.contains(&panel.first))
    }

    /// Returns the numbers of the panels of `garment`, in the order of [`Scene::panels`].
    pub(crate) fn panels_of(&self, garment: &Garment) -> Vec<usize> {
        let panels = self.panels.iter().enumerate();
        let of_garment = panels.filter(|(_, panel)| garment.particles.contains(&panel.first));
        of_garment.map(|(number, _)| number).collect()
    }

    /// Returns the triangles of `panel`, as particle numbers. The triangles of a cloth are in the
    /// order of its panels.
    pub(crate) fn triangles_of(&self, panel: &Panel) -> &[[u32; 3]] {
        let triangles = self.cloth.triangles();
        let particles = panel.particles();
        let [start, end] = [particles.start, particles.end]
            .map(|first| triangles.partition_point(|triangle| (triangle[0] as usize) < first));
        &triangles[start..end]
    }

    /// Returns the contact of the particles with the bodies at the start.
    ///
    /// # Errors
    /// Settings or bodies that make no contact.
    pub fn particle_contact(&self) -> Result<ParticleContact, drape_collide::Error> {
        let bodies = self.bodies.iter().map(|moving| moving.body.clone()).collect();
        ParticleContact::new(bodies, self.contact.particles, self.cloth.areas().to_vec())
    }
}
