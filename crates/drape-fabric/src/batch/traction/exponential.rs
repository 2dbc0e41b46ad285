//! The traction law with an exponential toe and friction that grows with the tension, for a batch.
#![allow(clippy::needless_range_loop, reason = "a lane indexes several arrays")]

use drape_hysteresis::{PreparedDahl, Stroke, exp_m1};

use crate::batch::batch_law::{BatchLaw, Responses};
use crate::batch::lanes::{LANES, Lanes, any, positive};
use crate::batch::memories::{CommittedBatch, LaneMemory, Memories, MemoriesMut, MemoryBatch, Toe};
use crate::batch::traction::compression::Compression;
use crate::batch::traction::toe::toe_end;
use crate::laws::traction::buckling::Buckling;
use crate::laws::traction::exponential::ExponentialToe;
use crate::laws::traction::proportional::{
    ProportionalFriction, Weight, WeightPiece, WeightedStep,
};

/// The law with an exponential toe for many connectors side by side.
///
/// The memory contains the end of the toe ([`Toe`]). The state of the friction is the first of the
/// two friction loads of a memory.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ExponentialBatch {
    toe: ExponentialToe,
    friction: ProportionalFriction,
    compression: Compression,
    /// Element whose load is the state of the friction, `None` without friction.
    element: Option<PreparedDahl>,
    /// Ratio of the stiffness that the toe adds to its steepness, in N/m.
    scale: f64,
    /// Number `$e^{-b} - 1$` with the steepness `$b$`.
    rest: f64,
    /// Product of the stiffness that the toe adds and its deficit, in N/m.
    lowered: f64,
}

/// Elastic load in tension of a batch and its tangent. The load is 0 in compressed lanes.
struct Tension {
    load: Lanes,
    tangent: Lanes,
}

impl ExponentialBatch {
    /// Prepares the law with a `toe`, a `friction` and `buckling` for a batch.
    pub(crate) fn new(
        toe: ExponentialToe,
        friction: ProportionalFriction,
        buckling: Buckling,
    ) -> Self {
        Self {
            toe,
            friction,
            compression: Compression { rest: toe.rest_stiffness(), buckling },
            element: (!friction.is_none()).then(|| PreparedDahl::new(friction.element())),
            scale: toe.stiffness / toe.steepness,
            rest: exp_m1(-toe.steepness),
            lowered: toe.stiffness * toe.deficit(),
        }
    }

    /// Returns the toe after the largest elongation `peak`.
    #[inline(always)]
    fn toe(&self, peak: f64) -> Toe {
        let ExponentialToe { toe_strain, toe_strain_after, steepness, .. } = self.toe;
        let end = toe_end(toe_strain, toe_strain_after, peak);
        Toe { end, weight_slope: steepness / end }
    }

    /// Returns whether any lane of `trial` is stretched beyond its largest elongation, which moves
    /// its toe.
    #[inline(always)]
    fn extends_toe(&self, memory: &MemoryBatch<'_>, trial: &Lanes) -> bool {
        self.toe.toe_strain_after > self.toe.toe_strain
            && any(|lane| trial[lane] > memory.lane(lane).peak.max(self.toe.toe_strain))
    }

    /// Returns the elastic load in tension at `trial`, and its tangent if `TANGENT`.
    #[inline(always)]
    fn tension<const TANGENT: bool>(&self, memory: &MemoryBatch<'_>, trial: &Lanes) -> Tension {
        let ExponentialToe { base_stiffness, stiffness, steepness, .. } = self.toe;
        let (mut load, mut tangent) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let (strain, toe) = (positive(trial[lane]), memory.lane(lane).toe);
            // Beyond the toe the exponent is zero. At zero strain it is exactly the steepness.
            let below = exp_m1(-positive(steepness - toe.weight_slope * strain));
            let within = self.scale * toe.end * (below - self.rest);
            let beyond = stiffness * positive(strain - toe.end);
            load[lane] = base_stiffness * strain + within + beyond;
            if TANGENT {
                tangent[lane] = base_stiffness + stiffness * (1.0 + below);
            }
        }

