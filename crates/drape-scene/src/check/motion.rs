//! Rigid motions of bodies and pins.

use drape_input::Given;

use crate::check::checker::Checker;
use crate::file::motion::MotionFile;
use crate::scene::motion::{MotionKey, RigidMotion};

/// Checks a motion at a key, about a centre of its own or else a middle, in m.
pub(crate) fn rigid_motion(
    checker: &mut Checker<'_>,
    key: &str,
    file: &MotionFile,
    middle: [f64; 3],
) -> Option<RigidMotion> {
    let unit = checker.unit;
    let count = file.times.len();
    let times: Vec<f64> = file.times.iter().map(|time| time.value()).collect();
    let shifts: Vec<[f64; 3]> = file.shift.iter().map(|x| x.map(|x| x * unit)).collect();
    let turns: Vec<[f64; 3]> = file.turn.iter().map(|x| x.map(Given::value)).collect();
    for (name, list) in [("shift", &shifts), ("turn", &turns)] {
        if !list.is_empty() && list.len() != count {
            let message = format!("{} places for {count} times", list.len());
            checker.fail(&format!("{key}.{name}"), message, "give one for each of the times");
            return None;
        }
    }
    let rising = times.windows(2).all(|pair| pair[0] < pair[1]);
    let finite = |list: &[[f64; 3]]| list.iter().flatten().all(|x| x.is_finite());
    if count == 0 || !rising || !finite(&shifts) || !finite(&turns) {
        let help = "give times = [0, 1, …] in s, each later than the one before, and as many \
                    shift = [[x, y, z], …] or turn = [[x, y, z], …]";
        checker.fail(key, "the motion is not one", help);
        return None;
    }
    let at = |list: &[[f64; 3]], k: usize| list.get(k).copied().unwrap_or([0.0; 3]);
    let keys = times.iter().enumerate().map(|(k, &time)| MotionKey {
        time,
        shift: at(&shifts, k),
        turn: at(&turns, k),
    });
    let center = file.center.map_or(middle, |center| center.map(|x| x * unit));
    RigidMotion::new(center, keys.collect())
}
