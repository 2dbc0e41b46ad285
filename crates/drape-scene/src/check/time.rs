//! Times of a simulation: steps, relaxation and the grids on which the cloth comes to rest, motion.

use drape_input::figure;

use crate::check::checker::Checker;
use crate::scene::clock::Clock;
use crate::scene::relaxation::Relaxation;
use crate::spacings::REFINE;
use crate::spec::run::{SettleSpec, TimeSpec};

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
    let spec = checker.spec;
    let TimeSpec { step: first, end, step_min, step_max, error, ramp } = spec.time;
    let sound = checker.is_sound("time.step");
    // A wrong step would make the other times wrong too.
    let step = if sound { first } else { 0.0 };
    checker.within("time.end", end, step..=Clock::END_MAX, "in s, at least one step");
    let interval = spec.output.every.unwrap_or(FRAME_INTERVAL.max(step));
    checker.within("output.every", interval, step..=1e5, "in s, at least one step");
    if error.is_some() {
        let quasi_static = spec.settle.as_ref().is_some_and(|settle| !settle.inertia);
        if quasi_static && spec.motion.is_none() {
            let message = "steps on the way to rest have no error in time";
            let help =
                "leave it out: settle.stride sets their length; or add inertia = true to [settle]";
            let mistake = checker.fail("time.error", message, help);
            checker.remedy(mistake, "time.error", None);
        }
    }
    let varies = error.is_some() || spec.settle.is_some();
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
    let inertia = spec.settle.as_ref().is_some_and(|settle| settle.inertia);
    let growth = match (error, &spec.settle) {
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

/// Returns the relaxation of particles that are `spacing` apart, in m, if there is to be one.
pub(crate) fn relaxation(checker: &Checker<'_>, spacing: f64) -> Option<Relaxation> {
    let settle = checker.spec.settle.as_ref()?;
    let &SettleSpec { speed, residual, stride, inertia } = settle;
    Some(Relaxation { speed, residual, stride: stride.unwrap_or(STRIDE * spacing), inertia })
}

/// Checks the spacings of the coarser grids, and that the cloth comes to rest on them.
pub(crate) fn refinement(checker: &mut Checker<'_>) {
    let Some(refine) = &checker.spec.refine else { return };
    if checker.spec.settle.is_none() {
        let message = "cloth that does not come to rest has no coarser grids";
        checker.fail("refine", message, "add [settle], or leave [refine] out");
    }
    if refine.spacings.len() > GRIDS_MAX {
        let message = format!("{} coarser grids", refine.spacings.len());
        checker.fail(REFINE, message, format!("name {GRIDS_MAX} at most, such as [0.02]"));
        return;
    }
    let finest = checker.spec.spacings()[0].value;
    let grids: Vec<f64> = refine.spacings.iter().copied().chain([finest]).collect();
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
    let spec = checker.spec;
    let seconds = spec.motion.as_ref()?.seconds;
    checker.within("motion.seconds", seconds, spec.time.step..=1e5, "in s, at least one step");
    if spec.settle.is_none() {
        let help = "add [settle], or leave [motion] out: bodies then move from the start";
        checker.fail("motion", "the cloth is not asked to come to rest", help);
    }
    Some(seconds)
}
