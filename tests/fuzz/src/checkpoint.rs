//! Checkpoints: damaged ones, and intact ones with other content.

use std::sync::OnceLock;

use drape::checkpoint::{Checkpoint, Identity};
use drape::dynamics::{SavedSimulation, Simulation};
use drape::input::Document;
use drape::scene::Scene;

use crate::mutation::{Random, mutated};
use crate::readers::FABRIC;

/// Length of magic, version and count.
const HEADER: usize = 16;

/// Length of a checksum.
const CHECKSUM: usize = 32;

/// Number of steps after a checkpoint is read.
const STEPS: usize = 2;

/// Makes a simulation with contact, friction and pins.
fn simulation() -> Simulation {
    let text = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
                panel = [{ name = \"a\", fabric = \"plain\", rectangle = [0.04, 0.04] }]\n\
                collider.sphere = [{ radius = 0.02, center = [0, 0, -0.021] }]\n\
                [time]\nstep = 0.005\nend = 1\n";
    let fabric = Document::new("plain.toml", FABRIC);
    let scene = Scene::from_documents(&Document::new("scene.toml", text), &[fabric]);
    Simulation::new(scene.expect("it is right")).expect("it begins")
}

/// Returns the bytes of a checkpoint.
fn whole() -> &'static [u8] {
    static WHOLE: OnceLock<Vec<u8>> = OnceLock::new();
    WHOLE.get_or_init(|| {
        let mut simulation = simulation();
        for _ in 0..3 {
            simulation.step().expect("it is solved");
        }
        let mut checkpoint = Checkpoint::new(Identity::new("fuzz"));
        simulation.saved().write(&mut checkpoint).expect("it is encoded");
        let mut bytes = Vec::new();
        checkpoint.encode(&mut bytes).expect("memory can be written");
        bytes
    })
}

/// Returns the bytes of a checkpoint with mutations.
pub fn damaged(seed: u64) -> Vec<u8> {
    mutated(whole(), seed)
}

/// Returns a number of bytes from a place on.
fn array<const N: usize>(bytes: &[u8], at: usize) -> Option<[u8; N]> {
    bytes.get(at..at.checked_add(N)?)?.try_into().ok()
}

/// Returns where each section begins, where its content does, and where its checksum.
fn sections(bytes: &[u8]) -> Option<Vec<[usize; 3]>> {
    let count = u32::from_le_bytes(array(bytes, HEADER - 4)?);
    let (mut all, mut at) = (Vec::new(), HEADER);
    for _ in 0..count {
        let content = at + 10 + usize::from(u16::from_le_bytes(array(bytes, at)?));
        let length = u64::from_le_bytes(array(bytes, content - 8)?);
        let end = content.checked_add(usize::try_from(length).ok()?)?;
        bytes.get(end..end.checked_add(CHECKSUM)?)?;
        all.push([at, content, end]);
        at = end + CHECKSUM;
    }
    Some(all)
}

/// Makes all checksums right, where there is room for them.
fn seal(bytes: &mut [u8]) -> Option<()> {
    for [start, _, end] in sections(bytes)? {
        let checksum = blake3::hash(&bytes[start..end]);
        bytes[end..end + CHECKSUM].copy_from_slice(checksum.as_bytes());
    }
    let end = bytes.len().checked_sub(CHECKSUM)?;
    let checksum = blake3::hash(&bytes[..end]);
    bytes[end..].copy_from_slice(checksum.as_bytes());
    Some(())
}

/// Returns the bytes of a checkpoint with mutations in the content of one section.
pub fn sealed(seed: u64) -> Vec<u8> {
    let mut bytes = whole().to_vec();
    let all = sections(&bytes).expect("it is intact");
    let [_, content, end] = all[Random(!seed).below(all.len())];
    let changed = mutated(&bytes[content..end], seed);
    bytes.splice(content - 8..end, [&(changed.len() as u64).to_le_bytes()[..], &changed].concat());
    bytes
}

/// Reads bytes: none but those that were written are a checkpoint.
pub fn decode(bytes: &[u8]) {
    if let Ok(read) = Checkpoint::decode(bytes) {
        let mut again = Vec::new();
        read.encode(&mut again).expect("memory can be written");
        assert_eq!(again, bytes, "other bytes are read as a checkpoint");
    }
}

/// Resumes a simulation from bytes whose checksums are made right, and takes some steps.
pub fn resume(bytes: &[u8]) {
    let mut bytes = bytes.to_vec();
    if seal(&mut bytes).is_none() {
        return;
    }
    let Ok(checkpoint) = Checkpoint::decode(&bytes) else { return };
    let Ok(saved) = SavedSimulation::read(&checkpoint) else { return };
    let mut simulation = simulation();
    if simulation.resume(saved).is_err() {
        return;
    }
    for _ in 0..STEPS {
        if simulation.step().is_err() {
            return;
        }
    }
    let _ = simulation.saved();
}
