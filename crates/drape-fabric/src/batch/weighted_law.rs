//! A law whose friction has a plateau with a weight that is linear between knots, for a batch.
//!
//! Such laws are bending, shear, and traction without an exponential toe. A scalar law cuts the
//! path into pieces. A batch adds contributions of the knots that the path passes instead.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_hysteresis::{PassedKnot, Stroke};

use crate::batch::batch_law::{BatchLaw, Responses};
use crate::batch::friction::PreparedFriction;
use crate::batch::lanes::{LANES, Lanes, any};
use crate::batch::memories::{CommittedBatch, LaneMemory, Memories, MemoriesMut, MemoryBatch, Toe};

/// Law whose friction has a plateau with a weight that is linear between knots.
///
/// Such a law supplies functions of one lane, without branches. The trait [`BatchLaw`] applies
/// these functions to a batch.
pub(crate) trait WeightedLaw {
    /// Number of knots: deformations at which the weight of the friction changes its slope.
    const KNOTS: usize;

    /// Whether the elastic load depends on the largest deformation.
    const DEPENDS_ON_PEAK: bool;

    /// Returns the elements of the friction.
    fn friction(&self) -> &PreparedFriction;

    /// Returns the priming zone after the largest deformation `peak`.
    fn toe(&self, peak: f64) -> Toe;

    /// Returns the largest deformation after the acceptance of `trial`, in the unit of the
    /// deformation. `peak` is the largest deformation before.
    fn peak(&self, peak: f64, trial: f64) -> f64;

    /// Returns the weight of the friction at `deformation`.
    fn weight(&self, lane: LaneMemory, deformation: f64) -> f64;

    /// Returns the derivative of the weight at the deformation of the memory `lane`, from above if
    /// the deformation is `rising`, otherwise from below.
    fn weight_slope(&self, lane: LaneMemory, rising: bool) -> f64;

    /// Returns the knot of the weight with the index `knot`.
    fn knot(&self, knot: usize, lane: LaneMemory) -> Knot;

    /// Adds elastic loads, and their tangents if `TANGENT`, at `trial` to `responses`.
    fn add_elastic<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    );

    /// Adds elastic energies per area at `trial` to `energies`, in J/m².
    fn add_elastic_energy(&self, memory: &MemoryBatch<'_>, trial: &Lanes, energies: &mut Lanes);

    /// Returns the path from the memory `lane` to `trial`.
    #[inline(always)]
    fn stroke(&self, lane: LaneMemory, trial: f64) -> Stroke {
        let rising = trial >= lane.position;
        let sign = if rising { 1.0 } else { -1.0 };
        Stroke {
            sign,
            length: (trial - lane.position).abs(),
            weight: self.weight(lane, lane.position),
            weight_slope: sign * self.weight_slope(lane, rising),
        }
    }

    /// Returns the part of the path beyond `knot`, with the length 0 if the path does not pass the
    /// knot.
    #[inline(always)]
    fn passed(&self, knot: usize, lane: LaneMemory, trial: f64) -> PassedKnot {
        let Knot { position, slope_change } = self.knot(knot, lane);
        let beyond = trial - position;
        // The path passes the knot if its ends lie on different sides of the knot.
        let passes = (lane.position - position) * beyond < 0.0;
        let length = if passes { beyond.abs() } else { 0.0 };
        PassedKnot { slope_change, length }
    }

    /// Returns whether the path of any lane passes `knot`.
    #[inline(always)]
    fn passes(&self, knot: usize, memory: &MemoryBatch<'_>, trial: &Lanes) -> bool {
        any(|lane| self.passed(knot, memory.lane(lane), trial[lane]).length > 0.0)
    }

    /// Returns whether the path of any lane of `trial` passes any knot.
    #[inline(always)]
    fn passes_any(&self, memory: &MemoryBatch<'_>, trial: &Lanes) -> bool {
        any(|lane| {
            (0..Self::KNOTS).fold(false, |passes, knot| {
                passes | (self.passed(knot, memory.lane(lane), trial[lane]).length > 0.0)
            })
        })
    }
}

impl<L: WeightedLaw> BatchLaw for L {
    fn append_memories(&self, memories: &mut Memories, count: usize) {
        memories.append(count, self.toe(0.0));
    }

    fn start(&self, memories: &mut Memories, start: usize, deformations: &Lanes) {
        for (index, &position) in (start..).zip(deformations) {
            let peak = self.peak(0.0, position);
            let toe = self.toe(peak);
            memories.set_frictionless(index, LaneMemory { position, peak, toe });
        }
    }

