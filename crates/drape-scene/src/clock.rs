use crate::file::SceneFile;
use crate::reader::Reader;

/// Seconds between frames when the scene does not say.
const FRAME_INTERVAL: f64 = 0.04;

/// How often the first step may be halved when the scene names an error but no shortest step.
const HALVINGS: u32 = 5;

/// How much longer than the first a step may become when the scene names an error but no longest
/// step; for cloth at 5 ms the solver's work per simulated second hardly falls beyond it.
const GROWTH: f64 = 4.0;

/// How much longer than the first a step may become on the way to rest when the scene does not say.
/// The last steps of a creeping cloth are long: there a step is worth what a minimisation is.
const SETTLING_GROWTH: f64 = 200.0;

/// Steps of a simulation; time is counted in ticks, each the first step divided by a power of two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Length of a step, of the first one where lengths vary, in s.
    pub step: f64,
    /// Ticks in a step.
    pub ticks_per_step: usize,
    /// Largest number of ticks that a step may grow to.
    pub ticks_max: usize,
    /// Root-mean-square error of the positions that a step may make, in m; steps are even without.
    pub error: Option<f64>,
    /// When the simulation ends at the latest, in s.
    pub end: f64,
    /// How long gravity takes to grow to its value, in s.
    pub ramp: f64,
    /// Ticks between frames.
    pub ticks_per_frame: usize,
}

impl Clock {
    /// The unit in which time is counted, in s.
    #[must_use]
    pub fn tick(&self) -> f64 {
        self.step / self.ticks_per_step as f64
    }

    /// Time of the end at the latest, in ticks.
    #[must_use]
    pub fn ticks_to_do(&self) -> usize {
        (self.end / self.tick()).round() as usize
    }
}

impl Reader<'_> {
    pub(crate) fn clock(&mut self, file: &SceneFile, unit: f64) -> Clock {
        let time = &file.time;
        let sound = self.within("time.step", time.step, (1e-7, 0.1), "in s; 0.005 is usual");
        // A wrong step would make the other times wrong too.
        let step = if sound { time.step } else { 0.0 };
        self.within("time.end", time.end, (step, 1e5), "in s, at least one step");
        let interval = file.output.every.unwrap_or(FRAME_INTERVAL.max(step));
        self.within("output.every", interval, (step, 1e5), "in s, at least one step");
        let ramp = time.ramp.unwrap_or(0.0);
        self.within("time.ramp", ramp, (0.0, 1e5), "in s; 0 for full gravity at once");
        let error = time.error.map(|error| error * unit);
        if let Some(error) = error {
            self.within("time.error", error, (1e-9, 0.1), "an error of positions; 0.1 mm is usual");
        }
        let varies = error.is_some() || file.settle.is_some();
        for (key, length, range) in [
            ("time.step_min", time.step_min, (1e-9, step)),
            ("time.step_max", time.step_max, (step, 100.0)),
        ] {
            let Some(length) = length else { continue };
            if !varies {
                let help = "steps vary with time.error, or on the way to rest with [settle]";
                self.fail(key, "steps are all of one length".into(), help);
            } else if sound {
                self.within(key, length, range, "in s, on its side of time.step");
            }
        }
        let halvings = match (time.step_min, error) {
            (Some(shortest), _) => (time.step / shortest).log2().floor().clamp(0.0, 30.0) as u32,
            (None, Some(_)) => HALVINGS,
            (None, None) => 0,
        };
        let growth = match (error, &file.settle) {
            (Some(_), _) => GROWTH,
            (None, Some(_)) => SETTLING_GROWTH,
            (None, None) => 1.0,
        };
        let ticks_per_step = 1_usize << halvings;
        let ticks = |seconds: f64| seconds / time.step * ticks_per_step as f64;
        Clock {
            step: time.step,
            ticks_per_step,
            ticks_max: ticks(time.step_max.unwrap_or(growth * time.step)) as usize,
            error,
            end: time.end,
            ramp,
            ticks_per_frame: ticks(interval).round().max(1.0) as usize,
        }
    }
}
