//! Targets that are tried with bytes: each of them panics where what it promises does not hold.

mod checkpoint;
mod constructors;
mod files;
mod kernels;
#[path = "../../faults/mutation.rs"]
#[allow(dead_code, reason = "the sweep of faults uses the others")]
pub mod mutation;
mod packed;
mod rational;
#[path = "../../faults/readers.rs"]
#[allow(dead_code, reason = "the sweep of faults uses the others")]
mod readers;
mod shapes;
mod simulation;
mod step_filter;

/// Where the bytes of a target come from without a fuzzer.
#[derive(Clone, Copy)]
pub enum Seeds {
    /// Mutations of the files of its folder of the corpus.
    Corpus,
    /// Mutations of bytes that are made.
    Made(fn(u64) -> Vec<u8>),
    /// Random bytes.
    Random,
}

/// Target: its name, the source of its bytes, and what is done with them.
#[derive(Clone, Copy)]
pub struct Target {
    pub name: &'static str,
    pub seeds: Seeds,
    pub run: fn(&[u8]),
}

const fn file(name: &'static str, run: fn(&[u8])) -> Target {
    Target { name, seeds: Seeds::Corpus, run }
}

const fn made(name: &'static str, bytes: fn(u64) -> Vec<u8>, run: fn(&[u8])) -> Target {
    Target { name, seeds: Seeds::Made(bytes), run }
}

const fn random(name: &'static str, run: fn(&[u8])) -> Target {
    Target { name, seeds: Seeds::Random, run }
}

pub const TARGETS: [Target; 26] = [
    file("scene", files::scene),
    file("fabric", files::fabric),
    file("csv", files::table),
    file("sheet", files::sheet),
    file("results", |bytes| files::draft("results.csv", bytes)),
    made("workbook", packed::workbook, |bytes| files::draft("results.xlsx", bytes)),
    made("ods", packed::open_document, |bytes| files::draft("bending.ods", bytes)),
    file("svg", |bytes| files::pattern("pattern.svg", bytes)),
    file("dxf", |bytes| files::pattern("pattern.dxf", bytes)),
    made("run", files::damaged_run, files::run),
    file("pattern", |bytes| files::pattern("pattern.toml", bytes)),
    file("garmentcode", |bytes| files::pattern("pattern.json", bytes)),
    file("freesewing", |bytes| files::pattern("pattern.json", bytes)),
    file("obj", |bytes| files::mesh("mesh.obj", bytes)),
    file("stl", |bytes| files::mesh("mesh.stl", bytes)),
    file("ply", |bytes| files::mesh("mesh.ply", bytes)),
    file("pc2", files::point_cache),
    file("npy", |bytes| files::frames("frame-00001.npy", bytes)),
    file("manifest", |bytes| files::frames("surfaces.json", bytes)),
    made("checkpoint", checkpoint::damaged, checkpoint::decode),
    made("state", checkpoint::sealed, checkpoint::resume),
    random("crossing", kernels::crossing),
    random("distance", kernels::distance),
    random("filter", step_filter::filter),
    random("simulation", simulation::simulate),
    random("constructors", constructors::call),
];

/// Returns the target of a name.
#[must_use]
pub fn target(name: &str) -> Option<Target> {
    TARGETS.into_iter().find(|target| target.name == name)
}