    #[inline(always)]
    fn respond<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        self.add_elastic::<TANGENT>(memory, trial, responses);
        self.add_friction::<TANGENT>(memory, trial, responses);
    }

    #[inline(always)]
    fn add_friction<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        let Responses { load, tangent } = responses;
        for (index, element) in self.friction().0.into_iter().enumerate() {
            let Some(element) = element else { continue };
            let before = memory.friction(index);
            for lane in 0..LANES {
                let stroke = self.stroke(memory.lane(lane), trial[lane]);
                let end = element.load(before[lane], stroke);
                load[lane] += end;
                if TANGENT {
                    let weight = self.weight(memory.lane(lane), trial[lane]);
                    tangent[lane] += element.tangent(end, stroke.sign, weight);
                }
            }
        }

        // Paths rarely pass a knot, so the contributions of the knots are skipped if none does.
        if !self.passes_any(memory, trial) {
            return;
        }
        for knot in 0..Self::KNOTS {
            if !self.passes(knot, memory, trial) {
                continue;
            }
            for element in self.friction().0.into_iter().flatten() {
                for lane in 0..LANES {
                    let sign = self.stroke(memory.lane(lane), trial[lane]).sign;
                    let passed = self.passed(knot, memory.lane(lane), trial[lane]);
                    let gained = element.knot_load(sign, passed);
                    load[lane] += gained;
                    if TANGENT {
                        tangent[lane] += element.tangent(gained, sign, 0.0);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn add_friction_work(&self, memory: &MemoryBatch<'_>, trial: &Lanes, works: &mut Lanes) {
        for (index, element) in self.friction().0.into_iter().enumerate() {
            let Some(element) = element else { continue };
            let before = memory.friction(index);
            for lane in 0..LANES {
                let stroke = self.stroke(memory.lane(lane), trial[lane]);
                works[lane] += element.work(before[lane], stroke);
            }
        }

        if !self.passes_any(memory, trial) {
            return;
        }
        for knot in 0..Self::KNOTS {
            if !self.passes(knot, memory, trial) {
                continue;
            }
            for element in self.friction().0.into_iter().flatten() {
                for lane in 0..LANES {
                    let passed = self.passed(knot, memory.lane(lane), trial[lane]);
                    works[lane] += element.knot_work(passed);
                }
            }
        }
    }

    #[inline(always)]
    fn add_work(&self, memory: &MemoryBatch<'_>, trial: &Lanes, works: &mut Lanes) {
        self.add_elastic_energy(memory, trial, works);
        self.add_friction_work(memory, trial, works);
    }

    #[inline(always)]
    fn commit(&self, memories: &mut MemoriesMut<'_>, start: usize, trial: &Lanes) -> Lanes {
        let mut lost = [0.0; LANES];
        let mut ends = [[0.0; LANES]; 2];
        let memory = memories.batch(start);
        self.add_friction_work(&memory, trial, &mut lost);

        // The friction dissipates its work less the change of its stored energy.
        for (index, element) in self.friction().0.into_iter().enumerate() {
            let Some(element) = element else { continue };
            let (before, end) = (memory.friction(index), &mut ends[index]);
            for lane in 0..LANES {
                end[lane] = element.load(before[lane], self.stroke(memory.lane(lane), trial[lane]));
            }
            for knot in 0..Self::KNOTS {
                if !self.passes(knot, &memory, trial) {
                    continue;
                }
                for lane in 0..LANES {
                    let sign = self.stroke(memory.lane(lane), trial[lane]).sign;
                    let passed = self.passed(knot, memory.lane(lane), trial[lane]);
                    end[lane] += element.knot_load(sign, passed);
                }
            }
            for lane in 0..LANES {
                lost[lane] += element.stored(before[lane]) - element.stored(end[lane]);
            }
        }

        let mut peaks = [0.0; LANES];
        for lane in 0..LANES {
            peaks[lane] = self.peak(memory.lane(lane).peak, trial[lane]);
        }

        // A moving toe changes the elastic energy at a constant strain, which is dissipated too.
        let toes_move = Self::DEPENDS_ON_PEAK && any(|lane| peaks[lane] > memory.lane(lane).peak);
        let mut energies = [[0.0; LANES]; 2];
        if toes_move {
            self.add_elastic_energy(&memory, trial, &mut energies[0]);
        }

        let [first, second] = self.friction().0;
        let friction = [first.map(|_| &ends[0]), second.map(|_| &ends[1])];
        memories.write(start, CommittedBatch { positions: trial, peaks: &peaks, friction });
        if toes_move {
            memories.update_toes(start, |peak| self.toe(peak));
            self.add_elastic_energy(&memories.batch(start), trial, &mut energies[1]);
            for lane in 0..LANES {
                lost[lane] += energies[0][lane] - energies[1][lane];
            }
        }
        lost
    }

    #[inline(always)]
    fn add_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes) {
        self.add_elastic_energy(memory, memory.position(), energies);
        self.add_friction_stored(memory, energies);
    }

    #[inline(always)]
    fn add_friction_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes) {
        for (index, element) in self.friction().0.into_iter().enumerate() {
            let Some(element) = element else { continue };
            for lane in 0..LANES {
                energies[lane] += element.stored(memory.friction(index)[lane]);
            }
        }
    }
}

/// Deformation at which the weight of the friction changes its slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Knot {
    /// Position of the knot, in the unit of the deformation.
    pub(crate) position: f64,
    /// Change of the weight's derivative at the knot, for rising deformation.
    pub(crate) slope_change: f64,
}