        // If the toe moves with the strain, its end replaces the end in the memory.
        if self.extends_toe(memory, trial) {
            let ExponentialToe { toe_strain, toe_strain_after, .. } = self.toe;
            for lane in 0..LANES {
                let strain = trial[lane];
                let moves = strain > memory.lane(lane).peak.max(toe_strain);
                let end = toe_end(toe_strain, toe_strain_after, strain);
                let reduction = self.lowered * (end - memory.lane(lane).toe.end);
                load[lane] -= if moves { reduction } else { 0.0 };
                if TANGENT {
                    let growth = (toe_strain_after - end) / toe_strain;
                    tangent[lane] -= if moves { self.lowered * growth } else { 0.0 };
                }
            }
        }
        Tension { load, tangent }
    }

    /// Adds the loads of the friction, and their tangents if `TANGENT`, with the elastic load
    /// `tension` to `responses`.
    #[inline(always)]
    fn add_friction_at<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        tension: &Tension,
        responses: &mut Responses,
    ) {
        let Some(element) = self.element else { return };
        let ProportionalFriction { ratio, plateau, .. } = self.friction;
        let Responses { load, tangent } = responses;

        // Weight and its slope. In compression the elastic load is zero and the plateau decays.
        let (mut weights, mut slopes) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            weights[lane] = plateau + ratio * tension.load[lane];
            slopes[lane] = ratio * tension.tangent[lane];
        }
        if any(|lane| trial[lane] < 0.0) {
            let scale = self.compression.buckling.strain;
            for lane in 0..LANES {
                let compressed = trial[lane] < 0.0;
                let decayed = plateau * (1.0 + exp_m1(-positive(-trial[lane]) / scale));
                weights[lane] = if compressed { decayed } else { weights[lane] };
                slopes[lane] = if compressed { decayed / scale } else { slopes[lane] };
            }
        }

        let before = memory.friction(0);
        for lane in 0..LANES {
            let stroke = self.stroke(memory.lane(lane), trial[lane]);
            let state = element.load(before[lane], stroke);
            load[lane] += weights[lane] * state;
            if TANGENT {
                let rate = element.tangent(state, stroke.sign, 1.0);
                tangent[lane] += slopes[lane] * state + weights[lane] * rate;
            }
        }
    }

    /// Returns the path of the friction's state from the memory `lane` to `trial`.
    #[inline(always)]
    fn stroke(&self, lane: LaneMemory, trial: f64) -> Stroke {
        let sign = if trial >= lane.position { 1.0 } else { -1.0 };
        Stroke { sign, length: (trial - lane.position).abs(), weight: 1.0, weight_slope: 0.0 }
    }

    /// Adds the elastic energies per area at `trial` to `energies`, in J/m².
    #[inline(always)]
    fn add_elastic_energy(&self, memory: &MemoryBatch<'_>, trial: &Lanes, energies: &mut Lanes) {
        let ExponentialToe { base_stiffness, stiffness, steepness, .. } = self.toe;
        let deficit = self.toe.deficit();
        for lane in 0..LANES {
            let (strain, toe) = (positive(trial[lane]), memory.lane(lane).toe);
            let below = exp_m1(-positive(steepness - toe.weight_slope * strain));
            let beyond = positive(strain - toe.end);
            let (within, scale) = (strain - beyond, toe.end / steepness);
            let curved = scale * (scale * (below - self.rest) - within * (1.0 + self.rest));
            let line = beyond * (0.5 * (strain + within) - deficit * toe.end);
            energies[lane] += 0.5 * base_stiffness * strain * strain + stiffness * (curved + line);
        }

        // If the toe moves, the integral of its end replaces the integral of the end in the memory.
        if self.extends_toe(memory, trial) {
            let ExponentialToe { toe_strain, toe_strain_after, .. } = self.toe;
            for lane in 0..LANES {
                let (strain, end) = (trial[lane], memory.lane(lane).toe.end);
                let beyond = strain - memory.lane(lane).peak.max(toe_strain);
                let moved = toe_end(toe_strain, toe_strain_after, strain) - end;
                let ends = (toe_strain_after - end) * beyond - toe_strain * moved;
                energies[lane] -= if beyond > 0.0 { self.lowered * ends } else { 0.0 };
            }
        }
        self.compression.add_energy(trial, energies);
    }

    /// Adds the works of the friction per area along `paths` to `works`, in J/m².
    #[inline(always)]
    fn add_path_work(&self, paths: &Paths<'_>, works: &mut Lanes) {
        let weight = Weight {
            toe: &self.toe,
            friction: &self.friction,
            buckling: &self.compression.buckling,
        };

        // Each piece of the weight that a path touches contributes to the work.
        let is_compressed = any(|lane| paths.from[lane].min(paths.to[lane]) < 0.0);
        if self.friction.plateau != 0.0 && is_compressed {
            let piece = weight.compressed();
            self.add_piece_work(paths, |_| (f64::NEG_INFINITY, 0.0, piece), works);
        }
        self.add_piece_work(
            paths,
            |lane| (0.0, paths.ends[lane], weight.within_toe(paths.ends[lane])),
            works,
        );
        if any(|lane| paths.highest(lane) > paths.ends[lane]) {
            self.add_piece_work(
                paths,
                |lane| (paths.ends[lane], paths.peaks[lane], weight.beyond_toe(paths.ends[lane])),
                works,
            );
        }
        if any(|lane| paths.highest(lane) > paths.peaks[lane]) {
            let piece = weight.virgin();
            self.add_piece_work(paths, |lane| (paths.peaks[lane], f64::INFINITY, piece), works);
        }
    }

    /// Adds the works along one piece of the weight to `works`. `piece` returns the lower and upper
    /// end of the piece in a lane, and the piece.
    #[inline(always)]
    fn add_piece_work(
        &self,
        paths: &Paths<'_>,
        piece: impl Fn(usize) -> (f64, f64, WeightPiece),
        works: &mut Lanes,
    ) {
        let length = self.friction.length;
        for lane in 0..LANES {
            let (low, high, piece) = piece(lane);
            let (from, to) = (paths.from[lane], paths.to[lane]);
            let sign = if to >= from { 1.0 } else { -1.0 };
            let start = clamped(from, low, high);
            let kept = 1.0 + exp_m1(-(start - from).abs() / length);
            let state = sign + (paths.states[lane] - sign) * kept;
            let step = WeightedStep { from: start, to: clamped(to, low, high), sign, state };
            // A path of zero length does no work, even where the piece is undefined.
            let work = piece.work(step, length);
            works[lane] += if step.from == step.to { 0.0 } else { work };
        }
    }

    /// Adds the largest energies per area that the friction can return from `memory` to `energies`,
    /// in J/m².
    #[inline(always)]
    fn add_unloading(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes) {
        if self.element.is_none() {
            return;
        }
        let (positions, states) = (memory.position(), memory.friction(0));
        let mut unloaded = [0.0; LANES];
        for lane in 0..LANES {
            let path = self.friction.length * states[lane].abs().ln_1p();
            unloaded[lane] = positions[lane] - path.copysign(states[lane]);
        }

        let ends = self.ends(memory);
        let peaks = [f64::INFINITY; LANES];
        let paths = Paths { from: positions, to: &unloaded, states, ends: &ends, peaks: &peaks };
        let mut works = [0.0; LANES];
        self.add_path_work(&paths, &mut works);
        for lane in 0..LANES {
            energies[lane] -= works[lane];
        }
    }

    /// Returns the ends of the toes in `memory`.
    #[inline(always)]
    fn ends(&self, memory: &MemoryBatch<'_>) -> Lanes {
        std::array::from_fn(|lane| memory.lane(lane).toe.end)
    }
}

