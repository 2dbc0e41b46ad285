use crate::track::Track;

/// The particles that a pin holds, and how they move.
#[derive(Debug, Clone, PartialEq)]
pub struct Pin {
    /// The particles.
    pub particles: Vec<usize>,
    /// Their places at the start, in m.
    pub start: Vec<[f64; 3]>,
    /// Their way; none if they stay.
    pub track: Option<Track>,
    /// When it lets go, in s; infinite if it never does.
    pub release: f64,
    /// The phases in which it holds.
    pub until: Until,
    /// Whether it holds along x, y and z.
    pub axes: [bool; 3],
}

/// What a pin holds until.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Until {
    /// The garment is sewn.
    Sewn,
    /// The cloth has come to rest, and bodies begin to move.
    Rest,
    /// The run ends.
    End,
}

impl Pin {
    /// Whether it holds its particles in a step that ends at a time, in s.
    #[must_use]
    pub fn holds(&self, end_time: f64) -> bool {
        end_time <= self.release
    }

    /// Whether its particles are held altogether; they are attached by springs otherwise.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.axes == [true; 3]
    }

    /// Lets go, at a time in s, if it is to hold until what has then been reached.
    pub fn reached(&mut self, until: Until, time: f64) {
        if self.until == until {
            self.release = time;
        }
    }

    /// The particles and their places at a time, in s.
    pub fn places(&self, time: f64) -> impl Iterator<Item = (usize, [f64; 3])> {
        let moved = self.track.as_ref().map(|track| track.points(time));
        let place = move |&start: &[f64; 3]| moved.as_ref().map_or(start, |moved| moved(start));
        self.particles.iter().copied().zip(self.start.iter().map(place))
    }

    /// Writes the places of the particles at a time, in s, into the flat array of all places.
    pub fn place(&self, time: f64, positions: &mut [f64]) {
        if self.track.is_some() {
            for (particle, place) in self.places(time) {
                positions[3 * particle..3 * particle + 3].copy_from_slice(&place);
            }
        }
    }
}
