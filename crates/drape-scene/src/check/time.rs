//! Times of a simulation: steps, relaxation and the grids on which the cloth comes to rest, motion.

use drape_input::{Given, figure};

use crate::check::checker::Checker;
use crate::scene::clock::Clock;
use crate::scene::relaxation::Relaxation;
use crate::spacings::{REFINE, spacings};

/// Time between frames when the scene does not say, in s.
const FRAME_INTERVAL: f64 = 0.04;

/// Number of times that the first step may be halved when the scene names an error but no shortest
/// step.
const HALVINGS: u32 = 5;

/// Factor by which a step may become longer than the first when the scene names an error but no
/// longest step; for cloth at 5 ms the solver's work per simulated second hardly falls beyond it.
const GROWTH: f64 = 4.0;

/// Factor by which a step may become longer than the first in relaxation when the scene does not
/// say. The last steps of a quasi-static relaxation are long: there a step is a minimisation.
const RELAXATION_GROWTH: f64 = 200.0;

/// Speed below which cloth is at rest when the scene does not say, in m/s.
const REST_SPEED: f64 = 0.002;

/// Acceleration below which cloth is at rest when the scene does not say, over g.
const REST_RESIDUAL: f64 = 1e-3;

/// Displacement of a particle in one step of relaxation when the scene does not say, as a fraction
/// of the spacing.
///
/// Longer strides take fewer steps of more iterations each, and follow the path, which a fabric
/// with friction remembers, less closely. With a half instead of a quarter a square metre on a cube
/// took as long, and with half the spacing about a quarter less; the energy stored at rest changed
/// by 0.2 %, on a sphere by 4 %.
const STRIDE: f64 = 0.25;

/// Smallest ratio of the spacings of two grids.
const GRID_RATIO_MIN: f64 = 1.1;

/// Largest number of coarser grids.
const GRIDS_MAX: usize = 8;

/// Checks steps, their end, and the times of frames.
pub(crate) fn clock(checker: &mut Checker<'_>) -> Clock {
    let (file, unit) = (checker.file, checker.unit);
    let time = &file.time;
    let [first, end] = [time.step, time.end].map(Given::value);
    let [step_min, step_max] = [time.step_min, time.step_max].map(|step| step.map(Given::value));
    let sound = checker.within("time.step", first, 1e-7..=0.1, "in s; 0.005 is usual");
    // A wrong step would make the other times wrong too.
    let step = if sound { first } else { 0.0 };
    checker.within("time.end", end, step..=1e5, "in s, at least one step");
    let interval = file.output.every.map_or(FRAME_INTERVAL.max(step), Given::value);
    checker.within("output.every", interval, step..=1e5, "in s, at least one step");
    let ramp = time.ramp.map_or(0.0, Given::value);
    checker.within("time.ramp", ramp, 0.0..=1e5, "in s; 0 for full gravity at once");
    let error = time.error.map(|error| error * unit);
    if let Some(error) = error {
        let help = "an error of positions; 0.1 mm is usual";
        checker.within("time.error", error, 1e-9..=0.1, help);
        let quasi_static =
            file.settle.as_ref().is_some_and(|settle| !settle.inertia.unwrap_or(false));
        if quasi_static && file.motion.is_none() {
            let message = "steps on the way to rest have no error in time";
            let help =
                "leave it out: settle.stride sets their length; or add inertia = true to [settle]";
            let mistake = checker.fail("time.error", message, help);
            checker.remedy(mistake, "time.error", None);
        }
    }
    let varies = error.is_some() || file.settle.is_some();
    for (key, length, range) in
        [("time.step_min", step_min, 1e-9..=step), ("time.step_max", step_max, step..=100.0)]
    {
        let Some(length) = length else { continue };
        if !varies {
            let help = "steps vary with time.error, or on the way to rest with [settle]";
            checker.fail(key, "steps are all of one length", help);
        } else if sound {
            checker.within(key, length, range, "in s, on its side of time.step");
        }
    }
    let halvings = match (step_min, error) {
        (Some(shortest), _) => (first / shortest).log2().floor().clamp(0.0, 30.0) as u32,
        (None, Some(_)) => HALVINGS,
        (None, None) => 0,
    };
    let inertia = file.settle.as_ref().is_some_and(|settle| settle.inertia.unwrap_or(false));
    let growth = match (error, &file.settle) {
        (Some(_), None) => GROWTH,
        (Some(_), Some(_)) if inertia => GROWTH,
        (_, Some(_)) => RELAXATION_GROWTH,
        (None, None) => 1.0,
    };
    let ticks_per_step = 1_usize << halvings;
    let ticks = |seconds: f64| seconds / first * ticks_per_step as f64;
    Clock {
        step: first,
        ticks_per_step,
        ticks_max: ticks(step_max.unwrap_or(growth * first)) as usize,
        error,
        end,
        ramp,
        ticks_per_frame: ticks(interval).round().max(1.0) as usize,
    }
}

