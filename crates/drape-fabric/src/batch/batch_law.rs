//! The interface of a law for a batch, and all that the laws share: friction, commit, stored energy.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_hysteresis::{PassedKnot, Response, Stroke};

use crate::batch::friction::PreparedFriction;
use crate::batch::lanes::{LANES, Lanes, any};
use crate::batch::memories::{CommittedBatch, LaneMemory, Memories, MemoriesMut, MemoryBatch, Toe};

/// Law prepared for many connectors side by side; its results are those of [`Law`](crate::Law) up to
/// rounding.
///
/// A law supplies functions of one lane, without branches; the provided methods apply them to a batch.
/// Everything is inlined into the caller, so that it is compiled for the vector instructions that the
/// caller has selected.
///
/// ```
/// use drape_fabric::{
///     BatchLaw, BendingBackbone, BendingBatch, BendingLaw, BlimanSorine, LANES, Law, Responses,
/// };
///
/// let law = BendingLaw {
///     backbone: BendingBackbone::Linear { rigidity: 1.2e-5 },
///     rest_curvature: 0.0,
///     friction: BlimanSorine::first_order(6e-4, 4.0),
/// };
/// let batch = BendingBatch::new(law);
/// let memories = batch.memories(LANES);
/// let mut responses = Responses::default();
/// batch.respond::<true>(&memories.batch(0), &[100.0; LANES], &mut responses);
/// let one = law.respond(&law.virgin(), 100.0);
/// assert!((responses.load[7] / one.load - 1.0).abs() < 1e-12);
/// ```
pub trait BatchLaw {
    /// Number of knots: deformations where the weight of the friction changes its slope.
    const KNOTS: usize;

    /// Whether the elastic load depends on the largest deformation.
    const DEPENDS_ON_PEAK: bool;

    /// Elements of the friction.
    fn friction(&self) -> &PreparedFriction;

    /// Returns the priming zone after a largest deformation.
    fn toe(&self, peak: f64) -> Toe;

    /// Returns the largest deformation after a trial has been accepted, in the unit of the
    /// deformation.
    fn peak(&self, peak: f64, trial: f64) -> f64;

    /// Returns the weight of the friction at a deformation.
    fn weight(&self, lane: LaneMemory, deformation: f64) -> f64;

    /// Returns the derivative of the weight at the remembered deformation, on the side of rising or
    /// of falling deformation.
    fn weight_slope(&self, lane: LaneMemory, rising: bool) -> f64;

    /// Returns one of the knots of the weight.
    fn knot(&self, knot: usize, lane: LaneMemory) -> Knot;

    /// Adds elastic loads, and their tangents if `TANGENT`, in the units of
    /// [`Response`].
    fn add_elastic<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    );

    /// Adds elastic energies per area, in J/m².
    fn add_elastic_energy(&self, memory: &MemoryBatch<'_>, trial: &Lanes, energies: &mut Lanes);

    /// Returns the memories of connectors that were never deformed.
    #[must_use]
    fn memories(&self, count: usize) -> Memories {
        let mut memories = Memories::default();
        self.append_memories(&mut memories, count);
        memories
    }

    /// Appends memories of connectors that were never deformed.
    fn append_memories(&self, memories: &mut Memories, count: usize) {
        memories.append(count, self.toe(0.0));
    }

    /// Writes the [`LANES`] memories from `start` on as those of connectors that have the given
    /// deformations and no friction.
    fn start(&self, memories: &mut Memories, start: usize, deformations: &Lanes) {
        for (index, &position) in (start..).zip(deformations) {
            let peak = self.peak(0.0, position);
            let toe = self.toe(peak);
            memories.set_frictionless(index, LaneMemory { position, peak, toe });
        }
    }

    /// Adds loads, and tangents if `TANGENT`, at trial deformations.
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

    /// Adds the loads of the friction, and their tangents if `TANGENT`.
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

    /// Adds the work of the friction per area from the memory to the trial, in J/m².
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

    /// Adds the potential within a step per area, in J/m²: the elastic energy at the trial and the
    /// work of the friction from the memory to the trial. Its constant depends on the memory.
    #[inline(always)]
    fn add_work(&self, memory: &MemoryBatch<'_>, trial: &Lanes, works: &mut Lanes) {
        self.add_elastic_energy(memory, trial, works);
        self.add_friction_work(memory, trial, works);
    }

    /// Advances the memories from `start` on; returns the energies per area that the friction has
    /// dissipated, in J/m².
    #[inline(always)]
    fn commit(&self, memories: &mut MemoriesMut<'_>, start: usize, trial: &Lanes) -> Lanes {
        let mut lost = [0.0; LANES];
        let mut ends = [[0.0; LANES]; 2];
        let memory = memories.batch(start);
        self.add_friction_work(&memory, trial, &mut lost);
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

    /// Adds the energies per area that can be returned from the memories, in J/m².
    #[inline(always)]
    fn add_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes) {
        self.add_elastic_energy(memory, memory.position(), energies);
        self.add_friction_stored(memory, energies);
    }

    /// Adds the energies per area that the friction elements can return, in J/m².
    #[inline(always)]
    fn add_friction_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes) {
        for (index, element) in self.friction().0.into_iter().enumerate() {
            let Some(element) = element else { continue };
            for lane in 0..LANES {
                energies[lane] += element.stored(memory.friction(index)[lane]);
            }
        }
    }

    /// Returns the path from the memory to a trial.
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

    /// Returns what remains of the path beyond a knot: nothing where it does not pass the knot.
    #[inline(always)]
    fn passed(&self, knot: usize, lane: LaneMemory, trial: f64) -> PassedKnot {
        let Knot { position, slope_change } = self.knot(knot, lane);
        let beyond = trial - position;
        // The path passes the knot if its ends lie on two sides of it.
        let passes = (lane.position - position) * beyond < 0.0;
        let length = if passes { beyond.abs() } else { 0.0 };
        PassedKnot { slope_change, length }
    }

    /// Returns whether some lane passes the knot.
    #[inline(always)]
    fn passes(&self, knot: usize, memory: &MemoryBatch<'_>, trial: &Lanes) -> bool {
        any(|lane| self.passed(knot, memory.lane(lane), trial[lane]).length > 0.0)
    }

    /// Returns whether some lane passes some knot.
    #[inline(always)]
    fn passes_any(&self, memory: &MemoryBatch<'_>, trial: &Lanes) -> bool {
        any(|lane| {
            (0..Self::KNOTS).fold(false, |passes, knot| {
                passes | (self.passed(knot, memory.lane(lane), trial[lane]).length > 0.0)
            })
        })
    }
}

/// Deformation where the weight of the friction changes its slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Knot {
    /// The deformation, in the unit of the deformation.
    pub position: f64,
    /// Change of the weight's derivative there, for rising deformation.
    pub slope_change: f64,
}

/// Loads and tangents of a batch, in the units of [`Response`].
#[derive(Debug, Clone, Copy)]
pub struct Responses {
    /// Loads per width.
    pub load: Lanes,
    /// Derivatives of the loads with respect to the deformations.
    pub tangent: Lanes,
}

impl Responses {
    /// Returns load and tangent of one lane.
    #[inline(always)]
    #[must_use]
    pub fn lane(&self, lane: usize) -> Response {
        Response { load: self.load[lane], tangent: self.tangent[lane] }
    }
}

impl Default for Responses {
    fn default() -> Self {
        Self { load: [0.0; LANES], tangent: [0.0; LANES] }
    }
}
