//! Many connectors of one law side by side, in arithmetic that compilers turn into vector instructions.
#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use drape_hysteresis::{Bend, BlimanSorine, Slider, Stroke};

use crate::memories::{Lane, Moving, Remembered};

/// Connectors that are evaluated side by side.
///
/// A parameter of the speed alone: eight vectors of four numbers are enough to hide the latency of
/// the exponentials, and few enough that a rare case costs few neighbours.
pub const LANES: usize = 32;

/// A number for each of the connectors that are evaluated side by side.
pub type Lanes = [f64; LANES];

/// Whether the condition holds in any lane: a sum of bits, which needs no branch per lane.
#[inline(always)]
pub(crate) fn any(condition: impl Fn(usize) -> bool) -> bool {
    (0..LANES).fold(0_u64, |bits, lane| bits | u64::from(condition(lane))) != 0
}

/// `$\max(x, 0)$`, and NaN of NaN.
#[inline(always)]
pub(crate) fn positive(x: f64) -> f64 {
    if x < 0.0 { 0.0 } else { x }
}

/// A law prepared for many connectors side by side; its results are those of [`Law`](crate::Law) up
/// to rounding.
///
/// What a law has to give is written for one lane, without branches; the methods that are provided
/// run it over a batch. Everything is inlined into the caller, so that it is compiled for the vector
/// instructions that the caller has switched on.
pub trait BatchLaw {
    /// Number of deformations where the weight of the friction changes its slope.
    const KNOTS: usize;

    /// Whether the elastic load depends on the largest deformation.
    const AGES: bool;

    /// The elements of the friction.
    fn sliders(&self) -> &Sliders;

    /// What follows from the largest deformation and is dear to compute: the end of the priming zone,
    /// and the slope of the friction's weight in it.
    fn toe(&self, peak: f64) -> [f64; 2];

    /// Largest deformation after a trial has been accepted, in the unit of the deformation.
    fn peak(&self, peak: f64, trial: f64) -> f64;

    /// Weight of the friction at a deformation.
    fn weight(&self, lane: Lane, deformation: f64) -> f64;

    /// Slope of that weight where a path sets out from the memory, up or down.
    fn slope(&self, lane: Lane, rising: bool) -> f64;

    /// Where the weight changes its slope, and by how much.
    fn knot(&self, knot: usize, lane: Lane) -> (f64, f64);

    /// Elastic loads, and their slopes if `TANGENT`, in the units of [`Response`](crate::Response).
    fn elastic<const TANGENT: bool>(
        &self,
        memory: &Remembered<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    );

