//! Needs: the memory and the disk that a run of a scene takes.

use drape_collide::Shape;

use crate::check::memory::BASE;
use crate::scene::Scene;
use crate::scene::motion::BodyMotion;

/// Memory that a run takes for a particle and a vertex of a body, in bytes: the former between 4.4
/// kB for cloth that hangs and 8 kB for cloth on a body.
const MEMORY: [u64; 2] = [8_000, 1_500];

/// Disk that a frame takes for a particle and a vertex of a body that moves, in bytes: positions,
/// and pressures of particles.
const FRAME: [u64; 2] = [26, 24];

/// Disk that a run takes once for a particle and a vertex of a body, in bytes: the topology, the
/// last frame, a page to look at, and one or two checkpoints of 650 to 800 bytes for a particle and
/// 120 for a vertex.
const ONCE: [u64; 2] = [1_200, 240];

/// Memory and disk that a run of a scene takes, about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Needs {
    /// Memory, in bytes.
    pub memory: u64,
    /// Number of frames, at most if the run ends at rest.
    pub frames: u64,
    /// Whether the run may end earlier, at rest.
    pub may_rest: bool,
    /// Disk for what is stored once, in bytes.
    pub disk_once: u64,
    /// Disk for each frame, in bytes.
    pub disk_per_frame: u64,
}

impl Needs {
    /// Returns the disk for all frames, in bytes.
    #[must_use]
    pub fn disk(&self) -> u64 {
        self.disk_per_frame.saturating_mul(self.frames).saturating_add(self.disk_once)
    }

    /// Returns the disk without which a run cannot end, in bytes: one that may end at rest stores
    /// two frames at least.
    #[must_use]
    pub fn disk_min(&self) -> u64 {
        let frames = if self.may_rest { self.frames.min(2) } else { self.frames };
        self.disk_per_frame.saturating_mul(frames).saturating_add(self.disk_once)
    }
}

impl Scene {
    /// Returns the memory and the disk that a run takes, about.
    #[must_use]
    pub fn needs(&self) -> Needs {
        let clock = &self.schedule.clock;
        let particles = self.cloth.particle_count() as u64;
        let (mut vertices, mut moving) = (0u64, 0u64);
        for body in &self.bodies {
            let count = match (&body.motion, &body.body.shape) {
                (Some(BodyMotion::Shapes(_)), Shape::Mesh(mesh)) => mesh.source_vertices().len(),
                _ => body.body.triangulate().map_or(0, |outline| outline.vertices.len()),
            };
            vertices = vertices.saturating_add(count as u64);
            if body.motion.is_some() {
                moving = moving.saturating_add(count as u64);
            }
        }
        let sum = |[of_particle, of_vertex]: [u64; 2], vertices: u64| {
            let of_vertices = of_vertex.saturating_mul(vertices);
            of_particle.saturating_mul(particles).saturating_add(of_vertices)
        };
        let frames = clock.end_ticks() / clock.ticks_per_frame.max(1);
        Needs {
            memory: sum(MEMORY, vertices).saturating_add(BASE),
            frames: (frames as u64).saturating_add(1),
            may_rest: self.schedule.relaxation.is_some(),
            disk_once: sum(ONCE, vertices),
            disk_per_frame: sum(FRAME, moving),
        }
    }
}
