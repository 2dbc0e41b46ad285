use crate::placement::turned;

/// Where a moving pin is at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Key {
    /// In s.
    pub(crate) time: f64,
    /// Shift from where it started, in m.
    pub(crate) shift: [f64; 3],
    /// Turn about its center: angles about x, then y, then z, in degrees.
    pub(crate) turn: [f64; 3],
}

/// The particles that a pin holds, and how they move as one rigid body.
#[derive(Debug, Clone, PartialEq)]
pub struct Pin {
    /// The particles.
    pub particles: Vec<usize>,
    /// Their places at the start, in m.
    pub(crate) start: Vec<[f64; 3]>,
    /// The point they turn about, in m.
    pub(crate) center: [f64; 3],
    /// In the order of their times; none for what does not move.
    pub(crate) keys: Vec<Key>,
}

/// What a pin bears: the pull of the cloth and the weight that hangs on it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PinLoad {
    /// Force of the cloth on the pin, in N.
    pub force: [f64; 3],
    /// Its moment about the middle of what the pin holds, in N·m.
    pub moment: [f64; 3],
}

impl Pin {
    /// The load from the forces on all particles.
    pub(crate) fn load(&self, positions: &[f64], forces: &[f64]) -> PinLoad {
        let vector = |all: &[f64], particle: usize| -> [f64; 3] {
            std::array::from_fn(|axis| all[3 * particle + axis])
        };
        let count = self.particles.len() as f64;
        let mut middle = [0.0; 3];
        for &particle in &self.particles {
            let place = vector(positions, particle);
            (0..3).for_each(|axis| middle[axis] += place[axis] / count);
        }
        let mut load = PinLoad::default();
        for &particle in &self.particles {
            let (place, force) = (vector(positions, particle), vector(forces, particle));
            for axis in 0..3 {
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                load.force[axis] += force[axis];
                load.moment[axis] +=
                    (place[j] - middle[j]) * force[k] - (place[k] - middle[k]) * force[j];
            }
        }
        load
    }

    /// What stays where it is.
    pub(crate) fn resting(particles: Vec<usize>) -> Self {
        Self { particles, start: Vec::new(), center: [0.0; 3], keys: Vec::new() }
    }

    /// Writes the places of the particles at a time, in s, into the flat array of all places.
    pub(crate) fn place(&self, time: f64, positions: &mut [f64]) {
        if self.keys.is_empty() {
            return;
        }
        let Key { shift, turn, .. } = self.at(time);
        for (&particle, start) in self.particles.iter().zip(&self.start) {
            let arm = std::array::from_fn(|axis| start[axis] - self.center[axis]);
            let arm = turned(arm, turn);
            for axis in 0..3 {
                positions[3 * particle + axis] = self.center[axis] + arm[axis] + shift[axis];
            }
        }
    }

    /// Shift and turn at a time: straight between keys, at rest before the first and after the last.
    fn at(&self, time: f64) -> Key {
        let next = self.keys.partition_point(|key| key.time <= time);
        let [Some(before), Some(after)] = [next.wrapping_sub(1), next].map(|k| self.keys.get(k))
        else {
            return *if next == 0 { &self.keys[0] } else { &self.keys[next - 1] };
        };
        let part = (time - before.time) / (after.time - before.time);
        let between = |from: [f64; 3], to: [f64; 3]| {
            std::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]))
        };
        let shift = between(before.shift, after.shift);
        Key { time, shift, turn: between(before.turn, after.turn) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pin_moves_rigidly_from_key_to_key_and_rests_outside_of_them() {
        let key = |time: f64, shift: f64, turn: f64| Key {
            time,
            shift: [shift, 0.0, 0.0],
            turn: [0.0, 0.0, turn],
        };
        let pin = Pin {
            particles: vec![1],
            start: vec![[2.0, 1.0, 0.0]],
            center: [1.0, 1.0, 0.0],
            keys: vec![key(1.0, 0.0, 0.0), key(2.0, 0.5, 180.0)],
        };
        let place = |time: f64| {
            let mut positions = [0.0; 6];
            pin.place(time, &mut positions);
            assert_eq!(positions[..3], [0.0; 3], "the other particle stays");
            [positions[3], positions[4]]
        };
        let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-15;
        for (time, expected) in
            [(0.0, [2.0, 1.0]), (1.0, [2.0, 1.0]), (1.5, [1.25, 2.0]), (9.0, [0.5, 1.0])]
        {
            assert!(near(place(time), expected), "{:?} at {time}", place(time));
        }
    }
}
