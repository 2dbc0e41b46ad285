//! Rigid motions of bodies and pins.

use crate::check::checker::Checker;
use crate::scene::motion::{MotionKey, RigidMotion};
use crate::spec::motion::MotionSpec;

/// Checks a motion at a key, about a centre of its own or else a middle, in m.
pub(crate) fn rigid_motion(
    checker: &mut Checker<'_>,
    key: &str,
    spec: &MotionSpec,
    middle: [f64; 3],
) -> Option<RigidMotion> {
    let MotionSpec { times, shift, turn, center } = spec;
    let count = times.len();
    for (name, list) in [("shift", shift), ("turn", turn)] {
        if !list.is_empty() && list.len() != count {
            let message = format!("{} places for {count} times", list.len());
            checker.fail(&format!("{key}.{name}"), message, "give one for each of the times");
            return None;
        }
    }
    let rising = times.windows(2).all(|pair| pair[0] < pair[1]);
    let finite = |list: &[[f64; 3]]| list.iter().flatten().all(|x| x.is_finite());
    if count == 0 || !rising || !finite(shift) || !finite(turn) {
        let help = "give times = [0, 1, …] in s, each later than the one before, and as many \
                    shift = [[x, y, z], …] or turn = [[x, y, z], …]";
        checker.fail(key, "the motion is not one", help);
        return None;
    }
    let at = |list: &[[f64; 3]], k: usize| list.get(k).copied().unwrap_or([0.0; 3]);
    let keys = times.iter().enumerate().map(|(k, &time)| MotionKey {
        time,
        shift: at(shift, k),
        turn: at(turn, k),
    });
    RigidMotion::new(center.unwrap_or(middle), keys.collect())
}
