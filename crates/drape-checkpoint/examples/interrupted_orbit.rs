//! A planet's orbit that is interrupted, and continued from its checkpoint to the same bits.
//!
//! `cargo run --example interrupted_orbit -p drape-checkpoint`
#![allow(clippy::print_stdout, reason = "an example prints its result")]

use drape_checkpoint::{Checkpoint, Error, Identity, Store};

/// Time step, in units in which an orbit takes 2π.
const STEP: f64 = 1e-3;

/// Position and velocity of the planet, and the number of steps so far.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Orbit {
    position: [f64; 2],
    velocity: [f64; 2],
    steps: u64,
}

impl Orbit {
    /// Returns the orbit after `count` further steps of the leapfrog method.
    fn after(mut self, count: u64) -> Self {
        for _ in 0..count {
            self.kick(0.5 * STEP);
            for axis in 0..2 {
                self.position[axis] += STEP * self.velocity[axis];
            }
            self.kick(0.5 * STEP);
            self.steps += 1;
        }
        self
    }

    /// Changes the velocity by the attraction of the sun over `time`.
    fn kick(&mut self, time: f64) {
        let cube = self.position[0].hypot(self.position[1]).powi(3);
        for axis in 0..2 {
            self.velocity[axis] -= time * self.position[axis] / cube;
        }
    }

    /// Writes the orbit to `store`.
    fn save(&self, store: &Store, identity: &Identity) -> Result<(), Error> {
        let mut checkpoint = Checkpoint::new(identity.clone());
        checkpoint.put("position", &self.position)?;
        checkpoint.put("velocity", &self.velocity)?;
        checkpoint.put("steps", &self.steps)?;
        store.write(&checkpoint)
    }

    /// Returns the orbit of `checkpoint`.
    fn restore(checkpoint: &Checkpoint) -> Result<Self, Error> {
        Ok(Self {
            position: checkpoint.get("position")?,
            velocity: checkpoint.get("velocity")?,
            steps: checkpoint.get("steps")?,
        })
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = Orbit { position: [1.0, 0.0], velocity: [0.0, 1.1], steps: 0 };
    let identity = Identity::new("orbit 1.0").with("the start", format!("{start:?}").as_bytes());
    let folder = tempfile::tempdir()?;
    let store = Store::new(folder.path());

    // The program saves its state twice. The power then fails while the second file is written.
    start.after(2_000).save(&store, &identity)?;
    start.after(4_000).save(&store, &identity)?;
    let second = folder.path().join("checkpoint-00000002.bin");
    let bytes = std::fs::read(&second)?;
    std::fs::write(&second, &bytes[..bytes.len() / 2])?;

    // The program starts again and takes the newest intact checkpoint.
    let stored = store.read()?;
    for damaged in &stored.damaged {
        println!("left out: {damaged:?}");
    }
    let checkpoint = stored.newest.ok_or("no checkpoint is intact")?;
    assert_eq!(identity.changes(checkpoint.identity()), Vec::<String>::new());
    let orbit = Orbit::restore(&checkpoint)?;
    println!("continued after {} steps", orbit.steps);
    assert_eq!(orbit.steps, 2_000);

    // The continued orbit and an uninterrupted one agree to the last bit.
    let end = orbit.after(4_000);
    assert_eq!(end, start.after(6_000));
    println!("after {} steps the planet is at {:?}", end.steps, end.position);
    Ok(())
}
