use crate::track::Track;

/// The particles that a pin holds, and how they move.
#[derive(Debug, Clone, PartialEq)]
pub struct Pin {
    /// The particles.
    pub particles: Vec<usize>,
    /// Their places at the start, in m.
    pub(crate) start: Vec<[f64; 3]>,
    /// Their way; none if they stay.
    pub(crate) track: Option<Track>,
    /// When it lets go, in s; infinite if it never does.
    pub(crate) release: f64,
    /// The phases in which it holds.
    pub(crate) until: Until,
    /// Whether it holds along x, y and z.
    pub(crate) axes: [bool; 3],
}

/// What a pin holds until.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Until {
    /// The garment is sewn.
    Sewn,
    /// The cloth has come to rest, and bodies begin to move.
    Rest,
    /// The run ends.
    End,
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
    /// Whether it holds its particles in a step that ends at a time, in s.
    pub(crate) fn holds(&self, end_time: f64) -> bool {
        end_time <= self.release
    }

    /// Whether its particles are held altogether; they are attached by springs otherwise.
    pub(crate) fn is_whole(&self) -> bool {
        self.axes == [true; 3]
    }

    /// Lets go, at a time in s, if it is to hold until what has then been reached.
    pub(crate) fn reached(&mut self, until: Until, time: f64) {
        if self.until == until {
            self.release = time;
        }
    }

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

    /// The particles and their places at a time, in s.
    pub(crate) fn places(&self, time: f64) -> impl Iterator<Item = (usize, [f64; 3])> {
        let moved = self.track.as_ref().map(|track| track.points(time));
        let place = move |&start: &[f64; 3]| moved.as_ref().map_or(start, |moved| moved(start));
        self.particles.iter().copied().zip(self.start.iter().map(place))
    }

    /// Writes the places of the particles at a time, in s, into the flat array of all places.
    pub(crate) fn place(&self, time: f64, positions: &mut [f64]) {
        if self.track.is_some() {
            for (particle, place) in self.places(time) {
                positions[3 * particle..3 * particle + 3].copy_from_slice(&place);
            }
        }
    }
}
