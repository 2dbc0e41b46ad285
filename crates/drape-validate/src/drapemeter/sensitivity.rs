//! Sensitivity of a drape coefficient: one factor of fabric or test is varied at a time.

use drape_fabric::{BendingBackbone, Fabric, ShearBackbone, TractionBackbone};

use super::meter::Drapemeter;
use super::protocol::{Protocol, Shake};
use super::study::{Sampling, Study};
use crate::error::ValidationError;

/// Drapemeter and fabric of which one factor is varied.
type Setting = (Drapemeter, Fabric);

/// Factor that is varied from a lower to a higher value.
pub struct Factor {
    /// Name, with both values.
    pub name: &'static str,
    set: fn(&mut Setting, usize),
}

/// Factors, in the order of the table.
pub const FACTORS: [Factor; 13] = [
    Factor { name: "no friction, with friction", set: friction },
    Factor { name: "2HG 0 to 2 gf/cm", set: shear_loop },
    Factor { name: "G 0.3 to 1.5 gf/(cm·deg)", set: shear_stiffness },
    Factor { name: "2HB halved, half as much again", set: bending_loop },
    Factor { name: "bending friction over 0.2 to 0.02 1/cm", set: bending_slip },
    Factor { name: "B less and more by 20 %", set: bending_rigidity },
    Factor { name: "W more and less by 5 %", set: weight },
    Factor { name: "traction halved and doubled", set: traction },
    Factor { name: "three strokes of 10 mm, no shaking", set: shake },
    Factor { name: "platform at 200 mm/s, at 20 mm/s", set: sink_speed },
    Factor { name: "steps of 10 ms, of 2.5 ms", set: step },
    Factor { name: "uneven by 0.05 mm, by 0.8 mm", set: unevenness },
    Factor { name: "grid at 0° and at 45° to the shaken noise", set: turn },
];

impl Factor {
    /// Drapes `fabric` on `meter` with this factor at its lower and at its higher value, from the
    /// starts of `sampling`. Calls `done` after each start.
    ///
    /// # Errors
    /// The errors of [`Drapemeter::study`].
    pub fn vary(
        &self,
        meter: &Drapemeter,
        fabric: &Fabric,
        sampling: Sampling,
        done: &(dyn Fn() + Sync),
    ) -> Result<[Study; 2], ValidationError> {
        let [low, high] = [0, 1].map(|end| {
            let mut setting = (*meter, fabric.clone());
            (self.set)(&mut setting, end);
            setting
        });
        Ok([low.0.study(&low.1, sampling, done)?, high.0.study(&high.1, sampling, done)?])
    }
}

fn friction((_, fabric): &mut Setting, end: usize) {
    if end == 0 {
        *fabric = fabric.without_friction();
    }
}

fn shear_loop((_, fabric): &mut Setting, end: usize) {
    fabric.shear.friction.elements[0].plateau = [0.0, 0.9807][end];
}

fn shear_stiffness((_, fabric): &mut Setting, end: usize) {
    fabric.shear.backbone = ShearBackbone::Linear { stiffness: [16.86, 84.28][end] };
}

fn bending_loop((_, fabric): &mut Setting, end: usize) {
    for laws in [&mut fabric.warp, &mut fabric.weft] {
        laws.bending.friction.elements.iter_mut().for_each(|e| e.plateau *= [0.5, 1.5][end]);
    }
}

fn bending_slip((_, fabric): &mut Setting, end: usize) {
    for laws in [&mut fabric.warp, &mut fabric.weft] {
        laws.bending.friction.elements.iter_mut().for_each(|e| e.length = [20.0, 2.0][end]);
    }
}

fn bending_rigidity((_, fabric): &mut Setting, end: usize) {
    for laws in [&mut fabric.warp, &mut fabric.weft] {
        if let BendingBackbone::Linear { rigidity } = &mut laws.bending.backbone {
            *rigidity *= [0.8, 1.2][end];
        }
    }
}

fn weight((_, fabric): &mut Setting, end: usize) {
    fabric.density *= [1.05, 0.95][end];
}

fn traction((_, fabric): &mut Setting, end: usize) {
    for laws in [&mut fabric.warp, &mut fabric.weft] {
        let factor = [0.5, 2.0][end];
        match &mut laws.traction.backbone {
            TractionBackbone::Exponential(toe) => {
                toe.stiffness *= factor;
                toe.base_stiffness *= factor;
            }
            TractionBackbone::Primed(primed) => primed.stiffness *= factor,
            TractionBackbone::Polynomial(polynomial) => {
                polynomial.quadratic *= factor;
                polynomial.quartic *= factor;
            }
        }
    }
}

fn shake((meter, _): &mut Setting, end: usize) {
    meter.protocol.shake = [Some(Shake::BOUNCE), None][end];
}

fn sink_speed((meter, _): &mut Setting, end: usize) {
    meter.protocol.sink_speed = [0.2, Protocol::default().sink_speed][end];
}

fn step((meter, _): &mut Setting, end: usize) {
    meter.protocol.step = [0.01, 0.0025][end];
}

fn unevenness((meter, _): &mut Setting, end: usize) {
    meter.protocol.unevenness = [5e-5, 8e-4][end];
}

fn turn((meter, _): &mut Setting, end: usize) {
    meter.protocol.turn = [0.0, 45.0][end];
}
