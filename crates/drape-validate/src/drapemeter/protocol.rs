//! Protocol of a drape test: the motion of the platform, the shaking of the disc, and the
//! unevenness of the specimen.

use std::f64::consts::TAU;

use drape_scene::MotionSpec;

/// Protocol of a drape test, and of its simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Protocol {
    /// Speed of the sinking platform, in m/s. The standards do not give it.
    pub sink_speed: f64,
    /// Shaking of the disc when the platform is down.
    pub shake: Option<Shake>,
    /// Turn of the specimen about the vertical, in degrees. Results must not depend on the turn.
    pub turn: f64,
    /// Length of a time step, in s.
    pub step: f64,
    /// Largest height of the uneven specimen at the start, in m. Heights change over 20 mm.
    ///
    /// The heights do not depend on the spacing. If heights varied from particle to particle, a
    /// finer grid would make the cloth more curved, and the friction of its yarns would probably
    /// slip before the cloth moves: at 2.3 mm a cotton then drapes to 75 % in four or five folds,
    /// instead of 83 % in five or six folds.
    pub unevenness: f64,
}

impl Default for Protocol {
    fn default() -> Self {
        Self { sink_speed: 0.02, shake: None, turn: 0.0, step: 0.005, unevenness: 2e-4 }
    }
}

/// Strokes of the disc up and down, a sine in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shake {
    /// Largest distance of the disc from its position at rest, in m.
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

    /// Returns the duration of all `strokes`, in s.
    fn seconds(&self) -> f64 {
        self.strokes as f64 / self.frequency
    }
}

/// Trajectory of a shaken disc.
pub(super) struct Strokes {
    /// The trajectory.
    pub(super) motion: MotionSpec,
    /// Time at which the disc rests again, in s.
    pub(super) end: f64,
}

/// Returns the trajectory of a disc whose shaking `shake` begins at the time `start`, in s.
pub(super) fn shaken(shake: Option<Shake>, start: f64) -> Strokes {
    /// Keys of the trajectory in a period.
    const SHAKE_KEYS: usize = 8;

    let shake = shake.unwrap_or(Shake { amplitude: 0.0, frequency: 1.0, strokes: 0 });
    let end = start + shake.seconds();
    let count = shake.strokes * SHAKE_KEYS;
    let (times, shift): (Vec<f64>, Vec<[f64; 3]>) = (0..=count)
        .map(|k| {
            let part = k as f64 / SHAKE_KEYS as f64;
            let height = if k == count { 0.0 } else { shake.amplitude * (TAU * part).sin() };
            (start + part / shake.frequency, [0.0, height, 0.0])
        })
        .unzip();
    Strokes { motion: MotionSpec { times, shift, ..MotionSpec::default() }, end }
}