    /// Elastic energies per area, in J/m².
    fn energy(&self, memory: &Remembered<'_>, trial: &Lanes, energies: &mut Lanes);

    /// Loads, and tangents if `TANGENT`, at trial deformations.
    #[inline(always)]
    fn respond<const TANGENT: bool>(
        &self,
        memory: &Remembered<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        self.elastic::<TANGENT>(memory, trial, responses);
        self.slide::<TANGENT>(memory, trial, responses);
    }

    /// Adds the loads of the friction, and their slopes if `TANGENT`.
    #[inline(always)]
    fn slide<const TANGENT: bool>(
        &self,
        memory: &Remembered<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        let Responses { load, tangent } = responses;
        for (element, slider) in self.sliders().0.into_iter().enumerate() {
            let Some(slider) = slider else { continue };
            let before = memory.friction(element);
            for lane in 0..LANES {
                let stroke = self.stroke(memory.lane(lane), trial[lane]);
                let end = slider.load(before[lane], stroke);
                load[lane] += end;
                if TANGENT {
                    let weight = self.weight(memory.lane(lane), trial[lane]);
                    tangent[lane] += slider.tangent(end, stroke.sign, weight);
                }
            }
        }
        if !self.passes_any(memory, trial) {
            return;
        }
        for knot in 0..Self::KNOTS {
            if !self.passes(knot, memory, trial) {
                continue;
            }
            for slider in self.sliders().0.into_iter().flatten() {
                for lane in 0..LANES {
                    let sign = self.stroke(memory.lane(lane), trial[lane]).sign;
                    let bend = self.bend(knot, memory.lane(lane), trial[lane]);
                    let gained = slider.bend_load(sign, bend);
                    load[lane] += gained;
                    if TANGENT {
                        tangent[lane] += slider.tangent(gained, sign, 0.0);
                    }
                }
            }
        }
    }

    /// Adds the works of the friction per area from the memory to the trial, in J/m².
    #[inline(always)]
    fn slide_work(&self, memory: &Remembered<'_>, trial: &Lanes, works: &mut Lanes) {
        for (element, slider) in self.sliders().0.into_iter().enumerate() {
            let Some(slider) = slider else { continue };
            let before = memory.friction(element);
            for lane in 0..LANES {
                let stroke = self.stroke(memory.lane(lane), trial[lane]);
                works[lane] += slider.work(before[lane], stroke);
            }
        }
        if !self.passes_any(memory, trial) {
            return;
        }
        for knot in 0..Self::KNOTS {
            if !self.passes(knot, memory, trial) {
                continue;
            }
            for slider in self.sliders().0.into_iter().flatten() {
                for lane in 0..LANES {
                    let bend = self.bend(knot, memory.lane(lane), trial[lane]);
                    works[lane] += slider.bend_work(bend);
                }
            }
        }
    }

    /// Elastic energies at the trial and works of the friction on the way there per area, in J/m²:
    /// the potential within a step, up to a constant of the step.
    #[inline(always)]
    fn work(&self, memory: &Remembered<'_>, trial: &Lanes, works: &mut Lanes) {
        self.energy(memory, trial, works);
        self.slide_work(memory, trial, works);
    }

    /// Moves the memories from `start` on, and returns the energies per area that were lost on the
    /// way, in J/m².
    #[inline(always)]
    fn commit(&self, moving: &mut Moving<'_>, start: usize, trial: &Lanes) -> Lanes {
        let mut lost = [0.0; LANES];
        let mut ends = [[0.0; LANES]; 2];
        let memory = moving.from(start);
        self.slide_work(&memory, trial, &mut lost);
        for (element, slider) in self.sliders().0.into_iter().enumerate() {
            let Some(slider) = slider else { continue };
            let (before, end) = (memory.friction(element), &mut ends[element]);
            for lane in 0..LANES {
                end[lane] = slider.load(before[lane], self.stroke(memory.lane(lane), trial[lane]));
            }
            for knot in 0..Self::KNOTS {
                if !self.passes(knot, &memory, trial) {
                    continue;
                }
                for lane in 0..LANES {
                    let sign = self.stroke(memory.lane(lane), trial[lane]).sign;
                    let bend = self.bend(knot, memory.lane(lane), trial[lane]);
                    end[lane] += slider.bend_load(sign, bend);
                }
            }
            for lane in 0..LANES {
                lost[lane] += slider.stored(before[lane]) - slider.stored(end[lane]);
            }
        }
        let mut peaks = [0.0; LANES];
        for lane in 0..LANES {
            peaks[lane] = self.peak(memory.lane(lane).peak, trial[lane]);
        }
        let ages = Self::AGES && any(|lane| peaks[lane] > memory.lane(lane).peak);
        let mut energies = [[0.0; LANES]; 2];
        if ages {
            self.energy(&memory, trial, &mut energies[0]);
        }
        let [first, second] = self.sliders().0;
        let loads = [first.map(|_| &ends[0]), second.map(|_| &ends[1])];
        moving.write(start, (trial, &peaks), loads);
        if ages {
            moving.age(self, start);
            self.energy(&moving.from(start), trial, &mut energies[1]);
            for lane in 0..LANES {
                lost[lane] += energies[0][lane] - energies[1][lane];
            }
        }
        lost
    }

    /// Adds the energies per area that the memories can give back, in J/m².
    #[inline(always)]
    fn stored(&self, memory: &Remembered<'_>, energies: &mut Lanes) {
        self.energy(memory, memory.position(), energies);
        self.slide_stored(memory, energies);
    }

    /// Adds the energies per area that the friction can give back, in J/m².
    #[inline(always)]
    fn slide_stored(&self, memory: &Remembered<'_>, energies: &mut Lanes) {
        for (element, slider) in self.sliders().0.into_iter().enumerate() {
            let Some(slider) = slider else { continue };
            for lane in 0..LANES {
                energies[lane] += slider.stored(memory.friction(element)[lane]);
            }
        }
    }

    /// The path from the memory to a trial.
    #[inline(always)]
    fn stroke(&self, lane: Lane, trial: f64) -> Stroke {
        let rising = trial >= lane.position;
        let sign = if rising { 1.0 } else { -1.0 };
        Stroke {
            sign,
            way: (trial - lane.position).abs(),
            weight: self.weight(lane, lane.position),
            ramp: sign * self.slope(lane, rising),
        }
    }

    /// What becomes of the path at a knot.
    #[inline(always)]
    fn bend(&self, knot: usize, lane: Lane, trial: f64) -> Bend {
        let (place, ramp) = self.knot(knot, lane);
        let beyond = trial - place;
        // The path passes the knot if its ends lie on two sides of it.
        let passes = (lane.position - place) * beyond < 0.0;
        let way = if passes { beyond.abs() } else { 0.0 };
        Bend { ramp, way }
    }

    /// Whether some lane passes the knot.
    #[inline(always)]
    fn passes(&self, knot: usize, memory: &Remembered<'_>, trial: &Lanes) -> bool {
        any(|lane| self.bend(knot, memory.lane(lane), trial[lane]).way > 0.0)
    }

    /// Whether some lane passes some knot.
    #[inline(always)]
    fn passes_any(&self, memory: &Remembered<'_>, trial: &Lanes) -> bool {
        any(|lane| {
            (0..Self::KNOTS).fold(false, |passes, knot| {
                passes | (self.bend(knot, memory.lane(lane), trial[lane]).way > 0.0)
            })
        })
    }
}

/// Loads and tangents of a batch, in the units of [`Response`](crate::Response).
#[derive(Debug, Clone, Copy)]
pub struct Responses {
    /// Loads per width.
    pub load: Lanes,
    /// Derivatives of the loads with respect to the deformations.
    pub tangent: Lanes,
}

impl Default for Responses {
    fn default() -> Self {
        Self { load: [0.0; LANES], tangent: [0.0; LANES] }
    }
}

/// The elements of a friction, prepared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sliders([Option<Slider>; 2]);

impl Sliders {
    /// Prepares a friction.
    #[must_use]
    pub fn new(friction: &BlimanSorine) -> Self {
        let prepare = |element: drape_hysteresis::Dahl| {
            (element.plateau != 0.0).then(|| Slider::new(element))
        };
        Self(friction.elements.map(prepare))
    }
}