/// Straight paths of a batch, with the strains on which the weight of the friction depends.
struct Paths<'a> {
    /// Strains at the starts.
    from: &'a Lanes,
    /// Strains at the ends.
    to: &'a Lanes,
    /// States of the friction at the starts.
    states: &'a Lanes,
    /// Ends of the toes, at strains greater than 0.
    ends: &'a Lanes,
    /// Strains beyond which the toes move.
    peaks: &'a Lanes,
}

impl Paths<'_> {
    /// Returns the largest strain of the path in `lane`.
    #[inline(always)]
    fn highest(&self, lane: usize) -> f64 {
        self.from[lane].max(self.to[lane])
    }
}

/// Returns `x` clamped between `low` and `high`, and NaN for a NaN `x`.
#[inline(always)]
fn clamped(x: f64, low: f64, high: f64) -> f64 {
    let x = if x < low { low } else { x };
    if x > high { high } else { x }
}

impl BatchLaw for ExponentialBatch {
    fn append_memories(&self, memories: &mut Memories, count: usize) {
        memories.append(count, self.toe(0.0));
    }

    fn start(&self, memories: &mut Memories, start: usize, deformations: &Lanes) {
        for (index, &position) in (start..).zip(deformations) {
            let peak = position.max(0.0);
            memories.set_frictionless(index, LaneMemory { position, peak, toe: self.toe(peak) });
        }
    }

