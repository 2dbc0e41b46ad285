use super::Simulation;
use crate::summary::{Contacts, Solver, Strain, Summary};
use crate::world::World;

impl Simulation {
    /// How the run has gone so far.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let World { cloth, state, contact, .. } = &self.world;
        let strains = cloth.strains(state);
        let survey = contact.survey(&state.positions);
        Summary {
            status: self.status.clone(),
            version: env!("CARGO_PKG_VERSION").into(),
            scene_hash: self.scene_hash.clone(),
            particles: cloth.particles(),
            steps: self.steps,
            simulated_seconds: self.time(),
            wall_seconds: self.stopwatch.wall_seconds(),
            cpu_seconds: self.stopwatch.cpu_seconds(),
            threads: rayon::current_num_threads(),
            solver: Solver {
                iterations_mean: self.iterations as f64 / self.steps.max(1) as f64,
                ..self.solver
            },
            energy: self.energy(),
            strain: Strain {
                traction_max: strains.traction_max,
                traction_p99: strains.traction_p99,
                shear_max: strains.shear_max,
                curvature_p99: strains.curvature_p99,
            },
            contact: Contacts {
                pairs_max: self.pairs_max,
                min_distance: Some(survey.min_distance).filter(|d| d.is_finite()),
                intersections: survey.inside,
            },
            settled: self.settled(),
            speed_max: self.speed_max,
            imbalance: self.imbalance,
            state_hash: self.state_hash(),
            measures: serde_json::Map::new(),
        }
    }

    /// Hash of positions, velocities and memories to the last bit.
    #[must_use]
    pub fn state_hash(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        let state = &self.world.state;
        for value in state.positions.iter().chain(&state.velocities) {
            hasher.update(&value.to_le_bytes());
        }
        for memory in state.memories() {
            let [first, second] = memory.friction;
            for value in [memory.position, first, second, memory.peak] {
                hasher.update(&value.to_le_bytes());
            }
        }
        hasher.finalize().to_hex().to_string()
    }
}
