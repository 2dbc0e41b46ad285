//! Readers of every kind of file, with what the program then does with the content.

use std::path::{Path, PathBuf};

use drape::collide::{Mesh, MeshInspection, PointCache, RepairSettings, read_mesh, repair};
use drape::dynamics::{Progress, Simulation};
use drape::fabric::Fabric;
use drape::input::Document;
use drape::kes::Sheet;
use drape::pattern::{Cutter, Pattern};
use drape::scene::Scene;
use drape::verify::Verifier;

pub const FABRIC: &str = include_str!("../fabrics/plain-weave.toml");

/// Sheet of one curve.
pub const SHEET: &str = r#"name = "linen"
W = 18.0
T = 0.4
B = "0.118 ± 0.006"
[[curve]]
test = "bending"
direction = "warp"
file = "bending.csv"
deformation = { column = "curvature", unit = "1/cm" }
load = { column = "moment", unit = "gf.cm/cm" }
"#;

pub const CURVE: &str =
    "curvature,moment\n0,0\n0.5,0.11\n1,0.2\n2,0.32\n1,0.1\n0,-0.06\n-2,-0.32\n-1,-0.1\n0,0.06\n";

/// Largest number of particles of a scene that is simulated.
const PARTICLES_MAX: usize = 3000;

/// Number of steps that are simulated.
const STEPS: usize = 3;

/// Watcher that ends a run after some steps.
struct Steps(usize);

impl Progress for Steps {
    fn step(&mut self, _: &drape::dynamics::Step, _: usize) {
        self.0 += 1;
    }

    fn is_interrupted(&self) -> bool {
        self.0 >= STEPS
    }
}

/// Simulates some steps of a scene that was accepted; all that come out are finite.
pub fn simulate(scene: Scene) -> bool {
    if scene.cloth.particle_count() > PARTICLES_MAX {
        return true;
    }
    let Ok(mut simulation) = Simulation::new(scene) else { return true };
    let summary = simulation.run(&mut Steps(0));
    let frame = simulation.frame();
    assert!(frame.cloth.iter().flatten().all(|x| x.is_finite()), "a position is not finite");
    if let Ok(summary) = summary {
        serde_json::to_string(&summary).expect("a summary is JSON");
    }
    true
}

/// Reads a scene with a fabric in memory, and simulates it.
pub fn scene(text: &str, fabric: &str) -> bool {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let fabric = Document::new(root.join("plain.toml"), fabric);
    let scene = Scene::from_documents(&Document::new(root.join("scene.toml"), text), &[fabric]);
    scene.is_ok_and(simulate)
}

/// Reads a fabric, writes it, and simulates a hanging strip of it.
pub fn fabric(text: &str) -> bool {
    let Ok(fabric) = Fabric::from_document(&Document::new("plain.toml", text)) else {
        return false;
    };
    let again = fabric.to_toml();
    let strip = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
                 panel = [{ name = \"a\", fabric = \"plain\", rectangle = [0.06, 0.1] }]\n\
                 pin = [{ panel = \"a\", edge = \"top\" }]\ntime = { step = 0.005, end = 0.1 }\n";
    drop(again);
    scene(strip, text);
    true
}

/// Reads a sheet with the tables beside it.
pub fn sheet(file: &Path) -> bool {
    Sheet::read(file).is_ok()
}

/// Reads a pattern and cuts it.
pub fn pattern(file: &Path) -> bool {
    let Ok(pattern) = Pattern::read(file) else { return false };
    let _ = Cutter::new(0.02).cut(&pattern);
    true
}

/// Reads a mesh, and inspects, repairs and uses it.
pub fn mesh(file: &Path) -> bool {
    let Ok(read) = read_mesh(file) else { return false };
    let _ = MeshInspection::new(&read);
    let _ = Mesh::new(&read.vertices, &read.triangles);
    let _ = repair(&read, &RepairSettings::for_spacing(0.01));
    true
}

pub fn point_cache(file: &Path) -> bool {
    PointCache::read(file).is_ok()
}

/// Reads all frames of a run, and verifies them.
pub fn frames(folder: &Path) -> bool {
    let Ok(verifier) = Verifier::open(folder) else { return false };
    let recording = verifier.recording();
    let _ = recording.energy();
    let frames = recording.frame_count().min(4);
    (0..frames).all(|number| recording.frame(number).is_ok() & verifier.verify(number).is_ok())
}

/// Returns the path of a file of the repository.
pub fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}
