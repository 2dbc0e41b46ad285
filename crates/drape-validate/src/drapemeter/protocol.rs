//! Protocol of a drape test: how the platform sinks, how the disc is shaken, and how even a
//! specimen is.

use std::f64::consts::TAU;

/// Protocol of a drape test, and of its simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Protocol {
    /// Speed of the sinking platform, in m/s. The standards do not give it.
    pub sink_speed: f64,
    /// Shaking of the disc when the platform is down.
    pub shake: Option<Shake>,
    /// Turn of the specimen about the upright, in degrees: what is read must not depend on it.
    pub turn: f64,
    /// Length of a time step, in s.
    pub step: f64,
    /// How uneven the specimen is at first, by heights that change over 20 mm: the greatest, in m.
    ///
    /// They are the same at every spacing. If each particle had a height of its own, the cloth
    /// would be curved the more the finer its grid, and the friction of its yarns would slip, it
    /// seems, before it moves: at 2.3 mm a cotton then drapes to 75 % in four folds or five, where
    /// it drapes to 83 % in five or six.
    pub unevenness: f64,
}

impl Default for Protocol {
    fn default() -> Self {
        Self { sink_speed: 0.02, shake: None, turn: 0.0, step: 0.005, unevenness: 2e-4 }
    }
}

/// Keys of the trajectory of a shaken disc in a period.
const SHAKE_KEYS: usize = 8;

/// Strokes of the disc up and down, a sine in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shake {
    /// Greatest distance from its place, in m.
    pub amplitude: f64,
    /// Frequency of the strokes, in 1/s.
    pub frequency: f64,
    /// Number of strokes.
    pub strokes: usize,
}

impl Shake {
    /// Three strokes of 10 mm to either side at 2 Hz, as a hand gives: 1.6 times gravity at the
    /// turns.
    pub const BOUNCE: Self = Self { amplitude: 0.01, frequency: 2.0, strokes: 3 };

    fn seconds(&self) -> f64 {
        self.strokes as f64 / self.frequency
    }
}

/// Trajectory of a shaken disc.
pub(super) struct Strokes {
    /// Its keys, as TOML.
    pub(super) keys: String,
    /// Time at which the disc rests again, in s.
    pub(super) end: f64,
}

/// Returns the trajectory of the disc when it is shaken from a time in s on.
pub(super) fn shaken(shake: Option<Shake>, start: f64) -> Strokes {
    let shake = shake.unwrap_or(Shake { amplitude: 0.0, frequency: 1.0, strokes: 0 });
    let end = start + shake.seconds();
    let count = shake.strokes * SHAKE_KEYS;
    let at = |k: usize| {
        let part = k as f64 / SHAKE_KEYS as f64;
        let height = if k == count { 0.0 } else { shake.amplitude * (TAU * part).sin() };
        (start + part / shake.frequency, [0.0, height, 0.0])
    };
    let (times, shift): (Vec<f64>, Vec<[f64; 3]>) = (0..=count).map(at).unzip();
    Strokes { keys: format!("{{ times = {times:?}, shift = {shift:?} }}"), end }
}
