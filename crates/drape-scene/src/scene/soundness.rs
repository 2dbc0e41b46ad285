//! Soundness of a scene that a program has changed after it was checked.

use super::clock::Clock;
use super::garment::Sewing;
use super::motion::BodyMotion;
use super::relaxation::Relaxation;
use super::{MovingBody, Scene};

impl Scene {
    /// Returns the first part of the scene that does not fit the others, or is out of range, in
    /// words. A scene that was built or read has none. A program that changes a field may make one:
    /// a simulation of such a scene is refused.
    #[must_use]
    pub fn fault(&self) -> Option<String> {
        let particles = self.cloth.particle_count();
        self.clock_fault()
            .or_else(|| self.panel_fault(particles))
            .or_else(|| self.start_fault(particles))
            .or_else(|| self.sewing.as_ref().and_then(|sewing| sewing_fault(sewing, particles)))
            .or_else(|| self.body_fault())
            .or_else(|| {
                let pin = self.pins.iter().position(|pin| !pin.is_sound(particles))?;
                Some(format!("the pin {pin} names a particle that does not exist, or no number"))
            })
            .or_else(|| {
                let other = self.coarser.iter().find(|grid| grid.panels.len() != self.panels.len());
                other.map(|_| "a coarser grid has another number of panels".into())
            })
    }

    /// Returns the first fault of the clock, the relaxation or the environment of the scene.
    fn clock_fault(&self) -> Option<String> {
        let Clock { step, ticks_per_step, ticks_max, error, end, ramp, ticks_per_frame } =
            self.schedule.clock;
        let positive = |number: f64| number > 0.0 && number.is_finite();
        let not_negative = |number: f64| number >= 0.0 && number.is_finite();
        let relaxation = self.schedule.relaxation;
        let rests = |Relaxation { speed, residual, stride, .. }: Relaxation| {
            [speed, residual, stride].into_iter().all(positive)
        };

        let rules = [
            (positive(step), "the length of a step must be positive"),
            (ticks_per_step > 0, "a step must have a tick"),
            (ticks_max > 0, "the longest step must have a tick"),
            (ticks_per_frame > 0, "a frame must have a tick"),
            (error.is_none_or(positive), "the error of a step must be positive"),
            (not_negative(end), "the end must be a number of at least 0"),
            (not_negative(ramp), "the time over which gravity grows must be at least 0"),
            (relaxation.is_none_or(rests), "the criteria of rest must be positive"),
            (
                self.schedule.motion_seconds.is_none_or(not_negative),
                "the time of motions must be at least 0",
            ),
            (
                self.environment.gravity.iter().all(|part| part.is_finite()),
                "the acceleration of gravity must be finite",
            ),
            (not_negative(self.environment.air), "the drag of the air must be at least 0"),
        ];
        rules.iter().find(|(holds, _)| !holds).map(|(_, rule)| (*rule).into())
    }

    /// Returns the first fault of the panels and garments of a cloth that has `particles`
    /// particles.
    fn panel_fault(&self, particles: usize) -> Option<String> {
        let mut first = 0;
        for panel in &self.panels {
            let count = panel.lattice.particle_count();
            let nodes = panel.edges.iter().flat_map(|edge| &edge.nodes);
            let is_sound = panel.first == first
                && panel.material < self.materials.len()
                && nodes.into_iter().all(|&node| (node as usize) < count);
            if !is_sound {
                return Some(format!(
                    "the panel \"{}\" names a particle or a fabric that does not exist",
                    panel.name
                ));
            }
            first += count;
        }
        if self.panels.is_empty() || first != particles {
            return Some(format!("the panels have {first} particles, and the cloth {particles}"));
        }

        let beyond = self.garments.iter().find(|garment| garment.particles.end > particles)?;
        Some(format!("the garment \"{}\" has more particles than the cloth", beyond.name))
    }

