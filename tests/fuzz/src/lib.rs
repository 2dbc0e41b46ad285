//! Targets that are tried with bytes: each of them panics where what it promises does not hold.

mod checkpoint;
mod files;
mod kernels;
#[path = "../../faults/mutation.rs"]
#[allow(dead_code, reason = "the sweep of faults uses the others")]
pub mod mutation;
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

const fn random(name: &'static str, run: fn(&[u8])) -> Target {
    Target { name, seeds: Seeds::Random, run }
}

pub const TARGETS: [Target; 18] = [
    file("scene", files::scene),
    file("fabric", files::fabric),
    file("csv", files::table),
    file("pattern", |bytes| files::pattern("pattern.toml", bytes)),
    file("garmentcode", |bytes| files::pattern("pattern.json", bytes)),
    file("freesewing", |bytes| files::pattern("pattern.json", bytes)),
    file("obj", |bytes| files::mesh("mesh.obj", bytes)),
    file("stl", |bytes| files::mesh("mesh.stl", bytes)),
    file("ply", |bytes| files::mesh("mesh.ply", bytes)),
    file("pc2", files::point_cache),
    file("npy", |bytes| files::frames("frame-00001.npy", bytes)),
    file("manifest", |bytes| files::frames("surfaces.json", bytes)),
    Target { name: "checkpoint", seeds: Seeds::Made(checkpoint::damaged), run: checkpoint::decode },
    Target { name: "state", seeds: Seeds::Made(checkpoint::sealed), run: checkpoint::resume },
    random("crossing", kernels::crossing),
    random("distance", kernels::distance),
    random("filter", step_filter::filter),
    random("simulation", simulation::simulate),
];

/// Returns the target of a name.
#[must_use]
pub fn target(name: &str) -> Option<Target> {
    TARGETS.into_iter().find(|target| target.name == name)
}
