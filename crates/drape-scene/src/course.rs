use crate::shapes::Shapes;
use crate::track::Track;

/// How a body moves.
#[derive(Debug, Clone, PartialEq)]
pub enum Course {
    /// As one rigid thing, along keys.
    Rigid(Track),
    /// Each vertex by itself, from frame to frame.
    Shapes(Shapes),
}

impl Course {
    /// Puts vertices that start at one list of places to where they are at a time; three coordinates each, in m.
    pub fn place(&self, time: f64, start: &[f64], places: &mut [f64]) {
        match self {
            Self::Rigid(track) => {
                let place = track.points(time);
                let start = start.as_chunks::<3>().0.iter();
                for (start, now) in start.zip(places.as_chunks_mut::<3>().0) {
                    *now = place(*start);
                }
            }
            Self::Shapes(shapes) => shapes.place(time, places),
        }
    }

    /// How far vertices that start at these places stray from straight ways between two times, in m. From frame to frame
    /// they go straight.
    #[must_use]
    pub fn bow(&self, times: [f64; 2], start: &[[f64; 3]]) -> f64 {
        match self {
            Self::Rigid(track) => track.bow(times, start),
            Self::Shapes(_) => 0.0,
        }
    }

    /// The greatest speed of a vertex that starts at one of these places, in m/s.
    #[must_use]
    pub fn speed_max(&self, start: &[[f64; 3]]) -> f64 {
        match self {
            Self::Rigid(track) => track.speed_max(start),
            Self::Shapes(shapes) => shapes.speed_max(),
        }
    }
}