    /// Returns the first fault of the positions and velocities at which `particles` particles
    /// start.
    fn start_fault(&self, particles: usize) -> Option<String> {
        let lists = [("positions", &self.start.positions), ("velocities", &self.start.velocities)];
        lists.into_iter().find_map(|(name, list)| {
            if list.len() != 3 * particles {
                let found = list.len();
                return Some(format!("{found} {name} are given for {particles} particles"));
            }
            let is_finite = list.iter().all(|number| number.is_finite());
            (!is_finite).then(|| format!("the {name} at the start must be finite"))
        })
    }

    /// Returns the first body whose motion does not fit the body, in words.
    fn body_fault(&self) -> Option<String> {
        let is_sound = |MovingBody { body, motion, .. }: &MovingBody| match motion {
            Some(motion @ BodyMotion::Shapes(_)) => {
                body.triangulate().is_ok_and(|mesh| motion.is_sound(mesh.vertices.len()))
            }
            Some(motion) => motion.is_sound(0),
            None => true,
        };
        let unsound = self.bodies.iter().find(|body| !is_sound(body))?;
        Some(format!("the motion of the body \"{}\" is no motion of this body", unsound.body.name))
    }
}

/// Returns the fault of the `sewing` of a cloth that has `particles` particles, if there is one.
fn sewing_fault(sewing: &Sewing, particles: usize) -> Option<String> {
    let Sewing { seams, pairs, cloth, seconds, bending } = sewing;
    let exists = |particle: &u32| (*particle as usize) < particles;
    let all = seams.iter().map(|seam| &seam.pairs).chain([pairs]);
    for pairs in all {
        let mut ties = pairs.ties.iter().flat_map(|tie| [tie.particle, tie.ends[0], tie.ends[1]]);
        if !(pairs.pairs.as_flattened().iter().all(exists) && ties.all(|tie| exists(&tie))) {
            return Some("a seam names a particle that does not exist".into());
        }
    }
    if [cloth.particle_count(), bending.particle_count()] != [particles; 2] {
        return Some("the cloth that is sewn has another number of particles".into());
    }
    let is_time = *seconds > 0.0 && seconds.is_finite();
    (!is_time).then(|| "the time of sewing must be positive".into())
}

#[cfg(test)]
mod tests {
    use drape_fabric::samples;
    use drape_input::Document;

    use super::*;

    fn towel() -> Scene {
        let fabric = Document::new("plain.toml", samples::plain_weave().to_toml());
        let text = "spacing = 0.02\nfabric.plain.file = \"plain.toml\"\n\
            panel = [{ name = \"towel\", fabric = \"plain\", rectangle = [0.1, 0.1] }]\n\
            pin = [{ panel = \"towel\", edge = \"top\" }]\n\
            time = { step = 0.005, end = 2 }\n";
        Scene::from_documents(&Document::new("towel.toml", text), &[fabric]).expect("right")
    }

    #[test]
    fn a_change_that_does_not_fit_is_named() {
        assert_eq!(towel().fault(), None);
        type Change = fn(&mut Scene);
        let changes: [(&str, Change); 10] = [
            ("a step must have a tick", |scene| scene.schedule.clock.ticks_per_step = 0),
            ("a frame must have a tick", |scene| scene.schedule.clock.ticks_per_frame = 0),
            ("the length of a step", |scene| scene.schedule.clock.step = f64::NAN),
            ("the acceleration of gravity", |scene| scene.environment.gravity[1] = f64::INFINITY),
            ("velocities are given for", |scene| scene.start.velocities.truncate(3)),
            ("the positions at the start", |scene| scene.start.positions[4] = f64::NAN),
            ("the panel \"towel\"", |scene| scene.panels[0].first = 1),
            ("the panels have 0 particles", |scene| scene.panels.clear()),
            ("the panel \"towel\"", |scene| scene.panels[0].material = 7),
            ("the pin 0", |scene| scene.pins[0].particles[0] = 36),
        ];
        for (words, change) in changes {
            let mut scene = towel();
            change(&mut scene);
            let fault = scene.fault().unwrap_or_default();
            assert!(fault.contains(words), "{fault:?} does not say {words:?}");
        }
    }
}
