//! Speeds of bodies and pins that move.

use drape_input::{excerpt, figure, figure_below};

use crate::check::body::CheckedBody;
use crate::check::checker::Checker;
use crate::check::pins::CheckedPin;
use crate::contact_stiffness::body_speed;

/// Checks that no body and no pin moves faster than the largest speed, in m/s, at which contact
/// keeps the cloth apart.
pub(crate) fn check_speeds(
    checker: &mut Checker<'_>,
    bodies: &[CheckedBody],
    pins: &[CheckedPin],
    most: f64,
) {
    for CheckedBody { body, motion, motion_key, .. } in bodies {
        let speed = motion.as_ref().map_or(0.0, |motion| body_speed(body, motion));
        let moved = Moved { name: format!("the body \"{}\"", excerpt(&body.name)), speed };
        check_speed(checker, motion_key, &moved, most);
    }
    for CheckedPin { pin, motion_key } in pins {
        let speed = pin.motion.as_ref().map_or(0.0, |motion| motion.max_speed(&pin.start));
        check_speed(checker, motion_key, &Moved { name: "the pin".into(), speed }, most);
    }
}

/// Checks that contact can stop bodies and pins at the top speed of the scene. `most` is the
/// largest speed that contact can stop, in m/s.
pub(crate) fn check_top_speed(checker: &mut Checker<'_>, most: f64) {
    const KEY: &str = "contact.top_speed";
    let Some(speed) = checker.spec.contact.top_speed else { return };
    if checker.spec.contact.stiffness.is_some() {
        let message = "contact.stiffness already says which speed contact stops";
        let mistake = checker.fail(KEY, message, "leave contact.stiffness out, or this key");
        checker.remedy(mistake, "contact.stiffness", None);
    } else if checker.is_sound(KEY) && !(speed <= most) {
        let message = format!(
            "contact keeps this fabric apart up to {most:.3} m/s, and {} m/s are asked for",
            figure(speed)
        );
        let most = figure_below(most);
        let mistake = checker.fail(KEY, message, format!("write {most} or less, in m/s"));
        checker.remedy(mistake, KEY, Some(&most));
    }
}

/// Body or pin that moves.
struct Moved {
    name: String,
    /// Largest speed, in m/s.
    speed: f64,
}

fn check_speed(checker: &mut Checker<'_>, key: &str, moved: &Moved, most: f64) {
    let Moved { name, speed } = moved;
    if !(*speed <= most) {
        let message = format!(
            "{name} moves at {speed:.3} m/s; contact keeps this fabric apart up to {most:.3} m/s"
        );
        let most = figure_below(most);
        let help = format!(
            "slow it to {most} m/s, or let only particles meet bodies with contact.surfaces = false"
        );
        checker.fail(key, message, &help);
    }
}