    #[inline(always)]
    fn respond<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        let tension = self.tension::<TANGENT>(memory, trial);
        for lane in 0..LANES {
            responses.load[lane] += tension.load[lane];
            responses.tangent[lane] += tension.tangent[lane];
        }
        self.compression.add_load::<TANGENT>(trial, responses);
        self.add_friction_at::<TANGENT>(memory, trial, &tension, responses);
    }

    #[inline(always)]
    fn add_friction<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        let tension = self.tension::<TANGENT>(memory, trial);
        self.add_friction_at::<TANGENT>(memory, trial, &tension, responses);
    }

    #[inline(always)]
    fn add_friction_work(&self, memory: &MemoryBatch<'_>, trial: &Lanes, works: &mut Lanes) {
        if self.element.is_none() {
            return;
        }
        let ends = self.ends(memory);
        let peaks = std::array::from_fn(|lane| memory.lane(lane).peak.max(self.toe.toe_strain));
        let states = memory.friction(0);
        let from = memory.position();
        self.add_path_work(&Paths { from, to: trial, states, ends: &ends, peaks: &peaks }, works);
    }

    #[inline(always)]
    fn add_work(&self, memory: &MemoryBatch<'_>, trial: &Lanes, works: &mut Lanes) {
        self.add_elastic_energy(memory, trial, works);
        self.add_friction_work(memory, trial, works);
    }

    #[inline(always)]
    fn commit(&self, memories: &mut MemoriesMut<'_>, start: usize, trial: &Lanes) -> Lanes {
        // The dissipated energy is the energy before plus the work, less the energy afterwards.
        let memory = memories.batch(start);
        let mut lost = [0.0; LANES];
        self.add_friction_work(&memory, trial, &mut lost);
        self.add_unloading(&memory, &mut lost);
        let toes_move = self.extends_toe(&memory, trial);
        let (mut before, mut after) = ([0.0; LANES], [0.0; LANES]);
        if toes_move {
            self.add_elastic_energy(&memory, trial, &mut before);
        }

        let (mut peaks, mut states) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let memory_of_lane = memory.lane(lane);
            peaks[lane] = memory_of_lane.peak.max(trial[lane]);
            if let Some(element) = self.element {
                let stroke = self.stroke(memory_of_lane, trial[lane]);
                states[lane] = element.load(memory.friction(0)[lane], stroke);
            }
        }
        let friction = [Some(&states), None];
        memories.write(start, CommittedBatch { positions: trial, peaks: &peaks, friction });
        if toes_move {
            memories.update_toes(start, |peak| self.toe(peak));
        }

        let memory = memories.batch(start);
        if toes_move {
            self.add_elastic_energy(&memory, trial, &mut after);
        }
        self.add_unloading(&memory, &mut after);
        for lane in 0..LANES {
            lost[lane] += before[lane] - after[lane];
        }
        lost
    }

    #[inline(always)]
    fn add_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes) {
        self.add_elastic_energy(memory, memory.position(), energies);
        self.add_unloading(memory, energies);
    }

    #[inline(always)]
    fn add_friction_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes) {
        self.add_unloading(memory, energies);
    }
}