/// Checks the relaxation of particles that are a spacing apart, in m, if there is to be one.
pub(crate) fn relaxation(checker: &mut Checker<'_>, spacing: f64) -> Option<Relaxation> {
    let unit = checker.unit;
    let settle = checker.file.settle.as_ref()?;
    let speed = settle.speed.map_or(REST_SPEED, Given::value);
    checker.within("settle.speed", speed, 1e-6..=10.0, "in m/s; 0.002 is usual");
    let residual = settle.residual.unwrap_or(REST_RESIDUAL);
    checker.within("settle.residual", residual, 1e-8..=1.0, "over g; 0.001 is usual");
    let stride = settle.stride.map_or(STRIDE * spacing, |stride| stride * unit);
    let help = "a length; a quarter of the spacing is usual";
    checker.within("settle.stride", stride, 1e-7..=1.0, help);
    let inertia = settle.inertia.unwrap_or(false);
    Some(Relaxation { speed, residual, stride, inertia })
}

/// Checks the spacings of the coarser grids, and that the cloth comes to rest on them.
pub(crate) fn refinement(checker: &mut Checker<'_>) {
    let Some(refine) = &checker.file.refine else { return };
    if checker.file.settle.is_none() {
        let message = "cloth that does not come to rest has no coarser grids";
        checker.fail("refine", message, "add [settle], or leave [refine] out");
    }
    if refine.spacings.len() > GRIDS_MAX {
        let message = format!("{} coarser grids", refine.spacings.len());
        checker.fail(REFINE, message, &format!("name {GRIDS_MAX} at most, such as [0.02]"));
        return;
    }
    let unit = checker.unit;
    let Ok(spacings) = spacings(checker.document()) else { return };
    let grids = refine.spacings.iter().map(|spacing| *spacing * unit);
    let grids: Vec<f64> = grids.chain([spacings[0].value]).collect();
    // A comparison that NaN fails.
    let too_close =
        grids.windows(2).position(|pair| !(pair[0] >= 0.999_999 * GRID_RATIO_MIN * pair[1]));
    if let Some(index) = too_close {
        let message = format!(
            "a grid of {} mm before one of {} mm",
            figure(1e3 * grids[index]),
            figure(1e3 * grids[index + 1])
        );
        let help = format!(
            "the coarsest comes first and each is {GRID_RATIO_MIN} times as coarse as the next or more, the \
             last one against the spacing of the scene"
        );
        checker.fail(&format!("{REFINE}[{index}]"), message, &help);
    }
}

/// Checks the time for which bodies and pins move when the cloth has come to rest, in s, if they do
/// so then.
pub(crate) fn motion_seconds(checker: &mut Checker<'_>) -> Option<f64> {
    let file = checker.file;
    let seconds = file.motion.as_ref()?.seconds.value();
    checker.within(
        "motion.seconds",
        seconds,
        file.time.step.value()..=1e5,
        "in s, at least one step",
    );
    if file.settle.is_none() {
        let help = "add [settle], or leave [motion] out: bodies then move from the start";
        checker.fail("motion", "the cloth is not asked to come to rest", help);
    }
    Some(seconds)
}
