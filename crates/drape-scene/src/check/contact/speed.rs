//! Speeds of bodies and pins that move.

use drape_input::{excerpt, figure_below};

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
