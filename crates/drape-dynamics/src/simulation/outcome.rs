use drape_cloth::SeamState;
use drape_collide::PairDistance;
use drape_implicit::{Error, Stop};

use super::Simulation;
use crate::summary::{Contacts, Solver, Status, Strain, Summary};
use crate::surfaces::Surfaces;
use crate::world::World;

impl Simulation {
    /// How the run has gone so far.
    #[must_use]
    pub fn summary(&self) -> Summary {
        let World { cloth, state, .. } = &self.world;
        let strains = cloth.strains(state);
        Summary {
            status: self.status.clone(),
            reason: self.reason.clone(),
            version: env!("CARGO_PKG_VERSION").into(),
            scene_hash: self.scene_hash.clone(),
            particles: cloth.particles(),
            phases: self.phases.clone(),
            steps: self.steps,
            frames: self.frames + 1,
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
            contact: self.contacts(),
            settled: self.settled(),
            speed_max: self.speed_max,
            imbalance: self.imbalance,
            state_hash: self.state_hash(),
            warnings: self.warnings.clone(),
            measures: self.measures.clone(),
        }
    }

    /// Takes note of why a step could not be made.
    pub(super) fn fail(&mut self, error: &Error) {
        self.status = match error {
            Error::NotConverged { stop: Stop::Intersection, .. } => Status::CertificateFailed,
            _ => Status::SolverFailed,
        };
        let tight = self.tightest().map(|place| format!("; {place}")).unwrap_or_default();
        self.reason = Some(format!("{error}{tight}"));
    }

    /// Where surfaces are nearest to what they keep, for people.
    pub(super) fn tightest(&self) -> Option<String> {
        let Surfaces { contact, names, .. } = self.world.surfaces.as_ref()?;
        let PairDistance { pair, distance } = contact.closest_pair()?;
        let of = |vertex: u32| &names[contact.surface().group(vertex) as usize];
        let [one, other] = [pair.vertices[0], pair.vertices[3]].map(of);
        let first = 3 * pair.vertices.into_iter().min()? as usize;
        let [x, y, z] = self.world.state.positions.get(first..first + 3)?.try_into().ok()?;
        Some(format!(
            "surfaces are nearest to what they keep between \"{one}\" and \"{other}\" near ({x:.4}, {y:.4}, {z:.4}) m, \
             {:.4} of {:.4} mm",
            1e3 * distance,
            1e3 * pair.min_separation
        ))
    }

    fn contacts(&self) -> Contacts {
        let World { contact, surfaces, state, .. } = &self.world;
        let (min_distance, intersections, crossings_found) = match surfaces {
            Some(surfaces) => {
                let found = surfaces.contact.intersections_with_released(&state.positions);
                let crossings = found.map_or(usize::MAX, |found| found.len());
                (self.distance_min, crossings, surfaces.crossings)
            }
            None => {
                let summary = contact.summary(&state.positions);
                (summary.min_distance, summary.inside, 0)
            }
        };
        Contacts {
            pairs_max: self.pairs_max,
            min_distance: Some(min_distance).filter(|distance| distance.is_finite()),
            intersections,
            crossings_found,
            thinned_max: self.pinched_max[0],
            released_max: self.pinched_max[1],
            grown_from: surfaces.as_ref().map_or(1.0, |surfaces| surfaces.grown_from),
            grown: self.world.grown(),
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
        let seams = self.world.bonds.seams().into_iter().flat_map(SeamState::memories);
        for memory in state.memories().chain(seams) {
            let [first, second] = memory.friction;
            for value in [memory.position, first, second, memory.peak] {
                hasher.update(&value.to_le_bytes());
            }
        }
        hasher.finalize().to_hex().to_string()
    }
}
